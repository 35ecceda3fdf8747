//! Weights of drag that add up to one around each soil particle.

use super::{Both, H, SIDE, SPACING, box_of, weight};
use alluvium::kernel::WendlandC2;
use alluvium::material::{DragLaw, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase};
use alluvium::time::{Evolve, Moment};
use alluvium::{Vector, setup};

/// The same drag wherever it is.
#[derive(Debug)]
struct Constant;

const C: f64 = 1e5;

impl DragLaw<f64> for Constant {
    fn coefficient(&self, _: f64, _: f64, _: f64) -> f64 {
        C
    }
    fn knows_slip(&self) -> bool {
        false
    }
}

/// Soil at rest, water at 1 mm/s, both in disorder.
fn cloud(scheme: DragScheme, is_normalised: bool) -> Both<f64> {
    let mut state = 5_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        0.5 * SPACING * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
    };
    let mut mixture = box_of(1.0, scheme, 0.0, |_| Vector::zero(), |_| Vector([1e-3, 0.0]));
    for x in mixture.soil_mut().positions_mut().iter_mut() {
        *x += Vector([random(), random()]);
    }
    for x in mixture.water_mut().positions_mut().iter_mut() {
        *x += Vector([random(), random()]);
    }
    mixture = mixture.with_drag(Constant);
    if is_normalised { mixture.with_normalised_drag() } else { mixture }
}

/// Drag on each soil particle over C_d times the slip, less one: the largest; and what is left of momentum.
fn error(scheme: DragScheme, is_normalised: bool) -> [f64; 2] {
    let at_rest = |mut mixture: Both<f64>| {
        mixture.water_mut().set_velocity(|_| Vector::zero());
        mixture.evaluate().unwrap();
        mixture
    };
    let without = at_rest(cloud(scheme, is_normalised));
    let mut mixture = cloud(scheme, is_normalised);
    mixture.evaluate().unwrap();
    // So short that implicit drag is explicit.
    mixture.complete(Moment::Now, 1e-12).unwrap();
    let (soil, water) = (mixture.soil(), mixture.water());
    let (mut worst, mut momentum, mut size) = (0.0_f64, Vector([0.0; 2]), 0.0);
    for i in 0..soil.len() {
        let a = soil.accelerations()[i] - without.soil().accelerations()[i];
        worst = worst.max((a[0] * soil.density(i) / (C * 1e-3) - 1.0).abs());
        momentum += a * soil.masses()[i];
        size += a.norm() * soil.masses()[i];
    }
    for a in 0..water.len() {
        momentum += (water.accelerations()[a] - without.water().accelerations()[a]) * water.masses()[a];
    }
    [worst, momentum.norm() / size]
}

#[test]
fn normalised_weights_make_drag_on_soil_exact_in_disorder() {
    for scheme in [DragScheme::Explicit, DragScheme::BackwardEuler] {
        let ([plain, _], [normalised, momentum]) = (error(scheme, false), error(scheme, true));
        assert!(plain > 1e-2, "{scheme:?}: plain weights are off by {plain:e} only");
        assert!(normalised < 1e-7 && momentum < 1e-9, "{scheme:?}: {normalised:e}, momentum {momentum:e}");
    }
}

#[test]
fn soil_with_little_water_around_keeps_its_weights() {
    // Water in the lower half of the box only.
    let lone = |is_normalised: bool| {
        let places = setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING);
        let volume = SPACING * SPACING;
        let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
        let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
        soil.add(&places, volume, |_| 0.0).unwrap();
        soil.set_volume_fraction(|_| 0.5);
        let low: Vec<_> = places.iter().copied().filter(|x| x[1] < 0.5 * SIDE).collect();
        let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
        water.add(&low, volume, |_| 0.0).unwrap();
        water.set_velocity(|_| Vector([1e-3, 0.0]));
        let mixture = Mixture::new(WendlandC2::new(H).unwrap(), soil, water).with_drag(Constant);
        let mut mixture = if is_normalised { mixture.with_normalised_drag() } else { mixture };
        mixture.evaluate().unwrap();
        mixture
    };
    let (plain, normalised) = (lone(false), lone(true));
    let (mut kept, mut changed) = (0, 0);
    for i in 0..plain.soil().len() {
        let water = plain.water();
        let filled: f64 = (0..water.len()).map(|a| water.volume(a) * weight(&plain, i, a)).sum();
        let [x, y] = plain.soil().positions()[i].0;
        let [a, b] = [&plain, &normalised].map(|of| of.soil().accelerations()[i][0]);
        // At the rims the images of the box, which this one has not, count in `weight`.
        if y > 0.5 * SIDE && filled > 1e-3 {
            assert_eq!(a, b, "{filled} filled");
            kept += 1;
        } else if (0.2..0.28).contains(&y) && (0.16..0.44).contains(&x) {
            assert!((b / a - 1.0 / filled).abs() < 1e-9 || (b - a).abs() < 1e-12, "{a} {b} {filled}");
            changed += 1;
        }
    }
    assert!(kept > 10 && changed > 10, "{kept} {changed}");
}
