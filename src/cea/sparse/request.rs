//! What a sweep is asked for, and the sweep as a whole.

use super::error::CeaError;
use super::sweep::SparseSweep;
use crate::cea::FrictionSweep;
use crate::prestress::SlidingTangent;

/// Which modes are wanted at each friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EigenLimit {
    /// All modes below this frequency, Hz.
    BelowFrequency(f64),
    /// This many modes of lowest frequency.
    Lowest(usize),
}

/// What a sweep is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct EigenRequest {
    /// Which modes.
    pub limit: EigenLimit,
    /// Friction coefficients whose mode shapes are returned; those that are not swept are ignored.
    pub shapes_at: Vec<f64>,
}

/// How far a sweep has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SweepProgress {
    /// Friction values solved.
    pub solved: usize,
    /// Friction values in all.
    pub total: usize,
}

/// Complex modes of `tangent` at every one of `friction_coefficients`, and where their branches turn
/// unstable.
///
/// Oscillating modes of lowest natural frequency only: overdamped motions, and modes whose eigenvalue is
/// far from the origin because of damping alone, are not searched. Friction values are solved in parallel
/// on the current rayon pool; the result is the same, bit for bit, for any number of threads. `progress`
/// is called from those threads.
///
/// Points come in the order given; repeated values are computed once.
///
/// # Errors
/// [`CeaError`]: a bad request, a mode count that the inertia contradicts, a pair above the residual
/// bound, a lost branch.
pub fn sweep(
    tangent: &SlidingTangent,
    friction_coefficients: &[f64],
    request: &EigenRequest,
    progress: &(dyn Fn(SweepProgress) + Sync),
) -> Result<FrictionSweep, CeaError> {
    let mut sweep = SparseSweep::prepare(tangent, friction_coefficients, request)?;
    sweep.cover()?;
    sweep.solve(progress)?;
    let branches = sweep.track()?;
    sweep.finish(friction_coefficients, request, &branches)
}
