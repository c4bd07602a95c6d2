//! `[sweep]`: any case key over several values.

use super::diagnostic::{CaseErrors, Location};
use super::keys;
use super::raw::{RawEntry, RawValue};
use super::reader::{Bound, Section};
use super::{Case, RawCase};

/// What runs at a point of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Analysis {
    /// The complex eigenvalue analysis.
    Cea,
    /// The explicit transient.
    Transient,
    /// The direct search for limit cycles.
    Cycle,
}

/// How several swept keys combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// Every value of each with every value of the others, the last key fastest.
    Grid,
    /// The first value of each, then the second of each, and so on.
    Zip,
}

/// A swept key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptKey {
    /// Dotted case key.
    pub key: String,
    /// Values, as TOML.
    pub values: Vec<String>,
    /// Where they are given.
    pub at: Location,
}

/// `[sweep]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Swept keys in alphabetical order.
    pub keys: Vec<SweptKey>,
    /// How they combine.
    pub combination: Combination,
    /// What runs at each point; empty if the case leaves that to the sections it has.
    pub analyses: Vec<Analysis>,
}

impl Sweep {
    /// Number of points.
    pub fn point_count(&self) -> usize {
        let counts = self.keys.iter().map(|key| key.values.len());
        match self.combination {
            Combination::Grid => counts.fold(1, usize::saturating_mul),
            Combination::Zip => counts.min().unwrap_or(0),
        }
    }

    /// The overrides that make point `index`, one for each key, in the order of the keys.
    pub fn overrides(&self, index: usize) -> Vec<String> {
        let mut rest = index;
        let mut overrides: Vec<String> = self
            .keys
            .iter()
            .rev()
            .map(|key| {
                let at = match self.combination {
                    Combination::Grid => {
                        let at = rest % key.values.len();
                        rest /= key.values.len();
                        at
                    }
                    Combination::Zip => index,
                };
                format!("{}={}", key.key, key.values[at])
            })
            .collect();
        overrides.reverse();
        overrides
    }
}

pub(super) fn read(root: &Section<'_>) -> Option<Sweep> {
    let section = root.section("sweep", false);
    if !section.is_given() {
        section.close();
        return None;
    }
    let combination = section.choice(
        "combine",
        &[("grid", Combination::Grid), ("zip", Combination::Zip)],
    );
    let analyses = section.choices(
        "analyses",
        &[
            ("transient", Analysis::Transient),
            ("cea", Analysis::Cea),
            ("cycle", Analysis::Cycle),
        ],
        &[],
    );
    let mut keys = Vec::new();
    for (name, entry) in section.remaining() {
        collect(&section, name, entry, &mut keys);
    }
    if keys.is_empty() {
        section.reject_there(
            &section.place(""),
            "[sweep] sweeps nothing".to_owned(),
            "no key with values".to_owned(),
            "add for example `\"contact.friction_coefficient\" = [0.2, 0.3, 0.4]`",
        );
    }
    let sweep = Sweep {
        keys,
        combination,
        analyses,
    };
    check_lengths(&section, &sweep);
    Some(sweep)
}

/// Reads one swept key; tables that are no range are dotted keys written without quotes.
fn collect(section: &Section<'_>, name: &str, entry: &RawEntry, keys: &mut Vec<SweptKey>) {
    if keys::find(name).is_none()
        && let RawValue::Table(inner) = &entry.item.value
    {
        for (key, entry) in inner {
            collect(section, &format!("{name}.{key}"), entry, keys);
        }
        return;
    }
    if keys::find(name).is_none() || name.starts_with("sweep.") {
        let all = keys::KEYS.iter().map(|key| key.name);
        section.reject_there(
            &entry.key_at,
            format!("unknown key `{name}` in [sweep]"),
            "not a case key that can be swept".to_owned(),
            &keys::nearest(name, all).map_or_else(
                || "a swept key is a dotted case key in quotes".to_owned(),
                |near| format!("did you mean \"{near}\"?"),
            ),
        );
        return;
    }
    let values: Vec<String> = match &entry.item.value {
        RawValue::Array(items) => items.iter().map(|item| item.value.to_string()).collect(),
        RawValue::Table(table) => section
            .range(name, table, &entry.item, Bound::Finite)
            .into_iter()
            .map(|value| RawValue::Float(value).to_string())
            .collect(),
        other => vec![other.to_string()],
    };
    if values.is_empty() && matches!(entry.item.value, RawValue::Array(_)) {
        section.reject_there(
            &entry.item.at,
            format!("\"{name}\" in [sweep] has no values"),
            "at least one value".to_owned(),
            "list its values or give a range { from, to, count }",
        );
    }
    keys.push(SweptKey {
        key: name.to_owned(),
        values,
        at: entry.item.at.clone(),
    });
}

fn check_lengths(section: &Section<'_>, sweep: &Sweep) {
    const MOST_POINTS: usize = 1_000_000;
    if sweep.combination == Combination::Zip
        && let Some((first, rest)) = sweep.keys.split_first()
        && let Some(other) = rest.iter().find(|k| k.values.len() != first.values.len())
    {
        section.reject_there(
            &other.at,
            format!(
                "\"{}\" has {} values but \"{}\" has {}",
                other.key,
                other.values.len(),
                first.key,
                first.values.len()
            ),
            "zipped keys need equally many values".to_owned(),
            "give them the same count, or combine = \"grid\"",
        );
    }
    if sweep.point_count() > MOST_POINTS {
        section.reject_there(
            &sweep.keys[0].at,
            format!("[sweep] has {} points", sweep.point_count()),
            format!("at most {MOST_POINTS}"),
            "sweep fewer values",
        );
    }
}

/// Checks each swept value on its own, all others as the case has them, so that a bad one is
/// reported before anything runs. Of a very long list only evenly spaced ones are tried: the sweep
/// itself reports the rest, point by point.
pub(super) fn check_values(case: &Case) -> Result<(), CaseErrors> {
    let Some(sweep) = &case.sweep else {
        return Ok(());
    };
    const MOST_TRIED: usize = 1000;
    let mut errors = Vec::new();
    for key in &sweep.keys {
        let last = key.values.len().saturating_sub(1);
        let tried = key.values.len().min(MOST_TRIED);
        for value in (0..tried).map(|i| &key.values[i * last / tried.max(2).saturating_sub(1)]) {
            let point = [format!("{}={value}", key.key)];
            let result = case.raw.sweep_point(&point).and_then(read_point);
            if let Err(bad) = result {
                for mut error in bad.diagnostics {
                    error.message = format!("swept value {}: {}", point[0], error.message);
                    error.at = key.at.clone();
                    errors.push(error);
                }
            }
        }
    }
    if errors.is_empty() {
        Ok(())
    } else {
        Err(case.raw.errors(errors))
    }
}

fn read_point(raw: RawCase) -> Result<(), CaseErrors> {
    Case::read(raw).map(|_| ())
}
