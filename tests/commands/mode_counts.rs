//! `cea.count_modes` as a user meets it.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// What the command prints with counts of modes, whether it succeeds, and its summary.
fn run(case: &str, sets: &[&str]) -> (String, bool, Value) {
    let folder = tempfile::tempdir().unwrap();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(case);
    let mut program = Command::cargo_bin("frictionsim").unwrap();
    program.arg("cea").arg(case).arg("--out").arg(folder.path().join("run"));
    program.args(["--no-figures", "--set", "cea.count_modes=true"]);
    for set in sets {
        program.args(["--set", set]);
    }
    let output = program.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    let summary = fs::read_to_string(folder.path().join("run/summary.json"));
    let summary = summary.map_or(Value::Null, |text| serde_json::from_str(&text).unwrap());
    (said.into_owned(), output.status.success(), summary)
}

/// Bodies without symmetry, damping that is not proportional: every list is complete, in words and in the summary.
#[test]
fn counts_are_printed_and_summed_up() {
    for (case, sets, modes, counts) in [
        ("sliding-block.toml", vec![], 10, 3),
        ("pad-on-disc.toml", vec!["cea.friction_coefficients=[0.0, 0.22, 0.5]"], 11, 4),
    ] {
        let (said, is_done, summary) = run(case, &sets);
        assert!(is_done, "{said}");
        let line = format!("counted {modes} modes below");
        assert!(said.contains(&line) && said.contains(": complete"), "{said}");
        let found = summary["mode_counts"].as_array().unwrap();
        assert_eq!(found.len(), counts, "{found:?}");
        for count in found {
            assert_eq!(count["is_complete"], true, "{count}");
            assert_eq!(count["counted"], count["known"]);
        }
    }
}

/// What cannot be counted is refused at its key, with the reason; what always is counted says so.
#[test]
fn what_cannot_be_counted_is_refused() {
    let (said, is_done, _) = run("disc-three-dimensions.toml", &[]);
    assert!(!is_done);
    for part in ["cea.count_modes = true", "body of revolution", "leave it out"] {
        assert!(said.contains(part), "{part:?} is not in\n{said}");
    }
    let (said, is_done, _) = run("brake-lining.toml", &[]);
    assert!(!is_done);
    assert!(said.contains("is a table over frequency"), "{said}");
    let coarse = ["mesh.circumferential_elements=24", "mesh.radial_elements=4"];
    let (said, is_done, summary) = run("polycarbonate-disc.toml", &coarse);
    assert!(is_done, "{said}");
    assert!(said.contains("the harmonics of an annulus are always counted"), "{said}");
    assert!(summary["mode_counts"].is_null());
}
