//! Why a study has no result.

use super::fit::FitError;
use frictionsim_case::CaseErrors;
use frictionsim_physics::{
    cea::CeaError, cycle::CycleError, fem::operator::SimdError, frf::FrfError, mesh::MeshError,
    prestress::PrestressError, transient::TransientError,
};

/// Why a study of a case has no result.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The case asks for what it cannot have; each error names its key.
    #[error(transparent)]
    Case(#[from] CaseErrors),
    /// There is no mesh, no steady sliding, or no spectrum.
    #[error(transparent)]
    Eigenvalues(#[from] CeaError),
    /// The transient cannot start, or belongs to another case.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// There is no such limit cycle, or it cannot be looked for.
    #[error(transparent)]
    Cycle(#[from] CycleError),
    /// An instruction set that this processor has not.
    #[error(transparent)]
    Simd(#[from] SimdError),
    /// A summary that does not serialize.
    #[error(transparent)]
    Summary(#[from] serde_json::Error),
    /// A fit that cannot be made.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// There is no frequency response.
    #[error(transparent)]
    Response(#[from] FrfError),
    /// The run has no result for another reason, in words.
    #[error("{0}")]
    Failed(String),
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
        if let Self::Case(errors) = self { errors.messages() } else { vec![self.to_string()] }
    }

    /// The same in one line.
    pub fn line(&self) -> String {
        self.messages().join("; ")
    }

    /// Whether the case is to blame rather than the run.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Case(_) | Self::Simd(_) => true,
            Self::Eigenvalues(error) => error.is_usage(),
            Self::Cycle(error) => error.is_usage(),
            Self::Fit(error) => error.is_usage(),
            _ => false,
        }
    }
}
