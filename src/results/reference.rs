//! Every declared column of the tables and every key of `summary.json`, with unit and meaning.

use super::basin::{BasinSummary, RUNS};
use super::cea::{
    AXIAL, BRANCHES, CONTRIBUTIONS, COUPLINGS, CeaSummary, FEED, MODES, NAMES, NODES, ONSET_ERRORS,
    ONSETS, PLACES, PLANE, POINTS, RINGS, ROWS, STATUS, TRACTIONS,
};
use super::compare::ComparisonSummary;
use super::convergence::{self, ConvergenceSummary};
use super::cycle::{self, CycleSummary};
use super::fit::{self, FitSummary};
use super::identification::{self, IdentificationSummary};
use super::improve::{self, ImproveSummary};
use super::mac::{self, MacSummary};
use super::matrices::{self, MatricesSummary};
use super::mesh::{MeshStatistics, MeshSummary};
use super::response::ResponseSummary;
use super::signal::{self, SignalSummary};
use super::sweep::{self, SweepSummary};
use super::transient::{self, TransientSummary};
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
        summary::<CeaSummary>("cea"),
        summary::<ComparisonSummary>("compare"),
        file("convergence", "convergence.csv", vec![all(convergence::ROWS)]),
        summary::<ConvergenceSummary>("convergence"),
        file(
            "cycle",
            "cycle.csv",
            vec![
                all(cycle::NAMES),
                all(cycle::MOTION),
                all(cycle::POWERS),
                all(cycle::KNOWN),
                all(cycle::ERRORS),
            ],
        ),
        file(
            "cycle",
            "cycle-N.csv",
            vec![all(cycle::HISTORY), all(cycle::WAVE_PATH), all(cycle::PATH)],
        ),
        file("cycle", "contact-N.csv", vec![all(cycle::CONTACT_NODES)]),
        file("cycle", "harmonics-N.csv", vec![all(cycle::HARMONICS)]),
        file("cycle", "stability-N.csv", vec![parameter(), all(cycle::EXPONENTS)]),
        file("cycle", "branch-N.csv", vec![parameter(), all(cycle::BRANCH)]),
        file("cycle", "two-waves-N.csv", vec![parameter(), all(cycle::TWO_WAVES)]),
        summary::<CycleSummary>("cycle"),
        file(
            "fit",
            "fit.csv",
            vec![all(fit::MEASURED), entries("model_", fit::MODES), all(fit::DIFFERENCES)],
        ),
        file("fit", "modes.csv", vec![all(fit::MODES), all(fit::GROWS)]),
        summary::<FitSummary>("fit"),
        file(
            "frf",
            "frf.csv",
            vec![pairs(&[
                ("frequency_hz", "frequency"),
                ("KEY_real", "real part of the accelerance, mobility or receptance"),
                ("KEY_imaginary", "its imaginary part"),
            ])],
        ),
        summary::<ResponseSummary>("frf"),
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
        summary::<ImproveSummary>("improve"),
        file("mac", "mac.csv", vec![all(mac::ROWS)]),
        summary::<MacSummary>("mac"),
        file("matrices", "unknowns.csv", vec![all(matrices::UNKNOWN)]),
        file(
            "matrices",
            "contact.csv",
            vec![all(matrices::PLANE_POINT), all(matrices::SOLID_POINT)],
        ),
        summary::<MatricesSummary>("matrices"),
        summary::<MeshSummary<MeshStatistics>>("mesh"),
        file("signal", "peaks.csv", vec![all(signal::PEAKS)]),
        file("signal", "spectrum-N.csv", vec![pairs(&signal::SPECTRUM)]),
        summary::<SignalSummary>("signal"),
        file(
            "sweep",
            "points.csv",
            vec![swept(), one("KEY.KEY", "numbers of the summaries"), points()],
        ),
        file("sweep", "stability.csv", vec![swept(), all(ONSETS), points()]),
        file("sweep", "unstable_modes.csv", vec![swept(), all(sweep::UNSTABLE), points()]),
        file("sweep", "modes.csv", vec![swept(), all(sweep::OWN_MODES), points()]),
        file("sweep", "branches.csv", vec![swept(), all(sweep::BRANCHES), points()]),
        summary::<SweepSummary>("sweep"),
        file(
            "transient",
            "probe-N.csv",
            vec![
                one("time_s", "time"),
                pairs(&[
                    ("u_KEY_m", "displacement in a direction: r, theta, x, y or z"),
                    ("v_KEY_m_per_s", "velocity"),
                    (
                        "a_KEY_m_per_s2",
                        "acceleration: mean since the last sample, or with `step` of the step alone",
                    ),
                ]),
            ],
        ),
        file("transient", "energy.csv", vec![all(transient::ENERGY)]),
        file("transient", "contact.csv", vec![all(transient::STATUS)]),
        file(
            "transient",
            "harmonics.csv",
            vec![
                one("time_s", "time"),
                pairs(&[
                    ("nKEY_real_m", "amplitude of a harmonic along the contact edge, real part"),
                    ("nKEY_imaginary_m", "imaginary part"),
                ]),
            ],
        ),
        summary::<TransientSummary>("transient"),
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

/// A swept key.
fn swept() -> Vec<Entry> {
    one("KEY", "value of a swept key")
}

/// The number of a point, and why it failed.
fn points() -> Vec<Entry> {
    pairs(&[("point", "number of the point, from 1"), ("error", "why it failed, in `points.csv`")])
}

/// The parameter of a branch.
fn parameter() -> Vec<Entry> {
    one("KEY", "value of the parameter of `cycle.continuation`; `point` without one")
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
