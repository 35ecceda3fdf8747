//! What a case says of drag and of its steps before it runs.

use crate::case_mixture::JET;
use crate::case_soil::read;
use alluvium::case::{Case, StepLimit};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, DragLaw, Ergun, Forchheimer, KozenyCarman, NoDrag, PoreFluid};
use alluvium::mixture::DragScheme;
use alluvium::time::{LeapFrog, Limit};

/// The jet with another law of drag, in water of this viscosity.
fn dragged_by(law: &str, viscosity: f64) -> String {
    let sound = "sound_speed_m_per_s = 250.0\n";
    JET.replace("hydraulic_conductivity_m_per_s = 5e-4\n", law)
        .replace(sound, &format!("{sound}viscosity_pa_s = {viscosity:?}\n"))
}

#[test]
fn every_law_of_drag_is_the_same_again_and_that_of_the_library() {
    let (fluid, seepage) = (PoreFluid::new(1000.0, 9.81, 1e-3).unwrap(), Conductivity::new(2e-3).unwrap());
    let k = "hydraulic_conductivity_m_per_s = 2e-3\n";
    let permeability = seepage.permeability(&fluid).unwrap();
    let laws: [(String, Box<dyn DragLaw<f64>>); 8] = [
        ("drag = \"none\"\n".to_owned(), Box::new(NoDrag)),
        (k.to_owned(), Box::new(Darcy::new(seepage))),
        (
            format!("intrinsic_permeability_m2 = {:?}\n", permeability.square_metres()),
            Box::new(Darcy::new(permeability.conductivity(&fluid).unwrap())),
        ),
        (
            "drag = \"kozeny-carman\"\ngrain_diameter_m = 1e-3\n".to_owned(),
            Box::new(KozenyCarman::of_grains(1e-3, 1e-3).unwrap()),
        ),
        // Measured where the soil begins, unless told otherwise.
        (format!("drag = \"kozeny-carman\"\n{k}"), Box::new(KozenyCarman::measured(seepage, 0.5).unwrap())),
        (
            format!("drag = \"kozeny-carman\"\n{k}reference_porosity = 0.4\n"),
            Box::new(KozenyCarman::measured(seepage, 0.4).unwrap()),
        ),
        ("drag = \"ergun\"\ngrain_diameter_m = 1e-3\n".to_owned(), Box::new(Ergun::new(1e-3, 1e-3).unwrap())),
        (format!("drag = \"forchheimer\"\n{k}"), Box::new(Forchheimer::new(seepage, &fluid, 0.55).unwrap())),
    ];
    for (text, law) in laws {
        let case = read(&dragged_by(&text, 1e-3)).0;
        assert_eq!(read(&case.to_string()).0, case, "{text}");
        let built = case.mixture::<f64, 2, _>(WendlandC2::new(case.smoothing_length()).unwrap()).unwrap();
        assert_eq!(built.drag_law().describe(), law.describe());
        for slip in [0.0, 0.3] {
            let found = built.drag_law().coefficient(0.45, 998.0, slip);
            assert!((found - law.coefficient(0.45, 998.0, slip)).abs() <= 1e-12 * found, "{text}");
        }
    }
    let thin = dragged_by("drag = \"ergun\"\ngrain_diameter_m = 1e-3\n", 0.0);
    let error = Case::parse("case.toml", &thin).expect_err("no viscosity");
    assert!(error.problems.iter().any(|p| p.key == "water.viscosity_pa_s"), "{error}");
}

#[test]
fn the_scheme_of_drag_follows_its_stiffness() {
    let plan = |text: &str| read(text).0.drag_plan().unwrap();
    let at = |k: &str| JET.replace("5e-4", k);
    // Of Table 3's soil and water at k = 5e-4 m/s.
    let paper = plan(&at("5e-4"));
    let c: f64 = 0.25 * 1000.0 * 9.81 / 5e-4;
    let stopping_time = 1.0 / (c * (1.0 / 500.0 + 1.0 / 1350.0));
    assert!((paper.stopping_time / stopping_time - 1.0).abs() < 1e-12);
    // m₂ = 5/18 of Wendland's C2 in the plane.
    let viscosity = 5.0 / 18.0 * 0.015 * 0.015 * c / 1850.0;
    assert!((paper.spurious_viscosity / viscosity - 1.0).abs() < 1e-8);
    assert_eq!(plan(&at("5e-3")).scheme, DragScheme::Explicit);
    assert_eq!(plan(&at("1e-6")).scheme, DragScheme::BackwardEuler);
    let said = |scheme: &str| {
        plan(&at("1e-6").replace("[mixture]\n", &format!("[mixture]\ndrag_scheme = \"{scheme}\"\n")))
    };
    assert_eq!(said("explicit").scheme, DragScheme::Explicit);
    assert_eq!(said("second-order").scheme, DragScheme::SecondOrder);
    assert_eq!(plan(&format!("preset = \"paper\"\n{}", at("1e-6"))).scheme, DragScheme::Explicit);
}

#[test]
fn a_fixed_step_beyond_half_of_what_pores_bear_is_doubtful() {
    let of = |fraction: &str, step: &str| {
        let text = JET.replace("volume_fraction = 0.5", &format!("volume_fraction = {fraction}"));
        assert!(!text.contains("[time]"));
        let (_, warnings) = read(&format!("{text}\n[time]\ntime_step_s = {step}\n"));
        let of_the_step = warnings.problems.iter().find(|p| p.key == "time.time_step_s");
        of_the_step.map(|p| p.what.clone())
    };
    // h φ/c is 3e-5 s at φ = 0.5, and h/c 5.5e-5 s.
    assert_eq!(of("0.5", "1.4e-5"), None);
    assert!(of("0.5", "1.6e-5").unwrap().contains("h φ/c of the water in the pores = 3.000e-5 s"));
    assert!(of("0.01", "2.8e-5").unwrap().contains("half of h/c = 5."));
}

#[test]
fn what_reconstruction_changes_is_told_before() {
    let plan = |text: &str| (read(text).0.drag_plan().unwrap(), read(text).0.step_limits());
    let explicit = JET.replacen("[mixture]", "[mixture]\ndrag_scheme = \"explicit\"", 1);
    let (plain, limits) = plan(&explicit);
    let (told, shorter) = plan(&explicit.replacen("[mixture]", "[mixture]\nreconstructed_drag = true", 1));
    assert!(told.is_reconstructed && !plain.is_reconstructed);
    assert_eq!(told.spurious_viscosity, plain.spurious_viscosity, "what there would be");
    let drag = |limits: &[StepLimit]| limits.iter().find(|limit| limit.name == "drag").unwrap().step;
    assert!((drag(&limits) / drag(&shorter) - 1.1).abs() < 1e-12, "a tenth shorter");
}

#[test]
fn every_limit_of_the_step_is_told_before() {
    let case = read(JET).0;
    let limits = case.step_limits();
    let speed = |name: &str| {
        let limit = limits.iter().find(|limit| limit.name == name).unwrap();
        0.2 * case.smoothing_length() / limit.step
    };
    // Table 3: 273 m/s drained, 349.5 m/s with the water in it.
    assert!((speed("acoustic (water)") - 250.0).abs() < 1e-9);
    assert!((speed("acoustic (soil)") - 273.5).abs() < 0.5, "{}", speed("acoustic (soil)"));
    assert!((speed("acoustic (water in pores)") * 0.5 / 0.2 - 500.0).abs() < 1e-9, "c/φ");
    let together = speed("acoustic (soil and water as one)");
    assert!((together - 349.5).abs() < 0.5, "{together}");
    let names: Vec<_> = limits.iter().map(|limit| limit.name).collect();
    assert!(names.contains(&"viscous") && names.contains(&"force") && names.contains(&"drag"));
}

#[test]
fn a_stiff_case_runs_at_the_step_of_sound() {
    let case = read(&JET.replace("5e-4", "1e-8")).0;
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).unwrap();
    let mut run = case.simulation(kernel, LeapFrog::new());
    if cfg!(feature = "implicit") {
        let run = run.as_mut().unwrap();
        for _ in 0..3 {
            assert_eq!(run.step().unwrap().limit, Limit::Acoustic);
        }
    }
    let solved = read(&JET.replace("[mixture]\n", "[mixture]\ndrag_scheme = \"backward-euler\"\n")).0;
    let built = solved.simulation(kernel, LeapFrog::new());
    assert_eq!(built.is_ok(), cfg!(feature = "implicit"));
    if let Err(error) = built {
        assert!(error.to_string().contains("feature `implicit`"), "{error}");
    }
}
