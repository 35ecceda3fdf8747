//! Drag solved over the step: stable and right at any conductivity, at the step sound allows; momentum, kinetic
//! energy and books; against a dense solution; the same bits however it is computed and across a restart.

mod dense;
mod direct;
mod fastest;
mod normalised;
mod projected;
mod reconstructed;
mod slip;

use alluvium::budget::Account;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Conductivity, Darcy, DragLaw, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase, Wall};
use alluvium::neighbours::Periodic;
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, Limit, Moment, StepSize, VelocityVerlet};
use alluvium::{Real, Vector, setup};

type Both<T> = Mixture<T, 2, WendlandC2<T, 2>, Soil<T, Unyielding>, Water<T>>;
type Run<T, I> = Simulation<T, 2, WendlandC2<T, 2>, Soil<T, Unyielding>, Water<T>, I>;

const SPACING: f64 = 0.05;
const SIDE: f64 = 0.6;
const H: f64 = 1.5 * SPACING;
const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

/// Soil and water on the same lattice of a periodic box, each with its velocity; the soil held below `floor`.
fn box_of<T: Real>(
    conductivity: f64,
    scheme: DragScheme,
    floor: f64,
    soil_velocity: impl Fn(&Vector<T, 2>) -> Vector<T, 2>,
    water_velocity: impl Fn(&Vector<T, 2>) -> Vector<T, 2>,
) -> Both<T> {
    let places = setup::fill::<T, 2>([0.0; 2], [SIDE; 2], SPACING);
    let (low, high): (Vec<_>, Vec<_>) = places.iter().partition(|x| x[1].as_f64() < floor);
    let volume = T::of(SPACING * SPACING);
    let elasticity = Elasticity::from_bulk(T::of(0.7e6), T::of(0.3)).unwrap();
    let mut soil = Phase::new(Soil::new(T::of(2650.0), elasticity, Unyielding).unwrap());
    soil.add_wall(Wall::dynamic(), &low, volume, |_| T::ZERO).unwrap();
    soil.add(&high, volume, |_| T::ZERO).unwrap();
    soil.set_volume_fraction(|_| T::of(0.5));
    soil.set_velocity(soil_velocity);
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(30.0)).unwrap());
    water.add(&places, volume, |_| T::ZERO).unwrap();
    water.set_velocity(water_velocity);
    let periodic = Periodic::new(Vector::zero(), [Some(T::of(SIDE)); 2]).unwrap();
    Mixture::new(WendlandC2::new(T::of(H)).unwrap(), soil, water)
        .with_periodic(periodic)
        .with_drag(darcy(conductivity))
        .with_drag_scheme(scheme)
}

fn darcy<T: Real>(conductivity: f64) -> Darcy<T> {
    Darcy::new(Conductivity::new(T::of(conductivity)).unwrap())
}

/// Soil and water that move as one each, so slowly that their lattices stay where they are.
fn two_streams<T: Real>(conductivity: f64, scheme: DragScheme) -> Both<T> {
    let slow = |x, y| move |_: &Vector<T, 2>| Vector([T::of(x), T::of(y)]);
    box_of(conductivity, scheme, 0.0, slow(1e-6, 0.0), slow(-1e-6, 3e-7))
}

/// Soil at rest in water that moves in a wave.
fn wave<T: Real>(conductivity: f64, scheme: DragScheme, floor: f64) -> Both<T> {
    let shear = |x: &Vector<T, 2>| {
        Vector([T::of(0.3 * (2.0 * core::f64::consts::PI * x[1].as_f64() / SIDE).sin()), T::ZERO])
    };
    box_of(conductivity, scheme, floor, |_| Vector::zero(), shear)
}

/// Slip of the first component, from mean velocities.
fn slip<T: Real>(mixture: &Both<T>) -> f64 {
    let mean = |velocities: &[Vector<T, 2>]| {
        velocities.iter().map(|v| v[0].as_f64()).sum::<f64>() / velocities.len() as f64
    };
    mean(mixture.water().velocities()) - mean(mixture.soil().velocities())
}

/// How fast drag acts on the slip of two lattices that coincide \[1/s\], with the fractions and densities of an
/// evaluated mixture.
fn drag_rate<T: Real>(mixture: &Both<T>, conductivity: f64) -> f64 {
    let (soil, water) = (mixture.soil(), mixture.water());
    let coefficient = darcy::<T>(conductivity)
        .coefficient(water.volume_fraction(0), water.true_density(0), T::ZERO)
        .as_f64();
    let around: f64 = (0..soil.len()).map(|i| weight(mixture, i, 0)).sum();
    let each = |density: T| coefficient * around * (SPACING * SPACING) / density.as_f64();
    each(soil.density(0)) + each(water.density(0))
}

/// From water particle `a` to soil particle `i`, over the nearest image.
fn nearest<T: Real>(mixture: &Both<T>, i: usize, a: usize) -> Vector<f64, 2> {
    let away = mixture.soil().positions()[i] - mixture.water().positions()[a];
    Vector(away.as_f64().map(|x| x - SIDE * (x / SIDE).round()))
}

/// Kernel between soil particle `i` and water particle `a`, over the nearest image.
fn weight<T: Real>(mixture: &Both<T>, i: usize, a: usize) -> f64 {
    let away = nearest(mixture, i, a);
    if away.norm2() < 4.0 * H * H { mixture.kernel().value(T::of(away.norm2())).as_f64() } else { 0.0 }
}

/// What each step leaves of a slip, `of(z)` with z = Δt/t_s, for conductivities from gravel to clay; momentum
/// and kinetic energy on the way.
fn damps<T: Real, I: Integrator<T>>(
    integrator: I,
    scheme: DragScheme,
    of: impl Fn(f64) -> f64,
    rounding: f64,
) {
    for exponent in [-2, -3, -4, -5, -6, -8, -10, -12] {
        let conductivity = 10_f64.powi(exponent);
        let courant = StepSize::courant(T::of(0.2)).unwrap();
        let mut run = Run::new(two_streams::<T>(conductivity, scheme), integrator.clone(), courant);
        let begin = slip(run.mixture());
        run.start().unwrap();
        let rate = drag_rate(run.mixture(), conductivity);
        let start = run.budget();
        let mut before = (begin, start.kinetic);
        for step in 0..8 {
            let done = run.step().unwrap();
            assert_eq!(done.limit, Limit::Acoustic);
            let now = slip(run.mixture());
            let z = rate * done.length;
            // Leap-frog's first step makes the fields half a step before the start, too.
            let is_regular = step > 0 || run.integrator().name() != "leap-frog";
            if is_regular {
                let error = (now - of(z) * before.0).abs();
                // The iteration ends at 1e-10 of the velocities.
                let allowed = 1e4 * rounding * before.0.abs() + (1e-10 + 10.0 * rounding) * begin.abs();
                assert!(
                    error <= allowed,
                    "k = 1e{exponent}, step {step}: {now:e} of {:e}, z {z:e}",
                    before.0
                );
            }
            let kinetic = run.budget().kinetic;
            let grows = kinetic > before.1 * (1.0 + 10.0 * rounding);
            let may_grow = !is_regular && scheme == DragScheme::SecondOrder;
            assert!(!grows || may_grow, "k = 1e{exponent}, step {step}: energy grows");
            let momentum = Vector(run.budget().momentum) - Vector(start.momentum);
            assert!(momentum.norm() <= rounding * start.mass * begin.abs(), "k = 1e{exponent}: {momentum:?}");
            before = (now, kinetic);
        }
    }
}

fn sdirk2(z: f64) -> f64 {
    (1.0 - (1.0 - 2.0 * GAMMA) * z) / (1.0 + GAMMA * z).powi(2)
}

#[test]
fn backward_euler_damps_a_slip_by_one_plus_the_stiffness() {
    let of = |z: f64| 1.0 / (1.0 + z);
    damps::<f64, _>(LeapFrog::new(), DragScheme::BackwardEuler, of, 1e-13);
    damps::<f64, _>(VelocityVerlet::new(), DragScheme::BackwardEuler, |z| of(z / 2.0).powi(2), 1e-13);
    damps::<f32, _>(LeapFrog::new(), DragScheme::BackwardEuler, of, 1e-6);
}

#[test]
fn the_second_order_scheme_damps_as_its_stability_function_has_it() {
    damps::<f64, _>(LeapFrog::new(), DragScheme::SecondOrder, sdirk2, 1e-13);
    damps::<f64, _>(VelocityVerlet::new(), DragScheme::SecondOrder, |z| sdirk2(z / 2.0).powi(2), 1e-13);
    damps::<f32, _>(LeapFrog::new(), DragScheme::SecondOrder, sdirk2, 1e-6);
}

/// Observed order of the slip's decay over one stopping time.
fn order<I: Integrator<f64>>(integrator: I, scheme: DragScheme) -> f64 {
    let conductivity = 1e-2;
    let error = |count: u32| {
        let mut mixture = two_streams::<f64>(conductivity, scheme);
        mixture.evaluate().unwrap();
        let end = 1.0 / drag_rate(&mixture, conductivity);
        let begin = slip(&mixture);
        let step = StepSize::fixed(end / f64::from(count)).unwrap();
        let mut run = Run::new(mixture, integrator.clone(), step);
        for _ in 0..count {
            run.step().unwrap();
        }
        (slip(run.mixture()) / begin - (-1.0_f64).exp()).abs()
    };
    (error(16) / error(64)).log2() / 2.0
}

#[test]
fn the_schemes_have_their_orders() {
    let is =
        |order: f64, expected: f64| assert!((order - expected).abs() < 0.15, "{order} is not {expected}");
    is(order(LeapFrog::new(), DragScheme::BackwardEuler), 1.0);
    is(order(VelocityVerlet::new(), DragScheme::BackwardEuler), 1.0);
    is(order(LeapFrog::new(), DragScheme::SecondOrder), 2.0);
    is(order(VelocityVerlet::new(), DragScheme::SecondOrder), 2.0);
}

#[test]
fn with_the_step_they_approach_explicit_drag() {
    let after = |scheme, count: u32| {
        let step = StepSize::fixed(8e-3 / f64::from(count)).unwrap();
        let mut run = Run::new(wave::<f64>(0.1, scheme, 0.0), LeapFrog::new(), step);
        for _ in 0..count {
            run.step().unwrap();
        }
        let mut velocities: Vec<_> = run
            .mixture()
            .water()
            .ids()
            .iter()
            .copied()
            .zip(run.mixture().water().velocities().to_vec())
            .collect();
        velocities.sort_by_key(|(id, _)| *id);
        velocities
    };
    let apart = |scheme, count| {
        let (here, there) = (after(scheme, count), after(DragScheme::Explicit, count));
        here.iter().zip(&there).map(|(a, b)| (a.1 - b.1).norm2()).sum::<f64>().sqrt()
    };
    for (scheme, least) in [(DragScheme::BackwardEuler, 1.8), (DragScheme::SecondOrder, 3.4)] {
        let (coarse, fine) = (apart(scheme, 32), apart(scheme, 64));
        assert!(coarse / fine > least, "{scheme:?}: {coarse:e}, {fine:e}");
    }
}

/// Water that falls through soil that is held, after some steps: how far its velocity is from the terminal one,
/// and the force on the soil from the water's weight, both relative.
fn seepage(conductivity: f64, scheme: DragScheme, integrator: impl Integrator<f64>) -> [f64; 2] {
    let still = |_: &Vector<f64, 2>| Vector::zero();
    let mixture = box_of(conductivity, scheme, SIDE, still, still).with_gravity(Vector([0.0, -9.81]));
    let mut run = Run::new(mixture, integrator, StepSize::courant(0.2).unwrap());
    for _ in 0..30 {
        assert_eq!(run.step().unwrap().limit, Limit::Acoustic);
    }
    let mixture = run.mixture();
    let (soil, water) = (mixture.soil(), mixture.water());
    let coefficient =
        darcy::<f64>(conductivity).coefficient(water.volume_fraction(0), water.true_density(0), 0.0);
    let around: f64 = (0..soil.len()).map(|i| weight(mixture, i, 0)).sum::<f64>() * SPACING * SPACING;
    let terminal = -9.81 * water.density(0) / (coefficient * around);
    let mean = water.velocities().iter().map(|v| v[1]).sum::<f64>() / water.len() as f64;
    let weight = -9.81 * water.masses().iter().sum::<f64>();
    let budget = run.budget();
    let books = (budget.momentum[1] - budget.impulse[1]).abs() / weight.abs();
    assert!(books < 1e-12, "momentum is not what was given: {books:e}");
    [(mean / terminal - 1.0).abs(), (soil.wall_force(0)[1] / weight - 1.0).abs()]
}

#[test]
fn water_seeps_through_held_soil_at_its_terminal_velocity() {
    for conductivity in [1e-4, 1e-6, 1e-9] {
        for scheme in [DragScheme::BackwardEuler, DragScheme::SecondOrder] {
            for [slip, force] in [
                seepage(conductivity, scheme, LeapFrog::new()),
                seepage(conductivity, scheme, VelocityVerlet::new()),
            ] {
                assert!(slip < 1e-6 && force < 1e-6, "{scheme:?}, k = {conductivity:e}: {slip:e}, {force:e}");
            }
        }
    }
}

/// Leap-frog whose prediction of the fields leaves drag out.
#[derive(Clone, Debug)]
struct Unaware(Option<f64>);

impl Integrator<f64> for Unaware {
    fn name(&self) -> &'static str {
        "unaware"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        if self.0.is_none() {
            system.complete(Moment::Now, dt)?;
            system.advance(Moment::Half, Moment::Now, -0.5 * dt);
        }
        system.complete(Moment::Half, dt)?;
        system.advance(Moment::Half, Moment::Half, dt);
        system.evaluate()?;
        system.drift(Moment::Half, dt);
        system.advance(Moment::Now, Moment::Half, 0.5 * dt);
        self.0 = Some(dt);
        Ok(())
    }
}

#[test]
fn a_prediction_without_drag_is_noticed() {
    let [slip, _] = seepage(1e-6, DragScheme::BackwardEuler, Unaware(None));
    assert!(slip > 1.0, "{slip:e}");
}

/// Soil, some of it in a wall that moves, and water in disorder with random velocities.
fn cloud(conductivity: f64, scheme: DragScheme) -> Both<f64> {
    let mut state = 7_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut mixture = box_of(conductivity, scheme, 0.15, |_| Vector::zero(), |_| Vector::zero());
    for x in mixture.soil_mut().positions_mut().iter_mut() {
        *x += Vector([random(), random()]) * (0.4 * SPACING);
    }
    for x in mixture.water_mut().positions_mut().iter_mut() {
        *x += Vector([random(), random()]) * (0.4 * SPACING);
    }
    for v in mixture.soil_mut().velocities_mut().iter_mut() {
        *v = Vector([random(), random()]);
    }
    for v in mixture.water_mut().velocities_mut().iter_mut() {
        *v = Vector([random(), random()]);
    }
    mixture.with_gravity(Vector([0.0, -9.81]))
}

#[test]
fn the_ledger_closes_at_any_conductivity() {
    for scheme in [DragScheme::BackwardEuler, DragScheme::SecondOrder] {
        for conductivity in [0.1, 1e-3, 1e-6] {
            let step = StepSize::fixed(2e-4).unwrap();
            let mut run = Run::new(wave::<f64>(conductivity, scheme, 0.0), VelocityVerlet::new(), step);
            run.start().unwrap();
            let start = run.budget();
            for _ in 0..100 {
                run.step().unwrap();
            }
            let (closure, drag) = (run.budget().closure(&start).abs(), run.budget().taken[Account::Drag]);
            assert!(closure < 1e-3, "{scheme:?}, k = {conductivity:e}: {closure:e}");
            assert!(drag > 0.1 * start.kinetic, "{scheme:?}, k = {conductivity:e}: drag took {drag:e}");
        }
    }
}

fn bits<T: Real>(mixture: &Both<T>) -> Vec<u64> {
    let (soil, water) = (mixture.soil(), mixture.water());
    [soil.positions(), soil.velocities(), water.positions(), water.velocities()]
        .into_iter()
        .flatten()
        .flat_map(|x| x.0)
        .map(Real::bits)
        .collect()
}

#[test]
fn the_bits_do_not_depend_on_threads() {
    fn after<T: Real>(threads: usize) -> Vec<u64> {
        let courant = StepSize::courant(T::of(0.2)).unwrap();
        let mixture = wave::<T>(1e-5, DragScheme::BackwardEuler, 0.15);
        let mut run = Run::new(mixture, LeapFrog::new(), courant);
        Threads::new(threads).unwrap().install(|| {
            for _ in 0..40 {
                run.step().unwrap();
            }
        });
        bits(run.mixture())
    }
    for threads in [2, 3] {
        assert!(after::<f64>(threads) == after::<f64>(1), "{threads} threads");
        assert!(after::<f32>(threads) == after::<f32>(1), "{threads} threads, f32");
    }
}

#[test]
fn a_resumed_run_has_the_same_bits() {
    fn resumes<I: Integrator<f64>>(integrator: I) {
        let begin = || {
            let mixture = wave::<f64>(1e-4, DragScheme::SecondOrder, 0.15);
            Run::new(mixture, integrator.clone(), StepSize::courant(0.2).unwrap())
        };
        let steps = |run: &mut Run<f64, I>| {
            for _ in 0..30 {
                run.step().unwrap();
            }
        };
        let mut whole = begin();
        steps(&mut whole);
        let snapshot = whole.snapshot();
        steps(&mut whole);
        let mut resumed = begin();
        resumed.restore(snapshot).unwrap();
        steps(&mut resumed);
        assert!(bits(resumed.mixture()) == bits(whole.mixture()), "{}", whole.integrator().name());
        assert_eq!(resumed.budget(), whole.budget());
    }
    resumes(LeapFrog::new());
    resumes(LeapFrog::new().with_third_order_density());
    resumes(VelocityVerlet::new());
}
