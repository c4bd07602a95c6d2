//! The output folder of a run: whose it is, who writes it, and whole files only.

pub(crate) use super::error::FolderError;
use super::framed::{Fill, create_folder, is_temporary, write_sealed, write_whole};
use super::lock::{Company, LOCK, Lock, remove_remnants, try_lock};
use super::manifest::Manifest;
use super::reopening::{Contents, JOURNAL, MANIFEST, read_contents, read_manifest};
use crate::drawing::{FIGURES, REPORT};
use frictionsim_bounds::{RESULT, read_text};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The mesh file of a case among its results.
pub const MESH: &str = "mesh.msh";
/// Folder in which results are built that replace others.
const STAGING: &str = ".replacing";

/// Whose results a run may replace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Replace {
    /// Those of the same effective case.
    SameCase,
    /// Those of the same command, which the caller knows to be of the same run: every file stays until it is replaced.
    Continued,
    /// Any.
    Anything,
}

/// An output folder that this process alone writes.
///
/// Every file appears under its final name only when complete. The lock goes with the process: a
/// killed run leaves none behind. A run that replaces the results of another case is built in a folder
/// beside them, `.replacing`, and takes their place when it is complete.
#[derive(Debug)]
pub struct OutputFolder {
    /// Where files are written.
    path: PathBuf,
    /// Where they belong.
    destination: PathBuf,
    manifest: Manifest,
    /// Files of earlier runs, and their checksums where they are known.
    earlier: BTreeMap<String, Option<u32>>,
    /// Files of this run and theirs.
    written: Mutex<BTreeMap<String, Option<u32>>>,
    /// Names of the files of this run until it has ended; none of a folder that processes share.
    journal: Option<File>,
    _lock: Lock,
}

impl OutputFolder {
    /// Takes a folder for a run, creating it where it is missing.
    ///
    /// # Errors
    /// [`FolderError`] if it belongs to another case and `replace` does not allow that, if another
    /// process holds it, or if it cannot be written.
    pub fn open(path: &Path, manifest: &Manifest, replace: Replace) -> Result<Self, FolderError> {
        // A folder that is refused stays as it is, without a lock file.
        Self::may_open(path, manifest, replace)?;
        create_folder(path)?;
        let (lock, company) = try_lock(&path.join(LOCK))?;
        if company == Company::Others {
            return Err(FolderError::Busy(path.to_owned()));
        }
        let destination = path;
        let staging = path.join(STAGING);
        let is_staged = replaces_others(path, manifest, replace)?;
        if !is_owned(&staging, manifest)? || !is_staged {
            // What an earlier run has left there is no result yet.
            let _ = fs::remove_dir_all(&staging);
        }
        let path = if is_staged { &staging } else { destination };
        create_folder(path)?;

        let mut earlier = BTreeMap::new();
        let journal_path = path.join(JOURNAL);
        let contents = read_contents(path)?;
        if contents.is_some() || journal_path.exists() {
            remove_remnants(path, is_temporary);
        }
        if let Some(contents) = contents {
            earlier = contents.into_files();
        }
        earlier.extend(unfinished(path));
        let journal = OpenOptions::new()
            .create(true)
            .append(true)
            .open(&journal_path)
            .map_err(|e| FolderError::io("open", &journal_path, e))?;
        let folder = Self {
            destination: destination.to_owned(),
            journal: Some(journal),
            earlier,
            ..Self::shared(path, manifest, lock)
        };
        write_manifest(path, manifest, &folder.earlier)?;
        Ok(folder)
    }

    /// A folder that processes share, whose manifest lists its files already; `lock` keeps other commands out.
    pub(crate) fn shared(path: &Path, manifest: &Manifest, lock: Lock) -> Self {
        Self {
            path: path.to_owned(),
            destination: path.to_owned(),
            journal: None,
            manifest: manifest.clone(),
            earlier: BTreeMap::new(),
            written: Mutex::default(),
            _lock: lock,
        }
    }

    /// Whether [`OutputFolder::open`] would take a folder, which is left as it is.
    ///
    /// # Errors
    /// Those of [`OutputFolder::open`] that the folder's contents decide.
    pub fn may_open(path: &Path, manifest: &Manifest, replace: Replace) -> Result<(), FolderError> {
        if !path.exists() {
            return Ok(());
        }
        if path.is_file() {
            return Err(FolderError::unusable(path, "is a file: --out names a folder"));
        }
        refuse_links(path)?;
        replaces_others(path, manifest, replace).map(|_| ())
    }

    /// Where this run was begun beside results that it is to replace, if it was, and interrupted.
    pub fn begun(path: &Path, manifest: &Manifest) -> Option<PathBuf> {
        let staging = path.join(STAGING);
        is_owned(&staging, manifest).unwrap_or(false).then_some(staging)
    }

    /// Takes the folder of an earlier run to draw its figures anew: figures and report that are not
    /// written again go, every other file stays.
    ///
    /// # Errors
    /// As [`read_manifest`]; [`FolderError::Busy`]; those of the file system.
    pub fn reopen(path: &Path) -> Result<Self, FolderError> {
        let manifest = read_manifest(path)?;
        let folder = Self::open(path, &manifest, Replace::SameCase)?;
        let is_drawing = |name: &str| name.starts_with(FIGURES) || name == REPORT;
        let kept = folder.earlier.iter().filter(|(name, _)| !is_drawing(name));
        let kept = kept.map(|(name, checksum)| (name.clone(), *checksum));
        folder.written().extend(kept);
        Ok(folder)
    }

    /// Where the files of this run are while it goes on.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where they are when it has ended.
    pub fn destination(&self) -> &Path {
        &self.destination
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
    ) -> Result<(), FolderError> {
        self.write_as(name, true, Box::new(fill))
    }

    /// Writes one file whole or not at all, but leaves it to the system when it reaches the disk: for
    /// the many large files (fields, figures) that a run after a power failure would make again.
    pub fn write_bulk(
        &self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), FolderError> {
        self.write_as(name, false, Box::new(fill))
    }

    /// Checksums of the files written so far, by name.
    fn written(&self) -> MutexGuard<'_, BTreeMap<String, Option<u32>>> {
        self.written.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn write_as(&self, name: &str, is_durable: bool, fill: Fill<'_>) -> Result<(), FolderError> {
        let path = self.path.join(name);
        let is_new = self.written().insert(name.to_owned(), None).is_none();
        if let Some(mut journal) = self.journal.as_ref().filter(|_| is_new) {
            writeln!(journal, "{name}").map_err(|e| FolderError::io("write", &path, e))?;
        }
        let checksum = write_whole(&path, is_durable, fill)?;
        self.written().insert(name.to_owned(), Some(checksum));
        Ok(())
    }

    /// Removes a file that has served its purpose, written by this run or an earlier one.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn discard(&self, name: &str) -> Result<(), FolderError> {
        self.written().remove(name);
        remove_files(&self.path, std::iter::once(&name.to_owned()))
    }

    /// Ends a complete run: removes what an earlier run of the same case left and this one did not
    /// write again, and takes the place of the results that it replaces.
    pub fn finish(self) -> Result<(), FolderError> {
        self.seal()?;
        if self.path == self.destination { Ok(()) } else { self.move_into_place() }
    }

    /// Ends a run before its time: its files stay where they are, and so do results that it was to replace. Gives that
    /// place.
    pub fn suspend(self) -> Result<PathBuf, FolderError> {
        self.seal()?;
        Ok(self.path)
    }

    /// Makes the files of this run, and no others, those of the folder that it is written in.
    fn seal(&self) -> Result<(), FolderError> {
        let written = self.written();
        let stale = self.earlier.keys().filter(|name| !written.contains_key(*name));
        remove_files(&self.path, stale)?;
        write_manifest(&self.path, &self.manifest, &written)?;
        let journal = self.path.join(JOURNAL);
        fs::remove_file(&journal).map_err(|e| FolderError::io("remove", &journal, e))
    }

    /// Moves the files of this run to their destination, and removes those of the run that it replaces.
    fn move_into_place(&self) -> Result<(), FolderError> {
        let written = self.written();
        let destination = &self.destination;
        let replaced = read_contents(destination)?.map(Contents::into_files);
        let mut replaced = replaced.unwrap_or_default();
        let journal_path = destination.join(JOURNAL);
        replaced.extend(unfinished(destination));
        // A process that is killed from here on leaves a run of this case that has not ended.
        let names: String = written.keys().map(|name| format!("{name}\n")).collect();
        fs::write(&journal_path, names).map_err(|e| FolderError::io("write", &journal_path, e))?;
        let both = replaced.keys().chain(written.keys()).map(|name| (name.clone(), None)).collect();
        write_manifest(destination, &self.manifest, &both)?;
        for name in written.keys() {
            let (from, to) = (self.path.join(name), destination.join(name));
            let parent = to.parent().unwrap_or(destination);
            create_folder(parent)?;
            fs::rename(&from, &to).map_err(|e| FolderError::io("write", &to, e))?;
        }
        let stale = replaced.keys().filter(|name| !written.contains_key(*name));
        remove_files(destination, stale)?;
        write_manifest(destination, &self.manifest, &written)?;
        let _ = fs::remove_dir_all(&self.path);
        fs::remove_file(&journal_path).map_err(|e| FolderError::io("remove", &journal_path, e))
    }
}

/// Writes the manifest of a folder with its files.
pub(crate) fn write_manifest(
    folder: &Path,
    manifest: &Manifest,
    files: &BTreeMap<String, Option<u32>>,
) -> Result<(), FolderError> {
    let contents = Contents::new(manifest, files);
    let path = folder.join(MANIFEST);
    write_whole(&path, true, Box::new(|out| write_sealed(out, &contents))).map(drop)
}

/// Removes files that a manifest lists.
pub(crate) fn remove_files<'a>(
    folder: &Path,
    names: impl Iterator<Item = &'a String>,
) -> Result<(), FolderError> {
    use io::ErrorKind::{IsADirectory, NotADirectory, NotFound};
    for path in names.filter(|name| is_inside(name)).map(|name| folder.join(name)) {
        match fs::remove_file(&path) {
            // A file that is gone already, or has made way for something of the user's, is what we want.
            Err(error) if !matches!(error.kind(), NotFound | NotADirectory | IsADirectory) => {
                return Err(FolderError::io("remove", &path, error));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Refuses a folder with a subfolder that is a link: files beyond it belong to nobody here.
fn refuse_links(path: &Path) -> Result<(), FolderError> {
    let entries = fs::read_dir(path).map_err(|e| FolderError::io("read folder", path, e))?;
    let mut links = entries.flatten().filter(|entry| {
        entry.file_type().is_ok_and(|kind| kind.is_symlink()) && entry.path().is_dir()
    });
    match links.next() {
        Some(link) => Err(FolderError::unusable(
            &link.path(),
            "is a link to another folder, whose files would be replaced: \
             remove the link, or choose another folder with --out",
        )),
        None => Ok(()),
    }
}

/// Whether a listed name stays below the folder, whatever an edited manifest says.
fn is_inside(name: &str) -> bool {
    Path::new(name).components().all(|part| matches!(part, std::path::Component::Normal(_)))
}

/// Whether a run of this case and command has been built in a folder.
fn is_owned(path: &Path, manifest: &Manifest) -> Result<bool, FolderError> {
    let found = read_contents(path)?.map(|contents| contents.manifest);
    Ok(found.is_some_and(|found| {
        found.case_hash == manifest.case_hash && found.command == manifest.command
    }))
}

/// Whether a run is to replace what lies in an existing folder, results of another case or foreign files; refuses what
/// must stay. A run that was begun so goes on without being allowed again.
fn replaces_others(path: &Path, ours: &Manifest, replace: Replace) -> Result<bool, FolderError> {
    let replaces = match read_contents(path)? {
        Some(found) if is_void(path, &found) => Ok(false),
        Some(found) => check_owner(path, &found.manifest, ours, replace).map(|same| !same),
        None => match refuse_foreign(path) {
            Ok(()) => Ok(false),
            Err(_) if replace == Replace::Anything => Ok(true),
            Err(error) => Err(error),
        },
    };
    match replaces {
        Err(_) if is_owned(&path.join(STAGING), ours)? => Ok(true),
        decided => decided,
    }
}

/// Whether a folder holds nobody's results: those of a run that ended before its first file, or with its mesh alone.
fn is_void(path: &Path, contents: &Contents) -> bool {
    let is_there = |name: &str| name != MESH && is_inside(name) && path.join(name).exists();
    !contents.files.iter().any(|name| is_there(name))
        && !unfinished(path).keys().any(|name| is_there(name))
}

/// The files that a killed run left in a folder, known from its journal.
fn unfinished(folder: &Path) -> BTreeMap<String, Option<u32>> {
    let journal = read_text(&folder.join(JOURNAL), RESULT).unwrap_or_default();
    journal.lines().map(|name| (name.to_owned(), None)).collect()
}

/// Whether the results there are of the same effective case; refuses those that must stay.
pub(crate) fn check_owner(
    path: &Path,
    found: &Manifest,
    ours: &Manifest,
    replace: Replace,
) -> Result<bool, FolderError> {
    let is_same = found.case_hash == ours.case_hash && found.command == ours.command;
    let is_allowed = match replace {
        Replace::SameCase => is_same,
        Replace::Continued => found.command == ours.command,
        Replace::Anything => true,
    };
    if is_allowed {
        return Ok(is_same || replace == Replace::Continued);
    }
    let command = found.command_line();
    let what = match command == ours.command_line() {
        true => "of this command on earlier input".to_owned(),
        false => format!("of another case or input ({command})"),
    };
    Err(FolderError::OtherCase(format!(
        "{} holds the results {what}: choose another folder with --out, or replace it with --force",
        path.display(),
    )))
}

pub(crate) fn refuse_foreign(path: &Path) -> Result<(), FolderError> {
    if path.join(MANIFEST).exists() {
        let reason = format!(
            "its {MANIFEST} is damaged: choose another folder with --out, or start over with --force"
        );
        return Err(FolderError::no_results(path, reason));
    }
    let entries = fs::read_dir(path).map_err(|e| FolderError::io("read folder", path, e))?;
    let names = entries
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        // Temporary files of a killed run start with a dot, as does the lock.
        .filter(|name| !name.starts_with('.'));
    let Some(found) = names.min() else { return Ok(()) };
    let reason = format!(
        "holds files that this program did not write (for example {found}). Choose another folder \
         with --out, or write there all the same with --force"
    );
    Err(FolderError::unusable(path, reason))
}
