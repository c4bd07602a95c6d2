//! The operating matrix of a study of eigenvalue analyses: which modes grow under which conditions.

use super::PointRecord;
use super::swept::{printed, short, swept_text};
use crate::results::cea::{UnstableCount, UnstableMode};
use crate::results::quantity::{fixed, quantity};
use crate::results::report::ReportTable;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// Longest list of unstable modes in a report; `unstable_modes.csv` has all.
const MOST_ROWS: usize = 400;

/// One operating condition: a point of the study at one friction coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition<'a> {
    /// Number of the point.
    pub point: usize,
    /// Swept keys and their values.
    pub swept: &'a Map<String, Value>,
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// The modes that grow.
    pub unstable: Vec<UnstableMode>,
}

/// Every condition of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct OperatingMatrix<'a> {
    /// In the order of the points, friction rising within each.
    pub conditions: Vec<Condition<'a>>,
    /// Points whose analysis failed.
    pub failed: Vec<&'a PointRecord>,
}

impl<'a> OperatingMatrix<'a> {
    /// The conditions of the points that have an eigenvalue analysis.
    pub fn of(records: &'a [PointRecord]) -> Self {
        let (mut conditions, mut failed) = (Vec::new(), Vec::new());
        for record in records {
            if record.error.is_some() {
                failed.push(record);
            }
            let Some(summary) = record.summaries.get("cea") else {
                continue;
            };
            let modes = listed::<UnstableMode>(summary.get("unstable_modes"));
            for count in listed::<UnstableCount>(summary.get("unstable_counts")) {
                let friction = count.friction_coefficient;
                let here = |mode: &&UnstableMode| mode.friction_coefficient == friction;
                conditions.push(Condition {
                    point: record.point,
                    swept: &record.swept,
                    friction_coefficient: friction,
                    unstable: modes.iter().filter(here).copied().collect(),
                });
            }
        }
        Self { conditions, failed }
    }

    /// How many conditions squeal, and the one whose mode grows fastest; nothing without a condition.
    pub fn sentence(&self) -> Option<String> {
        if self.conditions.is_empty() {
            return None;
        }
        let squealing = self.conditions.iter().filter(|c| !c.unstable.is_empty());
        let points: BTreeSet<usize> = self.conditions.iter().map(|c| c.point).collect();
        let mut text = format!(
            "{} of {} operating conditions ({} points) have unstable modes",
            squealing.count(),
            self.conditions.len(),
            points.len(),
        );
        let modes = self.modes();
        let fastest = modes.max_by(|a, b| a.1.growth_rate_per_s.total_cmp(&b.1.growth_rate_per_s));
        if let Some((condition, mode)) = fastest {
            text += &format!(
                "; the fastest, {} Hz, grows by {} 1/s at {}, friction {}",
                fixed(mode.frequency_hz, 1),
                fixed(mode.growth_rate_per_s, 1),
                swept_text(condition.swept),
                condition.friction_coefficient,
            );
        }
        Some(text)
    }

    /// Every unstable mode with its condition.
    fn modes(&self) -> impl Iterator<Item = (&Condition<'a>, &UnstableMode)> {
        let conditions = self.conditions.iter();
        conditions.flat_map(|own| own.unstable.iter().map(move |mode| (own, mode)))
    }

    /// The unstable modes as a table of a report; none where nothing is unstable.
    pub fn table(&self, keys: &[String]) -> Option<ReportTable> {
        let captions = ["frequency_hz", "growth_rate_per_s", "critical_friction"];
        let mut columns = vec!["point".to_owned()];
        columns.extend(keys.iter().map(|key| short(key).to_owned()));
        columns.extend(["friction".to_owned(), "mode".to_owned()]);
        columns.extend(captions.iter().map(|key| quantity(key).label()));
        let number = |key: &str, value: Option<f64>| {
            value.map_or_else(String::new, |value| quantity(key).number(value))
        };
        let rows = self.modes().take(MOST_ROWS).map(|(condition, mode)| {
            let mut row = vec![condition.point.to_string()];
            row.extend(condition.swept.values().map(printed));
            row.push(condition.friction_coefficient.to_string());
            row.push(match mode.harmonic {
                Some(harmonic) => format!("{} (n = {harmonic})", mode.mode),
                None => mode.mode.to_string(),
            });
            row.push(number(captions[0], Some(mode.frequency_hz)));
            row.push(number(captions[1], Some(mode.growth_rate_per_s)));
            row.push(number(captions[2], mode.critical_friction));
            row
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let count = self.modes().count();
        let caption = match count > MOST_ROWS {
            true => {
                format!("The first {MOST_ROWS} of {count} unstable modes (all: unstable_modes.csv)")
            }
            false => {
                "Unstable modes under every operating condition (unstable_modes.csv)".to_owned()
            }
        };
        (!rows.is_empty()).then_some(ReportTable::new(caption, columns, rows))
    }
}

/// The entries of a list that read as `T`; a record of another version has none.
fn listed<T: for<'de> Deserialize<'de>>(list: Option<&Value>) -> Vec<T> {
    let items = list.and_then(Value::as_array).into_iter().flatten();
    items.filter_map(|item| T::deserialize(item).ok()).collect()
}
