//! What must not matter: a uniform velocity, how the axes lie, mirroring, the order in which particles are
//! given.
//!
//! Water, soil that yields, and both with Darcy drag, with every term that is on by default, viscosity, artificial
//! stress and the relaxation of the density. Walls, and soil that is held, are a frame of their own: a uniform
//! velocity is left out for them. Axes and mirrors are no matter of bits: sums go through the cells in
//! the order of the axes.

use crate::clouds::{Cloud, FLOW, Made, Particle, STEPS, Seen, of_every_cloud};
use crate::frames::{Frame, Mistake};
use alluvium::Real;
use alluvium::time::{Integrator, LeapFrog, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Measured, Study};
use core::f64::consts::FRAC_PI_2;

const ABSOLUTE: &str = "artificial viscosity takes the absolute velocity for speed of sound";
const GRAVITY: &str = "gravity is not turned along";
const STRESS: &str = "the soil's stress is not turned along";
const CORNER: &str = "the search forgets one corner";
const MIXED_UP: &str = "two velocities belong to each other's particles";

const VALUES: &str = "(values: differences over spacing, largest speed, compression, stress)";
const MISTAKES: [(&str, Mistake); 5] = [
    (ABSOLUTE, Mistake::AbsoluteSpeed),
    (GRAVITY, Mistake::GravityStays),
    (STRESS, Mistake::StressStays),
    (CORNER, Mistake::Corner),
    (MIXED_UP, Mistake::MixedUp),
];

fn mistake(conditions: &Conditions) -> Option<Mistake> {
    MISTAKES.into_iter().find(|(name, _)| conditions.is(name)).map(|(_, mistake)| mistake)
}

/// On top of a flow of [`FLOW`], a quarter of the speed of sound \[m/s\].
const SPEED: f64 = 5.0;

pub fn studies() -> Vec<Study> {
    let clouds: Vec<Vec<Study>> = of_every_cloud!(of);
    clouds.into_iter().flatten().collect()
}

fn of<T: Real, const D: usize>(made: Made) -> Vec<Study> {
    let name = |what: &str| format!("invariance/{what}/{}/{D}d/{}", made.name(), T::NAME);
    let cloud = Cloud::<D>::new(made);
    let box_of = Cloud { periodic: true, ..cloud };
    let third_order_density = LeapFrog::new().with_third_order_density();
    let mut studies = vec![
        moved::<T, D>(&name("uniform velocity"), box_of),
        reordered::<T, D, _>(&name("order"), box_of, LeapFrog::new()),
        reordered::<T, D, _>(&name("order, leap-frog-ab3"), box_of, third_order_density),
        reordered::<T, D, _>(&name("order, velocity-verlet"), box_of, VelocityVerlet::new()),
    ];
    let turned = [
        ("quarter turn", turn(FRAC_PI_2, false), "turned by 90°"),
        ("oblique turn", turn(0.7, true), "turned by 40°, in three dimensions about an oblique axis"),
        ("mirror", mirror(), "mirrored"),
    ];
    for (what, turn, how) in turned {
        studies.push(other_axes::<T, D>(&name(what), cloud, turn, how));
    }
    let corrected = Cloud { corrected: true, ..cloud };
    let oblique = "turned by 40°, gradients corrected";
    studies.push(other_axes::<T, D>(&name("oblique turn, corrected"), corrected, turn(0.7, true), oblique));
    studies
}

/// What N steps may lose, each of them rounding positions of size L, in which pairs are Δx apart, and velocities
/// of size U + u, in which they differ by u: `ε N (L/Δx + U/u)`.
fn rounding<T: Real, const D: usize>(cloud: &Cloud<D>, speed: f64) -> f64 {
    T::EPSILON.as_f64() * STEPS as f64 * (1.0 / cloud.spacing() + speed / FLOW)
}

fn moved<T: Real, const D: usize>(name: &str, cloud: Cloud<D>) -> Study {
    let velocity = core::array::from_fn(|k| SPEED * [0.8, -0.6, 0.1][k]);
    let frame = Frame { velocity, ..Frame::own() };
    let study = Study::new(
        name,
        format!(
            "a uniform velocity of ten times the flow's changes nothing but places, in a box that repeats itself \
             {VALUES}"
        ),
        move |conditions| compare::<T, D>(&LeapFrog::new(), cloud, &frame, cloud, mistake(conditions)),
    );
    study
        .equations(&["52", "53", "55", "58", "69", "71", "72"])
        .source("Galilean invariance; bar: ε N (L/Δx + U/u), every rounding of N steps one way")
        .expect(Expected::Bound { largest: rounding::<T, D>(&cloud, SPEED) })
        .mutant(ABSOLUTE)
}

fn other_axes<T: Real, const D: usize>(name: &str, cloud: Cloud<D>, turn: [[f64; D]; D], how: &str) -> Study {
    let frame = Frame { turn, velocity: [0.0; D] };
    let study = Study::new(
        name,
        format!("a free cloud runs the same {how}, and gravity with it {VALUES}"),
        move |conditions| compare::<T, D>(&LeapFrog::new(), cloud, &frame, cloud, mistake(conditions)),
    )
    .equations(&["21", "34", "35", "52", "53", "55", "58", "65", "66"])
    .source("no direction of space is its own; bar: ε N L/Δx, every rounding of N steps one way")
    .expect(Expected::Bound { largest: rounding::<T, D>(&cloud, 0.0) })
    .mutant(GRAVITY)
    .mutant(CORNER);
    if cloud.made.has_soil() { study.mutant(STRESS) } else { study }
}

fn reordered<T: Real, const D: usize, I: Integrator<T> + Sync>(
    name: &str,
    cloud: Cloud<D>,
    integrator: I,
) -> Study {
    let shuffled = Cloud { order: 17, ..cloud };
    Study::new(
        name,
        format!(
            "particles given in another order become the same, to rounding: those of a cell are added up in the \
             order in which they came {VALUES}"
        ),
        move |conditions| compare(&integrator, cloud, &Frame::own(), shuffled, mistake(conditions)),
    )
    .source("numbers are names; bar: ε N L/Δx, every rounding of N steps one way")
    .expect(Expected::Bound { largest: rounding::<T, D>(&cloud, 0.0) })
    .mutant(MIXED_UP)
}

/// What `other` becomes in a frame, against what the cloud in its own becomes, seen from there.
fn compare<T: Real, const D: usize>(
    integrator: &impl Integrator<T>,
    cloud: Cloud<D>,
    frame: &Frame<D>,
    other: Cloud<D>,
    mistake: Option<Mistake>,
) -> Measured {
    let own = cloud.seen(integrator.clone(), &Frame::own(), None);
    let found = other.seen(integrator.clone(), frame, mistake);
    let travelled = STEPS as f64 * T::of(cloud.step()).as_f64();
    let see = |p: &Particle<D>| {
        let (x, v) = (frame.vector(p.position), frame.vector(p.velocity));
        Particle {
            position: core::array::from_fn(|k| x[k] + travelled * frame.velocity[k]),
            velocity: core::array::from_fn(|k| v[k] + frame.velocity[k]),
            stress: frame.tensor(p.stress),
            ..*p
        }
    };
    let expected = Seen {
        longest_step: own.longest_step,
        soil: own.soil.iter().map(see).collect(),
        water: own.water.iter().map(see).collect(),
    };
    let mut values = differences("soil", cloud, &found.soil, &expected.soil, frame);
    values.extend(differences("water", cloud, &found.water, &expected.water, frame));
    values.push(("step allowed".into(), found.longest_step / own.longest_step - 1.0));
    let (same, all) = same_bits(&found, &expected);
    Measured::values(values).note(format!("{same} of {all} numbers have the same bits"))
}

/// How many numbers of two clouds are the same to the last bit, of how many.
fn same_bits<const D: usize>(found: &Seen<D>, expected: &Seen<D>) -> (usize, usize) {
    let numbers = |seen: &Seen<D>| -> Vec<f64> {
        let of_soil = |p: &Particle<D>| [&p.position[..], &p.velocity, &p.stress.0].concat();
        let of_water = |p: &Particle<D>| [&p.position[..], &p.velocity, &[p.compression]].concat();
        seen.soil.iter().flat_map(of_soil).chain(seen.water.iter().flat_map(of_water)).collect()
    };
    let (found, expected) = (numbers(found), numbers(expected));
    (found.iter().zip(&expected).filter(|(a, b)| a == b).count(), expected.len())
}

/// The largest differences of two clouds, by what they are to be measured with.
fn differences<const D: usize>(
    of: &str,
    cloud: Cloud<D>,
    found: &[Particle<D>],
    expected: &[Particle<D>],
    frame: &Frame<D>,
) -> Vec<(String, f64)> {
    if expected.is_empty() {
        return Vec::new();
    }
    let largest = |number: &dyn Fn(&Particle<D>, &Particle<D>) -> f64| {
        let all = found.iter().zip(expected).map(|(a, b)| number(a, b));
        all.fold(0.0_f64, |most, x| if x.is_nan() || x > most { x } else { most })
    };
    let apart = |a: [f64; D], b: [f64; D]| (0..D).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    let around = |x: f64| if cloud.periodic { x - x.round() } else { x };
    let place =
        largest(&|a, b| apart(core::array::from_fn(|k| around(a.position[k] - b.position[k])), [0.0; D]));
    let speed = largest(&|_, b| apart(b.velocity, frame.velocity));
    let mut values = vec![
        (format!("places of {of}"), place / cloud.spacing()),
        (format!("velocities of {of}"), largest(&|a, b| apart(a.velocity, b.velocity)) / speed),
        (format!("fractions of {of}"), largest(&|a, b| (a.fraction - b.fraction).abs())),
    ];
    let compression = largest(&|_, b| b.compression.abs());
    if compression > 0.0 {
        let off = largest(&|a, b| (a.compression - b.compression).abs());
        values.push((format!("compressions of {of}"), off / compression));
    }
    let size = |t: &alluvium::SymTensor<f64>| t.0.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let stress = largest(&|_, b| size(&b.stress));
    if stress > 0.0 {
        values.push((format!("stresses of {of}"), largest(&|a, b| size(&(a.stress - b.stress))) / stress));
    }
    values
}

/// The matrix of a turn in the plane of the first two axes; `tilted`, in three dimensions, about an oblique axis.
fn turn<const D: usize>(angle: f64, tilted: bool) -> [[f64; D]; D] {
    let (sin, cos) = if angle == FRAC_PI_2 { (1.0, 0.0) } else { angle.sin_cos() };
    let axis = if D == 3 && tilted { [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0] } else { [0.0, 0.0, 1.0] };
    let cross = [[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]];
    core::array::from_fn(|a| {
        core::array::from_fn(|b| {
            let same = f64::from(u8::from(a == b));
            cos * same + (1.0 - cos) * axis[a] * axis[b] + sin * cross[a][b] // Rodrigues
        })
    })
}

/// The first axis the other way round.
fn mirror<const D: usize>() -> [[f64; D]; D] {
    let mut turn = Frame::<D>::own().turn;
    turn[0][0] = -1.0;
    turn
}
