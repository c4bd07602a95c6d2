//! Every declared column of the tables and every key of `summary.json`, with unit and meaning.

use super::summary::STATUS as FRACTIONS;
use super::{
    ResponseSummary, basin, cea, compare, convergence, cycle, fit, identification, improve, mac,
    manifest::Manifest, matrices, mesh, signal, sweep, transient, uncertainty,
};
use crate::common::*;
use frictionsim_output::{Entry, describe_field, entries, keys_of};

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

/// Names and meanings.
impl<const N: usize> Listed for [(&str, &str); N] {
    fn listed(self) -> Vec<Entry> {
        self.map(|(key, meaning)| Entry::new(key, meaning)).into()
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
        file!("basin", "basin.csv"; basin::RUNS),
        summary::<basin::BasinSummary>("basin"),
        file!("cea", "eigenvalues.csv"; cea::MODES),
        file!("cea", "stability.csv"; cea::ONSETS),
        file!("cea", "prestress.csv"; cea::NODES, cea::RINGS, cea::NAME, cea::TRACTIONS, cea::PLANE,
            cea::SPACE),
        file!("cea", "sensitivities.csv"; cea::ROWS, cea::EIGENVALUES, RATES),
        file!("cea", "contributions.csv"; cea::NAMES, cea::CONTRIBUTIONS),
        file!("cea", "coupling.csv"; cea::SHORT_NAMES, cea::COUPLINGS),
        file!("cea", "feed.csv"; cea::NUMBERS, cea::POINTS, cea::FEED),
        summary::<cea::CeaSummary>("cea"),
        file!("compare", "compare.csv"; [
            ("quantity", "dotted path in the summaries of the runs"),
            ("unit", "its unit"),
            ("KEY", "its value in the run of that name"),
            ("difference KEY", "difference of that run from the first"),
            ("relative difference KEY", "the same over the magnitude of the first"),
        ]),
        summary::<compare::ComparisonSummary>("compare"),
        file!("convergence", "convergence.csv"; convergence::ROWS),
        summary::<convergence::ConvergenceSummary>("convergence"),
        file!("cycle", "cycle.csv"; cycle::NAMES, cycle::MOTION, FRACTIONS, cycle::POWERS,
            cycle::BALANCE, cycle::KNOWN, cycle::ERRORS),
        file!("cycle", "cycle-N.csv"; cycle::HISTORY, cycle::WAVE_PATH, cycle::PATH),
        file!("cycle", "contact-N.csv"; cycle::CONTACT_NODES),
        file!("cycle", "harmonics-N.csv"; cycle::HARMONICS),
        file!("cycle", "stability-N.csv"; PARAMETER, cycle::EXPONENTS),
        file!("cycle", "branch-N.csv"; PARAMETER, cycle::BRANCH, FRACTIONS, cycle::POWERS,
            cycle::ALONG),
        file!("cycle", "two-waves-N.csv"; PARAMETER, cycle::TWO_WAVES),
        summary::<cycle::CycleSummary>("cycle"),
        file!("fit", "fit.csv"; fit::MEASURED, entries("model_", fit::MODES), fit::DIFFERENCES),
        file!("fit", "modes.csv"; fit::MODES, [fit::GROWS]),
        summary::<fit::FitSummary>("fit"),
        file!("frf", "frf.csv";
        [
            ("frequency_hz", "frequency"),
            ("KEY_real", "real part of the accelerance, mobility or receptance"),
            ("KEY_imaginary", "its imaginary part"),
        ]),
        summary::<ResponseSummary>("frf"),
        file!("identify", "modes.csv"; identification::MODES),
        file!("identify", "fit.csv"; identification::FITTED),
        summary::<identification::IdentificationSummary>("identify"),
        file!("improve", "candidates.csv"; improve::CANDIDATES, improve::EFFECTS,
            entries("predicted_", improve::PREDICTED), entries("confirmed_", improve::STATES),
            improve::VERDICTS),
        summary::<improve::ImproveSummary>("improve"),
        file!("mac", "mac.csv"; mac::ROWS),
        summary::<mac::MacSummary>("mac"),
        file!("matrices", "unknowns.csv"; matrices::UNKNOWN),
        file!("matrices", "contact.csv"; matrices::PLANE_POINT, matrices::SOLID_POINT),
        summary::<matrices::MatricesSummary>("matrices"),
        summary::<mesh::MeshSummary>("mesh"),
        file!("signal", "peaks.csv"; signal::PEAKS),
        file!("signal", "spectrum-N.csv"; signal::SPECTRUM),
        summary::<signal::SignalSummary>("signal"),
        file!("sweep", "points.csv"; SWEPT, [("KEY.KEY", "numbers of the summaries")], POINTS),
        file!("sweep", "stability.csv"; SWEPT, cea::SWEPT_ONSETS, POINTS),
        file!("sweep", "unstable_modes.csv"; SWEPT, cea::UNSTABLE, POINTS),
        file!("sweep", "modes.csv"; SWEPT, cea::SWEPT_MODES, POINTS),
        file!("sweep", "branches.csv"; SWEPT, sweep::BRANCHES, POINTS),
        summary::<sweep::SweepSummary>("sweep"),
        file!("transient", "probe-N.csv"; [("time_s", "time")],
        [
            ("u_KEY_m", "displacement in a direction: r, theta, x, y or z"),
            ("v_KEY_m_per_s", "velocity"),
            ("a_KEY_m_per_s2",
                "acceleration: mean since the last sample, or with `step` of the step alone"),
        ]),
        file!("transient", "energy.csv"; transient::ENERGY),
        file!("transient", "contact.csv"; transient::STATUS),
        file!("transient", "harmonics.csv"; [("time_s", "time")],
        [
            ("nKEY_real_m", "amplitude of a harmonic along the contact edge, real part"),
            ("nKEY_imaginary_m", "imaginary part"),
        ]),
        summary::<transient::TransientSummary>("transient"),
        file!("uncertainty", "samples.csv"; [("sample", "number of the sample, from 1")],
            [("KEY", "value of an uncertain parameter, by its key")], uncertainty::SAMPLES,
            uncertainty::ONSETS, uncertainty::ERRORS),
        summary::<uncertainty::UncertaintySummary>("uncertainty"),
    ]
}

/// A swept key.
const SWEPT: [(&str, &str); 1] = [("KEY", "value of a swept key")];

/// The number of a point, and why it failed.
const POINTS: [(&str, &str); 2] =
    [("point", "number of the point, from 1"), ("error", "why it failed, in `points.csv`")];

/// The parameter of a branch.
const PARAMETER: [(&str, &str); 1] =
    [("KEY", "value of the parameter of `cycle.continuation`; `point` without one")];

/// The derivatives of `sensitivities.csv`.
const RATES: [(&str, &str); 4] = [
    (
        "growth_rate_per_KEY",
        "derivative of the growth rate by a parameter, 1/s for each of its unit",
    ),
    ("frequency_hz_per_KEY", "derivative of the frequency, Hz for each unit of the parameter"),
    ("critical_friction", "friction coefficient above which the branch is unstable first"),
    ("critical_friction_per_KEY", "derivative of that by a parameter"),
];

fn summary<T: Described>(command: &'static str) -> FileReference {
    let mut keys = keys_of::<T>();
    let manifest = ("manifest", "what it was made from", false);
    describe_field(Manifest::describe, "", manifest, &mut keys);
    keys.iter_mut().for_each(|own| own.meaning = plain(&own.meaning));
    let head = [
        ("command", "the command"),
        ("title", "title of the case, of a command that runs one"),
        ("wall_s", "wall time, of a command that takes some"),
    ];
    FileReference { command, file: "summary.json", entries: [head.listed(), keys].concat() }
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
