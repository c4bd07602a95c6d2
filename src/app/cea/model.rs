//! The model that the eigenvalue solvers take.

use super::Failure;
use crate::case::{Case, Cea, CeaMethod};
use crate::fem::{Triplets, assemble_stiffness, nodal_stress};
use crate::mesh::{AnnulusMesh, SectorMesh};
use crate::prestress::{SectorTangent, SlidingTangent, SteadySliding, TangentOptions};
use crate::results::cea::{BaseField, BaseState};
use crate::study::tangent_options;

/// The eigenvalue solver that a case gets: every mesh here has rotational symmetry, so `auto` uses it.
pub fn method_of(cea: &Cea) -> CeaMethod {
    match cea.method {
        CeaMethod::Auto | CeaMethod::Cyclic => CeaMethod::Cyclic,
        CeaMethod::Sparse => CeaMethod::Sparse,
    }
}

/// The model that the solvers take: mesh, base state, and what its tangent is made of.
pub struct SlidingModel {
    /// The mesh with its sectors.
    pub annulus: AnnulusMesh,
    /// Elastic stiffness over all dofs, where the sparse method needs it.
    pub stiffness: Option<Triplets>,
    /// Steady sliding.
    pub base: SteadySliding,
    /// How the tangent is taken.
    pub options: TangentOptions,
}

impl SlidingModel {
    /// Builds the model of a case up to its base state.
    ///
    /// # Errors
    /// A mesh that cannot be built; contact that would open.
    pub fn new(case: &Case, cea: &Cea) -> Result<Self, Failure> {
        let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
        let options = tangent_options(case, cea.mass);
        let sliding = &case.contact.sliding;
        let (base, stiffness) = match method_of(cea) {
            CeaMethod::Sparse => {
                let stiffness = assemble_stiffness(&annulus.mesh, &case.material);
                let base = SteadySliding::solve(&annulus.mesh, &stiffness, sliding)?;
                (base, Some(stiffness))
            }
            CeaMethod::Auto | CeaMethod::Cyclic => {
                let sector = SectorMesh::generate(&case.annulus).map_err(Failure::usage)?;
                let tangent = SectorTangent::linearize(&sector, &case.material, &options, sliding)?;
                let base = SteadySliding::from_sector(&annulus, &sector, tangent.base());
                (base, None)
            }
        };
        Ok(Self {
            annulus,
            stiffness,
            base,
            options,
        })
    }

    /// The tangent over the whole mesh, for the sparse solver.
    pub fn tangent(&self, case: &Case) -> SlidingTangent {
        let assembled;
        let stiffness = match &self.stiffness {
            Some(stiffness) => stiffness,
            None => {
                assembled = assemble_stiffness(&self.annulus.mesh, &case.material);
                &assembled
            }
        };
        SlidingTangent::linearize(
            &self.annulus.mesh,
            &case.material,
            stiffness,
            &self.base,
            &self.options,
        )
    }

    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let friction = case.contact.sliding.friction_coefficient;
        let pressures = self.base.pressures();
        let smallest = pressures.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let traction = self.base.sliding_direction * friction;
        let torque = case.thickness * self.base.torque(friction);
        let shear = [traction * smallest, traction * largest];
        BaseState {
            friction_coefficient: friction,
            // The state is that of full sliding; one where a node would open does not exist.
            slipping: pressures.len(),
            sticking: 0,
            open: 0,
            pressure_pa: [smallest, largest],
            shear_pa: [shear[0].min(shear[1]), shear[0].max(shear[1])],
            torque_n_m: torque,
            power_w: torque * case.contact.sliding.rotation_speed,
        }
    }

    /// The base state node by node.
    pub fn base_field(&self, case: &Case) -> BaseField {
        let friction = case.contact.sliding.friction_coefficient;
        let displacement = self.base.displacement(friction);
        let pressures = self.base.pressures();
        let traction = self.base.sliding_direction * friction;
        BaseField {
            nodes: self.base.interface.nodes.clone(),
            angles: self.base.interface.angles.clone(),
            shears: pressures
                .iter()
                .map(|pressure| traction * pressure)
                .collect(),
            pressures,
            stress: nodal_stress(&self.annulus.mesh, &case.material, &displacement),
            displacement,
        }
    }
}
