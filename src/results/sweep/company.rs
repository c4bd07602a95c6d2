//! Locks of a folder that several processes share.

use super::super::folder::{FolderError, LOCK, open_lock};
use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

const DOOR: &str = ".door";

/// Who else works in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Company {
    /// No other process.
    None,
    /// Others, of the same sweep.
    Others,
    /// The file system has no locks to tell by.
    Unknown,
}

/// Holds the folder's lock shared, after `enter` has run: under the exclusive lock if no other
/// process is there.
pub fn share(
    path: &Path,
    enter: impl FnOnce(Company) -> Result<(), FolderError>,
) -> Result<File, FolderError> {
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
    let file = open_lock(&lock_path)?;
    let refusal = |error| match error {
        TryLockError::WouldBlock => FolderError::Busy(path.to_owned()),
        TryLockError::Error(error) => FolderError::io("lock", &lock_path, error),
    };
    match file.try_lock() {
        Ok(()) => {
            enter(Company::None)?;
            // Not every system turns one kind of lock into the other.
            file.unlock().map_err(|error| refusal(TryLockError::Error(error)))?;
            file.try_lock_shared().map_err(refusal)?;
        }
        Err(TryLockError::WouldBlock) => {
            file.try_lock_shared().map_err(refusal)?;
            enter(Company::Others)?;
        }
        Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {
            enter(Company::Unknown)?;
        }
        Err(error) => return Err(refusal(error)),
    }
    Ok(file)
}
