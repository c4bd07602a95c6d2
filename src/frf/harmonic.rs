//! The matrices of one circumferential harmonic at one friction coefficient.

use crate::fem::RayleighDamping;
use crate::linalg::banded::BandedMatrix;
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

/// A body with springs and dashpots of its supports, `C = alpha_R M + beta_R K + D`.
pub(super) fn held_harmonic(
    [mass, mut stiffness]: [BandedMatrix; 2],
    supports: Option<[BandedMatrix; 2]>,
    damping: RayleighDamping,
    is_standing: bool,
) -> Harmonic {
    let complex =
        |matrix: &BandedMatrix| matrix.values().iter().map(|v| c64::new(*v, 0.0)).collect();
    let mut damped = Damping::Proportional(damping);
    if let Some([springs, mut band]) = supports {
        // A support couples no two nodes, but its matrices have the shape of all.
        band.add_scaled(damping.mass_coefficient, &mass);
        band.add_scaled(damping.stiffness_coefficient, &stiffness);
        stiffness.add_scaled(1.0, &springs);
        damped = Damping::Band(complex(&band));
    }
    Harmonic {
        half_bandwidth: mass.half_bandwidth(),
        mass: complex(&mass),
        stiffness: complex(&stiffness),
        damping: damped,
        is_standing,
    }
}
