//! What the time loop steps: bodies with their contact.

mod contact;
mod operator;

use super::boundary::BoundaryForces;
use super::perturbation::{Place, places};
use super::relaxation::Relaxation;
use super::settings::{check_times, stable_step_limit, stiffening};
use super::{Perturbation, StepPlan, TransientError, TransientSettings};
use crate::contact::{ContactInterface, ContactStiffness, SlidingContact};
use crate::fem::operator::{StiffnessOperator, largest_frequency_of};
use crate::fem::{
    MassKind, MaterialField, RayleighDamping, Triplets, assemble_extra_damping, assemble_pressures,
    assemble_supports, beside,
};
use crate::mesh::{AnnulusMesh, BoundaryCondition, Mesh, SolidFace, SolidSector};
use crate::prestress::{Assembly, Elimination};
use nalgebra::Vector3;
use std::borrow::Cow;

/// Bodies of a mesh or of revolution.
#[derive(Clone, Copy, Debug)]
pub enum SteppedBody<'a> {
    /// In the plane, two components a node; the annulus that the mesh belongs to, if it is one.
    Plane {
        /// Its mesh.
        mesh: &'a Mesh,
        /// What it was generated as.
        annulus: Option<&'a AnnulusMesh>,
    },
    /// Of revolution, of bricks with 8 nodes.
    ///
    /// Dofs over the whole body are `3 (s n + k) + c`: component `c` of `(u_r, u_theta, u_z)` at node `k` of sector `s`, `n` nodes
    /// to a sector.
    Revolution {
        /// One of its sectors.
        sector: &'a SolidSector,
        /// All of it, [`SolidSector::whole`].
        mesh: &'a Mesh,
    },
    /// Solid bodies that are tied together and slide on each other.
    ///
    /// Dofs are those of the mesh, three a node in its frame; ties and held dofs are eliminated, what follows others moves with
    /// them. Meshes stay where they are: sliding is a relative velocity at each contact point.
    Assembly {
        /// The bodies with their ties and contacts.
        assembly: &'a Assembly<'a>,
        /// Point of the axis about which places are told, and the axis.
        axis: [[f64; 3]; 2],
    },
}

/// A body with its material and its contact; forces and energies are for each metre of thickness in the plane, else in N and J.
#[derive(Clone, Copy, Debug)]
pub struct TransientModel<'a> {
    /// The body.
    pub body: SteppedBody<'a>,
    /// Its materials.
    pub material: &'a dyn MaterialField,
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
    /// Friction and speed of the counterface; of an assembly the friction of its first contact, and the speed of its first motion.
    pub contact: SlidingContact,
    /// Springs and dashpots of the contact of one body; those of an assembly have their own.
    pub stiffness: ContactStiffness,
    /// Stiffness damping that acts on the springs of contacts too, s.
    pub contact_damping: f64,
}

impl<'a> TransientModel<'a> {
    /// A body in rigid contact.
    pub fn new(
        body: SteppedBody<'a>,
        material: &'a dyn MaterialField,
        damping: RayleighDamping,
        contact: SlidingContact,
    ) -> Self {
        let stiffness = ContactStiffness::default();
        Self { body, material, damping, contact, stiffness, contact_damping: 0.0 }
    }

    /// A generated annulus in rigid contact.
    pub fn of_annulus(
        annulus: &'a AnnulusMesh,
        material: &'a dyn MaterialField,
        damping: RayleighDamping,
        contact: SlidingContact,
    ) -> Self {
        let body = SteppedBody::Plane { mesh: &annulus.mesh, annulus: Some(annulus) };
        Self::new(body, material, damping, contact)
    }

    /// Displacement components of a node: 2, or 3.
    pub fn components(&self) -> usize {
        if let SteppedBody::Plane { .. } = self.body { 2 } else { 3 }
    }

    /// The mesh of all dofs.
    pub fn mesh(&self) -> &'a Mesh {
        match self.body {
            SteppedBody::Plane { mesh, .. } | SteppedBody::Revolution { mesh, .. } => mesh,
            SteppedBody::Assembly { assembly, .. } => assembly.mesh,
        }
    }

    /// Which dofs are held, and which follow others.
    fn basis(&self) -> Cow<'a, Elimination> {
        let total = self.mesh().dof_count();
        Cow::Owned(match self.body {
            SteppedBody::Plane { mesh, .. } => Elimination::holding(total, mesh.held_dofs()),
            SteppedBody::Revolution { sector: SolidSector { strip, .. }, .. } => {
                let is_held = |dof: &usize| strip.is_held[dof % strip.dof_count()];
                Elimination::holding(total, (0..total).filter(is_held))
            }
            SteppedBody::Assembly { assembly, .. } => return Cow::Borrowed(&assembly.joined.basis),
        })
    }

    /// A matrix over all dofs without those that are held or follow others.
    fn bound(&self, matrix: Triplets) -> Triplets {
        let basis = self.basis();
        let unknowns = basis.unknowns();
        let mut matrix = basis.congruent(&matrix).into_owned();
        let moves = |dof: usize| unknowns.unknown_of[dof].is_some();
        matrix.entries.retain(|&(row, column, _)| moves(row) && moves(column));
        matrix
    }

    /// Distance of a node from the axis, of a plane body from the origin (m), and its angle about it (rad).
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        match self.body {
            SteppedBody::Plane { mesh, .. } | SteppedBody::Revolution { mesh, .. } => {
                let [x, y] = mesh.plane_node(node);
                [x.hypot(y), mesh.frame_angles()[node]]
            }
            SteppedBody::Assembly { assembly, axis } => {
                let [center, axis] = axis.map(Vector3::from);
                let arm = Vector3::from(assembly.mesh.nodes[node]) - center;
                let first = beside(&axis); // The zero of the angle.
                let [x, y] = [arm.dot(&first), arm.dot(&axis.cross(&first))];
                [x.hypot(y), y.atan2(x)]
            }
        }
    }

    /// The step of the body: the smallest that any of its parts asks for.
    ///
    /// # Errors
    /// [`TransientError`] names the setting that does not fit, with its bound.
    pub fn plan(
        &self,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<StepPlan, TransientError> {
        check_times(settings)?;
        let count = operator.dof_count() / self.components();
        // Parts that the operator does not connect each have their own highest frequency.
        let part_of = match self.body {
            SteppedBody::Plane { mesh, .. } => mesh.bodies(),
            _ => vec![0; count],
        };
        let parts = part_of.iter().max().map_or(0, |last| last + 1);
        let factor = stiffening(self.mesh(), self.material);
        let rates = self.dashpot_rates(operator);
        let limits = (0..parts).map(|part| {
            let is_part = |dof: usize| part_of[dof / self.components()] == part;
            let frequency = factor * largest_frequency_of(operator, &is_part);
            (stable_step_limit(frequency, &self.bounding_damping(&rates, &is_part)), frequency)
        });
        let (limit, frequency) =
            limits.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0.0));
        StepPlan::within(limit, frequency, settings)
    }

    /// Bound of the decay rates that the dashpots of supports give, dof by dof, 1/s: the sums of the rows of `M^-1 C` (Gershgorin).
    fn dashpot_rates(&self, operator: &dyn StiffnessOperator) -> Vec<f64> {
        let mut rates = vec![0.0; operator.dof_count()];
        let [_, dashpots] = assemble_supports(self.mesh());
        for (row, _, value) in self.bound(dashpots).entries {
            let mass = operator.masses()[operator.position(row)];
            if mass > 0.0 {
                rates[row] += value.abs() / mass;
            }
        }
        rates
    }

    /// Coefficients of a Rayleigh damping that is nowhere below that of the dofs `is_part`, the `rates` of dashpots included: what
    /// bounds the step.
    fn bounding_damping(&self, rates: &[f64], is_part: &dyn Fn(usize) -> bool) -> RayleighDamping {
        let mut bound = RayleighDamping::default();
        let mesh = self.mesh();
        let first_dof = |e: usize| mesh.dimension * mesh.element_nodes(e)[0] as usize;
        for e in (0..mesh.element_count()).filter(|&e| is_part(first_dof(e))) {
            let own = self.material.own_damping(mesh.region(e)).unwrap_or(self.damping);
            bound.mass_coefficient = bound.mass_coefficient.max(own.mass_coefficient);
            bound.stiffness_coefficient =
                bound.stiffness_coefficient.max(own.stiffness_coefficient);
        }
        let rates = rates.iter().enumerate().filter(|(dof, _)| is_part(*dof));
        bound.mass_coefficient += rates.map(|(_, rate)| *rate).fold(0.0, f64::max);
        // Patches may overlap.
        for patch in &mesh.patches {
            bound.mass_coefficient += patch.mass_coefficient;
            bound.stiffness_coefficient += patch.stiffness_coefficient;
        }
        bound
    }

    /// Supports, pressures, and regions with a damping of their own.
    pub(super) fn boundary_forces(&self, operator: &dyn StiffnessOperator) -> BoundaryForces {
        let (mesh, kind) = (self.mesh(), MassKind::Lumped);
        let [springs, mut damping] = assemble_supports(mesh);
        let beta = self.damping.stiffness_coefficient;
        if beta != 0.0 {
            damping.entries.extend(springs.scaled(-beta).entries);
        }
        let [masses, own] = assemble_extra_damping(mesh, self.material, kind, self.damping);
        damping.entries.extend(own.entries);
        let mut damping = self.bound(damping);
        let basis = self.basis();
        damping.entries.extend(basis.gathered(&masses).entries); // Lumped as the masses are.
        let pressure = assemble_pressures(mesh).map(|load| basis.transposed_forces(&load));
        BoundaryForces::of(damping, &pressure.unwrap_or_default(), operator)
    }

    /// Maxwell elements of its regions.
    pub(super) fn relaxation(&self, operator: &dyn StiffnessOperator) -> Relaxation {
        Relaxation::new(self.mesh(), self.material, operator, &|matrix| self.bound(matrix))
    }

    /// Highest circumferential harmonic that the contact nodes show.
    pub fn highest_harmonic(&self) -> usize {
        match self.body {
            SteppedBody::Plane { mesh, .. } => ContactInterface::of(mesh).len() / 2,
            SteppedBody::Revolution { sector, .. } => sector.sector_count() / 2,
            // Its contact nodes are no edge.
            SteppedBody::Assembly { .. } => 0,
        }
    }

    /// The velocity of a perturbation over all dofs, m/s.
    ///
    /// On a plane body that is no annulus the depth is the distance from the counterface over the largest there is, and the
    /// angle that about the cylinder's axis, or `2 pi` times the share of the contact edge along a plane. Waves on a body of
    /// revolution are uniform over the thickness, and fade towards the cylinder that is clamped, the outer one where neither is;
    /// those of an assembly go along its axis over all bodies.
    ///
    /// # Errors
    /// [`TransientError::Setting`] for a harmonic above half the circumferential elements.
    pub fn perturbed(&self, perturbation: &Perturbation) -> Result<Vec<f64>, TransientError> {
        perturbation.check_harmonics(match self.body {
            SteppedBody::Plane { annulus: Some(annulus), .. } => annulus.sector_count(),
            SteppedBody::Revolution { sector, .. } => sector.sector_count(),
            _ => self.interface().len(),
        })?;
        let places = self.places();
        let mut velocity = vec![0.0; self.components() * places.len()];
        for (own, place) in velocity.chunks_exact_mut(self.components()).zip(&places) {
            let along = perturbation.along(place);
            own.iter_mut().zip(place.direction).for_each(|(v, share)| *v += along * share);
        }
        perturbation.add_noise(&mut velocity, self.components());
        // What is held or follows others does not move by itself.
        let basis = self.basis();
        let unknowns = basis.unknowns();
        Ok(basis.displacement(&unknowns.expand(&unknowns.restrict(&velocity))))
    }

    /// Where each node stands for the waves of a perturbation.
    fn places(&self) -> Vec<Place> {
        match self.body {
            SteppedBody::Plane { mesh, annulus } => places(mesh, annulus),
            SteppedBody::Revolution { sector, .. } => {
                let own = &sector.specification;
                let (inner, outer) = (own.annulus.inner_radius, own.annulus.outer_radius);
                let fades_inwards =
                    own.conditions[SolidFace::Inner as usize] == BoundaryCondition::Clamped;
                let nodes = 0..sector.node_count() * sector.sector_count();
                let place = nodes.map(|node| {
                    let [radius, angle] = self.place(node);
                    let share = (radius - inner) / (outer - inner);
                    let depth = if fades_inwards { 1.0 - share } else { share };
                    Place { depth, angle, direction: [0.0, 1.0, 0.0] }
                });
                place.collect()
            }
            SteppedBody::Assembly { assembly, axis } => {
                let mesh = assembly.mesh;
                let along = Vector3::from(axis[1]);
                let place = (0..mesh.node_count()).map(|node| Place {
                    depth: 0.0,
                    angle: self.place(node)[1],
                    direction: (mesh.frame(node).transpose() * along).into(),
                });
                place.collect()
            }
        }
    }
}
