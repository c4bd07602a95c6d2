//! What a results folder says of the run that it holds.

use super::Manifest;
use super::folder::{FolderError, MANIFEST, read_contents};
use std::fs;
use std::io;
use std::path::Path;

const SUMMARY: &str = "summary.json";

/// The manifest of a results folder.
///
/// # Errors
/// [`FolderError::NotResults`] if there is none; those of the file system.
pub fn read_manifest(path: &Path) -> Result<Manifest, FolderError> {
    let lacks = |reason: String| FolderError::NotResults {
        path: path.to_owned(),
        reason,
    };
    if !path.join(MANIFEST).is_file() {
        return Err(lacks(format!("it has no {MANIFEST}")));
    }
    match read_contents(path)? {
        Some(contents) => Ok(contents.manifest),
        None => Err(lacks(format!("its {MANIFEST} is damaged"))),
    }
}

/// The `summary.json` of a results folder.
///
/// # Errors
/// [`FolderError::NotResults`] if there is none, as after a run that was killed; those of the file
/// system.
pub fn read_summary(path: &Path) -> Result<serde_json::Value, FolderError> {
    let lacks = |reason: &str| FolderError::NotResults {
        path: path.to_owned(),
        reason: reason.to_owned(),
    };
    let file = path.join(SUMMARY);
    match fs::read(&file) {
        Ok(bytes) => {
            serde_json::from_slice(&bytes).map_err(|_| lacks("its summary.json is damaged"))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(lacks("it has no summary.json: the run did not end"))
        }
        Err(error) => Err(FolderError::io("read", &file, error)),
    }
}
