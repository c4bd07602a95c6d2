//! `frictionsim frf` of a body of revolution as a user meets it.

use assert_cmd::Command;
use predicates::str::contains;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The hammer test in three dimensions, coarse, struck along the axis at the rim of the top.
const SOLID: [&str; 9] = [
    "material.formulation=three-dimensional",
    "mesh.axial_elements=2",
    "mesh.circumferential_elements=24",
    "mesh.radial_elements=6",
    "frf.force_node={ radius = 0.0905, angle_deg = 30 }",
    "frf.response_node={ radius = 0.0905, angle_deg = 30 }",
    "frf.force_direction=axial",
    "frf.response_direction=axial",
    "frf.frequencies_hz={ from = 20, to = 6000, count = 5981 }",
];

fn frictionsim(folder: &TempDir, command: &str, overrides: &[&str]) -> Command {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/hammer-test.toml");
    let mut run = Command::cargo_bin("frictionsim").unwrap();
    run.current_dir(folder.path()).arg(command).arg(case);
    for set in SOLID.iter().chain(overrides) {
        run.args(["--set", set]);
    }
    run
}

fn json(command: &mut Command) -> Value {
    let output = command.arg("--json").output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{text}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn damping_is_identified_from_the_response_of_a_disc_with_thickness() {
    let folder = tempfile::tempdir().unwrap();
    let summary = json(frictionsim(&folder, "frf", &[]).args(["--out", "frf"]));
    assert_eq!(summary["method"], "cyclic");
    assert_eq!(summary["dofs"], 24 * 7 * 3 * 3);
    let description = summary["description"].as_str().unwrap();
    // The nodes of 7 x 3 of each sector; that of the rim is the last of the top.
    assert!(description.contains("node 63 axial"), "{description}");
    let mut identify = Command::cargo_bin("frictionsim").unwrap();
    identify.current_dir(folder.path());
    let found = json(identify.args(["identify", "frf/frf.csv", "--no-figures"]));
    for (key, exact, bound) in
        [("mass_coefficient", 40.0, 0.1), ("stiffness_coefficient", 4.5e-7, 0.05)]
    {
        // Noise of 1 %: a few standard errors of the estimates of a dozen modes.
        let value = found[key]["value"].as_f64().unwrap();
        assert!((value / exact - 1.0).abs() < bound, "{key}: {value}");
    }
    // The figures again from the folder alone.
    let figure = folder.path().join("frf/figures/response.svg");
    let before = fs::read(&figure).unwrap();
    fs::remove_file(&figure).unwrap();
    let mut plot = Command::cargo_bin("frictionsim").unwrap();
    let plotted = plot.current_dir(folder.path()).args(["plot", "frf"]);
    plotted.assert().code(0);
    assert_eq!(fs::read(&figure).unwrap(), before);
}

#[test]
fn the_response_in_sliding_contact_is_that_of_the_case_and_its_cost_is_known_before() {
    let folder = tempfile::tempdir().unwrap();
    let sliding = [
        "frf.boundary=sliding",
        "frf.force_node={ radius = 0.0205, angle_deg = 0 }",
        "frf.response_node={ radius = 0.0205, angle_deg = 90 }",
        "frf.frequencies_hz={ from = 500, to = 5000, count = 10 }",
    ];
    let checked = json(&mut frictionsim(&folder, "check", &sliding));
    assert_eq!(checked["cases"][0]["frf"]["lines"], 10);
    let summary = json(frictionsim(&folder, "frf", &sliding).args(["--out", "frf"]));
    // All nodes but those of the clamped rim, and three held along the normal.
    assert_eq!(summary["dofs"], 24 * (6 * 3 * 3 - 3));
    assert!(summary["backward_error"].as_f64().unwrap() <= 1e-14);
}

#[test]
fn methods_of_plane_bodies_and_held_nodes_are_refused_with_key_and_remedy() {
    let folder = tempfile::tempdir().unwrap();
    for method in ["direct", "reduced"] {
        let set = format!("frf.method={method}");
        for command in ["frf", "check"] {
            let run = frictionsim(&folder, command, &[&set]).assert().code(2);
            run.stderr(contains(format!(
                "frf.method = \"{method}\" is for bodies that are solved on their whole mesh"
            )))
            .stderr(contains("use \"auto\" or \"cyclic\""));
        }
    }
    let held = frictionsim(&folder, "frf", &["frf.boundary=clamped"]);
    let run = { held }.assert().code(2);
    run.stderr(contains("frf.force_node = 63 cannot move in axial direction"))
        .stderr(contains("frf.boundary = \"free\""));
}
