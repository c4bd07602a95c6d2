//! The matrices of one circumferential harmonic at one friction coefficient.

use crate::fem::RayleighDamping;
use crate::linalg::c64;

/// Bands of one harmonic, in the basis `(u_r, -i u_theta)` or `(u_r, -i u_theta, u_z)`.
pub(super) struct Harmonic {
    pub half_bandwidth: usize,
    pub mass: Vec<c64>,
    pub stiffness: Vec<c64>,
    pub damping: Damping,
    /// No other harmonic is the mirror image of this one.
    pub is_standing: bool,
}

/// Damping of one harmonic.
pub(super) enum Damping {
    /// `alpha_R M + beta_R K`.
    Proportional(RayleighDamping),
    /// Any other.
    Band(Vec<c64>),
}
