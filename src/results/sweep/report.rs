//! Summary of a sweep and the table that it prints.

use super::super::Manifest;
use super::super::quantity::quantity;
use super::super::summary::PointSummary;
use super::PointRecord;
use super::matrix::OperatingMatrix;
use super::swept::{printed, short};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::fmt::Write as _;

/// A number of a point's summary.
type NumberOf = fn(&PointSummary) -> Option<f64>;

/// What a person wants first of a point: the key whose caption the column has, and the number.
const FIRST_COLUMNS: [(&str, NumberOf); 18] = [
    ("main_frequency_hz", |s| s.own.main_frequency_hz),
    ("harmonic", |s| s.own.harmonic.map(|n| n as f64)),
    ("status.stick", |s| s.own.status.stick),
    ("status.slip", |s| s.own.status.slip),
    ("status.open", |s| s.own.status.open),
    ("critical_friction", |s| s.critical_frictions.first()?.critical_friction),
    ("harmonic", |s| s.critical_frictions.first()?.harmonic.map(|n| n as f64)),
    ("harmonic", |s| s.cycles.first()?.harmonic.map(|n| n as f64)),
    ("main_frequency_hz", |s| s.cycles.first()?.main_frequency_hz),
    ("status.stick", |s| s.cycles.first()?.status.stick),
    ("status.open", |s| s.cycles.first()?.status.open),
    ("harmonic", |s| s.cycles.get(1)?.harmonic.map(|n| n as f64)),
    ("main_frequency_hz", |s| s.cycles.get(1)?.main_frequency_hz),
    ("status.stick", |s| s.cycles.get(1)?.status.stick),
    ("status.open", |s| s.cycles.get(1)?.status.open),
    ("winner", |s| s.winner.map(|n| n as f64)),
    ("boundary.low", |s| s.boundary.low),
    ("boundary.high", |s| s.boundary.high),
];

/// Names of the ends of a transient that are no limit cycle although it vibrates.
pub(in crate::results) const TWO_FREQUENCY: &str = "two-frequency";
pub(in crate::results) const UNSETTLED: &str = "unsettled";

/// Longest table that is printed.
const MOST_ROWS: usize = 200;

/// Everything that is known of a sweep.
#[derive(Clone, Debug)]
pub struct SweepReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// Friction coefficient where it is not swept.
    pub friction_coefficient: f64,
    /// Swept keys.
    pub keys: &'a [String],
    /// Names of the analyses at each point.
    pub analyses: &'a [&'static str],
    /// Number of points of the whole sweep.
    pub count: usize,
    /// Finished points in their order.
    pub records: &'a [PointRecord],
    /// Time that they kept cores busy, s.
    pub core_s: f64,
    /// Points that this process ran, or none if it only collects.
    pub ran: Option<usize>,
    /// Wall time of this process, s.
    pub wall_s: f64,
}

impl SweepReport<'_> {
    /// Numbers of the points that are not finished, ascending.
    pub fn missing(&self) -> Vec<usize> {
        let mut finished = self.records.iter().map(|record| record.point).peekable();
        (1..=self.count).filter(|point| finished.next_if_eq(point).is_none()).collect()
    }

    /// Failed points.
    pub fn failed(&self) -> impl Iterator<Item = &PointRecord> {
        self.records.iter().filter(|record| record.error.is_some())
    }

    /// Points done in an hour of one core; failed ones cost time but do not count.
    fn points_per_core_hour(&self) -> Option<f64> {
        let done = self.records.len() - self.failed().count();
        (done > 0 && self.core_s > 0.0).then(|| done as f64 * 3600.0 / self.core_s)
    }

    /// Errors in the order of their first points, each with the numbers of all points that have it.
    fn errors(&self) -> Vec<(&str, Vec<usize>)> {
        let mut errors: Vec<(&str, Vec<usize>)> = Vec::new();
        for record in self.failed() {
            let text = record.error.as_deref().unwrap_or_default();
            match errors.iter_mut().find(|(known, _)| *known == text) {
                Some((_, points)) => points.push(record.point),
                None => errors.push((text, vec![record.point])),
            }
        }
        errors
    }

    /// What to know before points are compared: they were not all made alike.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut makers: Vec<String> = self
            .records
            .iter()
            .map(|record| format!("version {}, SIMD {}", record.version, record.simd))
            .collect();
        makers.sort();
        makers.dedup();
        let mut notes = Vec::new();
        if makers.len() > 1 {
            notes.push(format!(
                "the points were not all made alike, so their last digits may differ: {}",
                makers.join("; ")
            ));
        }
        let two = self.ending_in(|end| end == TWO_FREQUENCY);
        if !two.is_empty() {
            notes.push(format!(
                "the transient ends in a vibration of two frequencies at {} of {} points ({}): their numbers are of no \
                 limit cycle",
                two.len(),
                self.records.len(),
                number_ranges(&two)
            ));
        }
        let unsettled = self.ending_in(|end| end == UNSETTLED);
        if !unsettled.is_empty() {
            notes.push(format!(
                "the transient ends before it has settled at {} of {} points ({}): these are not limit cycles; \
                 raise transient.duration",
                unsettled.len(),
                self.records.len(),
                number_ranges(&unsettled)
            ));
        }
        notes
    }

    /// Points whose transient ends in such a state.
    fn ending_in(&self, is_such: impl Fn(&str) -> bool) -> Vec<usize> {
        let ends_so = |record: &&PointRecord| {
            let mut summaries = record.summaries.values().map(PointSummary::of);
            summaries.any(|summary| summary.end_state.as_deref().is_some_and(&is_such))
        };
        let points = self.records.iter().filter(ends_so);
        points.map(|record| record.point).collect()
    }
}

/// `summary.json` of `frictionsim sweep`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepSummary {
    /// `sweep`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Swept keys.
    pub swept: Vec<String>,
    /// Analyses at each point.
    pub analyses: Vec<String>,
    /// Points of the whole sweep.
    pub points: usize,
    /// Finished points.
    pub finished: usize,
    /// Points that this process ran; absent if it only gathered.
    pub ran: Option<usize>,
    /// Points that failed.
    pub failed: Vec<FailedPoint>,
    /// Numbers of those that are not finished.
    pub missing: Vec<usize>,
    /// Wall time of this process, s.
    pub wall_s: f64,
    /// Time that the points kept cores busy, s.
    pub core_s: f64,
    /// Points done in an hour of one core.
    pub points_per_core_hour: Option<f64>,
    /// What to know before points are compared.
    pub notes: Vec<String>,
    /// What it was made from.
    pub manifest: Manifest,
}

/// A point that failed, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FailedPoint {
    /// Its number, from 1.
    pub point: usize,
    /// Swept keys and their values.
    pub swept: Map<String, Value>,
    /// Why.
    pub error: Option<String>,
}

impl SweepSummary {
    /// The summary of a report.
    pub fn of(report: &SweepReport<'_>, manifest: &Manifest) -> Self {
        let failed = report.failed().map(|record| FailedPoint {
            point: record.point,
            swept: record.swept.clone(),
            error: record.error.clone(),
        });
        Self {
            command: manifest.command.clone(),
            title: report.title.to_owned(),
            swept: report.keys.to_vec(),
            analyses: report.analyses.iter().map(|&name| name.to_owned()).collect(),
            points: report.count,
            finished: report.records.len(),
            ran: report.ran,
            failed: failed.collect(),
            missing: report.missing(),
            wall_s: report.wall_s,
            core_s: report.core_s,
            points_per_core_hour: report.points_per_core_hour(),
            notes: report.notes(),
            manifest: manifest.clone(),
        }
    }
}

/// The report as text: a row for each point of a small sweep, what failed, what is missing.
pub fn print(report: &SweepReport<'_>) -> String {
    let mut out = String::new();
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    if report.records.len() <= MOST_ROWS {
        write_rows(&mut out, &rows(report));
    }
    if let Some(sentence) = OperatingMatrix::of(report.records).sentence() {
        let _ = writeln!(out, "{sentence}");
    }
    for (error, points) in report.errors() {
        let _ = writeln!(out, "failed: {}: {error}", number_ranges(&points));
    }
    let missing = report.missing();
    let _ = writeln!(
        out,
        "{} of {} points finished, {} of them failed{}",
        report.records.len(),
        report.count,
        report.failed().count(),
        match missing.is_empty() {
            true => String::new(),
            false => format!("; missing: {}", number_ranges(&missing)),
        }
    );
    if let Some(rate) = report.points_per_core_hour() {
        let _ = write!(out, "{rate:.0} points per core-hour");
        // The wall time of gathering says nothing of the points.
        let _ = match report.ran {
            Some(_) => writeln!(out, ", {:.1} s", report.wall_s),
            None => writeln!(out),
        };
    }
    for note in report.notes() {
        let _ = writeln!(out, "{note}");
    }
    out
}

/// Column names, then a row for each finished point, with what a person wants first.
pub(super) fn rows(report: &SweepReport<'_>) -> Vec<Vec<String>> {
    let summaries: Vec<Vec<PointSummary>> = report
        .records
        .iter()
        .map(|record| record.summaries.values().map(PointSummary::of).collect())
        .collect();
    let number = |point: &[PointSummary], of: NumberOf| point.iter().find_map(of);
    // A column that no point has a number for is left out.
    let columns: Vec<&(&str, NumberOf)> = FIRST_COLUMNS
        .iter()
        .filter(|(_, of)| summaries.iter().any(|point| number(point, *of).is_some()))
        .collect();
    let mut table = vec![vec!["point".to_owned()]];
    // Keys of one short name are told by their whole names.
    let is_alone =
        |key: &str| report.keys.iter().filter(|other| short(other) == short(key)).count() == 1;
    let head = |key: &String| if is_alone(key) { short(key).to_owned() } else { key.clone() };
    table[0].extend(report.keys.iter().map(head));
    table[0].extend(columns.iter().map(|(key, _)| quantity(key).label()));
    let end_of = |point: &[PointSummary]| point.iter().find_map(|s| s.end_state.clone());
    let has_ends = summaries.iter().any(|point| end_of(point).is_some());
    if has_ends {
        table[0].extend(["ends in".to_owned(), "settled".to_owned()]);
    }
    for (record, point) in report.records.iter().zip(&summaries) {
        let mut row = vec![record.point.to_string()];
        row.extend(record.swept.values().map(printed));
        // The first friction of the analysis is no critical one.
        let mut crossings = point.iter().filter_map(|summary| summary.critical_frictions.first());
        let is_bound = crossings.next().is_some_and(|first| first.unstable_from_start);
        row.extend(columns.iter().map(|(key, of)| match (&record.error, number(point, *of)) {
            (Some(_), _) => "failed".to_owned(),
            (None, None) => String::new(),
            (None, Some(n)) if is_bound && *key == "critical_friction" => {
                format!("<={}", quantity(key).number(n))
            }
            (None, Some(n)) => quantity(key).number(n),
        }));
        if has_ends {
            let settled = point.iter().find_map(|summary| summary.settled);
            let settled = settled.map(|settled| if settled { "yes" } else { "no" });
            let end = end_of(point).unwrap_or_default();
            row.extend([end, settled.unwrap_or_default().to_owned()]);
        }
        table.push(row);
    }
    table
}

/// Aligned columns.
fn write_rows(out: &mut String, table: &[Vec<String>]) {
    for row in table {
        for (at, text) in row.iter().enumerate() {
            let width = table.iter().map(|row| row[at].chars().count()).max();
            let _ = write!(out, "{text:>width$}  ", width = width.unwrap_or(0));
        }
        out.truncate(out.trim_end_matches(' ').len());
        out.push('\n');
    }
}

/// Ascending numbers with runs drawn together: `1-4, 7`.
fn number_ranges(numbers: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &number in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }
    let texts: Vec<String> = runs
        .iter()
        .map(|(first, last)| match first == last {
            true => first.to_string(),
            false => format!("{first}-{last}"),
        })
        .collect();
    texts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_missing_points_are_drawn_together() {
        assert_eq!(number_ranges(&[1, 2, 3, 7, 9, 10]), "1-3, 7, 9-10");
        assert_eq!(number_ranges(&[]), "");
    }

    #[test]
    fn points_without_a_record_are_missing() {
        let record = |point| PointRecord {
            point,
            swept: Map::new(),
            error: None,
            summaries: Map::new(),
            case_hash: String::new(),
            sweep_hash: String::new(),
            version: "1".into(),
            simd: "scalar".into(),
        };
        let report = SweepReport {
            title: "",
            friction_coefficient: 0.3,
            keys: &[],
            analyses: &[],
            count: 5,
            records: &[record(2), record(3), record(5)],
            core_s: 6.0,
            ran: None,
            wall_s: 0.0,
        };
        assert_eq!(report.missing(), [1, 4]);
        assert_eq!(report.points_per_core_hour(), Some(1800.0));
    }
}
