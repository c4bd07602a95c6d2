//! Typed summaries: the struct that `summary.json` is.
//!
//! Its fields are the keys in their order, between a head and a foot that all have. A value that may be absent is an
//! `Option` and null in JSON: JSON has neither NaN nor infinity.

use super::reopening::{SUMMARY, read_own};
use super::{framed::write_json, keys::keys, manifest::Manifest};
use crate::prelude::*;
use crate::{FolderError, OutputFolder};
use frictionsim_physics::transient::ContactPowers;
use std::fmt;

keys! {
    /// Where along a parameter steady sliding loses its stability.
    CriticalValue {
        key: String = "key of the case";
        value: f64 = "value, in its units";
    }
}

impl CriticalValue {
    /// Of a parameter, at a value in SI units.
    pub fn of(parameter: Parameter, value: f64) -> Self {
        Self { key: parameter.key().to_owned(), value: parameter.in_key_units(value) }
    }
}

impl fmt::Display for CriticalValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {:.5}", self.key, self.value)
    }
}

keys! {
    /// Fractions of the contact nodes, averaged over the interval that a summary is of.
    #[derive(Copy, Default)]
    StatusFractions, STATUS {
        stick: Option<f64> = "fraction of the contact that sticks", Always "stick" Percent(1);
        slip: Option<f64> = "fraction that slips", Always "slip" Percent(1);
        open: Option<f64> = "fraction that is open", Always "open" Percent(1);
    }
}

impl StatusFractions {
    /// Of `[stick, slip, open]`.
    pub fn of(fractions: [f64; 3]) -> Self {
        let [stick, slip, open] = fractions.map(present);
        Self { stick, slip, open }
    }
}

keys! {
    /// Mean powers of a whole disc, W; equations (9) to (12).
    #[derive(Copy, Default)]
    MeanPowers {
        external: Option<f64> = "of the motor";
        stick: Option<f64> = "of sticking nodes";
        slide: Option<f64> = "of sliding nodes";
        contact_dissipated: Option<f64> = "lost to friction";
        material_damping: Option<f64> = "lost in the body";
        normal_contact: Option<f64> = "of the normal contact forces";
        contact_damping?: f64 = "lost in the dashpots of a contact that has some";
        pressure?: f64 = "of the pressures on boundaries, where there are some";
    }
}

impl MeanPowers {
    /// Of the contact and of the damping of the body.
    pub fn of(contact: &ContactPowers, material_damping: f64) -> Self {
        Self {
            external: present(contact.external),
            stick: present(contact.stick),
            slide: present(contact.slide),
            contact_dissipated: present(contact.contact_dissipated),
            material_damping: present(material_damping),
            normal_contact: present(contact.normal),
            contact_damping: (contact.damping != 0.0).then_some(contact.damping),
            pressure: (contact.pressure != 0.0).then_some(contact.pressure),
        }
    }
}

/// What forces, torques, powers and energies are of, `extent` in JSON.
///
/// The columns of tables keep their names: this says how to read `_w`, `_j`, `_n`, `_n_m` there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Described, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Extent {
    /// Of the whole body.
    #[default]
    WholeBody,
    /// Of each metre of the thickness of a plane body, where the case gives no `geometry.thickness`.
    MetreOfThickness,
}

impl Extent {
    /// The unit of a quantity: for each metre "W/m" for "W", but "Hz" for "Hz", which does not grow with the thickness.
    pub fn unit(self, unit: &str) -> String {
        let grows = ["W", "J", "N", "N m", "N/m", "N s/m", "kg"].contains(&unit);
        let is_each = grows && self == Self::MetreOfThickness;
        if is_each { format!("{unit}/m") } else { unit.to_owned() }
    }

    /// A table for people, in these units.
    pub fn table(self, table: Table) -> Table {
        if self == Self::MetreOfThickness { table.for_each_metre() } else { table }
    }

    /// That of a summary, where it says one.
    pub fn of_summary(summary: &Value) -> Option<Self> {
        let own = summary.get("extent").or_else(|| summary.pointer("/base_state/extent"));
        Self::deserialize(own?).ok()
    }

    /// What is to be said beside numbers for each metre; nothing of those of a whole body.
    pub fn sentence(self) -> Option<String> {
        let text = "forces, torques, powers and energies are for each metre of thickness: the case gives no \
                    geometry.thickness.";
        (self == Self::MetreOfThickness).then(|| text.to_owned())
    }
}

keys! {
    /// Amplitude ratios between which the winner of two waves changes.
    #[derive(Copy, Default)]
    Bounds {
        low: Option<f64> = "largest ratio at which the first wave wins; without `high` it wins at every ratio tried";
        high: Option<f64> = "smallest ratio at which the second wins; without `low` it wins at every ratio tried";
    }
}

/// A number where there is one: JSON has neither NaN nor infinity, and nobody wants -0.0.
pub fn present(value: f64) -> Option<f64> {
    value.is_finite().then_some(value + 0.0)
}

/// What every summary begins with behind its command.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Head<'a> {
    /// Title of the case, of a command that runs one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<&'a str>,
    /// Wall time, s, of a command that takes some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall_s: Option<f64>,
}

impl<'a> Head<'a> {
    /// Of a case that took so long, s.
    pub fn of(title: &'a str, wall_s: f64) -> Self {
        Self { title: Some(title), wall_s: Some(wall_s) }
    }
}

/// The JSON object of what a command has found, behind its name and its head. No zero has a sign.
pub fn object(command: &str, head: Head<'_>, found: &impl Serialize) -> serde_json::Result<Value> {
    #[derive(Serialize)]
    struct Whole<'a, S> {
        command: &'a str,
        #[serde(flatten)]
        head: Head<'a>,
        #[serde(flatten)]
        found: &'a S,
    }
    let mut object = serde_json::to_value(Whole { command, head, found })?;
    drop_signs_of_zeros(&mut object);
    Ok(object)
}

/// The same with what it was made from: what `summary.json` holds.
pub fn summary_of(
    manifest: &Manifest,
    head: Head<'_>,
    found: &impl Serialize,
) -> serde_json::Result<Value> {
    let mut whole = object(&manifest.command, head, found)?;
    if let Some(entries) = whole.as_object_mut() {
        entries.insert("manifest".to_owned(), serde_json::to_value(manifest)?);
    }
    Ok(whole)
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

/// Writes `summary.json` of what was found and gives the object that it holds.
pub fn write_summary(
    folder: &OutputFolder,
    head: Head<'_>,
    found: &impl Serialize,
) -> Result<Value, FolderError> {
    let failed = |error: serde_json::Error| {
        FolderError::io("write", &folder.path().join(SUMMARY), error.into())
    };
    let object = summary_of(folder.manifest(), head, found).map_err(failed)?;
    folder.write(SUMMARY, |out| write_json(out, &object))?;
    Ok(object)
}

/// The summary of a results folder.
///
/// # Errors
/// [`FolderError::Unusable`] if there is none, as after a run that was killed, if it is damaged, or if it is of
/// another command; those of the file system.
pub fn read_summary<T: DeserializeOwned>(path: &Path) -> Result<T, FolderError> {
    let bytes = read_own(path, SUMMARY)?;
    let damaged =
        |error| FolderError::no_results(path, format!("its {SUMMARY} is damaged ({error})"));
    serde_json::from_slice(&bytes).map_err(damaged)
}
