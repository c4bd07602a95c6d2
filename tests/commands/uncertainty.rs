//! Probability of squeal from uncertain parameters.
//!
//! Independent checks: the closed form of a disc whose modulus alone is uncertain, and the same numbers whatever the
//! threads, the shards and the interruptions.

use assert_cmd::Command;
use frictionsim::case::Case;
use frictionsim::study::eigenvalues::modes_and_onsets;
use frictionsim::study::uncertainty::Sampler;
use serde_json::Value;
use std::path::{Path, PathBuf};

const COARSE: [&str; 5] = [
    "mesh.circumferential_elements=24",
    "mesh.radial_elements=4",
    "cea.max_frequency_hz=14000",
    "uncertainty.samples=160",
    "uncertainty.index_samples=64",
];

fn command(name: &str, out: &Path, set: &[&str], further: &[&str]) -> Command {
    let mut command = Command::cargo_bin("frictionsim").unwrap();
    let case: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    command.arg("uncertainty").arg(case).args(["--json", "--no-figures", "--out"]).arg(out);
    for text in COARSE.iter().chain(set) {
        command.args(["--set", text]);
    }
    command.args(further);
    command
}

fn run(out: &Path, set: &[&str], further: &[&str]) -> Value {
    let output = command("squeal-probability.toml", out, set, further).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// With rigid contact, a clamped rim and the modulus alone uncertain `kappa` scales with `E`: the onset of each branch is one curve over `E`, and quantiles of the modulus are quantiles of the onset.
#[test]
fn the_distribution_of_onsets_is_that_of_the_modulus_seen_through_one_curve() {
    let folder = tempfile::tempdir().unwrap();
    let rigid = [
        "boundaries={ outer = { condition = \"clamped\" } }",
        "contact.normal_stiffness=\"rigid\"",
        "uncertainty.distributions={ \"material.young_modulus\" = { normal = [2.5e9, 1e8] } }",
    ];
    let found = run(&folder.path().join("out"), &rigid, &[]);
    let at = |modulus: f64| {
        let mut set = rigid.to_vec();
        let modulus = format!("material.young_modulus={modulus:?}");
        set.push(&modulus);
        let mut command = Command::cargo_bin("frictionsim").unwrap();
        let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/squeal-probability.toml");
        command.arg("cea").arg(case).args([
            "--json",
            "--no-figures",
            "--unset",
            "uncertainty",
            "--out",
        ]);
        command.arg(folder.path().join(&modulus));
        for text in COARSE[..3].iter().chain(&set[..2]).chain([&modulus.as_str()]) {
            command.args(["--set", text]);
        }
        let output = command.output().unwrap();
        let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
        let onsets = summary["critical_frictions"].as_array().unwrap().iter();
        let onsets = onsets.map(|onset| onset["critical_friction"].as_f64().unwrap());
        onsets.fold(f64::INFINITY, f64::min)
    };
    let critical = &found["critical_friction"];
    let number = |key: &str| critical[key].as_f64().unwrap();
    // The lowest onset falls or rises with the modulus throughout: 5 % of one are 5 % of the other.
    let (low, middle, high) = (at(2.5e9 - 1.644854e8), at(2.5e9), at(2.5e9 + 1.644854e8));
    let (least, most) = (low.min(high), low.max(high));
    let spread = most - least;
    assert!((number("median") - middle).abs() < 0.03 * spread, "{critical} {middle}");
    assert!((number("p05") - least).abs() < 0.05 * spread, "{critical} {least}");
    assert!((number("p95") - most).abs() < 0.05 * spread, "{critical} {most}");
    assert!(number("mean_low") < number("mean") && number("mean") < number("mean_high"));
    let index = &found["sobol"]["material.young_modulus"];
    for order in ["first", "total"] {
        assert!((index[order].as_f64().unwrap() - 1.0).abs() < 0.02, "{index}");
    }
}

#[test]
fn threads_shards_and_interruptions_leave_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    let found = run(&one, &[], &["--threads", "1"]);
    // The second half first; then the first, which finds the other there.
    run(&two, &[], &["--threads", "2", "--shard", "2/2"]);
    assert!(!two.join("samples.csv").exists());
    run(&two, &[], &["--threads", "2", "--resume"]);
    let bytes = |folder: &Path, name: &str| std::fs::read(folder.join(name)).unwrap();
    for name in ["samples.csv", "points/point-000001.json", "points/point-000003.json"] {
        assert!(bytes(&one, name) == bytes(&two, name), "{name}");
    }
    let table = String::from_utf8(bytes(&one, "samples.csv")).unwrap();
    assert_eq!(table.lines().count(), 161);
    let p = &found["probability_unstable"];
    let [value, low, high] = ["value", "low", "high"].map(|key| p[key].as_f64().unwrap());
    assert!(0.0 <= low && low <= value && value <= high && high <= 1.0);
    for family in found["families"].as_array().unwrap() {
        assert!(family["probability"].as_f64().unwrap() <= value);
    }
    assert_eq!(found["sobol"].as_object().unwrap().len(), 4);
    // A finished run is not repeated in silence.
    let again = command("squeal-probability.toml", &one, &[], &[]).output().unwrap();
    assert_eq!(again.status.code(), Some(2));
}

#[test]
fn a_design_is_named_that_brings_the_probability_below_a_bound() {
    let folder = tempfile::tempdir().unwrap();
    let few = ["uncertainty.samples=32", "uncertainty.index_samples=0"];
    let idle = ["--robust", "transient.duration=0.1:0.3:2"];
    let design = ["--robust", "contact.friction_coefficient=0.02:0.3:5", "--bound", "0.2"];
    let found = run(&folder.path().join("out"), &few, &[&design[..], &idle].concat());
    // A key that moves no onset is said to have no effect.
    assert_eq!(found["robust"]["curves"][1]["has_effect"], false);
    let curve = &found["robust"]["curves"][0];
    let points = curve["points"].as_array().unwrap();
    assert_eq!(points.len(), 5);
    // Friction makes squeal: none with the least, more with each.
    let p: Vec<f64> = points.iter().map(|point| point[1].as_f64().unwrap()).collect();
    assert!(p.is_sorted() && p[0] < 0.2 && p[4] > 0.2, "{p:?}");
    let reached = curve["reaches_bound_at"].as_f64().unwrap();
    assert!(reached > 0.02 && reached < 0.3);
    assert_eq!(found["robust"]["cheapest"], "contact.friction_coefficient");
    assert!(found["sobol"].as_object().unwrap().is_empty());
}

#[test]
fn distributions_that_reach_forbidden_values_are_refused_or_said() {
    let folder = tempfile::tempdir().unwrap();
    let of = |text: &str| {
        let set = [text, "uncertainty.samples=2", "uncertainty.index_samples=0"];
        let output = command("squeal-probability.toml", folder.path(), &set, &["--dry-run"])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code().unwrap(), said)
    };
    let key = "uncertainty.distributions.\"material.poisson_ratio\"";
    for (value, part) in [
        ("{ uniform = [0.3, 0.6] }", "lies where the key"),
        ("{ normal = [0.45, 0.05] }", "lies where the key"),
        ("{ normal = [0.38, -0.01] }", "a positive deviation"),
        ("{ uniform = [0.4, 0.3] }", "two rising ends"),
        ("{ log_normal = [0.0, 0.1] }", "two positive numbers"),
        ("{ triangular = [0.3, 0.4] }", "unknown key `triangular`"),
        ("{ normal = [0.38] }", "two numbers"),
        ("{ normal = [0.38, \"x\"] }", "a finite number"),
        ("{ normal = [0.38, 0.01], uniform = [0.3, 0.4] }", "two distributions"),
        ("0.3", "no distribution"),
    ] {
        let (code, said) = of(&format!("{key}={value}"));
        assert_eq!(code, 2, "{value}: {said}");
        assert!(said.contains(part), "{value}: {said}");
    }
    // One in a thousand is left out, and said.
    let (code, said) = of(&format!("{key}={{ normal = [0.44, 0.02] }}"));
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("drawn from the rest"), "{said}");
}

/// The block of the shipped case slides with a friction far above its onset: samples have the onset that `cea` finds, and where the
/// lowest friction of an analysis is unstable already, a sweep says that it is no critical one.
#[test]
fn samples_of_solid_bodies_beyond_their_onset_have_the_onset_of_an_analysis() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/tread-block.toml");
    let text = std::fs::read(&path).unwrap();
    let uncertain = [
        "cea.friction_coefficients=[0.0, 0.4, 0.5, 0.6]",
        "cea.modes=3",
        "uncertainty={ samples = 2, seed = 1, index_samples = 0 }",
        "uncertainty.distributions={ \"material.density\" = { uniform = [1149.9999999, 1150.0000001] } }",
    ];
    let case = Case::parse(path.to_str().unwrap(), &text, &uncertain.map(str::to_owned)).unwrap();
    let known = modes_and_onsets(&case).unwrap().intervals;
    let known = known.iter().map(|own| own.critical_friction).fold(f64::INFINITY, f64::min);
    assert!((known - 0.4511).abs() < 1e-4, "{known}");
    let samples = Sampler::new(&case).unwrap().block(1);
    let onset = samples[0].lowest(0.6).unwrap();
    assert!((onset.critical_friction - known).abs() < 1e-6, "{onset:?} {known}");
    assert!(!onset.unstable_from_start && samples[0].is_unstable(0.6));

    let out = tempfile::tempdir().unwrap();
    let mut sweep = Command::cargo_bin("frictionsim").unwrap();
    sweep
        .arg("sweep")
        .arg(&path)
        .args(["--no-figures", "-q", "--out"])
        .arg(out.path().join("sweep"));
    for set in [
        "cea.friction_coefficients=[0.6]",
        "cea.modes=1",
        "sweep={ \"material.density\" = [1150.0], analyses = [\"cea\"] }",
    ] {
        sweep.args(["--set", set]);
    }
    sweep.assert().success().stdout(predicates::str::contains("<=0.600000"));
}

/// Where friction itself is uncertain each sample has its own, and the answer names none.
#[test]
fn uncertain_friction_is_no_single_value() {
    let folder = tempfile::tempdir().unwrap();
    let set = [
        "uncertainty.distributions={ \"contact.friction_coefficient\" = { uniform = [0.05, 0.3] } }",
        "uncertainty.samples=8",
        "uncertainty.index_samples=0",
    ];
    let found = run(&folder.path().join("out"), &set, &[]);
    assert!(found["friction_coefficient"].is_null(), "{found}");
    let known = run(
        &folder.path().join("known"),
        &["uncertainty.samples=2", "uncertainty.index_samples=0"],
        &[],
    );
    assert!(known["friction_coefficient"].is_number(), "{known}");
}
