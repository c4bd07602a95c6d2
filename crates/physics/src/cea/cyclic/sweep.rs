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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::ModeLimit;
    use crate::cea::cyclic::completeness::verify;
    use crate::cea::cyclic::found::MARGIN;
    use crate::cea::cyclic::paths::HarmonicPaths;
    use crate::contact::ContactStiffness;
    use crate::fem::{ElasticMaterial, MassKind, RayleighDamping};
    use crate::mesh::{BoundaryCondition, ElementKind};
    use crate::prestress::DampingModel;

    /// With structural damping, and with dashpots alone, branches of either direction.
    #[test]
    fn a_branch_that_is_left_out_is_missed() {
        let specification = AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 16,
            radial_elements: 4,
            radial_grading: 1.0,
            element: ElementKind::Quad4,
            outer: BoundaryCondition::Clamped,
            shaft: None,
        };
        let contact = SlidingContact {
            friction_coefficient: 0.3,
            decay: None,
            interference: 25e-6,
            rotation_speed: 63.9,
        };
        let grid = [0.0, 0.3];
        let request = SweepRequest::new(&grid, ModeLimit::MaxFrequency(12e3));
        let wanted = Wanted { request: &request, waves_at: &[], grid: &grid };
        for [loss_factor, tangential_damping] in [[0.05, 0.0], [0.0, 2e3]] {
            let material = ElasticMaterial {
                young_modulus: 2.5e9,
                poisson_ratio: 0.38,
                density: 1228.0,
                loss_factor,
                ..ElasticMaterial::PLAIN
            };
            let options = TangentOptions {
                mass: MassKind::Consistent,
                geometric_stiffness: true,
                damping: RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 },
                damping_model: DampingModel::WholeTangent,
                contact: ContactStiffness { tangential_damping, ..ContactStiffness::default() },
            };
            let sector = SectorMesh::generate(&specification).unwrap();
            let tangent = WaveTangent::of_annulus(&sector, &material, &options, &contact);
            let mut tangent = tangent.unwrap();
            let found = match proven::applies(&tangent) {
                true => proven::follow(&tangent, &wanted, MARGIN, None),
                false => reduced::follow_all(&mut tangent, &wanted).map(|found| found.0),
            };
            let (mut followed, limit) = found.map(|found| (found.followed, found.limit)).unwrap();
            let missed =
                |followed: &[HarmonicPaths]| verify(&tangent, followed, limit, &grid).missed;
            assert_eq!(missed(&followed), None);
            let mut directions = [0; 2];
            for h in 0..followed.len() {
                for p in 0..followed[h].paths.len() {
                    let path = followed[h].paths.remove(p);
                    let end = path.points.last().unwrap().theta;
                    let is_within = end.im.abs() < limit;
                    let harmonic = followed[h].problem.tangent.harmonic;
                    assert_eq!(missed(&followed), is_within.then_some(harmonic), "{end}");
                    directions[usize::from(end.im < 0.0)] += usize::from(is_within);
                    followed[h].paths.insert(p, path);
                }
            }
            assert!(directions.iter().all(|count| *count >= 3), "{directions:?}");
        }
    }
}
