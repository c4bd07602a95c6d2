//! A sweep over the friction coefficient.

use super::found::{Wanted, WaveSweep};
use super::{proven, reduced};
use crate::cea::{CeaError, SweepRequest};
use crate::contact::SlidingContact;
use crate::fem::{ElasticMaterial, MaterialField};
use crate::mesh::{AnnulusSpecification, SectorMesh, SolidSector, SolidSpecification};
use crate::prestress::{TangentOptions, WaveTangent};

/// Everything that an analysis of a body of revolution is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidModel<M = ElasticMaterial> {
    /// The body and its mesh.
    pub specification: SolidSpecification,
    /// The material of each of its regions.
    pub material: M,
    /// Choices of the linearisation.
    pub options: TangentOptions,
    /// The rotor.
    pub contact: SlidingContact,
}

impl<M: MaterialField> SolidModel<M> {
    /// The linearisation of one of its sectors.
    ///
    /// # Errors
    /// A sector that cannot be built; no sliding equilibrium.
    pub fn tangent(&self) -> Result<WaveTangent, CeaError> {
        let sector = SolidSector::generate(&self.specification)?;
        Ok(WaveTangent::of_revolution(&sector, &self.material, &self.options, &self.contact)?)
    }
}

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

/// [`sweep`] of a body of revolution in three dimensions.
///
/// # Errors
/// As [`sweep`].
pub fn solid_sweep<M: MaterialField>(
    model: &SolidModel<M>,
    request: &SweepRequest<'_>,
) -> Result<WaveSweep, CeaError> {
    wave_sweep(model.tangent()?, request, &[])
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
