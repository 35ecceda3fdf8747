//! A kernel of one's own: Lucy's quartic of 1977, `W = α (1 + 3s)(1 − s)³`, `s = r/2h < 1`.

use crate::tank::Dam;
use alluvium::kernel::Kernel;
use alluvium::material::Water;
use alluvium::mixture::{Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::{InstructionSet, Num, Real};
use core::f64::consts::PI;
use core::ops::ControlFlow;

#[derive(Clone, Copy, Debug)]
pub struct Lucy<T> {
    h: T,
    /// α [m⁻ᴰ].
    pub height: T,
}

impl<T: Real> Lucy<T> {
    pub fn new(h: f64, dimension: usize) -> Self {
        let support = 2.0 * h;
        let height = match dimension {
            2 => 5.0 / (PI * support.powi(2)),
            _ => 105.0 / (16.0 * PI * support.powi(3)),
        };
        Self { h: T::of(h), height: T::of(height) }
    }
}

impl<T: Real, const D: usize> Kernel<T, D> for Lucy<T> {
    fn smoothing_length(&self) -> T {
        self.h
    }
    fn support(&self) -> T {
        self.h + self.h
    }
    #[inline(always)]
    fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
        let s = r2.sqrt() / (N::splat(self.h) + N::splat(self.h));
        let t = (N::lit(1.0) - s).max(N::lit(0.0));
        N::splat(self.height) * (N::lit(1.0) + N::lit(3.0) * s) * (t * t * t)
    }
    #[inline(always)]
    fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
        let support = N::splat(self.h) + N::splat(self.h);
        let t = (N::lit(1.0) - r2.sqrt() / support).max(N::lit(0.0));
        N::lit(-12.0) * N::splat(self.height) / (support * support) * (t * t)
    }
}

/// Positions of the water after 0.05 s of a dam break with this kernel in these lanes.
fn positions(set: InstructionSet) -> Vec<[f64; 2]> {
    let dam = Dam { spacing: 0.01, ..Dam::SMALL };
    let water = Water::new(1000.0, 25.0).unwrap();
    let wall = Wall::extrapolated(Slip::FreeSlip);
    let mixture = dam.of::<f64, 2, _, _>(Lucy::new(0.013, 2), water, wall).with_instruction_set(set);
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).unwrap());
    let _ = run.run_until(0.05, |_| ControlFlow::Continue(())).unwrap();
    let water = run.mixture().water();
    water.positions()[water.wall_particles()..].iter().map(|x| x.as_f64()).collect()
}

#[test]
fn a_tank_runs_with_it_and_in_lanes_too() {
    let wide = positions(InstructionSet::detect());
    assert_eq!(wide, positions(InstructionSet::at_most("scalar").unwrap()));
    let front = wide.iter().map(|x| x[0]).fold(0.0, f64::max);
    // It falls by about g t²/2 = 12 mm, the front runs out of the 0.1 m column a little.
    assert!((0.098..0.125).contains(&front), "front at {front} m");
}
