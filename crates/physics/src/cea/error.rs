//! Errors of an eigenvalue analysis.

use crate::cea::*;
use crate::fem::ModulusTable;
use crate::mesh::MeshError;
use crate::prestress::PrestressError;
use thiserror::Error;

/// An eigenvalue analysis that cannot be done, or whose result cannot be vouched for.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CeaError {
    /// No mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// No sliding equilibrium.
    #[error(transparent)]
    Prestress(#[from] PrestressError),
    /// A factorization or a dense decomposition failed.
    #[error("eigenvalue solver: {0}")]
    Linalg(#[from] LinalgError),
    /// The case asks for what cannot be.
    #[error("{0}")]
    Asked(String),
    /// The analysis failed, or its result cannot be vouched for.
    #[error("{0}")]
    Failed(String),
    /// There is nothing to find.
    #[error(
        "no mode lies below {limit_hz} Hz (the lowest is at {lowest_hz:.1} Hz): raise \
         cea.max_frequency_hz above it"
    )]
    NoModes {
        /// Upper end of the frequency range, Hz.
        limit_hz: f64,
        /// Undamped frequency of the lowest mode without friction, Hz.
        lowest_hz: f64,
    },
    /// Harmonics fail where the whole mesh may not.
    #[error("{0}")]
    Harmonic(String),
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
    /// A mode whose frequency a table of modulus over frequency does not hold.
    #[error(
        "{key} = \"{file}\" holds {low} to {high} Hz, and at friction coefficient \
         {friction_coefficient} a mode lies at {frequency_hz:.1} Hz. A modulus beyond a table is \
         not guessed",
        low = range_hz[0],
        high = range_hz[1]
    )]
    BeyondTable {
        /// Case key of the table.
        key: String,
        /// Its file.
        file: String,
        /// Its lowest and highest frequency, Hz.
        range_hz: [f64; 2],
        /// Friction coefficient.
        friction_coefficient: f64,
        /// Frequency of the mode, Hz.
        frequency_hz: f64,
    },
    /// A harmonic of which a branch could not be followed.
    #[error("a branch of harmonic {harmonic} {}. Use cea.method = \"sparse\"", lost(*friction))]
    LostHarmonic {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Friction value of the grid that was not reached.
        friction: f64,
    },
}

/// Why a branch was not followed up to a friction coefficient.
fn lost(friction: f64) -> String {
    match friction {
        0.0 => "does not oscillate at friction 0: it diverges, or is damped beyond the critical"
            .to_owned(),
        _ => format!(
            "could not be followed up to friction {friction}: two branches meet there or a mode \
             stops oscillating"
        ),
    }
}

impl CeaError {
    /// More modes asked for than there are.
    pub(super) fn too_many_modes(asked: usize, total: usize) -> Self {
        Self::Asked(format!(
            "cea.modes = {asked}, but the mesh has only {total} modes: lower it or refine [mesh]"
        ))
    }

    /// An `eigenvalue` of a harmonic whose vectors do not settle.
    pub(super) fn unrefined(harmonic: usize, friction: f64, eigenvalue: c64) -> Self {
        let frequency_hz = eigenvalue.im.abs() / TAU;
        Self::Harmonic(format!(
            "the eigenvalue at {frequency_hz:.1} Hz of harmonic {harmonic} has no vectors of its \
             own at friction {friction}: two branches meet there. Change that friction coefficient \
             a little"
        ))
    }

    /// A `table` that a mode lies beyond.
    pub(super) fn beyond_table(
        table: &ModulusTable,
        friction_coefficient: f64,
        frequency_hz: f64,
    ) -> Self {
        let (key, file) = (table.key.clone(), table.file.clone());
        let range_hz = table.range_hz();
        Self::BeyondTable { key, file, range_hz, friction_coefficient, frequency_hz }
    }

    /// Whether the case asks for what cannot be, rather than the run having failed.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Mesh(_)
                | Self::Asked(_)
                | Self::NoModes { .. }
                | Self::BeyondTable { .. }
                | Self::Prestress(PrestressError::Asked(_) | PrestressError::GapEverywhere { .. })
        )
    }
}
