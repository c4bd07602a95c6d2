//! Every analysis on every kind of body: right, or refused with a reason.
//!
//! A test for each body, which is a column of the table in `tests/README.md`. Each cell runs the program on a coarse body and
//! holds its answer to another route: the same body described otherwise, another solver, the analysis that the study repeats, a
//! difference of two whole analyses. What the program refuses stands in the table with its reason.

mod checks;
mod kinds;

use crate::prelude::*;
use kinds::{Kind, kinds};
use std::cell::RefCell;
use std::collections::HashMap;

/// The summary, and the folder of the results; or the first line of the error.
pub type Answer = Result<(Value, PathBuf), String>;

/// What a cell of the table says; a wrong answer fails the test with its message.
#[derive(Debug, PartialEq)]
pub enum Cell {
    Right,
    Refused(String),
    Wrong(String),
}

/// What stops a check before it is right.
pub type Verdict = Result<(), Cell>;

/// A body's case file in a folder of its own, with the answers of the runs so far.
pub struct Bench {
    folder: TempDir,
    answers: RefCell<HashMap<String, Answer>>,
}

impl Bench {
    fn new(kind: &Kind) -> Self {
        let mesh = kind.mesh.as_deref().unwrap_or_default();
        let folder = folder_with(&[("case.toml", kind.case.as_bytes()), ("body.msh", mesh)]);
        Self { folder, answers: RefCell::default() }
    }

    /// A file beside the case.
    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        fs::write(&path, text).unwrap();
        path
    }

    /// Runs `command` under `overrides`, once for all checks.
    pub fn run(&self, command: &str, overrides: &[&str]) -> Answer {
        let request = format!("{command} {overrides:?}");
        // The borrow ends before an answer is added.
        let known = self.answers.borrow().get(&request).cloned();
        known.unwrap_or_else(|| {
            let answer = self.run_with(command, overrides, &[]);
            self.answers.borrow_mut().insert(request, answer.clone());
            answer
        })
    }

    /// Runs `command` under `overrides`, with `inputs` behind the case.
    pub fn run_with(&self, command: &str, overrides: &[&str], inputs: &[&Path]) -> Answer {
        let case = self.folder.path().join("case.toml");
        self.run_on(command, &[&[case.as_path()], inputs].concat(), overrides, "--no-figures")
    }

    /// Runs `command` on `inputs` alone; `figures` is the option that tells what is drawn.
    pub fn run_on(&self, command: &str, inputs: &[&Path], set: &[&str], figures: &str) -> Answer {
        let out =
            tempfile::Builder::new().prefix("run").tempdir_in(self.folder.path()).unwrap().keep();
        let mut run = Run::new(&[command, "--json"]).args(inputs).set(set);
        if command != "check" {
            run = run.args(&["-qq", figures, "--force"]).out(&out);
        }
        let run = run.end();
        if run.code != Some(0) {
            let line = run.stderr.lines().find(|line| line.starts_with("error"));
            let line = line.unwrap_or_else(|| panic!("{command}: no reason in {}", run.stderr));
            return Err(line.trim_start_matches("error: ").to_owned());
        }
        Ok((run.value(), out))
    }

    /// Draws the figures of a results folder.
    pub fn redraw(&self, folder: &Path) -> Result<(), String> {
        let run = Run::new(&["plot", "-qq", "--format=svg"]).args(&[folder]).end();
        (run.code == Some(0)).then_some(()).ok_or(run.stderr)
    }
}

/// The table of `tests/README.md`: names of its bodies, and each analysis with a cell for each body.
fn stored_table() -> (Vec<String>, Vec<(String, Vec<Cell>)>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/README.md");
    let text = fs::read_to_string(path).unwrap();
    let (_, rest) = text.split_once("<!-- table of bodies and analyses -->\n").unwrap();
    let (table, _) = rest.split_once("<!-- end of the table -->").unwrap();
    let (rows, reasons) = table.split_once("\n\n").unwrap();
    let reasons: Vec<&str> = reasons.lines().map(|line| line.split_once(". ").unwrap().1).collect();
    let words = |row: &str| -> Vec<String> {
        row.trim_matches('|').split('|').map(|word| word.trim().to_owned()).collect()
    };
    let cell = |word: &String| match word.as_str() {
        "right" => Cell::Right,
        number => Cell::Refused(reasons[number.parse::<usize>().unwrap() - 1].to_owned()),
    };
    let mut rows = rows.lines().map(words);
    let names = rows.next().unwrap().split_off(1);
    let rows = rows.skip(1).map(|row| (row[0].clone(), row[1..].iter().map(cell).collect()));
    (names, rows.collect())
}

/// Every analysis of one body is right, or refused with the reason of the table.
fn check_body(name: &str) {
    let (names, table) = stored_table();
    let column = names.iter().position(|other| other == name).expect("a column of the table");
    let kinds = kinds();
    let of = |name: &str| kinds.iter().find(|kind| kind.name == name).expect("a kind of body");
    let (bench, twin) = (Bench::new(of(name)), of(name).twin.map(|twin| Bench::new(of(twin))));
    let mut wrong = String::new();
    for ((analysis, check), (_, row)) in checks::ALL.iter().zip(&table) {
        let found = check(&bench, twin.as_ref()).err().unwrap_or(Cell::Right);
        if found != row[column] {
            wrong += &format!("{analysis}: {found:?}, in tests/README.md {:?}\n", row[column]);
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

/// A test for each body of the table.
macro_rules! bodies {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        fn $test() {
            check_body($name);
        })*

        #[test]
        fn the_table_has_every_body_and_every_analysis() {
            let (names, table) = stored_table();
            assert_eq!(names, [$($name),*]);
            assert_eq!(names, kinds().iter().map(|kind| kind.name).collect::<Vec<_>>());
            let analyses: Vec<&str> = table.iter().map(|(analysis, _)| analysis.as_str()).collect();
            assert_eq!(analyses, checks::ALL.iter().map(|(name, _)| *name).collect::<Vec<_>>());
        }
    };
}

bodies! {
    annulus: "annulus",
    annulus_on_springs: "annulus, springs in the contact",
    annulus_with_stiffening_contact: "annulus, stiffening contact",
    annulus_from_a_file_with_stiffening_contact: "annulus from a file, stiffening contact",
    supported_annulus: "annulus, supported",
    annulus_with_falling_friction: "annulus, falling friction",
    annulus_and_shaft: "annulus and shaft",
    annulus_from_a_file: "annulus from a file",
    orthotropic_annulus: "orthotropic annulus",
    orthotropic_annulus_from_a_file: "orthotropic annulus from a file",
    triangles_from_a_file: "triangles from a file",
    two_materials: "two materials",
    block_that_opens_in_part: "block, contact opens in part",
    two_matching_bodies: "two bodies, matching",
    two_bodies_that_do_not_match: "two bodies, not matching",
    body_of_revolution_with_contact_on_the_edge: "body of revolution, contact on the edge",
    body_of_revolution_with_contact_on_a_face: "body of revolution, contact on a face",
    solid_bodies_tied_and_sliding: "solid bodies, tied and sliding",
    solid_bodies_that_squeal: "solid bodies, squealing",
    solid_bodies_with_stiffening_contact: "solid bodies, stiffening contact",
    solid_of_sectors: "solid of sectors",
}
