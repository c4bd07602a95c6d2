//! Model of a transient of a plane body.

use super::settings::{check_times, stable_step_limit, stiffening};
use super::{OperatorChoice, Perturbation, StepPlan, TransientError, TransientSettings};
use crate::contact::{ContactInterface, ContactStiffness, SlidingContact};
use crate::fem::operator::{
    CyclicStencil, OperatorError, SimdLevel, SparseOperator, StiffnessOperator,
    largest_frequency_of,
};
use crate::fem::{MaterialField, RayleighDamping, lumped_masses};
use crate::mesh::{AnnulusMesh, Mesh};

/// The body and its contact.
#[derive(Clone, Copy, Debug)]
pub struct TransientModel<'a> {
    /// Mesh of the disc.
    pub mesh: &'a Mesh,
    /// The annulus that the mesh belongs to, if it is one.
    pub annulus: Option<&'a AnnulusMesh>,
    /// Its material.
    pub material: &'a dyn MaterialField,
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
    /// The rotating cylinder.
    pub contact: SlidingContact,
    /// Springs and dashpots of the contact; the default is rigid.
    pub stiffness: ContactStiffness,
}

impl<'a> TransientModel<'a> {
    /// A generated annulus of one material in rigid contact.
    pub fn of_annulus(
        annulus: &'a AnnulusMesh,
        material: &'a dyn MaterialField,
        damping: RayleighDamping,
        contact: SlidingContact,
    ) -> Self {
        Self {
            mesh: &annulus.mesh,
            annulus: Some(annulus),
            material,
            damping,
            contact,
            stiffness: ContactStiffness::default(),
        }
    }

    /// The step of the body, as [`StepPlan::new`]: the smallest that any of its parts asks for.
    ///
    /// # Errors
    /// Those of [`StepPlan::new`].
    pub(super) fn plan(
        &self,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<StepPlan, TransientError> {
        check_times(settings)?;
        let bodies = self.mesh.bodies();
        let count = bodies.iter().max().map_or(0, |last| last + 1);
        let factor = stiffening(self.mesh, self.material);
        if count < 2 {
            let damping = self.bounding_damping(&|_| true);
            return StepPlan::stiffened(operator, factor, &damping, settings);
        }
        let limits = (0..count).map(|body| {
            let is_part = |node: usize| bodies[node] == body;
            let frequency = factor * largest_frequency_of(operator, &|dof| is_part(dof / 2));
            let limit = stable_step_limit(frequency, &self.bounding_damping(&is_part));
            (limit, frequency)
        });
        let limits: Vec<(f64, f64)> = limits.collect();
        let smallest = limits.iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let (limit, frequency) = *smallest.expect("a mesh has a body");
        StepPlan::within(limit, frequency, settings)
    }

    /// Coefficients of a Rayleigh damping that is nowhere below that of the nodes `is_part`, dashpots included: what bounds
    /// the step.
    pub fn bounding_damping(&self, is_part: &dyn Fn(usize) -> bool) -> RayleighDamping {
        let mut regions: Vec<usize> = (0..self.mesh.element_count())
            .filter(|&e| is_part(self.mesh.element_nodes(e)[0] as usize))
            .map(|e| self.mesh.region(e))
            .collect();
        regions.sort_unstable();
        regions.dedup();
        let mut bound = RayleighDamping::default();
        for region in regions {
            let own = self.material.own_damping(region).unwrap_or(self.damping);
            bound.mass_coefficient = bound.mass_coefficient.max(own.mass_coefficient);
            bound.stiffness_coefficient =
                bound.stiffness_coefficient.max(own.stiffness_coefficient);
        }
        let mut supports = self.mesh.nodal_supports();
        supports.retain(|support| is_part(support.node));
        if supports.iter().any(|s| s.damping != [[0.0; 2]; 2]) {
            let masses = lumped_masses(self.mesh, self.material);
            let rates =
                supports.iter().map(|s| (s.damping[0][0] + s.damping[1][1]) / masses[s.node]);
            bound.mass_coefficient += rates.fold(0.0, f64::max);
        }
        // Patches may overlap.
        for patch in &self.mesh.patches {
            bound.mass_coefficient += patch.mass_coefficient;
            bound.stiffness_coefficient += patch.stiffness_coefficient;
        }
        bound
    }

    /// The contact edge.
    pub fn interface(&self) -> ContactInterface {
        ContactInterface::of(self.mesh)
    }
}

impl Perturbation {
    /// Velocity over all dofs of `model`, m/s.
    ///
    /// On a body that is no annulus the depth is the distance from the counterface over the largest there is, and the
    /// angle that about the cylinder's axis, or `2 pi` times the share of the contact edge along a plane.
    ///
    /// # Errors
    /// [`TransientError::HarmonicAboveNyquist`] for a harmonic above half the circumferential elements.
    pub fn field(&self, model: &TransientModel<'_>) -> Result<Vec<f64>, TransientError> {
        self.over(model.mesh, model.annulus)
    }
}

/// The operator of `model`.
///
/// # Errors
/// [`TransientError::Operator`] if the chosen operator cannot represent the mesh.
pub fn build_operator(
    model: &TransientModel<'_>,
    choice: OperatorChoice,
    simd: SimdLevel,
) -> Result<Box<dyn StiffnessOperator>, TransientError> {
    let is_cyclic = match choice {
        OperatorChoice::Auto => model.annulus.is_some() && model.mesh.is_quad4(),
        OperatorChoice::Cyclic => true,
        OperatorChoice::Sparse => false,
    };
    if !is_cyclic {
        let operator = SparseOperator::assemble(model.mesh, model.material, simd)?;
        return Ok(Box::new(operator));
    }
    let annulus = model.annulus.ok_or(OperatorError::NoSymmetry)?;
    let stencil = CyclicStencil::assemble(annulus, model.material, simd)?;
    Ok(Box::new(stencil))
}
