//! Critical friction as a function of a second parameter.

use crate::cea::{CeaError, ModeLimit, SweepRequest, UnstableInterval};
use rayon::prelude::*;

/// The unstable intervals for one value of the second parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilityMapPoint {
    /// The parameter's value.
    pub value: f64,
    /// Every unstable interval up to the largest friction coefficient, sorted by critical friction, or
    /// why this point could not be computed.
    pub outcome: Result<Vec<UnstableInterval>, CeaError>,
}

impl StabilityMapPoint {
    /// The interval of lowest critical friction: where squeal begins.
    pub fn lowest_onset(&self) -> Option<&UnstableInterval> {
        self.outcome.as_ref().ok()?.first()
    }

    /// Critical friction of one branch.
    pub fn critical_friction(&self, harmonic: usize, branch: usize, direction: i8) -> Option<f64> {
        let intervals = self.outcome.as_ref().ok()?;
        let is_same = |i: &&UnstableInterval| {
            (i.harmonic, i.branch, i.direction) == (harmonic, branch, direction)
        };
        intervals.iter().find(is_same).map(|i| i.critical_friction)
    }
}

/// Number of friction steps of each point; crossings are located exactly between them.
const FRICTION_STEPS: usize = 8;

/// Critical friction coefficients over values of a second parameter, up to `largest_friction`, by the function that solves a model.
///
/// `models` pairs each value of the parameter with the model that it makes. A point that fails is data, the
/// others go on. Parallel over values; the result does not depend on the number of threads.
pub fn map_of<M: Sync>(
    models: &[(f64, M)],
    limit: ModeLimit,
    largest_friction: f64,
    solve: impl Fn(&M, &SweepRequest<'_>) -> Result<Vec<UnstableInterval>, CeaError> + Sync,
) -> Vec<StabilityMapPoint> {
    let frictions: Vec<f64> =
        (0..=FRICTION_STEPS).map(|i| largest_friction * i as f64 / FRICTION_STEPS as f64).collect();
    let request = SweepRequest {
        friction_coefficients: &frictions,
        limit,
        shapes_at: &[],
        count_modes: false,
    };
    let solve = |(value, model): &(f64, M)| StabilityMapPoint {
        value: *value,
        outcome: solve(model, &request),
    };
    models.par_iter().map(solve).collect()
}
