//! The other body of a contact between two deformable ones.

use super::LagrangeContact;
use crate::contact::{ContactInterface, ContactStatus};
use crate::fem::operator::{MotionFields, StepCoefficients, StiffnessOperator};
use std::collections::BTreeMap;

/// Sweeps over the contact nodes within one step, at most; a step that needs more is counted.
const MOST_SWEEPS: usize = 400;

/// Change of a force within a sweep, relative to the largest, at which the sweeps end.
const TOLERANCE: f64 = 1e-12;

/// The dofs of the other body that the contact touches, and how forces between the bodies move one over the other.
#[derive(Clone, Debug)]
pub(super) struct OppositeBody {
    dofs: Vec<TouchedDof>,
    /// For each contact node its shares.
    shares: Vec<Vec<Share>>,
    /// `A`, row by row, each with its own node first: `dv_i = dt sum A_ij f_j`, of relative velocities and forces along
    /// normal and tangent, `A = diag(1 / m) + P M^-1 P^T`, m/kg.
    mobility: Vec<Vec<Response>>,
    /// Contact nodes while their forces are sought, and those forces, N/m.
    nodes: Vec<PairedNode>,
    forces: Vec<[f64; 2]>,
}

#[derive(Clone, Copy, Debug)]
struct TouchedDof {
    place: usize,
    inverse_mass: f64,
    /// Velocity and elastic acceleration before the step.
    before: [f64; 2],
    /// Velocity at the end of a step without contact, m/s.
    free: f64,
}

#[derive(Clone, Copy, Debug)]
struct Share {
    /// Among the touched dofs.
    touched: usize,
    /// Along the normal and along the tangent.
    along: [f64; 2],
}

/// How a force at `node` moves another one.
#[derive(Clone, Copy, Debug)]
struct Response {
    node: usize,
    mobility: [[f64; 2]; 2],
}

/// Motion of a contact node over what it meets, along its normal and along its tangent.
#[derive(Clone, Copy, Debug, Default)]
struct PairedNode {
    /// Along the normal, m.
    displacement: f64,
    /// Velocity before the step, and at its end without contact, m/s.
    before: [f64; 2],
    free: [f64; 2],
}

impl OppositeBody {
    /// `None` on a rigid counterface. Held dofs do not move and have no share.
    pub fn new(operator: &dyn StiffnessOperator, interface: &ContactInterface) -> Option<Self> {
        if interface.opposite.is_empty() {
            return None;
        }
        let mut touched: BTreeMap<usize, usize> = BTreeMap::new();
        let mut dofs = Vec::new();
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
                let touched = *touched.entry(place).or_insert_with(|| {
                    dofs.push(TouchedDof {
                        place,
                        inverse_mass: 1.0 / mass,
                        before: [0.0; 2],
                        free: 0.0,
                    });
                    dofs.len() - 1
                });
                own.push(Share { touched, along });
            }
            shares.push(own);
        }
        let own = |i: usize| 1.0 / operator.masses()[operator.position(interface.normal_dof(i))];
        Some(Self {
            mobility: mobility(&dofs, &shares, &own),
            nodes: vec![PairedNode::default(); shares.len()],
            forces: vec![[0.0; 2]; shares.len()],
            dofs,
            shares,
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

    /// The motion of contact node `i`, that of its own dofs given, less that of what it meets.
    fn relative(&self, i: usize, own: PairedNode, fields: &MotionFields) -> PairedNode {
        let mut node = own;
        for share in &self.shares[i] {
            let dof = &self.dofs[share.touched];
            node.displacement -= share.along[0] * fields.displacement[dof.place];
            for c in 0..2 {
                node.before[c] -= share.along[c] * dof.before[0];
                node.free[c] -= share.along[c] * dof.free;
            }
        }
        node
    }

    /// Relative velocity of contact node `i` at the end of the step without its own force along `c`, m/s.
    fn free(&self, i: usize, c: usize, dt: f64) -> f64 {
        let row = &self.mobility[i];
        let moved = row.iter().map(|response| {
            let [normal, tangential] = self.forces[response.node];
            response.mobility[c][0] * normal + response.mobility[c][1] * tangential
        });
        let moved: f64 = moved.sum();
        self.nodes[i].free[c] + dt * (moved - row[0].mobility[c][c] * self.forces[i][c])
    }
}

/// Rows of [`OppositeBody::mobility`]; `own` is `1 / m` of a contact node.
fn mobility(
    dofs: &[TouchedDof],
    shares: &[Vec<Share>],
    own: &dyn Fn(usize) -> f64,
) -> Vec<Vec<Response>> {
    let mut touching: Vec<Vec<(usize, [f64; 2])>> = vec![Vec::new(); dofs.len()];
    for (i, shares) in shares.iter().enumerate() {
        for share in shares {
            touching[share.touched].push((i, share.along));
        }
    }
    let row = |(i, shares): (usize, &Vec<Share>)| {
        let mut own_block = [[0.0; 2]; 2];
        (0..2).for_each(|c| own_block[c][c] = own(i));
        let mut blocks = BTreeMap::from([(i, own_block)]);
        for share in shares {
            let inverse_mass = dofs[share.touched].inverse_mass;
            for &(j, along) in &touching[share.touched] {
                let block = blocks.entry(j).or_insert([[0.0; 2]; 2]);
                for (c, entries) in block.iter_mut().enumerate() {
                    for (d, entry) in entries.iter_mut().enumerate() {
                        *entry += share.along[c] * along[d] * inverse_mass;
                    }
                }
            }
        }
        let mut row: Vec<Response> =
            blocks.into_iter().map(|(node, mobility)| Response { node, mobility }).collect();
        row.sort_by_key(|response| response.node != i);
        row
    };
    shares.iter().enumerate().map(row).collect()
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
        self.gather(&mut opposite, fields, coefficients);
        let is_coupled = opposite.mobility.iter().any(|row| row.len() > 1);
        let mut is_converged = false;
        for _ in 0..MOST_SWEEPS {
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            self.ambiguous = 0;
            for i in 0..self.normal.len() {
                let before = opposite.forces[i];
                opposite.forces[i][0] = self.press(i, &opposite, shares, dt);
                opposite.forces[i][1] = self.drag(i, &opposite, dt);
                let force = opposite.forces[i];
                let moved = [0, 1].map(|c| (force[c] - before[c]).abs());
                change = change.max(moved[0]).max(moved[1]);
                largest = largest.max(force[0]);
            }
            is_converged = !is_coupled || change <= TOLERANCE * largest;
            if is_converged {
                break;
            }
        }
        self.unconverged_steps += u64::from(!is_converged);
        for (i, force) in opposite.forces.iter().enumerate() {
            self.normal_force[i] = force[0];
            fields.elastic[self.normal[i]] -= force[0] / self.masses[i];
            fields.elastic[self.tangential[i]] -= force[1] / self.masses[i];
            for share in &opposite.shares[i] {
                let dof = &opposite.dofs[share.touched];
                let force = share.along[0] * force[0] + share.along[1] * force[1];
                fields.elastic[dof.place] += force * dof.inverse_mass;
            }
        }
        self.opposite = Some(opposite);
    }

    /// The motion of both bodies before the step and after a step without contact; no forces yet.
    fn gather(
        &mut self,
        opposite: &mut OppositeBody,
        fields: &MotionFields,
        coefficients: &StepCoefficients,
    ) {
        let free = |place: usize| {
            let (v, q) = (fields.velocity[place], fields.elastic[place]);
            let damping = coefficients.mass_coefficient * v
                + coefficients.stiffness_coefficient * fields.elastic_rate[place];
            v - coefficients.time_step * (q + damping)
        };
        for dof in &mut opposite.dofs {
            dof.before = [fields.velocity[dof.place], fields.elastic[dof.place]];
            dof.free = free(dof.place);
        }
        for i in 0..self.normal.len() {
            let (n, t) = (self.normal[i], self.tangential[i]);
            let (v, q) = (&fields.velocity, &fields.elastic);
            self.before[i] = [v[n], v[t], q[n], q[t]];
            let own = PairedNode {
                displacement: fields.displacement[n],
                before: [v[n], v[t]],
                free: [free(n), free(t)],
            };
            opposite.nodes[i] = opposite.relative(i, own, fields);
        }
        opposite.forces.fill([0.0; 2]);
    }

    /// The normal force of one node in its turn.
    fn press(&mut self, i: usize, opposite: &OppositeBody, shares: [f64; 3], dt: f64) -> f64 {
        let mobility = opposite.mobility[i][0].mobility[0][0];
        let node = &opposite.nodes[i];
        let free = opposite.free(i, 0, dt);
        if self.compliance.is_some() {
            let motion = [node.displacement, node.before[0], free];
            return self.compress(i, 1.0 / mobility, motion, shares, dt);
        }
        let expansion = self.interference * shares[2];
        let penetration = expansion - self.gaps[i] - (node.displacement + dt * free);
        (penetration / (dt * dt * mobility)).max(0.0)
    }

    /// The tangential force of one node in its turn.
    fn drag(&mut self, i: usize, opposite: &OppositeBody, dt: f64) -> f64 {
        let normal = opposite.forces[i][0];
        self.status[i] = ContactStatus::Open;
        self.tangential_force[i] = 0.0;
        if normal == 0.0 {
            return 0.0;
        }
        let inertia = 1.0 / (dt * opposite.mobility[i][0].mobility[1][1]);
        let free = opposite.free(i, 1, dt);
        if self.law.decay.is_none() && self.dashpots.is_empty() {
            let trial = inertia * (self.surface_speed - free);
            (self.tangential_force[i], self.status[i]) = self.law.project(trial, normal);
            return self.tangential_force[i];
        }
        let velocity = [opposite.nodes[i].before[1], free];
        let (friction, force) = self.slip_force(i, inertia, velocity, normal);
        self.tangential_force[i] = friction;
        force
    }
}
