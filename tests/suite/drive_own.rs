//! Own paths of `drive`: legs read as they stand, every mistake named, the answers of laws known in closed form.

use crate::case_soil::{Mistake, each_is_named_in};
use alluvium::case::OwnPath;
use alluvium::driver::Control;
use alluvium::output::Table;
use std::path::PathBuf;
use std::process::{Command, Output};

pub const GOOD: &str = r#"# Squeezed all round, then sheared to and fro under constant normal stress.
cycles = 2

[[leg]]
stress_xx_pa = -2e5
stress_yy_pa = -2e5
stress_zz_pa = -2e5
increments = 10

[[leg]]
held = ["xx", "yy", "zz"]
strain_xy = 0.03
rotation_xy_deg = -1.5

[[leg]]
held = ["xx", "yy", "zz"]
strain_xy = -0.03
rotation_xy_deg = 1.5
"#;

#[rustfmt::skip]
pub const MISTAKES: &[Mistake] = &[
    Mistake { from: "cycles = 2", to: "cycles = = 2", key: "", value: "", what: "not valid TOML", allowed: "key = value" },
    Mistake { from: "cycles = 2", to: "cycle = 2", key: "cycle", value: "2", what: "did you mean `cycles`?", allowed: "leg" },
    Mistake { from: "cycles = 2", to: "cycles = 0", key: "cycles", value: "0", what: "is out of range", allowed: "from 1 to 100000" },
    Mistake { from: "cycles = 2", to: "cycles = 2.5", key: "cycles", value: "2.5", what: "is a number", allowed: "a whole number" },
    Mistake { from: "increments = 10", to: "increments = -3", key: "leg[1].increments", value: "-3", what: "is out of range", allowed: "from 1" },
    Mistake { from: "increments = 10", to: "steps = 10", key: "leg[1].steps", value: "10", what: "unknown key", allowed: "increments" },
    Mistake { from: "stress_xx_pa = -2e5", to: "stress_xx = -2e5", key: "leg[1].stress_xx", value: "-2e5", what: "did you mean `stress_xx_pa`?", allowed: "stress_yy_pa" },
    Mistake { from: "stress_xx_pa = -2e5", to: "stress_xx_pa = \"held\"", key: "leg[1].stress_xx_pa", value: "\"held\"", what: "is a text", allowed: "[Pa, positive in tension]" },
    Mistake { from: "stress_xx_pa = -2e5", to: "stress_xx_pa = -inf", key: "leg[1].stress_xx_pa", value: "-inf", what: "is out of range", allowed: "from -1e13" },
    Mistake { from: "stress_xx_pa = -2e5", to: "stress_xx_pa = -2e5\nstrain_xx = 0.0", key: "leg[1].stress_xx_pa", value: "-2e5", what: "contradicts strain_xx", allowed: "either strain_xx or stress_xx_pa" },
    Mistake { from: "strain_xy = 0.03", to: "strain_xy = 20.0", key: "leg[2].strain_xy", value: "20.0", what: "is out of range", allowed: "from -10.0 to 10.0" },
    Mistake { from: "strain_xy = 0.03", to: "strain_xy = 0.03\nstrain_zz = 0.01", key: "leg[2].strain_zz", value: "0.01", what: "contradicts held", allowed: "either strain_zz or \"zz\" in held" },
    Mistake { from: "strain_xy = 0.03", to: "strain_yx = 0.02", key: "leg[2].strain_yx", value: "0.02", what: "unknown key", allowed: "strain_xy" },
    Mistake { from: "strain_xy = 0.03\nrotation_xy_deg = -1.5", to: "strain_xy = 0.0", key: "leg[2]", value: "[[leg]]", what: "leads nowhere", allowed: "a strain or a rotation that is not 0" },
    Mistake { from: "\"yy\"", to: "\"y\"", key: "leg[2].held[2]", value: "\"y\"", what: "is not a choice", allowed: "\"xx\", \"yy\"" },
    Mistake { from: "\"yy\"", to: "\"xx\"", key: "leg[2].held[2]", value: "\"xx\"", what: "is listed twice", allowed: "each word once" },
    Mistake { from: "rotation_xy_deg = -1.5", to: "rotation_xy_deg = 1e9", key: "leg[2].rotation_xy_deg", value: "1e9", what: "is out of range", allowed: "36000.0 [°" },
];

#[test]
fn every_mistake_is_named() {
    each_is_named_in(GOOD, MISTAKES, |text| OwnPath::<f64>::parse("legs.toml", text).map(|_| ()));
    let empty = OwnPath::<f64>::parse("legs.toml", "cycles = 3\n").unwrap_err();
    assert_eq!(empty.problems[0].what, "missing key `leg`");
    assert!(empty.to_string().contains("legs.toml:1:1") && empty.to_string().contains("[[leg]]"), "{empty}");
}

#[test]
fn legs_are_read_as_they_stand() {
    let path = OwnPath::<f32>::parse("legs.toml", GOOD).unwrap();
    assert_eq!((path.cycles, path.legs.len()), (2, 3));
    assert_eq!(path.legs.iter().map(|leg| leg.increments).collect::<Vec<_>>(), [Some(10), None, None]);
    let (squeeze, none, held) = (Control::Stress(-2e5), Control::Strain(0.0), Control::Held);
    assert_eq!(path.legs[0].leg.controls, [squeeze, squeeze, squeeze, none, none, none]);
    assert_eq!(path.legs[1].leg.controls, [held, held, held, Control::Strain(0.03), none, none]);
    // From x towards y is against `Tensor::spin`.
    assert_eq!(path.legs[1].leg.rotation, [1.5_f64.to_radians() as f32, 0.0, 0.0]);
}

fn drive(name: &str, legs: &str, arguments: &str) -> Output {
    let file = file(name);
    std::fs::write(&file, legs).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_alluvium"))
        .args(["drive", "own", "--youngs-modulus", "1e7", "--legs"])
        .arg(&file)
        .args(arguments.split_whitespace())
        .output();
    std::fs::remove_file(&file).unwrap();
    output.unwrap()
}

fn file(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("alluvium-legs-{name}-{}.toml", std::process::id()))
}

fn table(name: &str, legs: &str, arguments: &str) -> Table {
    let output = drive(name, legs, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    Table::parse(&String::from_utf8(output.stdout).unwrap()).unwrap()
}

/// Under constant normal stress shear ends on the cone, whichever way it goes: τ = 3 α p, with α = sin θ/3 and the
/// pressure of 200 kPa that the first leg has made.
#[test]
fn cyclic_shear_under_constant_stress_ends_on_the_cone() {
    let rows = table("cyclic", GOOD, "--friction-angle 30 --steps 40");
    assert_eq!(rows.rows(), 1 + 2 * (10 + 40 + 40));
    let column = |name: &str| rows.column(name).unwrap().to_vec();
    let (gone, p, root) = (column("legs gone [-]"), column("pressure [Pa]"), column("root_j2 [Pa]"));
    assert_eq!((gone[10], gone[50], gone[180]), (1.0, 2.0, 6.0));
    for row in 10..rows.rows() {
        assert!((p[row] / 2e5 - 1.0).abs() < 1e-9, "row {row}: p = {}", p[row]);
    }
    for end in [50, 90, 140, 180] {
        assert!((root[end] / 1e5 - 1.0).abs() < 1e-9, "row {end}: √J₂ = {}", root[end]);
    }
    let strain = column("strain_xy [-]");
    assert!((strain[50] - 0.03).abs() < 1e-15 && strain[90].abs() < 1e-15);
    assert!(column("stress_xy [Pa]")[50] > 0.0 && column("stress_xy [Pa]")[90] < 0.0);
}

/// A turn by the file's angle turns a stress as the path `rotation` does.
#[test]
fn an_angle_is_from_the_first_axis_towards_the_second() {
    let legs = "[[leg]]\nrotation_xy_deg = 45\nincrements = 400\n";
    let rows = table("turn", legs, "--surface elastic --start-stress 1e3,-1e3,0,0,0,0");
    assert!((rows.column("stress_xy [Pa]").unwrap().last().unwrap() / 1e3 - 1.0).abs() < 1e-6);
    let legs = "[[leg]]\nrotation_yz_deg = 45\nincrements = 400\n";
    let rows = table("turn-yz", legs, "--surface elastic --start-stress 0,1e3,-1e3,0,0,0 --precision f32");
    assert!((rows.column("stress_yz [Pa]").unwrap().last().unwrap() / 1e3 - 1.0).abs() < 1e-4);
}

#[test]
fn the_example_is_a_path() {
    let rows = table("example", include_str!("../../examples/legs.toml"), "--friction-angle 30");
    assert!(rows.column("lost [J/m3]").unwrap().last().unwrap() > &0.0);
}

#[test]
fn what_is_wrong_is_told_by_its_code() {
    let fails = |name: &str, legs: &str, arguments: &str, code: i32, word: &str| {
        let output = drive(name, legs, arguments);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments}: {told}");
        assert!(told.contains(word), "{arguments}: {told}");
    };
    let broken = GOOD.replace("strain_xy = 0.03", "strain_yx = 0.02");
    fails("unknown", &broken, "--friction-angle 30", 3, ".toml:12:1");
    for flag in ["--strain 0.1", "--angle 3", "--cycles 2"] {
        let word = flag.split(' ').next().unwrap();
        fails("flag", GOOD, &format!("--friction-angle 30 {flag}"), 2, word);
    }
    // The cone bears no pull.
    let pulled = "[[leg]]\nheld = [\"xx\", \"yy\"]\nstress_zz_pa = 1e5\n";
    fails("pulled", pulled, "--friction-angle 30", 4, "cycle 1, leg 1, increment");
    let told = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_alluvium")).arg("drive").args(arguments).output();
        let output = output.unwrap();
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let law = ["--youngs-modulus", "1e7", "--friction-angle", "30"];
    assert!(told(&[&["own"][..], &law].concat()).contains("give --legs FILE"));
    assert!(told(&[&["own", "--legs", "none.toml"][..], &law].concat()).contains("cannot read none.toml"));
    assert!(told(&[&["oedometer", "--legs", "none.toml"][..], &law].concat()).contains("path own only"));
}
