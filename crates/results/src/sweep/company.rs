//! Locks of a folder that several processes share.

use super::super::folder::FolderError;
use super::super::store::lock::{Company, LOCK, open_lock, try_lock};
use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

const DOOR: &str = ".door";

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
    let (file, company) = try_lock(&lock_path)?;
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
    Ok(file)
}
