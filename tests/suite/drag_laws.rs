//! Laws of drag: their values, where one becomes another, what they refuse.

use alluvium::Real;
use alluvium::material::{
    Conductivity, Darcy, DragLaw, Ergun, Forchheimer, KozenyCarman, NoDrag, Permeability, PoreFluid,
};

const DENSITY: f64 = 1000.0;
const VISCOSITY: f64 = 1e-3;

fn fluid<T: Real>() -> PoreFluid<T> {
    PoreFluid::new(T::of(DENSITY), T::of(9.81), T::of(VISCOSITY)).unwrap()
}

fn conductivity<T: Real>(k: f64) -> Conductivity<T> {
    Conductivity::new(T::of(k)).unwrap()
}

/// Relative difference of a law's coefficient from an expected one.
fn apart<T: Real>(law: &dyn DragLaw<T>, fraction: f64, slip: f64, expected: f64) -> f64 {
    let found = law.coefficient(T::of(fraction), T::of(DENSITY), T::of(slip)).as_f64();
    (found / expected - 1.0).abs()
}

const FRACTIONS: [f64; 4] = [0.2, 0.4, 0.55, 0.8];

fn laws_have_their_values<T: Real>(rounding: f64) {
    let (k, d) = (2e-3, 1e-3);
    for n in FRACTIONS {
        for slip in [0.0, 0.01, 3.0] {
            let seepage = n * slip;
            // φ times the pressure gradient over the slip, as the authors give the gradient over seepage.
            let darcy = n * DENSITY * 9.81 * n / k;
            assert!(apart::<T>(&Darcy::new(conductivity(k)), n, slip, darcy) < rounding);

            let kappa = d * d * n.powi(3) / (180.0 * (1.0 - n).powi(2));
            let law = KozenyCarman::of_grains(T::of(d), T::of(VISCOSITY)).unwrap();
            assert!(apart::<T>(&law, n, slip, n * n * VISCOSITY / kappa) < rounding);

            let viscous = 150.0 * VISCOSITY * (1.0 - n).powi(2) / (n.powi(3) * d * d);
            let inertial = 1.75 * DENSITY * (1.0 - n) / (n.powi(3) * d) * seepage;
            let law = Ergun::new(T::of(d), T::of(VISCOSITY)).unwrap();
            assert!(apart::<T>(&law, n, slip, n * n * (viscous + inertial)) < rounding);

            let kappa = k * VISCOSITY / (DENSITY * 9.81);
            let ward = VISCOSITY / kappa + 0.55 * DENSITY / kappa.sqrt() * seepage;
            let law = Forchheimer::new(conductivity(k), &fluid(), T::of(0.55)).unwrap();
            assert!(apart::<T>(&law, n, slip, n * n * ward) < rounding);
        }
    }
}

#[test]
fn coefficients_are_those_of_the_authors() {
    laws_have_their_values::<f64>(1e-13);
    laws_have_their_values::<f32>(2e-6);
}

#[test]
fn slow_flow_obeys_darcy() {
    let d = 5e-4;
    for n in FRACTIONS {
        let ergun = Ergun::new(d, VISCOSITY).unwrap();
        let permeability = Permeability::new(d * d * n * n * n / (150.0 * (1.0 - n) * (1.0 - n))).unwrap();
        let k = permeability.conductivity(&fluid()).unwrap();
        let darcy = Darcy::new(k).coefficient(n, DENSITY, 0.0);
        assert!(apart(&ergun, n, 0.0, darcy) < 1e-13);
        // The rest falls with the slip.
        let rest = |slip| apart(&ergun, n, slip, darcy);
        assert!((rest(1e-3) / rest(1e-5) - 100.0).abs() < 1e-4);
        let forchheimer = Forchheimer::new(k, &fluid(), 0.55).unwrap();
        assert!(apart(&forchheimer, n, 0.0, darcy) < 1e-13);
        // Carman's 180 for Ergun's 150.
        let carman = KozenyCarman::of_grains(d, VISCOSITY).unwrap();
        assert!(apart(&carman, n, 0.0, darcy * 1.2) < 1e-13);
    }
}

#[test]
fn a_measured_conductivity_holds_where_it_was_measured_and_follows_the_porosity() {
    let k = conductivity(1e-4);
    let (there, here) = (0.45, 0.35);
    let law = KozenyCarman::measured(k, there).unwrap();
    assert!(apart(&law, there, 0.0, Darcy::new(k).coefficient(there, DENSITY, 0.0)) < 1e-13);
    let f = |n: f64| n.powi(3) / (1.0 - n).powi(2);
    let scaled = conductivity(1e-4 * f(here) / f(there));
    assert!(apart(&law, here, 0.0, Darcy::new(scaled).coefficient(here, DENSITY, 0.0)) < 1e-13);
    // Constant conductivity is another law.
    assert!(apart(&law, here, 0.0, Darcy::new(k).coefficient(here, DENSITY, 0.0)) > 1.0);
}

#[test]
fn permeability_becomes_conductivity_through_a_fluid() {
    let k = Permeability::new(1e-12).unwrap().conductivity(&fluid()).unwrap();
    assert!((k.metres_per_second() / 9.81e-6 - 1.0).abs() < 1e-13);
    let back = k.permeability(&fluid()).unwrap();
    assert!((back.square_metres() / 1e-12 - 1.0).abs() < 1e-13);
    // Honey seeps slower through the same soil.
    let honey = PoreFluid::new(1400.0, 9.81, 10.0).unwrap();
    let slow = Permeability::new(1e-12).unwrap().conductivity(&honey).unwrap();
    assert!((slow.metres_per_second() / k.metres_per_second() - 1.4e-4).abs() < 1e-12);
}

#[test]
fn the_tangent_is_the_slope_of_the_force() {
    let ergun = Ergun::new(1e-3, VISCOSITY).unwrap();
    for slip in [0.0, 1e-3, 2.0] {
        let [a, b] = [0.0, slip].map(|s| ergun.coefficient(0.45, DENSITY, s));
        let slope = 2.0 * b - a; // of a s + (b − a) s, the second being quadratic
        let tangent = ergun.tangent(0.45, DENSITY, slip);
        assert!((tangent / slope - 1.0).abs() < 1e-12, "{tangent} for {slope} at {slip} m/s");
    }
    let darcy = Darcy::new(conductivity(1e-3));
    assert_eq!(darcy.tangent(0.45, DENSITY, 2.0), darcy.coefficient(0.45, DENSITY, 0.0));
}

#[test]
fn fractions_beyond_packed_grains_do_no_harm() {
    let laws: [Box<dyn DragLaw<f64>>; 6] = [
        Box::new(NoDrag),
        Box::new(Darcy::new(conductivity(1e-3))),
        Box::new(KozenyCarman::of_grains(1e-3, VISCOSITY).unwrap()),
        Box::new(KozenyCarman::measured(conductivity(1e-3), 0.4).unwrap()),
        Box::new(Ergun::new(1e-3, VISCOSITY).unwrap()),
        Box::new(Forchheimer::new(conductivity(1e-3), &fluid(), 0.55).unwrap()),
    ];
    for law in laws {
        for fraction in [-0.5, -1e-9, 0.0, 1e-9, 0.05, 1.0, 1.02] {
            let mut before = 0.0;
            for slip in [0.0, 1e-6, 1.0, 100.0] {
                let force = law.coefficient(fraction, DENSITY, slip) * slip;
                assert!(force.is_finite() && force >= before, "{} at φ = {fraction}", law.describe());
                before = force;
            }
        }
    }
}

#[test]
fn parameters_that_mean_nothing_are_refused_by_name() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Conductivity::new(bad).unwrap_err().name, "conductivity");
        assert_eq!(Permeability::new(bad).unwrap_err().name, "permeability");
        assert_eq!(Ergun::new(bad, 1e-3).unwrap_err().name, "grain_diameter");
        assert_eq!(Ergun::new(1e-3, bad).unwrap_err().name, "viscosity");
        assert_eq!(KozenyCarman::of_grains(bad, 1e-3).unwrap_err().name, "grain_diameter");
        assert_eq!(PoreFluid::new(1.0, bad, 1.0).unwrap_err().name, "gravity");
    }
    for bad in [0.0, 1.0, f64::NAN] {
        let error = KozenyCarman::measured(conductivity(1.0), bad).unwrap_err();
        assert_eq!(error.name, "reference_porosity");
    }
    let error = Forchheimer::new(conductivity(1.0), &fluid(), -1.0).unwrap_err();
    assert_eq!(error.name, "forchheimer_coefficient");
    // A permeability of clay is no number of f32 squared away, but its inverse root is.
    assert!(Permeability::new(1e-20_f32).is_ok());
}
