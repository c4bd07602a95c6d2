//! `map.csv` and its chart: critical friction over a second parameter.

use crate::cea::UnstableInterval;
use crate::cea::cyclic::StabilityMapPoint;
use crate::chart::{ChartError, Figure};
use crate::results::charts::{BranchName, CriticalBranch, critical_friction};
use crate::results::table::{Column, write_rows};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// A stability map in the friction coefficient and a second parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct MapReport {
    /// Case key of the second parameter.
    pub key: String,
    /// Its unit; empty of a number without one.
    pub unit: String,
    /// Whether the body has the symmetry that harmonics belong to.
    pub has_harmonics: bool,
    /// Largest friction coefficient studied.
    pub largest_friction: f64,
    /// Outcome at each value of the second parameter.
    pub points: Vec<StabilityMapPoint>,
}

impl MapReport {
    /// Harmonic or nodal diameters, where the body has them, branch and direction.
    fn name(&self, own: &UnstableInterval) -> BranchName {
        match self.has_harmonics {
            true => (Some(own.harmonic), own.branch, own.direction),
            false => (own.nodal_diameters, own.branch, 0),
        }
    }

    /// Writes one row for each value and branch that turns unstable; a value without instability or one
    /// that failed has one row, with the reason in the last column.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        type Row<'a> = (f64, Option<&'a UnstableInterval>, Option<String>);
        let columns: &[Column<'_, Row<'_>>] = &[
            (&self.key, &|row| row.0.into()),
            ("harmonic", &|row| row.1.and_then(|i| self.name(i).0).into()),
            ("branch", &|row| row.1.map(|i| i.branch).into()),
            ("direction", &|row| {
                let direction = row.1.map(|i| i.direction);
                direction.filter(|_| self.has_harmonics).into()
            }),
            ("critical_friction", &|row| row.1.map(|i| i.critical_friction).into()),
            ("frequency_hz", &|row| row.1.map(|i| i.frequency_hz).into()),
            ("restabilized_friction", &|row| {
                row.1.and_then(|i| i.restabilized).map(|end| end.0).into()
            }),
            ("error", &|row| row.2.clone().into()),
        ];
        let rows = self.points.iter().flat_map(|point| -> Vec<Row<'_>> {
            match &point.outcome {
                Ok(intervals) if intervals.is_empty() => vec![(point.value, None, None)],
                Ok(all) => all.iter().map(|i| (point.value, Some(i), None)).collect(),
                Err(error) => vec![(point.value, None, Some(error.to_string()))],
            }
        });
        write_rows(out, columns, rows)
    }

    /// The critical friction of every branch over the second parameter.
    ///
    /// # Errors
    /// [`ChartError::Empty`] for a map of a single value.
    pub(super) fn figure(&self) -> Result<Figure, ChartError> {
        if self.points.len() < 2 {
            return Err(ChartError::empty("map"));
        }
        let found = self.points.iter().filter_map(|point| point.outcome.as_ref().ok());
        let intervals = found.flatten();
        let branches: BTreeSet<BranchName> = intervals.map(|i| self.name(i)).collect();
        let values: Vec<f64> = self.points.iter().map(|point| point.value).collect();
        let curve = |branch: BranchName| {
            let critical = self.points.iter().map(|point| {
                let mut intervals = point.outcome.iter().flatten();
                let own = intervals.find(|i| self.name(i) == branch);
                own.map_or(f64::NAN, |i| i.critical_friction)
            });
            CriticalBranch { branch, critical: critical.collect() }
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
            Some((friction, value)) => {
                let at = format!("{value} {}", self.unit);
                format!(
                    "map over {}: lowest critical friction {friction:.6} at {}{failed}",
                    self.key,
                    at.trim_end()
                )
            }
            None => format!(
                "map over {}: stable up to friction {}{failed}",
                self.key, self.largest_friction
            ),
        }
    }
}
