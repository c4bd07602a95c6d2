//! Consistency check: what `check` says of a case is what its runs say.

use super::*;
use frictionsim::case::Analysis;
use frictionsim::study::{StudyError, preflight, summarize};

fn overrides(seed: u64) -> Vec<String> {
    let small = "mesh.circumferential_elements=24 ; mesh.radial_elements=4 ; \
        transient.duration=4e-5 ; transient.expansion_time=1e-5 ; output.probes=[1] ; \
        output.snapshots=[]";
    // Marsaglia's xorshift.
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = |count: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as usize % count
    };
    let mut all = vec![small.to_owned()];
    let pool: Vec<&str> = include_str!("agreement.txt").lines().skip(1).collect();
    for _ in 0..1 + random(3) {
        let (key, values) = pool[random(pool.len())].split_once(" | ").unwrap();
        let values: Vec<&str> = values.split(" ; ").collect();
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
    // Fewer modes than asked for, which none of these seeds has.
    let few = [&overrides(1)[..1], &["mesh.radial_elements=1 ; cea.modes=40".to_owned()]].concat();
    for overrides in (1..=160).map(overrides).chain([few]) {
        // A case that cannot be read is refused by every command alike.
        let Ok(case) = read_case("case.toml", RUN, &overrides) else { continue };
        let checked = is_refused(preflight(&case, f64::INFINITY));
        // Elements that the transient cannot run are a warning of the case.
        let runs = case.require_transient().is_ok();
        let run = (runs && is_refused(summarize(&case, Analysis::Transient, &manifest)))
            || is_refused(summarize(&case, Analysis::Cea, &manifest));
        assert_eq!(checked, run, "{overrides:?}");
        counts[usize::from(run)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}
