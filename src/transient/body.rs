//! The bodies that the time loop steps: of two components at each node, or of three.

use super::boundary::BoundaryForces;
use super::relaxation::Relaxation;
use super::{
    AssemblyTransientModel, LagrangeContact, OperatorChoice, Perturbation, SolidTransientModel,
    StepPlan, TransientError, TransientModel, TransientSettings, build_operator,
};
use crate::contact::{ContactInterface, SlidingContact};
use crate::fem::operator::{OperatorError, SimdLevel, StiffnessOperator};
use crate::fem::{RayleighDamping, Triplets, assemble_stiffness};
use crate::prestress::SteadySliding;

/// A body and its contact.
#[derive(Clone, Copy, Debug)]
pub enum TransientBody<'a> {
    /// In the plane.
    Plane(TransientModel<'a>),
    /// Of revolution, in three dimensions.
    Solid(SolidTransientModel<'a>),
    /// Solid bodies of a mesh.
    Assembly(AssemblyTransientModel<'a>),
}

impl<'a> From<TransientModel<'a>> for TransientBody<'a> {
    fn from(model: TransientModel<'a>) -> Self {
        Self::Plane(model)
    }
}

impl<'a> From<&TransientModel<'a>> for TransientBody<'a> {
    fn from(model: &TransientModel<'a>) -> Self {
        Self::Plane(*model)
    }
}

impl<'a> From<SolidTransientModel<'a>> for TransientBody<'a> {
    fn from(model: SolidTransientModel<'a>) -> Self {
        Self::Solid(model)
    }
}

impl<'a> From<AssemblyTransientModel<'a>> for TransientBody<'a> {
    fn from(model: AssemblyTransientModel<'a>) -> Self {
        Self::Assembly(model)
    }
}

impl TransientBody<'_> {
    /// Displacement components of a node: 2, or 3.
    pub fn components(&self) -> usize {
        match self {
            Self::Plane(_) => 2,
            Self::Solid(_) | Self::Assembly(_) => 3,
        }
    }

    /// Rayleigh coefficients.
    pub fn damping(&self) -> RayleighDamping {
        match self {
            Self::Plane(model) => model.damping,
            Self::Solid(model) => model.damping,
            Self::Assembly(model) => model.damping,
        }
    }

    /// Its operator.
    ///
    /// # Errors
    /// [`TransientError::Operator`] if the chosen operator cannot represent the mesh.
    pub fn operator(
        &self,
        choice: OperatorChoice,
        simd: SimdLevel,
    ) -> Result<Box<dyn StiffnessOperator>, TransientError> {
        match self {
            Self::Plane(model) => build_operator(model, choice, simd),
            Self::Solid(model) => model.operator(choice, simd),
            Self::Assembly(_) if choice == OperatorChoice::Cyclic => {
                Err(OperatorError::NoSymmetry.into())
            }
            Self::Assembly(model) => model.operator(simd),
        }
    }

    /// The rotor.
    pub fn contact(&self) -> &SlidingContact {
        match self {
            Self::Plane(model) => &model.contact,
            Self::Solid(model) => &model.contact,
            Self::Assembly(model) => &model.contact,
        }
    }

    /// The contact nodes.
    pub fn interface(&self) -> ContactInterface {
        match self {
            Self::Plane(model) => model.interface(),
            Self::Solid(model) => model.interface(),
            Self::Assembly(model) => model.interface(),
        }
    }

    /// Highest circumferential harmonic that the contact nodes show.
    pub fn highest_harmonic(&self) -> usize {
        match self {
            Self::Plane(model) => model.interface().len() / 2,
            Self::Solid(model) => model.sector.sector_count() / 2,
            // Its contact nodes are no edge.
            Self::Assembly(_) => 0,
        }
    }

    /// Radius (m) and angle (rad) of a node.
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        match self {
            Self::Plane(model) => {
                let [x, y] = model.mesh.plane_node(node);
                [x.hypot(y), model.mesh.frame_angles()[node]]
            }
            Self::Solid(SolidTransientModel { sector, .. }) => {
                let (local, s) = (node % sector.node_count(), node / sector.node_count());
                [sector.nodes[local].radius, sector.angle(local, s)]
            }
            Self::Assembly(model) => model.place(node),
        }
    }

    /// Displacement of steady sliding over all dofs, m.
    ///
    /// # Errors
    /// Where there is none.
    pub fn sliding_displacement(&self) -> Result<Vec<f64>, TransientError> {
        match self {
            Self::Plane(model) => {
                let stiffness = assemble_stiffness(model.mesh, model.material);
                let law = model.stiffness.law;
                let base = SteadySliding::solve_with(model.mesh, &stiffness, &model.contact, law)?;
                Ok(base.displacement(model.contact.friction_coefficient))
            }
            Self::Solid(model) => model.sliding_displacement(),
            Self::Assembly(model) => model.sliding_displacement(),
        }
    }

    pub(super) fn plan(
        &self,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<StepPlan, TransientError> {
        match self {
            Self::Plane(model) => model.plan(operator, settings),
            Self::Solid(model) => model.plan(operator, settings),
            Self::Assembly(model) => model.plan(operator, settings),
        }
    }

    pub(super) fn boundary_forces(&self, operator: &dyn StiffnessOperator) -> BoundaryForces {
        match self {
            Self::Plane(model) => BoundaryForces::new(model, operator),
            Self::Solid(model) => model.boundary_forces(operator),
            Self::Assembly(model) => model.boundary_forces(operator),
        }
    }

    /// Maxwell elements of its regions.
    pub(super) fn relaxation(&self, operator: &dyn StiffnessOperator) -> Relaxation {
        match self {
            Self::Plane(model) => {
                Relaxation::new(model.mesh, model.material, operator, &|matrix| matrix)
            }
            Self::Solid(_) => Relaxation::default(),
            Self::Assembly(model) => {
                let (assembly, basis) = (model.assembly, model.assembly.basis());
                let bound = |matrix: Triplets| basis.congruent(&matrix);
                Relaxation::new(assembly.mesh(), assembly.materials(), operator, &bound)
            }
        }
    }

    pub(super) fn lagrange_contact(
        &self,
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
    ) -> Result<LagrangeContact, TransientError> {
        match self {
            Self::Plane(model) => LagrangeContact::new(operator, interface, model),
            Self::Solid(model) => model.lagrange_contact(operator, interface),
            Self::Assembly(model) => model.lagrange_contact(operator),
        }
    }

    /// The velocity of a perturbation over all dofs, m/s.
    pub(super) fn perturbed(
        &self,
        perturbation: &Perturbation,
    ) -> Result<Vec<f64>, TransientError> {
        match self {
            Self::Plane(model) => perturbation.field(model),
            Self::Solid(model) => model.perturbed(perturbation),
            Self::Assembly(model) => model.perturbed(perturbation),
        }
    }
}

impl StepPlan {
    /// The step of a body, as [`Self::new`]: the smallest that any of its parts asks for.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn of<'a>(
        body: impl Into<TransientBody<'a>>,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<Self, TransientError> {
        body.into().plan(operator, settings)
    }
}
