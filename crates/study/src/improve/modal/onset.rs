//! Critical friction of a body after a change, in the space of its modes.

use super::{Change, ModalModel};
use frictionsim_physics::linalg::{LinalgError, c64};

/// Steps of friction in which a critical one is looked for, and halvings of the step that holds it.
const SCAN: usize = 12;
const HALVINGS: usize = 14;

/// Error of the onset without a change, relative to it, up to which the closer model is taken at other friction than
/// the base's.
const HOLDS: f64 = 0.03;

impl ModalModel<'_> {
    /// The friction coefficient above which, up to that of the base, a mode of the window grows; `None` where none does
    /// there.
    pub fn onset(&self, change: Option<&Change>) -> Result<Option<f64>, LinalgError> {
        self.onset_of(&|mu| self.spectrum(mu, change))
    }

    /// [`Self::onset`] less what the small problem is off for the body without the change, of which the onset is
    /// `known`.
    ///
    /// The vectors are those of the base's own friction coefficient. Where the closer model of what is attached to a
    /// node does not hold down to that onset, the listed modes alone are taken.
    pub fn corrected_onset(
        &self,
        change: &Change,
        known: Option<f64>,
    ) -> Result<Option<f64>, LinalgError> {
        let corrected = |onset: Option<f64>, without: Option<f64>| {
            let error = match (known, without) {
                (Some(known), Some(without)) => known - without,
                _ => 0.0,
            };
            onset.map(|mu| (mu + error).max(0.0))
        };
        if let (Some(attached), Some(known)) = (&change.attached, known) {
            let without = self.onset_of(&|mu| attached.spectrum(mu, true))?;
            if without.is_some_and(|mu| (mu - known).abs() <= HOLDS * known) {
                return Ok(corrected(self.onset(Some(change))?, without));
            }
        }
        let onset = self.onset_of(&|mu| self.of_listed(mu, Some(change)))?;
        Ok(corrected(onset, self.onset(None)?))
    }

    /// Looked for downwards: the modes of the base describe what is near its own friction coefficient best.
    fn onset_of(
        &self,
        spectrum: &dyn Fn(f64) -> Result<Vec<c64>, LinalgError>,
    ) -> Result<Option<f64>, LinalgError> {
        let window = self.base.window;
        let grows = |mu: f64| -> Result<bool, LinalgError> {
            Ok(window.outlook(spectrum(mu)?).unstable > 0)
        };
        if !grows(self.base.friction)? {
            return Ok(None);
        }
        let step = self.base.friction / SCAN as f64;
        let mut above = self.base.friction;
        for i in (0..SCAN).rev() {
            let mut below = step * i as f64;
            if grows(below)? {
                above = below;
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (below + above);
                if grows(middle)? { above = middle } else { below = middle }
            }
            break;
        }
        Ok(Some(above))
    }
}
