//! Errors of the steady-sliding equilibrium.

/// What is sought of the equilibrium, or why there is none.
pub(super) type Result<T, E = PrestressError> = std::result::Result<T, E>;

/// A sliding equilibrium that does not exist or cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrestressError {
    /// Loads on bodies that nothing holds.
    #[error(
        "nothing holds the bodies against the pressure on them. Give a boundary that is clamped, \
         fixed or supported, or leave the pressure out for the free modes of a part"
    )]
    NothingHolds,
    /// A contact node is pulled, not pressed.
    #[error(
        "contact opens in the base state: {count} of {total} contact nodes are not pressed, first \
         node {node} at {angle_degrees:.3} degrees with {pressure:.6e} Pa. Full sliding needs \
         pressure everywhere: raise contact.interference"
    )]
    Separation {
        /// Nodes without pressure.
        count: usize,
        /// Contact nodes.
        total: usize,
        /// First open node, 1-based.
        node: usize,
        /// Its angle, degrees.
        angle_degrees: f64,
        /// Its pressure, Pa.
        pressure: f64,
    },
    /// No contact node touches.
    #[error(
        "there is a gap everywhere: {}, with an interference of {interference:e} m. Raise \
         contact.interference (of a rigid counterface) by more than the gap, or press the bodies \
         with a boundary pressure", apart(*total, [*distance, *interference])
    )]
    GapEverywhere {
        /// Contact nodes.
        total: usize,
        /// Smallest distance left, m.
        distance: f64,
        /// Interference, m.
        interference: f64,
    },
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
    /// A rotor at rest under Coulomb's law as a vector.
    #[error(
        "contact.rotation_speed_rpm = 0: without sliding there is no steady sliding to study. \
         Friction then holds a three-dimensional body across the sliding as an infinite dashpot \
         (mu p / V) does. Give a speed"
    )]
    AtRest,
    /// The stiffness matrix is not positive definite.
    #[error(
        "the stiffness matrix is not positive definite: nothing holds the body, or part of it, or \
         a C3D20R alone deforms without energy. Check [boundaries], [material] and [mesh]"
    )]
    Singular,
}

/// How far the surfaces are apart.
fn apart(total: usize, [distance, interference]: [f64; 2]) -> String {
    match distance > 0.0 {
        true => format!("the nearest of {total} contact nodes is {distance:.3e} m away"),
        false if interference > 0.0 => format!("loads part all {total} contact nodes"),
        false => format!("nothing presses any of {total} contact nodes"),
    }
}
