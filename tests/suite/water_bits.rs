//! The bits of water as the first version that had no soil gave them: a small dam break, 300 steps on, is still the
//! same to the last bit.
//!
//! The column starts without pressure, so that no logarithm of the system's library has a part in it.

use crate::fingerprint::hash;
use alluvium::kernel::WendlandC2;
use alluvium::material::Water;
use alluvium::mixture::{Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::{Preset, Real, Vector, setup};

const SPACING: f64 = 0.005;
const STEPS: usize = 300;

const GRAVITY: f64 = 9.81;

fn column<T: Real>(preset: Preset, gravity: f64) -> Mixture<T, 2> {
    let volume = T::of(SPACING * SPACING);
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(25.0)).unwrap());
    let layers = preset.wall_layers(2.0 * preset.smoothing_ratio());
    let walls = setup::tank([0.0, 0.0], [0.3, 0.3], SPACING, layers, [(true, true), (true, false)]);
    water.add_wall(preset.wall(), &walls, volume, |_| T::ZERO).unwrap();
    water.add(&setup::fill([0.0, 0.0], [0.1, 0.2], SPACING), volume, |_| T::ZERO).unwrap();
    let kernel = WendlandC2::new(T::of(preset.smoothing_ratio() * SPACING)).unwrap();
    preset.apply(Mixture::of_water(kernel, water)).with_gravity(Vector::of([0.0, -gravity]))
}

fn state_after<T: Real>(preset: Preset, integrator: LeapFrog<T>, gravity: f64) -> u64 {
    let step = StepSize::courant(T::of(preset.courant())).unwrap();
    let run = Simulation::new(column(preset, gravity), integrator, step);
    let mut run = run.with_reinitialisation(preset.reinitialise_every());
    for _ in 0..STEPS {
        run.step().unwrap();
    }
    assert!(run.mixture().water_neighbourhood().rebuilds() > 1, "nothing was ever re-sorted");
    hash(run.mixture())
}

fn are_kept<T: Real>(preset: Preset, integrator: LeapFrog<T>, stored: u64) {
    let state = state_after(preset, integrator, GRAVITY);
    assert_eq!(
        state,
        stored,
        "the bits of water have changed: {}, preset {preset}, {integrator:?}: {state:#018x} for {stored:#018x}. If \
         that is meant, say in CHANGELOG.md what changed them, why, and by how much results differ; then store the \
         new number.",
        T::NAME
    );
}

/// With the leap-frog as printed: the bits are those of the first version.
#[test]
fn are_those_of_the_first_version() {
    are_kept::<f64>(Preset::Paper, LeapFrog::new(), 0xa243_789e_daf9_8615);
    are_kept::<f32>(Preset::Paper, LeapFrog::new(), 0x87fc_95c4_29f9_ed4f);
    are_kept::<f64>(Preset::Default, LeapFrog::new(), 0xff2d_ec59_a410_9bd7);
    are_kept::<f32>(Preset::Default, LeapFrog::new(), 0xe388_ac25_010e_bb6d);
}

/// The default preset's leap-frog came later (decision 24), and changed them.
#[test]
fn with_density_of_third_order() {
    are_kept::<f64>(Preset::Default, Preset::Default.leap_frog(), 0xfb07_734c_49d6_9e9c);
    are_kept::<f32>(Preset::Default, Preset::Default.leap_frog(), 0x19b6_8e17_4826_5676);
}

#[test]
fn a_last_bit_of_gravity_shows() {
    let state = |gravity| state_after::<f64>(Preset::Paper, LeapFrog::new(), gravity);
    assert_ne!(state(GRAVITY * (1.0 + f64::EPSILON)), state(GRAVITY));
}
