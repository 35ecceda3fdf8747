//! Return mapping onto each surface, judged by what characterises it, not by the formulas it uses.

use alluvium::SymTensor;
use alluvium::material::{Cone, DruckerPrager, Elasticity, Flow, MohrCoulomb, Place, Returned, YieldSurface};
use proptest::prelude::*;

fn elasticity() -> Elasticity<f64> {
    Elasticity::new(10e6, 0.3).unwrap()
}

fn cone(dilatancy: f64) -> DruckerPrager<f64> {
    DruckerPrager::cohesive(Cone::TriaxialCompression, 0.5, dilatancy, 200.0).unwrap()
}

/// `α_ψ = α_θ`.
fn associated_cone() -> DruckerPrager<f64> {
    cone(0.5)
}

fn pyramid(dilatancy: f64) -> MohrCoulomb<f64> {
    MohrCoulomb::cohesive(0.5, dilatancy, 200.0).unwrap()
}

/// `τ:τ/2G + p²/K` \[J/m³\], twice the energy: the measure of distance in return mapping.
fn product(a: &SymTensor<f64>, b: &SymTensor<f64>) -> f64 {
    a.double_dot(&elasticity().strain(b))
}

/// A stress of size `size` about a pressure of 1 kPa.
fn stress(values: [f64; 6], size: f64) -> SymTensor<f64> {
    SymTensor(values.map(|x| x * 10_f64.powf(size))) - SymTensor::isotropic(1e3)
}

/// With associated flow the return is the nearest admissible stress: every other one lies behind the
/// plane through it (the principle of maximum dissipation). Faces, edges, apex and cut-off alike.
fn is_nearest<Y: YieldSurface<f64>>(
    surface: &Y,
    trial: &SymTensor<f64>,
    other: &SymTensor<f64>,
) -> Result<Place, TestCaseError> {
    let Returned { stress, place } = surface.returned(&elasticity(), trial);
    let scale = stress.root_j2() + stress.trace().abs() + 200.0;
    prop_assert!(surface.excess(&stress) <= 1e-12 * scale, "{place:?}: F = {:e}", surface.excess(&stress));
    let other = surface.scaled_back(other).stress;
    let (towards, aside) = (*trial - stress, other - stress);
    // Both may be the apex, and nothing is aside.
    let (along, most) =
        (product(&towards, &aside), (product(&towards, &towards) * product(&aside, &aside)).sqrt());
    prop_assert!(place == Place::Inside || along <= 1e-6 * most, "{place:?}: another is nearer, {along}");
    Ok(place)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn an_associated_return_finds_the_nearest_stress(
        trial in prop::array::uniform6(-1.0..1.0_f64), size in 2.0..5.0_f64,
        other in prop::array::uniform6(-1.0..1.0_f64), reach in 2.0..5.0_f64,
    ) {
        let (trial, other) = (stress(trial, size), stress(other, reach));
        is_nearest(&associated_cone(), &trial, &other)?;
        is_nearest(&pyramid(0.5), &trial, &other)?;
    }

    /// The plastic strain of the pyramid is a sum, with no negative part, of the normals of its planes:
    /// its trace is 2 sin ψ/(1 + sin ψ) of what it extends.
    #[test]
    fn the_pyramid_dilates_by_its_dilatancy(
        trial in prop::array::uniform6(-1.0..1.0_f64), size in 2.0..5.0_f64, dilatancy in 0.0..0.5_f64,
    ) {
        let trial = stress(trial, size);
        let Returned { stress, place } = pyramid(dilatancy).returned(&elasticity(), &trial);
        prop_assume!(matches!(place, Place::Face | Place::Edge));
        let strain = elasticity().strain(&(trial - stress));
        let extends: f64 = principal(&strain).iter().map(|x| x.max(0.0)).sum();
        let sin = dilatancy.sin();
        let expected = 2.0 * sin / (1.0 + sin) * extends;
        prop_assert!((strain.trace() - expected).abs() < 1e-9 * extends.max(1e-6), "{place:?}: {} for {expected}", strain.trace());
    }

    /// The iteration that a surface gets without a closed form goes where the closed form does.
    #[test]
    fn cutting_planes_and_closed_forms_agree_on_smooth_parts(
        trial in prop::array::uniform6(-1.0..1.0_f64), size in 2.0..4.0_f64, dilatancy in 0.0..0.5_f64,
    ) {
        let trial = stress(trial, size);
        agree(cone(dilatancy), &trial)?;
        agree(pyramid(dilatancy), &trial)?;
    }

    /// Scaling back: the deviator's direction and the pressure stay.
    #[test]
    fn scaling_back_leaves_the_pressure(trial in prop::array::uniform6(-1.0..1.0_f64), size in 2.0..5.0_f64) {
        let trial = stress(trial, size);
        for (back, surface) in [(cone(0.0).scaled_back(&trial), 0), (pyramid(0.0).scaled_back(&trial), 1)] {
            let excess = if surface == 0 { cone(0.0).excess(&back.stress) } else { pyramid(0.0).excess(&back.stress) };
            prop_assert!(excess <= 1e-12 * (back.stress.root_j2() + back.stress.trace().abs() + 200.0));
            if back.place == Place::Face {
                prop_assert!((back.stress.trace() - trial.trace()).abs() < 1e-9 * trial.trace().abs().max(1.0));
                let ratio = back.stress.root_j2() / trial.root_j2();
                let apart = back.stress.deviator() - trial.deviator() * ratio;
                prop_assert!(apart.root_j2() < 1e-9 * trial.root_j2());
            }
        }
    }
}

/// A surface without its own returns.
#[derive(Clone, Debug)]
struct Plain<Y>(Y);

impl<Y: YieldSurface<f64>> YieldSurface<f64> for Plain<Y> {
    fn excess(&self, stress: &SymTensor<f64>) -> f64 {
        self.0.excess(stress)
    }
    fn flow(&self, stress: &SymTensor<f64>) -> Flow<f64> {
        self.0.flow(stress)
    }
    fn largest_tension(&self) -> f64 {
        self.0.largest_tension()
    }
}

fn agree<Y: YieldSurface<f64>>(surface: Y, trial: &SymTensor<f64>) -> Result<(), TestCaseError> {
    let closed = surface.returned(&elasticity(), trial);
    if closed.place != Place::Face {
        return Ok(());
    }
    let iterated = Plain(surface).returned(&elasticity(), trial);
    let apart = (closed.stress - iterated.stress).root_j2() + (closed.stress - iterated.stress).trace().abs();
    prop_assert!(apart < 1e-8 * (trial.root_j2() + 1e3), "{apart:e} Pa apart");
    Ok(())
}

/// Principal values by the trigonometric formula.
fn principal(tensor: &SymTensor<f64>) -> [f64; 3] {
    let (mean, tau, size) = (tensor.trace() / 3.0, tensor.deviator(), tensor.root_j2());
    let [a, b, c, d, e, f] = tau.0;
    let determinant = a * b * c + 2.0 * d * e * f - a * e * e - b * f * f - c * d * d;
    let cosine = (0.5 * determinant * (3.0 / (size * size)).powf(1.5)).clamp(-1.0, 1.0);
    let third = core::f64::consts::TAU / 3.0;
    [0.0, third, -third].map(|turn| mean + 2.0 * size / 3.0_f64.sqrt() * (cosine.acos() / 3.0 + turn).cos())
}

#[test]
fn every_part_of_the_surfaces_is_met() {
    let mut met = [0; 4];
    let places = [Place::Inside, Place::Face, Place::Edge, Place::Apex];
    for k in 0..4000_u32 {
        let at = |salt: f64| (f64::from(k) * salt).sin();
        let values = [at(1.1), at(2.3), at(3.7), at(0.7), at(5.1), at(4.3)];
        let trial = stress(values, 2.0 + 1.5 * at(0.01).abs()) + SymTensor::isotropic(5e3 * at(0.3));
        let place = pyramid(0.2).returned(&elasticity(), &trial).place;
        met[places.iter().position(|known| *known == place).unwrap()] += 1;
    }
    assert!(met.iter().all(|&count| count > 40), "{met:?}");
}

#[test]
fn the_pyramid_meets_the_cones_where_they_are_named_for() {
    let theta = 0.5_f64;
    let named =
        [(Cone::TriaxialCompression, [-1.0, -1.0, -4.0]), (Cone::TriaxialExtension, [-4.0, -4.0, -1.0])];
    for (kind, direction) in named {
        let cone = DruckerPrager::cohesive(kind, theta, 0.0, 200.0).unwrap();
        let pyramid = MohrCoulomb::cohesive(theta, 0.0, 200.0).unwrap();
        let [x, y, z] = direction;
        let out = SymTensor([x, y, z, 0.0, 0.0, 0.0]) * 1e3;
        let (a, b) = (cone.scaled_back(&out).stress, pyramid.scaled_back(&out).stress);
        assert!((a - b).root_j2() < 1e-9, "{kind:?}: {a:?} and {b:?}");
        assert!((cone.largest_tension() / pyramid.largest_tension() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn tension_is_cut_off_where_it_is_told_to() {
    let limit = 50.0;
    let surface = cone(0.2).with_tension_cut_off(limit).unwrap();
    let torn = SymTensor([700.0, 100.0, 300.0, 20.0, 0.0, 0.0]);
    let back = surface.returned(&elasticity(), &torn);
    assert_eq!(back.place, Place::CutOff);
    assert!((back.stress.trace() / 3.0 - limit).abs() < 1e-12);
    assert!(surface.excess(&back.stress) <= 1e-12 * limit);
    // The shear that the cone bears there stays.
    let strength = surface.cohesion() - 3.0 * surface.friction() * limit;
    let expected = torn.root_j2().min(strength);
    assert!((back.stress.root_j2() / expected - 1.0).abs() < 1e-12);
    assert!(cone(0.2).with_tension_cut_off(f64::NAN).is_err());
}

#[test]
fn without_friction_the_cone_is_a_cylinder() {
    let surface = DruckerPrager::cohesive(Cone::PlaneStrain, 0.0, 0.0, 300.0).unwrap();
    let trial = stress([0.3, -0.2, 0.9, 0.4, -0.7, 0.1], 6.0);
    let back = surface.returned(&elasticity(), &trial);
    assert_eq!(back.place, Place::Face);
    assert!((back.stress.root_j2() / 300.0 - 1.0).abs() < 1e-12);
    let torn = SymTensor::isotropic(1e9);
    assert_eq!(surface.returned(&elasticity(), &torn), Returned::inside(torn));
}

#[test]
fn a_stress_that_is_not_finite_is_left_for_others_to_find() {
    let trial = SymTensor([f64::NAN, 1.0, 2.0, f64::INFINITY, 0.0, 0.0]);
    assert_eq!(pyramid(0.0).returned(&elasticity(), &trial).place, Place::Inside);
    assert_eq!(cone(0.0).returned(&elasticity(), &trial).place, Place::Inside);
}
