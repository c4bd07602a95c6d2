//! Options that subcommands share, and the folder that results go to by default.

use super::{Failure, limits::STANDARD_INPUT, terminal};
use crate::chart::{Figure, WIDEST};
use crate::results::{
    DOTS_PER_INCH, DrawingOptions, Format, Head, Manifest, OutputFolder, Replace, is_result,
    read_manifest, write_page, write_summary, write_tables,
};
use crate::{case::unset, fem::operator::SimdLevel, output::Document};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgAction, Args, ValueHint};
use serde::Serialize;
use serde_json::{Value, json};
use std::path::{Component, Path, PathBuf};

/// The case to run and how.
#[derive(Args, Clone, Debug)]
pub struct RunOptions {
    /// Case file, `-` for standard input
    #[arg(value_name = "CASE.toml", value_hint = ValueHint::FilePath)]
    pub case: PathBuf,
    /// What the command line changes of it.
    #[command(flatten)]
    pub changes: CaseChanges,
    /// Worker threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// SIMD level of the kernels
    #[arg(long, value_parser = one_of(&SIMD_LEVELS), value_name = "LEVEL", default_value = "auto")]
    pub simd: SimdOption,
    /// Where results go and what is said of them.
    #[command(flatten)]
    pub output: OutputOptions,
}

/// A run that keeps what it has finished where it is interrupted.
#[derive(Args, Clone, Debug)]
pub struct ResumedRun {
    /// The case and how to run it.
    #[command(flatten)]
    pub options: RunOptions,
    /// Continue from what an interrupted run has finished, or start from the beginning
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
}

/// What the command line changes of a case.
#[derive(Args, Clone, Debug, Default)]
pub struct CaseChanges {
    /// Override a case key, for example contact.friction_coefficient=0.4 (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Remove a key or section of the case (repeatable; applied before --set)
    #[arg(long = "unset", value_name = "KEY")]
    pub unset: Vec<String>,
    /// Treat warnings about the case as errors
    #[arg(long)]
    pub deny_warnings: bool,
}

impl CaseChanges {
    /// The overrides: what is taken away, then what is set.
    pub fn overrides(&self) -> Vec<String> {
        self.unset.iter().map(|key| unset(key)).chain(self.set.iter().cloned()).collect()
    }
}

/// Where results go and what is said of them.
#[derive(Args, Clone, Debug, Default)]
pub struct OutputOptions {
    /// Output folder; the command line says each command's default.
    #[arg(long, short, help = "Output folder", value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Replace results of another case or table in the output folder, and files that --wav and --uff name
    #[arg(long)]
    pub force: bool,
    /// Check everything and print where results would go, without computing or writing anything
    #[arg(long)]
    pub dry_run: bool,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
    /// How figures are drawn
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Print the summary object, alone, on stdout
    #[arg(long)]
    pub json: bool,
    /// No progress bar and no information messages; twice: errors only, and no table
    #[arg(long, short, action = ArgAction::Count)]
    pub quiet: u8,
    /// Full tables and progress messages
    #[arg(long, short, action = ArgAction::Count, conflicts_with = "quiet")]
    pub verbose: u8,
}

/// What is said of a result.
pub struct Told<'a> {
    /// At the head of its summary.
    pub head: Head<'a>,
    /// On its page.
    pub document: Document,
    /// On the terminal.
    pub text: String,
}

impl<'a> Told<'a> {
    /// One document for both.
    pub fn of(head: Head<'a>, document: Document) -> Self {
        let document = document.titled(head.title.unwrap_or_default());
        Self { head, text: document.to_text(), document }
    }
}

impl OutputOptions {
    /// Whether progress is left out.
    pub fn is_quiet(&self) -> bool {
        self.quiet > 0
    }

    /// The folder for a run, and what it may replace there.
    ///
    /// Without `--out` it is `results/STEM/COMMAND`. Where that holds other results, the folder beside it that is named
    /// after what this run differs in: its overrides, or the folder that its input lies in. `is_continued`: a run that
    /// goes on takes the folder that is there.
    pub fn destination(&self, manifest: &Manifest, is_continued: bool) -> (PathBuf, Replace) {
        let replace = if self.force { Replace::Anything } else { Replace::SameCase };
        if let Some(path) = &self.out {
            return (path.clone(), replace);
        }
        let input = Path::new(&manifest.case_file);
        let stem = match manifest.case_file.as_str() {
            STANDARD_INPUT => std::ffi::OsStr::new("stdin"),
            _ => input.file_stem().unwrap_or(input.as_os_str()),
        };
        let plain = Path::new("results").join(stem).join(&manifest.command);
        let Ok(found) = read_manifest(&plain) else { return (plain, replace) };
        let is_same = found.case_hash == manifest.case_hash && found.command == manifest.command;
        if is_same || self.force {
            return (plain, replace);
        }
        let Some(difference) = difference(manifest, &found) else { return (plain, replace) };
        let own = plain.with_file_name(format!("{}-{difference}", manifest.command));
        if is_continued && !own.exists() {
            return (plain, replace);
        }
        tracing::info!(
            "{} keeps the results of an earlier run; writing to {} instead",
            plain.display(),
            own.display()
        );
        (own, replace)
    }

    /// As [`Self::destination`], where the run may have that. With `--dry-run` says instead which one it would be.
    ///
    /// # Errors
    /// Those of [`OutputFolder::may_open`]; [`Failure::DryRun`].
    pub fn find_folder(
        &self,
        manifest: &Manifest,
        is_continued: bool,
    ) -> Result<(PathBuf, Replace), Failure> {
        let (path, replace) = self.destination(manifest, is_continued);
        if is_continued && !path.exists() {
            tracing::warn!("{} does not exist: starting from the beginning", path.display());
        }
        if replace == Replace::Anything {
            refuse_input_inside(&path, Path::new(&manifest.case_file))?;
        }
        if self.dry_run {
            OutputFolder::may_open(&path, manifest, replace)?;
            return Err(self.dry_run_at(&path, manifest));
        }
        Ok((path, replace))
    }

    /// Takes the folder of a run.
    ///
    /// # Errors
    /// Those of [`Self::find_folder`] and [`OutputFolder::open`].
    pub fn open_folder(&self, manifest: &Manifest, goes_on: bool) -> Result<OutputFolder, Failure> {
        let (path, replace) = self.find_folder(manifest, goes_on)?;
        Ok(OutputFolder::open(&path, manifest, replace)?)
    }

    /// Prints the summary as JSON, or the table for people and where the files are.
    pub fn print(&self, table: &str, summary: &Value, folder: &Path) -> Result<(), Failure> {
        match self.quiet {
            _ if self.json => terminal::print_json(summary),
            0 | 1 => terminal::print(&format!("{table}results in {}\n", folder.display())),
            _ => Ok(()),
        }
    }

    /// How figures are drawn, if they are.
    pub fn drawing(&self) -> Option<DrawingOptions> {
        (!self.no_figures).then(|| self.figures.drawing())
    }

    /// Completes the output folder and prints as [`Self::print`].
    pub fn finish(&self, folder: OutputFolder, text: &str, summary: &Value) -> Result<(), Failure> {
        let path = folder.destination().to_owned();
        folder.finish()?;
        self.print(text, summary, &path)
    }

    /// Writes the tables, the figures, the page and the summary of a result; gives what is printed of it, for people
    /// and as an object.
    pub fn write_result(
        &self,
        folder: &OutputFolder,
        told: Told<'_>,
        summary: &impl Serialize,
        figures: impl FnOnce() -> Vec<Figure>,
    ) -> Result<(String, Value), Failure> {
        write_tables(folder, &told.document)?;
        if let Some(options) = self.drawing() {
            write_page(folder, told.document, figures(), &options)?;
        }
        Ok((told.text, write_summary(folder, told.head, summary)?))
    }

    /// The same, completes the folder and prints.
    pub fn finish_result(
        &self,
        folder: OutputFolder,
        told: Told<'_>,
        summary: &impl Serialize,
        figures: impl FnOnce() -> Vec<Figure>,
    ) -> Result<(), Failure> {
        let (text, object) = self.write_result(&folder, told, summary, figures)?;
        self.finish(folder, &text, &object)
    }

    /// Says what a run would do; the end of a dry run.
    pub fn dry_run_at(&self, path: &Path, manifest: &Manifest) -> Failure {
        let replaces = path.join("manifest.json").exists();
        let (Manifest { command, case_file, .. }, folder) = (manifest, path.display());
        let said = if self.json {
            terminal::print_json(&json!({
                "command": command,
                "dry_run": true,
                "folder": folder.to_string(),
                "replaces": replaces,
            }))
        } else {
            let verb = if replaces { "would replace the results in" } else { "would write to" };
            terminal::print(&format!("{case_file}: valid; {command} {verb} {folder}\n"))
        };
        said.err().unwrap_or(Failure::DryRun)
    }
}

/// Refuses to replace what lies in a folder where that might be the input itself: all there but cases that no run
/// wrote.
fn refuse_input_inside(folder: &Path, input: &Path) -> Result<(), Failure> {
    let (Ok(folder), Ok(input)) = (folder.canonicalize(), input.canonicalize()) else {
        return Ok(());
    };
    let Ok(name) = input.strip_prefix(&folder) else { return Ok(()) };
    let is_case = name.extension().is_some_and(|extension| extension == "toml");
    if is_case && !is_result(&folder, name) {
        return Ok(());
    }
    Err(Failure::usage(format!(
        "--force would replace {}, which is the input: choose another folder with --out, or move \
        the file out of this one",
        input.display()
    )))
}

/// What tells a run from the one whose results are there, fit for a folder's name.
fn difference(ours: &Manifest, found: &Manifest) -> Option<String> {
    let mut parts = Vec::new();
    if ours.case_file != found.case_file {
        let folders = Path::new(&ours.case_file).parent()?.components();
        let names = folders.filter_map(|part| match part {
            Component::Normal(name) => name.to_str(),
            _ => None,
        });
        let names: Vec<&str> = names.filter(|name| *name != "results").collect();
        let last = &names[names.len().saturating_sub(2)..];
        parts.extend((!last.is_empty()).then(|| last.join("-")));
    }
    if ours.arguments != found.arguments {
        parts.extend(ours.arguments.iter().map(|text| match text.strip_prefix("--") {
            Some(option) => option.replacen(' ', "=", 1),
            None => text.clone(),
        }));
    }
    let last = |key: &str| key.trim().rsplit('.').next().unwrap_or(key).to_owned();
    parts.extend(ours.overrides.iter().map(|text| match text.split_once('=') {
        Some((key, value)) => format!("{}={}", last(key), value.trim()),
        None => format!("no_{}", last(text.trim_start_matches("unset "))),
    }));
    let fit = |c: char| match c {
        c if c.is_alphanumeric() || "=.,+-_".contains(c) => c,
        _ => '_',
    };
    let name: String = parts.join(",").chars().map(fit).collect();
    match name.chars().count() {
        0 => None,
        1..=LONGEST_NAME => Some(name),
        // Cut, and made one of its kind again by the hash of the case.
        _ => {
            let head: String = name.chars().take(LONGEST_NAME).collect();
            let hash: String = ours.case_hash.chars().take(8).collect();
            Some(format!("{head}-{hash}"))
        }
    }
}

/// Longest part of a folder's name that is made from overrides or the names of runs, characters.
pub const LONGEST_NAME: usize = 100;

/// A SIMD level, or the widest that the machine has.
pub type SimdOption = Option<SimdLevel>;

/// SIMD levels that may be asked for, each with its word.
pub const SIMD_LEVELS: [Choice<SimdOption>; 4] = [
    ("auto", None, "The widest that the machine has"),
    ("scalar", Some(SimdLevel::Scalar), "No vector instructions"),
    ("avx2", Some(SimdLevel::Avx2), "AVX2 with FMA"),
    ("avx512", Some(SimdLevel::Avx512), "AVX-512"),
];

/// Resolution, width and formats of the figures.
#[derive(Args, Clone, Debug)]
pub struct FigureOptions {
    /// Resolution of the PNG figures, dots per inch
    #[arg(long, value_name = "DPI", default_value_t = DOTS_PER_INCH, value_parser = resolution)]
    dpi: f64,
    /// Width of the figures: "column" (85 mm), "page" (178 mm) or mm [default: each figure's own]
    #[arg(long, value_name = "WIDTH", value_parser = width)]
    width: Option<f64>,
    /// Formats of the figures
    #[arg(
        long,
        value_parser = one_of(&FORMATS),
        value_name = "FORMAT",
        value_delimiter = ',',
        default_value = "svg,png,pdf"
    )]
    format: Vec<Format>,
}

/// Formats of figures, each with its word.
const FORMATS: [Choice<Format>; 3] = [
    ("svg", Format::Svg, "Lines, text as text"),
    ("png", Format::Png, "Pixels"),
    ("pdf", Format::Pdf, "Lines, text as outlines"),
];

impl Default for FigureOptions {
    fn default() -> Self {
        let format = FORMATS.map(|choice| choice.1).into();
        Self { dpi: DOTS_PER_INCH, width: None, format }
    }
}

impl FigureOptions {
    /// What the drawing needs to know.
    pub fn drawing(&self) -> DrawingOptions {
        let formats = self.format.clone();
        DrawingOptions { dots_per_inch: self.dpi, width_mm: self.width, formats }
    }
}

fn resolution(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(dpi) if (20.0..=1200.0).contains(&dpi) => Ok(dpi),
        _ => Err("20 to 1200 dots per inch".to_owned()),
    }
}

fn width(text: &str) -> Result<f64, String> {
    match (text, text.trim_end_matches("mm").trim().parse::<f64>()) {
        ("column", _) => Ok(85.0),
        ("page", _) => Ok(178.0),
        (_, Ok(width)) if (60.0..=WIDEST).contains(&width) => Ok(width),
        _ => Err(format!("\"column\", \"page\" or 60 to {WIDEST} mm")),
    }
}

/// A word, what it stands for, and what the help says of it.
pub type Choice<T> = (&'static str, T, &'static str);

/// Takes one of the words for what it stands for.
pub fn one_of<T: Copy + Send + Sync>(
    choices: &'static [Choice<T>],
) -> impl TypedValueParser<Value = T> {
    let words = choices.iter().map(|choice| PossibleValue::new(choice.0).help(choice.2));
    PossibleValuesParser::new(words).try_map(|given| {
        let found = choices.iter().find(|choice| choice.0 == given);
        found.map(|choice| choice.1).ok_or("none of these words")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(file: &str, overrides: &[&str]) -> Manifest {
        Manifest {
            case_file: file.to_owned(),
            overrides: overrides.iter().map(|&text| text.to_owned()).collect(),
            ..Manifest::new("transient")
        }
    }

    #[test]
    fn a_folder_beside_the_default_is_named_after_what_the_run_differs_in() {
        let plain = manifest("disc.toml", &[]);
        let other_speed = manifest("disc.toml", &["contact.rotation_speed_rpm = 2000"]);
        let name = difference(&other_speed, &plain);
        assert_eq!(name.as_deref(), Some("rotation_speed_rpm=2000"));
        let table = manifest("results/70rpm/transient/probe-1641.csv", &[]);
        let table = Manifest { arguments: vec!["--from 0.01".to_owned()], ..table };
        let other_table = manifest("results/610rpm/transient/probe-1641.csv", &[]);
        let name = difference(&table, &other_table);
        assert_eq!(name.as_deref(), Some("70rpm-transient,from=0.01"));
        assert_eq!(difference(&plain, &other_speed), None);
        let path = manifest("disc.toml", &["mesh.file=\"../rig.msh\""]);
        let name = difference(&path, &plain).unwrap();
        assert!(!name.contains('/') && !name.contains('"'), "{name}");
    }
}
