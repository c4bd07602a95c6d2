//! Forward increment Lagrange multipliers of the contact edge.

mod face;
mod opposite;
mod points;
mod sums;

pub use sums::{ContactPowers, StatusCounts};

use super::compliance::{CompliantContact, CompressedNode};
use super::{TransientError, TransientModel};
use crate::contact::{ContactInterface, ContactStatus, CoulombFriction, SlippingNode};
use crate::fem::operator::{MotionFields, StepCoefficients, StiffnessOperator};
use face::FaceSliding;
use opposite::OppositeBody;
use points::PointContact;

/// Contact of each node of the contact edge with the moving counterface.
///
/// The forces at `n` enforce the constraints at `n + 1` (equation (6) of Brunetti et al.). With a lumped mass and
/// a rigid counterface each node stands alone and the multipliers are in closed form: a trial step without contact
/// gives `u*`, `v*`; then with penetration `g = delta - g_0 - u_n* > 0`, `g_0` the gap of the undeformed node,
///
/// ```text
/// N = m g / dt^2,   T* = m (V - v_t*) / dt,   T = min(max(T*, -mu N), mu N),
/// ```
///
/// stick where `|T*| <= mu N` (so that `v_t = V`, `Omega a` on a shaft, at `n + 1/2`), slip elsewhere; without penetration the
/// node is open and both vanish. Linear kinematics: the normal does not turn with the node. Friction that falls with
/// the slip speed is implicit in it, node by node: [`CoulombFriction::resolve`]. A contact with a stiffness has `N` from
/// its spring instead; a tangential dashpot adds `- c_t w v_t` while the node is in contact.
///
/// A deformable counterface takes the opposite forces; its motion is taken off that of the node, `1 / m` is the sum of
/// both sides', and nodes that share a node of the other body are solved one after the other until nothing changes.
/// Velocities in the powers are then those between the bodies.
#[derive(Clone, Debug)]
pub struct LagrangeContact {
    normal: Vec<usize>,
    tangential: Vec<usize>,
    masses: Vec<f64>,
    gaps: Vec<f64>,
    interference: f64,
    compliance: Option<CompliantContact>,
    /// `c_t w` of each node, Pa s; empty without a tangential dashpot.
    dashpots: Vec<f64>,
    law: CoulombFriction,
    surface_speed: f64,
    /// Normal force `N` on each node at `n`, N/m.
    pub normal_force: Vec<f64>,
    /// Tangential force `T` on each node at `n`, N/m.
    pub tangential_force: Vec<f64>,
    /// Status of each node at `n`.
    pub status: Vec<ContactStatus>,
    /// Before the step: `v_n, v_t, q_n, q_t`.
    before: Vec<[f64; 4]>,
    ambiguous: u64,
    /// Steps in which the forces between two bodies had not converged when their sweeps ended.
    pub(super) unconverged_steps: u64,
    /// The other body; `None` for a rigid counterface.
    opposite: Option<OppositeBody>,
    /// Sign of the normal dofs along the normal into the body.
    inward: f64,
    /// The face of a body in three dimensions.
    face: Option<FaceSliding>,
    /// The points between surfaces of an assembly.
    points: Option<PointContact>,
}

impl LagrangeContact {
    /// All nodes of `interface` open.
    ///
    /// # Errors
    /// [`TransientError::Prestress`] where the springs of a compliant contact have no base state.
    pub fn new(
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
        model: &TransientModel<'_>,
    ) -> Result<Self, TransientError> {
        let contact = &model.contact;
        let coefficient = model.stiffness.tangential_damping;
        let lengths = interface.tributary_lengths.iter();
        let dashpots = lengths.map(|w| coefficient * w).filter(|c| *c != 0.0);
        let count = interface.len();
        let place = |dof: usize| operator.position(dof);
        let normal: Vec<usize> = (0..count).map(|i| place(interface.normal_dof(i))).collect();
        Ok(Self {
            tangential: (0..count).map(|i| place(interface.tangential_dof(i))).collect(),
            masses: normal.iter().map(|&k| operator.masses()[k]).collect(),
            normal,
            gaps: interface.gaps.clone(),
            interference: contact.interference,
            compliance: CompliantContact::new(model, interface)?,
            dashpots: dashpots.collect(),
            law: contact.law(),
            surface_speed: interface.surface_speed(contact.rotation_speed),
            normal_force: vec![0.0; count],
            tangential_force: vec![0.0; count],
            status: vec![ContactStatus::Open; count],
            before: vec![[0.0; 4]; count],
            ambiguous: 0,
            unconverged_steps: 0,
            opposite: OppositeBody::new(operator, interface),
            inward: 1.0,
            face: None,
            points: None,
        })
    }

    /// The law, speed, interference and springs of `model`, whose contact has changed.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn retune(
        &mut self,
        interface: &ContactInterface,
        model: &TransientModel<'_>,
    ) -> Result<(), TransientError> {
        self.interference = model.contact.interference;
        self.law = model.contact.law();
        self.surface_speed = interface.surface_speed(model.contact.rotation_speed);
        self.compliance = CompliantContact::new(model, interface)?;
        Ok(())
    }

    /// Finds the multipliers of the coming step and adds them to the elastic accelerations.
    ///
    /// `shares` of the interference are reached one step ago, now and at the next step.
    pub fn apply(
        &mut self,
        fields: &mut MotionFields,
        coefficients: &StepCoefficients,
        shares: [f64; 3],
    ) {
        if self.points.is_some() {
            return self.apply_at_points(fields, coefficients, shares);
        }
        if self.opposite.is_some() {
            return self.apply_between_bodies(fields, coefficients, shares);
        }
        if self.face.is_some() {
            return self.apply_on_face(fields, coefficients, shares);
        }
        let expansion = self.interference * shares[2];
        let dt = coefficients.time_step;
        let (alpha, beta) = (coefficients.mass_coefficient, coefficients.stiffness_coefficient);
        self.ambiguous = 0;
        for i in 0..self.normal.len() {
            let (n, t, mass) = (self.normal[i], self.tangential[i], self.masses[i]);
            let before =
                [fields.velocity[n], fields.velocity[t], fields.elastic[n], fields.elastic[t]];
            self.before[i] = before;
            let [v_n, v_t, q_n, q_t] = before;
            let trial_n = v_n - dt * (q_n + (alpha * v_n + beta * fields.elastic_rate[n]));
            let trial_t = v_t - dt * (q_t + (alpha * v_t + beta * fields.elastic_rate[t]));
            let penetration = expansion - self.gaps[i] - (fields.displacement[n] + dt * trial_n);
            let (mut normal, mut tangential) = (0.0, 0.0);
            self.status[i] = ContactStatus::Open;
            if self.compliance.is_some() {
                let motion = [fields.displacement[n], v_n, trial_n];
                normal = self.compress(i, mass, motion, shares, dt);
            } else if penetration > 0.0 {
                // (6), node by node.
                normal = mass * penetration / (dt * dt);
            }
            if normal > 0.0 {
                let force;
                if self.law.decay.is_none() && self.dashpots.is_empty() {
                    let trial = mass * (self.surface_speed - trial_t) / dt;
                    (tangential, self.status[i]) = self.law.project(trial, normal);
                    force = tangential;
                } else {
                    (tangential, force) = self.slip_force(i, mass / dt, [v_t, trial_t], normal);
                }
                fields.elastic[n] = q_n - normal / mass;
                fields.elastic[t] = q_t - force / mass;
            }
            self.normal_force[i] = normal;
            self.tangential_force[i] = tangential;
        }
    }

    /// Normal force of a spring, from `u_n`, `v_{n-1/2}` and the `v_{n+1/2}` without contact.
    fn compress(
        &mut self,
        i: usize,
        mass: f64,
        motion: [f64; 3],
        shares: [f64; 3],
        dt: f64,
    ) -> f64 {
        let [displacement, before, free] = motion;
        let [earlier, now, later] = shares.map(|share| self.pushed(i, share));
        let node = CompressedNode {
            mass,
            before: 0.5 * (earlier + now) - displacement + 0.5 * dt * before,
            free: 0.5 * (now + later) - displacement - 0.5 * dt * free,
        };
        let law = self.compliance.as_mut();
        law.map_or(0.0, |law| law.force(i, &node, dt))
    }

    /// Friction force, and what it makes with the tangential dashpot, from `v_{n-1/2}` and the `v_{n+1/2}` without
    /// contact.
    fn slip_force(
        &mut self,
        i: usize,
        inertia: f64,
        velocity: [f64; 2],
        normal: f64,
    ) -> (f64, f64) {
        let [before, free] = velocity;
        // The dashpot acts on the mean of both velocities: half of it is inertia.
        let half = 0.5 * self.dashpots.get(i).copied().unwrap_or(0.0);
        let damped = inertia + half;
        let free = (inertia * free - half * before) / damped;
        let node = SlippingNode {
            inertia: damped,
            free_slip: self.surface_speed - free,
            slip_before: self.surface_speed - before,
        };
        let friction = self.law.resolve(&node, normal);
        self.ambiguous += u64::from(friction.is_ambiguous);
        self.status[i] = friction.status;
        let after = free + friction.force / damped;
        (friction.force, friction.force - half * (before + after))
    }

    /// How far the counterface is pushed in at node `i`, less the node's gap, m; a compliant contact gives way by its
    /// compression in the base state.
    pub fn pushed(&self, i: usize, share: f64) -> f64 {
        let law = self.compliance.as_ref();
        let compression = law.map_or(0.0, |law| law.compression(i));
        (self.interference + compression) * share - self.gaps[i]
    }

    /// Energy in the springs of a compliant contact at the half step before `u` and after its `shares` of the
    /// interference, J/m.
    pub fn energy(&self, fields: &MotionFields, shares: [f64; 2], dt: f64) -> f64 {
        if self.points.is_some() {
            return self.energy_at_points(fields, shares, dt);
        }
        let Some(law) = &self.compliance else {
            return 0.0;
        };
        let energy = |(i, &n): (usize, &usize)| {
            let [before, now] = shares.map(|share| self.pushed(i, share));
            let mut mean = fields.displacement[n] - 0.5 * dt * fields.velocity[n];
            mean *= self.inward;
            if let Some(opposite) = &self.opposite {
                mean -= opposite.mean_displacement(i, fields, dt);
            }
            law.energy(i, 0.5 * (before + now) - mean)
        };
        self.normal.iter().enumerate().map(energy).sum()
    }

    /// Takes the multipliers out of the elastic accelerations after the step, and returns what they did.
    pub fn settle(
        &self,
        fields: &mut MotionFields,
        coefficients: &StepCoefficients,
        shares: [f64; 3],
    ) -> (ContactPowers, StatusCounts) {
        if self.points.is_some() {
            return self.settle_at_points(fields, coefficients.time_step);
        }
        if self.face.is_some() {
            return self.settle_on_face(fields, coefficients, shares);
        }
        let dt = coefficients.time_step;
        let mut powers = ContactPowers::default();
        let mut counts = StatusCounts { ambiguous: self.ambiguous, ..StatusCounts::default() };
        if let Some(opposite) = &self.opposite {
            opposite.settle(fields, dt);
        }
        for i in 0..self.normal.len() {
            let (n, t) = (self.normal[i], self.tangential[i]);
            let [v_n, v_t, q_n, q_t] = self.before[i];
            if let Some(law) = &self.compliance {
                powers.damping += law.dissipation[i];
            }
            if self.status[i] == ContactStatus::Open {
                counts.open += 1;
                continue;
            }
            fields.elastic[n] = q_n + dt * fields.elastic_rate[n];
            fields.elastic[t] = q_t + dt * fields.elastic_rate[t];
            let (normal, tangential) = (self.normal_force[i], self.tangential_force[i]);
            let mut mean_n = 0.5 * (v_n + fields.velocity[n]);
            let mut mean_t = 0.5 * (v_t + fields.velocity[t]);
            if let Some(opposite) = &self.opposite {
                let [normal, tangential] = opposite.mean_velocity(i, fields);
                mean_n -= normal;
                mean_t -= tangential;
            }
            let power = tangential * mean_t;
            if self.status[i] == ContactStatus::Stick {
                counts.stick += 1;
                powers.stick += power;
            } else {
                counts.slip += 1;
                powers.slide += power;
            }
            // (9) and (10).
            powers.external += tangential * self.surface_speed;
            powers.contact_dissipated += tangential * (self.surface_speed - mean_t);
            powers.normal += normal
                * match &self.compliance {
                    None => mean_n,
                    Some(_) => 0.5 * (self.pushed(i, shares[2]) - self.pushed(i, shares[0])) / dt,
                };
            if let Some(dashpot) = self.dashpots.get(i) {
                powers.damping += dashpot * mean_t * mean_t;
            }
        }
        (powers, counts)
    }

    /// Distance of node `i` from the counterface under a `share` of the interference, m, in a displacement field.
    pub fn gap(&self, i: usize, displacement: &[f64], share: f64) -> f64 {
        match self.points {
            Some(_) => self.gap_at_node(i, displacement, share),
            None => self.inward * displacement[self.normal[i]] - self.pushed(i, share),
        }
    }

    /// Displacement of node `i` along the sliding, of two bodies over the other one where nodes have points, m.
    pub fn slip(&self, i: usize, displacement: &[f64]) -> f64 {
        match self.points {
            Some(_) => self.slip_at_node(i, displacement),
            None => displacement[self.tangential[i]],
        }
    }

    /// Values of a field (displacement or velocity) at node `i` along the normal and along the sliding; between solid bodies those
    /// of the one relative to the other.
    pub fn relative(&self, i: usize, field: &[f64]) -> [f64; 2] {
        match self.points {
            Some(_) => [0, 1].map(|row| self.row_at_node(i, row, field)),
            None => [field[self.normal[i]], field[self.tangential[i]]],
        }
    }

    /// Speed of the counterface at node `i`, m/s: what a node that sticks has for [`Self::relative`] velocity along the sliding.
    pub fn counterface_speed(&self, i: usize) -> f64 {
        match (&self.points, &self.face) {
            (Some(_), _) => self.speed_at_node(i),
            (None, Some(face)) => face.speed(i),
            (None, None) => self.surface_speed,
        }
    }

    /// Friction coefficient at node `i`; none where it falls with the slip speed.
    pub fn friction_coefficient(&self, i: usize) -> Option<f64> {
        let law = self.law_at_node(i).unwrap_or(self.law);
        law.decay.is_none().then_some(law.friction_coefficient)
    }

    /// Place of each node's normal dof in a field; none where contact is at points.
    pub fn normal_places(&self) -> &[usize] {
        &self.normal
    }

    /// Place of each node's tangential dof in a field; none where contact is at points.
    pub fn tangential_places(&self) -> &[usize] {
        &self.tangential
    }
}
