//! Case files: good ones give the same case again, broken ones say where, what and what is allowed.

use crate::case_soil::Mistake;
use alluvium::case::{Case, DiffusionKind, Dumps, OwnPath, Preset, Slip, StepSize, Strength, Walls};

pub const GOOD: &str = r#"name = "dam-break"
dimension = 2
precision = "f64"
end_time_s = 0.25
gravity_m_per_s2 = [0.0, -9.81]

[water]
sound_speed_m_per_s = 25.0
viscosity_pa_s = 1.0e-3

[water.density_diffusion]
kind = "hydrostatic"
coefficient = 0.1

[[water.block]]
low_m = [0.0, 0.0]
high_m = [0.1, 0.2]

[particles]
spacing_m = 0.0025
smoothing_ratio = 1.3
kernel = "wendland-c2"

[tank]
low_m = [0.0, 0.0]
high_m = [0.4, 0.3]
open = ["+y"]
walls = "extrapolated"
slip = "free-slip"

[time]
courant = 0.2

[output]
dump_times_s = [0.0, 0.1, 0.2]
fields = ["velocity", "pressure"]

[[gauge]]
name = "toe"
position_m = [0.399, 0.01]
quantity = "pressure"
"#;

fn parse(text: &str) -> Case {
    Case::parse("case.toml", text).unwrap_or_else(|error| panic!("{error}")).0
}

#[rustfmt::skip]
pub const MISTAKES: &[Mistake] = &[
    // Not TOML.
    Mistake { from: "dimension = 2", to: "dimension = = 2", key: "", value: "", what: "not valid TOML", allowed: "key = value" },
    Mistake { from: "[0.1, 0.2]\n", to: "[0.1, 0.2\n", key: "", value: "", what: "not valid TOML", allowed: "key = value" },
    Mistake { from: "[time]", to: "[water]", key: "", value: "", what: "duplicate key", allowed: "key = value" },
    Mistake { from: "\"f64\"", to: "f64", key: "", value: "f64", what: "not valid TOML", allowed: "key = value" },
    // Unknown keys.
    Mistake { from: "spacing_m =", to: "spacing =", key: "particles.spacing", value: "0.0025", what: "did you mean `spacing_m`?", allowed: "kernel, smoothing_ratio, spacing_m" },
    Mistake { from: "viscosity_pa_s", to: "viscocity_pa_s", key: "water.viscocity_pa_s", value: "1.0e-3", what: "did you mean `viscosity_pa_s`?", allowed: "sound_speed_m_per_s" },
    Mistake { from: "[time]", to: "[times]", key: "times", value: "", what: "did you mean `time`?", allowed: "time" },
    Mistake { from: "slip = ", to: "courant = 0.1\nslip = ", key: "tank.courant", value: "0.1", what: "it belongs to [time]", allowed: "high_m, layers, low_m" },
    Mistake { from: "[[gauge]]", to: "[[probe]]", key: "probe", value: "", what: "unknown key `probe` at the top", allowed: "gauge" },
    Mistake { from: "low_m = [0.0, 0.0]\nhigh_m = [0.1", to: "lo_m = [0.0, 0.0]\nhigh_m = [0.1", key: "water.block[1].lo_m", value: "[0.0, 0.0]", what: "did you mean `low_m`?", allowed: "low_m" },
    // Missing keys.
    Mistake { from: "end_time_s = 0.25\n", to: "", key: "end_time_s", value: "", what: "missing key", allowed: "a number above 0" },
    Mistake { from: "name = \"dam-break\"\n", to: "", key: "name", value: "", what: "missing key", allowed: "letters, digits" },
    Mistake { from: "spacing_m = 0.0025\n", to: "", key: "particles.spacing_m", value: "", what: "missing key", allowed: "above 0" },
    Mistake { from: "high_m = [0.1, 0.2]\n", to: "", key: "water.block[1].high_m", value: "", what: "missing key", allowed: "2 numbers" },
    Mistake { from: "[[water.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [0.1, 0.2]\n", to: "", key: "water.block", value: "", what: "missing key", allowed: "at least one [[water.block]]" },
    Mistake { from: "position_m = [0.399, 0.01]\n", to: "", key: "gauge[1].position_m", value: "", what: "missing key", allowed: "2 numbers" },
    // Wrong types.
    Mistake { from: "end_time_s = 0.25", to: "end_time_s = \"0.25 s\"", key: "end_time_s", value: "\"0.25 s\"", what: "is a text", allowed: "a number above 0" },
    Mistake { from: "courant = 0.2", to: "courant = true", key: "time.courant", value: "true", what: "is a true/false", allowed: "at most 1.0" },
    Mistake { from: "dimension = 2", to: "dimension = 2.0", key: "dimension", value: "2.0", what: "is a number", allowed: "from 2 to 3" },
    Mistake { from: "kernel = \"wendland-c2\"", to: "kernel = 2", key: "particles.kernel", value: "2", what: "is a whole number", allowed: "\"wendland-c4\"" },
    Mistake { from: "open = [\"+y\"]", to: "open = \"+y\"", key: "tank.open", value: "\"+y\"", what: "is a text", allowed: "a list of" },
    Mistake { from: "low_m = [0.0, 0.0]\nhigh_m = [0.4", to: "low_m = 0.0\nhigh_m = [0.4", key: "tank.low_m", value: "0.0", what: "is a number", allowed: "2 numbers, one per dimension" },
    Mistake { from: "[time]\ncourant = 0.2\n", to: "[[time]]\ncourant = 0.2\n", key: "time", value: "[[time]]", what: "is a list", allowed: "a table, [time]" },
    // Words that are no choice.
    Mistake { from: "wendland-c2", to: "wendland-c3", key: "particles.kernel", value: "\"wendland-c3\"", what: "did you mean \"wendland-c2\"?", allowed: "\"quintic-spline\"" },
    Mistake { from: "\"hydrostatic\"", to: "\"antuono\"", key: "water.density_diffusion.kind", value: "\"antuono\"", what: "is not a choice", allowed: "\"renormalised\"" },
    Mistake { from: "[\"+y\"]", to: "[\"top\"]", key: "tank.open[1]", value: "\"top\"", what: "is not a choice", allowed: "\"+y\"" },
    Mistake { from: "[\"velocity\", \"pressure\"]", to: "[\"velocity\", \"pressures\"]", key: "output.fields[2]", value: "\"pressures\"", what: "did you mean \"pressure\"?", allowed: "\"density\"" },
    Mistake { from: "[\"velocity\", \"pressure\"]", to: "[\"velocity\", \"velocity\"]", key: "output.fields[2]", value: "\"velocity\"", what: "is listed twice", allowed: "once" },
    // Values out of range.
    Mistake { from: "smoothing_ratio = 1.3", to: "smoothing_ratio = 0.8", key: "particles.smoothing_ratio", value: "0.8", what: "is out of range", allowed: "from 1.0 to 4.0" },
    Mistake { from: "spacing_m = 0.0025", to: "spacing_m = -0.0025", key: "particles.spacing_m", value: "-0.0025", what: "is out of range", allowed: "above 0" },
    Mistake { from: "end_time_s = 0.25", to: "end_time_s = 0", key: "end_time_s", value: "0", what: "is out of range", allowed: "above 0" },
    Mistake { from: "end_time_s = 0.25", to: "end_time_s = inf", key: "end_time_s", value: "inf", what: "is out of range", allowed: "above 0" },
    Mistake { from: "viscosity_pa_s = 1.0e-3", to: "viscosity_pa_s = nan", key: "water.viscosity_pa_s", value: "nan", what: "is out of range", allowed: "from 0.0" },
    Mistake { from: "dimension = 2", to: "dimension = 4", key: "dimension", value: "4", what: "is out of range", allowed: "from 2 to 3" },
    Mistake { from: "courant = 0.2", to: "courant = 20", key: "time.courant", value: "20", what: "is out of range", allowed: "at most 1.0" },
    Mistake { from: "coefficient = 0.1", to: "coefficient = -0.1", key: "water.density_diffusion.coefficient", value: "-0.1", what: "is out of range", allowed: "from 0.0 to 1.0" },
    Mistake { from: "\"dam-break\"", to: "\"../dam\"", key: "name", value: "\"../dam\"", what: "cannot name a file", allowed: "letters, digits" },
    // Lists of the wrong length.
    Mistake { from: "[0.0, -9.81]", to: "[0.0, 0.0, -9.81]", key: "gravity_m_per_s2", value: "[0.0, 0.0, -9.81]", what: "has 3 entries", allowed: "2 numbers" },
    Mistake { from: "[0.399, 0.01]", to: "[0.399, \"low\"]", key: "gauge[1].position_m[2]", value: "\"low\"", what: "is a text", allowed: "a number from" },
    // Parts that do not fit together.
    Mistake { from: "high_m = [0.1, 0.2]", to: "high_m = [0.5, 0.2]", key: "water.block[1].high_m[1]", value: "0.5", what: "is outside the tank", allowed: "from 0.0 to 0.4 [m]" },
    Mistake { from: "high_m = [0.1, 0.2]", to: "high_m = [0.1, 0.0]", key: "water.block[1].high_m[2]", value: "0.0", what: "is not above low_m", allowed: "above 0.0" },
    Mistake { from: "high_m = [0.1, 0.2]", to: "high_m = [0.001, 0.2]", key: "water.block[1].high_m[1]", value: "0.001", what: "no room for a particle", allowed: "one spacing, 0.0025 m" },
    Mistake { from: "[particles]", to: "[[water.block]]\nlow_m = [0.05, 0.1]\nhigh_m = [0.2, 0.2]\n[particles]", key: "water.block[2]", value: "[[water.block]]", what: "overlaps water.block[1]", allowed: "touch" },
    Mistake { from: "[particles]", to: "surface_m = 1e300\n[particles]", key: "water.block[1].surface_m", value: "1e300", what: "is out of range", allowed: "from -2e7 to 2e7 [m]" },
    Mistake { from: "[time]", to: "[[tank.obstacle]]\nlow_m = [0.05, 0.0]\nhigh_m = [0.2, 0.1]\n[time]", key: "tank.obstacle[1]", value: "[[tank.obstacle]]", what: "overlaps water.block[1]", allowed: "boxes that at most touch" },
    Mistake { from: "[time]", to: "[[tank.obstacle]]\nlow_m = [0.2, 0.0]\nhigh_m = [0.3, 0.1]\n[[tank.obstacle]]\nlow_m = [0.1, 0.0]\nhigh_m = [0.25, 0.05]\n[time]", key: "tank.obstacle[2]", value: "[[tank.obstacle]]", what: "overlaps tank.obstacle[1]", allowed: "boxes that at most touch" },
    Mistake { from: "[time]", to: "[[water.inflow]]\nlow_m = [0.0, 0.19]\nhigh_m = [0.1, 0.25]\nvelocity_m_per_s = [0.0, -1.0]\n[time]", key: "water.inflow[1]", value: "[[water.inflow]]", what: "overlaps water.block[1]", allowed: "boxes that at most touch" },
    Mistake { from: "high_m = [0.4, 0.3]", to: "high_m = [-0.4, 0.3]", key: "tank.high_m[1]", value: "-0.4", what: "is not above low_m", allowed: "above 0.0" },
    Mistake { from: "spacing_m = 0.0025", to: "spacing_m = 2.5e-9", key: "particles.spacing_m", value: "2.5e-9", what: "water particles", allowed: "at most 1e9" },
    Mistake { from: "sound_speed_m_per_s = 25.0", to: "sound_speed_m_per_s = 1.5", key: "water.sound_speed_m_per_s", value: "1.5", what: "below the fastest speed to expect", allowed: "ten times" },
    Mistake { from: "[0.0, 0.1, 0.2]", to: "[0.0, 0.1, 0.3]", key: "output.dump_times_s[3]", value: "0.3", what: "is after the end", allowed: "end_time_s = 0.25" },
    Mistake { from: "[0.0, 0.1, 0.2]", to: "[0.0, 0.2, 0.1]", key: "output.dump_times_s[3]", value: "0.1", what: "not after the time before", allowed: "ascending" },
    Mistake { from: "dump_times_s = [0.0, 0.1, 0.2]", to: "dump_interval_s = 1e-9", key: "output.dump_interval_s", value: "1e-9", what: "too many dumps", allowed: "at least" },
    Mistake { from: "courant = 0.2", to: "courant = 0.2\ntime_step_s = 1e-5", key: "time.time_step_s", value: "1e-5", what: "contradicts courant", allowed: "either" },
    Mistake { from: "dump_times_s", to: "dump_interval_s = 0.1\ndump_times_s", key: "output.dump_times_s", value: "[0.0, 0.1, 0.2]", what: "contradicts dump_interval_s", allowed: "either" },
    Mistake { from: "[time]", to: "[periodic]\naxes = [\"z\"]\n[time]", key: "periodic.axes[1]", value: "\"z\"", what: "does not exist in two dimensions", allowed: "\"x\"" },
    Mistake { from: "[time]", to: "[periodic]\naxes = [\"y\"]\n[time]", key: "tank.open[1]", value: "\"+y\"", what: "has no effect", allowed: "not in periodic.axes" },
    Mistake { from: "high_m = [0.4, 0.3]", to: "high_m = [0.4001, 0.3]\n[periodic]\naxes = [\"x\"]\n[tank.x]", key: "tank.x", value: "", what: "unknown key", allowed: "open" },
    Mistake { from: "[time]", to: "[[tank.moving]]\nside = \"+y\"\nvelocity_m_per_s = [1.0, 0.0]\n[time]", key: "tank.moving[1].side", value: "\"+y\"", what: "has no wall to move", allowed: "neither open nor periodic" },
    Mistake { from: "[0.399, 0.01]", to: "[0.41, 0.01]", key: "gauge[1].position_m[1]", value: "0.41", what: "is outside the tank", allowed: "from 0.0 to 0.4" },
    Mistake { from: "[[gauge]]", to: "[[gauge]]\nname = \"toe\"\nposition_m = [0.1, 0.1]\n[[gauge]]", key: "gauge[2].name", value: "\"toe\"", what: "is taken", allowed: "no other gauge" },
    Mistake { from: "gravity_m_per_s2 = [0.0, -9.81]\n\n[water]\nsound_speed_m_per_s = 25.0", to: "gravity_m_per_s2 = [0.0, 0.0]\n\n[water]", key: "water.sound_speed_m_per_s", value: "", what: "missing key", allowed: "ten times" },
];

/// The line of `text` that differs first from the good case.
fn first_changed_line(text: &str) -> usize {
    let same = GOOD.lines().zip(text.lines()).take_while(|(a, b)| a == b).count();
    same + 1
}

#[test]
fn every_mistake_is_named() {
    const { assert!(MISTAKES.len() >= 25) };
    for mistake in MISTAKES {
        let Mistake { from, to, key, value, what, allowed } = mistake;
        assert!(GOOD.contains(from), "{from}");
        let text = GOOD.replacen(from, to, 1);
        let error = Case::parse("case.toml", &text).expect_err(to);
        let shown = error.to_string();
        let found = error.problems.iter().find(|p| p.key == *key && p.what.contains(what));
        let found = found.unwrap_or_else(|| panic!("`{to}`: no `{what}` for `{key}` in\n{shown}"));
        assert!(found.value.contains(value), "`{to}`: value `{}`", found.value);
        assert!(found.allowed.contains(allowed), "`{to}`: allowed `{}`", found.allowed);
        if !key.is_empty() {
            assert!(found.what.contains(key.rsplit('.').next().unwrap()), "`{to}`: {}", found.what);
        }
        assert!(shown.contains(&format!("--> case.toml:{}:{}\n", found.line, found.column)), "{shown}");
        assert!(shown.contains(&format!("= allowed: {}", found.allowed)), "{shown}");
        assert_eq!(text.lines().nth(found.line - 1).map(str::trim_end), Some(found.text.as_str()), "{shown}");
        if !value.is_empty() && !value.starts_with("[[") {
            assert!(found.text.contains(value.lines().next().unwrap()), "`{to}`: line {}", found.line);
            assert!(found.line.abs_diff(first_changed_line(&text)) <= 3 || to.contains("axes"), "{shown}");
        }
    }
}

#[test]
fn the_place_is_underlined() {
    let text = GOOD.replacen("smoothing_ratio = 1.3", "smoothing_ratio = 0.8", 1);
    let expected = "\
error: `particles.smoothing_ratio = 0.8` is out of range
  --> case.toml:21:19
   |
21 | smoothing_ratio = 0.8
   |                   ^^^
   = allowed: a number from 1.0 to 4.0 [h/Δx; below 1 there are too few neighbours]
case.toml: 1 error";
    assert_eq!(Case::parse("case.toml", &text).unwrap_err().to_string(), expected);
}

#[test]
fn all_mistakes_are_shown_at_once() {
    let text = GOOD.replacen("end_time_s = 0.25", "end_time_s = -1", 1).replacen("kernel", "kernal", 1);
    let error = Case::parse("case.toml", &text).unwrap_err();
    let keys: Vec<_> = error.problems.iter().map(|p| p.key.as_str()).collect();
    assert_eq!(keys, ["end_time_s", "particles.kernal"]);
    assert!(error.to_string().ends_with("case.toml: 2 errors"));
}

#[test]
fn a_case_written_back_is_the_same_case() {
    let three = GOOD
        .replacen("dimension = 2", "dimension = 3\npreset = \"paper\"", 1)
        .replace("[0.0, -9.81]", "[0.0, -9.81, 0.0]")
        .replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]")
        .replace("[0.1, 0.2]", "[0.1, 0.2, 0.05]")
        .replace("[0.4, 0.3]", "[0.4, 0.3, 0.05]")
        .replace("[0.399, 0.01]", "[0.399, 0.01, 0.02]")
        .replace("slip = \"free-slip\"", "slip = \"no-slip\"")
        .replace("[time]", "[periodic]\naxes = [\"z\"]\n[[tank.moving]]\nside = \"-y\"\nvelocity_m_per_s = [1, 0, 0]\n[time]")
        .replace("courant = 0.2", "time_step_s = 1e-5");
    for text in [GOOD, &three] {
        let case = parse(text);
        let used = case.to_string();
        let (again, warnings) = Case::parse("case.used.toml", &used).unwrap();
        assert_eq!(again, case);
        assert_eq!(again.to_string(), used);
        assert_eq!(warnings.problems, [], "a written case warns of nothing");
    }
}

#[test]
fn presets_are_a_base_that_keys_override() {
    let short = "name = \"a\"\nend_time_s = 1\nparticles.spacing_m = 0.01\n\
                 tank = { low_m = [0, 0], high_m = [1, 1] }\n\
                 water.block = [{ low_m = [0, 0], high_m = [0.5, 0.5] }]\n";
    let default = parse(short);
    assert_eq!(default.preset, Preset::Default);
    let water = |case: &Case| case.water.clone().unwrap();
    assert_eq!((default.particles.smoothing_ratio, water(&default).reinitialisation_every), (1.3, 0));
    let tank = default.tank.as_ref().unwrap();
    assert_eq!((tank.walls, tank.layers), (Walls::Extrapolated(Slip::FreeSlip), 3));
    assert_eq!(default.time.step, StepSize::Courant(0.2));
    assert_eq!(default.output.dumps, Dumps::Every(0.02));
    let fall = 10.0 * (2.0 * 9.81 * 0.5_f64).sqrt();
    assert!((water(&default).sound_speed - fall).abs() < 1e-12, "ten times the speed of a fall");
    let paper = parse(&format!("preset = \"paper\"\n{short}"));
    assert_eq!((paper.particles.smoothing_ratio, water(&paper).reinitialisation_every), (1.0, 20));
    assert_eq!(water(&paper).diffusion, DiffusionKind::PartialDensity);
    assert_eq!(paper.tank.as_ref().unwrap().walls, Walls::Dynamic);
    assert_eq!(paper.time.step, StepSize::Courant(0.3));
    let mixed = parse(&format!("preset = \"paper\"\n{short}particles.smoothing_ratio = 1.5\n"));
    assert_eq!(mixed.particles.smoothing_ratio, 1.5);
    assert_eq!(water(&mixed).reinitialisation_every, 20);
}

#[test]
fn what_is_doubtful_is_a_warning() {
    let warned = |from: &str, to: &str| {
        let (_, warnings) = Case::parse("case.toml", &GOOD.replacen(from, to, 1)).unwrap();
        warnings.problems.iter().map(|p| p.what.clone()).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(warned("", ""), "");
    assert!(warned("ratio = 1.3", "ratio = 1.1").contains("few neighbours"));
    assert!(warned("\"extrapolated\"", "\"dynamic\"").contains("slip = \"free-slip\"` has no effect"));
    assert!(warned("\"hydrostatic\"", "\"none\"").contains("coefficient = 0.1` has no effect"));
    assert!(warned("courant = 0.2", "time_step_s = 0.01").contains("expect it to fail"));
    assert!(warned("[0.1, 0.2]", "[0.101, 0.2]").contains("whole number of particles"));
    assert!(warned("= 25.0", "= 5.0").contains("density will vary"));
}

/// The complete cases of the documentation, of water and of soil.
fn documented(n: usize) -> &'static str {
    let text = include_str!("../../docs/case-format.md");
    text.split("```toml\n").nth(n).unwrap().split("```").next().unwrap()
}

/// Keys of the case as it is used that the documentation leaves out.
fn undocumented(used: &str, present: &[&str]) -> Vec<String> {
    let keys = |text: &str| {
        let line = |line: &str| line.split(" =").next().unwrap_or("").split(']').next().unwrap().to_owned();
        text.lines().map(line).filter(|key| !key.is_empty()).collect::<Vec<_>>()
    };
    let present: Vec<String> = present.iter().flat_map(|text| keys(text)).collect();
    let mut missing = keys(used);
    missing.retain(|key| !present.contains(key));
    missing
}

#[test]
fn the_documented_case_of_soil_has_every_key_and_its_defaults() {
    let case = parse(documented(2));
    assert_eq!(undocumented(&case.to_string(), &[documented(1), documented(2)]), Vec::<String>::new());
    let text = include_str!("../../examples/sand_column.toml");
    let mut own = parse(&text.replace("dump_interval_s = 0.05\n", ""));
    let soil = |case: &Case| case.soil.clone().unwrap();
    let ratios = [&case, &own].map(|case| soil(case).bodies[0].lateral_ratio);
    assert!((ratios[0] - ratios[1]).abs() < 1e-6, "{ratios:?}");
    let own_soil = own.soil.as_mut().unwrap();
    own_soil.bodies[0].lateral_ratio = ratios[0];
    // The cone's apex is at zero without cohesion, where it may be cut off by name.
    if let Strength::DruckerPrager { tension_cut_off, .. } = &mut own_soil.strength {
        *tension_cut_off = Some(0.0);
    }
    assert_eq!(case, own, "values said to be defaults are");
    let cylinder = parse(crate::case_soil::CYLINDER).to_string();
    let present = [documented(1), documented(2), documented(3)];
    let missing = undocumented(&cylinder.replace("youngs_modulus_pa", "bulk_modulus_pa"), &present);
    assert_eq!(missing, ["friction_coefficient"], "a comment there");
}

#[test]
fn the_documented_case_has_every_key_and_its_defaults() {
    let documented = parse(documented(1));
    assert_eq!(undocumented(&documented.to_string(), &[self::documented(1)]), Vec::<String>::new());
    let own = "name = \"dam-break\"\nend_time_s = 0.5\nparticles.spacing_m = 0.0025\n\
        water.sound_speed_m_per_s = 25.0\nwater.block = [{ low_m = [0, 0], high_m = [0.1, 0.2] }]\n\
        [tank]\nlow_m = [0, 0]\nhigh_m = [0.4, 0.3]\nopen = [\"+y\"]\n\
        [[tank.moving]]\nside = \"-y\"\nvelocity_m_per_s = [0, 0]\n\
        [[gauge]]\nname = \"toe\"\nposition_m = [0.399, 0.01]\n";
    assert_eq!(documented, parse(own), "values said to be defaults are");
}

#[test]
fn the_examples_are_valid_and_nothing_in_them_is_doubtful() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let cases: Vec<_> = paths.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    assert!(!cases.is_empty(), "no case in {folder}");
    for path in cases {
        let (name, text) = (path.display().to_string(), std::fs::read_to_string(&path).unwrap());
        if text.contains("[[leg]]") {
            let path = OwnPath::<f64>::parse(&name, &text).unwrap_or_else(|error| panic!("{error}"));
            assert!(!path.legs.is_empty(), "{name}");
            continue;
        }
        let read = Case::parse(&name, &text);
        let (case, warnings) = read.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(warnings.problems, [], "{name}");
        assert_eq!(Some(&*case.name), path.file_stem().and_then(|stem| stem.to_str()));
    }
}
