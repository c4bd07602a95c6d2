//! The operating matrix of a study of eigenvalue analyses: which modes grow under which conditions.

use super::record::{PointRecord, listed};
use super::swept::{of_points, swept_text};
use crate::cea::{UNSTABLE, UnstableCount, UnstableMode};
use frictionsim_output::{Table, fixed};
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
}

impl<'a> OperatingMatrix<'a> {
    /// The conditions of the points that have an eigenvalue analysis.
    pub fn of(records: &'a [PointRecord]) -> Self {
        let of_point = |(record, summary): (&'a PointRecord, &Value)| {
            let modes = listed::<UnstableMode>(summary.get("unstable_modes"));
            let counts = listed::<UnstableCount>(summary.get("unstable_counts")).into_iter();
            counts.map(move |UnstableCount { friction_coefficient, .. }| {
                let own = modes.iter().filter(|m| m.friction_coefficient == friction_coefficient);
                let (unstable, swept) = (own.copied().collect(), &record.swept);
                Condition { point: record.point, swept, friction_coefficient, unstable }
            })
        };
        let solved = records.iter().filter_map(|own| Some((own, own.summaries.get("cea")?)));
        Self { conditions: solved.flat_map(of_point).collect() }
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
                "; the fastest, {} Hz, grows by {} 1/s at friction {} of the eigenvalue analysis, point {} ({})",
                fixed(mode.frequency_hz, 1),
                fixed(mode.growth_rate_per_s, 1),
                condition.friction_coefficient,
                condition.point,
                swept_text(condition.swept),
            );
        }
        Some(text)
    }

    /// Every unstable mode with its condition.
    fn modes(&self) -> impl Iterator<Item = (&Condition<'a>, &UnstableMode)> {
        self.conditions.iter().flat_map(|own| own.unstable.iter().map(move |mode| (own, mode)))
    }

    /// The unstable modes as a table.
    pub(super) fn table(&self, keys: &[String]) -> Table {
        let count = self.modes().count();
        let caption = if count > MOST_ROWS {
            format!("The first {MOST_ROWS} of {count} unstable modes (all: unstable_modes.csv)")
        } else {
            "Unstable modes under every operating condition (unstable_modes.csv)".to_owned()
        };
        let shown: Vec<_> = self.modes().take(MOST_ROWS).collect();
        let points = shown.iter().map(|own| (own.0.point, own.0.swept));
        of_points(caption, keys, points).columns(UNSTABLE, shown.iter().map(|own| own.1))
    }
}
