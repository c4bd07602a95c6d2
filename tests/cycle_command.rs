//! `frictionsim cycle` as a user runs it: the shipped case at full size, and what it says where there is no cycle.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str], out: &Path) -> Output {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/limit-cycle.toml");
    Command::new(env!("CARGO_BIN_EXE_frictionsim"))
        .args(["cycle", case, "--json", "--no-figures", "--out"])
        .arg(out)
        .args(arguments)
        .output()
        .unwrap()
}

fn error(arguments: &[&str]) -> (i32, String) {
    let folder = tempfile::tempdir().unwrap();
    let output = run(arguments, &folder.path().join("cycle"));
    let text = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), text)
}

#[test]
fn shipped_case_follows_both_waves_over_the_speed_and_says_where_the_single_one_loses_stability() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("cycle");
    let output = run(&["--set", "cycle.frames=3"], &out);
    assert!(output.status.success(), "{output:?}");
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [one, two] = summary["cycles"].as_array().unwrap().as_slice() else {
        panic!("two waves");
    };
    for wave in [one, two] {
        assert_eq!(wave["stability"]["is_stable"], true);
        let branch = &wave["branch"];
        assert!(branch["cycles"].as_u64().unwrap() >= 61);
        let ends = serde_json::json!(["the range ends", "the range ends"]);
        assert_eq!(branch["ends"], ends);
    }
    let changes = one["branch"]["stability_changes"].as_array().unwrap();
    assert_eq!(changes.len(), 1);
    // Transients that start on the cycle stay at 1229 rpm and have left it at 1400.
    let at = changes[0]["at"].as_f64().unwrap();
    assert!((1229.0..1400.0).contains(&at), "{at}");
    assert_eq!(changes[0]["harmonic"], 1);
    assert!(
        two["branch"]["stability_changes"]
            .as_array()
            .unwrap()
            .is_empty()
    );

    let frames = std::fs::read_to_string(out.join("cycle-n2.pvd")).unwrap();
    assert!(frames.contains("cycle-n2.vtu") && frames.contains("cycle-n2-002.vtu"));
    assert!(out.join("cycle-n1-001.vtu").exists() && !out.join("cycle-n1-003.vtu").exists());

    let table = std::fs::read_to_string(out.join("stability-n1.csv")).unwrap();
    let header = "contact.rotation_speed_rpm,class,growth_rate_per_s,wave_frequency_rad_per_s,harmonic,frequency_hz";
    assert_eq!(table.lines().next().unwrap(), header);
    let branch = std::fs::read_to_string(out.join("branch-n1.csv")).unwrap();
    assert!(
        branch
            .lines()
            .next()
            .unwrap()
            .ends_with("growth_rate_per_s")
    );
}

#[test]
fn what_cannot_be_found_says_why_and_what_to_change() {
    let (code, text) = error(&["--set", "mesh.element=quad8"]);
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("quad4"), "{text}");
    let (code, text) = error(&["--set", "contact.friction_coefficient=0.05"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("contact.friction_coefficient"), "{text}");
    // A mesh too coarse for the wave: it is refused, not reported.
    let coarse = [
        "mesh.circumferential_elements=60",
        "mesh.radial_elements=12",
        "cycle.harmonics=[2]",
    ];
    let arguments: Vec<&str> = coarse.iter().flat_map(|set| ["--set", set]).collect();
    let (code, text) = error(&arguments);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains("refine the mesh") && text.contains("mesh.circumferential_elements"),
        "{text}"
    );
}
