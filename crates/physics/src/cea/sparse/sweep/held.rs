//! How many modes a sweep holds.

use super::SparseSweep;
use crate::cea::sparse::branches::TrackedBranch;
use crate::cea::{CeaError, ModeLimit};

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
}
