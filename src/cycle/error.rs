//! Errors of the search for a limit cycle.

use super::Family;
use crate::mesh::MeshError;
use crate::transient::TransientError;

/// A limit cycle that cannot be looked for or was not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CycleError {
    /// The mesh has more than one contact node for each sector.
    #[error("limit cycles need mesh.element = \"quad4\": a contact edge with equal nodes")]
    Element,
    /// The mesh cannot be built.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The cylinder must turn, counter-clockwise.
    #[error(
        "contact.rotation_speed_rpm = {rpm} must be positive: limit cycles live on a turning cylinder (the mirror \
         image of a case turns the other way)"
    )]
    RotationSpeed {
        /// Given speed, 1/min.
        rpm: f64,
    },
    /// A value that must be positive is not.
    #[error("{key} = {value} must be a positive finite number")]
    NotPositive {
        /// Case key.
        key: &'static str,
        /// Given value.
        value: f64,
    },
    /// A harmonic that the mesh cannot carry.
    #[error(
        "cycle.harmonics holds {harmonic}: a mesh of {sectors} sectors carries waves of 1 to {limit} nodal diameters"
    )]
    Harmonic {
        /// Given harmonic.
        harmonic: usize,
        /// Sectors of the mesh.
        sectors: usize,
        /// Highest harmonic.
        limit: usize,
    },
    /// Steady sliding never loses stability to this wave.
    #[error(
        "{family}: steady sliding has no such loss of stability up to a friction coefficient of \
         {limit}, so no limit cycle is born. Only the modes of cea.modes or cea.max_frequency_hz \
         are looked at, else the lowest ones. Name another harmonic or onset"
    )]
    NoOnset {
        /// Which limit cycle.
        family: Family,
        /// Largest friction coefficient searched.
        limit: f64,
    },
    /// The wave grows at any friction.
    #[error(
        "{family}: this wave grows without friction already, so it has no critical friction at \
         which a cycle could be born. Give the body some damping (damping.stiffness_coefficient)"
    )]
    Undamped {
        /// Which limit cycle.
        family: Family,
    },
    /// The eigenvalue analysis that finds the onsets failed.
    #[error("onsets of limit cycles: {0}")]
    Spectrum(String),
    /// The branch ends before the point asked for.
    #[error(
        "{family}: the branch of limit cycles does not reach {key} = {value:.6}: it ends at {reached:.6} \
         ({reason})"
    )]
    NotReached {
        /// Which limit cycle.
        family: Family,
        /// Case key of the parameter.
        key: &'static str,
        /// Value asked for, SI.
        value: f64,
        /// Last value, SI.
        reached: f64,
        /// Why it ends.
        reason: String,
    },
    /// What was found is no motion of the disc.
    #[error(
        "{family}: the wave on {sectors} elements around is no motion of the disc: it opens inside \
         the cylinder or draws energy from normal contact. Refine the mesh \
         (mesh.circumferential_elements and radial_elements), or try another cycle.phases"
    )]
    Unphysical {
        /// Which limit cycle.
        family: Family,
        /// Sectors of the mesh.
        sectors: usize,
    },
    /// The leading exponents do not converge.
    #[error(
        "the stability of this limit cycle cannot be told: no exponent has converged after {dimension} periods; let a \
         transient tell (transient.initial = \"limit-cycle\")"
    )]
    Stability {
        /// Periods spent.
        dimension: usize,
    },
    /// Neither of two waves grows.
    #[error(
        "steady sliding is stable against waves of {} and {} nodal diameters at \
         contact.friction_coefficient = {friction}: neither can win. Raise it, or name others in \
         basin.harmonics",
        harmonics[0],
        harmonics[1]
    )]
    StableSliding {
        /// The two.
        harmonics: [usize; 2],
        /// Friction coefficient.
        friction: f64,
    },
    /// The mesh's time stepping cannot take the cycle.
    #[error(transparent)]
    Stepping(#[from] TransientError),
}

impl CycleError {
    /// Whether elements, mesh, damping or harmonics of the case are to blame, which hold for all cycles, rather than the
    /// operating point.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Element | Self::Mesh(_) | Self::Harmonic { .. } | Self::Undamped { .. }
        )
    }
}
