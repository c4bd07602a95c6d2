//! A sweep over the friction coefficient.

use super::found::{Wanted, WaveSweep};
use super::{proven, reduced};
use crate::cea::{CeaError, SweepRequest};
use crate::contact::SlidingContact;
use crate::fem::MaterialField;
use crate::mesh::{AnnulusSpecification, SectorMesh};
use crate::prestress::{TangentOptions, WaveTangent};

/// Eigenvalues of steady sliding of a plane annulus over a range of friction coefficients.
///
/// # Errors
/// [`CeaError`] where there is no sliding equilibrium, or a branch cannot be followed.
pub fn sweep(
    specification: &AnnulusSpecification,
    material: &dyn MaterialField,
    options: &TangentOptions,
    contact: &SlidingContact,
    request: &SweepRequest<'_>,
) -> Result<WaveSweep, CeaError> {
    let sector = SectorMesh::generate(specification)?;
    wave_sweep(WaveTangent::of_annulus(&sector, material, options, contact)?, request, &[])
}

/// Eigenvalues of small motions over a range of friction coefficients, with the waves of one sector at those of `waves_at`.
///
/// Every branch is followed from `mu = 0` to the largest friction coefficient given. Without friction the modes are complete by
/// inertia counts; of a plane body of viscous damping it is proven, too, that friction brings no others.
///
/// # Errors
/// [`CeaError`] where a branch cannot be followed.
pub fn wave_sweep(
    tangent: WaveTangent,
    request: &SweepRequest<'_>,
    waves_at: &[f64],
) -> Result<WaveSweep, CeaError> {
    let wanted = Wanted { request, waves_at, grid: &request.rising_grid()? };
    request.limit.check()?;
    match proven::applies(&tangent) {
        true => proven::solve(tangent, &wanted),
        false => reduced::solve(tangent, &wanted),
    }
}
