//! The stiffness operator of a body.

use super::{SteppedBody, TransientModel};
use crate::fem::operator::{
    OperatorError, SectorStencil, SimdLevel, SparseOperator, StiffnessOperator,
};
use crate::fem::sector::supports;
use crate::fem::{MassKind, lumped_masses};
use crate::prestress::Assembly;
use crate::transient::{OperatorChoice, TransientError};
use std::collections::BTreeMap;

impl TransientModel<'_> {
    /// Its operator: the stencil of a sector where the mesh has one, else rows of a matrix.
    ///
    /// # Errors
    /// [`TransientError::Operator`] if the chosen operator cannot represent the mesh.
    pub fn operator(
        &self,
        choice: OperatorChoice,
        simd: SimdLevel,
    ) -> Result<Box<dyn StiffnessOperator>, TransientError> {
        match (self.body, choice) {
            (SteppedBody::Plane { mesh, annulus }, _) => {
                let is_cyclic = match choice {
                    OperatorChoice::Auto => annulus.is_some() && mesh.is_quad4(),
                    OperatorChoice::Cyclic => true,
                    OperatorChoice::Sparse => false,
                };
                if !is_cyclic {
                    return Ok(Box::new(SparseOperator::assemble(mesh, self.material, simd)?));
                }
                let annulus = annulus.ok_or(OperatorError::NoSymmetry)?;
                Ok(Box::new(SectorStencil::of_annulus(annulus, self.material, simd)?))
            }
            (SteppedBody::Revolution(_), OperatorChoice::Sparse) => {
                Err(OperatorError::NotPlane.into())
            }
            (SteppedBody::Revolution(sector), _) => {
                let [springs, _] = supports(sector, MassKind::Lumped);
                let material = self.material;
                Ok(Box::new(SectorStencil::of_revolution(sector, material, &springs, simd)?))
            }
            (SteppedBody::Assembly { .. }, OperatorChoice::Cyclic) => {
                Err(OperatorError::NoSymmetry.into())
            }
            (SteppedBody::Assembly { assembly, .. }, _) => Ok(Box::new(assembled(assembly, simd)?)),
        }
    }
}

/// The stiffness of solid bodies over the dofs that move by themselves, with their lumped masses.
///
/// The mass of a dof that follows others goes to these, by the size of their shares.
fn assembled(assembly: &Assembly<'_>, simd: SimdLevel) -> Result<SparseOperator<3>, OperatorError> {
    let (mesh, basis) = (assembly.mesh, &assembly.joined.basis);
    let unknowns = basis.unknowns();
    let moves = |dof: usize| unknowns.unknown_of[dof].is_some();

    // What each dof that follows others follows.
    let mut followers: BTreeMap<usize, Vec<(u32, f64)>> = BTreeMap::new();
    for (dof, row) in basis.combinations() {
        let shares = row.iter().filter(|(other, share)| moves(*other) && *share != 0.0);
        followers.insert(dof, shares.map(|&(other, share)| (other as u32, share)).collect());
    }

    // A dof that moves by itself has all its mass.
    let masses = lumped_masses(mesh, assembly.materials);
    let mut own = vec![0.0; mesh.dof_count()];
    for (dof, mass) in masses.iter().flat_map(|&mass| [mass; 3]).enumerate() {
        let itself = [(dof as u32, 1.0)];
        let shares = match followers.get(&dof) {
            Some(shares) => &shares[..],
            None => &itself[..usize::from(moves(dof))],
        };
        let total: f64 = shares.iter().map(|(_, share)| share.abs()).sum();
        for &(other, share) in shares {
            own[other as usize] += mass * share.abs() / total;
        }
    }

    let stiffness = assembly.joined.stiffness();
    let followers = followers.into_iter().map(|(dof, shares)| (dof as u32, shares));
    SparseOperator::new(&basis.congruent(&stiffness), own, followers.collect(), simd)
}
