//! Swept keys and their values as people read them.

use super::PointRecord;
use super::table::cell;
use crate::grouped;
use frictionsim_output::{Format, Table, rounded};
use serde_json::{Map, Value};

/// Keys over which figures are drawn first.
pub(crate) const SPEED: &str = "contact.rotation_speed_rpm";
pub(crate) const FRICTION: &str = "contact.friction_coefficient";

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
