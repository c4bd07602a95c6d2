//! Modes of projected matrices whose stiffness depends on frequency, each at its own frequency.

use super::mode::ReducedMode;
use super::projected::ProjectedMatrices;
use super::{MOST_STEPS, NEAR};
use crate::linalg::LinalgError;
use std::f64::consts::TAU;

/// The modes, by rising frequency, without derivatives and scale: as many as `frozen` gives at one frequency in Hz.
///
/// The `i`-th mode of the problem frozen at `f`, in the order of frequencies `f_i(f)`, has a fixed point `f_i(f) = f`, one for each
/// `i` as long as stiffness rises less than with the square of the frequency: as many modes lie below `f` as the frozen problem has
/// below `f`. Each is sought from its vectors at `start_hz` by Rayleigh quotients on the nonlinear problem; where that ends at a
/// mode found already, or not at all, by that fixed point. A mode that does not settle is given as it is: its residual tells.
pub(super) fn solve(
    at: &ProjectedMatrices,
    frozen: &(dyn Fn(f64) -> Result<Vec<ReducedMode>, LinalgError> + Sync),
    start_hz: f64,
) -> Result<Vec<ReducedMode>, LinalgError> {
    let start = frozen(start_hz)?;
    let mut found: Vec<Option<ReducedMode>> =
        crate::parallel::map(&start, |mode| at.mode_near(mode));
    for i in 1..found.len() {
        let (before, own) = found.split_at_mut(i);
        let is_known =
            |mode: &ReducedMode| before.iter().flatten().any(|other| mode.is_same(other));
        if own[0].as_ref().is_some_and(|mode| mode.eigenvalue.im <= 0.0 || is_known(mode)) {
            own[0] = None; // Two starts may end at one mode.
        }
    }
    for i in 0..found.len() {
        if found[i].is_none() {
            let others: Vec<&ReducedMode> = found.iter().flatten().collect();
            found[i] = Some(fixed_point(at, frozen, (i, &start[i]), &others)?);
        }
    }
    let mut modes: Vec<ReducedMode> = found.into_iter().flatten().collect();
    crate::order::sort_by_number(&mut modes, |p| p.eigenvalue.im);
    Ok(modes)
}

/// The mode of one place in the order of frequencies.
fn fixed_point(
    at: &ProjectedMatrices,
    frozen: &(dyn Fn(f64) -> Result<Vec<ReducedMode>, LinalgError> + Sync),
    (place, start): (usize, &ReducedMode),
    others: &[&ReducedMode],
) -> Result<ReducedMode, LinalgError> {
    let mut mode = start.clone();
    let mut frequency_hz = mode.eigenvalue.im / TAU;
    for pass in 0..MOST_STEPS {
        let mut all = frozen(frequency_hz)?;
        if place >= all.len() {
            break;
        }
        mode = all.swap_remove(place);
        let next = mode.eigenvalue.im / TAU;
        if (next - frequency_hz).abs() <= NEAR * next {
            let fine = at.mode_near(&mode);
            let is_new = |fine: &ReducedMode| !others.iter().any(|other| fine.is_same(other));
            if let Some(fine) = fine.filter(is_new) {
                return Ok(fine);
            }
        }
        // Whole steps, then half ones.
        frequency_hz = if 2 * pass < MOST_STEPS { next } else { 0.5 * (next + frequency_hz) };
    }
    Ok(mode)
}
