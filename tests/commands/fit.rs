//! Parameters fitted to measured modes.
//!
//! Independent checks: the eigenvalues of Table 1 of the paper, and spectra of known parameters with noise.

use crate::prelude::*;
use frictionsim::study::eigenvalues::modes_below;
use frictionsim::study::fit::{FitProblem, ModelMode, fit, fit_case};

fn fitted(name: &str, table: &str, set: &[&str]) -> Answer {
    let run = Run::of("fit", shipped(name)).args(&["modes.csv", "--json"]).out("out").set(set);
    run.beside(&[("modes.csv", table)]).end()
}

const COARSE: &str = "mesh.circumferential_elements=40 ; mesh.radial_elements=8";

fn disc_table() -> String {
    fs::read_to_string(shipped("table-1.csv")).unwrap()
}

#[test]
fn table_1_gives_back_the_three_values_that_the_paper_leaves_out() {
    let set = ["mesh.circumferential_elements=60", "mesh.radial_elements=12", "fit.starts=4"];
    let found = fitted("fit-table-1.toml", &disc_table(), &set).code(0).value();
    let value = |key: &str| found["parameters"][key]["value"].as_f64().unwrap();
    assert!((value("material.poisson_ratio") - 0.3805).abs() < 0.001);
    let ratio = value("material.young_modulus") / 1228.0;
    assert!((ratio / 2.036e6 - 1.0).abs() < 0.002, "{ratio}");
    let stiffness = value("contact.normal_stiffness");
    assert!((stiffness / 7.4e12 - 1.0).abs() < 0.15, "{stiffness:e}");
    assert!(found["worst_percent"].as_f64().unwrap() < 0.2);
    // Every row is the mode that the exact continuum model says it is.
    for (row, wanted) in found["residuals"].as_array().unwrap().iter().zip(TABLE_1.iter()) {
        assert_eq!(row["mode"]["harmonic"], wanted.2, "{row}");
        assert_eq!(row["mode"]["branch"], wanted.3, "{row}");
    }
}

#[test]
fn one_support_stiffness_explains_the_four_frequencies_heard() {
    let table = fs::read_to_string(shipped("squeal.csv")).unwrap();
    let set = ["mesh.circumferential_elements=60", "mesh.radial_elements=16"];
    let found = fitted("fit-test-bench.toml", &table, &set).code(0).value();
    assert!(found["worst_percent"].as_f64().unwrap() < 5.0, "{found:#}");
    let stiffness = found["parameters"]["boundaries.outer.normal_stiffness"].clone();
    // The prototype of another discretisation fits between these two.
    let value = stiffness["value"].as_f64().unwrap();
    assert!(value > 1.3e11 && value < 2.2e11, "{value:e}");
    assert!(stiffness["low"].as_f64().unwrap() < value);
    let heard = found["residuals"].as_array().unwrap().iter();
    assert!(heard.clone().all(|row| row["mode"]["real_hz"].as_f64().unwrap() > 0.0));
}

/// In how many of `seeds` noisy spectra of a case the interval of each fitted parameter holds the value of the case.
fn coverage(case: &Case, limit_hz: f64, noise: [f64; 2], seeds: u64) -> Vec<usize> {
    let modes = modes_below(case, limit_hz).unwrap();
    let keys = &case.require_fit().unwrap().parameters;
    let truth: Vec<f64> = keys.iter().map(|p| case.number(&p.parameter.key).unwrap()).collect();
    let mut hits = vec![0; truth.len()];
    for seed in 0..seeds {
        let mut stream = GaussianNoise::new(seed);
        let lines = modes.iter().enumerate().map(|(k, mode)| {
            let error = stream.draw();
            let frequency_hz = mode.frequency_hz() * (1.0 + noise[0] * error.re);
            let real_hz = mode.real_hz() + noise[1] * mode.frequency_hz() * error.im;
            measured_mode(k + 1, frequency_hz, Some(real_hz))
        });
        let fitted = fit_case(case, &lines.collect::<Vec<_>>(), None).unwrap();
        let estimates = fitted.parameters.values();
        for ((hit, estimate), truth) in hits.iter_mut().zip(estimates).zip(&truth) {
            let (low, high) = estimate.low.zip(estimate.high).unwrap();
            *hit += usize::from(low <= *truth && *truth <= high);
        }
    }
    hits
}

#[test]
fn intervals_of_three_parameters_hold_the_truth_in_95_of_100_noisy_spectra() {
    let set = "mesh.circumferential_elements=30 ; mesh.radial_elements=4 ; fit.starts=1 ; \
         material.young_modulus=2.5e9 ; material.poisson_ratio=0.38 ; contact.normal_stiffness=7e12";
    let case = shipped_case("fit-table-1.toml", &[set]);
    // Real parts are known ten times worse than frequencies: the weight between them is found.
    let (seeds, expected) = sized((10, 8..=10), (100, 90..=99));
    let hits = coverage(&case, 15_000.0, [1e-4, 1e-3], seeds);
    assert!(hits.iter().all(|hits| expected.contains(hits)), "{hits:?}");
}

#[test]
fn friction_that_is_fitted_is_told_as_that_of_the_fit() {
    let with = |more: &str| shipped_case("fit-table-1.toml", &[COARSE, more]);
    let lines = modes_below(&with("contact.friction_coefficient=0.21"), 12_000.0).unwrap();
    let lines = lines.iter().map(|own| measured_mode(2, own.frequency_hz(), Some(own.real_hz())));
    let key = "contact.friction_coefficient";
    let case = with(&format!("fit={{ starts = 2, parameters = {{ \"{key}\" = [0.1, 0.4] }} }}"));
    let found = fit_case(&case, &lines.collect::<Vec<_>>(), None).unwrap();
    assert_eq!(found.friction_coefficient, found.parameters[key].value);
    assert!((found.friction_coefficient - 0.21).abs() < 1e-6, "{found:?}");
}

#[test]
fn what_the_data_cannot_tell_apart_is_named() {
    let set = [COARSE, "fit.parameters.\"material.density\"=[1000, 1500] ; fit.starts=2"];
    let said = "cannot tell ; material.young_modulus ; material.density ; contact.normal_stiffness";
    fitted("fit-table-1.toml", &disc_table(), &set).code(1).warns(&[said]);
}

#[test]
fn a_line_that_no_mode_can_be_is_named() {
    let table = "frequency_hz,harmonic,unstable\n7660,1,1\n9900,2,1\n10500,1,1\n9000,0,1\n";
    let one = "fit={ starts = 1, parameters = { \"material.young_modulus\" = [1.5e9, 3e9] } }";
    fitted("fit-table-1.toml", table, &[COARSE, one]).code(1).warns(&["line 5", "n = 0, unstable"]);
}

#[test]
fn more_parameters_than_data_and_bad_tables_are_refused_before_anything_runs() {
    let tables = [("5857\n7655", &["3 parameters", "2 measured"][..]), ("abc", &["modes.csv:2:1"])];
    for (rows, said) in tables {
        let table = format!("frequency_hz\n{rows}\n");
        fitted("fit-table-1.toml", &table, &[COARSE]).code(2).warns(said);
    }
}

#[test]
fn a_fit_on_its_bound_says_so() {
    let set = [COARSE, "fit.parameters={ \"material.young_modulus\" = [1.5e9, 2.2e9] }"];
    // The disc's lowest torsion and the lowest waves around it.
    let lowest = "f [Hz],harmonic\n5857,0\n7655,1\n9884,2\n11258,3\n";
    let words = ["fit", &shipped("fit-table-1.toml"), "m.csv", "--json", "--format", "svg"];
    let run = Run::new(&words).beside(&[("m.csv", lowest)]).out("out").set(&set);
    let answer = run.done().warns(&["is at its bound"]);
    // Each panel says what its own points are.
    let names = "fitted model, stable ; case as written, unstable ; >frequency< ; !difference of";
    has(&answer.text("figures/fit.svg"), &[names]);
    assert_eq!(answer.value()["parameters"]["material.young_modulus"]["at_bound"], 2.2e9);
}

/// Two modes on springs that share one stiffness, `f = 1000 sqrt(p)` and `1000 sqrt(2.4 - p)`: two values of `p` give the same two
/// frequencies, and only the shapes tell which. They mix a little where the modes are close.
#[test]
fn shapes_tell_modes_apart_that_cross() {
    let truth = 1.2996_f64;
    let frequencies = |p: f64| [1000.0 * p.sqrt(), 1000.0 * (2.4 - p).sqrt()];
    let model = |values: &[f64], _: bool| -> Result<Vec<ModelMode>, String> {
        // The share of the other mode, largest where both have one frequency.
        let mixed = 0.1 * (-((values[0] - 1.2) / 0.05).powi(2)).exp();
        let modes = frequencies(values[0]).into_iter().enumerate();
        let modes = modes.map(|(k, frequency)| ModelMode {
            rates: vec![None],
            assurances: [0, 1].map(|i| if i == k { 1.0 - mixed } else { mixed }).to_vec(),
            ..ModelMode::new(c64::new(-10.0, TAU * frequency), None, k, 0)
        });
        Ok(modes.collect())
    };
    let lines = frequencies(truth).into_iter().enumerate();
    let lines: Vec<_> = lines.map(|(k, own)| measured_mode(k + 2, own, None)).collect();
    let key = "material.young_modulus";
    let bounds = format!("fit.parameters={{ \"{key}\" = [0.8, 1.6] }}");
    let changes = [bounds.as_str(), "fit.starts=8", "fit.shape_weight=0.1"];
    let case = shipped_case("fit-table-1.toml", &changes);
    let wanted = case.require_fit().unwrap();
    let with = |shape_of: [Option<usize>; 2]| {
        let problem = FitProblem {
            model: &model,
            wanted,
            lines: &lines,
            shape_of: shape_of.to_vec(),
            // Where the frequencies alone are matched, by the wrong modes.
            own: Some(vec![1.1]),
        };
        fit(&problem).unwrap()
    };
    let alone = with([None, None]);
    assert!(!alone.other_minima.is_empty(), "{alone:?}");
    for (shape_of, expected) in [([0, 1], truth), ([1, 0], 2.4 - truth)] {
        let fitted = with(shape_of.map(Some));
        let value = fitted.parameters[key].value;
        assert!((value - expected).abs() < 1e-3, "{value} {expected}");
        assert!(fitted.other_minima.is_empty(), "{:?}", fitted.other_minima);
        assert!(fitted.residuals.iter().all(|line| line.mac.unwrap() > 0.9));
    }
}
