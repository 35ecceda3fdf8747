//! Manufactured motions in time: what is of second order, and what stays.

use crate::mistaken_motions::Mistake;
#[cfg(feature = "implicit")]
use crate::motions::together_implicitly;
use crate::motions::{
    Run, WATER, alone, darcy, errors_alone, errors_together, fluid, skeleton, together, velocities,
};
use crate::seepage::Powered;
use crate::soil::SpinningBack;
use crate::water::{Unforeseen, Unpredicted};
use alluvium::Real;
#[cfg(feature = "implicit")]
use alluvium::mixture::DragScheme;
use alluvium::time::{Integrator, LeapFrog, VelocityVerlet};
use alluvium::verify::{Expected, Level, Measured, Study, relative_l2};

const SOURCE: &str = "manufactured solution (Roache 1998), its sources by automatic differentiation";
const IN_TIME: &str = "difference to the same particles in sixteen times as many steps";
const DOUBLE: &str = "viscosity twice as large";
const UNCORRECTED: &str = "gradients not corrected";
const CORRECTED: &str = "gradients corrected";
const UNPREDICTED: &str = "half-step approximation left out";
const WIDE: &str = "gradients corrected, and h = 2 Δx";
const NARROW: &str = "h/Δx kept as it is";
const ORDERLY: &str = "from the lattice";
#[cfg(feature = "implicit")]
const OTHER: &str = "the other scheme";
const SPIN: &str = "spin of the opposite sign";
const CUBED: &str = "φ_f cubed in C_d";
const TWICE: &str = "drag twice as strong";
const MISTAKES: [(&str, Mistake); 4] = [
    ("buoyancy of the soil left out", Mistake::NoBuoyancy),
    ("drag on the water alone", Mistake::OneSidedDrag),
    ("reference density of the water frozen", Mistake::FrozenReference),
    ("σ_xx and σ_yy swapped", Mistake::SwappedStress),
];

/// Particles along an edge.
const SIDES: [usize; 3] = [12, 24, 48];
const SIDES_3D: [usize; 3] = [8, 16, 24];

pub fn studies() -> Vec<Study> {
    #[cfg_attr(not(feature = "implicit"), expect(unused_mut, reason = "nothing is added"))]
    let mut studies = explicit();
    #[cfg(feature = "implicit")]
    {
        let (first, second) = (DragScheme::BackwardEuler, DragScheme::SecondOrder);
        studies.extend([
            implicit_in_time("manufactured/both/time/backward Euler", first, second)
                .expect(Expected::order(1.0, 0.1)),
            implicit_in_time("manufactured/both/time/second-order drag", second, first)
                .expect(Expected::order(2.0, 0.1)),
        ]);
    }
    studies
}

fn explicit() -> Vec<Study> {
    vec![
        water_in_space::<f64, 2, _>("manufactured/water/space/2d/f64", &SIDES, 1.0, VelocityVerlet::new)
            .mutant(UNCORRECTED),
        water_in_space::<f64, 2, _>("manufactured/water/space/leap-frog", &SIDES, 1.0, LeapFrog::new)
            .mutant(UNCORRECTED),
        water_in_space::<f32, 2, _>("manufactured/water/space/2d/f32", &SIDES, 2.0, VelocityVerlet::new),
        water_in_space::<f64, 3, _>("manufactured/water/space/3d/f64", &SIDES_3D, 1.0, VelocityVerlet::new)
            .level(Level::Full),
        water_in_space::<f32, 3, _>("manufactured/water/space/3d/f32", &SIDES_3D, 1.0, VelocityVerlet::new)
            .level(Level::Full),
        uncorrected(),
        joint_limit(),
        disordered(),
        water_in_time::<2, _, _>("manufactured/water/time/velocity-verlet", VelocityVerlet::new, Unforeseen),
        water_in_time::<2, _, _>("manufactured/water/time/leap-frog", LeapFrog::new, Unpredicted),
        water_in_time::<2, _, _>("manufactured/water/time/leap-frog-ab3", third_order_density, Unpredicted),
        water_in_time::<3, _, _>(
            "manufactured/water/time/3d/velocity-verlet",
            VelocityVerlet::new,
            Unforeseen,
        )
        .level(Level::Full),
        water_in_time::<3, _, _>(
            "manufactured/water/time/3d/leap-frog-ab3",
            third_order_density,
            Unpredicted,
        )
        .level(Level::Full),
        MISTAKES
            .iter()
            .fold(both_in_space::<f64, 2>("manufactured/both/space/2d/f64", &SIDES), |study, (name, _)| {
                study.mutant(name)
            }),
        both_in_space::<f32, 2>("manufactured/both/space/2d/f32", &SIDES),
        both_in_space::<f64, 3>("manufactured/both/space/3d/f64", &[16, 24, 32]).level(Level::Full),
        both_in_space::<f32, 3>("manufactured/both/space/3d/f32", &[24, 32]).level(Level::Full),
        printed(),
        both_in_time::<2, _, _>("manufactured/both/time/velocity-verlet", VelocityVerlet::new, Unforeseen),
        both_in_time::<2, _, _>("manufactured/both/time/leap-frog", LeapFrog::new, Unpredicted),
        both_in_time::<2, _, _>("manufactured/both/time/leap-frog-ab3", third_order_density, Unpredicted),
        both_in_time::<3, _, _>("manufactured/both/time/3d/leap-frog-ab3", third_order_density, Unpredicted)
            .level(Level::Full),
    ]
}

fn third_order_density() -> LeapFrog<f64> {
    LeapFrog::new().with_third_order_density()
}

fn water_in_space<T: Real, const D: usize, I: Integrator<T>>(
    name: &str,
    sides: &'static [usize],
    ratio: f64,
    integrator: fn() -> I,
) -> Study {
    Study::new(
        name,
        "with corrected gradients, viscous compressible flow converges at second order while its particles leave their \
         lattice (values: relative error of the velocity)",
        move |conditions| {
            let viscosity = if conditions.is(DOUBLE) { 2.0 } else { 1.0 } * WATER.viscosity;
            let corrected = !conditions.is(UNCORRECTED);
            let run = |side| Run { corrected, ..Run::new(side, ratio) };
            in_space(sides, |side| errors_alone(&alone::<T, D>(run(side), fluid(viscosity), integrator())).into())
        },
    )
    .equations(&["14", "15", "16", "52", "58"])
    .source(SOURCE)
    .expect(Expected::order(2.0, 0.2))
    .mutant(DOUBLE)
}

/// Errors at some resolutions: the first is judged, the others are reported.
fn in_space(sides: &[usize], errors: impl Fn(usize) -> Vec<f64>) -> Measured {
    let all: Vec<_> = sides.iter().map(|&side| (1.0 / side as f64, errors(side))).collect();
    let measured = Measured::errors(all.iter().map(|(spacing, errors)| (*spacing, errors[0])));
    all.iter().fold(measured, |measured, (spacing, errors)| {
        let others: Vec<_> = errors[1..].iter().map(|error| format!("{error:.3e}")).collect();
        measured.note(format!("at Δx = {spacing:.4} the other fields are off by {}", others.join(", ")))
    })
}

/// As the paper has it, at h = Δx.
fn uncorrected() -> Study {
    Study::new(
        "manufactured/water/uncorrected",
        "without the correction, at h = Δx, the error of the velocity stops falling where eight neighbours leave it",
        |conditions| {
            in_space(&SIDES, |side| {
                let run = Run { corrected: conditions.is(CORRECTED), ..Run::new(side, 1.0) };
                errors_alone(&alone::<f64, 2>(run, fluid(WATER.viscosity), VelocityVerlet::new())).into()
            })
        },
    )
    .equations(&["52", "58"])
    .source(SOURCE)
    .expect(Expected::Plateau { value: 0.055, tolerance: 0.02 })
    .mutant(CORRECTED)
}

/// Both limits at once: more particles, and more of them within the support of each.
fn joint_limit() -> Study {
    Study::new(
        "manufactured/water/joint limit",
        "without the correction, the error goes on falling where h/Δx grows with the cube root of the resolution",
        |conditions| {
            in_space(&SIDES, |side| {
                let wider = if conditions.is(NARROW) { 1.0 } else { (side as f64 / SIDES[0] as f64).cbrt() };
                let ratio = 1.3 * wider;
                let run = Run { corrected: false, ..Run::new(side, ratio) };
                errors_alone(&alone::<f64, 2>(run, fluid(WATER.viscosity), VelocityVerlet::new())).into()
            })
        },
    )
    .equations(&["50", "52", "58"])
    .source(SOURCE)
    .expect(Expected::Order { at_least: 1.0, at_most: 2.0 })
    .mutant(NARROW)
}

/// From places a tenth of a spacing off the lattice.
fn disordered() -> Study {
    Study::new(
        "manufactured/water/disordered",
        "from disordered places forces that conserve momentum do not converge, corrected as they are: the order is \
         between minus one and one half",
        |conditions| {
            in_space(&SIDES, |side| {
                let jitter = if conditions.is(ORDERLY) { 0.0 } else { 0.1 };
                let run = Run { jitter, ..Run::new(side, 2.0) };
                errors_alone(&alone::<f64, 2>(run, fluid(WATER.viscosity), VelocityVerlet::new())).into()
            })
        },
    )
    .equations(&["51", "58"])
    .source(SOURCE)
    .expect(Expected::Order { at_least: -1.0, at_most: 0.5 })
    .mutant(ORDERLY)
}

/// The paper's sums for both constituents at h = Δx.
fn printed() -> Study {
    Study::new(
        "manufactured/both/as printed",
        "with (55), (58) as printed and h = Δx soil and water do not converge: water is held by the lattice of the \
         grains",
        |conditions| {
            in_space(&SIDES, |side| {
                let run = match conditions.is(WIDE) {
                    true => Run::new(side, 2.0),
                    false => Run { corrected: false, ..Run::new(side, 1.0) },
                };
                errors_together(&together::<f64, 2, _>(run, skeleton(), darcy(1.0), VelocityVerlet::new())).into()
            })
        },
    )
    .equations(&["55", "58"])
    .source(SOURCE)
    .expect(Expected::Order { at_least: -2.0, at_most: 0.0 })
    .mutant(WIDE)
}

fn both_in_space<T: Real, const D: usize>(name: &str, sides: &'static [usize]) -> Study {
    Study::new(
        name,
        "with corrected gradients, the velocities of soil and water that pass through each other and the stress of the \
         soil converge at second order at h = 2 Δx (values: rms of their relative errors; the last of the fields \
         noted is the pore pressure, which does not: the drag's sum keeps its error)",
        move |conditions| {
            in_space(sides, |side| {
                let mistake = MISTAKES.iter().find(|(name, _)| conditions.is(name)).map(|(_, mistake)| *mistake);
                let run = Run { steps: 5 * side, mistake, ..Run::new(side, 2.0) };
                let integrator = VelocityVerlet::new;
                if conditions.is(SPIN) {
                    let soil = SpinningBack(skeleton());
                    errors_together(&together::<T, D, _>(run, soil, darcy(1.0), integrator())).into()
                } else if conditions.is(CUBED) {
                    let drag = Powered { right: darcy(1.0), power: 3 };
                    errors_together(&together::<T, D, _>(run, skeleton(), drag, integrator())).into()
                } else {
                    let drag = darcy(if conditions.is(TWICE) { 2.0 } else { 1.0 });
                    errors_together(&together::<T, D, _>(run, skeleton(), drag, integrator())).into()
                }
            })
        },
    )
    .equations(&["20", "33", "34", "35", "37", "52", "53", "55", "58", "65", "69"])
    .source(SOURCE)
    .expect(Expected::order(2.0, 0.2))
    .mutant(SPIN)
    .mutant(CUBED)
    .mutant(TWICE)
}

/// Differences of the velocities to those in sixteen times as many steps as the finest; singles would round them away.
fn in_time(velocities: impl Fn(usize) -> Vec<f64>) -> Measured {
    const STEPS: [usize; 3] = [80, 160, 320];
    let exact = velocities(16 * STEPS[2]);
    let error = |steps: usize| (1.0 / steps as f64, relative_l2(&velocities(steps), &exact));
    Measured::errors(STEPS.map(error))
}

fn water_in_time<const D: usize, I: Integrator<f64>, J: Integrator<f64> + Copy + Send + Sync + 'static>(
    name: &str,
    integrator: fn() -> I,
    mistaken: J,
) -> Study {
    Study::new(name, "the error of a water step is of second order in its length", move |conditions| {
        in_time(|steps| {
            let run = Run { steps, ..Run::new(8, 1.0) };
            let water = fluid(WATER.viscosity);
            if conditions.is(UNPREDICTED) {
                velocities(alone::<f64, D>(run, water, mistaken).water())
            } else {
                velocities(alone::<f64, D>(run, water, integrator()).water())
            }
        })
    })
    .equations(&["71", "72"])
    .source(IN_TIME)
    .expect(Expected::order(2.0, 0.1))
    .mutant(UNPREDICTED)
}

/// With drag solved over the step; the drag's own time is 7 ms, the longest step 1.3 ms.
#[cfg(feature = "implicit")]
fn implicit_in_time(name: &str, scheme: DragScheme, other: DragScheme) -> Study {
    Study::new(
        name,
        "the error of a step of soil and water whose drag is solved over it is of the order of its scheme",
        move |conditions| {
            in_time(|steps| {
                let run = Run { steps, ..Run::new(8, 2.0) };
                let scheme = if conditions.is(OTHER) { other } else { scheme };
                let mixture = together_implicitly(run, scheme, VelocityVerlet::new());
                [velocities(mixture.soil()), velocities(mixture.water())].concat()
            })
        },
    )
    .equations(&["37"])
    .source(IN_TIME)
    .mutant(OTHER)
}

fn both_in_time<const D: usize, I: Integrator<f64>, J: Integrator<f64> + Copy + Send + Sync + 'static>(
    name: &str,
    integrator: fn() -> I,
    mistaken: J,
) -> Study {
    Study::new(
        name,
        "the error of a step of soil and water is of second order in its length",
        move |conditions| {
            in_time(|steps| {
                let run = Run { steps, ..Run::new(8, 2.0) };
                let both = |mixture: &crate::motions::Mixed<f64, D, _>| {
                    [velocities(mixture.soil()), velocities(mixture.water())].concat()
                };
                if conditions.is(UNPREDICTED) {
                    both(&together::<f64, D, _>(run, skeleton(), darcy(1.0), mistaken))
                } else {
                    both(&together::<f64, D, _>(run, skeleton(), darcy(1.0), integrator()))
                }
            })
        },
    )
    .equations(&["71", "72"])
    .source(IN_TIME)
    .expect(Expected::order(2.0, 0.1))
    .mutant(UNPREDICTED)
}
