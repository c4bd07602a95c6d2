//! A transient that starts on a limit cycle.

use crate::app::Failure;
use crate::app::cycle::{disc_model, mode_limit};
use crate::case::Case;
use crate::cycle::{CycleSolver, Family, LimitCycle, OperatingPoint};

/// Displacement at time zero (m) and velocity half a step earlier (m/s) of the limit cycle of `family` at the case's own
/// operating point, over all dofs in nodal frames.
///
/// # Errors
/// No such cycle, or elements that a cycle cannot be sought on.
pub fn limit_cycle(case: &Case, family: Family, time_step: f64) -> Result<[Vec<f64>; 2], Failure> {
    let point = OperatingPoint {
        contact: case.contact.sliding,
        damping: case.damping.rayleigh,
    };
    let phases = case.cycle.as_ref().and_then(|cycle| cycle.phases);
    let model = disc_model(case);
    let onset = model
        .onset_of(family, mode_limit(case))
        .map_err(Failure::run)?;
    let solver = CycleSolver::born_at(&model, family, &onset, phases).map_err(Failure::usage)?;
    let cycle = solver.find(&point).map_err(Failure::run)?;
    Ok(cycle_fields(&solver, &cycle, time_step))
}

/// Displacement of a limit cycle at time zero (m) and its velocity half a step earlier (m/s), over all dofs in nodal
/// frames: what the time loop starts from.
pub fn cycle_fields(solver: &CycleSolver, cycle: &LimitCycle, time_step: f64) -> [Vec<f64>; 2] {
    let [displacement, _] = solver.field(cycle, 0.0);
    let [_, velocity] = solver.field(cycle, -0.5 * time_step);
    [displacement, velocity]
}
