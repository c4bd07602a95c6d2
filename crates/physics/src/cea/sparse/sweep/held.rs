//! How many modes a sweep holds.

use super::SparseSweep;
use crate::cea::sparse::GUARD_MODES;
use crate::cea::sparse::branches::TrackedBranch;
use crate::cea::{CeaError, ModeLimit};
use crate::linalg::LinalgError;

impl SparseSweep<'_> {
    /// Motions of the body that are not rigid.
    pub(super) fn elastic(&self) -> usize {
        self.tangent.unknowns.len() - self.builder.rigid
    }

    /// Whether friction brings modes from above a limit in frequency: there may be more where all that are held lie below.
    pub(super) fn lacks_modes(&self) -> bool {
        let held = self.builder.count;
        let is_full = self.points.iter().any(|point| point.wanted >= held);
        matches!(self.limit, ModeLimit::MaxFrequency(_)) && is_full && held < self.elastic()
    }

    /// Whether what grows without oscillating has taken the places of modes, of which a number is asked for.
    pub(super) fn lacks_places(&self, branches: &[TrackedBranch]) -> Result<bool, CeaError> {
        let ModeLimit::Lowest(count) = self.limit else {
            return Ok(false);
        };
        let is_short = self.points.iter().any(|point| point.wanted < count);
        let may_hold_more = is_short && self.builder.count < self.elastic();
        Ok(may_hold_more && self.divergence(branches)?.is_some())
    }

    /// Number of modes to hold of a basis of all motions.
    pub(super) fn most_wanted(&self) -> Result<usize, LinalgError> {
        let (all, solver) = (self.elastic(), self.point_solver());
        let wanted = self.grid.iter().map(|&mu| {
            let modes = self.builder.model.solve_right(mu, all)?;
            Ok(solver.wanted(&modes))
        });
        let most = wanted.collect::<Result<Vec<_>, _>>()?.into_iter().max();
        Ok((most.unwrap_or(0) + GUARD_MODES).min(all))
    }
}
