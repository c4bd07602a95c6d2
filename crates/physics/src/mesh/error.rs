//! Why no body can be made of a mesh file.

use frictionsim_formats::{FileMesh, MeshFileError};

/// A mesh file of which no body can be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] MeshFileError),
    /// A mesh that is read but cannot be used as a body.
    #[error("{0}")]
    Body(String),
    /// What was asked of the mesh does not fit it.
    #[error("{message}")]
    Request {
        /// Which part of the request.
        part: BodyPart,
        /// What is wrong, and what to do.
        message: String,
    },
}

/// Refuses a scale that takes a node of a file beyond reason.
pub(super) fn refuse_far(file: &FileMesh, scale: f64) -> Result<(), BodyError> {
    match file.far_node(scale) {
        Some(message) => Err(BodyPart::Scale.refused(message)),
        None => Ok(()),
    }
}

/// Part of what makes a body of a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BodyPart {
    /// The contact curve.
    Contact,
    /// The curve of the other body.
    Opposite,
    /// The condition of a boundary.
    Boundary(String),
    /// The way a plane slides.
    Direction,
    /// The axis of a cylinder.
    Center,
    /// The scale of the coordinates.
    Scale,
    /// The number of sectors.
    Sectors,
}

impl BodyPart {
    /// The error that this part of the request does not fit the mesh.
    pub(super) fn refused(self, message: String) -> BodyError {
        BodyError::Request { part: self, message }
    }
}
