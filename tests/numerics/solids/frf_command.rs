//! `frictionsim frf` of a body of revolution as a user meets it.

use crate::prelude::*;

/// The hammer test in three dimensions, coarse, struck along the axis at the rim of the top.
const SOLID: [&str; 1] = ["material.formulation=three-dimensional ; mesh.axial_elements=2 ; \
     mesh.circumferential_elements=24 ; mesh.radial_elements=6 ; \
     frf.force_node={ radius = 0.0905, angle_deg = 30 } ; \
     frf.response_node={ radius = 0.0905, angle_deg = 30 } ; frf.force_direction=axial ; \
     frf.response_direction=axial ; frf.frequencies_hz={ from = 20, to = 6000, count = 5981 }"];

fn run(folder: &TempDir, command: &str, overrides: &[&str]) -> Run {
    let words = [command, &shipped("hammer-test.toml")];
    Run::new(&words).within(folder).set(&SOLID).set(overrides)
}

#[test]
fn damping_is_identified_from_the_response_of_a_disc_with_thickness() {
    let folder = folder();
    let answer = run(&folder, "frf", &[]).out("frf").done();
    let summary = answer.summary();
    assert_eq!(summary["method"], "cyclic");
    assert_eq!(summary["dofs"], 24 * 7 * 3 * 3);
    // The nodes of 7 x 3 of each sector; that of the rim is the last of the top.
    has(summary["description"].as_str().unwrap(), &["node 63 axial"]);
    let found = Run::of("identify", "frf/frf.csv").within(&folder).args(&["--json"]).done().value();
    let coefficients = [("mass_coefficient", 40.0, 0.1), ("stiffness_coefficient", 4.5e-7, 0.05)];
    for (key, exact, bound) in coefficients {
        // Noise of 1 %: a few standard errors of the estimates of a dozen modes.
        near(found[key]["value"].as_f64().unwrap(), exact, bound);
    }
    // The figures again from the folder alone.
    let figure = "figures/response.svg";
    let before = answer.bytes(figure);
    fs::remove_file(answer.path(figure)).unwrap();
    Run::new(&["plot", "frf"]).within(&folder).done();
    assert_eq!(answer.bytes(figure), before);
}

#[test]
fn the_response_in_sliding_contact_is_that_of_the_case_and_its_cost_is_known_before() {
    let folder = folder();
    let sliding = ["frf.boundary=sliding ; frf.force_node={ radius = 0.0205, angle_deg = 0 } ; \
         frf.response_node={ radius = 0.0205, angle_deg = 90 } ; \
         frf.frequencies_hz={ from = 500, to = 5000, count = 10 }"];
    let checked = run(&folder, "check", &sliding).args(&["--json"]).done().value();
    assert_eq!(checked["cases"][0]["frf"]["lines"], 10);
    let summary = run(&folder, "frf", &sliding).out("frf").done().summary();
    // All nodes but those of the clamped rim, and three held along the normal.
    assert_eq!(summary["dofs"], 24 * (6 * 3 * 3 - 3));
    assert!(summary["backward_error"].as_f64().unwrap() <= 1e-14);
    // The eigenproblem has the same ones.
    let modes = ["cea={ friction_coefficients = [0.0, 0.3], max_frequency_hz = 3000 }"];
    let waves = run(&folder, "cea", &modes).out("cea").done().summary();
    assert_eq!(waves["dofs"], summary["dofs"]);
}
