//! The case exactly as its TOML says it: a tree of values that know where they were written.

use super::value::{convert_table, leaves, quote, table_of, with_point};
use super::{Source, diagnostic::BACKSLASH, keys, overrides};
use crate::*;
use frictionsim_physics::mesh::MeshFileError;
use sha2::{Digest, Sha256};
use std::{collections::HashSet, path::PathBuf, sync::OnceLock};
use toml::de::DeTable;

/// A parsed, not yet validated case: the file's TOML with the overrides laid over it.
#[derive(Clone, Debug, PartialEq)]
pub struct RawCase {
    /// Name of the case file as the user gave it.
    pub name: String,
    /// Text of the case file.
    pub text: String,
    /// Overrides `KEY=VALUE` in the order given.
    pub overrides: Vec<String>,
    /// The effective tree.
    pub root: RawTable,
    /// The mesh file, once it is read.
    pub mesh: Option<MeshBytes>,
    /// Tables beside the case, once they are read.
    pub tables: Vec<TableBytes>,
}

/// A table of a case as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct TableBytes {
    /// Its name in the case.
    pub file: String,
    /// What it holds.
    pub bytes: Arc<[u8]>,
}

impl TableBytes {
    /// The name under which the table of a section, named by a key, lies beside the results.
    pub fn kept_as(key: &str, section: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        format!("{key}-{}.csv", section.chars().map(plain).collect::<String>())
    }
}

/// A mesh file as it was read.
#[derive(Clone, Debug)]
pub struct MeshBytes {
    /// Its name in the case.
    pub file: String,
    /// What it holds, the text of files that it includes in their places.
    pub bytes: Arc<[u8]>,
    /// What its text says, once that is asked for.
    parsed: Arc<OnceLock<Result<Arc<FileMesh>, MeshFileError>>>,
}

impl PartialEq for MeshBytes {
    fn eq(&self, other: &Self) -> bool {
        self.file == other.file && self.bytes == other.bytes
    }
}

impl MeshBytes {
    /// The bytes of the mesh file that a case calls `file`.
    pub fn new(file: String, bytes: impl Into<Arc<[u8]>>) -> Self {
        Self { file, bytes: bytes.into(), parsed: Arc::default() }
    }

    /// The mesh and what the file holds beside it; read once.
    ///
    /// # Errors
    /// [`MeshFileError`] with the line, or the byte of a binary file.
    pub fn read(&self) -> Result<Arc<FileMesh>, MeshFileError> {
        let read = || FileMesh::read_as(&self.file, &self.bytes).map(Arc::new);
        self.parsed.get_or_init(read).clone()
    }
}

impl RawCase {
    /// Parses the bytes of a case file and lays the overrides over it.
    ///
    /// An override is one TOML assignment to a dotted key, `contact.friction_coefficient=0.4`; a value that is not TOML
    /// is taken as a string, so that `mesh.element=quad8` needs no quotes. Nothing is validated here but the syntax.
    ///
    /// # Errors
    /// [`CaseErrors`] with every syntax error of the file and of the overrides.
    pub fn parse(name: &str, bytes: &[u8], overrides: &[String]) -> Result<Self, CaseErrors> {
        let (name, mut diagnostics) = (name.to_owned(), Vec::new());
        let (text, root) = match readable_text(bytes) {
            Ok(text) => (text.to_owned(), parse_document(text, 0, &mut diagnostics)),
            Err((error, text)) => {
                diagnostics.push(error);
                (text, RawTable::new())
            }
        };
        let (mesh, tables) = (None, Vec::new());
        Self { name, text, overrides: Vec::new(), root, mesh, tables }.lay(overrides, diagnostics)
    }

    /// Lays overrides over the case, or gives the errors so far and theirs.
    fn lay(mut self, texts: &[String], mut errors: Vec<Diagnostic>) -> Result<Self, CaseErrors> {
        for text in texts {
            self.overrides.push(text.clone());
            let laid = overrides::lay(&mut self.root, text, self.overrides.len());
            errors.extend(laid.err().into_iter().flatten());
        }
        if errors.is_empty() { Ok(self) } else { Err(self.errors(errors)) }
    }

    /// This case with further overrides, as a sweep makes its points.
    pub fn with_overrides(&self, further: &[String]) -> Result<Self, CaseErrors> {
        self.clone().lay(further, Vec::new())
    }

    /// The point of a parameter study that `overrides` make: a case of its own without `[sweep]`, so
    /// that its hash stays the same when the study gains other points.
    pub fn sweep_point(&self, overrides: &[String]) -> Result<Self, CaseErrors> {
        let mut point = self.with_overrides(overrides)?;
        point.root.remove("sweep");
        Ok(point)
    }

    /// The effective case as canonical TOML, one `section.key = value` line for each key: comments,
    /// white space and the way a number is written leave no trace.
    pub fn canonical(&self) -> String {
        let leaves = leaves(&self.root, quote);
        leaves.iter().map(|(path, value)| format!("{path} = {value}\n")).collect()
    }

    /// SHA-256 of [`RawCase::canonical`], and of the mesh file and tables where there are any, in hexadecimal.
    pub fn hash(&self) -> String {
        let canonical = self.canonical();
        let mesh = self.mesh.iter().map(|mesh| &mesh.bytes[..]);
        let tables = self.tables.iter().map(|table| &table.bytes[..]);
        hash_of(std::iter::once(canonical.as_bytes()).chain(mesh).chain(tables))
    }

    /// Tables that the case names, each with the name under which it lies beside the results.
    pub fn table_files(&self) -> Vec<(String, String)> {
        let own = self.find("material.table").and_then(|item| item.value.text());
        let own = own.map(|file| ("material-table.csv".to_owned(), file.to_owned()));
        let mut found: Vec<(String, String)> = own.into_iter().collect();
        for (group, key) in [("materials", "table"), ("contacts", "gap")] {
            let Some(sections) = table_of(&self.root, group) else { continue };
            for name in sections.keys() {
                let own = table_of(sections, name).and_then(|own| own.get(key));
                let file = own.and_then(|own| own.value.text());
                found.extend(file.map(|file| (TableBytes::kept_as(key, name), file.to_owned())));
            }
        }
        found
    }

    /// The tables that were read, each with the name under which it lies beside the results.
    pub fn kept_tables(&self) -> Vec<(String, &TableBytes)> {
        let of = |file: String| self.tables.iter().find(|table| table.file == file);
        let kept = self.table_files().into_iter();
        kept.filter_map(|(name, file)| Some((name, of(file)?))).collect()
    }

    /// This case without some of its keys.
    pub fn without(&self, keys: &[&str]) -> Self {
        let mut case = self.clone();
        for key in keys {
            // One that is not there may go, too.
            let _ = overrides::lay(&mut case.root, &overrides::unset(key), 0);
        }
        case
    }

    /// The first key that has another value in `other`, in words: `section.key is 1 here, 2`.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let (ours, theirs) = (self.canonical(), other.canonical());
        let lines_of = |text| str::lines(text).collect::<HashSet<&str>>();
        let [our_lines, their_lines] = [&*ours, &*theirs].map(lines_of);
        let of_ours = ours.lines().find(|line| !their_lines.contains(line));
        let of_theirs = theirs.lines().find(|line| !our_lines.contains(line));
        let (key, _) = of_ours.or(of_theirs)?.split_once(" = ")?;
        let value = |text: &str| {
            let mut assignments = text.lines().filter_map(|line| line.split_once(" = "));
            let found = assignments.find(|(name, _)| *name == key);
            found.map_or("not given".to_owned(), |(_, value)| value.to_owned())
        };
        Some(format!("{key} is {} here, {}", value(&ours), value(&theirs)))
    }

    /// Bundles diagnostics with the texts they point into, unknown keys first: others may be missing for a slip in one.
    pub fn errors(&self, mut diagnostics: Vec<Diagnostic>) -> CaseErrors {
        diagnostics.sort_by_key(|own| !own.message.starts_with("unknown key"));
        let mut sources = vec![Source { name: self.name.clone(), text: self.text.clone() }];
        sources.extend(self.overrides.iter().map(|text| overrides::source(text)));
        CaseErrors { sources, diagnostics }
    }

    /// The path of a file that the case names, which is relative to it.
    pub(super) fn beside(&self, file: &str) -> PathBuf {
        Path::new(&self.name).parent().unwrap_or(Path::new("")).join(file)
    }

    /// Where the case ends.
    pub(super) fn end(&self) -> Location {
        let end = self.text.trim_end().len();
        Location::new(0, end..end)
    }

    /// Where a dotted key is written, else the nearest section around it.
    pub fn place(&self, key: &str) -> Location {
        let key = keys::dotted(key);
        let names = std::iter::successors(Some(&*key), |name| Some(name.rsplit_once('.')?.0));
        let mut items = names.filter_map(|name| self.find(name));
        items.next().map(|item| item.at.clone()).unwrap_or_default()
    }

    /// The value of a dotted key, if the case gives it.
    pub fn find(&self, key: &str) -> Option<&RawItem> {
        let mut table = &self.root;
        let key = keys::dotted(key);
        let mut parts = key.split('.').peekable();
        while let Some(part) = parts.next() {
            let item = table.get(part)?;
            match (&item.value, parts.peek()) {
                (_, None) => return Some(item),
                (RawValue::Table(inner), Some(_)) => table = inner,
                (RawValue::Array(items), Some(place)) => {
                    return items.get(keys::list_place(place)?);
                }
                _ => return None,
            }
        }
        None
    }
}

/// The text of a case file; else what it is instead, and as much of it as is fit to be shown.
fn readable_text(bytes: &[u8]) -> Result<&str, (Diagnostic, String)> {
    let refuse = |message: &str, at: std::ops::Range<usize>, shown: String| {
        let label = if at.is_empty() { "" } else { "the first invalid byte" };
        let at = Location::new(0, at);
        Err((placed!(at, "{message}"; "{label}"; "save the file as UTF-8 text"), shown))
    };
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return refuse("the case file is UTF-16 text, not UTF-8", 0..0, String::new());
    }
    if bytes.contains(&0) {
        return refuse("the case file is no text: it holds zero bytes", 0..0, String::new());
    }
    std::str::from_utf8(bytes).or_else(|error| {
        let start = error.valid_up_to();
        let shown = String::from_utf8_lossy(bytes).into_owned();
        refuse("the case file is not UTF-8 text", start..start + 1, shown)
    })
}

/// Parses a whole document; syntax errors are added to `diagnostics`.
fn parse_document(text: &str, source: usize, diagnostics: &mut Vec<Diagnostic>) -> RawTable {
    let (table, errors) = DeTable::parse_recoverable(text);
    if let (false, Some(other)) = (errors.is_empty(), foreign(text)) {
        let first_line = 0..text.find('\n').unwrap_or(text.len());
        diagnostics.push(placed!(Location::new(source, first_line),
            "this is {other}, not a case"; "expected a section such as [geometry], or a key";
            "`frictionsim init` writes a case to start from"));
        return RawTable::new();
    }
    for error in &errors {
        let span = error.span().unwrap_or(0..0);
        let help = match error.message().contains("escape") {
            true => Some(BACKSLASH.to_owned()),
            false => decimal_comma(text, span.start),
        };
        diagnostics.push(Diagnostic::error(error.message(), "", Location::new(source, span), help));
    }
    convert_table(table.get_ref(), source, diagnostics)
}

/// What a text is that is no TOML at all.
fn foreign(text: &str) -> Option<&'static str> {
    let begin = text.trim_start();
    let known = [
        ("$MeshFormat", "a Gmsh mesh (a case names it as mesh.file)"),
        ("{", "a JSON file"),
        ("<", "an XML or HTML file"),
    ];
    if let Some((_, what)) = known.iter().find(|(head, _)| begin.starts_with(head)) {
        return Some(what);
    }
    let mut rows = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let is_row = |line: &str| {
        let has_columns = line.contains([',', ';', '\t']);
        has_columns && !line.contains('=') && !line.starts_with(['[', '#'])
    };
    // The first rows tell: a case has an assignment or a section among them.
    let (first, second) = (rows.next()?, rows.next()?);
    (is_row(first) && is_row(second)).then_some("a table of values")
}

/// A hint where the line of a syntax error gives a number with a decimal comma, or no value.
fn decimal_comma(text: &str, at: usize) -> Option<String> {
    let begin = text.get(..at)?.rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[begin..].lines().next()?;
    let value = line.split_once('=')?.1.trim();
    if value.is_empty() {
        return Some("write a value behind the `=`".to_owned());
    }
    let number = with_point(value)?;
    Some(format!("write the number with a decimal point, not a comma: {number}"))
}

/// SHA-256 of parts one behind the other, in hexadecimal.
pub fn hash_of<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> String {
    let mut digest = Sha256::new();
    parts.into_iter().for_each(|part| digest.update(part));
    format!("{:x}", digest.finalize())
}
