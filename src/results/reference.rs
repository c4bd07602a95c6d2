//! Every declared column of the tables and every key of `summary.json`, with unit and meaning.

use super::basin::{BasinSummary, RUNS};
use super::cea::{
    AXIAL, BRANCHES, CONTRIBUTIONS, COUPLINGS, CeaSummary, FEED, MAP, MODES, NAMES, NODES,
    ONSET_ERRORS, ONSETS, PLACES, PLANE, POINTS, RINGS, ROWS, STATUS, TRACTIONS,
};
use super::fit::{self, FitSummary};
use super::identification::{self, IdentificationSummary};
use super::improve::{self, ImproveSummary};
use super::mac::{self, MacSummary};
use super::mesh::{MeshStatistics, MeshSummary};
use super::signal::{self, SignalSummary};
use super::uncertainty::{self, UncertaintySummary};
use crate::output::{Column, Entry, Key, entries, keys_of, unit_of};
use std::fmt::Write as _;

/// What one file of a command holds.
pub struct FileReference {
    /// The command.
    pub command: &'static str,
    /// Its file; `N` stands for a number. Columns that begin with `KEY` have a key of the case or a parameter there.
    pub file: &'static str,
    /// Columns or keys in their order.
    pub entries: Vec<Entry>,
}

impl FileReference {
    /// Whether it has a column or key of this name.
    pub fn knows(&self, name: &str) -> bool {
        let is_own = |entry: &Entry| match entry.key.split_once("KEY") {
            Some((start, end)) => name.starts_with(start) && name.ends_with(end),
            None => entry.key == name,
        };
        self.entries.iter().any(is_own)
    }
}

/// The files of all commands whose columns are declared.
pub fn reference() -> Vec<FileReference> {
    let file = |command, file, groups: Vec<Vec<Entry>>| FileReference {
        command,
        file,
        entries: groups.concat(),
    };
    vec![
        file("basin", "basin.csv", vec![all(RUNS)]),
        summary::<BasinSummary>("basin"),
        file("cea", "eigenvalues.csv", vec![all(PLACES), all(MODES), all(AXIAL)]),
        file("cea", "stability.csv", vec![all(ONSETS), all(ONSET_ERRORS)]),
        file(
            "cea",
            "prestress.csv",
            vec![
                all(NODES),
                all(RINGS),
                all(&POINTS[..1]),
                all(TRACTIONS),
                all(STATUS),
                all(PLANE),
                all(&POINTS[3..]),
            ],
        ),
        file("cea", "sensitivities.csv", vec![all(ROWS), rates()]),
        file("cea", "contributions.csv", vec![all(NAMES), all(BRANCHES), all(CONTRIBUTIONS)]),
        file("cea", "coupling.csv", vec![all(NAMES), all(COUPLINGS)]),
        file("cea", "feed.csv", vec![all(&NAMES[..3]), all(FEED)]),
        file("cea", "map.csv", vec![one("KEY", "value of the second parameter"), all(MAP)]),
        summary::<CeaSummary>("cea"),
        file(
            "fit",
            "fit.csv",
            vec![all(fit::MEASURED), entries("model_", fit::MODES), all(fit::DIFFERENCES)],
        ),
        file("fit", "modes.csv", vec![all(fit::MODES), all(fit::GROWS)]),
        summary::<FitSummary>("fit"),
        file("identify", "modes.csv", vec![all(identification::MODES)]),
        file("identify", "fit.csv", vec![pairs(&identification::FITTED)]),
        summary::<IdentificationSummary>("identify"),
        file(
            "improve",
            "candidates.csv",
            vec![
                all(improve::CANDIDATES),
                all(improve::EFFECTS),
                entries("predicted_", improve::STATES),
                entries("confirmed_", improve::STATES),
                entries("confirmed_", improve::BESIDE),
                all(improve::VERDICTS),
            ],
        ),
        file(
            "improve",
            "front.csv",
            vec![
                all(improve::WEIGHTS),
                all(&improve::CANDIDATES[1..]),
                entries("predicted_", improve::STATES),
                entries("confirmed_", improve::STATES),
                all(improve::FRONTS),
                all(improve::VERDICTS),
            ],
        ),
        summary::<ImproveSummary>("improve"),
        file("mac", "mac.csv", vec![all(mac::ROWS)]),
        summary::<MacSummary>("mac"),
        summary::<MeshSummary<MeshStatistics>>("mesh"),
        file("signal", "peaks.csv", vec![all(signal::PEAKS)]),
        file("signal", "spectrum-N.csv", vec![pairs(&signal::SPECTRUM)]),
        summary::<SignalSummary>("signal"),
        file(
            "uncertainty",
            "samples.csv",
            vec![
                one("sample", "number of the sample, from 1"),
                one("KEY", "value of an uncertain parameter, by its key"),
                all(uncertainty::SAMPLES),
                all(uncertainty::ONSETS),
                all(uncertainty::ERRORS),
            ],
        ),
        summary::<UncertaintySummary>("uncertainty"),
    ]
}

fn all<T>(columns: &[Column<T>]) -> Vec<Entry> {
    entries("", columns)
}

fn pairs(columns: &[(&str, &str)]) -> Vec<Entry> {
    columns.iter().flat_map(|(key, meaning)| one(key, meaning)).collect()
}

fn one(key: &str, meaning: &str) -> Vec<Entry> {
    vec![Entry { key: key.to_owned(), meaning: meaning.to_owned() }]
}

/// The derivatives of `sensitivities.csv`.
fn rates() -> Vec<Entry> {
    pairs(&[
        (
            "growth_rate_per_KEY",
            "derivative of the growth rate by a parameter, 1/s for each of its unit",
        ),
        ("frequency_hz_per_KEY", "derivative of the frequency, Hz for each unit of the parameter"),
        ("critical_friction", "friction coefficient above which the branch is unstable first"),
        ("critical_friction_per_KEY", "derivative of that by a parameter"),
    ])
}

fn summary<T: crate::output::Described>(command: &'static str) -> FileReference {
    let entry = |key: Key| Entry { key: key.path, meaning: key.meaning.to_owned() };
    let entries = keys_of::<T>().into_iter().map(entry).collect();
    FileReference { command, file: "summary.json", entries }
}

/// The guide's tables.
pub fn markdown() -> String {
    let plain = |text: &str| text.replace('|', "\\|").replace('[', "\\[");
    let mut out = String::new();
    for file in reference() {
        let _ = writeln!(
            out,
            "\n`{}` of `{}`\n\n| name | unit | meaning |\n|---|---|---|",
            file.file, file.command
        );
        for entry in &file.entries {
            let unit = unit_of(&entry.key).1;
            let _ = writeln!(out, "| `{}` | {unit} | {} |", entry.key, plain(&entry.meaning));
        }
    }
    out.trim_start().to_owned()
}
