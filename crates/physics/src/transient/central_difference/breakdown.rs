//! Detection of numbers that stopped making sense.

use super::CentralDifference;
use crate::transient::{Breakdown, TransientError};

/// Relative energy residual beyond which the numbers are not to be trusted; honest runs stay ten million times
/// below it.
const RESIDUAL_LIMIT: f64 = 1e-6;

impl CentralDifference<'_> {
    /// Refuses energies that no honest run has.
    pub(super) fn check(&self, energy: f64, residual: f64) -> Result<(), TransientError> {
        let (symptom, cause) = if !energy.is_finite() || !residual.is_finite() {
            ("the energy is not a number any more".to_owned(), Breakdown::Overflow)
        } else if energy < -1e-9 * self.account.largest {
            (format!("the energy is negative, {energy:.3e} J/m"), Breakdown::StepTooLong)
        } else if residual > RESIDUAL_LIMIT {
            (
                format!("the energy balance is off by a fraction of {residual:.1e}"),
                Breakdown::RoundOff,
            )
        } else {
            return Ok(());
        };
        Err(self.unstable(symptom, cause))
    }

    fn unstable(&self, symptom: String, cause: Breakdown) -> TransientError {
        let count = self.model.components();
        let speed = |node: usize| {
            let component =
                |c: usize| self.fields.velocity[self.operator.position(count * node + c)];
            let speed = (2..count)
                .fold(component(0).hypot(component(1)), |size, c| size.hypot(component(c)));
            if speed.is_finite() { speed } else { f64::MAX }
        };
        let speeds = (0..self.operator.dof_count() / count).map(|node| (node, speed(node)));
        let fastest = speeds.reduce(|best, own| if own.1 > best.1 { own } else { best });
        let (node, largest) = fastest.unwrap_or_default();
        let [radius, angle] = self.model.place(node);
        let step = self.next_step - 1;
        let problem = format!(
            "t = {:.6e} s (step {step}): {symptom}. The fastest node is {}, at {:.2} degrees and \
             radius {radius:.4e} m, moving at {largest:.3e} m/s",
            step as f64 * self.plan.time_step,
            node + 1,
            angle.to_degrees(),
        );
        TransientError::Unstable { problem, cause }
    }
}
