//! Water that comes in and particles that leave: in step, in the books, never lost in silence.

use crate::fingerprint::hash;
use alluvium::budget::Account;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Absent, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{Mixture, Phase, StepError, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, StepSize, VelocityVerlet};
use alluvium::{Real, Vector, setup};

type Jet<T, const D: usize, I> = Simulation<T, D, WendlandC2<T, D>, Absent, Water<T>, I>;

const SPACING: f64 = 0.01;
const SPEED: f64 = 2.0;

/// Water that comes down through a mouth 4 spacings wide at height 0.
fn jet<T: Real, const D: usize, I: Integrator<T>>(
    integrator: I,
    step: StepSize<T>,
    outlet: Option<f64>,
    domain: Option<f64>,
) -> Jet<T, D, I> {
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(30.0)).unwrap());
    let (mut low, mut high) = ([0.0; D], [4.0 * SPACING; D]);
    (low[D - 1], high[D - 1]) = (0.0, 4.0 * SPACING);
    let mut velocity = Vector::zero();
    velocity[D - 1] = T::of(-SPEED);
    water.add_inflow(low, high, SPACING, velocity).unwrap();
    let mut gravity = Vector::zero();
    gravity[D - 1] = T::of(-9.81);
    let mut mixture = Mixture::<T, D>::of_water(WendlandC2::new(T::of(1.3 * SPACING)).unwrap(), water)
        .with_gravity(gravity);
    let below = |level: f64| {
        let mut high = [f64::INFINITY; D];
        high[D - 1] = level;
        ([f64::NEG_INFINITY; D], high)
    };
    if let Some((low, high)) = outlet.map(below) {
        mixture = mixture.with_outlet(low, high).unwrap();
    }
    if let Some(level) = domain {
        let mut low = [f64::NEG_INFINITY; D];
        low[D - 1] = level;
        mixture = mixture.with_domain(low, [f64::INFINITY; D]).unwrap();
    }
    Simulation::new(mixture, integrator, step)
}

fn steps<T: Real, const D: usize, I: Integrator<T>>(run: &mut Jet<T, D, I>, count: usize) {
    for _ in 0..count {
        run.step().unwrap();
    }
}

#[test]
fn rows_come_in_a_spacing_apart_whatever_the_step() {
    fn rows<I: Integrator<f64>>(integrator: I) {
        // A row passes the mouth in the middle of a step.
        let step = StepSize::fixed(SPACING / SPEED / 20.6).unwrap();
        let mut run = jet::<f64, 2, _>(integrator, step, None, None);
        steps(&mut run, 206);
        let water = run.mixture().water();
        assert_eq!(water.wall_particles(), 16);
        assert_eq!(water.len() - water.wall_particles(), 4 * 10, "ten rows of four");
        let mut column: Vec<f64> =
            water.positions()[..16].iter().filter(|x| x[0] < SPACING).map(|x| x[1]).collect();
        column.sort_by(f64::total_cmp);
        for pair in column.windows(2) {
            assert!((pair[1] - pair[0] - SPACING).abs() < 1e-12, "{pair:?}");
        }
        let mut ids = water.ids().to_vec();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), water.len(), "everyone has a number of their own");
    }
    rows(LeapFrog::new());
    rows(LeapFrog::new().with_third_order_density());
    rows(VelocityVerlet::new());
}

#[test]
fn what_comes_in_and_leaves_is_in_the_books() {
    fn books<T: Real, const D: usize, I: Integrator<T>>(integrator: I, bar: f64) {
        let step = StepSize::courant(T::of(0.1)).unwrap();
        let mut run = jet::<T, D, I>(integrator, step, Some(-0.1), None);
        run.start().unwrap();
        let start = run.budget();
        while run.time() < 0.1 {
            run.step().unwrap();
        }
        let now = run.budget();
        let came = -now.taken[Account::Inflow];
        assert!(now.taken[Account::Outflow] != 0.0 && came > 0.0);
        assert!(now.mass_closure(&start).abs() < bar * now.mass, "mass {}", now.mass_closure(&start));
        let momentum = now.momentum_closure(&start)[D - 1];
        assert!(momentum.abs() < bar * now.mass * SPEED, "momentum {momentum}");
        let energy = now.closure(&start);
        assert!(energy.abs() < 2e-3 * came, "energy {energy} of {came}");
    }
    books::<f64, 2, _>(LeapFrog::new(), 1e-11);
    books::<f64, 2, _>(LeapFrog::new().with_third_order_density(), 1e-11);
    books::<f64, 2, _>(VelocityVerlet::new(), 1e-11);
    books::<f64, 3, _>(LeapFrog::new().with_third_order_density(), 1e-11);
    books::<f64, 3, _>(VelocityVerlet::new(), 1e-11);
    books::<f32, 2, _>(VelocityVerlet::new(), 1e-4);
    books::<f32, 3, _>(LeapFrog::new().with_third_order_density(), 1e-4);
}

#[test]
fn an_open_run_goes_on_with_the_same_bits() {
    fn resumes<T: Real, const D: usize, I: Integrator<T>>(integrator: &I) {
        let step = StepSize::courant(T::of(0.2)).unwrap();
        let make = || jet::<T, D, I>(integrator.clone(), step, Some(-0.1), None);
        let mut whole = make();
        steps(&mut whole, 300);
        let snapshot = whole.snapshot();
        let came_before = whole.budget().taken[Account::Inflow];
        steps(&mut whole, 200);
        assert!(whole.budget().taken[Account::Inflow] != came_before, "nobody came after the snapshot");
        let mut resumed = make();
        resumed.restore(snapshot).unwrap();
        steps(&mut resumed, 200);
        assert_eq!(hash(resumed.mixture()), hash(whole.mixture()), "{D}D {} {}", T::NAME, integrator.name());
        assert_eq!(resumed.budget(), whole.budget());
    }
    resumes::<f64, 2, _>(&LeapFrog::new());
    resumes::<f64, 2, _>(&LeapFrog::new().with_third_order_density());
    resumes::<f64, 2, _>(&VelocityVerlet::new());
    resumes::<f32, 3, _>(&LeapFrog::new().with_third_order_density());
}

#[test]
fn nobody_leaves_the_domain_in_silence() {
    let step = StepSize::courant(0.2).unwrap();
    let mut run = jet::<f64, 2, _>(LeapFrog::new(), step, None, Some(-0.05));
    let error = loop {
        match run.step() {
            Ok(_) => assert!(run.time() < 0.1, "somebody should have left"),
            Err(error) => break error,
        }
    };
    assert!(matches!(&error, StepError::Escaped { culprit, .. } if culprit.kind == "water"), "{error}");
    // Through an outlet that begins before the domain ends they may.
    let mut run = jet::<f64, 2, _>(LeapFrog::new(), step, Some(-0.045), Some(-0.05));
    while run.time() < 0.1 {
        run.step().unwrap();
    }
}

#[test]
fn an_inflow_moves_along_an_axis_and_has_particles() {
    let mut water = Phase::<f64, 2, _>::new(Water::new(1000.0, 30.0).unwrap());
    let refused = |error: alluvium::error::ParameterError| error.to_string();
    let skew = water.add_inflow([0.0; 2], [0.04; 2], SPACING, Vector([1.0, 1.0])).map_err(refused);
    assert!(skew.is_err_and(|why| why.contains("along one axis")));
    let empty = water.add_inflow([0.0; 2], [0.001; 2], SPACING, Vector([1.0, 0.0])).map_err(refused);
    assert!(empty.is_err_and(|why| why.contains("at least one spacing")));
}

#[test]
fn water_that_comes_in_beside_soil_has_the_fraction_of_its_place() {
    let mut soil = Phase::new(Soil::new(2700.0, Elasticity::new(1e6, 0.3).unwrap(), Unyielding).unwrap());
    let beside = setup::fill::<f64, 2>([0.04, -0.1], [0.09, 0.08], SPACING);
    soil.add_wall(Wall::dynamic(), &beside, SPACING * SPACING, |_| 0.0).unwrap();
    soil.set_volume_fraction(|_| 0.5);
    let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
    water.add_inflow([0.0, 0.0], [0.04, 0.04], SPACING, Vector([0.0, -SPEED])).unwrap();
    let kernel = WendlandC2::new(1.5 * SPACING).unwrap();
    let mixture = Mixture::<f64, 2, _, _>::new(kernel, soil, water);
    let step = StepSize::fixed(SPACING / SPEED / 20.6).unwrap();
    let mut run = Simulation::new(mixture, LeapFrog::new(), step);
    // Each place of the box has been taken anew.
    for _ in 0..110 {
        run.step().unwrap();
    }
    run.mixture_mut().evaluate().unwrap();
    let (soil, water) = (run.mixture().soil(), run.mixture().water());
    let mut least = 1.0_f64;
    for a in 0..water.len() {
        let grains = |i: usize| {
            let r2 = (water.positions()[a] - soil.positions()[i]).norm2();
            let near = r2 < kernel.support() * kernel.support();
            if near { soil.volume(i) * soil.volume_fraction(i) * kernel.value::<f64>(r2) } else { 0.0 }
        };
        let fraction = 1.0 - (0..soil.len()).map(grains).sum::<f64>(); // (68)
        least = least.min(fraction);
        assert!(
            (water.volume_fraction(a) - fraction).abs() < 5e-3,
            "{} for {fraction}",
            water.volume_fraction(a)
        );
    }
    assert!(least < 0.95 && water.len() > 30, "{least}");
}
