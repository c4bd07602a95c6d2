//! Runs side by side: every number that they share, and their figures over each other.

mod figures;

pub use figures::overlaid;

use super::sweep::{cell, join};
use crate::common::*;
use crate::{Manifest, Page, identification::response_unit};

/// A finished run.
pub struct ComparedRun {
    /// What it is called.
    pub name: String,
    /// What it was made from.
    pub manifest: Manifest,
    /// Its `summary.json`.
    pub summary: Value,
    /// Its figures, where it has any.
    pub page: Option<Page>,
}

keys! {
    /// A number that every run has.
    SharedQuantity {
        path: String = "dotted path in the summaries; entries of lists are named by what they are of";
        values: Vec<Value> = "its value in each run: a number, or whether something is so";
    }

    /// `summary.json` of `frictionsim compare`.
    ComparisonSummary {
        runs: Vec<String> = "the runs";
        quantities: Vec<SharedQuantity> = "numbers that all of them have";
    }
}

/// Keys that say what an entry of a list is of.
const NAMES: [&str; 7] =
    ["friction_coefficient", "harmonic", "branch", "direction", "onset", "key", "name"];

/// Numbers that tell runs apart but decide nothing.
const COSTS: [&str; 4] = ["wall_s", "core_s", "element_steps_per_s", "points_per_core_hour"];

/// What a person asks of two runs first.
const FIRST: [&str; 12] = [
    "critical_friction",
    "peak_frequency_hz",
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
fn numbers_of(summary: &Value) -> Vec<(String, &Value)> {
    fn visit<'a>(path: &str, value: &'a Value, out: &mut Vec<(String, &'a Value)>) {
        match value {
            Value::Number(_) | Value::Bool(_) => out.push((path.to_owned(), value)),
            Value::Object(entries) => {
                let entries = entries.iter().filter(|(key, _)| *key != "manifest");
                entries.for_each(|(key, value)| visit(&join(path, key), value, out));
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
                    visit(&join(path, &key), entry, out);
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
    let numbers: Vec<Vec<(String, &Value)>> =
        runs.iter().map(|run| numbers_of(&run.summary)).collect();
    let of = |path: &str, run: &[(String, &Value)]| {
        run.iter().find(|own| own.0 == path).map(|own| own.1.clone())
    };
    let quantity = |path: &String| {
        let values: Option<Vec<Value>> = numbers.iter().map(|run| of(path, run)).collect();
        Some(SharedQuantity { path: path.clone(), values: values? })
    };
    let paths = distinct(numbers.first().into_iter().flatten().map(|own| &own.0));
    paths.into_iter().filter_map(quantity).collect()
}

impl SharedQuantity {
    /// The value in a run; 1 where something is so, else 0.
    fn value(&self, run: usize) -> f64 {
        let own = &self.values[run];
        own.as_f64().unwrap_or_else(|| f64::from(u8::from(own == true)))
    }

    /// Difference of a run from the first.
    fn difference(&self, run: usize) -> f64 {
        self.value(run) - self.value(0)
    }

    /// The same as it stands in tables: whole of counts.
    fn difference_cell(&self, run: usize) -> Cell {
        let difference = self.difference(run);
        let is_whole = [run, 0].iter().all(|&own| !self.values[own].is_f64());
        if is_whole { Cell::Count(difference as i64) } else { difference.into() }
    }

    fn is_equal(&self) -> bool {
        (1..self.values.len()).all(|run| self.difference(run) == 0.0)
    }

    /// The same relative to the first.
    fn relative(&self, run: usize) -> Option<f64> {
        let first = self.value(0);
        (first != 0.0).then(|| self.difference(run) / first.abs())
    }

    /// The largest of them, infinite where the first is zero.
    fn largest_relative(&self) -> f64 {
        let off = |run| self.relative(run).map_or(f64::INFINITY, f64::abs);
        (1..self.values.len()).map(off).fold(0.0, f64::max)
    }

    /// Whether it decides nothing.
    pub fn is_cost(&self) -> bool {
        self.path.rsplit('.').next().is_some_and(|key| COSTS.contains(&key))
    }
}

/// The unit that the last part of a path says which says one.
fn unit(path: &str) -> &'static str {
    let units = path.rsplit('.').map(|part| match part {
        "mass_coefficient" => "1/s",
        "stiffness_coefficient" => "s",
        "accelerance" | "mobility" | "receptance" => response_unit(part),
        other => unit_of(other).1,
    });
    units.into_iter().find(|unit| !unit.is_empty()).unwrap_or_default()
}

/// Path, unit, the value of each run, then differences from the first, absolute and relative; people see the latter in
/// per cent.
fn table_of(
    (file, caption): (&str, &str),
    runs: &[ComparedRun],
    quantities: &[&SharedQuantity],
) -> Table {
    let words = |label: &'static str| Some((label, Format::Plain));
    let extent = runs.iter().find_map(|run| Extent::of_summary(&run.summary)).unwrap_or_default();
    let units = quantities.iter().map(|own| extent.unit(unit(&own.path)));
    let mut table = Table::new(file, caption)
        .column("quantity", words("quantity"), quantities.iter().map(|own| own.path.clone()))
        .column("unit", words("unit"), units);
    let mut add =
        |key: &str, look: Option<(&str, Format)>, of: &dyn Fn(&SharedQuantity) -> Cell| {
            let cells = quantities.iter().map(|own| of(own));
            table = std::mem::take(&mut table).column(key, look, cells);
        };
    for (at, run) in runs.iter().enumerate() {
        add(&run.name, None, &|own| cell(&own.values[at]));
        add("", Some((&run.name, Format::Significant(7))), &|own| cell(&own.values[at]));
    }
    for (at, run) in runs.iter().enumerate().skip(1) {
        let less = format!("{} less {}", run.name, runs[0].name);
        add(&format!("difference {}", run.name), None, &|own| own.difference_cell(at));
        add("", Some((&less, Format::Significant(4))), &|own| own.difference_cell(at));
    }
    for (at, run) in runs.iter().enumerate().skip(1) {
        let (key, off) =
            (format!("relative difference {}", run.name), format!("{} off by (%)", run.name));
        add(&key, None, &|own| own.relative(at).into());
        add("", Some((&off, Format::Significant(4))), &|own| {
            own.relative(at).map(|share| 100.0 * share).into()
        });
    }
    table
}

/// `compare.csv`: every shared number.
pub fn file(runs: &[ComparedRun], quantities: &[SharedQuantity]) -> Table {
    table_of(("compare.csv", ""), runs, &quantities.iter().collect::<Vec<_>>())
}

/// Most lines of the table for the terminal.
const MOST_PRINTED: usize = 30;
/// Relative difference that is round-off.
const ROUND_OFF: f64 = 1e-9;

/// The numbers that differ, but for costs: what a person asks first, then the others, the largest relative difference
/// first.
fn differing(quantities: &[SharedQuantity]) -> Vec<&SharedQuantity> {
    let differs = |shared: &&SharedQuantity| !shared.is_equal() && !shared.is_cost();
    let mut found: Vec<&SharedQuantity> =
        first_of(quantities).into_iter().filter(differs).collect();
    let is_other = |shared: &&SharedQuantity| found.iter().all(|own| own.path != shared.path);
    let others = quantities.iter().filter(is_other).filter(differs);
    let others = sorted(others, |own| -own.largest_relative());
    found.extend(others);
    found
}

/// The table for the terminal: the numbers that differ by more than round-off, what a person asks first above.
pub fn print(runs: &[ComparedRun], quantities: &[SharedQuantity]) -> String {
    let (round_off, differing): (Vec<_>, Vec<_>) =
        differing(quantities).into_iter().partition(|own| own.largest_relative() < ROUND_OFF);
    let shown = &differing[..differing.len().min(MOST_PRINTED)];
    let mut out = table_of(("", ""), runs, shown).text();
    let total = quantities.iter().filter(|shared| !shared.is_cost()).count();
    let beyond = match differing.len() - shown.len() {
        0 => String::new(),
        more => format!("; {more} more are in compare.csv"),
    };
    if !round_off.is_empty() {
        out.push_str(&format!("{} of {total} differ by round-off alone\n", round_off.len()));
    }
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

columns! {
    /// What a run was made from.
    INPUTS: run as ComparedRun;
    run = run.name.clone(), Always "run" Plain;
    command = run.manifest.command.clone(), Always "command" Plain;
    case = run.manifest.case_file.clone(), Always "case" Plain;
    overrides = run.manifest.overrides_text(), Always "overrides" Plain;
    version = run.manifest.version.clone(), Always "version" Plain;
    hash = run.manifest.case_hash.clone(), Always "SHA-256 of the case" Plain;
}

/// The page: what decides, the figures over each other, every shared number, what the runs were made from.
pub fn document(runs: &[ComparedRun], quantities: &[SharedQuantity]) -> Document {
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    let decisive = quantities.iter().filter(|shared| !shared.is_cost());
    let (differing, equal): (Vec<_>, Vec<_>) = decisive.partition(|shared| !shared.is_equal());
    let without = runs.iter().filter(|run| run.page.is_none());
    let results = Section::new("Results")
        .facts([
            ("runs", runs.len().to_string()),
            ("shared numbers that differ", differing.len().to_string()),
            ("that are equal", equal.len().to_string()),
        ])
        .text(without.map(|run| format!("{} has no figures: run it again with figures.", run.name)))
        .tables([
            table_of(("", "Key results"), runs, &first_of(quantities)),
            Table::new("", "Inputs").columns(INPUTS, runs),
        ]);
    let every = Section::new("Every shared number").tables([
        table_of(("", "Numbers that differ"), runs, &differing),
        table_of(("", "Numbers that are equal"), runs, &equal),
    ]);
    Document::new(format!("Comparison of {}", names.join(", ")))
        .section(results)
        .section(Section::new("Figures over each other").figures([""]))
        .section(every)
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

        // Round-off is counted and not listed.
        let runs = [of("a", 7e3, 1.0), of("b", 7e3 * (1.0 + 1e-14), 2.0)];
        let text = print(&runs, &shared(&runs));
        assert!(!text.contains("branch=1"), "{text}");
        assert!(text.contains("1 of 6 differ by round-off"), "{text}");
    }

    #[test]
    fn the_peak_of_a_response_is_compared_where_both_are_of_one_quantity() {
        let of = |name, quantity: &str, at: f64| {
            run(name, json!({ "peak": { quantity: 2.0 }, "peak_frequency_hz": at }))
        };
        let paths = |other: &str| -> Vec<String> {
            let found = shared(&[of("a", "mobility", 8e3), of("b", other, 9e3)]);
            found.into_iter().map(|own| own.path).collect()
        };
        assert_eq!(paths("receptance"), ["peak_frequency_hz"]);
        assert_eq!(paths("mobility"), ["peak.mobility", "peak_frequency_hz"]);
        assert_eq!(["peak.mobility", "peak_frequency_hz"].map(unit), ["m/s/N", "Hz"]);
    }

    #[test]
    fn powers_for_each_metre_of_thickness_say_so() {
        let of = |name, power: f64| {
            let frequency = 9e3 + power;
            let powers = json!({ "external": power });
            let extent = "metre-of-thickness";
            run(
                name,
                json!({ "extent": extent, "power_w": powers, "main_frequency_hz": frequency }),
            )
        };
        let runs = [of("a", 1.0), of("b", 2.0)];
        let text = print(&runs, &shared(&runs));
        assert!(text.contains(" W/m ") && text.contains(" Hz "), "{text}");
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
        // A count has no point.
        assert!(of("dofs").is_equal() && cell(&of("dofs").values[0]) == Cell::Count(10));
        let second = of("critical_frictions.[harmonic=2 direction=-1].critical_friction");
        assert_eq!(second.values, [json!(0.2), json!(0.25)]);
        assert!((second.relative(1).unwrap() - 0.25).abs() < 1e-12);
        assert!(found.iter().all(|q| q.path != "more"));
        assert_eq!(first_of(&found)[0].values, [json!(0.1), json!(0.1)]);
    }
}
