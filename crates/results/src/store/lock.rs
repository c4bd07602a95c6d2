//! The lock of a folder, and what a process that lost it left.

use super::error::FolderError;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::{io, path::Path};

pub(crate) const LOCK: &str = ".lock";
/// Held for a moment by each of several processes that enter a folder.
const DOOR: &str = ".door";

/// The file of a lock, which ends with it: a process that starts meanwhile may hold the file a moment longer.
#[derive(Debug)]
pub(crate) struct Lock(File);

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = self.0.unlock();
    }
}

/// Opens the file of a lock, which has nothing in it.
fn open_lock(path: &Path) -> Result<File, FolderError> {
    let mut options = OpenOptions::new();
    options.create(true).truncate(false).write(true);
    options.open(path).map_err(|e| FolderError::io("open", path, e))
}

/// Who else works in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Company {
    /// No other process.
    None,
    /// Others, of the same sweep.
    Others,
    /// The file system has no locks to tell by: the folder is taken as if there were none.
    Unknown,
}

/// Takes a lock for this process alone, if no other holds it.
pub(crate) fn try_lock(path: &Path) -> Result<(Lock, Company), FolderError> {
    let file = open_lock(path)?;
    let company = match file.try_lock() {
        Ok(()) => Company::None,
        Err(TryLockError::WouldBlock) => Company::Others,
        Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {
            Company::Unknown
        }
        Err(TryLockError::Error(error)) => return Err(FolderError::io("lock", path, error)),
    };
    Ok((Lock(file), company))
}

/// Holds the folder's lock shared, after `enter` has run: under the exclusive lock if no other process is there.
pub(crate) fn share(
    path: &Path,
    enter: impl FnOnce(Company) -> Result<(), FolderError>,
) -> Result<Lock, FolderError> {
    // One process enters at a time, which takes a moment; hundreds of them may start at once.
    let door_path = path.join(DOOR);
    let door = open_lock(&door_path)?;
    match door.lock() {
        Err(error) if error.kind() != io::ErrorKind::Unsupported => {
            return Err(FolderError::io("lock", &door_path, error));
        }
        _ => {}
    }
    let lock_path = path.join(LOCK);
    let (lock, company) = try_lock(&lock_path)?;
    let file = &lock.0;
    let share = || {
        file.try_lock_shared().map_err(|error| match error {
            TryLockError::WouldBlock => FolderError::Busy(path.to_owned()),
            TryLockError::Error(error) => FolderError::io("lock", &lock_path, error),
        })
    };
    if company == Company::Others {
        share()?;
    }
    enter(company)?;
    if company == Company::None {
        // Not every system turns one kind of lock into the other.
        file.unlock().map_err(|error| FolderError::io("lock", &lock_path, error))?;
        share()?;
    }
    Ok(lock)
}

/// Removes what a killed run left, such as half-written files; this process holds the lock, so nobody uses them.
pub(crate) fn remove_remnants(path: &Path, is_remnant: fn(&str) -> bool) {
    for entry in fs::read_dir(path).into_iter().flatten().flatten() {
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir() {
            remove_remnants(&entry.path(), is_remnant);
        } else if is_remnant(&entry.file_name().to_string_lossy()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}
