//! The law of water against its formulas.

use alluvium::material::{Material, Water};
use alluvium::{Real, SymTensor, Tensor};

fn water<T: Real>() -> Water<T> {
    Water::new(T::of(1000.0), T::of(25.0)).unwrap().with_viscosity(T::of(1e-3)).unwrap()
}

/// `B [(ρ̃/ρ̃₀)⁷ − 1]` with `B = ρ̃₀c²/7`.
fn tait(e: f64) -> f64 {
    1000.0 * 25.0_f64.powi(2) / 7.0 * (7.0 * e.ln_1p()).exp_m1()
}

const COMPRESSIONS: [f64; 7] = [-0.05, -1e-3, -1e-6, 1e-9, 1e-5, 1e-2, 0.1];

#[test]
fn pressure_is_the_printed_one() {
    for e in COMPRESSIONS {
        assert!((water::<f64>().pressure(e, &()) / tait(e) - 1.0).abs() < 1e-13, "{e}");
        // Single precision keeps its seven digits down to the smallest compression: no cancellation.
        let single = water::<f32>().pressure(e as f32, &());
        assert!((f64::from(single) / tait(f64::from(e as f32)) - 1.0).abs() < 2e-6, "{e}: {single}");
    }
}

#[test]
fn compression_is_its_inverse() {
    for e in COMPRESSIONS {
        let law = water::<f64>();
        let back = law.compression(law.pressure(e, &()));
        assert!((back / e - 1.0).abs() < 1e-12, "{e}: {back}");
    }
}

#[test]
fn pressure_rises_with_the_square_of_the_sound_speed() {
    let (law, step) = (water::<f64>(), 1e-6);
    let slope = (law.pressure(step, &()) - law.pressure(-step, &())) / (2.0 * step * 1000.0);
    assert!((slope / 625.0 - 1.0).abs() < 1e-9, "dp/dρ = {slope}");
    assert!((law.stiffness() - 1000.0 * 625.0 / 7.0).abs() < 1e-9);
}

#[test]
fn one_percent_of_density_at_a_tenth_of_the_sound_speed() {
    // The stagnation pressure of a flow at V = c/10 is ½ρ̃₀V²: half a percent of density; (18), (19).
    let e = water::<f64>().compression(0.5 * 1000.0 * 2.5 * 2.5);
    assert!((e / 0.005 - 1.0).abs() < 0.02, "{e}");
}

#[test]
fn stress_is_twice_the_viscosity_times_the_deviatoric_strain_rate() {
    let gradient = Tensor([[1.0, 2.0, 0.0], [-5.0, 3.0, 0.0], [0.0, 0.0, 0.0]]);
    let tau = water::<f64>().deviator(&gradient, &());
    let third = 2.0 / 3.0 * 4.0;
    // (15) written out: 2 ∂u/∂x − ⅔∇·v, …, ∂u/∂y + ∂v/∂x.
    let expected = SymTensor([2.0 - third, 6.0 - third, -third, -3.0, 0.0, 0.0]);
    for k in 0..6 {
        assert!((tau.0[k] - 1e-3 * expected.0[k]).abs() < 1e-17, "component {k}: {}", tau.0[k]);
    }
    let rotation = Tensor([[0.0, 7.0, 0.0], [-7.0, 0.0, 0.0], [0.0; 3]]);
    assert_eq!(water::<f64>().deviator(&rotation, &()), SymTensor::zero());
}

#[test]
fn the_stored_energy_is_the_work_of_pressure() {
    let law = water::<f64>();
    for e in [-0.01, 1e-3, 0.05] {
        let step = 1e-6;
        let slope = (law.stored_energy(e + step, &()) - law.stored_energy(e - step, &())) / (2.0 * step);
        // d(energy)/dρ̃ = p/ρ̃².
        let expected = law.pressure(e, &()) / (1000.0 * (1.0 + e).powi(2));
        assert!((slope / expected - 1.0).abs() < 1e-5, "{e}: {slope} for {expected}");
    }
}

#[test]
fn the_hydrostatic_slope_is_that_of_still_water() {
    let law = water::<f64>();
    let (value, bend) = law.hydrostatic_slope();
    let e = 1e-4;
    // dp = ρ̃ d(g·x) and p(e): d(ρ̃/ρ̃₀)/d(g·x) = ρ̃/(dp/de).
    let stiffness = (law.pressure(e + 1e-7, &()) - law.pressure(e - 1e-7, &())) / 2e-7;
    let exact = 1000.0 * (1.0 + e) / stiffness;
    assert!((value * (1.0 + bend * e) / exact - 1.0).abs() < 1e-6);
    assert!((value / exact - 1.0).abs() > 1e-4, "the bend matters at this compression");
}

#[test]
fn impossible_values_are_refused_with_name_value_and_range() {
    let errors = [
        Water::new(-1.0, 25.0).unwrap_err(),
        Water::new(1000.0, f64::NAN).unwrap_err(),
        water::<f64>().with_viscosity(-1e-3).unwrap_err(),
        water::<f64>().with_exponent(0).unwrap_err(),
    ];
    let said: Vec<_> = errors.iter().map(|e| (e.name, e.value.as_str())).collect();
    let expected = [
        ("reference_density", "-1"),
        ("sound_speed", "NaN"),
        ("viscosity", "-0.001"),
        ("tait_exponent", "0"),
    ];
    assert_eq!(said, expected);
}

#[test]
fn cavitating_water_keeps_its_pressure_and_stores_the_work_against_it() {
    let (law, free) = (water::<f64>().with_cavitation(-2e3).unwrap(), water::<f64>());
    let open = free.compression(-2e3);
    for e in [open + 1e-6, -1e-3, 0.0, 0.02] {
        assert_eq!(law.pressure(e, &()), free.pressure(e, &()));
        assert_eq!(law.stored_energy(e, &()), free.stored_energy(e, &()));
    }
    for e in [open - 1e-6, -0.01, -0.3] {
        assert_eq!(law.pressure(e, &()), -2e3);
        assert!(law.stored_energy(e, &()) < free.stored_energy(e, &()));
        // dE/dρ̃ = p/ρ̃².
        let (step, x) = (1e-8, 1.0 + e);
        let slope =
            (law.stored_energy(e + step, &()) - law.stored_energy(e - step, &())) / (2.0 * step * 1e3);
        assert!((slope * 1e6 * x * x / -2e3 - 1.0).abs() < 1e-5, "{e}: {slope}");
    }
    assert!(law.pressure(f64::NAN, &()).is_nan());
    for wrong in [1.0, f64::NAN, -1000.0 * 625.0 / 7.0] {
        let error = water::<f64>().with_cavitation(wrong).unwrap_err();
        assert!(error.to_string().contains("cavitation_pressure"), "{error}");
    }
    // A softer law no longer reaches it.
    let deep = water::<f64>().with_exponent(1).unwrap().with_cavitation(-5e5).unwrap();
    assert!(deep.with_exponent(7).is_err());
}
