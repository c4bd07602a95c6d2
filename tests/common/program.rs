//! The program as a user starts it: a command, its case and overrides, and what it says and leaves.

use super::prelude::*;
use std::ffi::OsStr;
use std::ops::Index;
use std::process::Output;

/// A run that is being put together.
pub struct Run {
    program: Command,
    input: Vec<u8>,
    within: PathBuf,
    out: PathBuf,
    /// The folder of a run that was given none.
    own: Option<TempDir>,
}

/// What a run said, and the folder of its results.
pub struct Answer {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
    pub out: PathBuf,
    own: Option<TempDir>,
}

/// A row of a table, its words by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Row(pub BTreeMap<String, String>);

pub fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub fn shipped(name: &str) -> String {
    format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"))
}

pub fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

pub fn folder_with(files: &[(&str, &[u8])]) -> TempDir {
    let folder = folder();
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

/// A script of the shell in a folder, whose `$0` is the program.
pub fn shell(folder: impl AsRef<Path>, script: &str, words: &[&str]) -> Answer {
    let mut shell = Command::new("sh");
    shell.args(["-c", script, env!("CARGO_BIN_EXE_frictionsim")]).args(words);
    Answer::of(shell.current_dir(&folder).output().unwrap(), folder.as_ref().to_owned(), None)
}

/// The names in a folder, in their order.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap().map(Result::unwrap);
    let names = entries.map(|entry| entry.file_name().into_string().unwrap());
    BTreeSet::from_iter(names).into_iter().collect()
}

/// Every file below a folder.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let paths = names_in(folder).into_iter().map(|name| folder.join(name));
    let below = |path: PathBuf| if path.is_dir() { files_below(&path) } else { vec![path] };
    paths.flat_map(below).collect()
}

impl Run {
    /// The program with any words.
    pub fn new<S: AsRef<OsStr>>(words: &[S]) -> Self {
        let mut program = Command::new(env!("CARGO_BIN_EXE_frictionsim"));
        program.args(words);
        Self { program, input: Vec::new(), within: PathBuf::new(), out: PathBuf::new(), own: None }
    }

    /// A command on a case, without figures.
    pub fn of(command: &str, case: impl AsRef<OsStr>) -> Self {
        let plain = if command == "check" { "-q" } else { "--no-figures" };
        Self::new(&[OsStr::new(command), case.as_ref(), OsStr::new(plain)])
    }

    /// A command on the text of a case, in a file of the folder.
    pub fn of_text(command: &str, folder: &Path, text: &str) -> Self {
        std::fs::write(folder.join("case.toml"), text).unwrap();
        Self::of(command, "case.toml").within(folder)
    }

    pub fn within(mut self, folder: impl AsRef<Path>) -> Self {
        self.within = folder.as_ref().to_owned();
        self.program.current_dir(&self.within);
        self
    }

    /// In a folder of its own that holds these files.
    pub fn beside<T: AsRef<[u8]>>(self, files: &[(&str, T)]) -> Self {
        let files: Vec<_> = files.iter().map(|(name, own)| (*name, own.as_ref())).collect();
        let own = folder_with(&files);
        let run = self.within(&own);
        Self { own: Some(own), ..run }
    }

    pub fn args<S: AsRef<OsStr>>(mut self, words: &[S]) -> Self {
        self.program.args(words);
        self
    }

    /// Changes values, each as `KEY=VALUE`; several stand in one text with ` ; ` between.
    pub fn set<S: AsRef<str>>(mut self, changes: &[S]) -> Self {
        for change in changes.iter().flat_map(|text| text.as_ref().split(" ; ")) {
            self.program.args(["--set", change]);
        }
        self
    }

    pub fn out(mut self, folder: impl AsRef<Path>) -> Self {
        self.out = folder.as_ref().to_owned();
        self.program.arg("--out").arg(&self.out);
        self
    }

    /// What stands on standard input.
    pub fn input(mut self, bytes: Vec<u8>) -> Self {
        self.input = bytes;
        self
    }

    /// The command itself, for runs that are watched or stopped.
    pub fn program(self) -> Command {
        self.program
    }

    /// Runs it to its end, in a temporary folder of its own where it was given none.
    pub fn end(mut self) -> Answer {
        if self.within.as_os_str().is_empty() {
            self = self.beside::<&[u8]>(&[]);
        }
        let [input, output, errors] = [(); 3].map(|()| Stdio::piped());
        let mut child = self.program.stdin(input).stdout(output).stderr(errors).spawn().unwrap();
        // A run that refuses its case does not read on.
        let _ = child.stdin.take().unwrap().write_all(&self.input);
        Answer::of(child.wait_with_output().unwrap(), self.within.join(self.out), self.own)
    }

    /// Starts the run, waits until it has come so far, a minute at most, and ends it: by a signal, at once where there is none.
    #[track_caller]
    pub fn stopped(mut self, signal: Option<&str>, is_due: impl Fn() -> bool) -> Answer {
        self.program.stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = self.program.spawn().unwrap();
        let start = Instant::now();
        while !is_due() {
            assert!(start.elapsed() < Duration::from_secs(60), "not so far after a minute");
            std::thread::sleep(Duration::from_millis(2));
        }
        let id = child.id().to_string();
        match signal {
            Some(name) => {
                assert!(Command::new("kill").args(["-s", name, &id]).status().unwrap().success());
            }
            None => child.kill().unwrap(),
        }
        Answer::of(child.wait_with_output().unwrap(), self.within.join(self.out), self.own)
    }

    /// A run that must end well.
    pub fn done(self) -> Answer {
        self.end().code(0)
    }

    /// A run that must be refused as bad usage or a bad case, with all of these words.
    pub fn refused(self, parts: &[&str]) -> Answer {
        self.end().code(2).warns(parts)
    }
}

impl Answer {
    fn of(output: Output, out: PathBuf, own: Option<TempDir>) -> Self {
        let [stdout, stderr] =
            [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        Self { code: output.status.code(), stdout, stderr, out, own }
    }

    #[track_caller]
    pub fn code(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}", self.said());
        self
    }

    /// What was printed, with errors and warnings.
    pub fn said(&self) -> String {
        format!("{}{}", self.stdout, self.stderr)
    }

    /// Holds what was printed to all of these words.
    #[track_caller]
    pub fn says(self, parts: &[&str]) -> Self {
        has(&self.stdout, parts);
        self
    }

    /// Holds errors and warnings to all of these words.
    #[track_caller]
    pub fn warns(self, parts: &[&str]) -> Self {
        has(&self.stderr, parts);
        self
    }

    /// What was printed, its words a space apart.
    pub fn words(&self) -> String {
        self.stdout.split_whitespace().collect::<Vec<&str>>().join(" ")
    }

    /// What `--json` printed.
    pub fn value(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.out.join(name)
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        let path = self.path(name);
        std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.bytes(name)).unwrap()
    }

    pub fn summary(&self) -> Value {
        self.json("summary.json")
    }

    /// The words of the page, without mark-up, scripts and figures.
    pub fn page(&self) -> String {
        let mut html = self.text("report.html");
        for part in ["script", "style", "svg"] {
            while let Some(start) = html.find(&format!("<{part}")) {
                let end = html[start..].find(&format!("</{part}>")).unwrap();
                html.replace_range(start..start + end + part.len() + 3, "");
            }
        }
        let texts = html.split('<').map(|part| part.split_once('>').map_or("", |own| own.1));
        let text = texts.collect::<Vec<_>>().join("\n");
        let marks =
            [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
        marks.iter().fold(text, |text, (mark, own)| text.replace(mark, own))
    }

    /// The first line of a table.
    pub fn header(&self, name: &str) -> String {
        self.text(name).lines().next().unwrap().to_owned()
    }

    pub fn rows(&self, name: &str) -> Vec<Row> {
        rows(&self.path(name))
    }

    /// Eigenvalues of the modes at a friction coefficient.
    pub fn modes(&self, friction: &str) -> Vec<c64> {
        let rows = self.rows("eigenvalues.csv").into_iter();
        let own = rows.filter(|row| row["friction_coefficient"] == friction);
        let own = own.map(|row| row.numbers(["growth_rate_per_s", "frequency_hz"]));
        own.map(|[growth, hz]| c64::new(growth, TAU * hz)).collect()
    }

    /// Holds the run to files that it must have written, their names a space apart; one behind `!` must not be there.
    #[track_caller]
    pub fn wrote(self, names: &str) -> Self {
        for name in names.split(' ') {
            let own = name.trim_start_matches('!');
            assert_eq!(self.path(own).exists(), own == name, "{name}");
        }
        self
    }
}

impl Row {
    /// The number in a column; NaN where there is none.
    pub fn number(&self, column: &str) -> f64 {
        self[column].parse().unwrap_or(f64::NAN)
    }

    pub fn numbers<const N: usize>(&self, columns: [&str; N]) -> [f64; N] {
        columns.map(|column| self.number(column))
    }
}

impl Index<&str> for Row {
    type Output = String;

    fn index(&self, column: &str) -> &String {
        self.0.get(column).unwrap_or_else(|| panic!("no column {column}: {self:?}"))
    }
}

pub fn rows(path: &Path) -> Vec<Row> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    reader.deserialize().map(|row| Row(row.unwrap())).collect()
}

/// The numbers of some columns, row by row.
pub fn columns<const N: usize>(rows: &[Row], columns: [&str; N]) -> Vec<[f64; N]> {
    rows.iter().map(|row| row.numbers(columns)).collect()
}

pub fn column(rows: &[Row], column: &str) -> Vec<f64> {
    columns(rows, [column]).concat()
}

/// Holds a text to all of these parts, several of which stand in one with ` ; ` between; a part behind `!` must not be there.
#[track_caller]
pub fn has(text: &str, parts: &[&str]) {
    for part in parts.iter().flat_map(|parts| parts.split(" ; ")) {
        match part.strip_prefix('!') {
            Some(never) => assert!(!text.contains(never), "{never:?} is in\n{text}"),
            None => assert!(text.contains(part), "{part:?} is not in\n{text}"),
        }
    }
}
