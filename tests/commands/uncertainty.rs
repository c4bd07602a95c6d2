//! Probability of squeal from uncertain parameters.
//!
//! Independent checks: the closed form of a disc whose modulus alone is uncertain, and the same numbers whatever the
//! threads, the shards and the interruptions.

use crate::prelude::*;
use frictionsim::study::uncertainty::Sampler;

const COARSE: [&str; 2] = [
    "mesh.circumferential_elements=24 ; mesh.radial_elements=4 ; cea.max_frequency_hz=14000",
    "uncertainty.samples=160 ; uncertainty.index_samples=64",
];

fn uncertainty(set: &[&str]) -> Run {
    let run = Run::of("uncertainty", shipped("squeal-probability.toml")).args(&["--json"]);
    run.set(&COARSE).set(set)
}

fn found(set: &[&str]) -> Value {
    uncertainty(set).done().value()
}

/// With rigid contact, a clamped rim and the modulus alone uncertain `kappa` scales with `E`: the onset of each branch is one curve over `E`, and quantiles of the modulus are quantiles of the onset.
#[test]
fn the_distribution_of_onsets_is_that_of_the_modulus_seen_through_one_curve() {
    let rigid = [
        "boundaries={ outer = { condition = \"clamped\" } }",
        "contact.normal_stiffness=\"rigid\"",
        "uncertainty.distributions={ \"material.young_modulus\" = { normal = [2.5e9, 1e8] } }",
    ];
    let found = found(&rigid);
    let at = |modulus: f64| {
        let modulus = format!("material.young_modulus={modulus:?}");
        let run = Run::of("cea", shipped("squeal-probability.toml"));
        let run = run.args(&["--json", "--unset", "uncertainty"]);
        let summary = run.set(&COARSE[..1]).set(&rigid[..2]).set(&[&modulus]).end().value();
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
    for (key, exact, of) in [("median", middle, 0.03), ("p05", least, 0.05), ("p95", most, 0.05)] {
        below((number(key) - exact).abs(), of * spread, format!("{critical} {exact}"));
    }
    assert!(number("mean_low") < number("mean") && number("mean") < number("mean_high"));
    let index = &found["sobol"]["material.young_modulus"];
    for order in ["first", "total"] {
        assert!((index[order].as_f64().unwrap() - 1.0).abs() < 0.02, "{index}");
    }
}

#[test]
fn threads_shards_and_interruptions_leave_the_same_bytes() {
    let folder = folder();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    let run = |out: &Path, words: &[&str]| uncertainty(&[]).out(out).args(words);
    let whole = run(&one, &["--threads", "1"]).done();
    // The second half first; then the first, which finds the other there.
    run(&two, &["--threads", "2", "--shard", "2/2"]).done();
    assert!(!two.join("samples.csv").exists());
    let parts = run(&two, &["--threads", "2", "--resume"]).done();
    for name in ["samples.csv", "points/point-000001.json", "points/point-000003.json"] {
        assert!(whole.bytes(name) == parts.bytes(name), "{name}");
    }
    assert_eq!(whole.text("samples.csv").lines().count(), 161);
    let summary = whole.value();
    let p = &summary["probability_unstable"];
    let [value, low, high] = ["value", "low", "high"].map(|key| p[key].as_f64().unwrap());
    assert!(0.0 <= low && low <= value && value <= high && high <= 1.0);
    for family in summary["families"].as_array().unwrap() {
        assert!(family["probability"].as_f64().unwrap() <= value);
    }
    assert_eq!(summary["sobol"].as_object().unwrap().len(), 4);
    // A finished run is not repeated in silence.
    run(&one, &[]).refused(&[]);
}

#[test]
fn a_design_is_named_that_brings_the_probability_below_a_bound() {
    let few = ["uncertainty.samples=32", "uncertainty.index_samples=0"];
    let idle = ["--robust", "transient.duration=0.1:0.3:2"];
    let design = ["--robust", "contact.friction_coefficient=0.02:0.3:5", "--bound", "0.2"];
    let found = uncertainty(&few).args(&design).args(&idle).done().value();
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
fn a_distribution_whose_tail_is_forbidden_is_drawn_without_it() {
    let tail =
        ["uncertainty.distributions.\"material.poisson_ratio\"={ normal = [0.44, 0.02] } ; \
         uncertainty.samples=2 ; uncertainty.index_samples=0"];
    // One in a thousand is left out, and said.
    uncertainty(&tail).args(&["--dry-run"]).done().warns(&["drawn from the rest"]);
}

/// The block of the shipped case slides with a friction far above its onset: samples have the onset that `cea` finds, and where the
/// lowest friction of an analysis is unstable already, a sweep says that it is no critical one.
#[test]
fn samples_of_solid_bodies_beyond_their_onset_have_the_onset_of_an_analysis() {
    let uncertain = ["cea.friction_coefficients=[0.0, 0.4, 0.5, 0.6] ; cea.modes=3 ; \
         uncertainty={ samples = 2, seed = 1, index_samples = 0 } ; \
         uncertainty.distributions={ \"material.density\" = { uniform = [1149.9999999, 1150.0000001] } }"];
    let case = shipped_case("tread-block.toml", &uncertain);
    let known = modes_and_onsets(&case).unwrap().intervals;
    let known = known.iter().map(|own| own.critical_friction).fold(f64::INFINITY, f64::min);
    assert!((known - 0.4511).abs() < 1e-4, "{known}");
    let samples = Sampler::new(&case).unwrap().block(1);
    let onset = samples[0].lowest(0.6).unwrap();
    assert!((onset.critical_friction - known).abs() < 1e-6, "{onset:?} {known}");
    assert!(!onset.unstable_from_start && samples[0].is_unstable(0.6));
    let set = ["cea.friction_coefficients=[0.6] ; cea.modes=1 ; \
         sweep={ \"material.density\" = [1150.0], analyses = [\"cea\"] }"];
    let sweep = Run::of("sweep", shipped("tread-block.toml")).args(&["-q"]).set(&set);
    sweep.done().says(&["<=0.600000"]);
}

#[test]
fn uncertain_friction_is_no_single_value() {
    let set = [
        "uncertainty.distributions={ \"contact.friction_coefficient\" = { uniform = [0.05, 0.3] } }",
        "uncertainty.samples=8 ; uncertainty.index_samples=0",
    ];
    let scattered = found(&set);
    assert!(scattered["friction_coefficient"].is_null(), "{scattered}");
    let known = found(&["uncertainty.samples=2 ; uncertainty.index_samples=0"]);
    assert!(known["friction_coefficient"].is_number(), "{known}");
}

#[test]
fn where_no_sample_turns_unstable_no_parameter_decides() {
    let stable =
        found(&["contact.friction_coefficient=0.01 ; cea.friction_coefficients=[0.0,0.01] ; \
        uncertainty.samples=8 ; uncertainty.index_samples=4"]);
    assert_eq!(stable["probability_unstable"]["value"], 0.0);
    assert_eq!(stable["decisive"], Value::Null);
}
