//! What a case that is right key by key asks for in vain, and what of it is hardly meant.

mod contact;
mod material;
mod mesh;
mod motion;
mod unused;

use super::{Case, Diagnostic};
pub(super) use material::material_key;

/// A value beyond what is plausible.
struct Limit {
    /// Whether a run could do with it all the same.
    is_possible: bool,
    /// What is said of it.
    said: Diagnostic,
}

/// Values with a limit of what is plausible and one of what is possible.
const LIMITED: [fn(&Case) -> Option<Limit>; 4] =
    [material::wave_speed, motion::seeds, contact::friction, contact::stiffness];

/// What cannot run.
const IMPOSSIBLE: [fn(&Case) -> Option<Diagnostic>; 3] =
    [motion::time_step, motion::duration, motion::start];

/// What hardly anybody means.
const DOUBTFUL: [fn(&Case) -> Option<Diagnostic>; 11] = [
    mesh::lengths,
    mesh::unmerged_nodes,
    mesh::element_shape,
    material::density,
    contact::speed,
    material::poisson_ratio,
    contact::interference,
    contact::overlap,
    motion::unresolved_springs,
    motion::steep_friction,
    material::overdamping,
];

/// What is said of values on one side of what is possible.
fn limited(case: &Case, is_possible: bool) -> impl Iterator<Item = Diagnostic> {
    let found = LIMITED.into_iter().filter_map(move |limited| limited(case));
    found.filter(move |limit| limit.is_possible == is_possible).map(|limit| limit.said)
}

/// What a case asks for in vain.
pub(super) fn infeasible(case: &Case) -> Vec<Diagnostic> {
    let found = IMPOSSIBLE.iter().filter_map(|check| check(case));
    found.chain(limited(case, false)).collect()
}

/// What of a case is hardly meant.
pub(super) fn implausible(case: &Case) -> Vec<Diagnostic> {
    let found = DOUBTFUL.iter().filter_map(|check| check(case));
    found.chain(limited(case, true)).collect()
}
