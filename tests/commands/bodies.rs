//! Every analysis on every kind of body: right, or refused with a reason.
//!
//! Each cell of the table runs the program on a coarse body and holds its answer to another route: the same body described
//! otherwise, another solver, the analysis that the study repeats, a difference of two whole analyses. What the program
//! refuses is listed with its reason. `FRICTIONSIM_WRITE_TABLE=1 cargo test --test commands bodies` writes the table into
//! `tests/README.md`; the test fails where that file says something else.

mod checks;
mod grid;
mod kinds;

use kinds::{Kind, kinds};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a run gave.
pub enum Answer {
    /// The summary, and the folder of the results.
    Done(serde_json::Value, PathBuf),
    /// The first line of the error.
    Refused(String),
}

/// What a cell of the table says; a wrong answer fails the test with its message.
pub enum Cell {
    Right,
    Refused(String),
    Wrong(String),
}

/// A body's case file in a folder of its own.
pub struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new(kind: &Kind) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("case.toml"), &kind.case).unwrap();
        if let Some(mesh) = &kind.mesh {
            std::fs::write(folder.path().join("body.msh"), mesh).unwrap();
        }
        Self { folder }
    }

    /// A file beside the case.
    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    /// Runs `command` under `overrides`, with `inputs` behind the case.
    pub fn run(&self, command: &str, overrides: &[&str], inputs: &[&Path]) -> Answer {
        let case = self.folder.path().join("case.toml");
        self.run_on(command, &[&[case.as_path()], inputs].concat(), overrides)
    }

    /// Runs `command` on `inputs` alone.
    pub fn run_on(&self, command: &str, inputs: &[&Path], overrides: &[&str]) -> Answer {
        let out =
            tempfile::Builder::new().prefix("run").tempdir_in(self.folder.path()).unwrap().keep();
        let mut program = Command::new(env!("CARGO_BIN_EXE_frictionsim"));
        program.arg(command).args(inputs).arg("--json");
        if command != "check" {
            program.args(["-qq", "--no-figures", "--force", "--out"]).arg(&out);
        }
        for setting in overrides {
            program.args(["--set", setting]);
        }
        let run = program.output().unwrap();
        let errors = String::from_utf8_lossy(&run.stderr);
        if !run.status.success() {
            let line = errors.lines().find(|line| line.starts_with("error"));
            let line =
                line.unwrap_or_else(|| panic!("{command} failed without a reason: {errors}"));
            return Answer::Refused(line.trim_start_matches("error: ").to_owned());
        }
        let summary = serde_json::from_slice(&run.stdout)
            .unwrap_or_else(|error| panic!("{command}: {error}: {errors}"));
        Answer::Done(summary, out)
    }
}

impl Bench {
    /// Draws the figures of a results folder.
    pub fn redraw(&self, folder: &Path) -> Result<(), String> {
        let mut program = Command::new(env!("CARGO_BIN_EXE_frictionsim"));
        let run = program.arg("plot").arg(folder).arg("-qq").output().unwrap();
        let errors = String::from_utf8_lossy(&run.stderr).into_owned();
        run.status.success().then_some(()).ok_or(errors)
    }
}

/// The table as Markdown: a row for each analysis, a column for each body, the reasons of refusals below.
fn table(kinds: &[Kind], cells: &[(&str, Vec<Cell>)]) -> String {
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
    let mut text = format!("| | {} |\n|---|{}\n", names.join(" | "), "---|".repeat(names.len()));
    let mut reasons: Vec<&str> = Vec::new();
    for (analysis, row) in cells {
        write!(text, "| {analysis} |").unwrap();
        for cell in row {
            let Cell::Refused(reason) = cell else {
                text += " right |";
                continue;
            };
            let known = reasons.iter().position(|known| known == reason);
            let number = known.unwrap_or_else(|| {
                reasons.push(reason);
                reasons.len() - 1
            });
            write!(text, " {} |", number + 1).unwrap();
        }
        text.push('\n');
    }
    text.push('\n');
    for (i, reason) in reasons.iter().enumerate() {
        writeln!(text, "{}. {reason}", i + 1).unwrap();
    }
    text
}

#[test]
fn every_analysis_of_every_body_is_right_or_refused_with_a_reason() {
    const BEGIN: &str = "<!-- table of bodies and analyses: generated -->\n";
    const END: &str = "<!-- end of the table -->";
    let kinds = kinds();
    let benches: Vec<Bench> = kinds.iter().map(Bench::new).collect();
    let mut wrong = String::new();
    let mut cells = Vec::new();
    for (analysis, check) in checks::ALL {
        let row: Vec<Cell> = kinds
            .iter()
            .zip(&benches)
            .map(|(kind, bench)| {
                let twin = kind.twin.map(|name| {
                    let place = kinds.iter().position(|other| other.name == name);
                    &benches[place.expect("a twin is a kind of the table")]
                });
                check(bench, twin)
            })
            .collect();
        for (kind, cell) in kinds.iter().zip(&row) {
            if let Cell::Wrong(message) = cell {
                writeln!(wrong, "{analysis}, {}: {message}", kind.name).unwrap();
            }
        }
        cells.push((*analysis, row));
    }
    assert!(wrong.is_empty(), "\n{wrong}");

    let table = table(&kinds, &cells);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/README.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once(BEGIN).expect("tests/README.md has the table's place");
    let (stored, after) = rest.split_once(END).expect("tests/README.md has the table's end");
    if std::env::var_os("FRICTIONSIM_WRITE_TABLE").is_some() {
        std::fs::write(&path, format!("{before}{BEGIN}{table}{END}{after}")).unwrap();
    } else {
        assert_eq!(stored, table, "the table of tests/README.md has changed");
    }
}
