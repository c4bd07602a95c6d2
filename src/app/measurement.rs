//! Options, input and output folder that the commands on measured tables share.

use super::prelude::*;
use crate::{case::hash_of, signal::reader::ReadError};
use frictionsim_bounds::MEASUREMENT;
use std::fmt::Display;
use std::io::Write as _;

/// A table on its way through one command.
pub struct Measurement {
    /// Bytes of the table.
    pub bytes: Vec<u8>,
    /// Its name in messages.
    pub source: String,
    /// What the results are made from.
    pub manifest: Manifest,
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
        let bytes = read_input(path, MEASUREMENT)?;
        let mut manifest = Manifest {
            case_file: path.display().to_string(),
            case_hash: hash_of([&bytes[..]]),
            ..Manifest::new(command)
        };
        choices.into_iter().for_each(|choice| depend_on(&mut manifest, choice, None));
        Ok(Self { bytes, source: input_name(path), manifest, start })
    }

    /// What its summary begins with: the wall time since the start.
    pub fn head(&self) -> Head<'static> {
        Head { title: None, wall_s: Some(self.start.elapsed().as_secs_f64()) }
    }
}

/// An option that changes the result, with each of its values.
pub fn chosen<T: Display>(
    name: &'static str,
    values: impl IntoIterator<Item = T>,
) -> impl Iterator<Item = String> {
    values.into_iter().map(move |value| format!("--{name} {value}"))
}

/// A file that a command writes outside the output folder.
pub struct SideFile<'a> {
    path: &'a Path,
    force: bool,
}

impl<'a> SideFile<'a> {
    /// Asks before any work whether the file, if one is named, may be written. Nothing is replaced without `--force`,
    /// the measurement itself never.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming `option`.
    pub fn prepare(
        option: &str,
        path: Option<&'a Path>,
        measurement: &Path,
        force: bool,
    ) -> Result<Option<Self>, Failure> {
        let Some(path) = path else { return Ok(None) };
        let shown = path.display();
        let refused = |why| Err(Failure::usage(format!("{option} {shown}: {why}")));
        let same = |a: &Path, b: &Path| Some(a.canonicalize().ok()? == b.canonicalize().ok()?);
        if same(path, measurement) == Some(true) {
            return refused("this is the measurement itself; name another file");
        }
        if path.symlink_metadata().is_ok() && !force {
            return refused("the file exists; name another one, or replace it with --force");
        }
        Ok(Some(Self { path, force }))
    }

    /// Writes the file, whole or not at all.
    ///
    /// # Errors
    /// A place that cannot be written; a file that has come into being meanwhile.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let fail = |error| Failure::run(format!("cannot write {}: {error}", self.path.display()));
        let parent = self.path.parent().filter(|p| !p.as_os_str().is_empty());
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As any file that a program creates, under the user's umask.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut file = builder.tempfile_in(parent.unwrap_or(Path::new("."))).map_err(fail)?;
        file.write_all(bytes).map_err(fail)?;
        let kept = match self.force {
            true => file.persist(self.path),
            false => file.persist_noclobber(self.path),
        };
        kept.map(drop).map_err(|error| fail(error.error))
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::Usage(error.into())
    }
}
