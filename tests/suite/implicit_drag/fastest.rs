//! How fast drag of reconstructed velocities acts at most, by power iteration: what its limit of the step and its
//! stability solved over the step rest on.

use super::{Both, SIDE, SPACING, darcy};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Phase};
use alluvium::neighbours::Periodic;
use alluvium::time::Evolve;
use alluvium::{Vector, setup};

fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
}

/// Soil and water in this much disorder, with drag and nothing else.
fn cloud((ratio, disorder, fraction): (f64, f64, f64), periodic: bool) -> Both<f64> {
    let (mut state, volume) = (11, SPACING * SPACING);
    let lattice = setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING);
    let mut places = || -> Vec<Vector<f64, 2>> {
        let mut step = || disorder * SPACING * random(&mut state);
        lattice.iter().map(|x| *x + Vector([step(), step()])).collect()
    };
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
    soil.add(&places(), volume, |_| 0.0).unwrap();
    soil.set_volume_fraction(|_| fraction);
    let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
    water.add(&places(), volume, |_| 0.0).unwrap();
    let none = ArtificialViscosity { linear: 0.0, quadratic: 0.0 };
    let mixture = Mixture::new(WendlandC2::new(ratio * SPACING).unwrap(), soil, water)
        .with_drag(darcy(1e-6))
        .with_artificial_viscosity(none)
        .and_then(|mixture| mixture.with_soil_artificial_viscosity(none))
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
        .unwrap();
    let all = Periodic::new(Vector::zero(), [Some(SIDE); 2]).unwrap();
    if periodic { mixture.with_periodic(all) } else { mixture }
}

/// The fastest rate of drag \[1/s\].
fn fastest(mixture: &mut Both<f64>) -> f64 {
    let mut state = 5;
    let mut wild = || Vector([random(&mut state), random(&mut state)]);
    mixture.soil_mut().velocities_mut().fill_with(&mut wild);
    mixture.water_mut().velocities_mut().fill_with(&mut wild);
    let mut rate = 0.0;
    for _ in 0..200 {
        mixture.evaluate().unwrap();
        let (soil, water) = (mixture.soil(), mixture.water());
        let (mut power, mut size, mut change) = (0.0, 0.0, 0.0);
        for (phase_v, phase_a, masses) in [
            (soil.velocities(), soil.accelerations(), soil.masses()),
            (water.velocities(), water.accelerations(), water.masses()),
        ] {
            for ((v, a), m) in phase_v.iter().zip(phase_a).zip(masses) {
                (power, size, change) = (power - m * v.dot(*a), size + m * v.norm2(), change + m * a.norm2());
            }
        }
        rate = power / size;
        let scale = (size / change).sqrt();
        let (on_soil, on_water) = (soil.accelerations().to_vec(), water.accelerations().to_vec());
        mixture.soil_mut().velocities_mut().iter_mut().zip(on_soil).for_each(|(v, a)| *v = a * scale);
        mixture.water_mut().velocities_mut().iter_mut().zip(on_water).for_each(|(v, a)| *v = a * scale);
    }
    rate
}

#[test]
fn reconstructed_drag_is_little_faster() {
    let (mut of_limit, mut of_plain) = (0.0_f64, 0.0_f64);
    for periodic in [true, false] {
        for of in [(1.3, 0.0, 0.5), (1.5, 0.4, 0.1), (2.0, 0.8, 0.5), (2.5, 0.0, 0.1)] {
            let mut plain = cloud(of, periodic);
            let (rate, limit) = (fastest(&mut plain), plain.limits().drag);
            assert!(rate * limit < 1.0 + 1e-9, "{of:?}: the limit of plain drag is safe: {}", rate * limit);
            let reconstructed = fastest(&mut cloud(of, periodic).with_reconstructed_drag());
            (of_limit, of_plain) = (of_limit.max(reconstructed * limit), of_plain.max(reconstructed / rate));
        }
    }
    assert!(of_limit > 1.0 && of_limit < 1.1, "of the plain limit: {of_limit}");
    assert!(of_plain > 1.0 && of_plain < 1.2, "of plain drag: {of_plain}");
}
