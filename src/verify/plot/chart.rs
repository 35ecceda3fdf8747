//! Curves and points over one axis: fronts, budgets, histories.

use super::canvas::{Anchor, Canvas, Stroke};
use super::colour::SERIES;
use super::scale::Scale;

pub(super) const MARGIN: Margin = Margin { left: 84.0, right: 22.0, top: 46.0, bottom: 58.0 };

/// Width and height of a chart; a legend beside it makes it wider.
pub(super) const SIZE: (f64, f64) = (760.0, 480.0);

pub(super) struct Margin {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

/// How a series is drawn.
#[derive(Clone, Debug)]
pub(super) enum Style {
    Line(&'static str),
    Points(Marker),
    /// Filled down to these values.
    Band(Vec<f64>),
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Marker {
    Circle,
    Square,
    Diamond,
    Triangle,
}

/// One curve, set of points or band.
#[derive(Clone, Debug)]
pub struct Series {
    pub(super) name: String,
    pub(super) points: Vec<(f64, f64)>,
    pub(super) style: Style,
    pub(super) colour: Option<&'static str>,
}

impl Series {
    /// A full line.
    pub fn line(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.to_owned(), points, style: Style::Line(""), colour: None }
    }

    /// A dashed line.
    pub fn dashed(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { style: Style::Line("7 4"), ..Self::line(name, points) }
    }

    /// Points; each set of a chart gets its own mark.
    pub fn points(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { style: Style::Points(Marker::Circle), ..Self::line(name, points) }
    }

    /// Bands stacked on each other, from zero upwards: one per part of a whole.
    pub fn stack(x: &[f64], parts: &[(&str, Vec<f64>)]) -> Vec<Self> {
        let mut base = vec![0.0; x.len()];
        let mut bands = Vec::new();
        for (name, part) in parts {
            let top: Vec<f64> = base.iter().zip(part).map(|(b, p)| b + p).collect();
            let points = x.iter().copied().zip(top.iter().copied()).collect();
            let lower = core::mem::replace(&mut base, top);
            bands.push(Self { style: Style::Band(lower), ..Self::line(name, points) });
        }
        bands
    }

    /// In this colour instead of the next one.
    pub fn coloured(self, colour: &'static str) -> Self {
        Self { colour: Some(colour), ..self }
    }
}

/// A chart: title, axes with units, series, legend.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    title: String,
    x_label: String,
    y_label: String,
    x_range: Option<(f64, f64)>,
    y_range: Option<(f64, f64)>,
    logarithmic: (bool, bool),
    pub(super) series: Vec<Series>,
}

impl Chart {
    /// An empty chart; labels name quantity and unit, as in `time [s]`.
    pub fn new(title: &str, x_label: &str, y_label: &str) -> Self {
        let [title, x_label, y_label] = [title, x_label, y_label].map(str::to_owned);
        Self { title, x_label, y_label, ..Self::default() }
    }

    /// Fixes the horizontal range.
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x_range = Some((low, high));
        self
    }

    /// Fixes the vertical range.
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y_range = Some((low, high));
        self
    }

    /// Logarithmic axes, horizontal and vertical.
    pub fn logarithmic(mut self, x: bool, y: bool) -> Self {
        self.logarithmic = (x, y);
        self
    }

    /// Adds a series, in the next free colour (and mark) unless it has its own.
    pub fn with(mut self, mut series: Series) -> Self {
        series.colour = series.colour.or(Some(SERIES[self.series.len() % SERIES.len()]));
        if let Style::Points(marker) = &mut series.style {
            let before = self.series.iter().filter(|s| matches!(s.style, Style::Points(_))).count();
            *marker = [Marker::Circle, Marker::Square, Marker::Diamond, Marker::Triangle][before % 4];
        }
        self.series.push(series);
        self
    }

    /// Adds several.
    pub fn with_all(self, series: Vec<Series>) -> Self {
        series.into_iter().fold(self, Self::with)
    }

    /// The picture.
    pub fn svg(&self) -> String {
        let (x, y, (places_x, places_y)) = self.scales();
        let mut canvas = Canvas::new(self.width(), SIZE.1);
        self.axes(&mut canvas, x, y, (places_x, places_y));
        let size = (places_x.1 - places_x.0, places_y.0 - places_y.1);
        let (left, top) = (places_x.0, places_y.1);
        canvas.raw(&format!(
            "<clipPath id=\"frame\"><rect x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\"/></clipPath>",
            size.0, size.1
        ));
        canvas.raw("<g clip-path=\"url(#frame)\">");
        for series in &self.series {
            draw(&mut canvas, series, x, y);
        }
        canvas.raw("</g>");
        canvas.rectangle((left, top), size, "none", "#222");
        self.legend(&mut canvas);
        canvas.finish()
    }

    /// Both axes, and between which places they run: left and right, bottom and top.
    pub(super) fn scales(&self) -> (Scale, Scale, Frame) {
        let places_x = (MARGIN.left, SIZE.0 - MARGIN.right);
        let places_y = (SIZE.1 - MARGIN.bottom, MARGIN.top);
        let x = scale(self.range(|p| p.0, self.x_range, self.logarithmic.0), places_x, self.logarithmic.0);
        let y = scale(self.range(|p| p.1, self.y_range, self.logarithmic.1), places_y, self.logarithmic.1);
        (x, y, (places_x, places_y))
    }

    /// The range of the data, with a little room; zero is kept if it is near.
    fn range(&self, of: impl Fn(&(f64, f64)) -> f64, fixed: Option<(f64, f64)>, log: bool) -> (f64, f64) {
        if let Some(range) = fixed {
            return range;
        }
        let values = self.series.iter().flat_map(|s| s.points.iter().map(&of));
        let usable = values.filter(|v| v.is_finite() && (!log || *v > 0.0));
        let (low, high) = usable.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
        if low > high {
            return (0.1, 1.0);
        }
        if log {
            return (low / 1.3, high * 1.3);
        }
        // What varies by rounding alone is drawn as the constant it is.
        let room = 0.05 * (high - low).max(1e-3 * high.abs()).max(1e-300);
        let near_zero = low >= 0.0 && low < 0.3 * high;
        (if near_zero { 0.0 } else { low - room }, high + room)
    }

    fn axes(&self, canvas: &mut Canvas, x: Scale, y: Scale, places: ((f64, f64), (f64, f64))) {
        let ((left, right), (bottom, top)) = places;
        let grid = Stroke { colour: "#e4e4e4", width: 1.0, dash: "" };
        for (value, label) in x.ticks(7) {
            let at = x.place(value);
            canvas.line((at, bottom), (at, top), grid);
            canvas.text((at, bottom + 19.0), 13.0, Anchor::Middle, &label);
        }
        for (value, label) in y.ticks(6) {
            let at = y.place(value);
            canvas.line((left, at), (right, at), grid);
            canvas.text((left - 8.0, at + 4.5), 13.0, Anchor::End, &label);
        }
        canvas.heading((left, top - 16.0), 16.0, &self.title);
        canvas.text((0.5 * (left + right), bottom + 44.0), 14.0, Anchor::Middle, &self.x_label);
        canvas.upward_text((18.0, 0.5 * (bottom + top)), 14.0, &self.y_label);
    }
}

/// Where axes run: left and right, bottom and top.
pub(super) type Frame = ((f64, f64), (f64, f64));

/// Charts in a row, as one picture.
pub fn beside(charts: &[Chart]) -> String {
    let mut canvas = Canvas::new(charts.iter().map(Chart::width).sum(), SIZE.1);
    let mut left = 0.0;
    for chart in charts {
        canvas.raw(&format!("<g transform=\"translate({left} 0)\">"));
        left += chart.width();
        canvas.raw(&chart.svg());
        canvas.raw("</g>");
    }
    canvas.finish()
}

fn scale(range: (f64, f64), places: (f64, f64), log: bool) -> Scale {
    if log { Scale::logarithmic(range, places) } else { Scale::linear(range, places) }
}

fn draw(canvas: &mut Canvas, series: &Series, x: Scale, y: Scale) {
    let colour = series.colour.unwrap_or(SERIES[0]);
    let at = |p: &(f64, f64)| (x.place(p.0), y.place(p.1));
    let places: Vec<_> =
        series.points.iter().filter(|p| p.0.is_finite() && p.1.is_finite()).map(at).collect();
    match &series.style {
        Style::Line(dash) => canvas.polyline(&places, Stroke { colour, width: 2.0, dash }),
        Style::Points(marker) => places.iter().for_each(|at| mark(canvas, *marker, *at, colour)),
        Style::Band(lower) => {
            let back = series.points.iter().zip(lower).map(|(p, base)| at(&(p.0, *base)));
            let outline: Vec<_> = places.iter().copied().chain(back.rev()).collect();
            canvas.polygon(&outline, colour);
        }
    }
}

pub(super) fn mark(canvas: &mut Canvas, marker: Marker, (x, y): (f64, f64), colour: &str) {
    let r = 4.5;
    let shape = match marker {
        Marker::Circle => format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{r}\""),
        Marker::Square => {
            format!("<rect x=\"{:.2}\" y=\"{:.2}\" width=\"8\" height=\"8\"", x - 4.0, y - 4.0)
        }
        Marker::Diamond => format!("<path d=\"M{x:.2} {:.2}l5.5 5.5l-5.5 5.5l-5.5 -5.5Z\"", y - 5.5),
        Marker::Triangle => format!("<path d=\"M{x:.2} {:.2}l5 8.5h-10Z\"", y - 5.0),
    };
    canvas.raw(&format!("{shape} fill=\"white\" stroke=\"{colour}\" stroke-width=\"1.8\"/>"));
}
