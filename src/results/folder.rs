//! The output folder of a run: whose it is, who writes it, and whole files only.

use super::Manifest;
use super::drawing::{FIGURES, REPORT};
use super::reopening::read_manifest;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

pub(super) const MANIFEST: &str = "manifest.json";
pub(super) const LOCK: &str = ".lock";
/// Names of the files that a run has written so far; gone when it is complete.
const JOURNAL: &str = ".written";
/// How the name of a file that is still being written begins.
pub(super) const TEMPORARY: &str = ".writing-";

/// A folder that cannot be used or written.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// It holds the results of another case.
    #[error(
        "{} holds the results of another case ({found}): \
         choose another folder with --out, or replace it with --force",
        path.display()
    )]
    OtherCase {
        /// The folder.
        path: PathBuf,
        /// What it holds.
        found: String,
    },
    /// It holds files of unknown origin.
    #[error(
        "{} holds files that this program did not write (for example {found}): \
         choose another folder with --out, or write there all the same with --force",
        path.display()
    )]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// One of the files.
        found: String,
    },
    /// Another process writes it.
    #[error(
        "{} is being written by another process: wait for it, or choose another folder with --out",
        path.display()
    )]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// It holds finished points of the same sweep.
    #[error(
        "{} already holds {found} of the {asked} points asked for: go on with --resume, \
         start over with --force, or choose another folder with --out",
        path.display()
    )]
    Started {
        /// The folder.
        path: PathBuf,
        /// Finished points.
        found: usize,
        /// Points of this run.
        asked: usize,
    },
    /// It is not the results folder of a sweep.
    #[error("{} is not the results folder of a sweep: {reason}", path.display())]
    NotASweep {
        /// The folder.
        path: PathBuf,
        /// What it lacks.
        reason: String,
    },
    /// It does not hold results that can be gone back to.
    #[error("{} does not hold the results of a run: {reason}", path.display())]
    NotResults {
        /// The folder.
        path: PathBuf,
        /// What it lacks.
        reason: String,
    },
    /// No space left.
    #[error(
        "no room left: {} was not written, because the disk is full or a quota or file size limit \
         is reached (files finished before are whole): make room, or choose another folder with --out",
        path.display()
    )]
    DiskFull {
        /// The file.
        path: PathBuf,
    },
    /// Any other failure of the file system.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// What was tried.
        action: &'static str,
        /// On which file.
        path: PathBuf,
        /// Why it failed.
        source: io::Error,
    },
}

impl FolderError {
    pub(super) fn io(action: &'static str, path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::StorageFull
            | io::ErrorKind::QuotaExceeded
            | io::ErrorKind::FileTooLarge => Self::DiskFull { path },
            _ => Self::Io {
                action,
                path,
                source,
            },
        }
    }

    /// Whether the user asked for the wrong folder, rather than a run failing.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::OtherCase { .. }
                | Self::Foreign { .. }
                | Self::Started { .. }
                | Self::NotASweep { .. }
                | Self::NotResults { .. }
        )
    }
}

/// Whose results a run may replace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Replace {
    /// Those of the same effective case.
    SameCase,
    /// Those of the same case file text, whatever the overrides.
    SameText,
    /// Any.
    Anything,
}

/// `manifest.json`: the manifest and the files that go with it.
#[derive(Serialize, Deserialize)]
pub(super) struct Contents {
    #[serde(flatten)]
    pub(super) manifest: Manifest,
    pub(super) files: BTreeSet<String>,
}

/// An output folder that this process alone writes.
///
/// Every file appears under its final name only when complete. The lock goes with the process: a
/// killed run leaves none behind.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    manifest: Manifest,
    earlier: BTreeSet<String>,
    written: RefCell<BTreeSet<String>>,
    journal: File,
    _lock: File,
}

impl OutputFolder {
    /// Takes a folder for a run, creating it where it is missing.
    ///
    /// # Errors
    /// [`FolderError`] if it belongs to another case and `replace` does not allow that, if another
    /// process holds it, or if it cannot be written.
    pub fn open(path: &Path, manifest: &Manifest, replace: Replace) -> Result<Self, FolderError> {
        fs::create_dir_all(path).map_err(|e| FolderError::io("create folder", path, e))?;
        let lock = lock(path)?;
        let contents = read_contents(path)?;
        let (mut earlier, mut is_same) = (BTreeSet::new(), true);
        match contents {
            Some(contents) => {
                is_same = check_owner(path, &contents.manifest, manifest, replace)?;
                earlier = contents.files;
            }
            None if replace != Replace::Anything => refuse_foreign(path)?,
            None => {}
        }
        // What a killed run left is known from its journal.
        let journal_path = path.join(JOURNAL);
        let unfinished = fs::read_to_string(&journal_path).unwrap_or_default();
        earlier.extend(unfinished.lines().map(str::to_owned));
        remove_temporaries(path);
        let journal = OpenOptions::new()
            .create(true)
            .append(true)
            .open(&journal_path)
            .map_err(|e| FolderError::io("open", &journal_path, e))?;
        let folder = Self {
            path: path.to_owned(),
            journal,
            manifest: manifest.clone(),
            earlier,
            written: RefCell::default(),
            _lock: lock,
        };
        if !is_same {
            // Files of another case must not lie beside those of this one.
            folder.remove(folder.earlier.iter());
        }
        folder.write_manifest(&folder.earlier)?;
        Ok(folder)
    }

    /// Takes the folder of an earlier run to draw its figures anew: figures and report that are not
    /// written again go, every other file stays.
    ///
    /// # Errors
    /// As [`read_manifest`]; [`FolderError::Busy`]; those of the file system.
    pub fn reopen(path: &Path) -> Result<Self, FolderError> {
        let manifest = read_manifest(path)?;
        let folder = Self::open(path, &manifest, Replace::SameCase)?;
        let is_drawing = |name: &&String| name.starts_with(FIGURES) || *name == REPORT;
        let kept = folder.earlier.iter().filter(|name| !is_drawing(name));
        folder.written.borrow_mut().extend(kept.cloned());
        Ok(folder)
    }

    /// The folder's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The manifest of the run.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Writes one file whole or not at all: under a temporary name first, flushed to the disk, then
    /// renamed. `name` may have subfolders.
    ///
    /// # Errors
    /// [`FolderError::DiskFull`] or [`FolderError::Io`] with the file's path.
    pub fn write(
        &self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<PathBuf, FolderError> {
        self.write_as(name, true, fill)
    }

    /// Writes one file whole or not at all, but leaves it to the system when it reaches the disk: for
    /// the many large files (fields, figures) that a run after a power failure would make again.
    ///
    /// # Errors
    /// As [`OutputFolder::write`].
    pub fn write_bulk(
        &self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<PathBuf, FolderError> {
        self.write_as(name, false, fill)
    }

    fn write_as(
        &self,
        name: &str,
        is_durable: bool,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<PathBuf, FolderError> {
        let path = self.path.join(name);
        let failed = |error| FolderError::io("write", &path, error);
        if self.written.borrow_mut().insert(name.to_owned()) {
            writeln!(&self.journal, "{name}").map_err(failed)?;
        }
        write_whole(&path, is_durable, fill).map_err(failed)?;
        Ok(path)
    }

    /// Removes a file that has served its purpose, written by this run or an earlier one.
    pub fn discard(&self, name: &str) {
        self.written.borrow_mut().remove(name);
        self.remove(std::iter::once(&name.to_owned()));
    }

    /// Ends a complete run: removes what an earlier run of the same case left and this one did not
    /// write again.
    ///
    /// # Errors
    /// As [`OutputFolder::write`].
    pub fn finish(self) -> Result<(), FolderError> {
        let written = self.written.borrow();
        self.remove(self.earlier.difference(&written));
        self.write_manifest(&written)?;
        let journal = self.path.join(JOURNAL);
        fs::remove_file(&journal).map_err(|e| FolderError::io("remove", &journal, e))
    }

    fn write_manifest(&self, files: &BTreeSet<String>) -> Result<(), FolderError> {
        let contents = Contents {
            manifest: self.manifest.clone(),
            files: files.clone(),
        };
        write_contents(&self.path, &contents)
    }

    fn remove<'a>(&self, names: impl Iterator<Item = &'a String>) {
        remove_files(&self.path, names);
    }
}

pub(super) fn write_contents(folder: &Path, contents: &Contents) -> Result<(), FolderError> {
    let path = folder.join(MANIFEST);
    write_whole(&path, true, |out| {
        serde_json::to_writer_pretty(&mut *out, contents)?;
        out.write_all(b"\n")
    })
    .map_err(|e| FolderError::io("write", &path, e))
}

/// Removes files that a manifest lists.
pub(super) fn remove_files<'a>(folder: &Path, names: impl Iterator<Item = &'a String>) {
    for name in names.filter(|name| is_inside(name)) {
        // A file that is gone already is what we want.
        let _ = fs::remove_file(folder.join(name));
    }
}

/// Whether a listed name stays below the folder, whatever an edited manifest says.
fn is_inside(name: &str) -> bool {
    Path::new(name)
        .components()
        .all(|part| matches!(part, std::path::Component::Normal(_)))
}

fn lock(path: &Path) -> Result<File, FolderError> {
    let lock_path = path.join(LOCK);
    let file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(&lock_path)
        .map_err(|e| FolderError::io("open", &lock_path, e))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(FolderError::Busy {
            path: path.to_owned(),
        }),
        // A file system without locks: go on as if there were no other process.
        Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => Ok(file),
        Err(TryLockError::Error(error)) => Err(FolderError::io("lock", &lock_path, error)),
    }
}

/// Removes half-written files of a killed run; this process holds the lock, so nobody writes them.
fn remove_temporaries(path: &Path) {
    for entry in fs::read_dir(path).into_iter().flatten().flatten() {
        let Ok(kind) = entry.file_type() else {
            continue;
        };
        if kind.is_dir() {
            remove_temporaries(&entry.path());
        } else if entry.file_name().to_string_lossy().starts_with(TEMPORARY) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

pub(super) fn read_contents(path: &Path) -> Result<Option<Contents>, FolderError> {
    let path = path.join(MANIFEST);
    match fs::read(&path) {
        Ok(bytes) => Ok(serde_json::from_slice(&bytes).ok()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(FolderError::io("read", &path, error)),
    }
}

/// Whether the results there are of the same effective case; refuses those that must stay.
pub(super) fn check_owner(
    path: &Path,
    found: &Manifest,
    ours: &Manifest,
    replace: Replace,
) -> Result<bool, FolderError> {
    let is_same = found.case_hash == ours.case_hash && found.command == ours.command;
    let is_allowed = match replace {
        Replace::SameCase => is_same,
        Replace::SameText => {
            is_same || (found.command == ours.command && found.case_text == ours.case_text)
        }
        Replace::Anything => true,
    };
    if is_allowed {
        return Ok(is_same);
    }
    let mut described = format!("frictionsim {} {}", found.command, found.case_file);
    for text in &found.overrides {
        described.push_str(" --set ");
        described.push_str(text);
    }
    Err(FolderError::OtherCase {
        path: path.to_owned(),
        found: described,
    })
}

pub(super) fn refuse_foreign(path: &Path) -> Result<(), FolderError> {
    let entries = fs::read_dir(path).map_err(|e| FolderError::io("read folder", path, e))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        // Temporary files of a killed run start with a dot, as does the lock.
        .filter(|name| !name.starts_with('.'))
        .collect();
    names.sort();
    match names.into_iter().next() {
        Some(found) => Err(FolderError::Foreign {
            path: path.to_owned(),
            found,
        }),
        None => Ok(()),
    }
}

/// Writes a file under a temporary name in the same folder and renames it, flushed to the disk before
/// that if it is to be durable.
pub(super) fn write_whole(
    path: &Path,
    is_durable: bool,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let parent = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(parent)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any file that a program creates, under the user's umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut temporary = builder.tempfile_in(parent)?;
    let mut out = BufWriter::with_capacity(1 << 16, temporary.as_file_mut());
    fill(&mut out)?;
    out.flush()?;
    drop(out);
    if is_durable {
        temporary.as_file().sync_all()?;
    }
    temporary.persist(path).map_err(|error| error.error)?;
    Ok(())
}
