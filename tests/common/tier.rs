//! Two tiers: every claim at its smallest size, and at full size with `FRICTIONSIM_LONG=1`, as `.ci/long` runs it.

/// A size of a test, a mesh, a count of seeds or a list of cases: `small`, or `full` in the long tier.
pub fn sized<T>(small: T, full: T) -> T {
    let is_long = std::env::var_os("FRICTIONSIM_LONG").is_some_and(|value| value != "0");
    if is_long { full } else { small }
}
