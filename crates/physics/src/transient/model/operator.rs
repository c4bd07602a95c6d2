//! The stiffness operator of a body.

use super::{SteppedBody, TransientModel};
use crate::fem::operator::{
    OperatorError, SectorStencil, SimdLevel, SparseOperator, StiffnessOperator,
};
use crate::fem::{MassKind, assemble_mass};
use crate::prestress::Assembly;
use crate::transient::{OperatorChoice, TransientError};

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
        let refused = |problem: &str| OperatorError(format!("transient.operator = {problem}"));
        let no_symmetry = || {
            refused(
                "\"cyclic\" needs the symmetry of the built-in annulus, which an imported mesh does not have; use \"auto\" or \"sparse\"",
            )
        };
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
                let annulus = annulus.ok_or_else(no_symmetry)?;
                Ok(Box::new(SectorStencil::of_annulus(annulus, self.material, simd)?))
            }
            (SteppedBody::Revolution { .. }, OperatorChoice::Sparse) => {
                let problem = "\"sparse\" is for plane bodies; a three-dimensional one takes \"auto\" or \"cyclic\"";
                Err(refused(problem).into())
            }
            (SteppedBody::Revolution { sector, .. }, _) => {
                Ok(Box::new(SectorStencil::of_revolution(sector, self.material, simd)?))
            }
            (SteppedBody::Assembly { .. }, OperatorChoice::Cyclic) => Err(no_symmetry().into()),
            (SteppedBody::Assembly { assembly, .. }, _) => Ok(Box::new(assembled(assembly, simd)?)),
        }
    }
}

/// The stiffness of solid bodies over the dofs that move by themselves, with their lumped masses.
fn assembled(assembly: &Assembly<'_>, simd: SimdLevel) -> Result<SparseOperator<3>, OperatorError> {
    let (mesh, basis) = (assembly.mesh, &assembly.joined.basis);
    let mass = assemble_mass(mesh, assembly.materials, MassKind::Lumped);
    let mut own = vec![0.0; mesh.dof_count()];
    basis.gathered(&mass).entries.into_iter().for_each(|(dof, _, mass)| own[dof] += mass);

    // What each dof that follows others follows.
    let unknowns = basis.unknowns();
    let moves = |dof: usize| unknowns.unknown_of[dof].is_some();
    let followers = basis.combinations().map(|(dof, row)| {
        let shares = row.iter().filter(|(other, share)| moves(*other) && *share != 0.0);
        (dof as u32, shares.map(|&(other, share)| (other as u32, share)).collect())
    });
    let stiffness = basis.congruent(&assembly.joined.stiffness()).into_owned();
    SparseOperator::new(&stiffness, own, followers.collect(), simd)
}
