//! Every declared column of the tables and every key of `summary.json`, with unit and meaning.

use super::ResponseSummary;
use super::basin::{BasinSummary, RUNS};
use super::cea::{self, CeaSummary};
use super::compare::ComparisonSummary;
use super::convergence::{self, ConvergenceSummary};
use super::cycle::{self, CycleSummary};
use super::fit::{self, FitSummary};
use super::identification::{self, IdentificationSummary};
use super::improve::{self, ImproveSummary};
use super::mac::{self, MacSummary};
use super::manifest::Manifest;
use super::matrices::{self, MatricesSummary};
use super::mesh::{MeshStatistics, MeshSummary, SolidMeshStatistics};
use super::signal::{self, SignalSummary};
use super::summary::STATUS as FRACTIONS;
use super::sweep::{self, SweepSummary};
use super::transient::{self, TransientSummary};
use super::uncertainty::{self, UncertaintySummary};
use crate::prelude::*;
use frictionsim_output::{Entry, describe_field, entries, keys_of, unit_of};
use serde_json::json;
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

/// What has entries: columns, or entries themselves.
trait Listed {
    fn listed(self) -> Vec<Entry>;
}

impl<T> Listed for &[Column<T>] {
    fn listed(self) -> Vec<Entry> {
        entries("", self)
    }
}

impl Listed for Vec<Entry> {
    fn listed(self) -> Vec<Entry> {
        self
    }
}

/// A file of a command and what it holds, in its order.
macro_rules! file {
    ($command:literal, $file:literal; $($group:expr),+) => {
        FileReference {
            command: $command,
            file: $file,
            entries: [$($group.listed()),+].concat(),
        }
    };
}

/// The files of all commands whose columns are declared.
pub fn reference() -> Vec<FileReference> {
    vec![
        file!("basin", "basin.csv"; RUNS),
        summary::<BasinSummary>("basin"),
        file!("cea", "eigenvalues.csv"; cea::PLACES, cea::MODES, cea::AXIAL),
        file!("cea", "stability.csv"; cea::ONSETS),
        file!("cea", "prestress.csv"; cea::NODES, cea::RINGS, parted(cea::POINTS, "x_m").0,
            cea::TRACTIONS, cea::STATUS, cea::PLANE, parted(cea::POINTS, "z_m").1),
        file!("cea", "sensitivities.csv"; cea::ROWS, cea::EIGENVALUES, rates()),
        file!("cea", "contributions.csv"; cea::NAMES, cea::CONTRIBUTIONS),
        file!("cea", "coupling.csv"; cea::SHORT_NAMES, cea::COUPLINGS),
        file!("cea", "feed.csv"; cea::NUMBERS, cea::FEED),
        summary::<CeaSummary>("cea"),
        file!("compare", "compare.csv"; pairs(&[
            ("quantity", "dotted path in the summaries of the runs"),
            ("unit", "its unit"),
            ("KEY", "its value in the run of that name"),
            ("difference KEY", "difference of that run from the first"),
            ("relative difference KEY", "the same over the magnitude of the first"),
        ])),
        summary::<ComparisonSummary>("compare"),
        file!("convergence", "convergence.csv"; convergence::ROWS),
        summary::<ConvergenceSummary>("convergence"),
        file!("cycle", "cycle.csv"; cycle::NAMES, cycle::MOTION, FRACTIONS, cycle::POWERS,
            cycle::BALANCE, cycle::KNOWN, cycle::ERRORS),
        file!("cycle", "cycle-N.csv"; cycle::HISTORY, cycle::WAVE_PATH, cycle::PATH),
        file!("cycle", "contact-N.csv"; cycle::CONTACT_NODES),
        file!("cycle", "harmonics-N.csv"; cycle::HARMONICS),
        file!("cycle", "stability-N.csv"; parameter(), cycle::EXPONENTS),
        file!("cycle", "branch-N.csv"; parameter(), cycle::BRANCH, FRACTIONS, cycle::POWERS,
            cycle::ALONG),
        file!("cycle", "two-waves-N.csv"; parameter(), cycle::TWO_WAVES),
        summary::<CycleSummary>("cycle"),
        file!("fit", "fit.csv"; fit::MEASURED, entries("model_", fit::MODES), fit::DIFFERENCES),
        file!("fit", "modes.csv"; fit::MODES, fit::GROWS),
        summary::<FitSummary>("fit"),
        file!("frf", "frf.csv";
        pairs(&[
            ("frequency_hz", "frequency"),
            ("KEY_real", "real part of the accelerance, mobility or receptance"),
            ("KEY_imaginary", "its imaginary part"),
        ])),
        summary::<ResponseSummary>("frf"),
        file!("identify", "modes.csv"; identification::MODES),
        file!("identify", "fit.csv"; identification::FITTED),
        summary::<IdentificationSummary>("identify"),
        file!("improve", "candidates.csv"; improve::CANDIDATES, improve::EFFECTS,
            entries("predicted_", improve::PREDICTED), entries("confirmed_", improve::STATES),
            improve::VERDICTS),
        summary::<ImproveSummary>("improve"),
        file!("mac", "mac.csv"; mac::ROWS),
        summary::<MacSummary>("mac"),
        file!("matrices", "unknowns.csv"; matrices::UNKNOWN),
        file!("matrices", "contact.csv"; matrices::PLANE_POINT, matrices::SOLID_POINT),
        summary::<MatricesSummary>("matrices"),
        summary::<MeshSummary<AnyMesh>>("mesh"),
        file!("signal", "peaks.csv"; signal::PEAKS),
        file!("signal", "spectrum-N.csv"; signal::SPECTRUM),
        summary::<SignalSummary>("signal"),
        file!("sweep", "points.csv"; swept(), one("KEY.KEY", "numbers of the summaries"), points()),
        file!("sweep", "stability.csv"; swept(), cea::SWEPT_ONSETS, points()),
        file!("sweep", "unstable_modes.csv"; swept(), cea::UNSTABLE, points()),
        file!("sweep", "modes.csv"; swept(), cea::SWEPT_MODES, points()),
        file!("sweep", "branches.csv"; swept(), sweep::BRANCHES, points()),
        summary::<SweepSummary>("sweep"),
        file!("transient", "probe-N.csv"; one("time_s", "time"),
        pairs(&[
            ("u_KEY_m", "displacement in a direction: r, theta, x, y or z"),
            ("v_KEY_m_per_s", "velocity"),
            ("a_KEY_m_per_s2",
                "acceleration: mean since the last sample, or with `step` of the step alone"),
        ])),
        file!("transient", "energy.csv"; transient::ENERGY),
        file!("transient", "contact.csv"; transient::STATUS),
        file!("transient", "harmonics.csv"; one("time_s", "time"),
        pairs(&[
            ("nKEY_real_m", "amplitude of a harmonic along the contact edge, real part"),
            ("nKEY_imaginary_m", "imaginary part"),
        ])),
        summary::<TransientSummary>("transient"),
        file!("uncertainty", "samples.csv"; one("sample", "number of the sample, from 1"),
            one("KEY", "value of an uncertain parameter, by its key"), uncertainty::SAMPLES,
            uncertainty::ONSETS, uncertainty::ERRORS),
        summary::<UncertaintySummary>("uncertainty"),
    ]
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
    columns.iter().map(|(key, meaning)| Entry::new(*key, meaning)).collect()
}

fn one(key: &str, meaning: &str) -> Vec<Entry> {
    vec![Entry::new(key, meaning)]
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

fn summary<T: Described>(command: &'static str) -> FileReference {
    let mut keys = keys_of::<T>();
    let manifest = ("manifest", "what it was made from", false);
    describe_field(Manifest::describe, "", manifest, &mut keys);
    keys.iter_mut().for_each(|own| own.meaning = plain(&own.meaning));
    let head = pairs(&[
        ("command", "the command"),
        ("title", "title of the case, of a command that runs one"),
        ("wall_s", "wall time, of a command that takes some"),
    ]);
    FileReference { command, file: "summary.json", entries: [head, keys].concat() }
}

/// The mesh of any body: what plane bodies and bodies of revolution have, and solid bodies.
enum AnyMesh {}

impl Described for AnyMesh {
    fn describe(path: &str, keys: &mut Vec<Entry>) {
        MeshStatistics::describe(path, keys);
        SolidMeshStatistics::describe(path, keys);
    }
}

/// The comment of a field as columns have their meaning: without its first capital and its full stop.
fn plain(comment: &str) -> String {
    let mut letters = comment.trim_end_matches('.').chars();
    let first = letters.next().into_iter();
    match letters.clone().next() {
        Some(second) if second.is_uppercase() => first.chain(letters).collect(),
        _ => first.flat_map(char::to_lowercase).chain(letters).collect(),
    }
}

/// Columns and keys whose name, meaning, file or command holds a word, one object each.
pub fn objects(word: &str) -> Vec<Value> {
    let lower = word.to_lowercase();
    let holds = |text: &str| text.to_lowercase().contains(&lower);
    let mut found = Vec::new();
    for FileReference { command, file, entries } in reference() {
        let is_whole = holds(command) || holds(file);
        let own = entries.iter().filter(|e| is_whole || holds(&e.key) || holds(&e.meaning));
        found.extend(own.map(|Entry { key, meaning, .. }| {
            let unit = unit_of(key).1;
            json!({ "command": command, "file": file, "name": key, "unit": unit, "meaning": meaning })
        }));
    }
    found
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
