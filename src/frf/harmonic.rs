//! The matrices of one circumferential harmonic at one friction coefficient.

use crate::fem::RayleighDamping;
use crate::prestress::MovingHarmonic;

/// One harmonic, in the basis `(u_r, -i u_theta)` or `(u_r, -i u_theta, u_z)`.
pub(super) struct Harmonic {
    pub bands: MovingHarmonic,
    /// Where `C = alpha_R M + beta_R K`.
    pub proportional: Option<RayleighDamping>,
    /// No other harmonic is the mirror image of this one.
    pub is_standing: bool,
}
