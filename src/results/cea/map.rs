//! `map.csv` and its chart: critical friction over a second parameter.

use crate::cea::UnstableInterval;
use crate::cea::cyclic::StabilityMapPoint;
use crate::chart::{ChartError, Figure};
use crate::results::charts::{CriticalBranch, critical_friction};
use crate::results::table::{Table, format_number};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// A stability map in the friction coefficient and a second parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct MapReport {
    /// Case key of the second parameter.
    pub key: String,
    /// Largest friction coefficient studied.
    pub largest_friction: f64,
    /// Outcome at each value of the second parameter.
    pub points: Vec<StabilityMapPoint>,
}

impl MapReport {
    /// Writes one row for each value and branch that turns unstable; a value without instability or one
    /// that failed has one row, with the reason in the last column.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let columns = [
            self.key.as_str(),
            "harmonic",
            "branch",
            "direction",
            "critical_friction",
            "frequency_hz",
            "restabilized_friction",
            "error",
        ];
        let mut table = Table::new(out, &columns)?;
        for point in &self.points {
            let value = format_number(point.value);
            let mut row = |interval: Option<&UnstableInterval>, error: String| {
                let text =
                    |of: &dyn Fn(&UnstableInterval) -> String| interval.map_or(String::new(), of);
                table.row([
                    value.clone(),
                    text(&|i| i.harmonic.to_string()),
                    text(&|i| i.branch.to_string()),
                    text(&|i| i.direction.to_string()),
                    text(&|i| format_number(i.critical_friction)),
                    text(&|i| format_number(i.frequency_hz)),
                    text(&|i| {
                        i.restabilized
                            .map_or(String::new(), |end| format_number(end.0))
                    }),
                    error,
                ])
            };
            match &point.outcome {
                Ok(intervals) if intervals.is_empty() => row(None, String::new())?,
                Ok(intervals) => {
                    for interval in intervals {
                        row(Some(interval), String::new())?;
                    }
                }
                Err(error) => row(None, error.to_string())?,
            }
        }
        table.finish()
    }

    /// The critical friction of every branch over the second parameter.
    ///
    /// # Errors
    /// [`ChartError::Empty`] for a map of a single value.
    pub(super) fn figure(&self) -> Result<Figure, ChartError> {
        if self.points.len() < 2 {
            return Err(ChartError::empty("map"));
        }
        let found = self
            .points
            .iter()
            .filter_map(|point| point.outcome.as_ref().ok());
        let intervals = found.flatten();
        let branches: BTreeSet<_> = intervals
            .map(|i| (i.harmonic, i.branch, i.direction))
            .collect();
        let values: Vec<f64> = self.points.iter().map(|point| point.value).collect();
        let curve = |(n, branch, direction)| {
            let critical =
                |point: &StabilityMapPoint| point.critical_friction(n, branch, direction);
            let critical = self
                .points
                .iter()
                .map(|point| critical(point).unwrap_or(f64::NAN));
            CriticalBranch {
                branch: (n, branch, direction),
                critical: critical.collect(),
            }
        };
        let branches: Vec<CriticalBranch> = branches.into_iter().map(curve).collect();
        let figure = critical_friction(&self.key, &values, &branches, self.largest_friction);
        Ok(figure.named("map"))
    }

    /// The lowest critical friction over the map, in words.
    pub fn print(&self) -> String {
        let onsets = self.points.iter().filter_map(|point| {
            let onset = point.lowest_onset()?;
            Some((onset.critical_friction, point.value))
        });
        let failed = self.points.iter().filter(|point| point.outcome.is_err());
        let failed = match failed.count() {
            0 => String::new(),
            count => format!("; {count} values failed, see map.csv"),
        };
        match onsets.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((friction, value)) => format!(
                "map over {}: lowest critical friction {friction:.6} at {value}{failed}",
                self.key
            ),
            None => format!(
                "map over {}: stable up to friction {}{failed}",
                self.key, self.largest_friction
            ),
        }
    }
}
