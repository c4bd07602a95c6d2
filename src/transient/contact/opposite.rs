//! The other body of a contact between two deformable ones.

use super::LagrangeContact;
use crate::contact::{ContactInterface, ContactStatus};
use crate::fem::operator::{MotionFields, StepCoefficients, StiffnessOperator};
use std::collections::BTreeMap;

/// Sweeps over the contact nodes within one step, at most.
const MOST_SWEEPS: usize = 400;

/// Change of a force within a sweep, relative to the largest, at which the sweeps end.
const TOLERANCE: f64 = 1e-12;

/// The dofs of the other body that the contact touches.
#[derive(Clone, Debug)]
pub(super) struct OppositeBody {
    dofs: Vec<TouchedDof>,
    /// For each contact node its shares.
    shares: Vec<Vec<Share>>,
    /// `1 / m` of each contact node and its shares, along the normal and along the tangent, m/kg.
    mobilities: Vec<[f64; 2]>,
    /// Whether two contact nodes share a dof.
    is_coupled: bool,
    /// Velocities of the touched dofs at the end of the step as known so far, m/s.
    velocities: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct TouchedDof {
    place: usize,
    inverse_mass: f64,
    /// Velocity and elastic acceleration before the step.
    before: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
struct Share {
    /// Among the touched dofs.
    touched: usize,
    /// Along the normal and along the tangent.
    along: [f64; 2],
}

impl OppositeBody {
    /// `None` on a rigid counterface. Held dofs do not move and have no share.
    pub fn new(operator: &dyn StiffnessOperator, interface: &ContactInterface) -> Option<Self> {
        if interface.opposite.is_empty() {
            return None;
        }
        let mut touched: BTreeMap<usize, usize> = BTreeMap::new();
        let mut dofs = Vec::new();
        let mut is_coupled = false;
        let mut shares = Vec::new();
        for i in 0..interface.len() {
            let mut own = Vec::new();
            for share in interface.opposite_of(i) {
                let place = operator.position(share.dof);
                let mass = operator.masses()[place];
                let along = [share.normal, share.tangential];
                if mass == 0.0 || along == [0.0; 2] {
                    continue;
                }
                is_coupled |= touched.contains_key(&place);
                let touched = *touched.entry(place).or_insert_with(|| {
                    dofs.push(TouchedDof {
                        place,
                        inverse_mass: 1.0 / mass,
                        before: [0.0; 2],
                    });
                    dofs.len() - 1
                });
                own.push(Share { touched, along });
            }
            shares.push(own);
        }
        let mobilities = (0..interface.len()).map(|i| {
            let place = operator.position(interface.normal_dof(i));
            [0, 1].map(|c| {
                let opposite = shares[i].iter();
                let sum: f64 = opposite
                    .map(|s: &Share| s.along[c] * s.along[c] * dofs[s.touched].inverse_mass)
                    .sum();
                1.0 / operator.masses()[place] + sum
            })
        });
        Some(Self {
            mobilities: mobilities.collect(),
            velocities: vec![0.0; dofs.len()],
            dofs,
            shares,
            is_coupled,
        })
    }

    /// Elastic accelerations after the step without the forces of the contact.
    pub fn settle(&self, fields: &mut MotionFields, time_step: f64) {
        for dof in &self.dofs {
            let [_, elastic] = dof.before;
            fields.elastic[dof.place] = elastic + time_step * fields.elastic_rate[dof.place];
        }
    }

    /// Mean velocity over the step of what contact node `i` meets, along its normal and along its tangent, m/s.
    pub fn mean_velocity(&self, i: usize, fields: &MotionFields) -> [f64; 2] {
        let mut mean = [0.0; 2];
        for share in &self.shares[i] {
            let dof = &self.dofs[share.touched];
            let velocity = 0.5 * (dof.before[0] + fields.velocity[dof.place]);
            mean[0] += share.along[0] * velocity;
            mean[1] += share.along[1] * velocity;
        }
        mean
    }

    /// Displacement of what contact node `i` meets at the half step before `u`, along its normal, m.
    pub fn mean_displacement(&self, i: usize, fields: &MotionFields, time_step: f64) -> f64 {
        let shares = self.shares[i].iter();
        shares
            .map(|share| {
                let place = self.dofs[share.touched].place;
                let mean = fields.displacement[place] - 0.5 * time_step * fields.velocity[place];
                share.along[0] * mean
            })
            .sum()
    }

    /// What contact node `i` meets: its displacement along the normal, its velocity before the step and at its end along
    /// component `c` of the node's frame.
    fn motion(&self, i: usize, c: usize, fields: &MotionFields) -> [f64; 3] {
        let mut motion = [0.0; 3];
        for share in &self.shares[i] {
            let dof = &self.dofs[share.touched];
            motion[0] += share.along[c] * fields.displacement[dof.place];
            motion[1] += share.along[c] * dof.before[0];
            motion[2] += share.along[c] * self.velocities[share.touched];
        }
        motion
    }

    /// Adds an impulse on contact node `i`, of which this body takes the opposite, N s/m.
    fn push(&mut self, i: usize, impulse: [f64; 2]) {
        for share in &self.shares[i] {
            let along = share.along[0] * impulse[0] + share.along[1] * impulse[1];
            self.velocities[share.touched] -= along * self.dofs[share.touched].inverse_mass;
        }
    }
}

impl LagrangeContact {
    /// [`Self::apply`] with a deformable counterface.
    ///
    /// Projected Gauss-Seidel: each node in turn gets the normal force that closes its gap at the end of the step, if
    /// that pushes (or its spring's), and the tangential force of friction under it. One sweep where no two nodes share a
    /// dof. Starts from nothing, so that a step depends on nothing but the fields.
    pub(super) fn apply_between_bodies(
        &mut self,
        fields: &mut MotionFields,
        coefficients: &StepCoefficients,
        shares: [f64; 3],
    ) {
        let Some(mut opposite) = self.opposite.take() else {
            return;
        };
        let dt = coefficients.time_step;
        let free = |place: usize, fields: &MotionFields| {
            let (v, q) = (fields.velocity[place], fields.elastic[place]);
            let damping = coefficients.mass_coefficient * v
                + coefficients.stiffness_coefficient * fields.elastic_rate[place];
            v - dt * (q + damping)
        };
        for (dof, velocity) in opposite.dofs.iter_mut().zip(&mut opposite.velocities) {
            dof.before = [fields.velocity[dof.place], fields.elastic[dof.place]];
            *velocity = free(dof.place, fields);
        }
        let count = self.normal.len();
        let mut nodes = vec![PairedNode::default(); count];
        for (i, node) in nodes.iter_mut().enumerate() {
            let (n, t) = (self.normal[i], self.tangential[i]);
            self.before[i] = [
                fields.velocity[n],
                fields.velocity[t],
                fields.elastic[n],
                fields.elastic[t],
            ];
            node.velocity = [free(n, fields), free(t, fields)];
        }
        for _ in 0..MOST_SWEEPS {
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            self.ambiguous = 0;
            for (i, node) in nodes.iter_mut().enumerate() {
                let before = node.force;
                self.press(i, node, &mut opposite, fields, shares, dt);
                self.drag(i, node, &mut opposite, fields, dt);
                let moved = [0, 1].map(|c| (node.force[c] - before[c]).abs());
                change = change.max(moved[0]).max(moved[1]);
                largest = largest.max(node.force[0]);
            }
            if !opposite.is_coupled || change <= TOLERANCE * largest {
                break;
            }
        }
        for (i, node) in nodes.iter().enumerate() {
            self.normal_force[i] = node.force[0];
            fields.elastic[self.normal[i]] -= node.force[0] / self.masses[i];
            fields.elastic[self.tangential[i]] -= node.force[1] / self.masses[i];
            for share in &opposite.shares[i] {
                let dof = &opposite.dofs[share.touched];
                let force = share.along[0] * node.force[0] + share.along[1] * node.force[1];
                fields.elastic[dof.place] += force * dof.inverse_mass;
            }
        }
        self.opposite = Some(opposite);
    }

    /// The normal force of one node in its turn.
    fn press(
        &mut self,
        i: usize,
        node: &mut PairedNode,
        opposite: &mut OppositeBody,
        fields: &MotionFields,
        shares: [f64; 3],
        dt: f64,
    ) {
        let mobility = opposite.mobilities[i][0];
        let [displacement, before, velocity] = opposite.motion(i, 0, fields);
        let displacement = fields.displacement[self.normal[i]] - displacement;
        // Without this node's own force.
        let free = node.velocity[0] - velocity - dt * mobility * node.force[0];
        let normal = if self.compliance.is_some() {
            let motion = [displacement, self.before[i][0] - before, free];
            self.compress(i, 1.0 / mobility, motion, shares, dt)
        } else {
            let expansion = self.interference * shares[2];
            let penetration = expansion - self.gaps[i] - (displacement + dt * free);
            (penetration / (dt * dt * mobility)).max(0.0)
        };
        node.push(0, normal, self.masses[i], i, opposite, dt);
    }

    /// The tangential force of one node in its turn.
    fn drag(
        &mut self,
        i: usize,
        node: &mut PairedNode,
        opposite: &mut OppositeBody,
        fields: &MotionFields,
        dt: f64,
    ) {
        let mobility = opposite.mobilities[i][1];
        let [_, before, velocity] = opposite.motion(i, 1, fields);
        let free = node.velocity[1] - velocity - dt * mobility * node.force[1];
        let inertia = 1.0 / (dt * mobility);
        let normal = node.force[0];
        self.status[i] = ContactStatus::Open;
        let mut force = 0.0;
        self.tangential_force[i] = 0.0;
        if normal > 0.0 && self.law.decay.is_none() && self.dashpots.is_empty() {
            let trial = inertia * (self.surface_speed - free);
            (force, self.status[i]) = self.law.project(trial, normal);
            self.tangential_force[i] = force;
        } else if normal > 0.0 {
            let velocity = [self.before[i][1] - before, free];
            (self.tangential_force[i], force) = self.slip(i, inertia, velocity, normal);
        }
        node.push(1, force, self.masses[i], i, opposite, dt);
    }
}

/// A contact node while its forces are sought.
#[derive(Clone, Copy, Debug, Default)]
struct PairedNode {
    /// Velocity at the end of the step as known so far, m/s.
    velocity: [f64; 2],
    /// Forces on it, those of dashpots included, N/m.
    force: [f64; 2],
}

impl PairedNode {
    /// Changes one force; both bodies move.
    fn push(
        &mut self,
        c: usize,
        force: f64,
        mass: f64,
        i: usize,
        opposite: &mut OppositeBody,
        dt: f64,
    ) {
        let impulse = dt * (force - self.force[c]);
        self.velocity[c] += impulse / mass;
        self.force[c] = force;
        let mut impulses = [0.0; 2];
        impulses[c] = impulse;
        opposite.push(i, impulses);
    }
}
