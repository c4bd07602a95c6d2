//! Model of a transient of an assembly of solid bodies.

use super::boundary::{BoundaryForces, extra_damping};
use super::compliance::SpringDamping;
use super::contact::ContactPart;
use super::perturbation::Place;
use super::settings::stiffening;
use super::{
    LagrangeContact, OperatorChoice, Perturbation, StepPlan, TransientError, TransientSettings,
};
use crate::contact::{ContactInterface, CoulombFriction, Row, SlidingContact};
use crate::fem::operator::{AssembledOperator, OperatorError, SimdLevel, StiffnessOperator};
use crate::fem::{
    MassKind, RayleighDamping, assemble_extra_damping, assemble_pressures, lumped_masses,
};
use crate::mesh::Counterface;
use crate::prestress::{Assembly, PressedRange, PressedState, PrestressError};
use std::collections::BTreeMap;

/// Solid bodies that are tied together and slide on each other.
///
/// Dofs are those of the mesh, three a node in its frame; ties and held dofs are eliminated, what follows others moves with
/// them. Meshes stay where they are: sliding is a relative velocity at each contact point. Forces are in N, energies in J.
#[derive(Clone, Copy, Debug)]
pub struct AssemblyTransientModel<'a> {
    /// The bodies with their ties and contacts.
    pub assembly: &'a Assembly<'a>,
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
    /// Friction of the first contact, and the speed of the first motion.
    pub contact: SlidingContact,
    /// Stiffness damping that acts on the springs of contacts too, s.
    pub contact_damping: f64,
    /// Point of the axis about which places are told, and the axis.
    pub axis: [[f64; 3]; 2],
}

impl AssemblyTransientModel<'_> {
    /// Its operator: the stiffness over the dofs that move by themselves, with their lumped masses.
    ///
    /// The mass of a dof that follows others goes to these, by the size of their shares.
    ///
    /// # Errors
    /// [`TransientError::Operator`] where a node has no positive mass, and for [`OperatorChoice::Cyclic`].
    pub fn operator(
        &self,
        choice: OperatorChoice,
        simd: SimdLevel,
    ) -> Result<Box<dyn StiffnessOperator>, TransientError> {
        if choice == OperatorChoice::Cyclic {
            return Err(OperatorError::NoSymmetry.into());
        }
        let (mesh, basis) = (self.assembly.mesh(), self.assembly.basis());
        let unknowns = basis.unknowns();
        let moves = |dof: usize| unknowns.unknown_of[dof].is_some();
        let masses = lumped_masses(mesh, self.assembly.materials());
        let mut own = vec![0.0; mesh.dof_count()];
        let mut followers = BTreeMap::new();
        for (dof, row) in basis.combinations() {
            let shares: Vec<(u32, f64)> = row
                .iter()
                .filter(|(other, share)| moves(*other) && *share != 0.0)
                .map(|&(other, share)| (other as u32, share))
                .collect();
            followers.insert(dof, shares);
        }
        for (dof, mass) in masses.iter().flat_map(|&mass| [mass; 3]).enumerate() {
            match followers.get(&dof) {
                None if moves(dof) => own[dof] += mass,
                None => {}
                Some(shares) => {
                    let total: f64 = shares.iter().map(|(_, share)| share.abs()).sum();
                    for &(other, share) in shares {
                        own[other as usize] += mass * share.abs() / total;
                    }
                }
            }
        }
        let mut stiffness = self.assembly.elastic().clone();
        let [springs, _] = self.assembly.supports();
        stiffness.entries.extend_from_slice(&springs.entries);
        let followers = followers.into_iter();
        let followers = followers.map(|(dof, shares)| (dof as u32, shares)).collect();
        let stiffness = basis.congruent(&stiffness);
        let operator = AssembledOperator::new(&stiffness, own, followers, simd)?;
        Ok(Box::new(operator))
    }

    /// The nodes of the contact surfaces, contact by contact; each has an area for a length and its angle about the axis.
    pub fn interface(&self) -> ContactInterface {
        let (mut nodes, mut areas) = (Vec::new(), Vec::new());
        for (_, surface) in self.assembly.contacts() {
            let mut own: BTreeMap<u32, f64> = surface.nodes.iter().map(|&n| (n, 0.0)).collect();
            for (point, shares) in surface.points.iter().zip(&surface.shares) {
                for &(node, share) in shares {
                    *own.entry(node).or_default() += share * point.weight;
                }
            }
            nodes.extend(own.keys());
            areas.extend(own.values());
        }
        let angles = nodes.iter().map(|&node: &u32| self.place(node as usize)[1]);
        ContactInterface {
            angles: angles.collect(),
            gaps: vec![0.0; nodes.len()],
            nodes,
            tributary_lengths: areas,
            counterface: Counterface::Plane { point: [0.0; 2], direction: [1.0, 0.0] },
            opposite: Vec::new(),
        }
    }

    /// Distance of a node from the axis (m) and its angle about it (rad).
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        let [center, axis] = self.axis.map(nalgebra::Vector3::from);
        let arm = nalgebra::Vector3::from(self.assembly.mesh().nodes[node]) - center;
        // The axis with the smallest share along the other one gives the zero of the angle.
        let first = nalgebra::Vector3::ith(axis.iamin(), 1.0);
        let first = (first - axis * axis.dot(&first)).normalize();
        let [x, y] = [arm.dot(&first), arm.dot(&axis.cross(&first))];
        [x.hypot(y), y.atan2(x)]
    }

    /// Displacement of steady sliding over all dofs, m.
    pub(super) fn sliding_displacement(&self) -> Result<Vec<f64>, TransientError> {
        let state = self.sliding_state()?;
        Ok(state.displacement(self.contact.friction_coefficient))
    }

    fn sliding_state(&self) -> Result<PressedState, TransientError> {
        let friction_coefficient = self.contact.friction_coefficient;
        let PressedRange { states, state_of, .. } = self.assembly.range(&[friction_coefficient])?;
        let place = state_of.first().copied();
        let state = place.and_then(|at| states.into_iter().nth(at));
        let none = PrestressError::NoState { friction_coefficient };
        Ok(state.ok_or(none)?)
    }

    pub(super) fn plan(
        &self,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<StepPlan, TransientError> {
        let factor = stiffening(self.assembly.mesh(), self.assembly.materials());
        StepPlan::stiffened(operator, factor, &self.bounding_damping(operator), settings)
    }

    /// Coefficients of a Rayleigh damping that is nowhere below that of the bodies and their supports: what bounds the step.
    fn bounding_damping(&self, operator: &dyn StiffnessOperator) -> RayleighDamping {
        let mut bound = self.damping;
        let (mesh, materials) = (self.assembly.mesh(), self.assembly.materials());
        for region in 0..mesh.regions.len() {
            let own = materials.own_damping(region).unwrap_or(self.damping);
            bound.mass_coefficient = bound.mass_coefficient.max(own.mass_coefficient);
            bound.stiffness_coefficient =
                bound.stiffness_coefficient.max(own.stiffness_coefficient);
        }
        let [_, dashpots] = self.assembly.supports();
        let rates = dashpots.entries.iter().filter_map(|&(row, column, value)| {
            let mass = operator.masses()[operator.position(row)];
            (row == column && mass > 0.0).then(|| value / mass)
        });
        bound.mass_coefficient += rates.fold(0.0, f64::max);
        bound
    }

    pub(super) fn boundary_forces(&self, operator: &dyn StiffnessOperator) -> BoundaryForces {
        let (mesh, basis) = (self.assembly.mesh(), self.assembly.basis());
        let own =
            assemble_extra_damping(mesh, self.assembly.materials(), MassKind::Lumped, self.damping);
        let damping = extra_damping(self.assembly.supports(), own, self.damping);
        let pressure = assemble_pressures(mesh).unwrap_or_default();
        let pressure = match pressure.is_empty() {
            true => pressure,
            false => basis.transposed_forces(&pressure),
        };
        BoundaryForces::of(&basis.congruent(&damping), &pressure, operator)
    }

    pub(super) fn lagrange_contact(
        &self,
        operator: &dyn StiffnessOperator,
        _interface: &ContactInterface,
    ) -> Result<LagrangeContact, TransientError> {
        let friction = self.contact.friction_coefficient;
        let mut contacts = self.assembly.contacts().iter();
        let stiffens = contacts.any(|(surfaces, _)| surfaces.law.is_some());
        let damped_by = SpringDamping {
            coefficient: self.contact_damping,
            springs: match stiffens && self.contact_damping > 0.0 {
                true => self.sliding_state()?.springs(friction),
                false => Vec::new(),
            },
        };
        let mut parts: Vec<ContactPart<'_>> = Vec::new();
        let mut first = 0;
        for (surfaces, surface) in self.assembly.contacts() {
            let mut nodes: BTreeMap<u32, Vec<(usize, f64)>> =
                surface.nodes.iter().map(|&node| (node, Vec::new())).collect();
            for (k, shares) in surface.shares.iter().enumerate() {
                for (node, share) in shares {
                    if let Some(points) = nodes.get_mut(node) {
                        points.push((k, *share));
                    }
                }
            }
            let areas: Vec<f64> = surface.points.iter().map(|point| point.weight).collect();
            parts.push(ContactPart {
                points: &surface.points,
                nodes: nodes.into_values().collect(),
                law: CoulombFriction {
                    friction_coefficient: friction * surfaces.friction.ratio,
                    decay: surfaces.friction.decay,
                },
                interference: surfaces.counter.interference(),
                springs: damped_by.springs_of(surfaces, &areas, first),
                tangential_damping: surfaces.stiffness.tangential_damping,
            });
            first += surface.points.len();
        }
        let bound = |row: &Row| self.assembly.basis().transposed(row);
        Ok(LagrangeContact::new(operator, 2, parts, &bound))
    }

    /// The velocity of a perturbation over all dofs, m/s: waves along the axis of the motion over all bodies, and noise.
    pub(super) fn perturbed(
        &self,
        perturbation: &Perturbation,
    ) -> Result<Vec<f64>, TransientError> {
        let (mesh, basis) = (self.assembly.mesh(), self.assembly.basis());
        perturbation.check_harmonics(self.interface().len())?;
        let axis = nalgebra::Vector3::from(self.axis[1]);
        let mut velocity = vec![0.0; mesh.dof_count()];
        for node in 0..mesh.node_count() {
            let along =
                perturbation.along(&Place { depth: 0.0, angle: self.place(node)[1], tangent: 0.0 });
            let own = mesh.frame(node).transpose() * axis * along;
            velocity[3 * node..3 * node + 3].copy_from_slice(own.as_slice());
        }
        perturbation.add_noise(&mut velocity, 3);
        // What is held or follows others does not move by itself.
        let unknowns = basis.unknowns();
        let free = unknowns.expand(&unknowns.restrict(&velocity));
        Ok(basis.displacement(&free))
    }
}
