//! Why a results folder cannot be used.

use std::path::{Path, PathBuf};
use std::{fmt::Display, io};

/// A folder that cannot be used or written.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// It holds the results of another case: which, and the remedy.
    #[error("{0}")]
    OtherCase(String),
    /// It cannot be written to, or gone back to, as it is: what is in the way, and the remedy.
    #[error("{0}")]
    Unusable(String),
    /// Another process writes it.
    #[error(
        "{} is being written by another process: wait for it, or choose another folder with --out",
        .0.display()
    )]
    Busy(PathBuf),
    /// No space left.
    #[error(
        "no room left: {} was not written, because the disk is full or a quota or file size limit is reached. Files \
         finished before are whole. Make room, or choose another folder with --out",
        .0.display()
    )]
    DiskFull(PathBuf),
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
    /// Of a folder that cannot be used: what it has or lacks, and the remedy.
    pub fn unusable(path: &Path, reason: impl Display) -> Self {
        Self::Unusable(format!("{} {reason}", path.display()))
    }

    /// Of a folder that does not hold results that can be gone back to.
    pub fn no_results(path: &Path, reason: impl Display) -> Self {
        Self::unusable(path, format!("does not hold the results of a run: {reason}"))
    }

    pub(crate) fn io(action: &'static str, path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::StorageFull
            | io::ErrorKind::QuotaExceeded
            | io::ErrorKind::FileTooLarge => Self::DiskFull(path),
            _ => Self::Io { action, path, source },
        }
    }

    /// Whether the user asked for the wrong folder, rather than a run failing.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::OtherCase(_) | Self::Unusable(_))
    }
}
