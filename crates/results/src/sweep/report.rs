//! Summary and document of a sweep, and the operating matrix of a study of eigenvalue analyses: which modes grow under
//! which conditions.

use super::record::{PointRecord, listed};
use super::table::{cell, heads, of_points, swept_friction, swept_text, tables};
use crate::cea::{UNSTABLE, UnstableCount, UnstableMode};
use crate::common::*;
use crate::number_ranges;

/// What the first summary of a point says that has it; nothing of a point that failed.
fn first(point: &PointRecord, path: &str) -> Cell {
    let mut said = point.summaries.values().filter_map(|summary| summary.pointer(path));
    said.find(|value| !value.is_null()).map_or(Cell::None, cell)
}

/// The lowest critical friction; the first friction of the analysis is only a bound of it, as is one where its branch
/// was lost.
fn critical(point: &PointRecord) -> Cell {
    let said = |key: &str| first(point, &format!("/critical_frictions/0/{key}"));
    let is_from_start = matches!(said("unstable_from_start"), Cell::Flag(true));
    match (said("critical_friction"), said("lost_after")) {
        (lowest, Cell::None) if !is_from_start => lowest,
        (lowest, _) => Cell::Text(format!("<={}", lowest.text(Format::Fixed(6)))),
    }
}

columns! {
    /// What a person wants first of a point.
    FIRST: point as PointRecord;
    main_frequency_hz = first(point, "/main_frequency_hz"), IfAny "main frequency" Fixed(2);
    harmonic = first(point, "/main_harmonic"), IfAny "n" Count;
    stick = first(point, "/status/stick"), IfAny "stick" Fixed(3);
    slip = first(point, "/status/slip"), IfAny "slip" Fixed(3);
    open = first(point, "/status/open"), IfAny "open" Fixed(3);
    critical_friction = critical(point), IfAny "critical friction" Fixed(6);
    critical_harmonic = first(point, "/critical_frictions/0/harmonic"), IfAny "n" Count;
    first_harmonic = first(point, "/cycles/0/harmonic"), IfAny "n" Count;
    first_hz = first(point, "/cycles/0/main_frequency_hz"), IfAny "main frequency" Fixed(2);
    first_stick = first(point, "/cycles/0/status/stick"), IfAny "stick" Fixed(3);
    first_open = first(point, "/cycles/0/status/open"), IfAny "open" Fixed(3);
    second_harmonic = first(point, "/cycles/1/harmonic"), IfAny "n" Count;
    second_hz = first(point, "/cycles/1/main_frequency_hz"), IfAny "main frequency" Fixed(2);
    second_stick = first(point, "/cycles/1/status/stick"), IfAny "stick" Fixed(3);
    second_open = first(point, "/cycles/1/status/open"), IfAny "open" Fixed(3);
    winner = first(point, "/winner"), IfAny "n that always wins" Count;
    low = first(point, "/boundary/low"), IfAny "ratio below" Fixed(3);
    high = first(point, "/boundary/high"), IfAny "ratio above" Fixed(3);

    /// How a point ends.
    ENDS: point as PointRecord;
    end = first(point, "/end_state"), IfAny "ends in" Plain;
    settled = first(point, "/settled"), IfAny "settled" Plain;
}

/// Names of the ends of a transient that are no limit cycle although it vibrates.
pub(crate) const TWO_FREQUENCY: &str = "two-frequency";
pub(crate) const UNSETTLED: &str = "unsettled";

/// Longest table that is printed.
const MOST_ROWS: usize = 200;

keys! {
    /// `summary.json` of `frictionsim sweep`.
    SweepSummary {
        swept: Vec<String> = "swept keys";
        analyses: Vec<String> = "analyses at each point";
        points: usize = "points of the whole sweep";
        finished: usize = "finished points";
        ran: Option<usize> = "points that this process ran; absent if it only gathered";
        failed: Vec<FailedPoint> = "points that failed";
        missing: Vec<usize> = "numbers of those that are not finished";
        core_s: f64 = "time that the points kept cores busy, s";
        points_per_core_hour: Option<f64> = "points done in an hour of one core";
        notes: Vec<String> = "what to know before points are compared";
        #[serde(skip)]
        records: Vec<PointRecord> = "finished points in their order";
    }

    /// A point that failed, and why.
    FailedPoint {
        point: usize = "its number, from 1";
        swept: Map<String, Value> = "swept keys and their values";
        error: Option<String> = "why";
    }
}

impl SweepSummary {
    /// What finished points of `count` come to, in their order, which kept cores busy for `core_s`, s. Who runs points
    /// adds how many.
    pub fn of(
        swept: Vec<String>,
        analyses: Vec<String>,
        count: usize,
        records: Vec<PointRecord>,
        core_s: f64,
    ) -> Self {
        let failed = records.iter().filter(|record| record.error.is_some());
        let failed = failed.map(|record| FailedPoint {
            point: record.point,
            swept: record.swept.clone(),
            error: record.error.clone(),
        });
        let failed: Vec<FailedPoint> = failed.collect();
        let mut finished = records.iter().map(|record| record.point).peekable();
        let missing = (1..=count).filter(|point| finished.next_if_eq(point).is_none()).collect();
        // Failed points cost time but do not count.
        let done = records.len() - failed.len();
        let rate = (done > 0 && core_s > 0.0).then(|| done as f64 * 3600.0 / core_s);
        Self {
            swept,
            analyses,
            points: count,
            finished: records.len(),
            ran: None,
            failed,
            missing,
            core_s,
            points_per_core_hour: rate,
            notes: notes(&records),
            records,
        }
    }

    /// Errors in the order of their first points, each with the numbers of all points that have it.
    fn errors(&self) -> Vec<(&str, Vec<usize>)> {
        let failed = self.failed.iter();
        grouped(failed.map(|own| (own.error.as_deref().unwrap_or_default(), own.point)))
    }
}

/// What to know before points are compared: they were not all made alike.
fn notes(records: &[PointRecord]) -> Vec<String> {
    let maker = |own: &PointRecord| format!("version {}, SIMD {}", own.version, own.simd);
    let makers: BTreeSet<String> = records.iter().map(maker).collect();
    let mut notes = Vec::new();
    if makers.len() > 1 {
        notes.push(format!(
            "the points were not all made alike, so their last digits may differ: {}",
            Vec::from_iter(makers).join("; ")
        ));
    }
    let two = "their numbers are of no limit cycle";
    let unsettled = "these are not limit cycles; raise transient.duration";
    for (end, how, so) in [
        (TWO_FREQUENCY, "in a vibration of two frequencies", two),
        (UNSETTLED, "before it has settled", unsettled),
    ] {
        let ends_so = |summary: &Value| summary["end_state"].as_str() == Some(end);
        let points = records.iter().filter(|own| own.summaries.values().any(ends_so));
        let points: Vec<usize> = points.map(|own| own.point).collect();
        if !points.is_empty() {
            notes.push(format!(
                "the transient ends {how} at {} of {} points ({}): {so}",
                points.len(),
                records.len(),
                number_ranges(&points)
            ));
        }
    }
    notes
}

/// Tables and sentences of a sweep: what failed, what is missing, what a person wants first of every point; a page has
/// the tables that are files, too.
pub fn document(summary: &SweepSummary, is_page: bool) -> Document {
    let records = &summary.records;
    let conditions = conditions(records);
    let errors = summary.errors();
    let errors =
        errors.iter().map(|(error, points)| format!("failed: {}: {error}", number_ranges(points)));
    let missing = &summary.missing;
    let missing = (!missing.is_empty()).then(|| format!("missing: {}", number_ranges(missing)));
    // Pages of the same points are the same bytes.
    let rate = summary.points_per_core_hour.filter(|_| !is_page);
    let rate = rate.map(|rate| ("points per core-hour", format!("{rate:.0}")));
    let results = Section::new("Results")
        .text([format!("{} at each point.", summary.analyses.join(" and "))])
        .text(squeal_sentence(&conditions))
        .text(errors)
        .text(missing)
        .facts(ranges(summary))
        .facts(rate);
    let modes = Some(modes_table(&conditions, &summary.swept)).filter(|_| is_page);
    let points = Some(points_table(summary)).filter(|_| is_page || records.len() <= MOST_ROWS);
    let document = Document::new("Study")
        .section(results)
        .section(Section::new("Study").figures([""]))
        .section(Section::new("Points").tables(modes).tables(points))
        .notes(&summary.notes);
    let files = is_page.then(|| tables(&summary.swept, &summary.analyses, records));
    files.into_iter().flatten().fold(document, Document::file)
}

/// How far the study is, and the range of every quantity that a person wants first.
fn ranges(summary: &SweepSummary) -> Vec<(String, String)> {
    let records = &summary.records;
    let finished = format!("{} of {}", records.len(), summary.points);
    let failed = summary.failed.len().to_string();
    let mut out = vec![("points".to_owned(), finished), ("failed".to_owned(), failed)];
    let mut add = |head: String, numbers: Vec<f64>| {
        if let (false, (low, high)) = (numbers.is_empty(), extremes(numbers.iter().copied())) {
            let [low, high] = [low, high].map(|value| significant(value, 6));
            out.push((head, if low == high { low } else { format!("{low} to {high}") }));
        }
    };
    for (key, head) in heads(&summary.swept.iter().collect::<Vec<_>>()) {
        let values = records.iter().filter_map(|record| record.swept.get(key)?.as_f64());
        add(head.to_owned(), values.collect());
    }
    for column in FIRST {
        let values = records.iter().filter_map(|record| (column.cell)(record).number());
        add(column.heading(), values.collect());
    }
    out
}

/// What a person wants first of every point; `points.csv` has all.
fn points_table(summary: &SweepSummary) -> Table {
    let records = &summary.records;
    let points = records.iter().map(|record| (record.point, &record.swept));
    let table = of_points("Finished points (every quantity: points.csv)", &summary.swept, points);
    table.columns(FIRST, records).columns(ENDS, records).shown_column(
        "outcome",
        records.iter().map(|record| record.error.as_ref().map(|_| "failed")),
    )
}

/// Longest list of unstable modes in a report; `unstable_modes.csv` has all.
const MOST_MODES: usize = 400;

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

/// The conditions of the points that have an eigenvalue analysis, in their order, friction rising within each; a point
/// of swept friction is one.
pub(super) fn conditions<'a>(records: &'a [PointRecord]) -> Vec<Condition<'a>> {
    let of_point = |(record, summary): (&'a PointRecord, &Value)| {
        let modes = listed::<UnstableMode>(summary.get("unstable_modes"));
        let counts = listed::<UnstableCount>(summary.get("unstable_counts")).into_iter();
        let swept = swept_friction(record);
        let is_asked = move |mu: f64| swept.is_none_or(|own| own.1 == mu);
        let counts = counts.filter(move |own| is_asked(own.friction_coefficient));
        counts.map(move |UnstableCount { friction_coefficient, .. }| {
            let own = modes.iter().filter(|m| m.friction_coefficient == friction_coefficient);
            let (unstable, swept) = (own.copied().collect(), &record.swept);
            Condition { point: record.point, swept, friction_coefficient, unstable }
        })
    };
    let solved = records.iter().filter_map(|own| Some((own, own.summaries.get("cea")?)));
    solved.flat_map(of_point).collect()
}

/// Every unstable mode with its condition.
pub(super) fn unstable<'a>(
    conditions: &'a [Condition<'_>],
) -> impl Iterator<Item = (&'a Condition<'a>, &'a UnstableMode)> {
    conditions.iter().flat_map(|own| own.unstable.iter().map(move |mode| (own, mode)))
}

/// How many conditions squeal, and the one whose mode grows fastest; nothing without a condition.
fn squeal_sentence(conditions: &[Condition<'_>]) -> Option<String> {
    let squealing = conditions.iter().filter(|c| !c.unstable.is_empty()).count();
    let points: BTreeSet<usize> = conditions.iter().map(|c| c.point).collect();
    let mut text = format!(
        "{squealing} of {} operating conditions ({} points) have unstable modes",
        conditions.len(),
        points.len(),
    );
    let rate = |own: &(&Condition<'_>, &UnstableMode)| own.1.growth_rate_per_s;
    let fastest = unstable(conditions).max_by(|a, b| rate(a).total_cmp(&rate(b)));
    if let Some((condition, mode)) = fastest {
        let Condition { point, friction_coefficient: friction, swept, .. } = condition;
        let [hz, rate] = [mode.frequency_hz, mode.growth_rate_per_s].map(|own| fixed(own, 1));
        text += &format!(
            "; the fastest, {hz} Hz, grows by {rate} 1/s at friction {friction} of the eigenvalue analysis, point \
             {point} ({})",
            swept_text(swept),
        );
    }
    (!conditions.is_empty()).then_some(text)
}

/// The unstable modes as a table.
fn modes_table(conditions: &[Condition<'_>], keys: &[String]) -> Table {
    let all = unstable(conditions).count();
    let caption = match all > MOST_MODES {
        true => format!("The first {MOST_MODES} of {all} unstable modes (all: unstable_modes.csv)"),
        false => "Unstable modes under every operating condition (unstable_modes.csv)".to_owned(),
    };
    let shown: Vec<_> = unstable(conditions).take(MOST_MODES).collect();
    let points = shown.iter().map(|own| (own.0.point, own.0.swept));
    of_points(caption, keys, points).columns(UNSTABLE, shown.iter().map(|own| own.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn runs_of_missing_points_are_drawn_together() {
        assert_eq!(number_ranges(&[1, 2, 3, 7, 9, 10]), "1-3, 7, 9-10");
        assert_eq!(number_ranges(&[]), "");
    }

    #[test]
    fn points_without_a_record_are_missing() {
        let record = |point| PointRecord { point, ..PointRecord::default() };
        let records = vec![record(2), record(3), record(5)];
        let summary = SweepSummary::of(Vec::new(), Vec::new(), 5, records, 6.0);
        assert_eq!(summary.missing, [1, 4]);
        assert_eq!(summary.points_per_core_hour, Some(1800.0));
    }

    #[test]
    fn a_point_of_swept_friction_is_a_condition_at_its_own() {
        let count = |mu: f64| json!({ "friction_coefficient": mu, "modes": 2, "unstable": 0 });
        let counts = [0.0, 0.2, 0.3].map(count);
        let cea = json!({ "unstable_counts": counts,
                          "base_state": { "friction_coefficient": 0.2 } });
        for (key, frictions) in [
            ("contact.speed", vec![0.0, 0.2, 0.3]),
            ("contact.friction_coefficient", vec![0.2]),
            ("contacts.a.friction_coefficient", vec![0.2]),
        ] {
            let record = PointRecord {
                swept: Map::from_iter([(key.to_owned(), json!(0.2))]),
                summaries: Map::from_iter([("cea".to_owned(), cea.clone())]),
                ..PointRecord::default()
            };
            let records = [record];
            let found: Vec<f64> =
                conditions(&records).iter().map(|own| own.friction_coefficient).collect();
            assert_eq!(found, frictions, "{key}");
        }
    }
}
