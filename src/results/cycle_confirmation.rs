//! Whether a transient that starts on a limit cycle stays there: words and summary.

use super::cycle::{CycleReport, CycleResult};
use crate::cycle::LimitCycle;
use serde_json::{Value, json};

/// Largest difference between a cycle and a transient that stays on it: of the frequency and of the external power,
/// relative, and of the fractions of contact nodes. On the coarsest meshes that carry waves of the disc (60 x 14) the
/// three are at most 0.003, 0.016 and 0.034; a wave that is no motion of the disc is left within a few periods.
const TOLERANCE: [f64; 3] = [0.01, 0.05, 0.1];

/// The last fifth of a short transient that started on a limit cycle, for each metre of thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confirmation {
    /// Length of the run in periods of the cycle.
    pub periods: usize,
    /// Its main frequency, Hz; `None` if it has stopped to vibrate.
    pub main_frequency_hz: Option<f64>,
    /// Circumferential harmonic of that, of 0 to 8.
    pub main_harmonic: Option<usize>,
    /// Fractions of contact nodes that `[stick, slip, open]`.
    pub status: [f64; 3],
    /// Power of the rotor, W/m.
    pub external_power: f64,
}

impl Confirmation {
    /// Whether the transient still is on the cycle.
    pub fn agrees(&self, cycle: &LimitCycle) -> bool {
        let [frequency_bound, power_bound, status_bound] = TOLERANCE;
        let within = |value: f64, wanted: f64, bound: f64| (value / wanted - 1.0).abs() <= bound;
        let frequency = self.main_frequency_hz.unwrap_or(0.0);
        let statuses = self.status.iter().zip(&cycle.fractions);
        // The main vibration is that of the wave, or of one of its superharmonics.
        let harmonic = self.main_harmonic.unwrap_or(0);
        let order = (frequency / cycle.frequency_hz()).round().max(1.0);
        (cycle.harmonic >= cycle.harmonics.len() || harmonic == cycle.harmonic * order as usize)
            && within(frequency, order * cycle.frequency_hz(), frequency_bound)
            && within(self.external_power, cycle.powers.external, power_bound)
            && statuses
                .into_iter()
                .all(|(a, b)| (a - b).abs() <= status_bound)
    }
}

/// The transient of a result and its cycle, where there are both.
fn confirmed(result: &CycleResult) -> Option<(&LimitCycle, &Confirmation)> {
    let cycle = result.cycle.as_ref().ok()?;
    Some((cycle, result.confirmation.as_ref()?.as_ref().ok()?))
}

/// The summary object: null where no transient was asked for.
pub fn confirmation_object(report: &CycleReport<'_>, result: &CycleResult) -> Value {
    let error = result.confirmation.as_ref().and_then(|c| c.as_ref().err());
    match (confirmed(result), error) {
        (Some((cycle, found)), _) => {
            let [stick, slip, open] = found.status;
            json!({
                "periods": found.periods,
                "agrees": found.agrees(cycle),
                "main_frequency_hz": found.main_frequency_hz,
                "main_harmonic": found.main_harmonic,
                "status": { "stick": stick, "slip": slip, "open": open },
                "power_w": { "external": found.external_power * report.thickness },
            })
        }
        (None, Some(error)) => json!({ "agrees": false, "error": error }),
        (None, None) => Value::Null,
    }
}

/// What the transient says of the cycle, in words; nothing where none was asked for.
pub fn confirmation_text(report: &CycleReport<'_>, result: &CycleResult) -> Option<String> {
    let family = result.family;
    let Some((cycle, found)) = confirmed(result) else {
        let error = result.confirmation.as_ref()?.as_ref().err()?;
        return Some(format!(
            "{family}: no transient can start on the cycle: {error}"
        ));
    };
    let [stick, slip, open] = found.status;
    let verdict = match found.agrees(cycle) {
        true => "a transient stays on it",
        false => "NOT CONFIRMED: a transient does not stay on it",
    };
    Some(format!(
        "{family}: {verdict}: after {} periods {:.2} Hz, stick {stick:.3}, slip {slip:.3}, open {open:.3}, {:.2} W",
        found.periods,
        found.main_frequency_hz.unwrap_or(0.0),
        found.external_power * report.thickness,
    ))
}

/// Why the result should not be trusted, if so.
pub fn doubt(report: &CycleReport<'_>, result: &CycleResult) -> Option<String> {
    let is_good = match confirmed(result) {
        Some((cycle, found)) => found.agrees(cycle),
        None => result.confirmation.is_none(),
    };
    let text = confirmation_text(report, result)?;
    (!is_good).then(|| {
        format!(
            "{text}; refine the mesh (mesh.circumferential_elements and radial_elements), or trust the transient"
        )
    })
}
