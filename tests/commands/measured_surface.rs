//! `contacts.*.gap`: a measured surface beside a case.

use assert_cmd::Command;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The shipped brake in a folder of its own.
fn brake(folder: &TempDir) -> PathBuf {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    fs::create_dir(folder.path().join("meshes")).unwrap();
    for name in ["brake.toml", "meshes/brake.inp"] {
        fs::copy(cases.join(name), folder.path().join(name)).unwrap();
    }
    folder.path().join("brake.toml")
}

/// The face of the outer lining, worn by `gap` of the angle from its middle (degrees) and the radius (m).
fn table(header: &str, gap: impl Fn(f64, f64) -> f64) -> String {
    let mut text = format!("{header}\n");
    for i in 0..=20 {
        for j in 0..=40 {
            let (radius, angle) = (0.070 + 0.002 * f64::from(i), f64::from(j) * 1.3 - 26.0);
            let (sine, cosine) = (90.0 + angle).to_radians().sin_cos();
            let (x, y) = (radius * cosine, radius * sine);
            writeln!(text, "{x:.6},{y:.6},0.006,{:.4e}", gap(angle, radius)).unwrap();
        }
    }
    text
}

/// Standard output and standard error of an analysis with one mode.
fn cea(case: &Path, set: &[&str]) -> (bool, String) {
    let mut program = Command::cargo_bin("frictionsim").unwrap();
    program.arg("cea").arg(case).args(["--out", "run", "--force", "--no-figures"]);
    program.current_dir(case.parent().unwrap());
    program.args(["--unset", "cea.max_frequency_hz", "--set", "cea.modes=1"]);
    program.args(["--set", "cea.friction_coefficients=[0.4]"]);
    for text in set {
        program.args(["--set", text]);
    }
    let output = program.output().unwrap();
    let said = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8(said).unwrap())
}

const GAP: &str = "contacts.Outer_Friction_face.gap=wear.csv";

/// Worn by a millimetre beyond a third of its arc, far more than the pressure closes.
#[test]
fn a_pad_that_is_worn_at_one_end_touches_at_the_other_and_keeps_its_table() {
    let folder = tempfile::tempdir().unwrap();
    let case = brake(&folder);
    let worn = table("x,y,z,gap", |angle, _| if angle > 8.0 { 1e-3 } else { 0.0 });
    fs::write(folder.path().join("wear.csv"), &worn).unwrap();
    let (is_done, said) = cea(&case, &[GAP]);
    assert!(is_done, "{said}");
    let run = folder.path().join("run");
    assert_eq!(fs::read_to_string(run.join("gap-Outer_Friction_face.csv")).unwrap(), worn);
    let points = fs::read_to_string(run.join("prestress.csv")).unwrap();
    let mut counts = [[0; 2]; 2];
    for row in points.lines().skip(1).filter(|row| row.starts_with("Outer")) {
        let cells: Vec<&str> = row.split(',').collect();
        let [x, y]: [f64; 2] = [1, 2].map(|k| cells[k].parse().unwrap());
        let angle = y.atan2(x).to_degrees() - 90.0;
        let is_open = usize::from(cells[7] == "open");
        if angle > 9.5 {
            counts[1][is_open] += 1;
        } else if angle < -5.0 {
            counts[0][is_open] += 1;
        }
    }
    let [[_, _], [closed, worn_open]] = counts;
    assert!(closed == 0 && worn_open > 100, "{counts:?}");
    assert!(counts[0][0] > 100, "{counts:?}");
}

#[test]
fn measured_surfaces_that_cannot_be_meant_are_refused_with_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let case = brake(&folder);
    let write = |text: String| fs::write(folder.path().join("wear.csv"), text).unwrap();
    let refused = |set: &[&str], parts: &[&str]| {
        let (is_done, said) = cea(&case, set);
        assert!(!is_done, "{said}");
        parts.iter().for_each(|part| assert!(said.contains(part), "{part}: {said}"));
    };
    refused(&[GAP], &["cannot read the table", "wear.csv"]);
    write(table("x,y,z,gap_um", |_, _| 1.0));
    refused(&[GAP], &["give x, y, z and gap in m"]);
    write(table("x,y,z", |_, _| 1.0));
    refused(&[GAP], &["contacts.Outer_Friction_face.gap"]);
    // In millimetres, without saying so.
    let millimetres = table("x,y,z,gap", |_, _| 1e-6).replace("0.006", "6");
    write(millimetres);
    refused(
        &[GAP],
        &["no measured point of wear.csv", "are metres in the coordinates of the mesh"],
    );
    write(table("x,y,z,gap", |_, _| 1e-6));
    let closed = [
        GAP,
        "contacts.Outer_Friction_face.state=closed",
        "contacts.Inner_Friction_face.state=closed",
    ];
    refused(&closed, &["closed and free of stress", "leave one of the two out"]);
}
