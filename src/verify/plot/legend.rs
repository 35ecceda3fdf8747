//! The legend of a chart: where it hides nothing.

use super::canvas::{Anchor, Canvas, Stroke};
use super::chart::{Chart, MARGIN, SIZE, Series, Style, mark};
use super::colour::SERIES;
use super::scale::Scale;

impl Chart {
    /// How wide the picture is, the legend included.
    pub(super) fn width(&self) -> f64 {
        let size = self.legend_size();
        if self.corner(size).is_some() { SIZE.0 } else { SIZE.0 + size.0 + MARGIN.right }
    }

    /// Series with a name. A stack grows upwards, and so do its names.
    fn named(&self) -> Vec<&Series> {
        let mut named: Vec<&Series> = self.series.iter().filter(|s| !s.name.is_empty()).collect();
        if self.is_stack() {
            named.reverse();
        }
        named
    }

    fn is_stack(&self) -> bool {
        let is_band = |s: &Series| matches!(s.style, Style::Band(_));
        self.series.iter().any(is_band) && self.series.iter().all(|s| s.name.is_empty() || is_band(s))
    }

    fn legend_size(&self) -> (f64, f64) {
        let named = self.named();
        let longest = named.iter().map(|s| s.name.chars().count()).max().unwrap_or(0);
        (54.0 + 7.2 * longest as f64, 10.0 + 20.0 * named.len() as f64)
    }

    pub(super) fn legend(&self, canvas: &mut Canvas) {
        let (named, size) = (self.named(), self.legend_size());
        if named.is_empty() {
            return;
        }
        let at = self.corner(size).unwrap_or((SIZE.0 - 6.0, MARGIN.top));
        canvas.rectangle(at, size, "#ffffffd8", "#c8c8c8");
        for (n, series) in named.iter().enumerate() {
            let line = at.1 + 15.0 + 20.0 * n as f64;
            key(canvas, series, (at.0 + 8.0, line));
            canvas.text((at.0 + 42.0, line + 4.5), 13.0, Anchor::Start, &series.name);
        }
    }

    /// A corner of the frame where a legend of this size hides nothing; none in a stack, which fills the
    /// frame, or if every corner is in use: then it stands beside the frame.
    fn corner(&self, size: (f64, f64)) -> Option<(f64, f64)> {
        let (x, y, ((left, right), (bottom, top))) = self.scales();
        let corners = [
            (left + 10.0, top + 10.0),
            (right - size.0 - 10.0, top + 10.0),
            (left + 10.0, bottom - size.1 - 10.0),
            (right - size.0 - 10.0, bottom - size.1 - 10.0),
        ];
        let hides = |at: &(f64, f64)| {
            let (low, high) = ((at.0, at.1), (at.0 + size.0, at.1 + size.1));
            self.series.iter().any(|s| s.touches(x, y, low, high))
        };
        if self.is_stack() { None } else { corners.into_iter().find(|at| !hides(at)) }
    }
}

impl Series {
    /// Whether anything of it is drawn in a box of the picture.
    fn touches(&self, x: Scale, y: Scale, low: (f64, f64), high: (f64, f64)) -> bool {
        let place = |p: &(f64, f64)| (x.place(p.0), y.place(p.1));
        let inside = |p: (f64, f64)| p.0 > low.0 && p.0 < high.0 && p.1 > low.1 && p.1 < high.1;
        let places: Vec<_> = self.points.iter().map(place).collect();
        let crosses = |pair: &[(f64, f64)]| {
            let ((a, b), (c, d)) = (pair[0], pair[1]);
            (0..=20).map(|n| f64::from(n) / 20.0).any(|s| inside((a + s * (c - a), b + s * (d - b))))
        };
        match self.style {
            Style::Points(_) => places.into_iter().any(inside),
            Style::Line(_) | Style::Band(_) => places.windows(2).any(crosses),
        }
    }
}

fn key(canvas: &mut Canvas, series: &Series, (x, y): (f64, f64)) {
    let colour = series.colour.unwrap_or(SERIES[0]);
    match &series.style {
        Style::Line(dash) => canvas.line((x, y), (x + 26.0, y), Stroke { colour, width: 2.0, dash }),
        Style::Points(marker) => mark(canvas, *marker, (x + 13.0, y), colour),
        Style::Band(_) => canvas.rectangle((x + 3.0, y - 6.0), (20.0, 12.0), colour, ""),
    }
}
