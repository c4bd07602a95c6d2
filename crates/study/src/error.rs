//! Why a study has no result.

use super::fit::FitError;
use crate::prelude::*;
use frictionsim_physics::fem::operator::SimdError;
use frictionsim_physics::frf::FrfError;
use frictionsim_physics::mesh::MeshError;
use frictionsim_physics::prestress::PrestressError;
use frictionsim_physics::transient::TransientError;

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
    /// The transient became numerically unstable.
    #[error("{error}: {remedy}")]
    Unstable {
        /// Where, and how it showed.
        error: TransientError,
        /// Which keys to change.
        remedy: &'static str,
    },
    /// There is no such limit cycle, or it cannot be looked for.
    #[error(transparent)]
    Cycle(#[from] CycleError),
    /// No limit cycle was found, of any family: why, family by family.
    #[error("no limit cycle found: {0}")]
    NoCycle(String),
    /// An instruction set that this processor has not.
    #[error(transparent)]
    Simd(#[from] SimdError),
    /// A summary that does not serialize.
    #[error(transparent)]
    Summary(#[from] serde_json::Error),
    /// A fit that cannot be made.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The first sample of a design, `key = value`, cannot be solved: why not.
    #[error("{0}")]
    Design(String),
    /// The modes of a linear stage would take too long: nodes that a mesh may have for them.
    #[error("more than {0} nodes")]
    TooManyNodes(usize),
    /// There is no frequency response.
    #[error(transparent)]
    Response(#[from] FrfError),
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
            _ => vec![self.to_string()],
        }
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
