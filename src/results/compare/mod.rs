//! Runs side by side: every number that they share, and their figures over each other.

mod figures;

pub use figures::overlaid;

use super::quantity::{quantity, significant};
use super::report::{NamedFigure, Report, ReportSection, ReportTable};
use super::table::{Table, format_number};
use super::{FolderError, Manifest, OutputFolder};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A finished run.
#[derive(Clone, Debug)]
pub struct ComparedRun {
    /// What it is called.
    pub name: String,
    /// What it was made from.
    pub manifest: Manifest,
    /// Its `summary.json`.
    pub summary: Value,
    /// Its `report.html`, where it has one.
    pub page: Option<String>,
}

/// A number that every run has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SharedQuantity {
    /// Dotted path in the summaries; entries of lists are named by what they are of.
    pub path: String,
    /// Its value in each run.
    pub values: Vec<f64>,
}

/// `summary.json` of `frictionsim compare`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonSummary {
    /// `compare`.
    pub command: String,
    /// The runs.
    pub runs: Vec<String>,
    /// Numbers that all of them have.
    pub quantities: Vec<SharedQuantity>,
    /// What it was made from.
    pub manifest: Manifest,
}

/// Keys that say what an entry of a list is of.
const NAMES: [&str; 7] =
    ["friction_coefficient", "harmonic", "branch", "direction", "onset", "key", "name"];

/// Numbers that tell runs apart but decide nothing.
const COSTS: [&str; 4] = ["wall_s", "core_s", "element_steps_per_s", "points_per_core_hour"];

/// What a person asks of two runs first.
const FIRST: [&str; 11] = [
    "critical_friction",
    "main_frequency_hz",
    "main_harmonic",
    "status.stick",
    "status.slip",
    "status.open",
    "power_w.external",
    "power_w.contact_dissipated",
    "power_w.material_damping",
    "mass_coefficient.value",
    "stiffness_coefficient.value",
];

/// Most entries of a list among them.
const MOST_OF_A_KIND: usize = 8;

/// All numbers of a summary by their paths.
fn numbers_of(summary: &Value) -> Vec<(String, f64)> {
    fn visit(path: &str, value: &Value, out: &mut Vec<(String, f64)>) {
        let below = |key: &str| match path {
            "" => key.to_owned(),
            _ => format!("{path}.{key}"),
        };
        match value {
            Value::Number(number) => out.extend(number.as_f64().map(|n| (path.to_owned(), n))),
            Value::Bool(is_true) => out.push((path.to_owned(), f64::from(u8::from(*is_true)))),
            Value::Object(entries) => {
                let entries = entries.iter().filter(|(key, _)| *key != "manifest");
                entries.for_each(|(key, value)| visit(&below(key), value, out));
            }
            Value::Array(entries) => {
                for (index, entry) in entries.iter().enumerate() {
                    let names = NAMES.iter().filter_map(|name| {
                        let value = entry.get(name).filter(|v| v.is_number() || v.is_string())?;
                        Some(format!("{name}={}", value.to_string().trim_matches('"')))
                    });
                    let names: Vec<String> = names.collect();
                    let key = match names.is_empty() {
                        true => index.to_string(),
                        false => format!("[{}]", names.join(" ")),
                    };
                    visit(&below(&key), entry, out);
                }
            }
            Value::Null | Value::String(_) => {}
        }
    }
    let mut out = Vec::new();
    visit("", summary, &mut out);
    out
}

/// The numbers that all runs have, in the order of the first.
pub fn shared(runs: &[ComparedRun]) -> Vec<SharedQuantity> {
    let numbers: Vec<Vec<(String, f64)>> =
        runs.iter().map(|run| numbers_of(&run.summary)).collect();
    let of =
        |path: &str, run: &[(String, f64)]| run.iter().find(|own| own.0 == path).map(|own| own.1);
    let Some(first) = numbers.first() else {
        return Vec::new();
    };
    let mut out: Vec<SharedQuantity> = Vec::new();
    for (path, _) in first {
        let values: Option<Vec<f64>> = numbers.iter().map(|run| of(path, run)).collect();
        if let Some(values) = values.filter(|_| out.iter().all(|known| known.path != *path)) {
            out.push(SharedQuantity { path: path.clone(), values });
        }
    }
    out
}

impl SharedQuantity {
    /// Difference of each other run from the first.
    fn differences(&self) -> impl Iterator<Item = f64> + '_ {
        self.values[1..].iter().map(|value| value - self.values[0])
    }

    fn is_equal(&self) -> bool {
        self.differences().all(|difference| difference == 0.0)
    }

    /// Difference of each other run from the first, relative to the first.
    fn relative(&self) -> impl Iterator<Item = Option<f64>> + '_ {
        let first = self.values[0];
        let relative = move |difference: f64| (first != 0.0).then(|| difference / first.abs());
        self.differences().map(relative)
    }

    fn last_key(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or(&self.path)
    }
}

/// Writes `compare.csv`: path, unit, the value of each run, then differences from the first, absolute and relative.
///
/// # Errors
/// Those of the folder.
pub fn write_comparison(
    folder: &OutputFolder,
    runs: &[ComparedRun],
    quantities: &[SharedQuantity],
) -> Result<(), FolderError> {
    let others = || runs[1..].iter().map(|run| run.name.as_str());
    let columns = ["quantity", "unit"].map(String::from).into_iter();
    let columns: Vec<String> = columns
        .chain(runs.iter().map(|run| run.name.clone()))
        .chain(others().map(|name| format!("difference {name}")))
        .chain(others().map(|name| format!("relative difference {name}")))
        .collect();
    let names: Vec<&str> = columns.iter().map(String::as_str).collect();
    folder.write("compare.csv", |out| {
        let mut table = Table::new(out, &names)?;
        for shared in quantities {
            let texts = [shared.path.clone(), quantity(&shared.path).unit.to_owned()];
            let numbers = shared.values.iter().copied().chain(shared.differences());
            let relative = shared.relative().map(|v| v.map_or_else(String::new, format_number));
            table.row(texts.into_iter().chain(numbers.map(format_number)).chain(relative))?;
        }
        table.finish()
    })?;
    Ok(())
}

/// The rows of the table for people: quantity, values, difference from the first in per cent where there is one.
fn table_of(runs: &[ComparedRun], caption: String, quantities: &[&SharedQuantity]) -> ReportTable {
    let mut columns = vec!["quantity".to_owned(), "unit".to_owned()];
    columns.extend(runs.iter().map(|run| run.name.clone()));
    columns.extend(runs[1..].iter().map(|run| format!("{} less {}", run.name, runs[0].name)));
    columns.extend(runs[1..].iter().map(|run| format!("{} off by (%)", run.name)));
    let rows = quantities.iter().map(|shared| {
        let mut row = vec![shared.path.clone(), quantity(&shared.path).unit.to_owned()];
        row.extend(shared.values.iter().map(|&value| significant(value, 7)));
        row.extend(shared.differences().map(|value| significant(value, 4)));
        let relative = shared.relative().map(|value| value.map(|v| significant(100.0 * v, 4)));
        row.extend(relative.map(Option::unwrap_or_default));
        row
    });
    ReportTable::new(caption, columns, rows)
}

/// Most lines of the table for the terminal.
const MOST_PRINTED: usize = 30;

/// The numbers that differ, but for costs: what a person asks first, then the others, the largest relative difference first.
fn differing(quantities: &[SharedQuantity]) -> Vec<&SharedQuantity> {
    let is_cost = |shared: &SharedQuantity| COSTS.contains(&shared.last_key());
    let differs = |shared: &&SharedQuantity| !shared.is_equal() && !is_cost(shared);
    let mut found: Vec<&SharedQuantity> =
        first_of(quantities).into_iter().filter(differs).collect();
    let size = |shared: &SharedQuantity| {
        let relative = shared.relative().flatten().map(f64::abs);
        relative.fold(0.0, f64::max)
    };
    let mut others: Vec<&SharedQuantity> = quantities
        .iter()
        .filter(|shared| found.iter().all(|known| known.path != shared.path))
        .filter(differs)
        .collect();
    others.sort_by(|a, b| size(b).total_cmp(&size(a)));
    found.extend(others);
    found
}

/// The table for the terminal: the numbers that differ, what a person asks first above.
pub fn print(runs: &[ComparedRun], quantities: &[SharedQuantity]) -> String {
    let differing = differing(quantities);
    let shown = &differing[..differing.len().min(MOST_PRINTED)];
    let table = table_of(runs, String::new(), shown);
    let rows: Vec<&Vec<String>> = std::iter::once(&table.columns).chain(&table.rows).collect();
    let width = |at: usize| rows.iter().map(|row| row[at].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..table.columns.len()).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).map(|(text, &width)| format!("{text:>width$}"));
        out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        out.push('\n');
    }
    let costs = quantities.iter();
    let costs = costs.filter(|shared| COSTS.contains(&shared.last_key()));
    let total = quantities.len() - costs.count();
    let beyond = match differing.len() - shown.len() {
        0 => String::new(),
        more => format!("; {more} more are in compare.csv"),
    };
    out.push_str(&format!("{} of {total} shared numbers differ{beyond}\n", differing.len()));
    out
}

/// The numbers that a person asks first.
fn first_of(quantities: &[SharedQuantity]) -> Vec<&SharedQuantity> {
    let of = |key: &&str| {
        let ending = format!(".{key}");
        let is_own = move |q: &&SharedQuantity| q.path.ends_with(&ending) || q.path == ending[1..];
        quantities.iter().filter(is_own).take(MOST_OF_A_KIND)
    };
    FIRST.iter().flat_map(of).collect()
}

/// The report: what decides, the figures over each other, every shared number, what the runs were made from.
pub fn html_report(
    runs: &[ComparedRun],
    quantities: &[SharedQuantity],
    figures: Vec<NamedFigure>,
    manifest: &Manifest,
) -> Report {
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    let (differing, equal): (Vec<_>, Vec<_>) = quantities
        .iter()
        .filter(|shared| !COSTS.contains(&shared.last_key()))
        .partition(|shared| !shared.is_equal());
    let counts = vec![
        ("runs".to_owned(), runs.len().to_string()),
        ("shared numbers that differ".to_owned(), differing.len().to_string()),
        ("that are equal".to_owned(), equal.len().to_string()),
    ];
    let without = runs.iter().filter(|run| run.page.is_none());
    let without =
        without.map(|run| format!("{} has no report.html: frictionsim plot draws it.", run.name));
    let made = runs.iter().map(|run| {
        let manifest = &run.manifest;
        let overrides = match manifest.overrides.is_empty() {
            true => "none".to_owned(),
            false => manifest.overrides.join(", "),
        };
        let own = [
            &manifest.command,
            &manifest.case_file,
            &overrides,
            &manifest.version,
            &manifest.case_hash,
        ];
        std::iter::once(&run.name).chain(own).cloned().collect()
    });
    let made = ReportTable::new(
        "Inputs",
        ["run", "command", "case", "overrides", "version", "SHA-256 of the case"],
        made,
    );
    let first = table_of(runs, "Key results".into(), &first_of(quantities));
    let section =
        |heading: &str, tables: Vec<ReportTable>| ReportSection::new(heading).with_tables(tables);
    Report {
        title: format!("Comparison of {}", names.join(", ")),
        sections: vec![
            ReportSection::results(without.collect(), counts).with_tables([first, made]),
            ReportSection::new("Figures over each other").with_figures(figures),
            section(
                "Every shared number",
                vec![
                    table_of(runs, "Numbers that differ".into(), &differing),
                    table_of(runs, "Numbers that are equal".into(), &equal),
                ],
            ),
        ],
        manifest: manifest.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(name: &str, summary: Value) -> ComparedRun {
        ComparedRun { name: name.into(), manifest: Manifest::new("cea"), summary, page: None }
    }

    #[test]
    fn the_printed_table_has_the_numbers_that_differ_and_no_other() {
        let of = |name, frequency: f64, wall_s: f64| {
            run(
                name,
                json!({ "main_frequency_hz": 9433.0, "wall_s": wall_s, "dofs": 10,
                        "modes": [{ "branch": 1, "frequency_hz": frequency }, { "branch": 2, "frequency_hz": 5e3 }] }),
            )
        };
        let runs = [of("a", 7e3, 1.0), of("b", 7.7e3, 2.0)];
        let text = print(&runs, &shared(&runs));
        assert!(text.contains("modes.[branch=1].frequency_hz"), "{text}");
        for equal in ["main_frequency_hz", "branch=2", "wall_s", "dofs"] {
            assert!(!text.contains(equal), "{equal}: {text}");
        }
        assert!(text.contains("1 of 6 shared numbers differ"), "{text}");
    }

    #[test]
    fn entries_of_lists_are_compared_by_what_they_are_of() {
        let entry = |n: usize, critical: f64| json!({ "harmonic": n, "direction": -1, "critical_friction": critical });
        let runs = [
            run(
                "a",
                json!({ "dofs": 10, "critical_frictions": [entry(1, 0.1), entry(2, 0.2)], "notes": ["x"] }),
            ),
            run(
                "b",
                json!({ "dofs": 10, "critical_frictions": [entry(2, 0.25), entry(1, 0.1)], "more": 1 }),
            ),
        ];
        let found = shared(&runs);
        let of = |path: &str| found.iter().find(|q| q.path == path).unwrap();
        assert!(of("dofs").is_equal());
        let second = of("critical_frictions.[harmonic=2 direction=-1].critical_friction");
        assert_eq!(second.values, [0.2, 0.25]);
        assert!((second.relative().next().unwrap().unwrap() - 0.25).abs() < 1e-12);
        assert!(found.iter().all(|q| q.path != "more"));
        assert_eq!(first_of(&found)[0].values, [0.1, 0.1]);
    }
}
