//! Options, input and output folder that the commands on measured tables share.

use super::options::{OutputOptions, input_name, read_input};
use super::{Failure, terminal};
use crate::results::{Manifest, OutputFolder};
use crate::signal::reader::ReadError;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

/// A table on its way through one command.
pub struct Measurement {
    /// Bytes of the table.
    pub bytes: Vec<u8>,
    /// Its name in messages.
    pub source: String,
    /// What the results are made from.
    pub manifest: Manifest,
    options: OutputOptions,
    start: Instant,
}

impl Measurement {
    /// Reads the table and starts the log. `choices` are the options that change the result; they
    /// belong to the identity of the output folder.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn start(
        command: &str,
        path: &Path,
        options: &OutputOptions,
        choices: Vec<String>,
    ) -> Result<Self, Failure> {
        let start = Instant::now();
        terminal::start_log(options.quiet, options.verbose);
        // The matrices here are small, and the bytes must not depend on the number of threads.
        crate::linalg::factorize_on_one_thread();
        let bytes = read_input(path)?;
        let mut hash = Sha256::new();
        hash.update(&bytes);
        for choice in &choices {
            hash.update([0]);
            hash.update(choice.as_bytes());
        }
        let mut case_hash = String::new();
        for byte in hash.finalize() {
            let _ = write!(case_hash, "{byte:02x}");
        }
        Ok(Self {
            bytes,
            source: input_name(path),
            manifest: Manifest {
                case_file: path.display().to_string(),
                case_hash,
                overrides: choices,
                ..Manifest::new(command)
            },
            options: options.clone(),
            start,
        })
    }

    /// Takes the output folder; it belongs to one table and one set of options.
    ///
    /// # Errors
    /// Those of [`OutputOptions::open_folder`].
    pub fn open_folder(&self) -> Result<OutputFolder, Failure> {
        self.options.open_folder(&self.manifest, false)
    }

    /// Wall time since the start, s.
    pub fn wall_seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }
}

/// Writes a file outside the output folder, whole or not at all.
///
/// # Errors
/// A place that cannot be written.
pub fn write_aside(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let fail = |error| Failure::run(format!("cannot write {}: {error}", path.display()));
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
    let folder = parent.unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(fail)?;
    file.write_all(bytes).map_err(fail)?;
    file.persist(path).map_err(|error| fail(error.error))?;
    Ok(())
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::Usage(error.into())
    }
}
