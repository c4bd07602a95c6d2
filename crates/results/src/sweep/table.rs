//! `points.csv`, one row for each finished point, and long tables: one row for each onset, mode or limit cycle of each
//! point, named by what it is. Swept keys and their values as people read them.

use super::record::{PointRecord, listed};
use crate::cea::{SWEPT_MODES, SWEPT_ONSETS, UNSTABLE};
use crate::common::*;
use crate::cycle::{BranchRecord, FamilyRecord};

/// Lists longer than this anywhere in a sweep stay in the points' own files.
const LONGEST_LIST: usize = 16;

/// What a table over many points leaves out of a summary: what is the same for all of them, and
/// what the clock says, so that the table does not depend on who computed it and how fast; and the modes and the
/// branches of limit cycles, which are tables of their own.
const LEFT_OUT: [&str; 10] = [
    "runs",
    "command",
    "curves",
    "modes_at_friction",
    "unstable_modes",
    "title",
    "manifest",
    "notes",
    "wall_s",
    "element_steps_per_s",
];

/// The table: swept keys, the scalars of the summaries, `point` and `error`.
///
/// A scalar inside an object or a list has a dotted name, `status.stick`, `harmonics.0`; an item of a list that is a
/// mode goes by the mode and not by its rank, so that a column has one mode in all rows:
/// `critical_frictions.n1_b1_against.critical_friction`, `cycles.n2.main_frequency_hz`.
/// With more than one analysis to a point the name begins with the analysis. The bytes depend on
/// the points alone, not on the order or the number of processes and threads that made them.
///
/// Does not sort: `records` come in the order of the points.
pub(super) fn points(keys: &[String], records: &[PointRecord]) -> Table {
    let mut longest = BTreeMap::new();
    let rows: Vec<Vec<(String, Cell)>> =
        records.iter().map(|record| scalars(record, &mut longest)).collect();
    let mut columns = Vec::new();
    rows.iter().for_each(|row| add_columns(&mut columns, row));
    let too_long = longest.into_iter().filter(|&(_, length)| length > LONGEST_LIST);
    let too_long: Vec<String> = too_long.map(|(path, _)| format!("{path}.")).collect();
    let is_kept = |name: &String| !too_long.iter().any(|list| name.starts_with(list.as_str()));
    let names: Vec<String> = columns.into_iter().filter(is_kept).collect();

    let rows: Vec<BTreeMap<String, Cell>> =
        rows.into_iter().map(|row| row.into_iter().collect()).collect();
    let table = names.iter().fold(swept("points.csv", keys, records.iter()), |table, name| {
        table.column(name, None, rows.iter().map(|row| row.get(name).cloned()))
    });
    table.column("point", None, records.iter().map(|record| record.point)).column(
        "error",
        None,
        records.iter().map(|record| record.error.as_ref()),
    )
}

/// A table of points that begins with a column for each swept key.
pub(super) fn swept<'a>(
    file: &str,
    keys: &[String],
    points: impl Iterator<Item = &'a PointRecord> + Clone,
) -> Table {
    keys.iter().fold(Table::new(file, ""), |table, key| {
        table.column(key, None, points.clone().map(|own| own.swept.get(key).map(cell)))
    })
}

/// Names and cells of a record's scalars in the order of its summaries.
fn scalars(record: &PointRecord, longest: &mut BTreeMap<String, usize>) -> Vec<(String, Cell)> {
    let mut out = Vec::new();
    for (analysis, summary) in &record.summaries {
        let prefix = if record.summaries.len() == 1 { "" } else { analysis.as_str() };
        let Value::Object(entries) = summary else { continue };
        for (key, value) in entries {
            if !LEFT_OUT.contains(&key.as_str()) {
                flatten(&join(prefix, key), value, &mut out, longest);
            }
        }
    }
    out
}

fn flatten(
    path: &str,
    value: &Value,
    out: &mut Vec<(String, Cell)>,
    longest: &mut BTreeMap<String, usize>,
) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries.iter().filter(|(key, _)| *key != "wall_s") {
                flatten(&join(path, key), value, out, longest);
            }
        }
        Value::Array(items) => {
            let length = longest.entry(path.to_owned()).or_default();
            *length = items.len().max(*length);
            if items.len() <= LONGEST_LIST {
                let mut names: Vec<String> = Vec::new();
                for (index, item) in items.iter().enumerate() {
                    let name = item_name(item).unwrap_or_else(|| index.to_string());
                    let earlier = names.iter().filter(|known| **known == name).count();
                    let again = match earlier {
                        0 => name.clone(),
                        _ => format!("{name}_again{earlier}"),
                    };
                    flatten(&join(path, &again), item, out, longest);
                    names.push(name);
                }
            }
        }
        scalar => out.push((path.to_owned(), cell(scalar))),
    }
}

/// Name of a list's item: of a mode harmonic, branch (or onset) and direction, of what is known at one friction
/// coefficient that.
fn item_name(item: &Value) -> Option<String> {
    let number = |key: &str| item.get(key).and_then(Value::as_i64);
    if let (None, Some(friction)) = (number("harmonic"), item.get("friction_coefficient")) {
        return Some(format!("mu{friction}"));
    }
    let mut name = format!("n{}", number("harmonic")?);
    for (key, letter) in [("branch", 'b'), ("onset", 'o')] {
        if let Some(rank) = number(key) {
            name += &format!("_{letter}{rank}");
        }
    }
    // What else has a direction, has it as a result.
    if number("branch").is_some() {
        name += match number("direction") {
            Some(1) => "_with",
            Some(-1) => "_against",
            _ => "",
        };
    }
    Some(name)
}

/// A dotted path.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// A value as a table cell: text without quotes, lists as JSON.
pub(crate) fn cell(value: &Value) -> Cell {
    match value {
        Value::Null => Cell::None,
        Value::Bool(flag) => Cell::Flag(*flag),
        Value::String(text) => text.into(),
        Value::Number(number) if number.is_f64() => number.as_f64().into(),
        Value::Number(number) => {
            number.as_i64().map_or_else(|| Cell::Text(number.to_string()), Cell::Count)
        }
        Value::Array(_) | Value::Object(_) => Cell::Text(value.to_string()),
    }
}

/// Adds the names of a row that are new to those of columns, each behind the one before it in that row.
fn add_columns(columns: &mut Vec<String>, row: &[(String, Cell)]) {
    let mut at = 0;
    for (name, _) in row {
        if columns.get(at) != Some(name) {
            match columns.iter().position(|known| known == name) {
                Some(known) => at = known,
                None => columns.insert(at, name.clone()),
            }
        }
        at += 1;
    }
}

/// A cycle of a branch: its family, and its place along the branch.
type BranchPoint = (FamilyRecord, usize);

/// A quantity of the branch at a point.
fn at<T: Copy>((family, place): &BranchPoint, of: impl Fn(&BranchRecord) -> &Vec<T>) -> Option<T> {
    of(family.branch.as_ref()?).get(*place).copied()
}

columns! {
    /// A limit cycle along a branch.
    pub(crate) BRANCHES: own as BranchPoint;
    mode: "mode that leads to it, of a body without rotating waves" = own.0.mode;
    harmonic: "nodal diameters of a wave" = own.0.mode.is_none().then_some(own.0.harmonic);
    onset: "onset at which the wave is born, from 1" = own.0.mode.is_none().then_some(own.0.onset);
    key: "key of the parameter" = own.0.branch.as_ref().map(|branch| branch.key.clone());
    value: "its value" = at(own, |branch| &branch.values);
    main_frequency_hz: "frequency" = at(own, |branch| &branch.frequency_hz);
    amplitude_m: "amplitude along the counterface" = at(own, |branch| &branch.amplitude);
    stick: "fraction of the contact that sticks" = at(own, |branch| &branch.status[0]);
    slip: "fraction that slips" = at(own, |branch| &branch.status[1]);
    open: "fraction that is open" = at(own, |branch| &branch.status[2]);
    stable: "whether it is stable, where that is known" = at(own, |branch| &branch.stable).flatten();
    growth_rate_per_s: "growth rate of its leading perturbation, where it is known"
        = at(own, |branch| &branch.growth_rate).flatten();
}

/// The tables of a sweep with these analyses: its points, and the long tables, in which failed points have no rows.
pub fn tables(
    keys: &[String],
    analyses: &[impl AsRef<str>],
    records: &[PointRecord],
) -> Vec<Table> {
    let has = |name: &str| analyses.iter().any(|own| own.as_ref() == name);
    let mut tables = vec![points(keys, records)];
    if has("cea") {
        let of = ("stability.csv", "cea", "critical_frictions");
        tables.push(long(of, keys, records, SWEPT_ONSETS, |own| vec![own]));
        let of = ("unstable_modes.csv", "cea", "unstable_modes");
        tables.push(long(of, keys, records, UNSTABLE, |own| vec![own]));
        let of = ("modes.csv", "cea", "modes_at_friction");
        tables.push(long(of, keys, records, SWEPT_MODES, |own| vec![own]));
    }
    if has("cycle") {
        let cycles = |family: FamilyRecord| -> Vec<BranchPoint> {
            let count = family.branch.as_ref().map_or(0, |branch| branch.values.len());
            (0..count).map(|place| (family.clone(), place)).collect()
        };
        let of = ("branches.csv", "cycle", "curves");
        tables.push(long(of, keys, records, BRANCHES, cycles));
    }
    tables
}

/// The swept keys, the columns and the number of the point, with the rows of each entry of a list of an analysis; an
/// entry of another version has none.
fn long<S: DeserializeOwned, T>(
    (file, analysis, list): (&str, &str, &str),
    keys: &[String],
    records: &[PointRecord],
    columns: &[Column<T>],
    rows_of: impl Fn(S) -> Vec<T>,
) -> Table {
    let mut rows: Vec<(&PointRecord, T)> = Vec::new();
    for record in records {
        let found = record.summaries.get(analysis).and_then(|summary| summary.get(list));
        let own = listed(found).into_iter().flat_map(&rows_of);
        rows.extend(own.map(|row| (record, row)));
    }
    let table = swept(file, keys, rows.iter().map(|row| row.0));
    let table = table.columns(columns, rows.iter().map(|row| &row.1));
    table.column("point", None, rows.iter().map(|row| row.0.point))
}

/// Keys over which figures are drawn first.
pub(crate) const SPEED: &str = "contact.rotation_speed_rpm";
pub(crate) const FRICTION: &str = "contact.friction_coefficient";

/// The swept key and value that a point has as the own friction coefficient of its eigenvalue analysis.
pub(super) fn swept_friction(record: &PointRecord) -> Option<(&String, f64)> {
    let own = record.summaries.get("cea")?.pointer("/base_state/friction_coefficient")?.as_f64()?;
    let is_own = |key: &str, value: &Value| {
        key.ends_with(".friction_coefficient") && value.as_f64() == Some(own)
    };
    record.swept.iter().find(|(key, value)| is_own(key, value)).map(|(key, _)| (key, own))
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

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Map, json};

    /// A point of a sweep over the inner radius.
    fn of(point: usize, analysis: &str, summary: Value) -> PointRecord {
        PointRecord {
            point,
            swept: Map::from_iter([("geometry.inner_radius".to_owned(), json!(0.3))]),
            summaries: Map::from_iter([(analysis.to_owned(), summary)]),
            ..PointRecord::default()
        }
    }

    fn record(point: usize, summary: Value) -> PointRecord {
        of(point, "transient", summary)
    }

    /// One of the tables of a sweep.
    fn written(file: &str, records: &[PointRecord]) -> String {
        let keys = ["geometry.inner_radius".to_owned()];
        let mut tables = tables(&keys, &["cea", "cycle"], records);
        tables.push(points(&keys, records));
        let mut out = Vec::new();
        tables.iter().find(|table| table.file == file).unwrap().write_csv(&mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    fn table(records: &[PointRecord]) -> String {
        written("points.csv", records)
    }

    #[test]
    fn nested_scalars_have_dotted_names_and_the_clock_is_left_out() {
        let summary = json!({
            "steps": 10, "wall_s": 3.0, "status": { "stick": 0.25 },
            "growth": [{ "rate_per_s": 1e-7, "harmonic": 2 }], "notes": ["slow"]
        });
        assert_eq!(
            table(&[record(1, summary)]),
            "geometry.inner_radius,steps,status.stick,growth.n2.rate_per_s,growth.n2.harmonic,\
             point,error\n0.3,10,0.25,1e-7,2,1,\n"
        );
    }

    #[test]
    fn a_column_has_one_mode_in_all_rows_whatever_its_rank() {
        let onset = |branch: usize, mu: f64| {
            let mut own = json!({ "harmonic": 1, "branch": branch, "direction": -1 });
            own["critical_friction"] = json!(mu);
            own
        };
        let both = record(1, json!({ "onsets": [onset(1, 0.1), onset(0, 0.2)] }));
        let one = record(2, json!({ "onsets": [onset(0, 0.15)] }));
        let text = table(&[both, one]);
        let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
        let column = |name: &str| {
            let at = rows[0].iter().position(|known| *known == name).unwrap();
            [rows[1][at], rows[2][at]]
        };
        assert_eq!(column("onsets.n1_b0_against.critical_friction"), ["0.2", "0.15"]);
        assert_eq!(column("onsets.n1_b1_against.critical_friction"), ["0.1", ""]);
    }

    #[test]
    fn what_is_known_at_one_friction_coefficient_is_named_by_it() {
        let count = |friction: f64| json!({ "friction_coefficient": friction, "unstable": 1 });
        let text = table(&[record(1, json!({ "counts": [count(0.0), count(0.25)] }))]);
        assert!(
            text.contains("counts.mu0.0.unstable") && text.contains("counts.mu0.25.unstable"),
            "{text}"
        );
    }

    #[test]
    fn rows_with_other_scalars_share_columns_in_their_own_order() {
        let short = record(1, json!({ "a": 1, "list": [1], "z": 2 }));
        let long = record(2, json!({ "a": 1, "list": [1, 2], "z": null }));
        assert_eq!(
            table(&[short, long]),
            "geometry.inner_radius,a,list.0,list.1,z,point,error\n\
             0.3,1,1,,2,1,\n0.3,1,1,2,,2,\n"
        );
    }

    #[test]
    fn a_list_that_is_long_at_one_point_is_in_no_row() {
        let short = record(1, json!({ "list": [1], "z": 2 }));
        let long = record(2, json!({ "list": vec![0; 17], "z": 2 }));
        assert_eq!(
            table(&[short, long]),
            "geometry.inner_radius,z,point,error\n0.3,2,1,\n0.3,2,2,\n"
        );
    }

    #[test]
    fn each_onset_of_each_point_is_a_row_named_by_its_branch() {
        let onset = |n: u32, branch: u32, mu: f64| {
            json!({ "harmonic": n, "branch": branch, "direction": -1, "critical_friction": mu,
                    "frequency_hz": 1e4, "restabilized_friction": null, "unstable_from_start": false })
        };
        let first = json!({ "critical_frictions": [onset(1, 1, 0.12), onset(2, 0, 0.14)] });
        let second = json!({ "critical_frictions": [onset(2, 0, 0.11)] });
        let swept = Map::from_iter([("geometry.inner_radius".to_owned(), json!(0.4))]);
        let records = [of(1, "cea", first), PointRecord { swept, ..of(2, "cea", second) }];
        assert_eq!(
            written("stability.csv", &records),
            "geometry.inner_radius,harmonic,branch,direction,critical_friction,frequency_hz,\
             restabilized_friction,restabilized_frequency_hz,unstable_from_start,lost_after,point\n\
             0.3,1,1,-1,0.12,10000.0,,,false,,1\n0.3,2,0,-1,0.14,10000.0,,,false,,1\n\
             0.4,2,0,-1,0.11,10000.0,,,false,,2\n"
        );
    }

    #[test]
    fn each_limit_cycle_of_a_branch_is_a_row() {
        let branch = BranchRecord {
            key: "contact.rotation_speed_rpm".into(),
            values: vec![10.0, 20.0],
            frequency_hz: vec![9e3, 8e3],
            amplitude: vec![1e-6, 2e-6],
            status: [vec![0.5, 0.4], vec![0.5, 0.4], vec![0.0, 0.2]],
            stable: vec![Some(true), None],
            growth_rate: vec![Some(-3.5), None],
            ..BranchRecord::default()
        };
        let family = |harmonic, onset, mode| {
            let branch = Some(branch.clone());
            FamilyRecord { harmonic, onset, mode, branch, ..FamilyRecord::default() }
        };
        let summary = json!({ "curves": [family(2, 1, None), family(0, 0, Some(4))] });
        let text = written("branches.csv", &[of(1, "cycle", summary)]);
        let rows: Vec<&str> = text.lines().skip(1).collect();
        let key = "contact.rotation_speed_rpm";
        assert_eq!(
            rows,
            [
                format!("0.3,,2,1,{key},10.0,9000.0,1e-6,0.5,0.5,0.0,true,-3.5,1"),
                format!("0.3,,2,1,{key},20.0,8000.0,2e-6,0.4,0.4,0.2,,,1"),
                format!("0.3,4,,,{key},10.0,9000.0,1e-6,0.5,0.5,0.0,true,-3.5,1"),
                format!("0.3,4,,,{key},20.0,8000.0,2e-6,0.4,0.4,0.2,,,1"),
            ]
        );
    }
}
