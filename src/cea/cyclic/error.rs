//! What can go wrong in the cyclic analysis.

use crate::mesh::MeshError;
use crate::prestress::PrestressError;

/// A cyclic complex eigenvalue analysis that cannot be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CyclicError {
    /// No mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// No sliding equilibrium.
    #[error(transparent)]
    Prestress(#[from] PrestressError),
    /// A friction coefficient that is not one.
    #[error("cea.friction_coefficients: {value} is not a finite number of at least 0")]
    Friction {
        /// Given value.
        value: f64,
    },
    /// No friction coefficient at all.
    #[error("cea.friction_coefficients is empty: give at least one value")]
    NoFriction,
    /// A limit that selects no modes.
    #[error("cea.{key} = {value} must be a positive number")]
    Limit {
        /// Case key without its section.
        key: &'static str,
        /// Given value.
        value: f64,
    },
    /// More modes asked for than there are.
    #[error("cea.modes = {asked}, but the mesh has only {total} modes: lower it or refine [mesh]")]
    TooManyModes {
        /// Modes asked for.
        asked: usize,
        /// Modes of all harmonics.
        total: usize,
    },
    /// A branch that could not be followed.
    #[error(
        "a branch of harmonic {harmonic} could not be followed up to friction {friction}: two \
         branches meet there or a mode stops oscillating; use cea.method = \"sparse\""
    )]
    LostBranch {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Friction value of the grid that was not reached.
        friction: f64,
    },
    /// A mode that was not followed lies in the range.
    #[error(
        "harmonic {harmonic} has a mode below the limit that was not found although branches were \
         followed from {margin:.2} times the limit; use cea.method = \"sparse\""
    )]
    Unproven {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Largest margin tried.
        margin: f64,
    },
    /// The inertia of a harmonic and its eigenpairs disagree.
    #[error(
        "harmonic {harmonic} has {counted} modes below the limit by inertia but {found} were found; \
         use cea.method = \"sparse\""
    )]
    Incomplete {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Modes counted.
        counted: usize,
        /// Modes found.
        found: usize,
    },
}
