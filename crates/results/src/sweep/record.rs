//! Record of one point of a sweep, with its keys and values as people read them.

use super::table::cell;
use crate::grouped;
use frictionsim_output::{Format, Table, rounded};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A finished point: what was swept to which values, and what came out of it.
///
/// Holds no case text: the folder's manifest has it once, and `swept` is all that a point changes. Holds nothing that
/// the clock says either: the same point has the same bytes whoever computed it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// Number of the point, from 1.
    pub point: usize,
    /// Swept keys and their values, in the order of the keys.
    pub swept: Map<String, Value>,
    /// Why it failed; `None` if it did not.
    pub error: Option<String>,
    /// Summary of each analysis by its name; empty if the point failed.
    pub summaries: Map<String, Value>,
    /// SHA-256 of the point's effective case, without its `[sweep]`.
    pub case_hash: String,
    /// SHA-256 of the effective case of the whole sweep.
    pub sweep_hash: String,
    /// Program version that made it.
    pub version: String,
    /// SIMD level that the kernels ran with.
    pub simd: String,
}

/// What the clock said of a finished point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointClock {
    /// Wall time on its worker, s.
    pub wall_s: f64,
    /// Time that it kept cores busy, s; less than the wall time where other programs had them too.
    pub core_s: f64,
    /// What the summary of each analysis says of time and speed, by its dotted path.
    pub summaries: Map<String, Value>,
}

/// Keys of summaries that hold what the clock says.
const CLOCK: [&str; 2] = ["wall_s", "element_steps_per_s"];

impl PointClock {
    /// Takes what the clock says out of the summaries of a point.
    pub fn taken_from(wall_s: f64, core_s: f64, summaries: &mut Map<String, Value>) -> Self {
        let mut taken = Map::new();
        for (analysis, summary) in summaries {
            take(summary, analysis, &mut taken);
        }
        Self { wall_s, core_s, summaries: taken }
    }
}

fn take(value: &mut Value, path: &str, taken: &mut Map<String, Value>) {
    match value {
        Value::Object(entries) => {
            for key in CLOCK {
                if let Some(said) = entries.shift_remove(key) {
                    taken.insert(format!("{path}.{key}"), said);
                }
            }
            for (key, value) in entries {
                take(value, &format!("{path}.{key}"), taken);
            }
        }
        Value::Array(items) => {
            for (index, item) in items.iter_mut().enumerate() {
                take(item, &format!("{path}.{index}"), taken);
            }
        }
        _ => {}
    }
}

/// The entries of a list that read as `T`; a record of another version has none.
pub(crate) fn listed<T: for<'de> Deserialize<'de>>(list: Option<&Value>) -> Vec<T> {
    let items = list.and_then(Value::as_array).into_iter().flatten();
    items.filter_map(|item| T::deserialize(item).ok()).collect()
}

/// A value as people read it: numbers to five significant digits.
pub(crate) fn printed(value: &Value) -> String {
    match value.as_f64() {
        Some(number) => {
            cell(&Value::from(rounded(number, 5))).csv().trim_end_matches(".0").to_owned()
        }
        None => cell(value).csv(),
    }
}

/// The last part of a dotted key.
fn short(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// What keys are told by: the last part, or all of them where several share it.
pub(super) fn heads<'a>(keys: &[&'a String]) -> Vec<(&'a String, &'a str)> {
    let is_alone = |key: &str| keys.iter().filter(|other| short(other) == short(key)).count() == 1;
    keys.iter().map(|&key| (key, if is_alone(key) { short(key) } else { key })).collect()
}

/// A table of points with a column for each key.
pub(super) fn of_points<'a>(
    caption: impl Into<String>,
    keys: &'a [String],
    points: impl Iterator<Item = (usize, &'a Map<String, Value>)> + Clone,
) -> Table {
    let number = points.clone().map(|own| own.0);
    let table = Table::new("", caption).column("", Some(("point", Format::Count)), number);
    heads(&keys.iter().collect::<Vec<_>>()).into_iter().fold(table, |table, (key, head)| {
        let values = points.clone().map(|own| own.1.get(key).map(printed));
        table.column("", Some((head, Format::Plain)), values)
    })
}

/// What points have, a list for each choice of the swept keys other than one, under its label.
pub(crate) fn by_other_keys<'a, T>(
    points: impl Iterator<Item = (&'a PointRecord, T)>,
    key: &str,
    label: impl Fn(&Map<String, Value>) -> String,
) -> Vec<(String, Vec<T>)> {
    grouped(points.map(|(record, own)| {
        let mut rest = record.swept.clone();
        rest.remove(key);
        (label(&rest), own)
    }))
}

/// `friction_coefficient = 0.3, rotation_speed_rpm = 610`; keys of one name and value once.
pub fn swept_text(swept: &Map<String, Value>) -> String {
    let mut keys: Vec<&String> = Vec::new();
    for (key, value) in swept {
        if !keys.iter().any(|own| short(own) == short(key) && swept[*own] == *value) {
            keys.push(key);
        }
    }
    let part = |(key, head): (&String, &str)| format!("{head} = {}", printed(&swept[key]));
    heads(&keys).into_iter().map(part).collect::<Vec<_>>().join(", ")
}
