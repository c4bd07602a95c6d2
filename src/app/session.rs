//! Steps of every run before and after its analysis: read the case, take the output folder, report the results.

use super::{Failure, RunOptions, Told, embedded, input_name, read_input, terminal};
use crate::case::{Case, RawCase, hash_of};
use crate::results::{Finding, Head, MESH, Manifest, OutputFolder, declared};
use crate::{chart::Figure, fem::operator::SimdLevel, output::Document, study::refuse_memory};
use frictionsim_bounds::CASE;
use serde::Serialize;
use std::{path::Path, time::Instant};

/// A validated case on its way through one subcommand.
#[derive(Debug)]
pub struct Session {
    /// The case.
    pub case: Case,
    /// How to run it.
    pub options: RunOptions,
    /// What the results are made from.
    pub manifest: Manifest,
    /// Instruction set of the kernels.
    pub simd: SimdLevel,
    start: Instant,
}

impl Session {
    /// Reads and validates the case, starts the log, and fixes threads and SIMD level.
    ///
    /// # Errors
    /// Everything that can be known to be wrong before the run.
    pub fn start(command: &str, options: &RunOptions) -> Result<Self, Failure> {
        let start = Instant::now();
        terminal::start_log(options.output.quiet, options.output.verbose);
        let case = read_case(&options.case, &options.changes.overrides())?;
        let ignored = case.ignored_by(command);
        if options.changes.deny_warnings {
            case.deny_warnings(&ignored)?;
        }
        // `check` and `mesh` say what an input file has given.
        for note in &case.taken.notes {
            tracing::debug!("{note}");
        }
        for warning in case.warnings.iter().chain(&ignored) {
            tracing::warn!("{warning}");
        }
        let simd = options.simd.map_or_else(|| Ok(SimdLevel::detect()), SimdLevel::available);
        let simd = simd.map_err(Failure::usage)?;
        let manifest = Manifest {
            case_file: options.case.display().to_string(),
            case_text: case.raw.text.clone(),
            case_hash: case.raw.hash(),
            overrides: case.raw.overrides.clone(),
            threads: start_threads(options.threads),
            simd: simd.to_string(),
            ..Manifest::new(command)
        };
        Ok(Self { case, options: options.clone(), manifest, simd, start })
    }

    /// Takes the output folder; it belongs to one effective case. `is_continued`: that of a run that goes on.
    ///
    /// # Errors
    /// Those of [`OutputOptions::open_folder`](super::options::OutputOptions::open_folder).
    pub fn open_folder(&self, is_continued: bool) -> Result<OutputFolder, Failure> {
        let folder = self.options.output.open_folder(&self.manifest, is_continued)?;
        self.keep_inputs(&folder)?;
        Ok(folder)
    }

    /// Takes the folder of a run that keeps nothing when it is interrupted, where the machine has the memory for it.
    ///
    /// # Errors
    /// As [`Self::check_memory`] and [`Self::open_folder`].
    pub fn begin(&self) -> Result<OutputFolder, Failure> {
        self.check_memory(self.case.memory(&self.manifest.command).0)?;
        let folder = self.open_folder(false)?;
        terminal::catch_signals(terminal::NOTHING_KEPT);
        Ok(folder)
    }

    /// Puts the mesh file and the tables beside the results: they can be drawn again without the files in their places.
    pub fn keep_inputs(&self, folder: &OutputFolder) -> Result<(), Failure> {
        let write = |name: &str, bytes: &[u8]| folder.write(name, |out| out.write_all(bytes));
        self.case.raw.mesh.iter().try_for_each(|mesh| write(MESH, &mesh.bytes))?;
        let mut tables = self.case.raw.kept_tables().into_iter();
        Ok(tables.try_for_each(|(name, table)| write(&name, &table.bytes))?)
    }

    /// As [`OutputOptions::finish_result`](super::options::OutputOptions::finish_result), under the title of the case.
    pub fn finish_result(
        &self,
        folder: OutputFolder,
        document: Document,
        summary: &impl Serialize,
        figures: impl FnOnce() -> Vec<Figure>,
    ) -> Result<(), Failure> {
        self.options.output.finish_result(folder, Told::of(self.head(), document), summary, figures)
    }

    /// The same for a finding.
    pub fn finish_finding(&self, folder: OutputFolder, own: &impl Finding) -> Result<(), Failure> {
        let figures = || declared(own.figures());
        self.finish_result(folder, own.document(), own, figures)
    }

    /// What its summary begins with.
    pub fn head(&self) -> Head<'_> {
        Head::of(&self.case.title, self.wall_seconds())
    }

    /// Wall time since the start, s.
    pub fn wall_seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Refuses a run that does not fit the machine's memory.
    ///
    /// # Errors
    /// [`Failure::Case`] at the key that asks for most of it.
    pub fn check_memory(&self, bytes: f64) -> Result<(), Failure> {
        let command = &self.manifest.command;
        Ok(refuse_memory(&self.case, command, bytes, machine_memory())?)
    }
}

/// Takes an argument besides the case, with the content of what it names, into what identifies the results.
pub fn depend_on(manifest: &mut Manifest, argument: String, content: Option<&[u8]>) {
    let content = content.unwrap_or(argument.as_bytes());
    manifest.case_hash = hash_of([manifest.case_hash.as_bytes(), content]);
    manifest.arguments.push(argument);
}

/// Reads and validates a case file.
///
/// # Errors
/// [`Failure::Usage`] if it cannot be read, [`Failure::Case`] if it is not valid.
pub fn read_case(path: &Path, overrides: &[String]) -> Result<Case, Failure> {
    let raw = RawCase::parse(&input_name(path), &read_input(path, CASE)?, overrides)?;
    Ok(Case::from_raw(raw)?)
}

/// Fixes the number of worker threads of the whole process and returns it.
pub fn start_threads(asked: Option<u16>) -> usize {
    if embedded::current().is_some() {
        // The threads of an embedded run are its own.
        return rayon::current_num_threads();
    }
    // None are as many as there are cores.
    let builder = rayon::ThreadPoolBuilder::new().num_threads(asked.map_or(0, usize::from));
    // The pool can be built once; a second session of the same process keeps the first one's.
    let _ = builder.build_global();
    rayon::current_num_threads()
}

/// Memory that this process may still take, bytes: what the kernel holds available, within the limit of the control
/// group. Where the system does not say, more than any workstation has.
pub fn machine_memory() -> f64 {
    available_memory().unwrap_or(1e12)
}

fn available_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    let limit = std::fs::read_to_string("/sys/fs/cgroup/memory.max")
        .ok()
        .and_then(|text| text.trim().parse().ok())
        .unwrap_or(f64::INFINITY);
    Some((1024.0 * kibibytes).min(limit))
}
