//! The law of soil against its equations, where a path through the driver would not show it.

use alluvium::driver::{Driver, Kind, Leg, Path};
use alluvium::material::{
    Cone, DruckerPrager, Elasticity, Flow, LateralRatio, Material, Memory, Plasticity, Soil, SoilMemory,
    Unyielding, YieldSurface,
};
use alluvium::{SymTensor, Tensor};
use proptest::prelude::*;

fn elasticity() -> Elasticity<f64> {
    Elasticity::new(0.84e6, 0.3).unwrap()
}

fn cone(friction: f64, dilatancy: f64) -> DruckerPrager<f64> {
    DruckerPrager::new(Cone::PlaneStrainAssociated, friction.to_radians(), dilatancy.to_radians()).unwrap()
}

fn soil(cone: DruckerPrager<f64>) -> Soil<f64> {
    Soil::new(2650.0, elasticity(), cone).unwrap()
}

/// A compressed stress with `√J₂` as large as this cone bears.
fn yielding(surface: &DruckerPrager<f64>) -> SymTensor<f64> {
    let tau = SymTensor([-3.0, 1.0, 2.0, 0.7, -0.4, 1.1]);
    let (p, size) = (2e3, tau.root_j2());
    tau * (3.0 * surface.friction() * p / size) - SymTensor::isotropic(p)
}

const GRADIENT: Tensor<f64> = Tensor([[-0.3, 0.8, 0.1], [0.2, 0.1, -0.5], [0.4, 0.3, 0.05]]);

#[test]
fn moduli_are_those_of_young_and_poisson() {
    let elasticity = elasticity();
    assert!((elasticity.bulk() - 0.84e6 / (3.0 * 0.4)).abs() < 1e-9);
    assert!((elasticity.shear() - 0.84e6 / 2.6).abs() < 1e-9);
    assert!((elasticity.youngs_modulus() / 0.84e6 - 1.0).abs() < 1e-14);
    let same = Elasticity::from_bulk(0.7e6_f64, 0.3).unwrap();
    assert!((same.youngs_modulus() / 0.84e6 - 1.0).abs() < 1e-14);
    let strain = SymTensor([1e-3, -2e-3, 4e-4, 7e-4, -1e-4, 3e-4]);
    let back = elasticity.strain(&elasticity.stress(&strain));
    assert!(back.0.iter().zip(strain.0).all(|(a, b)| (a - b).abs() < 1e-18), "{back:?}");
    let energy = 0.5 * strain.double_dot(&elasticity.stress(&strain));
    assert!((elasticity.energy(&elasticity.stress(&strain)) / energy - 1.0).abs() < 1e-13);
}

/// (31), (32) and (36), written out as printed, for the associated cone.
#[test]
fn the_general_rate_is_the_printed_one_for_a_cone() {
    for (friction, dilatancy) in [(19.8, 19.8), (25.0, 25.0), (25.0, 0.0), (30.0, 12.0)] {
        let surface = cone(friction, dilatancy);
        let (a, b) = (surface.friction(), surface.dilatancy());
        let (k, g) = (elasticity().bulk(), elasticity().shear());
        let memory = SoilMemory::stressed(yielding(&surface));
        let (tau, shear) = (memory.stress.deviator(), memory.stress.root_j2());
        let stretch = GRADIENT.symmetric();
        let load = 3.0 * a * k * stretch.trace() + g / shear * tau.double_dot(&stretch);
        let sign = if load > 0.0 { 1.0 } else { -1.0 };
        let gradient = Tensor(GRADIENT.0.map(|row| row.map(|x| x * sign)));
        let stretch = stretch * sign;
        let multiplier = load.abs() / (9.0 * a * b * k + g);
        let law = soil(surface).with_plasticity(Plasticity::Rate);
        let rate = law.rate(&gradient, &memory);
        let pressure = -k * stretch.trace() + 3.0 * multiplier * b * k;
        assert!((rate.pressure() / pressure - 1.0).abs() < 1e-12, "{} for {pressure}", rate.pressure());
        let spin = gradient.spin();
        let expected = tau.turning(&spin) + stretch.deviator() * (2.0 * g) - tau * (multiplier * g / shear);
        for (value, expected) in rate.stress.deviator().0.iter().zip(expected.0) {
            assert!((value - expected).abs() < 1e-12 * k, "{value} for {expected}");
        }
        // (79): λ̇ τ^xy / 2√J₂.
        let shear_rate = multiplier * tau.0[3] / (2.0 * shear);
        assert!((rate.plastic_strain.0[3] / shear_rate - 1.0).abs() < 1e-12);
        let lost = law.power_lost(&stretch, &tau, &memory).plastic;
        let expected = -multiplier * (a - b) * memory.stress.trace();
        assert!((lost - expected).abs() < 1e-10 * k, "{lost} for {expected}");
        assert!(dilatancy != friction || lost.abs() < 1e-10 * k, "associated without cohesion loses nothing");
    }
}

/// (34) with the spin of (35), as products of matrices.
#[test]
fn the_jaumann_rate_is_spin_times_stress_less_stress_times_spin() {
    let stress = yielding(&cone(25.0, 0.0));
    let gradient = GRADIENT.0;
    let omega = |a: usize, b: usize| 0.5 * (gradient[a][b] - gradient[b][a]);
    let sigma = |a: usize, b: usize| stress.0[SymTensor::<f64>::index(a, b)];
    let turning = stress.turning(&GRADIENT.spin());
    for a in 0..3 {
        for b in 0..3 {
            let expected: f64 = (0..3).map(|c| sigma(a, c) * omega(b, c) + sigma(c, b) * omega(a, c)).sum();
            let value = turning.0[SymTensor::<f64>::index(a, b)];
            assert!((value - expected).abs() < 1e-10, "{a}{b}: {value} for {expected}");
        }
    }
}

#[test]
fn unloading_is_elastic_and_so_is_soil_that_does_not_yield() {
    let surface = cone(25.0, 25.0);
    let memory = SoilMemory::stressed(yielding(&surface));
    let stretch = memory.stress.deviator() * -1e-6;
    let gradient =
        Tensor::embed(&[0, 1, 2].map(|a| [0, 1, 2].map(|b| stretch.0[SymTensor::<f64>::index(a, b)])));
    let rate = soil(surface).with_plasticity(Plasticity::Rate).rate(&gradient, &memory);
    assert_eq!(rate.plastic_strain, SymTensor::zero());
    let elastic = Soil::new(2650.0, elasticity(), Unyielding).unwrap();
    assert_eq!(elastic.rate(&gradient, &memory).stress, rate.stress);
    let torn = SoilMemory::stressed(SymTensor::isotropic(1e9));
    assert_eq!(elastic.admit(torn).0, torn);
}

/// A hundred-thousandth inside the surface, where steps along it end.
#[test]
fn only_to_the_letter_is_a_stress_just_inside_the_surface_elastic() {
    let surface = cone(25.0, 25.0);
    let law = |plasticity| soil(surface).with_plasticity(plasticity);
    let flows = |plasticity, part: f64| {
        let on = yielding(&surface);
        let memory = SoilMemory::stressed(on - on.deviator() * part);
        let stretch = on.deviator() * 1e-6;
        let gradient =
            Tensor::embed(&[0, 1, 2].map(|a| [0, 1, 2].map(|b| stretch.0[SymTensor::<f64>::index(a, b)])));
        law(plasticity).rate(&gradient, &memory).plastic_strain != SymTensor::zero()
    };
    assert!(flows(Plasticity::Rate, 1e-5) && !flows(Plasticity::LiteralRate, 1e-5));
    for plasticity in [Plasticity::Rate, Plasticity::LiteralRate] {
        assert!(flows(plasticity, -1e-5) && !flows(plasticity, 1e-2), "{plasticity:?}");
    }
}

/// At the apex rounding leaves a deviator, of which the flow must not make a direction.
#[test]
fn a_stress_without_shear_flows_without_shear() {
    let surface = DruckerPrager::cohesive(Cone::PlaneStrain, 0.4_f32, 0.1, 300.0).unwrap();
    for k in 1..1000 {
        let stress = SymTensor::isotropic(k as f32 * 0.7);
        assert_eq!(surface.flow(&stress).direction, SymTensor::isotropic(surface.dilatancy()), "{k}");
    }
}

#[test]
fn plastic_shear_cancels_in_a_cycle_and_its_equivalent_does_not() {
    let start = SoilMemory::stressed(SymTensor::isotropic(-1e3));
    let path = Path::new(Kind::PureShear, 0.01).cyclic(3);
    for plasticity in [Plasticity::ReturnMapping, Plasticity::Rate] {
        let law = soil(cone(25.0, 0.0)).with_plasticity(plasticity);
        let rows = Driver::new(law, start).run(&path, 500).unwrap();
        let equivalent = |row: usize| rows[row].memory.equivalent_plastic_strain;
        assert!((1..rows.len()).all(|row| equivalent(row) >= equivalent(row - 1)));
        let end = &rows[rows.len() - 1].memory;
        // γ = 0.04 in each of three cycles; yielding begins γ_y after the start and 2γ_y after each of
        // six turns.
        let yields = 3.0 * cone(25.0, 0.0).friction() * 1e3 / elasticity().shear();
        let exact = (0.12 - 13.0 * yields) / 3.0_f64.sqrt();
        let error = end.equivalent_plastic_strain / exact - 1.0;
        let bound = if plasticity == Plasticity::Rate { 0.01 } else { 1e-10 };
        assert!(error.abs() < bound, "{plasticity:?}: {error:e}");
        assert!(end.plastic_strain.0[3].abs() < 0.05 * end.equivalent_plastic_strain, "{plasticity:?}");
    }
}

#[test]
fn the_papers_correction_books_what_it_takes() {
    let surface = DruckerPrager::cohesive(Cone::PlaneStrain, 0.4, 0.0, 300.0).unwrap();
    let law = soil(surface).with_plasticity(Plasticity::Rate);
    let outside = SoilMemory::stressed(yielding(&surface) * 1.0 + yielding(&surface).deviator());
    let torn = SoilMemory::stressed(SymTensor([9e3, 8e3, 7e3, 500.0, 0.0, 0.0]));
    for (memory, is_torn) in [(outside, false), (torn, true)] {
        let (after, loss) = law.admit(memory);
        let stored = law.stored_energy(0.0, &memory) - law.stored_energy(0.0, &after);
        assert!((loss.total() / (2650.0 * stored) - 1.0).abs() < 1e-12);
        assert_eq!((loss.cut_off > 0.0, loss.scale_back > 0.0), (is_torn, !is_torn));
        assert_eq!(after.plastic_strain, SymTensor::zero());
        assert!(!is_torn || after.stress == SymTensor::isotropic(surface.largest_tension()));
    }
}

#[test]
fn the_printed_ratio_at_rest_lies_outside_the_papers_own_cone() {
    // Table 2 and Table 3: 14.3 % and 8.7 % of the vertical stress vanish at the first correction.
    for (friction, smallest, vanishes) in [(19.8, 0.5839, 0.143), (25.0, 0.5176, 0.087)] {
        let surface = cone(friction, friction);
        let ratio = LateralRatio::new(&elasticity(), &surface);
        assert!((ratio.printed - 3.0 / 7.0).abs() < 1e-12 && !ratio.printed_is_admissible());
        assert!((ratio.smallest - smallest).abs() < 5e-5, "{}", ratio.smallest);
        let law = soil(surface).with_plasticity(Plasticity::Rate);
        let vertical = |ratio: f64| {
            let memory = SoilMemory::geostatic(-1e3, ratio, 1);
            1.0 + law.admit(memory).0.stress.0[1] / 1e3
        };
        assert!((vertical(ratio.printed) - vanishes).abs() < 5e-4, "{}", vertical(ratio.printed));
        assert_eq!(vertical(ratio.admissible()), 0.0);
    }
    let strong = LateralRatio::new(&elasticity(), &cone(40.0, 0.0));
    assert!(strong.printed_is_admissible() && strong.admissible() == strong.printed);
}

#[test]
fn waves_and_names_are_as_documented() {
    // Table 3: E = 150 MPa, ν = 0.3, grains of 2700 kg/m³.
    let law = Soil::new(2700.0, Elasticity::new(150e6, 0.3).unwrap(), cone(25.0, 0.0)).unwrap();
    assert!((law.sound_speed() - 215.2).abs() < 0.1 && (law.fastest_wave() - 273.5).abs() < 0.1);
    let mut numbers = Vec::new();
    SoilMemory::stressed(yielding(law.surface())).show(&mut numbers);
    let shown: usize = <SoilMemory<f64> as Memory<f64>>::SHOWN.iter().map(|shown| shown.1).sum();
    assert_eq!(numbers.len(), shown);
    let row = Driver::new(law, SoilMemory::default()).row();
    assert_eq!(alluvium::driver::Row::<f64, SoilMemory<f64>>::names().len(), row.numbers().len());
}

#[test]
fn impossible_values_are_refused_with_name_and_value() {
    let e = |error: alluvium::error::ParameterError| (error.name, error.value);
    let surface = |friction: f64, dilatancy: f64, cohesion: f64| {
        e(DruckerPrager::cohesive(Cone::PlaneStrain, friction, dilatancy, cohesion).unwrap_err())
    };
    assert_eq!(e(Elasticity::new(-1.0_f64, 0.3).unwrap_err()), ("youngs_modulus", "-1".into()));
    assert_eq!(e(Elasticity::new(1e6_f64, 0.5).unwrap_err()), ("poissons_ratio", "0.5".into()));
    assert_eq!(e(Elasticity::from_bulk(1e6_f64, 0.5).unwrap_err()), ("poissons_ratio", "0.5".into()));
    assert_eq!(surface(25.0, 0.0, 0.0), ("friction_angle", "25".into()));
    assert_eq!(surface(0.4, 0.5, 0.0), ("dilatancy_angle", "0.5".into()));
    assert_eq!(surface(0.0, 0.0, 0.0), ("cohesion", "0".into()));
    assert_eq!(surface(0.4, 0.1, f64::NAN), ("cohesion", "NaN".into()));
    let soil = Soil::new(0.0, elasticity(), Unyielding).unwrap_err();
    assert_eq!(e(soil), ("reference_density", "0".into()));
}

#[test]
fn a_stress_that_the_law_does_not_bear_is_an_error() {
    use alluvium::driver::{Control, DriveError};
    let held = Control::Held;
    let none = Control::Strain(0.0);
    let leg = Leg::mixed([held, held, Control::Stress(-1e5), none, none, none]);
    let start = SoilMemory::stressed(SymTensor::isotropic(-1e3));
    let error = Driver::new(soil(cone(25.0, 0.0)), start).follow(&leg, 1000).unwrap_err();
    // It bears 932 Pa of difference (0.932 of the lateral stress), and each increment asks for 99 more.
    assert!(matches!(error, DriveError::StressNotFound { increment: 10, .. }), "{error}");
}

proptest! {
    /// The general multiplier's two normals are the derivatives of F.
    #[test]
    fn the_normal_is_the_derivative_of_the_yield_function(values in prop::array::uniform6(-1.0..1.0_f64)) {
        let surface = cone(25.0, 10.0);
        let stress = SymTensor(values) - SymTensor::isotropic(3.0);
        prop_assume!(stress.root_j2() > 0.05);
        let Flow { normal, .. } = surface.flow(&stress);
        for k in 0..6 {
            let moved = |by: f64| {
                let mut stress = stress;
                stress.0[k] += by;
                surface.excess(&stress)
            };
            // A shear component stands for two of the nine.
            let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5 * if k < 3 { 1.0 } else { 0.5 };
            prop_assert!((slope - normal.0[k]).abs() < 1e-6, "{k}: {slope} for {}", normal.0[k]);
        }
    }
}
