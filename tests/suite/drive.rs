//! The command `drive`: exit codes, the table, the folder.

use alluvium::output::Table;
use std::path::PathBuf;
use std::process::{Command, Output};

fn drive(arguments: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_alluvium");
    Command::new(program).arg("drive").args(arguments.split_whitespace()).output().unwrap()
}

fn table(arguments: &str) -> Table {
    let output = drive(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
    Table::parse(&String::from_utf8(output.stdout).unwrap()).unwrap()
}

fn last(table: &Table, column: &str) -> f64 {
    *table.column(column).unwrap().last().unwrap()
}

#[test]
fn the_triaxial_plateau_is_the_closed_one() {
    let law =
        "triaxial-compression --youngs-modulus 1e7 --friction-angle 30 --confining-stress 1e5 --steps 50";
    for (cone, plateau) in [("plane-strain-associated", 1.15139), ("triaxial-compression", 2.0)] {
        let rows = table(&format!("{law} --cone {cone}"));
        assert_eq!(rows.rows(), 51);
        let q = last(&rows, "stress_xx [Pa]") - last(&rows, "stress_zz [Pa]");
        assert!((q / 1e5 - plateau).abs() < 1e-5, "{cone}: {q}");
        assert!((last(&rows, "amount [-]") - 0.05).abs() < 1e-15);
    }
    let pyramid = table(&format!("{law} --surface mohr-coulomb --precision f32"));
    let q = last(&pyramid, "stress_xx [Pa]") - last(&pyramid, "stress_zz [Pa]");
    assert!((q / 1e5 - 2.0).abs() < 1e-4, "{q}");
}

#[test]
fn a_stress_turns_with_its_matter() {
    let elastic = "--youngs-modulus 1e7 --surface elastic";
    let rows = table(&format!("rotation {elastic} --start-stress 1e3,-1e3,0,0,0,0 --angle 45 --steps 400"));
    // diag(1, −1) turned by 45° is pure shear.
    assert!((last(&rows, "stress_xy [Pa]") / 1e3 - 1.0).abs() < 1e-6);
    assert!(last(&rows, "stress_xx [Pa]").abs() < 1e-3);
    assert!((last(&rows, "amount [rad]").to_degrees() - 45.0).abs() < 1e-12);
    let shear = table(&format!("simple-shear {elastic} --strain 1 --steps 400 --poissons-ratio 0.25"));
    let (g, at) = (4e6, |name| last(&shear, name));
    assert!((at("stress_xy [Pa]") / (g * 1_f64.sin()) - 1.0).abs() < 1e-6);
    assert!(((at("stress_xx [Pa]") + 1e5) / (g * (1.0 - 1_f64.cos())) - 1.0).abs() < 1e-6);
}

#[test]
fn tension_ends_at_the_cut_off_and_else_at_the_apex() {
    let clay =
        "isotropic --bulk-modulus 1e7 --friction-angle 30 --cohesion 1e4 --confining-stress 0 --strain -0.01";
    let mean = |arguments: &str| {
        let rows = table(&format!("{clay} {arguments}"));
        ["xx", "yy", "zz"].map(|name| last(&rows, &format!("stress_{name} [Pa]"))).iter().sum::<f64>() / 3.0
    };
    assert!((mean("--tension-cut-off 2e3") / 2e3 - 1.0).abs() < 1e-9);
    // c cot θ.
    assert!((mean("") / (1e4 * 3.0_f64.sqrt()) - 1.0).abs() < 1e-9);
}

#[test]
fn a_cycle_ends_where_it_began_and_loses_energy() {
    let sand = "cyclic --bulk-modulus 1e7 --friction-angle 30 --strain 0.02 --cycles 2";
    let rows = table(sand);
    assert_eq!(rows.rows(), 601);
    assert!(last(&rows, "amount [-]").abs() < 1e-15 && last(&rows, "strain_xy [-]").abs() < 1e-12);
    assert!(last(&rows, "lost [J/m3]") > 0.0);
    let rate = table(&format!("{sand} --plasticity rate"));
    assert!((last(&rate, "lost [J/m3]") / last(&rows, "lost [J/m3]") - 1.0).abs() < 0.02);
}

#[test]
fn a_folder_gets_a_table_and_a_picture() {
    let folder = std::env::temp_dir().join(format!("alluvium-drive-{}", std::process::id()));
    std::fs::remove_dir_all(&folder).ok();
    let paths = ["oedometer", "triaxial-extension", "isotropic", "pure-shear"];
    for path in paths {
        let out: PathBuf = folder.join(path);
        let arguments = format!("{path} --youngs-modulus 1e7 --friction-angle 30 --out {}", out.display());
        let output = drive(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(output.stdout.is_empty());
        let rows = Table::parse(&std::fs::read_to_string(out.join("path.csv")).unwrap()).unwrap();
        assert_eq!(rows.rows(), 101);
        let svg = std::fs::read_to_string(out.join("path.svg")).unwrap();
        assert!(svg.contains("stress path") && !svg.contains("NaN"), "{path}");
        assert_eq!(drive(&arguments).status.code(), Some(2), "a folder that is not empty");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_is_wrong_is_told_by_its_code() {
    let cases = [
        ("oedometer", 2, "--youngs-modulus"),
        ("oedometer --youngs-modulus 1e7 --bulk-modulus 1e7 --friction-angle 30", 2, "cannot be used with"),
        ("climb --youngs-modulus 1e7", 2, "climb"),
        ("oedometer --youngs-modulus 1e7 --friction-angle 30 --angle 3", 2, "--angle"),
        ("rotation --youngs-modulus 1e7 --friction-angle 30 --strain 3", 2, "--strain"),
        ("oedometer --youngs-modulus 1e7 --surface elastic --cohesion 3", 2, "--cohesion"),
        ("oedometer --youngs-modulus 1e7 --surface mohr-coulomb --cone plane-strain", 2, "--cone"),
        ("oedometer --youngs-modulus 1e7 --friction-angle 30 --start-stress 1,2", 2, "six"),
        ("oedometer --youngs-modulus 1e7 --friction-angle 30 --start-stress 1e3,0,0,0,0,0", 2, "outside"),
        ("oedometer --youngs-modulus 1e7 --friction-angle 30 --strain 0", 2, "nowhere"),
        ("oedometer --youngs-modulus -1 --friction-angle 30", 3, "youngs_modulus"),
        ("oedometer --youngs-modulus 1e7 --poissons-ratio 0.5 --friction-angle 30", 3, "poissons_ratio"),
        ("oedometer --youngs-modulus 1e7", 3, "cohesion"),
        ("oedometer --youngs-modulus 1e7 --friction-angle 30 --dilatancy-angle 40", 3, "dilatancy"),
        ("triaxial-extension --youngs-modulus 1e7 --cohesion 1e4 --strain inf", 2, "finite"),
        ("oedometer --youngs-modulus 1e300 --friction-angle 30 --strain 1e100", 4, "infinite"),
    ];
    for (arguments, code, word) in cases {
        let output = drive(arguments);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments}: {told}");
        assert!(told.contains(word), "{arguments}: {told}");
    }
}
