//! The bodies that the time loop steps: of two components at each node, or of three.

use super::boundary::BoundaryForces;
use super::relaxation::Relaxation;
use super::{
    AssemblyTransientModel, LagrangeContact, OperatorChoice, Perturbation, SolidTransientModel,
    StepPlan, TransientError, TransientModel, TransientSettings,
};
use crate::contact::{ContactInterface, SlidingContact};
use crate::fem::operator::{SimdLevel, StiffnessOperator};
use crate::fem::{MaterialField, RayleighDamping, Triplets};
use crate::mesh::Mesh;

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

/// An expression of the model of any body.
macro_rules! of_any {
    ($body:expr, $model:ident => $value:expr) => {
        match $body {
            TransientBody::Plane($model) => $value,
            TransientBody::Solid($model) => $value,
            TransientBody::Assembly($model) => $value,
        }
    };
}

impl TransientBody<'_> {
    /// Displacement components of a node: 2, or 3.
    pub fn components(&self) -> usize {
        if let Self::Plane(_) = self { 2 } else { 3 }
    }

    /// Rayleigh coefficients.
    pub fn damping(&self) -> RayleighDamping {
        of_any!(self, model => model.damping)
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
        of_any!(self, model => model.operator(choice, simd))
    }

    /// The rotor.
    pub fn contact(&self) -> &SlidingContact {
        of_any!(self, model => &model.contact)
    }

    pub(super) fn contact_mut(&mut self) -> &mut SlidingContact {
        of_any!(self, model => &mut model.contact)
    }

    /// The contact nodes.
    pub fn interface(&self) -> ContactInterface {
        of_any!(self, model => model.interface())
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

    /// Distance of a node from the axis (m) and its angle about it (rad).
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        of_any!(self, model => model.place(node))
    }

    /// Displacement of steady sliding over all dofs, m.
    ///
    /// # Errors
    /// Where there is none.
    pub fn sliding_displacement(&self) -> Result<Vec<f64>, TransientError> {
        of_any!(self, model => model.sliding_displacement())
    }

    pub(super) fn plan(
        &self,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<StepPlan, TransientError> {
        of_any!(self, model => model.plan(operator, settings))
    }

    pub(super) fn boundary_forces(&self, operator: &dyn StiffnessOperator) -> BoundaryForces {
        of_any!(self, model => model.boundary_forces(operator))
    }

    /// Maxwell elements of its regions.
    pub(super) fn relaxation(&self, operator: &dyn StiffnessOperator) -> Relaxation {
        let (mesh, materials): (&Mesh, &dyn MaterialField) = match self {
            Self::Plane(model) => (model.mesh, model.material),
            Self::Solid(_) => return Relaxation::default(),
            Self::Assembly(model) => (model.assembly.mesh(), model.assembly.materials()),
        };
        let bound = |matrix: Triplets| match self {
            Self::Assembly(model) => model.assembly.basis().congruent(&matrix),
            _ => matrix,
        };
        Relaxation::new(mesh, materials, operator, &bound)
    }

    pub(super) fn lagrange_contact(
        &self,
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
    ) -> Result<LagrangeContact, TransientError> {
        of_any!(self, model => model.lagrange_contact(operator, interface))
    }

    /// The velocity of a perturbation over all dofs, m/s.
    pub(super) fn perturbed(
        &self,
        perturbation: &Perturbation,
    ) -> Result<Vec<f64>, TransientError> {
        of_any!(self, model => model.perturbed(perturbation))
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
