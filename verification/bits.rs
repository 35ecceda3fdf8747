//! Runs of water, soil and both that are the same to the last bit, whatever the threads, the instructions, the
//! search, and whether they were interrupted.

use crate::clouds::{Both, Cloud, Following, Made, of_every_cloud};
use crate::frames::{Frame, Mistake};
use alluvium::material::{Material, Memory};
use alluvium::mixture::Phase;
use alluvium::neighbours::{BruteForce, NeighbourSearch};
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, LeapFrog, StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Measured, Study};
use alluvium::{InstructionSet, Real};

const SHORT: &str = "search 1 % short of the support";
const LONGER: &str = "the step of three threads is longer by one rounding";
const ANEW: &str = "goes on from what is seen, not from what was kept";

const STEPS: usize = 30;

pub fn studies() -> Vec<Study> {
    let clouds: Vec<Vec<Study>> = of_every_cloud!(of);
    clouds.into_iter().flatten().collect()
}

fn of<T: Real, const D: usize>(made: Made) -> Vec<Study> {
    let name = |what: &str| format!("invariance/{what}/{}/{D}d/{}", made.name(), T::NAME);
    vec![
        study::<T, D, _>(name("bits"), made, LeapFrog::new().with_third_order_density()),
        study::<T, D, _>(name("bits, leap-frog"), made, LeapFrog::new()),
        study::<T, D, _>(name("bits, velocity-verlet"), made, VelocityVerlet::new()),
    ]
}

fn study<T: Real, const D: usize, I: Integrator<T> + Sync>(name: String, made: Made, integrator: I) -> Study {
    // More particles than a task of the loops over them takes.
    let cloud = Cloud::<D> { periodic: true, side: if D == 2 { 46 } else { 13 }, ..Cloud::new(made) };
    Study::new(
        name,
        "a run has the same bits for any threads, instructions and search, and if it is kept and resumed on \
         the way (values: numbers that differ)",
        move |conditions| differences::<T, D, I>(cloud, &integrator, conditions),
    )
    .source("each particle adds its own neighbours in ascending order; a snapshot holds all that a step begins with")
    .expect(Expected::Identical)
    .mutant(SHORT)
    .mutant(LONGER)
    .mutant(ANEW)
}

fn differences<T: Real, const D: usize, I: Integrator<T>>(
    cloud: Cloud<D>,
    integrator: &I,
    conditions: &Conditions,
) -> Measured {
    let run = |mixture: Both<T, D>, courant: f64| -> Following<T, D, I> {
        let step = StepSize::courant(T::of(courant)).expect("a Courant number");
        Simulation::new(mixture, integrator.clone(), step)
    };
    let follow = |mistake, courant| run(cloud.mixture(Cloud::<D>::soil(), &Frame::own(), mistake), courant);
    let own = || follow(None, COURANT);
    let mut whole = own();
    steps(&mut whole, STEPS, 1);
    let expected = bits(whole.mixture());
    let mut values = Vec::new();
    let mut compare = |what: &str, run: &Following<T, D, I>| {
        let different = bits(run.mixture()).iter().zip(&expected).filter(|(a, b)| a != b).count();
        values.push((what.to_owned(), different as f64));
    };
    let longer = if conditions.is(LONGER) { 1.0 + T::EPSILON.as_f64() } else { 1.0 };
    let mut other = follow(None, COURANT * longer);
    steps(&mut other, STEPS, 3);
    compare("3 threads", &other);
    for set in InstructionSet::NAMES {
        let set_of = InstructionSet::at_most(set).expect("a name of the list");
        let mut other = run(own().into_mixture().with_instruction_set(set_of), COURANT);
        steps(&mut other, STEPS, 2);
        compare(&format!("2 threads, {set}"), &other);
    }
    let mut searched = match conditions.is(SHORT) {
        true => follow(Some(Mistake::ShortSighted), COURANT),
        false => {
            let all = || -> Box<dyn NeighbourSearch<T, D>> { Box::<BruteForce>::default() };
            run(own().into_mixture().with_search(all), COURANT)
        }
    };
    steps(&mut searched, STEPS, 2);
    compare("every pair looked at", &searched);
    let mut resumed = own();
    steps(&mut resumed, STEPS / 2, 2);
    let mut after = own();
    if conditions.is(ANEW) {
        after = run(resumed.into_mixture(), COURANT);
    } else {
        after.restore(resumed.snapshot()).expect("a snapshot of this cloud");
    }
    steps(&mut after, STEPS / 2, 2);
    compare("resumed", &after);
    let mixture = whole.mixture();
    let sorted = mixture.soil_neighbourhood().rebuilds().max(mixture.water_neighbourhood().rebuilds());
    Measured::values(values).note(format!("{} numbers; lists renewed {sorted} times", expected.len()))
}

/// Small enough that it, and not the pores (which know no such number), sets the step.
const COURANT: f64 = 0.15;

fn steps<T: Real, const D: usize, I: Integrator<T>>(
    run: &mut Following<T, D, I>,
    count: usize,
    threads: usize,
) {
    Threads::new(threads).expect("a few threads").install(|| {
        for _ in 0..count {
            run.step().expect("a step");
        }
    });
}

/// Of every particle, as the arrays have them.
fn bits<T: Real, const D: usize>(mixture: &Both<T, D>) -> Vec<u64> {
    let mut bits = of_phase(mixture.soil());
    bits.extend(of_phase(mixture.water()));
    bits
}

pub fn of_phase<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> Vec<u64> {
    let mut bits = Vec::new();
    for i in 0..phase.len() {
        bits.push(u64::from(phase.ids()[i]));
        bits.extend(phase.positions()[i].0.into_iter().chain(phase.velocities()[i].0).map(Real::bits));
        bits.extend([phase.density(i), phase.compression(i), phase.volume_fraction(i)].map(Real::bits));
        bits.push(phase.pressures()[i].bits());
        let mut remembered = Vec::new();
        phase.memory(i).show(&mut remembered);
        bits.extend(remembered.into_iter().map(f64::to_bits));
    }
    bits
}
