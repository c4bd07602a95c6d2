//! What every run does before and after its analysis: read the case, take the output folder, say
//! what came out.

use super::terminal;
use super::{Failure, RunOptions};
use crate::case::{Case, RawCase};
use crate::results::{Manifest, OutputFolder, Replace};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A validated case on its way through one subcommand.
#[derive(Debug)]
pub struct Session {
    /// The case.
    pub case: Case,
    /// How to run it.
    pub options: RunOptions,
    /// What the results are made from.
    pub manifest: Manifest,
    start: Instant,
}

impl Session {
    /// Reads and validates the case, starts the log, and fixes threads and SIMD level.
    ///
    /// # Errors
    /// Everything that can be known to be wrong before the run.
    pub fn start(command: &str, options: &RunOptions) -> Result<Self, Failure> {
        let start = Instant::now();
        terminal::start_log(options.quiet);
        let case = read_case(&options.case, &options.set)?;
        for warning in &case.warnings {
            tracing::warn!("{warning}");
        }
        let simd = options.simd.resolve().ok_or_else(|| {
            Failure::usage(format!(
                "--simd {:?} is not available on this machine: use --simd auto",
                options.simd
            ))
        })?;
        let manifest = Manifest {
            case_file: options.case.display().to_string(),
            case_text: case.raw.text.clone(),
            case_hash: case.raw.hash(),
            overrides: case.raw.overrides.clone(),
            threads: start_threads(options.threads),
            simd: simd.to_owned(),
            ..Manifest::new(command)
        };
        Ok(Self {
            case,
            options: options.clone(),
            manifest,
            start,
        })
    }

    /// Takes the output folder.
    ///
    /// The default folder belongs to the case file: a run of the same file with other overrides may
    /// replace it. A folder named by `--out` belongs to one effective case.
    ///
    /// # Errors
    /// Those of [`OutputFolder::open`].
    pub fn open_folder(&self) -> Result<OutputFolder, Failure> {
        let replace = match (&self.options.out, self.options.force) {
            (_, true) => Replace::Anything,
            (Some(_), false) => Replace::SameCase,
            (None, false) => Replace::SameText,
        };
        Ok(OutputFolder::open(
            &self.folder_path(),
            &self.manifest,
            replace,
        )?)
    }

    /// Takes the output folder of a run that goes on: it must hold this very case.
    ///
    /// # Errors
    /// Those of [`OutputFolder::open`].
    pub fn reopen_folder(&self) -> Result<OutputFolder, Failure> {
        let path = self.folder_path();
        Ok(OutputFolder::open(
            &path,
            &self.manifest,
            Replace::SameCase,
        )?)
    }

    /// Where the output folder is.
    pub fn folder_path(&self) -> PathBuf {
        match &self.options.out {
            Some(path) => path.clone(),
            None => default_folder(&self.options.case, &self.manifest.command),
        }
    }

    /// Wall time since the start, s.
    pub fn wall_seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Refuses a run that does not fit the machine's memory; `keys` say what to lower.
    ///
    /// # Errors
    /// [`Failure::Case`] at the mesh.
    pub fn check_memory(&self, bytes: f64) -> Result<(), Failure> {
        match available_memory() {
            Some(available) if bytes > available => Err(Failure::Case(self.case.error_at(
                "mesh.circumferential_elements",
                format!(
                    "the case needs about {:.1} GiB of memory, {:.1} GiB are available",
                    gibibytes(bytes),
                    gibibytes(available)
                ),
                "too many elements for this machine".to_owned(),
                Some("lower mesh.circumferential_elements or mesh.radial_elements".to_owned()),
            ))),
            _ => Ok(()),
        }
    }

    /// Prints the summary as JSON, or the table for people and where the files are.
    ///
    /// # Errors
    /// Those of stdout.
    pub fn print(
        &self,
        table: &str,
        summary: &serde_json::Value,
        folder: &Path,
    ) -> Result<(), Failure> {
        if self.options.json {
            terminal::print_json(summary)
        } else {
            terminal::print(&format!("{table}results in {}\n", folder.display()))
        }
    }
}

/// Reads and validates a case file.
///
/// # Errors
/// [`Failure::Usage`] if it cannot be read, [`Failure::Case`] if it is not valid.
pub fn read_case(path: &Path, overrides: &[String]) -> Result<Case, Failure> {
    let bytes = std::fs::read(path)
        .map_err(|error| Failure::usage(format!("cannot read {}: {error}", path.display())))?;
    let raw = RawCase::parse(&path.display().to_string(), &bytes, overrides)?;
    Ok(Case::from_raw(raw)?)
}

/// `results/<case file stem>/<command>`.
fn default_folder(case: &Path, command: &str) -> PathBuf {
    let stem = case.file_stem().unwrap_or(case.as_os_str());
    Path::new("results").join(stem).join(command)
}

/// Fixes the number of worker threads of the whole process and returns it.
pub fn start_threads(asked: Option<u16>) -> usize {
    // Threads belong to the outer loops (friction values, harmonics); inside them faer would only
    // make small factorizations slower.
    faer::set_global_parallelism(faer::Par::Seq);
    let mut builder = rayon::ThreadPoolBuilder::new();
    if let Some(count) = asked {
        builder = builder.num_threads(usize::from(count));
    }
    // The pool can be built once; a second session of the same process keeps the first one's.
    let _ = builder.build_global();
    rayon::current_num_threads()
}

/// Memory that this process may still take, bytes, where the system says so: what the kernel holds
/// available, within the limit of the control group.
pub fn available_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text
        .lines()
        .find(|line| line.starts_with("MemAvailable:"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    let limit = std::fs::read_to_string("/sys/fs/cgroup/memory.max")
        .ok()
        .and_then(|text| text.trim().parse().ok())
        .unwrap_or(f64::INFINITY);
    Some((1024.0 * kibibytes).min(limit))
}

/// Bytes in GiB.
pub fn gibibytes(bytes: f64) -> f64 {
    bytes / f64::from(1 << 30)
}
