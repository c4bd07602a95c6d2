//! Consistency check: what `check` says of a case is what its runs say.

use super::RUN;
use crate::prelude::*;
use frictionsim::case::Analysis;
use frictionsim::study::{StudyError, preflight, summarize};

/// Values for keys, good and bad ones.
const POOL: &[(&str, &[&str])] = &[
    ("mesh.circumferential_elements", &["3", "5", "24", "60"]),
    ("mesh.radial_elements", &["1", "2", "9"]),
    ("mesh.radial_grading", &["0.5", "3.0", "1e9"]),
    ("mesh.element", &["quad4", "quad8"]),
    ("material.poisson_ratio", &["-0.9", "0.0", "0.4999", "0.5"]),
    ("material.formulation", &["plane-stress"]),
    ("contact.friction_coefficient", &["0", "0.9", "1000"]),
    ("contact.interference", &["1e-12", "1e-3", "1"]),
    ("contact.rotation_speed_rpm", &["0", "-610", "1e7"]),
    ("contact.normal_stiffness", &["1", "7e12", "1e40", "rigid"]),
    ("damping.mass_coefficient", &["0", "1e9"]),
    ("damping.stiffness_coefficient", &["0", "1e-5"]),
    ("cea.max_frequency_hz", &["1", "100", "1e5"]),
    ("cea.modes", &["1", "40", "100000"]),
    ("cea.method", &["cyclic", "sparse"]),
    ("cea.mass", &["consistent"]),
    ("transient.time_step", &["auto", "1e-8", "2e-6", "1e-5", "1e-3"]),
    ("transient.duration", &["1e-7", "1e-5", "1e-4"]),
    ("transient.expansion_time", &["0", "2e-5", "1"]),
    ("transient.initial", &["steady-sliding"]),
    ("transient.operator", &["sparse", "cyclic"]),
    ("transient.perturbation.harmonics", &["[0]", "[2, 12]", "[13]"]),
    ("output.probes", &["[1, 120]", "[121]", "[100000]"]),
    ("output.sample_interval", &["1e-9", "1e-5", "1e-3"]),
    ("output.snapshots", &["[0]", "[1e-5, 2e-5]", "[1]"]),
];

fn overrides(seed: u64) -> Vec<String> {
    let small =
        ["mesh.circumferential_elements=24 ; mesh.radial_elements=4 ; transient.duration=4e-5 ; \
         transient.expansion_time=1e-5 ; output.probes=[1] ; output.snapshots=[]"];
    // Marsaglia's xorshift.
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = |count: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as usize % count
    };
    let mut all: Vec<String> =
        small.iter().flat_map(|text| text.split(" ; ")).map(str::to_owned).collect();
    for _ in 0..1 + random(3) {
        let (key, values) = POOL[random(POOL.len())];
        all.push(format!("{key}={}", values[random(values.len())]));
    }
    all
}

/// Whether a command refuses its case, which is exit code 2.
fn is_refused<T>(outcome: Result<T, StudyError>) -> bool {
    outcome.is_err_and(|error| error.is_usage())
}

#[test]
fn check_refuses_what_a_run_refuses_and_nothing_else() {
    let simd = frictionsim::fem::operator::SimdLevel::detect();
    let manifest = Manifest { simd: simd.to_string(), ..Manifest::new("transient") };
    let mut counts = [0, 0];
    for seed in 1..=160 {
        let overrides = overrides(seed);
        // A case that cannot be read is refused by every command alike.
        let Ok(case) = Case::parse("case.toml", RUN.as_bytes(), &overrides) else {
            continue;
        };
        let checked = is_refused(preflight(&case, f64::INFINITY));
        // Elements that the transient cannot run are a warning of the case.
        let runs = case.require_transient().is_ok();
        let run = (runs && is_refused(summarize(&case, Analysis::Transient, &manifest)))
            || is_refused(summarize(&case, Analysis::Cea, &manifest));
        assert_eq!(checked, run, "seed {seed}: {overrides:?}");
        counts[usize::from(run)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}
