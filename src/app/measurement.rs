//! What the commands on measured tables share: options, reading the file, the output folder.

use super::figure_options::FigureOptions;
use super::{Failure, terminal};
use crate::results::{Manifest, OutputFolder, Replace};
use crate::signal::reader::ReadError;
use clap::{Args, ValueHint};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Output options of a command that starts from a table instead of a case.
#[derive(Args, Clone, Debug)]
pub struct OutputOptions {
    /// Output folder; `None` is `results/STEM/COMMAND` with the stem of the table's name.
    #[arg(
        long,
        help = "Output folder [default: results/<table's stem>/<command>]",
        value_name = "DIR",
        value_hint = ValueHint::DirPath
    )]
    pub out: Option<PathBuf>,
    /// Print the summary object, alone, on stdout
    #[arg(long)]
    pub json: bool,
    /// No log but errors
    #[arg(long, short)]
    pub quiet: bool,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
    /// How figures are drawn
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Replace an output folder of another table
    #[arg(long)]
    pub force: bool,
}

/// A table on its way through one command.
pub struct Measurement {
    /// Bytes of the table.
    pub bytes: Vec<u8>,
    /// Its name in messages.
    pub source: String,
    /// What the results are made from.
    pub manifest: Manifest,
    options: OutputOptions,
    folder: PathBuf,
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
        terminal::start_log(options.quiet);
        // The matrices here are small, and the bytes must not depend on the number of threads.
        faer::set_global_parallelism(faer::Par::Seq);
        let bytes = std::fs::read(path)
            .map_err(|error| Failure::usage(format!("cannot read {}: {error}", path.display())))?;
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
        let stem = path.file_stem().unwrap_or(path.as_os_str());
        Ok(Self {
            bytes,
            source: path.display().to_string(),
            manifest: Manifest {
                case_file: path.display().to_string(),
                case_hash,
                overrides: choices,
                ..Manifest::new(command)
            },
            folder: match &options.out {
                Some(path) => path.clone(),
                None => Path::new("results").join(stem).join(command),
            },
            options: options.clone(),
            start,
        })
    }

    /// Takes the output folder. The default folder may be replaced by a run on a changed table, one
    /// named by `--out` belongs to one table and one set of options.
    ///
    /// # Errors
    /// Those of [`OutputFolder::open`].
    pub fn open_folder(&self) -> Result<OutputFolder, Failure> {
        let replace = match (&self.options.out, self.options.force) {
            (_, true) => Replace::Anything,
            (Some(_), false) => Replace::SameCase,
            (None, false) => Replace::SameText,
        };
        Ok(OutputFolder::open(&self.folder, &self.manifest, replace)?)
    }

    /// Wall time since the start, s.
    pub fn wall_seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Prints the summary as JSON, or the table for people and where the files are.
    ///
    /// # Errors
    /// Those of stdout.
    pub fn print(&self, table: &str, summary: &serde_json::Value) -> Result<(), Failure> {
        if self.options.json {
            terminal::print_json(summary)
        } else {
            let folder = self.folder.display();
            terminal::print(&format!("{table}results in {folder}\n"))
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::Usage(error.into())
    }
}
