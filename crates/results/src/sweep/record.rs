//! Record of one point of a sweep.

use crate::common::*;

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
