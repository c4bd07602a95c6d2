//! Brakes that creep: friction across the sliding, a dashpot of `mu p / V`, overdamps the modes that slide across.

use assert_cmd::Command;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

/// Frequencies and growth rates at friction 0.32, and what the command printed, of the brake of the operating matrix at 3 rpm.
fn spectrum(frictions: &str) -> (Vec<[f64; 2]>, String) {
    let folder = tempfile::tempdir().unwrap();
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let text = fs::read_to_string(cases.join("operating-matrix.toml")).unwrap();
    let (case, _) = text.split_once("[sweep]").unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    let mesh = "meshes/brake.inp";
    fs::copy(cases.join(mesh), folder.path().join(mesh)).unwrap();
    fs::write(folder.path().join("brake.toml"), case).unwrap();
    let mut program = Command::cargo_bin("frictionsim").unwrap();
    program.current_dir(folder.path());
    program.args(["cea", "brake.toml", "--out", "run", "--no-figures"]);
    for set in [
        "boundaries.Outer_Piston.pressure=1.5e6",
        "boundaries.Inner_Piston.pressure=1.5e6",
        "motion.Disc_Disc_iron.rotation_speed_rpm=3",
        "cea.max_frequency_hz=3100",
        &format!("cea.friction_coefficients={frictions}"),
    ] {
        program.args(["--set", set]);
    }
    let output = program.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    // How the input file was read is for `check` to say.
    assert!(!said.contains("are numbered from") && !said.contains("taken from"), "{said}");
    let table = fs::read_to_string(folder.path().join("run/eigenvalues.csv")).unwrap();
    let rows = table
        .lines()
        .skip(1)
        .map(|line| -> Vec<String> { line.split(',').map(str::to_owned).collect() });
    let own = rows.filter(|row| row[0] == "0.32");
    let modes = own.map(|row| [3, 5].map(|column: usize| row[column].parse().unwrap()));
    (modes.collect(), said.into_owned())
}

/// Consistency check: the modes at one friction value do not depend on the values before it, through which branches end.
#[test]
fn modes_that_slow_sliding_overdamps_end_their_branches_and_are_said() {
    let (coarse, said) = spectrum("[0.0, 0.32]");
    for part in ["near critical damping", "2972 Hz from friction 0 on", "mu p / V"] {
        assert!(said.contains(part), "{part:?} is not in\n{said}");
    }
    let (fine, _) = spectrum("[0.0, 0.02, 0.16, 0.32]");
    assert_eq!(coarse.len(), fine.len());
    assert!(coarse.len() >= 5);
    for (a, b) in coarse.iter().zip(&fine) {
        let error = (a[0] - b[0]).hypot((a[1] - b[1]) / TAU) / a[0];
        assert!(error < 1e-8, "{a:?} {b:?}");
    }
}
