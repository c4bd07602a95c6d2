//! Why a study has no result.

use crate::case::CaseErrors;
use crate::cea::CeaError;
use crate::mesh::MeshError;
use crate::prestress::PrestressError;

/// Why a study of a case has no result.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The case asks for what it cannot have; each error names its key.
    #[error(transparent)]
    Case(#[from] CaseErrors),
    /// There is no mesh, no steady sliding, or no spectrum.
    #[error(transparent)]
    Eigenvalues(#[from] CeaError),
}

impl From<MeshError> for StudyError {
    fn from(error: MeshError) -> Self {
        Self::Eigenvalues(error.into())
    }
}

impl From<PrestressError> for StudyError {
    fn from(error: PrestressError) -> Self {
        Self::Eigenvalues(error.into())
    }
}

impl StudyError {
    /// What went wrong, one line for each error.
    pub fn messages(&self) -> Vec<String> {
        match self {
            Self::Case(errors) => errors.messages(),
            Self::Eigenvalues(error) => vec![error.to_string()],
        }
    }
}
