//! Model of a transient of a plane body.

use super::boundary::{BoundaryForces, extra_damping};
use super::compliance::CompliantContact;
use super::contact::ContactPart;
use super::settings::{check_times, stable_step_limit, stiffening};
use super::{
    LagrangeContact, OperatorChoice, Perturbation, StepPlan, TransientError, TransientSettings,
};
use crate::contact::{ContactInterface, ContactStiffness, Row, SlidingContact};
use crate::fem::operator::{
    CyclicStencil, OperatorError, SimdLevel, SparseOperator, StiffnessOperator,
    largest_frequency_of,
};
use crate::fem::{
    MassKind, MaterialField, RayleighDamping, assemble_extra_damping, assemble_stiffness,
    assemble_supports, lumped_masses,
};
use crate::mesh::{AnnulusMesh, Mesh};
use crate::prestress::SteadySliding;

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

    /// Its operator.
    ///
    /// # Errors
    /// As [`build_operator`].
    pub(super) fn operator(
        &self,
        choice: OperatorChoice,
        simd: SimdLevel,
    ) -> Result<Box<dyn StiffnessOperator>, TransientError> {
        build_operator(self, choice, simd)
    }

    /// Distance of a node from the origin (m) and the angle of its frame (rad).
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        let [x, y] = self.mesh.plane_node(node);
        [x.hypot(y), self.mesh.frame_angles()[node]]
    }

    /// Displacement of steady sliding over all dofs, m.
    pub(super) fn sliding_displacement(&self) -> Result<Vec<f64>, TransientError> {
        let stiffness = assemble_stiffness(self.mesh, self.material);
        let law = self.stiffness.law;
        let base = SteadySliding::solve_with(self.mesh, &stiffness, &self.contact, law)?;
        Ok(base.displacement(self.contact.friction_coefficient))
    }

    pub(super) fn boundary_forces(&self, operator: &dyn StiffnessOperator) -> BoundaryForces {
        let own = assemble_extra_damping(self.mesh, self.material, MassKind::Lumped, self.damping);
        let pressure = self.mesh.pressure_forces().unwrap_or_default();
        let supports = assemble_supports(self.mesh);
        let damping = extra_damping(&supports, own, self.damping);
        BoundaryForces::of(&damping, &pressure, operator)
    }

    pub(super) fn perturbed(
        &self,
        perturbation: &Perturbation,
    ) -> Result<Vec<f64>, TransientError> {
        perturbation.field(self)
    }

    /// The contact nodes of `interface`, all open.
    ///
    /// # Errors
    /// [`TransientError::Prestress`] where the springs of a compliant contact have no base state.
    pub(super) fn lagrange_contact(
        &self,
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
    ) -> Result<LagrangeContact, TransientError> {
        let speed = interface.surface_speed(self.contact.rotation_speed);
        let mut points = interface.points(&self.contact);
        // Along the second axes of the nodes, with its sign.
        points.iter_mut().for_each(|point| point.speed = speed);
        let part = ContactPart {
            nodes: ContactPart::nodes_as_points(points.len()),
            points: &points,
            law: self.contact.law(),
            interference: self.contact.interference,
            springs: self.springs(interface)?,
            tangential_damping: self.stiffness.tangential_damping,
        };
        Ok(LagrangeContact::new(operator, 1, vec![part], &Row::clone))
    }

    /// The springs of the contact; `None` where it is rigid.
    fn springs(
        &self,
        interface: &ContactInterface,
    ) -> Result<Option<CompliantContact>, TransientError> {
        let own = &self.stiffness;
        let Some(stiffness) = own.normal_stiffness else {
            return Ok(None);
        };
        let shares = &interface.tributary_lengths;
        let elastic = || assemble_stiffness(self.mesh, self.material);
        let friction = self.contact.friction_coefficient;
        let Some(law) = own.law else {
            let base = SteadySliding::solve(self.mesh, &elastic(), &self.contact)?;
            let forces = base.normal_forces(friction);
            let constants = [stiffness, own.normal_damping];
            return Ok(Some(CompliantContact::of(constants, shares, &forces)));
        };
        // Dashpots that follow the stiffness of a law have that of the base state.
        let mut damping: Vec<f64> = shares.iter().map(|w| own.normal_damping * w).collect();
        if own.law_damping > 0.0 {
            let base = SteadySliding::solve_with(self.mesh, &elastic(), &self.contact, Some(law))?;
            let springs = base.springs(friction);
            for (damping, spring) in damping.iter_mut().zip(springs.iter().flatten()) {
                *damping += own.law_damping * spring;
            }
        }
        Ok(Some(CompliantContact::stiffening(law, shares, damping)))
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
