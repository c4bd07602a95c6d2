//! Confirmation of a limit cycle by a transient: words and summary.

use super::stability::known;
use super::{CycleReport, CycleResult};
use crate::cycle::{Confirmation, LimitCycle, Verdict};
use crate::results::summary::{StatusFractions, present};
use serde::{Deserialize, Serialize};

/// The transient of a result and its cycle, where there are both.
fn confirmed(result: &CycleResult) -> Option<(&LimitCycle, &Confirmation)> {
    let cycle = result.cycle.as_ref().ok()?;
    Some((cycle, result.confirmation.as_ref()?.as_ref().ok()?))
}

/// A transient that started on a cycle, in the summary.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ConfirmationSummary {
    /// It ran.
    Ran {
        /// Length of the run in periods of the cycle.
        periods: usize,
        /// Whether it still is on the cycle.
        agrees: bool,
        /// Frequency, Hz; none if it has stopped to vibrate.
        main_frequency_hz: Option<f64>,
        /// Its harmonic.
        main_harmonic: Option<usize>,
        /// Fractions of contact nodes.
        status: StatusFractions,
        /// Power of the rotor.
        power_w: ExternalPower,
    },
    /// It could not.
    Failed {
        /// False.
        agrees: bool,
        /// Why.
        error: String,
    },
}

/// Power of the rotor alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExternalPower {
    /// Mean power, W.
    pub external: Option<f64>,
}

impl ConfirmationSummary {
    /// Of a result; none where no transient was asked for.
    pub fn of(report: &CycleReport<'_>, result: &CycleResult) -> Option<Self> {
        let Some((cycle, found)) = confirmed(result) else {
            let error = result.confirmation.as_ref()?.as_ref().err()?;
            return Some(Self::Failed { agrees: false, error: error.clone() });
        };
        let [stick, slip, open] = found.status.map(present);
        Some(Self::Ran {
            periods: found.periods,
            agrees: found.agrees(cycle),
            main_frequency_hz: found.main_frequency_hz,
            main_harmonic: found.main_harmonic,
            status: StatusFractions { stick, slip, open },
            power_w: ExternalPower { external: present(found.external_power * report.thickness) },
        })
    }
}

/// What the transient says of the cycle, in words; nothing where none was asked for.
pub fn confirmation_text(report: &CycleReport<'_>, result: &CycleResult) -> Option<String> {
    let family = result.family;
    let Some((cycle, found)) = confirmed(result) else {
        let error = result.confirmation.as_ref()?.as_ref().err()?;
        return Some(format!("{family}: no transient can start on the cycle: {error}"));
    };
    let [stick, slip, open] = found.status;
    let verdict = match (found.agrees(cycle), leaves(result)) {
        (true, false) => "a transient stays on it".to_owned(),
        (true, true) => format!(
            "a transient is still on it, in a time in which the leading perturbation makes {:.1} e-folds: too few to tell",
            found.e_folds
        ),
        (false, true) => "a transient leaves it, as its leading perturbation says".to_owned(),
        (false, false) => "NOT CONFIRMED: a transient does not stay on it".to_owned(),
    };
    Some(format!(
        "{family}: {verdict}: after {} periods {:.2} Hz, stick {stick:.3}, slip {slip:.3}, open {open:.3}, {:.2} {}",
        found.periods,
        found.main_frequency_hz.unwrap_or(0.0),
        found.external_power * report.thickness,
        report.extent.unit("W"),
    ))
}

/// Whether a transient is expected to leave the cycle.
fn leaves(result: &CycleResult) -> bool {
    known(&result.stability).is_some_and(|found| found.verdict() == Verdict::Unstable)
}

/// Why the result should not be trusted, if so.
pub fn doubt(report: &CycleReport<'_>, result: &CycleResult) -> Option<String> {
    let is_good = match confirmed(result) {
        Some((cycle, found)) => found.agrees(cycle) || leaves(result),
        None => result.confirmation.is_none(),
    };
    let text = confirmation_text(report, result)?;
    (!is_good).then(|| {
        format!(
            "{text}; refine the mesh (mesh.circumferential_elements and radial_elements), or trust the transient"
        )
    })
}
