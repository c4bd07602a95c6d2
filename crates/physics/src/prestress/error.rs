//! Errors of the steady-sliding equilibrium.

/// What is sought of the equilibrium, or why there is none.
pub(super) type Result<T, E = PrestressError> = std::result::Result<T, E>;

/// A sliding equilibrium that does not exist or cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrestressError {
    /// There is none: why, and what to do.
    #[error("{0}")]
    NoEquilibrium(String),
    /// No contact node touches.
    #[error("{0}")]
    GapEverywhere(String),
    /// The complementarity problem has no solution that could be found.
    #[error(
        "there is no state of steady sliding at friction {friction_coefficient}. Whatever nodes were taken as closed, \
         one of them is pulled or an open one penetrates. Lower contact.friction_coefficient, or the largest of \
         cea.friction_coefficients. A contact stiffness far above that of the bodies may hide a state: lower it, too"
    )]
    NoState {
        /// Friction coefficient.
        friction_coefficient: f64,
    },
    /// The case asks for what cannot be.
    #[error("{0}")]
    Asked(String),
    /// The stiffness matrix is not positive definite.
    #[error(
        "the stiffness matrix is not positive definite: nothing holds the body, or part of it, or \
         a C3D20R alone deforms without energy. Check [boundaries], [material] and [mesh]"
    )]
    Singular,
}

impl PrestressError {
    /// That none of so many contact nodes touches, with the smallest distance left and the interference, m.
    pub(super) fn gap_everywhere(total: usize, [distance, interference]: [f64; 2]) -> Self {
        let apart = match distance > 0.0 {
            true => format!("the nearest of {total} contact nodes is {distance:.3e} m away"),
            false if interference > 0.0 => format!("loads part all {total} contact nodes"),
            false => format!("nothing presses any of {total} contact nodes"),
        };
        Self::GapEverywhere(format!(
            "there is a gap everywhere: {apart}, with an interference of {interference:e} m. Raise contact.interference (of a rigid \
             counterface) by more than the gap, or press the bodies with a boundary pressure"
        ))
    }
}
