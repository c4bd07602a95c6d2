//! Typed summaries: the struct that `summary.json` is.
//!
//! Its fields are the keys in their order. A value that may be absent is an `Option` and null in JSON: JSON has neither NaN
//! nor infinity.

use super::folder::{FolderError, OutputFolder};
use super::reopening::{SUMMARY, read_own};
use crate::cycle::CriticalValue;
use crate::output::Described;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// Where along a parameter steady sliding loses its stability.
#[derive(Clone, Debug, PartialEq, Described, Serialize, Deserialize)]
pub struct CriticalSummary {
    /// Key of the case.
    pub key: String,
    /// Value, in its units.
    pub value: f64,
}

impl StatusFractions {
    /// Of `[stick, slip, open]`.
    pub fn of(fractions: [f64; 3]) -> Self {
        let [stick, slip, open] = fractions.map(present);
        Self { stick, slip, open }
    }
}

impl From<CriticalValue> for CriticalSummary {
    fn from(own: CriticalValue) -> Self {
        Self { key: own.parameter.key().to_owned(), value: own.parameter.in_key_units(own.value) }
    }
}

/// Fractions of the contact nodes, averaged over the interval that a summary is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Described, Serialize, Deserialize)]
pub struct StatusFractions {
    /// Sticking.
    pub stick: Option<f64>,
    /// Slipping.
    pub slip: Option<f64>,
    /// Open.
    pub open: Option<f64>,
}

/// Mean powers of a whole disc, W; equations (9) to (12).
#[derive(Clone, Copy, Debug, Default, PartialEq, Described, Serialize, Deserialize)]
pub struct MeanPowers {
    /// Of the motor.
    pub external: Option<f64>,
    /// Of sticking nodes.
    pub stick: Option<f64>,
    /// Of sliding nodes.
    pub slide: Option<f64>,
    /// Lost to friction.
    pub contact_dissipated: Option<f64>,
    /// Lost in the body.
    pub material_damping: Option<f64>,
    /// Of the normal contact forces.
    pub normal_contact: Option<f64>,
    /// Lost in the dashpots of a contact that has some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_damping: Option<f64>,
}

/// What a study reads of the summary of an analysis at a point: what vibrates, and where stability ends. Keys that an
/// analysis does not have are absent.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct PointSummary {
    /// The vibration of a transient's end.
    #[serde(flatten)]
    pub own: Vibration,
    /// The limit cycles of a search.
    pub cycles: Vec<Vibration>,
    /// The crossings into instability of an eigenvalue analysis, lowest first.
    pub critical_frictions: Vec<Crossing>,
    /// Whether a transient has settled.
    pub settled: Option<bool>,
    /// What a transient ends in, by name.
    pub end_state: Option<String>,
    /// Growth of the harmonics in the linear stage.
    pub growth: Vec<HarmonicGrowth>,
    /// Time step, s.
    pub time_step_s: Option<f64>,
    /// The wave that wins whatever the seeds.
    pub winner: Option<usize>,
    /// The boundary between two basins.
    pub boundary: Bounds,
}

/// A limit cycle, or the vibration at the end of a transient.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Vibration {
    /// Nodal diameters.
    #[serde(alias = "main_harmonic")]
    pub harmonic: Option<usize>,
    /// Onset of the harmonic at which it is born.
    pub onset: Option<usize>,
    /// Frequency, Hz.
    pub main_frequency_hz: Option<f64>,
    /// Contact status.
    pub status: StatusFractions,
    /// Powers, W.
    pub power_w: MeanPowers,
    /// Points along the phase.
    pub phases: Option<usize>,
    /// Why there is none.
    pub error: Option<String>,
    /// What a transient says of it.
    pub confirmation: Option<Confirmed>,
}

/// Whether a transient stays on a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(default)]
pub struct Confirmed {
    /// It does, or does not.
    pub agrees: Option<bool>,
}

/// Where a branch turns unstable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Crossing {
    /// Nodal diameters.
    pub harmonic: Option<usize>,
    /// Friction coefficient.
    pub critical_friction: Option<f64>,
    /// Whether it is unstable at the lowest friction already.
    pub unstable_from_start: bool,
}

/// Amplitude ratios between which the winner of two waves changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Described, Serialize, Deserialize)]
pub struct Bounds {
    /// Largest ratio at which the first wave wins; without `high` it wins at every ratio tried.
    pub low: Option<f64>,
    /// Smallest ratio at which the second wins; without `low` it wins at every ratio tried.
    pub high: Option<f64>,
}

/// Growth of one harmonic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct HarmonicGrowth {
    /// Nodal diameters.
    pub harmonic: Option<usize>,
    /// Rate, 1/s.
    pub rate_per_s: Option<f64>,
}

impl PointSummary {
    /// Reads a summary.
    ///
    /// # Errors
    /// A key that holds something else than it does here.
    pub fn read(summary: &Value) -> Result<Self, serde_json::Error> {
        Self::deserialize(summary)
    }

    /// As [`PointSummary::read`] for what is shown only: nothing of a summary that cannot be read.
    pub fn of(summary: &Value) -> Self {
        Self::read(summary).unwrap_or_default()
    }
}

/// A number where there is one: JSON has neither NaN nor infinity, and nobody wants -0.0.
pub fn present(value: f64) -> Option<f64> {
    value.is_finite().then_some(value + 0.0)
}

/// The JSON object of a summary, in which no zero has a sign.
///
/// # Errors
/// Those of the serializer.
pub fn object(summary: &impl Serialize) -> serde_json::Result<Value> {
    let mut object = serde_json::to_value(summary)?;
    drop_signs_of_zeros(&mut object);
    Ok(object)
}

fn drop_signs_of_zeros(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() && number.as_f64() == Some(0.0) => {
            *value = Value::from(0.0);
        }
        Value::Array(items) => items.iter_mut().for_each(drop_signs_of_zeros),
        Value::Object(entries) => entries.values_mut().for_each(drop_signs_of_zeros),
        _ => {}
    }
}

/// Writes `summary.json` and gives the object that it holds.
///
/// # Errors
/// Those of the folder.
pub fn write_summary(
    folder: &OutputFolder,
    summary: &impl Serialize,
) -> Result<Value, FolderError> {
    let failed = |error: serde_json::Error| {
        FolderError::io("write", &folder.path().join(SUMMARY), error.into())
    };
    let object = object(summary).map_err(failed)?;
    folder.write(SUMMARY, |out| {
        serde_json::to_writer_pretty(&mut *out, &object)?;
        out.write_all(b"\n")
    })?;
    Ok(object)
}

/// The summary of a results folder.
///
/// # Errors
/// [`FolderError::NotResults`] if there is none, as after a run that was killed, if it is damaged, or if it is of another
/// command; those of the file system.
pub fn read_summary<T: DeserializeOwned>(path: &Path) -> Result<T, FolderError> {
    let bytes = read_own(path, SUMMARY)?;
    serde_json::from_slice(&bytes).map_err(|error| FolderError::NotResults {
        path: path.to_owned(),
        reason: format!("its {SUMMARY} is damaged ({error})"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_point_reads_what_its_analysis_has() {
        let transient = json!({
            "command": "transient", "main_frequency_hz": 9433.0, "main_harmonic": 2,
            "status": { "stick": 0.25, "slip": 0.75, "open": null },
            "growth": [{ "harmonic": 2, "rate_per_s": 952.0, "direction": -1 }]
        });
        let read = PointSummary::read(&transient).unwrap();
        assert_eq!(read.own.harmonic, Some(2));
        assert_eq!((read.own.status.stick, read.own.status.open), (Some(0.25), None));
        assert_eq!(read.growth[0].rate_per_s, Some(952.0));
        let cycles = json!({ "cycles": [
            { "harmonic": 1, "onset": 2, "error": "none", "confirmation": null },
            { "harmonic": 2, "onset": 1, "main_frequency_hz": 1e4, "confirmation": { "agrees": false } }
        ] });
        let read = PointSummary::read(&cycles).unwrap();
        assert_eq!(read.cycles[0].error.as_deref(), Some("none"));
        assert_eq!(read.cycles[1].confirmation.unwrap().agrees, Some(false));
        assert!(PointSummary::read(&json!({ "main_frequency_hz": "fast" })).is_err());
    }
}
