//! What changed on purpose since 0.1.0, and why.

/// `(case, file, key, reason)`; a name that ends in `*` stands for all that begin so.
const CHANGES: &[(&str, &str, &str, &str)] = &[
    ("*", "points/*", "wall_s", CLOCK),
    ("*", "points/*", "core_s", CLOCK),
    ("*", "points/*", "summaries.cea.wall_s", CLOCK),
    ("*", "points/*", "summaries.cycle.wall_s", CLOCK),
    ("*", "points/*", "summaries.cycle.cycles[].wall_s", CLOCK),
    ("*", "points/*", "summaries.transient.wall_s", CLOCK),
    ("*", "points/*", "summaries.transient.element_steps_per_s", CLOCK),
    ("transient*", "probe-*", "a_*", MEAN_ACCELERATION),
    ("signal", "*", "*", SIGNAL),
    ("transient*", "summary.json", "growth[]*", GROWTH),
    ("*", "points/*", "summaries.transient.growth[]*", GROWTH),
    ("*", "points.csv", "growth.*", GROWTH),
    ("*", "points.csv", "critical_frictions.*", NAMED),
    ("*", "points.csv", "cycles.*", NAMED),
    // Its transient is two milliseconds long: two quantities fewer, whose rows shift the others.
    ("convergence", "convergence.csv", "*", GROWTH),
    ("convergence", "summary.json", "series[].quantities[]*", GROWTH),
    ("*", "*", "cycles[].confirmation*", SEEDED),
    ("*", "*", "cycles[].onsets*", ONSETS),
    ("*", "*", "summaries.cycle.cycles[].confirmation*", SEEDED),
    ("*", "*", "summaries.cycle.cycles[].onsets*", ONSETS),
    ("*", "*", "cycles[].branch.folds*", FOLDS),
    ("*", "*", "branch", BRANCH),
    ("*", "*", "critical_frictions[].branch", BRANCH),
    ("*", "*", "friction[].modes[].branch", BRANCH),
    ("*", "*", "summaries.cea.critical_frictions[].branch", BRANCH),
    ("*", "*", "summaries.cea.friction[].modes[].branch", BRANCH),
    ("identify", "modes.csv", "used", "a flag is true or false in every table"),
    ("*", "*", "summaries.cycle.cycles[].branch.folds*", FOLDS),
];

const SEEDED: &str = "the transient is seeded, its frequency is that of the wave's own harmonic";

const ONSETS: &str = "onsets are those below the case's friction, from the eigenvalue analysis";

const BRANCH: &str = "branches are counted from 1, as modes are";

const FOLDS: &str = "a fold is a turn back by more than the phases of the wave resolve";

const SIGNAL: &str = "probes hold mean accelerations; peaks stand out of the noise at a stated resolution, modes are named within 3 %, stages \
     need an interval";

const NAMED: &str =
    "columns go by the mode, not by its rank: critical_frictions.n1_b1_against.critical_friction";
const CLOCK: &str =
    "what the clock says of a point is in a file of its own, so that points keep their bytes";

const MEAN_ACCELERATION: &str =
    "the acceleration of a probe is its mean over the sample interval, which does not alias";

const GROWTH: &str = "a rate needs 20 periods above round-off and an exponential envelope";

pub fn explains(case: &str, file: &str, key: &str) -> bool {
    let fits = |pattern: &str, name: &str| match pattern.strip_suffix('*') {
        Some(start) => name.starts_with(start),
        None => pattern == name,
    };
    CHANGES.iter().any(|(c, f, k, _)| fits(c, case) && fits(f, file) && fits(k, key))
}

pub fn depends_on_the_clock(key: &str) -> bool {
    ["wall_s", "core_s", "points_per_core_hour", "element_steps_per_s"]
        .iter()
        .any(|name| key.contains(name))
}

/// Relative to the largest value of the column or list.
pub fn tolerance(case: &str, file: &str, key: &str) -> f64 {
    match key {
        // Differences of matrices, of fourth order in a step far above round-off; they were closed forms.
        _ if file.contains("sensitivities") => 1e-8,
        // Sizes of round-off: only their order is a result.
        _ if key.contains("residual")
            || key.contains("backward_error")
            || key.contains("largest_error") =>
        {
            f64::INFINITY
        }
        // The search for an onset ends at a tolerance.
        _ if key.contains("critical_friction") || key.contains("restabilized") => 1e-9,
        // Iterations end at a residual.
        _ if case.contains("sparse") => 1e-9,
        _ => 1e-12,
    }
}
