//! Errors of an eigenvalue analysis.

use crate::fem::ModulusTable;
use crate::linalg::LinalgError;
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
    /// More modes asked for than there are.
    #[error("cea.modes = {asked}, but the mesh has only {total} modes: lower it or refine [mesh]")]
    TooManyModes {
        /// Modes asked for.
        asked: usize,
        /// Modes that the mesh carries.
        total: usize,
    },
    /// The iteration found another number of modes than the inertia of `K - sigma M` proves.
    #[error(
        "without friction the solver found {found} modes below {frequency_hz:.1} Hz, the inertia of \
         the stiffness counts {counted}"
    )]
    CountMismatch {
        /// Modes found.
        found: usize,
        /// Modes counted.
        counted: usize,
        /// Where, Hz.
        frequency_hz: f64,
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
    /// A mode that finds no frequency of its own.
    #[error(
        "at friction coefficient {friction_coefficient} the mode at about {frequency_hz:.1} Hz \
         does not settle at a frequency of its own (relative residual {residual:.1e}). The modulus \
         of {key} changes too fast there: give its table more rows or smooth it"
    )]
    Unsettled {
        /// Case key of the first table.
        key: String,
        /// Friction coefficient.
        friction_coefficient: f64,
        /// Where the search ended, Hz.
        frequency_hz: f64,
        /// Residual there.
        residual: f64,
    },
    /// A harmonic of which a branch could not be followed.
    #[error(
        "a branch of harmonic {harmonic} could not be followed up to friction {friction}: two \
         branches meet there or a mode stops oscillating. Use cea.method = \"sparse\""
    )]
    LostHarmonic {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Friction value of the grid that was not reached.
        friction: f64,
    },
    /// Matrices that leave a motion undetermined.
    #[error(
        "the mass, damping and stiffness matrices of {dimension} unknowns are singular together: \
         some motion has neither mass nor stiffness. Remove unknowns that depend on each other"
    )]
    SingularTogether {
        /// Number of unknowns.
        dimension: usize,
    },
    /// An eigenvalue of a body of revolution whose vectors do not settle.
    #[error(
        "the eigenvalue at {frequency_hz:.1} Hz of harmonic {harmonic} has no vectors of its own \
         at friction {friction}: two branches meet there. Change that friction coefficient a little"
    )]
    Unrefined {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Friction coefficient.
        friction: f64,
        /// Its frequency, Hz.
        frequency_hz: f64,
    },
    /// A count of modes that an eigenvalue on its edge forbids.
    #[error(
        "not counted: an eigenvalue lies at or near {frequency_hz:.1} Hz with a growth rate of \
         about {growth_rate:.1} 1/s, on the edge of the count. Move cea.max_frequency_hz or \
         cea.modes"
    )]
    Uncounted {
        /// Its frequency, Hz.
        frequency_hz: f64,
        /// Its growth rate, 1/s.
        growth_rate: f64,
    },
    /// Stiffness over which modes cannot be counted.
    #[error(
        "cea.count_modes needs matrices that are analytic in the eigenvalue: {key} is a table over frequency"
    )]
    Uncountable {
        /// Case key of the table.
        key: String,
    },
}

impl CeaError {
    /// A `table` that a mode lies beyond.
    pub(super) fn beyond_table(
        table: &ModulusTable,
        friction_coefficient: f64,
        frequency_hz: f64,
    ) -> Self {
        let [key, file] = [table.key(), table.file()].map(str::to_owned);
        Self::BeyondTable {
            key,
            file,
            range_hz: table.range_hz(),
            friction_coefficient,
            frequency_hz,
        }
    }

    /// Whether the case asks for what cannot be, rather than the run having failed.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Mesh(_)
                | Self::Friction { .. }
                | Self::NoFriction
                | Self::Limit { .. }
                | Self::NoModes { .. }
                | Self::TooManyModes { .. }
                | Self::BeyondTable { .. }
                | Self::Prestress(
                    PrestressError::Unpressed { .. }
                        | PrestressError::GapEverywhere { .. }
                        | PrestressError::Pair { .. }
                        | PrestressError::Overconstrained { .. }
                        | PrestressError::MixedContacts
                        | PrestressError::FrameOfNone { .. }
                        | PrestressError::NotOfRevolution { .. }
                )
        )
    }
}
