//! Cases of soil and water together: good ones give the same case again and the mixture they describe, broken
//! ones say where, what and what is allowed.

use crate::case_soil::{Mistake, each_is_named, read};
use crate::fingerprint;
use alluvium::case::{Case, Drag, Problem, SchemeChoice, Seepage, SoilLaw};
use alluvium::kernel::{QuinticSpline, WendlandC2};
use alluvium::mixture::{CouplingForm, Mixture, Slip, VolumeFraction, WallKind};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, LeapFrog, StepSize};

/// A jet on a saturated bed.
pub const JET: &str = include_str!("../../examples/jet.toml");

/// Water that seeps through held soil around an obstacle.
const TUBE: &str = r#"
name = "tube"
end_time_s = 0.1
[particles]
spacing_m = 0.05
[soil]
reference_density_kg_per_m3 = 2650.0
volume_fraction = 0.55
bulk_modulus_pa = 0.7e6
poissons_ratio = 0.3
yield_surface = "elastic"
[[soil.block]]
low_m = [0.5, 0.0]
high_m = [1.0, 0.4]
held = true
[[water.block]]
low_m = [0.0, 0.0]
high_m = [1.5, 0.4]
[mixture]
hydraulic_conductivity_m_per_s = 0.01
[tank]
low_m = [0.0, 0.0]
high_m = [1.5, 1.2]
open = ["+y"]
[[tank.obstacle]]
low_m = [0.5, 0.4]
high_m = [1.0, 1.2]
"#;

fn mixture(text: &str) -> Mixture<f64, 2, WendlandC2<f64, 2>, SoilLaw<f64>> {
    let case = read(text).0;
    case.mixture(WendlandC2::new(case.smoothing_length()).unwrap()).unwrap()
}

#[test]
fn the_case_is_the_same_again_with_every_default() {
    for text in [JET, include_str!("../../examples/jet_3d.toml"), TUBE] {
        let case = read(text).0;
        assert_eq!(read(&case.to_string()).0, case);
    }
    let case = read(TUBE).0;
    let mixing = case.mixing.clone().unwrap();
    assert_eq!(mixing.coupling, CouplingForm::PressureDifference);
    assert_eq!(mixing.drag, Drag::Darcy(Seepage::Conductivity(0.01)));
    let sound = case.water.as_ref().unwrap().sound_speed;
    assert!((mixing.relaxation_time - 200.0 * case.smoothing_length() / sound).abs() < 1e-12);
    // One and a half times the spacing of water in the soil.
    assert!((case.particles.smoothing_ratio - 1.5 / 0.45_f64.sqrt()).abs() < 1e-12);
    let paper = read(&format!("preset = \"paper\"\n{TUBE}")).0;
    let mixing = paper.mixing.unwrap();
    assert_eq!((mixing.coupling, mixing.relaxation_time), (CouplingForm::Printed, 0.0));
    assert_eq!(mixing.drag_scheme, SchemeChoice::Explicit);
    assert_eq!(paper.particles.smoothing_ratio, 1.0);
}

#[rustfmt::skip]
pub const MISTAKES: &[Mistake] = &[
    Mistake { from: "hydraulic_conductivity_m_per_s = 5e-4\n", to: "", key: "mixture.hydraulic_conductivity_m_per_s", value: "", what: "missing key", allowed: "[m/s]" },
    Mistake { from: "5e-4\n", to: "-5e-4\n", key: "mixture.hydraulic_conductivity_m_per_s", value: "-5e-4", what: "is out of range", allowed: "above 0.0" },
    Mistake { from: "[mixture]\n", to: "[mixture]\ndrag = \"none\"\n", key: "mixture.hydraulic_conductivity_m_per_s", value: "5e-4", what: "contradicts drag = \"none\"", allowed: "\"darcy\"" },
    Mistake { from: "[mixture]\n", to: "[mixture]\nintrinsic_permeability_m2 = 1e-11\n", key: "mixture.intrinsic_permeability_m2", value: "1e-11", what: "says a second time", allowed: "one of the two" },
    Mistake { from: "[mixture]\n", to: "[mixture]\ngrain_diameter_m = 1e-3\n", key: "mixture.grain_diameter_m", value: "1e-3", what: "contradicts drag = \"darcy\"", allowed: "\"ergun\"" },
    Mistake { from: "[mixture]\n", to: "[mixture]\ndrag = \"ergun\"\n", key: "mixture.hydraulic_conductivity_m_per_s", value: "5e-4", what: "contradicts drag = \"ergun\"", allowed: "\"forchheimer\"" },
    Mistake { from: "hydraulic_conductivity_m_per_s = 5e-4\n", to: "drag = \"ergun\"\n", key: "mixture.grain_diameter_m", value: "", what: "missing key", allowed: "[m]" },
    Mistake { from: "[mixture]\n", to: "[mixture]\ndrag = \"kozeny-carman\"\ngrain_diameter_m = 1e-3\n", key: "mixture.hydraulic_conductivity_m_per_s", value: "5e-4", what: "contradicts grain_diameter_m", allowed: "\"darcy\"" },
    Mistake { from: "[mixture]\n", to: "[mixture]\ndrag_scheme = \"implicit\"\n", key: "mixture.drag_scheme", value: "\"implicit\"", what: "is not a choice", allowed: "\"backward-euler\"" },
    Mistake { from: "[mixture]\n", to: "[mixture]\ncoupling = \"pressure difference\"\n", key: "mixture.coupling", value: "\"pressure difference\"", what: "did you mean \"pressure-difference\"?", allowed: "\"printed\"" },
    Mistake { from: "[mixture]\n", to: "[mixture]\nconductivity_m_per_s = 1.0\n", key: "mixture.conductivity_m_per_s", value: "1.0", what: "did you mean `hydraulic_conductivity_m_per_s`?", allowed: "density_relaxation_s" },
    Mistake { from: "volume_fraction = 0.5", to: "volume_fraction = 1.0", key: "soil.volume_fraction", value: "1.0", what: "leaves water 0.00 of the space", allowed: "0.95" },
    Mistake { from: "velocity_m_per_s = [0.0, -25.0]", to: "velocity_m_per_s = [1.0, -25.0]", key: "water.inflow[1].velocity_m_per_s", value: "[1.0, -25.0]", what: "is not along one of the axes", allowed: "one component" },
    Mistake { from: "high_m = [0.23, 0.26]", to: "high_m = [0.23, 0.22]", key: "water.inflow[1].high_m[2]", value: "0.22", what: "shorter than the support", allowed: "at least 0.03" },
    Mistake { from: "high_m = [0.23, 0.26]", to: "high_m = [0.234, 0.26]", key: "water.inflow[1].high_m[1]", value: "0.234", what: "does not hold a whole number of particles", allowed: "0.23" },
    Mistake { from: "high_m = [1e6, -0.2]", to: "high_m = [1e6, -1e7]", key: "outlet[1].high_m[2]", value: "-1e7", what: "is not above low_m", allowed: "above -1000000.0" },
    Mistake { from: "open = [\"+y\"]", to: "open = [\"+y\"]\nwater_slip = \"friction\"", key: "tank.water_slip", value: "\"friction\"", what: "is for soil", allowed: "\"free-slip\"" },
    Mistake { from: "high_m = [0.45, 0.18]\nopen", to: "high_m = [0.45, 0.18]\nobstacle = [{ low_m = [0.1, 0.1], high_m = [0.5, 0.18] }]\nopen", key: "tank.obstacle[1].high_m[1]", value: "0.5", what: "is outside the tank", allowed: "0.45" },
    Mistake { from: "hydraulic_conductivity_m_per_s = 5e-4\n", to: "drag = \"none\"\nprojected_drag = true\n", key: "mixture.projected_drag", value: "true", what: "contradicts drag = \"none\"", allowed: "another drag" },
    Mistake { from: "hydraulic_conductivity_m_per_s = 5e-4\n", to: "drag = \"none\"\nnormalised_drag = true\n", key: "mixture.normalised_drag", value: "true", what: "contradicts drag = \"none\"", allowed: "another drag" },
    Mistake { from: "[mixture]\n", to: "[mixture]\nprojected_drag = true\nreconstructed_drag = true\n", key: "mixture.reconstructed_drag", value: "true", what: "contradicts projected_drag", allowed: "projected_drag = false" },
    Mistake { from: "hydraulic_conductivity_m_per_s = 5e-4\n", to: "drag = \"none\"\nreconstructed_drag = true\n", key: "mixture.reconstructed_drag", value: "true", what: "contradicts drag = \"none\"", allowed: "another drag" },
    Mistake { from: "[mixture]\n", to: "[mixture]\nnormalised_drag = 1\n", key: "mixture.normalised_drag", value: "1", what: "is a whole number", allowed: "true or false" },
    Mistake { from: "[water]\n", to: "[water]\ncavitation_pressure_pa = 1.0\n", key: "water.cavitation_pressure_pa", value: "1.0", what: "is out of range", allowed: "0.0" },
    Mistake { from: "[water]\n", to: "[water]\ncavitation_pressure_pa = -1e7\n", key: "water.cavitation_pressure_pa", value: "-1e7", what: "is never reached", allowed: "-8.9286e6" },
    Mistake { from: "[mixture]\n", to: "[mixture]\nvolume_fraction = 0.5\n", key: "mixture.volume_fraction", value: "0.5", what: "is a number", allowed: "\"sum\"" },
    Mistake { from: "[particles]\n", to: "[particles]\ninterphase_smoothing_ratio = 0.5\n", key: "particles.interphase_smoothing_ratio", value: "0.5", what: "is out of range", allowed: "4.0" },
    Mistake { from: "smoothing_ratio = 1.5\n", to: "smoothing_ratio = 2.5\ninterphase_smoothing_ratio = 1.2\n", key: "particles.interphase_smoothing_ratio", value: "1.2", what: "less than half", allowed: "from 1.25" },
    Mistake { from: "[particles]\n", to: "[particles]\ngradient_correction = \"Bonet-Lok\"\n", key: "particles.gradient_correction", value: "\"Bonet-Lok\"", what: "is a text", allowed: "true or false" },
    Mistake { from: "[[soil.block]]\n", to: "[[soil.block]]\nheld = \"yes\"\n", key: "soil.block[1].held", value: "\"yes\"", what: "is a text", allowed: "true or false" },
];

#[test]
fn every_mistake_is_named() {
    each_is_named(JET, MISTAKES);
    let alone = "name = \"a\"\nend_time_s = 1\nparticles.spacing_m = 0.01\nwater.block = [{ low_m = [0, 0], \
                 high_m = [0.1, 0.1] }]\n[mixture]\nhydraulic_conductivity_m_per_s = 0.1\n";
    let error = Case::parse("case.toml", alone).expect_err("water alone");
    assert!(
        error.problems.iter().any(|p| p.key == "mixture" && p.what.contains("nothing to couple")),
        "{error}"
    );
    let between = alone.replace("[mixture]\nhydraulic_conductivity_m_per_s = 0.1\n", "").replace(
        "particles.spacing_m = 0.01\n",
        "particles.spacing_m = 0.01\nparticles.interphase_kernel = \"wendland-c4\"\n",
    );
    let error = Case::parse("case.toml", &between).expect_err("water alone");
    let named = |p: &Problem| p.key == "particles.interphase_kernel" && p.what.contains("nothing to couple");
    assert!(error.problems.iter().any(named), "{error}");
}

/// What changes a mixture's numbers, as a key, in the table and in the library.
#[rustfmt::skip]
#[allow(clippy::type_complexity)]
const CHOICES: &[(&str, &str, fn(Jet) -> Jet)] = &[
    ("[particles]", "gradient_correction = true", |mixture| mixture.with_gradient_correction()),
    ("[particles]", "interphase_smoothing_ratio = 1.25", |mixture| mixture.with_interphase_kernel(WendlandC2::new(0.0125).unwrap()).unwrap()),
    ("[particles]", "interphase_kernel = \"quintic-spline\"\ninterphase_smoothing_ratio = 1.0", |mixture| mixture.with_interphase_kernel(QuinticSpline::new(0.01).unwrap()).unwrap()),
    ("[mixture]", "volume_fraction = \"sum\"", |mixture| mixture.with_volume_fraction(VolumeFraction::Sum)),
    ("[mixture]", "normalised_drag = true", |mixture| mixture.with_normalised_drag()),
    ("[mixture]", "projected_drag = true", |mixture| mixture.with_projected_drag()),
    ("[mixture]", "reconstructed_drag = true", |mixture| mixture.with_reconstructed_drag()),
];

type Jet = Mixture<f64, 2, WendlandC2<f64, 2>, SoilLaw<f64>>;

#[test]
fn a_choice_in_the_case_is_that_of_the_library() {
    // A thousandth of a second on, when particles are off their lattices.
    let bits = |mixture: Jet| {
        let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::fixed(1e-5).unwrap());
        for _ in 0..40 {
            run.step().unwrap();
        }
        fingerprint::hash(run.mixture())
    };
    let plain = bits(mixture(JET));
    for (table, key, chosen) in CHOICES {
        let text = JET.replacen(table, &format!("{table}\n{key}"), 1);
        let case = read(&text).0;
        assert_eq!(read(&case.to_string()).0, case, "{key}");
        assert!(key.lines().all(|key| case.to_string().contains(key)), "{key}");
        let found = bits(mixture(&text));
        assert_eq!(found, bits(chosen(mixture(JET))), "{key}");
        assert_ne!(found, plain, "{key}");
    }
}

#[test]
fn water_cavitates_where_the_case_says() {
    let text = JET.replacen("[water]", "[water]\ncavitation_pressure_pa = -1e4", 1);
    let case = read(&text).0;
    assert_eq!(read(&case.to_string()).0, case);
    assert_eq!(mixture(&text).water().material().cavitation(), -1e4);
    assert_eq!(mixture(JET).water().material().cavitation(), f64::NEG_INFINITY);
}

/// Tables and keys of a case, those in comments too.
fn keys(text: &str) -> Vec<(String, String)> {
    let mut table = String::new();
    let mut keys = Vec::new();
    for line in text.lines().map(|line| line.trim_start_matches("# ")) {
        if line.starts_with('[') {
            line.split_whitespace().next().unwrap().clone_into(&mut table);
        } else if let Some((key, _)) = line.split_once(" = ") {
            keys.push((table.clone(), key.to_owned()));
        }
    }
    keys
}

#[test]
fn every_key_of_mixtures_is_documented() {
    let text = include_str!("../../docs/case-format.md");
    let documented: Vec<_> =
        text.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    let documented: Vec<_> = documented.into_iter().flat_map(keys).collect();
    let cavitating = JET.replacen("[water]", "[water]\ncavitation_pressure_pa = -1e4", 1);
    for case in [JET, TUBE, &cavitating] {
        for key in keys(&read(case).0.to_string()) {
            assert!(documented.contains(&key), "{} {} is not documented", key.0, key.1);
        }
    }
    // A key of another table does not count, nor a longer one that ends as it does.
    let of = |table: &str, key: &str| documented.contains(&(table.to_owned(), key.to_owned()));
    assert!(of("[water]", "cavitation_pressure_pa") && !of("[mixture]", "cavitation_pressure_pa"));
    assert!(of("[mixture]", "reconstructed_drag") && !of("[mixture]", "drag_pa") && !of("[water]", "drag"));
}

#[test]
fn the_bed_is_buoyant_and_starts_at_rest() {
    let mut mixture = mixture(JET);
    let soil = mixture.soil();
    for i in soil.wall_particles()..soil.len() {
        let depth = 0.18 - soil.positions()[i][1];
        let vertical = soil.memory(i).stress.0[1];
        assert!((vertical + 1700.0 * 9.81 * depth).abs() < 1e-9, "{vertical} at a depth of {depth}");
    }
    mixture.evaluate().unwrap();
    let (soil, water) = (mixture.soil(), mixture.water());
    // Away from the surface, where kernels are cut off, nothing pulls.
    for i in soil.wall_particles()..soil.len() {
        let x = soil.positions()[i];
        // The mean stress beside a wall is not that of the corner.
        if x[1] < 0.13 && (0.02..0.43).contains(&x[0]) {
            let a = soil.accelerations()[i].norm();
            assert!(a < 0.1, "soil at {:?} falls by {a} m/s²", x.0);
        }
    }
    for a in water.wall_particles()..water.len() {
        if water.positions()[a][1] < 0.13 {
            let pull = water.accelerations()[a].norm();
            assert!(pull < 0.1, "water at {:?} falls by {pull} m/s²", water.positions()[a].0);
            let fraction = water.volume_fraction(a);
            assert!((fraction - 0.5).abs() < 0.01, "{fraction} beside walls full of soil too");
        }
    }
    let given = water.walls().iter().filter(|wall| wall.kind() == WallKind::Given).count();
    assert_eq!(given, 1, "a nozzle");
}

#[test]
fn held_soil_stays_and_walls_without_soil_leave_the_water_its_space() {
    let case = read(TUBE).0;
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).unwrap();
    let mut run = case.simulation(kernel, LeapFrog::new()).unwrap();
    let held: Vec<_> = run.mixture().soil().positions().to_vec();
    for _ in 0..20 {
        run.step().unwrap();
    }
    let (soil, water) = (run.mixture().soil(), run.mixture().water());
    assert_eq!(soil.len(), soil.wall_particles(), "all of it is held");
    let mut now: Vec<_> = soil.positions().to_vec();
    let order = |a: &alluvium::Vector<f64, 2>, b: &alluvium::Vector<f64, 2>| {
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    };
    let mut held = held;
    held.sort_by(order);
    now.sort_by(order);
    assert_eq!(now, held);
    for a in water.wall_particles()..water.len() {
        let (x, fraction) = (water.positions()[a], water.volume_fraction(a));
        let inside = if (0.7..0.8).contains(&x[0]) {
            Some(0.45)
        } else if x[0] < 0.2 || x[0] > 1.3 {
            Some(1.0)
        } else {
            None
        };
        if let Some(expected) = inside {
            assert!((fraction - expected).abs() < 0.01, "{fraction} for {expected} at {:?}", x.0);
        }
    }
    let along = |wall: &alluvium::mixture::Wall<f64, 2>| match wall.kind() {
        WallKind::Extrapolated { slip, .. } => Some(slip),
        _ => None,
    };
    assert!(soil.walls().iter().filter_map(along).all(|slip| slip == Slip::NoSlip));
    assert!(water.walls().iter().filter_map(along).all(|slip| slip == Slip::FreeSlip));
}

/// Stress per area of the grains: the weight of dry soil above the water's surface, and less its uplift below.
#[test]
fn soil_starts_under_its_weight_less_the_uplift_of_the_water_that_is_there() {
    let bed = |water: &str| {
        let text = format!(
            "name = \"bed\"\nend_time_s = 0.1\nparticles.spacing_m = 0.01\n\
             [soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = 0.5\nbulk_modulus_pa = 1e6\n\
             poissons_ratio = 0.3\nfriction_angle_deg = 30.0\n\
             [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [0.2, 0.1]\n\
             [water]\nsound_speed_m_per_s = 30.0\n{water}\
             [mixture]\nhydraulic_conductivity_m_per_s = 5e-3\n\
             [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [0.6, 0.2]\nopen = [\"+y\"]\n"
        );
        mixture(&text)
    };
    let block =
        |low: [f64; 2], high: [f64; 2]| format!("[[water.block]]\nlow_m = {low:?}\nhigh_m = {high:?}\n");
    let half = bed(&block([0.0, 0.0], [0.2, 0.05]));
    let drowned = bed(&block([0.0, 0.0], [0.2, 0.15]));
    let dry = bed(&block([0.4, 0.0], [0.6, 0.1]));
    for (name, mixture, level) in
        [("half wet", half, 0.05_f64), ("under water", drowned, 0.15), ("dry", dry, 0.0)]
    {
        let soil = mixture.soil();
        for i in soil.wall_particles()..soil.len() {
            let y = soil.positions()[i][1];
            let wet = (level.min(0.1) - y).max(0.0);
            let weight = 9.81 * (2650.0 * (0.1 - y) - 1000.0 * wet);
            let vertical = -soil.memory(i).stress.0[1];
            assert!((vertical - weight).abs() < 1e-9 * 2650.0, "{name}, y = {y}: {vertical} for {weight}");
        }
    }
}
