//! A search of one's own: points sorted along one axis, a window of them proposed.

use crate::fingerprint::hash;
use crate::tank::Dam;
use alluvium::mixture::{Mixture, Slip, Wall};
use alluvium::neighbours::NeighbourSearch;
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::{Real, Vector};
use core::ops::{ControlFlow, Range};

#[derive(Clone, Debug, Default)]
pub struct Sweep {
    /// Coordinate on the first axis \[m\] and index, ascending.
    sorted: Vec<(f64, u32)>,
    radius: f64,
    /// A deliberate mistake: how much of the radius is looked at.
    reach: f64,
}

impl Sweep {
    pub fn new() -> Self {
        Self::reaching(1.0 + 1e-6)
    }

    pub fn reaching(reach: f64) -> Self {
        Self { reach, ..Self::default() }
    }
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for Sweep {
    fn name(&self) -> &'static str {
        "sweep"
    }
    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        self.sorted = points.iter().map(|x| x[0].as_f64()).zip(0..).collect();
        self.sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.radius = radius.as_f64() * self.reach;
    }
    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        let x = place[0].as_f64();
        let first = self.sorted.partition_point(|point| point.0 < x - self.radius);
        let near = self.sorted[first..].iter().take_while(|point| point.0 <= x + self.radius);
        ranges.extend(near.map(|point| point.1..point.1 + 1));
    }
}

fn state<T: Real, const D: usize>(mixture: Mixture<T, D>) -> u64 {
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).unwrap());
    let _ = run.run_until(0.04, |_| ControlFlow::Continue(())).unwrap();
    hash(run.mixture())
}

fn tank<T: Real, const D: usize>() -> Mixture<T, D> {
    let dam = Dam { water: [0.1, 0.1, 0.05], tank: [0.2, 0.15, 0.05], spacing: 0.01 };
    dam.mixture(Wall::extrapolated(Slip::NoSlip))
}

#[test]
fn it_gives_the_bits_of_the_cell_list() {
    assert_eq!(state(tank::<f64, 2>().with_search(|| Box::new(Sweep::new()))), state(tank::<f64, 2>()));
    assert_eq!(state(tank::<f32, 3>().with_search(|| Box::new(Sweep::new()))), state(tank::<f32, 3>()));
}

#[test]
fn one_that_looks_too_near_does_not() {
    let short = || -> Box<dyn NeighbourSearch<f64, 2>> { Box::new(Sweep::reaching(0.7)) };
    assert_ne!(state(tank::<f64, 2>().with_search(short)), state(tank::<f64, 2>()));
}
