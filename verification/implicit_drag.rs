//! Drag solved over the step, in time: orders where the step resolves the stopping time, what is left of them where
//! it does not, and the terminal slip at any step.

use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase, Wall};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, Moment, StepSize};
use alluvium::verify::{Expected, Measured, Study};
use alluvium::{Vector, setup};

type Both = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>;

const SIDE: f64 = 0.6;
const SPACING: f64 = 0.05;
const OTHER: &str = "the other scheme";
const UNAWARE: &str = "fields predicted without drag";

pub fn studies() -> Vec<Study> {
    vec![
        dustybox("implicit drag/order/backward euler", DragScheme::BackwardEuler, 1.0),
        dustybox("implicit drag/order/second order", DragScheme::SecondOrder, 2.0),
        driven("implicit drag/reduced order"),
        terminal("implicit drag/terminal slip"),
    ]
}

fn law(k: f64) -> Darcy<f64> {
    Darcy::new(Conductivity::new(k).expect("a conductivity"))
}

/// Soil, held or not, and water on one lattice; the water moves at `speed` along x.
fn lattice(k: f64, scheme: DragScheme, is_held: bool, speed: f64) -> Both {
    let places = setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING);
    let volume = SPACING * SPACING;
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).expect("moduli");
    let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).expect("soil"));
    if is_held {
        soil.add_wall(Wall::dynamic(), &places, volume, |_| 0.0).expect("a wall");
    } else {
        soil.add(&places, volume, |_| 0.0).expect("particles");
    }
    soil.set_volume_fraction(|_| 0.5);
    let mut water = Phase::new(Water::new(1000.0, 30.0).expect("water"));
    water.add(&places, volume, |_| 0.0).expect("particles");
    water.set_velocity(|_| Vector([speed, 0.0]));
    Mixture::new(WendlandC2::new(1.5 * SPACING).expect("a length"), soil, water)
        .with_periodic(Periodic::new(Vector::zero(), [Some(SIDE); 2]).expect("a period"))
        .with_drag(law(k))
        .with_drag_scheme(scheme)
}

/// How fast drag acts on water and on soil \[1/s\], of explicit drag on the lattice.
fn rates(k: f64) -> [f64; 2] {
    let mut mixture = lattice(k, DragScheme::Explicit, false, 1e-6);
    mixture.evaluate().expect("rates");
    [-mixture.water().accelerations()[7][0] / 1e-6, mixture.soil().accelerations()[7][0] / 1e-6]
}

fn mean(velocities: &[Vector<f64, 2>], axis: usize) -> f64 {
    velocities.iter().map(|v| v[axis]).sum::<f64>() / velocities.len() as f64
}

fn dustybox(name: &str, scheme: DragScheme, order: f64) -> Study {
    Study::new(
        name,
        "over one stopping time, in 8 to 64 steps, the slip of soil and water on one lattice falls by e with the \
         order of the scheme",
        move |conditions| {
            let scheme = match (conditions.is(OTHER), scheme) {
                (true, DragScheme::BackwardEuler) => DragScheme::SecondOrder,
                (true, _) => DragScheme::BackwardEuler,
                (false, scheme) => scheme,
            };
            let k = 1e-2;
            let end = 1.0 / rates(k).iter().sum::<f64>();
            Measured::errors([8, 16, 32, 64].map(|count| {
                let dt = end / f64::from(count);
                let step = StepSize::fixed(dt).expect("a step");
                let mut run = Simulation::new(lattice(k, scheme, false, 1e-6), LeapFrog::new(), step);
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
fn driven(name: &str) -> Study {
    Study::new(
        name,
        "where steps are a thousand times the stopping time, the second-order scheme follows a shaking force at \
         first order only: the slip is that of the force at the beginning of the kick",
        move |conditions| {
            let t_s = 1e-6;
            let k = 1e-2 * rates(1e-2)[0] * t_s;
            let omega = 2.0 * core::f64::consts::PI / 0.1;
            Measured::errors([20, 40, 80].map(|count| {
                let dt = 0.02 / f64::from(count);
                let shaken = lattice(k, DragScheme::SecondOrder, true, 0.0)
                    .with_force(move |_, t| Vector([(omega * t).sin(), 0.0]));
                let step = StepSize::fixed(dt).expect("a step");
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

impl Integrator<f64> for Unaware {
    fn name(&self) -> &'static str {
        "unaware"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        if !self.0 {
            system.complete(Moment::Now, dt)?;
            system.advance(Moment::Half, Moment::Now, -0.5 * dt);
        }
        system.complete(Moment::Half, dt)?;
        system.advance(Moment::Half, Moment::Half, dt);
        system.evaluate()?;
        system.drift(Moment::Half, dt);
        system.advance(Moment::Now, Moment::Half, 0.5 * dt);
        self.0 = true;
        Ok(())
    }
}

fn terminal(name: &str) -> Study {
    Study::new(
        name,
        "water falls through held soil at the slip k/φ_f, whatever the step over the stopping time (value: \
         relative difference; z = Δt/t_s)",
        |conditions| {
            let is_unaware = conditions.is(UNAWARE);
            Measured::values([1e1, 1e2, 1e4, 1e6, 1e8].map(|z| {
                let dt = 5e-4;
                let k = 1e-2 * rates(1e-2)[0] * dt / z;
                let falling =
                    lattice(k, DragScheme::BackwardEuler, true, 0.0).with_gravity(Vector([0.0, -9.81]));
                let step = StepSize::fixed(dt).expect("a step");
                (format!("z = {z:e}"), slip(falling, step, is_unaware) / (9.81 * dt / z) - 1.0)
            }))
        },
    )
    .equations(&["37", "71"])
    .source("balance of weight and drag with the lattice's kernel sum")
    .expect(Expected::Bound { largest: 1e-6 })
    .mutant(UNAWARE)
}

fn slip(falling: Both, step: StepSize<f64>, is_unaware: bool) -> f64 {
    fn run<I: Integrator<f64>>(falling: Both, integrator: I, step: StepSize<f64>) -> f64 {
        let mut run = Simulation::new(falling, integrator, step);
        for _ in 0..30 {
            run.step().expect("a step");
        }
        -mean(run.mixture().water().velocities(), 1)
    }
    if is_unaware { run(falling, Unaware(false), step) } else { run(falling, LeapFrog::new(), step) }
}
