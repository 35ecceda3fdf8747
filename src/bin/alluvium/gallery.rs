//! Pictures of any run at a few instants: soil by its plastic strain; water by pressure in two dimensions, by
//! speed in three, where all is seen from the front and above, and a bed in water cut open in the middle.

use crate::plots::{Panel, ParticlePicture};
use crate::solver::{Seen, Solver, View};
use alluvium::case::Case;

/// Parts of the run after which there is a picture.
const PARTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// More particles than this make a picture too large to open.
const MOST: usize = 150_000;
/// How far one metre along z, towards the viewer, is moved to the left and down.
const OBLIQUE: [f64; 2] = [0.4, 0.3];

/// Keeps what a few pictures need.
pub struct Gallery<'a> {
    case: &'a Case,
    views: Vec<(f64, View)>,
}

impl<'a> Gallery<'a> {
    /// Empty.
    pub fn new(case: &'a Case) -> Self {
        Self { case, views: Vec::new() }
    }

    /// Looks on at a dump: keeps the first after each part of the run.
    pub fn look(&mut self, time: f64, solver: &mut dyn Solver) {
        let due = PARTS.get(self.views.len()).map(|part| part * self.case.end_time * (1.0 - 1e-9));
        if due.is_some_and(|due| time >= due) && solver.particles().0 <= MOST {
            self.views.push((time, solver.view()));
        }
    }

    /// The picture, if there is anything to draw.
    pub fn svg(&self) -> Option<String> {
        let flat = self.case.dimension == 2;
        let (of, quantity, least) = self.shown();
        let mut values: Vec<f64> =
            self.views.iter().flat_map(|(_, view)| self.particles(view).iter().map(of)).collect();
        values.sort_unstable_by(f64::total_cmp);
        // A few extremes must not take all the colours.
        let top = values.get(values.len().checked_sub(1)? * 99 / 100)?;
        let picture = ParticlePicture {
            quantity,
            range: (0.0, top.max(least)),
            window: self.window(),
            spacing: self.case.particles.spacing,
            axes: ["x [m]", "y [m]"],
            columns: 2,
        };
        let panel = |(time, view): &(f64, View)| Panel {
            caption: format!("t = {time:.3} s"),
            layers: if flat { vec![layer(self.particles(view).iter(), of)] } else { self.layers(view, of) },
            walls: if flat { view.walls.iter().map(|x| [x[0], x[1]]).collect() } else { Vec::new() },
            lines: self.edges(),
        };
        Some(picture.svg(&self.views.iter().map(panel).collect::<Vec<_>>()))
    }

    /// The soil, or the water where there is no soil.
    fn particles<'v>(&self, view: &'v View) -> &'v [Seen] {
        if self.case.soil.is_some() { &view.soil } else { &view.water }
    }

    /// What particles are coloured by, and the least a colour bar ends at.
    fn shown(&self) -> (fn(&Seen) -> f64, &'static str, f64) {
        match (self.case.soil.is_some(), self.case.dimension) {
            (true, _) => (|seen| seen.equivalent_plastic_strain, "equivalent plastic strain [-]", 1e-3),
            (_, 2) => (|seen| seen.pressure * 1e-3, "pressure [kPa]", 1e-9),
            _ => (|seen| seen.speed, "speed [m/s]", 1e-9),
        }
    }

    /// The edges of a tank of three dimensions.
    fn edges(&self) -> Vec<([f64; 2], [f64; 2])> {
        let Some(tank) = self.case.tank.as_ref().filter(|_| self.case.dimension == 3) else {
            return Vec::new();
        };
        // Bit k of a corner's number says whether it is high along axis k.
        let corner = |n: usize| {
            projected(core::array::from_fn(|k| if n >> k & 1 == 1 { tank.high[k] } else { tank.low[k] }))
        };
        let from = |n: usize| (0..3).filter(move |k| n >> k & 1 == 0).map(move |k| (n, n | 1 << k));
        (0..8).flat_map(from).map(|(a, b)| (corner(a), corner(b))).collect()
    }

    /// Slices of one spacing across z, the farthest first.
    fn layers(&self, view: &View, of: impl Fn(&Seen) -> f64 + Copy) -> Vec<Vec<([f64; 2], f64)>> {
        let slice = |seen: &&Seen| (seen.place[2] / self.case.particles.spacing).floor() as i64;
        let inside = |seen: &&Seen| seen.place[2] < self.cut();
        let mut far_to_near: Vec<&Seen> = self.particles(view).iter().filter(inside).collect();
        far_to_near.sort_by_key(slice);
        far_to_near
            .chunk_by(|a, b| slice(a) == slice(b))
            .map(|slice| layer(slice.iter().copied(), of))
            .collect()
    }

    /// Where along z what is nearer is left out: of soil with water, whose holes are inside, the middle of the tank.
    fn cut(&self) -> f64 {
        match &self.case.tank {
            Some(tank) if self.case.soil.is_some() && self.case.water.is_some() => {
                0.5 * (tank.low[2] + tank.high[2])
            }
            _ => f64::INFINITY,
        }
    }

    /// What is shown: the tank, or what there is at the start with room around them.
    fn window(&self) -> ([f64; 2], [f64; 2]) {
        let case = self.case;
        let boxes = case.boxes();
        let (low, high): (Vec<f64>, Vec<f64>) = (0..case.dimension)
            .map(|k| match &case.tank {
                Some(tank) => (tank.low[k], tank.high[k]),
                None => {
                    let low = boxes.iter().map(|(low, _)| low[k]).fold(f64::INFINITY, f64::min);
                    let high = boxes.iter().map(|(_, high)| high[k]).fold(f64::NEG_INFINITY, f64::max);
                    (low - 0.5 * (high - low), high + 0.5 * (high - low))
                }
            })
            .unzip();
        let room = 5.0 * case.particles.spacing;
        let depth = |z: &[f64], k: usize| z.get(2).map_or(0.0, |z| OBLIQUE[k] * z);
        (
            core::array::from_fn(|k| low[k] - depth(&high, k) - room),
            core::array::from_fn(|k| high[k] - depth(&low, k) + room),
        )
    }
}

fn layer<'s>(seen: impl Iterator<Item = &'s Seen>, of: impl Fn(&Seen) -> f64) -> Vec<([f64; 2], f64)> {
    seen.map(|seen| (projected(seen.place), of(seen))).collect()
}

/// Where a place appears; in two dimensions z is 0.
fn projected(place: [f64; 3]) -> [f64; 2] {
    core::array::from_fn(|k| place[k] - OBLIQUE[k] * place[2])
}
