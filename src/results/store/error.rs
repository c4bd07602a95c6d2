//! Why a results folder cannot be used.

use std::io;
use std::path::{Path, PathBuf};

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
        "{} holds files that this program did not write (for example {found}). Choose another \
         folder with --out, or write there all the same with --force",
        path.display()
    )]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// One of the files.
        found: String,
    },
    /// A subfolder of it is a link to a folder elsewhere.
    #[error(
        "{} is a link to another folder, whose files would be replaced: \
         remove the link, or choose another folder with --out",
        .0.display()
    )]
    Linked(PathBuf),
    /// Another process writes it.
    #[error(
        "{} is being written by another process: wait for it, or choose another folder with --out",
        .0.display()
    )]
    Busy(PathBuf),
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
         is reached. Files finished before are whole. Make room, or choose another folder with \
         --out",
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
        matches!(
            self,
            Self::OtherCase { .. }
                | Self::Foreign { .. }
                | Self::Linked(_)
                | Self::Started { .. }
                | Self::NotASweep { .. }
                | Self::NotResults { .. }
        )
    }
}
