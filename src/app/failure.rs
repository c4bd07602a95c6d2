//! Failures of a command and their exit codes.

use crate::results::{DrawingError, FolderError};
use crate::{case::CaseErrors, study::StudyError};
use std::io;

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub enum Failure {
    /// Errors of a case file, each with its place: exit code 2.
    Case(CaseErrors),
    /// Any other bad input: exit code 2.
    Usage(anyhow::Error),
    /// The input was good but the run failed: exit code 1.
    Run(anyhow::Error),
    /// A signal stopped the run: exit code 130.
    Interrupted(String),
    /// The program is wrong: what a panic inside another program said.
    Panic(String),
    /// Nothing was to be done: exit code 0.
    DryRun,
    /// The reader of our output has gone, as `head` does: exit code 0.
    BrokenPipe,
}

impl Failure {
    /// Bad input in words.
    pub fn usage(message: impl std::fmt::Display) -> Self {
        Self::Usage(anyhow::anyhow!("{message}"))
    }

    /// Failure of a run in words.
    pub fn run(message: impl std::fmt::Display) -> Self {
        Self::Run(anyhow::anyhow!("{message}"))
    }

    /// What went wrong, one line for each error.
    pub fn messages(&self) -> Vec<String> {
        match self {
            Self::Case(errors) => errors.messages(),
            Self::Usage(error) | Self::Run(error) => vec![error.to_string()],
            Self::Interrupted(message) | Self::Panic(message) => vec![message.clone()],
            Self::BrokenPipe | Self::DryRun => Vec::new(),
        }
    }
}

impl From<CaseErrors> for Failure {
    fn from(errors: CaseErrors) -> Self {
        Self::Case(errors)
    }
}

impl From<FolderError> for Failure {
    fn from(error: FolderError) -> Self {
        if error.is_usage() { Self::Usage(error.into()) } else { Self::Run(error.into()) }
    }
}

impl From<DrawingError> for Failure {
    fn from(error: DrawingError) -> Self {
        match error {
            DrawingError::Folder(error) => error.into(),
            DrawingError::Chart(_) => Self::Run(error.into()),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Case(errors) => errors.into(),
            error if error.is_usage() => Self::Usage(error.into()),
            error => Self::Run(error.into()),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::BrokenPipe
        } else {
            Self::Run(error.into())
        }
    }
}
