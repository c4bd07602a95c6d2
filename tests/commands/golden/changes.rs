//! Whether a difference is one of `changes.txt`, and how large it may be otherwise.

pub fn explains(case: &str, file: &str, key: &str) -> bool {
    let fits = |pattern: &str, name: &str| match pattern.strip_suffix('*') {
        Some(start) => name.starts_with(start),
        None => pattern == name,
    };
    super::rows(include_str!("changes.txt"))
        .any(|[c, f, k, _]| fits(c, case) && fits(f, file) && fits(k, key))
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
        // A small difference of two areas, which round-off of either moves.
        _ if key.contains("area_error") => 1e-10,
        // The search for an onset ends at a tolerance.
        _ if key.contains("critical_friction") || key.contains("restabilized") => 1e-9,
        // Iterations end at a residual.
        _ if case.contains("sparse") => 1e-9,
        _ => 1e-12,
    }
}
