//! `cea.count_modes` as a user meets it.

use crate::prelude::*;

fn counted(case: &str, sets: &[&str], code: i32) -> (Answer, tempfile::TempDir) {
    let folder = folder();
    let run = Run::of("cea", shipped(case)).out(folder.path().join("run"));
    (run.set(&["cea.count_modes=true"]).set(sets).end().code(code), folder)
}

/// Bodies without symmetry, damping that is not proportional: every list is complete, in words and in the summary.
#[test]
fn counts_are_printed_and_summed_up() {
    for (case, sets, modes, counts) in [
        ("sliding-block.toml", vec![], 10, 3),
        ("pad-on-disc.toml", vec!["cea.friction_coefficients=[0.0, 0.22, 0.5]"], 11, 4),
    ] {
        let (answer, _folder) = counted(case, &sets, 0);
        let line = format!("counted {modes} modes below");
        let summary = answer.says(&[&line, ": complete"]).summary();
        let found = summary["mode_counts"].as_array().unwrap();
        assert_eq!(found.len(), counts, "{found:?}");
        for count in found {
            assert_eq!(count["is_complete"], true, "{count}");
            assert_eq!(count["counted"], count["known"]);
        }
    }
}

#[test]
fn what_cannot_be_counted_is_refused() {
    let refused = counted("disc-three-dimensions.toml", &[], 2).0;
    refused.warns(&["cea.count_modes = true", "body of revolution", "leave it out"]);
    counted("brake-lining.toml", &[], 2).0.warns(&["is a table over frequency"]);
    let coarse = ["mesh.circumferential_elements=24", "mesh.radial_elements=4"];
    let (answer, _folder) = counted("polycarbonate-disc.toml", &coarse, 0);
    assert!(answer.said().contains("the harmonics of an annulus are always counted"));
    assert!(answer.summary()["mode_counts"].is_null());
}

/// A disc without damping on a soft contact: every branch that friction feeds grows, by a part of a thousand million. With little damping
/// none does, and nothing is said.
#[test]
fn branches_that_hardly_grow_are_told_from_squeal() {
    let run = |damping: &str| {
        let sets = [
            "mesh.circumferential_elements=24",
            "mesh.radial_elements=4",
            "cea.geometric_stiffness=false",
            "contact.normal_stiffness=1e5",
            "damping.stiffness_coefficient=0",
            damping,
        ];
        let folder = folder();
        let run = Run::of("cea", shipped("polycarbonate-disc.toml")).out(folder.path().join("run"));
        run.set(&sets).end().code(0).said().to_owned()
    };
    let undamped = run("damping.mass_coefficient=0");
    let note = "13 unstable branches hardly grow (";
    assert!(undamped.contains(note), "{undamped}");
    let damped = run("damping.mass_coefficient=1");
    assert!(damped.contains("0 unstable") && !damped.contains("hardly grow"), "{damped}");
}
