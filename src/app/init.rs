//! `frictionsim init`: a commented case to start from.

use super::prelude::*;
use super::shipped::{ShippedCase, ShippedFile, all_cases, all_files};
use crate::case::{case_from, reference};
use std::fmt::Write as _;
use std::{fs::File, io::Write};

/// Short names of shipped cases.
const SHORT_NAMES: &[(&str, &str)] = &[
    ("cea", "polycarbonate-disc"),
    ("transient", "polycarbonate-610rpm"),
    ("sweep", "speed-friction-study"),
    ("cycle", "limit-cycle"),
    ("frf", "hammer-test"),
    ("fit", "fit-table-1"),
    ("uncertainty", "squeal-probability"),
    ("mesh", "sliding-block"),
    ("two-bodies", "pad-on-disc"),
    ("three-dimensions", "ring-on-disc"),
];

/// The case that is made from the declarations of the keys.
const REFERENCE: &str = "reference";

/// Write a commented case to start from
#[derive(Args)]
pub struct Arguments {
    /// Shipped case or its short name; see --list
    #[arg(default_value = "cea")]
    template: String,
    /// Mesh file to start from: of Abaqus or CalculiX, Nastran, Gmsh, or a universal file; the case has all that the
    /// file holds
    #[arg(long, value_name = "MESH", value_hint = ValueHint::FilePath, conflicts_with = "template")]
    from: Option<PathBuf>,
    /// File to write, `-` for stdout; its meshes and tables go beside it [default: <TEMPLATE>.toml, with --from beside
    /// the mesh]. With --all the folder to write to [default: cases]
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// List the shipped cases and their short names
    #[arg(long)]
    list: bool,
    /// Write every shipped case with its meshes and tables
    #[arg(long, conflicts_with = "list")]
    all: bool,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    if asked.list {
        return terminal::print(&list());
    }
    if asked.all {
        let folder = asked.out.clone().unwrap_or_else(|| PathBuf::from("cases"));
        let files: Vec<_> = missing(&folder, all_files()).collect();
        return write_files(&files, asked.force);
    }
    if let Some(mesh) = &asked.from {
        return start_from(mesh, asked);
    }
    let name = asked.template.as_str();
    let case = if name == REFERENCE { None } else { Some(find(name)?) };
    let path = asked.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let is_stdout = path == Path::new("-");
    let shown = match path.file_name() {
        Some(name) if !is_stdout => name.to_string_lossy().into_owned(),
        _ => format!("{name}.toml"),
    };
    let text = case.as_ref().map_or_else(reference::template, |case| case.named(&shown));
    if is_stdout {
        return terminal::print(&text);
    }
    let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let beside = case.map_or(Vec::new(), |case| case.files());
    let mut files = vec![(path, text.as_bytes())];
    files.extend(missing(&folder, beside));
    write_files(&files, asked.force)
}

/// Every shipped case with its short name and its title, one on a line.
fn list() -> String {
    let cases = all_cases();
    let line = |name: &str, short: &str, title: &str| format!("{name:<40}  {short:<16}  {title}\n");
    let short = |case: &ShippedCase| SHORT_NAMES.iter().find(|pair| pair.1 == case.name());
    let lines = cases
        .iter()
        .map(|case| line(case.name(), short(case).map_or("", |pair| pair.0), case.title()));
    let all = "every key of a case with its default and meaning";
    lines.chain([line(REFERENCE, "", all)]).collect()
}

/// Shipped files that a folder does not hold as they would be written.
fn missing<'a>(
    folder: &'a Path,
    files: Vec<ShippedFile>,
) -> impl Iterator<Item = (PathBuf, &'a [u8])> {
    let placed = files
        .into_iter()
        .map(move |(name, bytes)| -> (PathBuf, &'a [u8]) { (folder.join(name), bytes) });
    placed.filter(|(path, bytes)| std::fs::read(path).ok().as_deref() != Some(*bytes))
}

/// Writes all files or, where one exists, none, and says which.
fn write_files(files: &[(PathBuf, &[u8])], force: bool) -> Result<(), Failure> {
    let is_there = |(path, _): &&(PathBuf, &[u8])| path.symlink_metadata().is_ok();
    if let Some((path, _)) = files.iter().find(is_there).filter(|_| !force) {
        return Err(exists(path));
    }
    let mut written = String::new();
    for (path, bytes) in files {
        write(path, bytes, force)?;
        let _ = writeln!(written, "{}", path.display());
    }
    terminal::print(&written)
}

/// Writes the case that a mesh file suggests, beside it unless told otherwise.
fn start_from(mesh: &Path, arguments: &Arguments) -> Result<(), Failure> {
    let path = arguments.out.clone().unwrap_or_else(|| mesh.with_extension("toml"));
    let is_stdout = path == Path::new("-");
    // The case names the mesh as seen from its own folder.
    let folder = path.parent().unwrap_or(Path::new(""));
    let shown = match mesh.strip_prefix(folder) {
        Ok(inside) if !is_stdout => inside.to_path_buf(),
        _ if is_stdout || folder.as_os_str().is_empty() => mesh.to_path_buf(),
        _ => std::path::absolute(mesh).unwrap_or_else(|_| mesh.to_path_buf()),
    };
    let Some(name) = shown.to_str() else {
        return Err(Failure::usage(format!(
            "{}: the name is not UTF-8, as a case must name its mesh: rename the file or its folder",
            shown.display()
        )));
    };
    let text = case_from(mesh, name).map_err(Failure::usage)?;
    if is_stdout {
        return terminal::print(&text);
    }
    write_files(&[(path, text.as_bytes())], arguments.force)
}

/// The shipped case of a name or short name.
fn find(name: &str) -> Result<ShippedCase, Failure> {
    let short = SHORT_NAMES.iter().find(|pair| pair.0 == name);
    let own = short.map_or(name, |pair| pair.1);
    let cases = all_cases();
    cases.iter().find(|case| case.name() == own).copied().ok_or_else(|| {
        let short = SHORT_NAMES.iter().map(|pair| pair.0);
        let names = short.chain([REFERENCE]).chain(cases.iter().map(ShippedCase::name));
        let names: Vec<&str> = names.collect();
        Failure::usage(format!("no template \"{name}\": choose one of {}", names.join(", ")))
    })
}

fn exists(path: &Path) -> Failure {
    Failure::usage(format!(
        "{} exists: replace it with --force, or name another file with --out",
        path.display()
    ))
}

fn write(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let failed = |error| Failure::run(format!("cannot write {}: {error}", path.display()));
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    let file = if force { File::create(path) } else { File::create_new(path) };
    let result = file.and_then(|mut file| file.write_all(bytes));
    result.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => exists(path),
        _ => failed(error),
    })
}
