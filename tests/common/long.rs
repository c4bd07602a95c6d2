//! Tiers of tests: each claim at its smallest mesh and with few seeds, or at full size.

/// Whether tests run at full size: `FRICTIONSIM_LONG=1`, as `.ci/long` sets it.
pub fn is_long() -> bool {
    std::env::var_os("FRICTIONSIM_LONG").is_some_and(|value| value != "0")
}
