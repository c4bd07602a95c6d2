//! Swept keys and their values as people read them.

use super::table::cell;
use serde_json::{Map, Value};

/// A value as people read it: numbers to five significant digits.
pub(super) fn printed(value: &Value) -> String {
    match value.as_f64() {
        Some(number) => {
            let rounded: f64 = format!("{number:.4e}").parse().unwrap_or(number);
            cell(&Value::from(rounded)).trim_end_matches(".0").to_owned()
        }
        None => cell(value),
    }
}

/// The last part of a dotted key.
pub(super) fn short(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// `friction_coefficient = 0.3, rotation_speed_rpm = 610`; keys of one name and value once.
pub fn swept_text(swept: &Map<String, Value>) -> String {
    let mut parts: Vec<String> = Vec::new();
    for (key, value) in swept {
        let part = format!("{} = {}", short(key), printed(value));
        if !parts.contains(&part) {
            parts.push(part);
        }
    }
    parts.join(", ")
}
