//! Drag solved over the step, in time: orders where the step resolves the stopping time, what is left of them where
//! it does not, and the terminal slip at any step.

use crate::rungs::every_rung;
use crate::soil::{along, elastic};
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, Moment, StepSize};
use alluvium::verify::{Expected, Level, Measured, Study};
use alluvium::{Real, Vector, setup};

type Both<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

const SIDE: f64 = 0.6;
const SPACING: f64 = 0.05;
const OTHER: &str = "the other scheme";
const UNAWARE: &str = "fields predicted without drag";

pub fn studies() -> Vec<Study> {
    let mut studies = Vec::new();
    let counts: [&[u32]; 2] = [&[8, 16, 32, 64], &[8, 16, 32]];
    let euler = (DragScheme::BackwardEuler, 1.0);
    studies.extend(every_rung!(dustybox, "implicit drag/order/backward euler", euler; counts[0], counts[1]));
    let second = (DragScheme::SecondOrder, 2.0);
    studies.extend(every_rung!(dustybox, "implicit drag/order/second order", second; counts[0], counts[1]));
    studies.extend(every_rung!(driven, "implicit drag/reduced order"; &[20, 40, 80], &[20, 40, 80]));
    // Sums of some fifty terms, each rounded.
    studies.extend(every_rung!(terminal, "implicit drag/terminal slip"; 1e-6, 1e-5));
    let in_space = |study: &Study| study.name.contains("/3d/");
    studies.into_iter().map(|study| if in_space(&study) { study.level(Level::Full) } else { study }).collect()
}

fn law<T: Real>(k: f64) -> Darcy<T> {
    Darcy::new(Conductivity::new(T::of(k)).expect("a conductivity"))
}

/// Soil, held or not, and water on one lattice; the water moves at `speed` along x.
fn lattice<T: Real, const D: usize>(k: f64, scheme: DragScheme, is_held: bool, speed: f64) -> Both<T, D> {
    let places = setup::fill::<T, D>([0.0; D], [SIDE; D], SPACING);
    let volume = T::of(SPACING.powi(D as i32));
    let mut soil = Phase::new(elastic());
    if is_held {
        soil.add_wall(Wall::dynamic(), &places, volume, |_| T::ZERO).expect("a wall");
    } else {
        soil.add(&places, volume, |_| T::ZERO).expect("particles");
    }
    soil.set_volume_fraction(|_| T::of(0.5));
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(30.0)).expect("water"));
    water.add(&places, volume, |_| T::ZERO).expect("particles");
    water.set_velocity(|_| along(0, speed));
    Mixture::new(WendlandC2::new(T::of(1.5 * SPACING)).expect("a length"), soil, water)
        .with_periodic(periodic([SIDE; D]))
        .with_drag(law(k))
        .with_drag_scheme(scheme)
}

/// How fast drag acts on water and on soil \[1/s\], of explicit drag on the lattice.
fn rates<T: Real, const D: usize>(k: f64) -> [f64; 2] {
    let mut mixture = lattice::<T, D>(k, DragScheme::Explicit, false, 1e-6);
    mixture.evaluate().expect("rates");
    let of = |acceleration: Vector<T, D>| acceleration[0].as_f64() / 1e-6;
    [-of(mixture.water().accelerations()[7]), of(mixture.soil().accelerations()[7])]
}

fn mean<T: Real, const D: usize>(velocities: &[Vector<T, D>], axis: usize) -> f64 {
    velocities.iter().map(|v| v[axis].as_f64()).sum::<f64>() / velocities.len() as f64
}

/// In so many steps: singles in no more than leave an error above their rounding.
fn dustybox<T: Real, const D: usize>(
    name: &str,
    (scheme, order): (DragScheme, f64),
    counts: &'static [u32],
) -> Study {
    Study::new(
        name,
        "over one stopping time, in 8 steps and more, the slip of soil and water on one lattice falls by e with the \
         order of the scheme",
        move |conditions| {
            let scheme = match (conditions.is(OTHER), scheme) {
                (true, DragScheme::BackwardEuler) => DragScheme::SecondOrder,
                (true, _) => DragScheme::BackwardEuler,
                (false, scheme) => scheme,
            };
            let k = 1e-2;
            let end = 1.0 / rates::<T, D>(k).iter().sum::<f64>();
            Measured::errors(counts.iter().map(|&count| {
                let dt = end / f64::from(count);
                let step = StepSize::fixed(T::of(dt)).expect("a step");
                let mut run = Simulation::new(lattice::<T, D>(k, scheme, false, 1e-6), LeapFrog::new(), step);
                for _ in 0..count {
                    run.step().expect("a step");
                }
                let mixture = run.mixture();
                let slip = mean(mixture.water().velocities(), 0) - mean(mixture.soil().velocities(), 0);
                (dt, (slip / 1e-6 - (-1.0_f64).exp()).abs())
            }))
        },
    )
    .equations(&["37", "71"])
    .source("DUSTYBOX (Laibe & Price 2011): exact exponential")
    .expect(Expected::Order { at_least: order - 0.15, at_most: order + 0.15 })
    .mutant(OTHER)
}

/// Water in held soil, t_s = 1 µs, shaken along x.
fn driven<T: Real, const D: usize>(name: &str, counts: &'static [u32; 3]) -> Study {
    Study::new(
        name,
        "where steps are a thousand times the stopping time, the second-order scheme follows a shaking force at \
         first order only: the slip is that of the force at the beginning of the kick",
        move |conditions| {
            let t_s = 1e-6;
            let k = 1e-2 * rates::<T, D>(1e-2)[0] * t_s;
            let omega = 2.0 * core::f64::consts::PI / 0.1;
            Measured::errors(counts.map(|count| {
                let dt = 0.02 / f64::from(count);
                let shaken = lattice::<T, D>(k, DragScheme::SecondOrder, true, 0.0)
                    .with_force(move |_, t| along(0, (omega * t).sin()));
                let step = StepSize::fixed(T::of(dt)).expect("a step");
                let mut run = Simulation::new(shaken, LeapFrog::new(), step);
                for _ in 0..count {
                    run.step().expect("a step");
                }
                let lag = if conditions.is("compared with the force half a step before") { 0.5 * dt } else { 0.0 };
                let force = (omega * (run.time() - lag)).sin();
                let slip = mean(run.mixture().water().velocities(), 0);
                (dt, (slip / (t_s * force) - 1.0).abs())
            }))
        },
    )
    .equations(&["37", "71"])
    .source("order reduction of stiff problems (Prothero & Robinson 1974)")
    .expect(Expected::Order { at_least: 0.8, at_most: 1.2 })
    .mutant("compared with the force half a step before")
}

/// Leap-frog whose prediction of the fields leaves drag out.
#[derive(Clone, Debug)]
struct Unaware(bool);

impl<T: Real> Integrator<T> for Unaware {
    fn name(&self) -> &'static str {
        "unaware"
    }
    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error> {
        let half = T::of(0.5) * dt;
        system.evaluate()?;
        if !self.0 {
            system.complete(Moment::Now, dt)?;
            system.advance(Moment::Half, Moment::Now, -half);
        }
        system.complete(Moment::Half, dt)?;
        system.advance(Moment::Half, Moment::Half, dt);
        system.evaluate()?;
        system.drift(Moment::Half, dt);
        system.advance(Moment::Now, Moment::Half, half);
        self.0 = true;
        Ok(())
    }
}

fn terminal<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(
        name,
        "water falls through held soil at the slip k/φ_f, whatever the step over the stopping time (value: \
         relative difference; z = Δt/t_s)",
        move |conditions| {
            let is_unaware = conditions.is(UNAWARE);
            Measured::values([1e1, 1e2, 1e4, 1e6, 1e8].map(|z| {
                let dt = 5e-4;
                let k = 1e-2 * rates::<T, D>(1e-2)[0] * dt / z;
                let falling =
                    lattice::<T, D>(k, DragScheme::BackwardEuler, true, 0.0).with_gravity(along(1, -9.81));
                let step = StepSize::fixed(T::of(dt)).expect("a step");
                (format!("z = {z:e}"), slip(falling, step, is_unaware) / (9.81 * dt / z) - 1.0)
            }))
        },
    )
    .equations(&["37", "71"])
    .source("balance of weight and drag with the lattice's kernel sum")
    .expect(Expected::Bound { largest })
    .mutant(UNAWARE)
}

fn slip<T: Real, const D: usize>(falling: Both<T, D>, step: StepSize<T>, is_unaware: bool) -> f64 {
    fn run<T: Real, const D: usize>(
        falling: Both<T, D>,
        integrator: impl Integrator<T>,
        step: StepSize<T>,
    ) -> f64 {
        let mut run = Simulation::new(falling, integrator, step);
        for _ in 0..30 {
            run.step().expect("a step");
        }
        -mean(run.mixture().water().velocities(), 1)
    }
    if is_unaware { run(falling, Unaware(false), step) } else { run(falling, LeapFrog::new(), step) }
}
