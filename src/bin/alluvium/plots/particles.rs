//! Particles coloured by a quantity, in panels that share axes and colour bar.

use alluvium::verify::plot::{Anchor, Canvas, Scale, Stroke, viridis};
use core::fmt::Write;

/// Shades a colour bar is cut into; one path each keeps the file small.
const SHADES: usize = 64;
const PANEL_WIDTH: f64 = 430.0;
const GAP: (f64, f64) = (26.0, 62.0);
const LEFT: f64 = 66.0;
const TOP: f64 = 50.0;
const BAR: f64 = 96.0;

/// How a quantity's range is laid on places.
type Axis = fn((f64, f64), (f64, f64)) -> Scale;

/// One instant.
pub struct Panel {
    /// What is written above it.
    pub caption: String,
    /// Where particles are, and their quantity: each layer is drawn over those before.
    pub layers: Vec<Vec<([f64; 2], f64)>>,
    /// Where wall particles are.
    pub walls: Vec<[f64; 2]>,
    /// Lines behind the particles, from one place to another.
    pub lines: Vec<([f64; 2], [f64; 2])>,
}

/// A picture of one or more instants.
pub struct ParticlePicture<'a> {
    /// The quantity with its unit, as in `pressure [kPa]`.
    pub quantity: &'a str,
    /// Quantity at the ends of the colour bar.
    pub range: (f64, f64),
    /// Lowest and highest corner of what is shown \[m\].
    pub window: ([f64; 2], [f64; 2]),
    /// Diameter of a particle \[m\].
    pub spacing: f64,
    /// Names of the axes, with units.
    pub axes: [&'a str; 2],
    /// Panels in a row.
    pub columns: usize,
}

impl ParticlePicture<'_> {
    /// The picture of these instants.
    pub fn svg(&self, panels: &[Panel]) -> String {
        self.draw(panels, Scale::linear)
    }

    /// The same with a colour bar in decades; what is below its lower end has that end's colour.
    pub fn svg_logarithmic(&self, panels: &[Panel]) -> String {
        self.draw(panels, Scale::logarithmic)
    }

    fn draw(&self, panels: &[Panel], axis: Axis) -> String {
        let columns = self.columns.clamp(1, panels.len().max(1));
        let rows = panels.len().max(1).div_ceil(columns);
        let size = self.panel_size();
        let right = LEFT + columns as f64 * (size.0 + GAP.0);
        let height = TOP + rows as f64 * (size.1 + GAP.1) + 4.0;
        let mut canvas = Canvas::new(right + BAR, height);
        for (n, panel) in panels.iter().enumerate() {
            let (column, row) = (n % columns, n / columns);
            let at = (LEFT + column as f64 * (size.0 + GAP.0), TOP + row as f64 * (size.1 + GAP.1));
            let is_lowest = n + columns >= panels.len();
            self.panel(&mut canvas, panel, at, (column == 0, is_lowest), axis);
        }
        let bar = size.1.max((height - TOP - GAP.1).min(320.0));
        self.colour_bar(&mut canvas, (right + 4.0, TOP), bar, axis);
        canvas.finish()
    }

    fn panel_size(&self) -> (f64, f64) {
        let (low, high) = self.window;
        (PANEL_WIDTH, PANEL_WIDTH * (high[1] - low[1]) / (high[0] - low[0]))
    }

    fn panel(&self, canvas: &mut Canvas, panel: &Panel, at: (f64, f64), labelled: (bool, bool), axis: Axis) {
        let size = self.panel_size();
        let (low, high) = self.window;
        let x = Scale::linear((low[0], high[0]), (at.0, at.0 + size.0));
        let y = Scale::linear((low[1], high[1]), (at.1 + size.1, at.1));
        canvas.rectangle(at, size, "#fafafa", "");
        for (from, to) in &panel.lines {
            let at = |p: &[f64; 2]| (x.place(p[0]), y.place(p[1]));
            canvas.line(at(from), at(to), Stroke { colour: "#999", width: 1.0, dash: "" });
        }
        self.dots(canvas, panel, (x, y), axis(self.range, (0.0, 1.0)));
        canvas.rectangle(at, size, "none", "#222");
        canvas.text((at.0, at.1 - 9.0), 14.0, Anchor::Start, &panel.caption);
        let tick = Stroke { colour: "#222", width: 1.0, dash: "" };
        let bottom = at.1 + size.1;
        for (value, label) in x.ticks(5) {
            canvas.line((x.place(value), bottom), (x.place(value), bottom + 5.0), tick);
            canvas.text((x.place(value), bottom + 19.0), 12.0, Anchor::Middle, &label);
        }
        for (value, label) in y.ticks((size.1 / 55.0) as usize) {
            canvas.line((at.0 - 5.0, y.place(value)), (at.0, y.place(value)), tick);
            if labelled.0 {
                canvas.text((at.0 - 9.0, y.place(value) + 4.0), 12.0, Anchor::End, &label);
            }
        }
        if labelled.1 {
            canvas.text((at.0 + 0.5 * size.0, bottom + 38.0), 13.0, Anchor::Middle, self.axes[0]);
        }
        if labelled.0 {
            canvas.upward_text((at.0 - 48.0, at.1 + 0.5 * size.1), 13.0, self.axes[1]);
        }
    }

    /// One path of round dots per shade, in tenths of a pixel.
    fn dots(&self, canvas: &mut Canvas, panel: &Panel, (x, y): (Scale, Scale), shade: Scale) {
        let mut walls = String::new();
        let put = |path: &mut String, p: [f64; 2]| {
            if x.contains(p[0]) && y.contains(p[1]) {
                write!(path, "M{:.0} {:.0}h0", 10.0 * x.place(p[0]), 10.0 * y.place(p[1])).ok();
            }
        };
        let shaded = |layer: &Vec<([f64; 2], f64)>| {
            let mut paths = vec![String::new(); SHADES];
            for (place, value) in layer {
                let part = shade.place(*value).clamp(0.0, 1.0);
                put(&mut paths[((part * SHADES as f64) as usize).min(SHADES - 1)], *place);
            }
            paths
        };
        panel.walls.iter().for_each(|place| put(&mut walls, *place));
        let diameter = 10.0 * (x.place(self.spacing) - x.place(0.0));
        canvas.raw("<g transform=\"scale(0.1)\" fill=\"none\" stroke-linecap=\"round\">");
        let mut draw = |path: &str, colour: &str, width: f64| {
            if !path.is_empty() {
                canvas.raw(&format!("<path d=\"{path}\" stroke=\"{colour}\" stroke-width=\"{width:.1}\"/>"));
            }
        };
        draw(&walls, "#b4b4b4", 0.8 * diameter);
        for paths in panel.layers.iter().map(shaded) {
            for (n, path) in paths.iter().enumerate() {
                draw(path, &viridis((n as f64 + 0.5) / SHADES as f64), 1.35 * diameter);
            }
        }
        canvas.raw("</g>");
    }

    fn colour_bar(&self, canvas: &mut Canvas, at: (f64, f64), height: f64, axis: Axis) {
        let step = height / SHADES as f64;
        for n in 0..SHADES {
            let top = at.1 + height - (n + 1) as f64 * step;
            let colour = viridis((n as f64 + 0.5) / SHADES as f64);
            canvas.rectangle((at.0, top), (16.0, step + 0.4), &colour, "");
        }
        canvas.rectangle(at, (16.0, height), "none", "#222");
        let scale = axis(self.range, (at.1 + height, at.1));
        for (value, label) in scale.ticks(6) {
            let y = scale.place(value);
            canvas.line((at.0 + 16.0, y), (at.0 + 20.0, y), Stroke { colour: "#222", width: 1.0, dash: "" });
            canvas.text((at.0 + 24.0, y + 4.0), 12.0, Anchor::Start, &label);
        }
        canvas.upward_text((at.0 + 70.0, at.1 + 0.5 * height), 13.0, self.quantity);
    }
}
