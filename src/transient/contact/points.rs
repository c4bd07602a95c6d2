//! Contact at points between surfaces of solid bodies: friction is a vector, and points share nodes.

mod at_nodes;
mod set_up;

use super::{ContactPowers, LagrangeContact, StatusCounts};
use crate::contact::{ContactStatus, CoulombFriction, SlippingPoint};
use crate::fem::operator::{MotionFields, StepCoefficients, StiffnessOperator};
use crate::prestress::Assembly;
use crate::transient::compliance::{CompliantContact, CompressedNode, SpringDamping};
use std::ops::Range;

/// Sweeps over the points within one step, at most; a step that needs more is counted.
const MOST_SWEEPS: usize = 400;

/// Change of a force within a sweep, relative to the largest, at which the sweeps end.
const TOLERANCE: f64 = 1e-12;

/// The points of all contacts of an assembly, with the dofs that they touch.
#[derive(Clone, Debug)]
pub(super) struct PointContact {
    dofs: Vec<TouchedDof>,
    /// Velocity of each dof at the end of the step under the forces found so far, m/s: what a sweep reads and writes.
    velocities: Vec<f64>,
    points: Vec<TouchingPoint>,
    /// Rows of all points, one after the other: dof and entry.
    entries: Vec<(u32, f64)>,
    /// Springs of each contact; `None` is rigid.
    springs: Vec<Option<CompliantContact>>,
    /// How far the rigid counterface of each contact is pushed in at the end, m.
    interferences: Vec<f64>,
    /// The same one step ago, now and at the next step.
    pushed: Vec<[f64; 3]>,
    /// What the record shows of each node of the surfaces.
    nodes: Vec<ShownNode>,
    /// Friction across the sliding on each of these nodes, N.
    across: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct TouchedDof {
    place: usize,
    inverse_mass: f64,
    /// Velocity and elastic acceleration before the step.
    before: [f64; 2],
}

#[derive(Clone, Debug)]
struct TouchingPoint {
    /// Rows of separation, slip along the sliding and across it over the touched dofs, among the entries.
    rows: [Range<usize>; 3],
    /// What a unit of force along the normal, and along the surface where it yields most, adds to the velocity in a unit of
    /// time, 1/kg.
    mobility: [f64; 2],
    gap: f64,
    /// Sliding speed, m/s.
    speed: f64,
    /// Tangential dashpot, N s/m.
    dashpot: f64,
    law: CoulombFriction,
    /// Contact that it belongs to, and its place among the points of that.
    contact: (usize, usize),
    /// Before the step: separation (m), relative velocity along the rows (m/s).
    separation: f64,
    before: [f64; 3],
    /// Forces along the rows, those of dashpots included, N.
    force: [f64; 3],
    /// Friction alone along the sliding and across it, N.
    friction: [f64; 2],
    status: ContactStatus,
}

#[derive(Clone, Debug)]
struct ShownNode {
    /// Points with the share that the node has in each.
    points: Vec<(usize, f64)>,
}

impl PointContact {
    /// One sweep: each point's forces anew under those of all others. Returns the largest change and the largest force, N.
    fn sweep(&mut self, dt: f64) -> [f64; 2] {
        let [mut change, mut largest] = [0.0_f64; 2];
        for point in &mut self.points {
            let along_row = |row: &Range<usize>| -> f64 {
                let entries = self.entries[row.clone()].iter();
                let parts = entries.map(|&(k, along)| along * self.velocities[k as usize]);
                parts.sum()
            };
            let [normal, slip, across] = &point.rows;
            let velocity = [along_row(normal), along_row(slip), along_row(across)];
            let old = point.force;
            let c = point.contact.0;
            point.resolve(velocity, &mut self.springs[c], self.pushed[c], dt);
            for (c, row) in point.rows.iter().enumerate() {
                let step = point.force[c] - old[c];
                change = change.max(step.abs());
                largest = largest.max(point.force[c].abs());
                if step != 0.0 {
                    for &(k, along) in &self.entries[row.clone()] {
                        let inverse_mass = self.dofs[k as usize].inverse_mass;
                        self.velocities[k as usize] += dt * step * along * inverse_mass;
                    }
                }
            }
        }
        [change, largest]
    }
}

impl TouchingPoint {
    /// The forces that obey the laws of normal contact and friction, where `velocity` is the relative one at the end of the step
    /// under the forces of now.
    fn resolve(
        &mut self,
        velocity: [f64; 3],
        springs: &mut Option<CompliantContact>,
        pushed: [f64; 3],
        dt: f64,
    ) {
        let [normal_yield, surface_yield] = self.mobility;
        let free = velocity[0] - dt * normal_yield * self.force[0];
        let [earlier, now, later] = pushed.map(|pushed| pushed - self.gap);
        let normal = match springs {
            // (6): no penetration at the end of the step.
            None => ((later - self.separation - dt * free) / (dt * dt * normal_yield)).max(0.0),
            Some(springs) => springs.force(
                self.contact.1,
                &CompressedNode {
                    mass: normal_yield.recip(),
                    before: 0.5 * (earlier + now) - self.separation + 0.5 * dt * self.before[0],
                    free: 0.5 * (now + later) - self.separation - 0.5 * dt * free,
                },
                dt,
            ),
        };
        if normal <= 0.0 {
            (self.force, self.friction) = ([0.0; 3], [0.0; 2]);
            self.status = ContactStatus::Open;
            return;
        }
        let mut force = [normal, 0.0, 0.0];
        if surface_yield > 0.0 {
            // Half of a dashpot on the mean velocity is inertia.
            let (inertia, half) = (1.0 / (surface_yield * dt), 0.5 * self.dashpot);
            let damped = inertia + half;
            let free = [1, 2].map(|c| {
                let free = velocity[c] - self.force[c] / inertia;
                (inertia * free - half * self.before[c]) / damped
            });
            let speed = [self.speed, 0.0];
            let friction = self.law.resolve_point(
                &SlippingPoint {
                    inertia: damped,
                    free_slip: [0, 1].map(|c| speed[c] - free[c]),
                    slip_before: [0, 1].map(|c| speed[c] - self.before[c + 1]),
                },
                normal,
            );
            self.friction = friction.force;
            self.status = friction.status;
            for c in 0..2 {
                let after = free[c] + friction.force[c] / damped;
                force[c + 1] = friction.force[c] - half * (self.before[c + 1] + after);
            }
        }
        self.force = force;
    }
}

impl LagrangeContact {
    /// All points of `assembly` open.
    ///
    /// The forces of a step hold the laws at its end, point by point and in turn until none changes (Gauss-Seidel over the
    /// mobilities `J M^-1 J^T` of the points, which share nodes): normal forces as on an edge, friction as on a face.
    pub(in crate::transient) fn at_points(
        operator: &dyn StiffnessOperator,
        assembly: &Assembly<'_>,
        friction_coefficient: f64,
        damped_by: &SpringDamping,
    ) -> Self {
        let points = PointContact::new(assembly, friction_coefficient, damped_by, operator);
        let count = points.nodes.len();
        Self {
            normal: Vec::new(),
            tangential: Vec::new(),
            masses: Vec::new(),
            gaps: Vec::new(),
            interference: 0.0,
            compliance: None,
            dashpots: Vec::new(),
            law: CoulombFriction { friction_coefficient, decay: None },
            surface_speed: 0.0,
            normal_force: vec![0.0; count],
            tangential_force: vec![0.0; count],
            status: vec![ContactStatus::Open; count],
            before: Vec::new(),
            ambiguous: 0,
            unconverged_steps: 0,
            opposite: None,
            inward: 1.0,
            face: None,
            points: Some(points),
        }
    }

    /// Friction across the sliding on the nodes of the surfaces, N.
    pub(super) fn across_at_points(&self) -> &[f64] {
        self.points.as_ref().map_or(&[], |points| &points.across)
    }

    /// [`Self::apply`] at points.
    pub(super) fn apply_at_points(
        &mut self,
        fields: &mut MotionFields,
        coefficients: &StepCoefficients,
        shares: [f64; 3],
    ) {
        let Some(mut contact) = self.points.take() else {
            return;
        };
        let dt = coefficients.time_step;
        // The end of the step without contact.
        for (dof, velocity) in contact.dofs.iter_mut().zip(&mut contact.velocities) {
            let (v, q) = (fields.velocity[dof.place], fields.elastic[dof.place]);
            let rate = coefficients.mass_coefficient * v
                + coefficients.stiffness_coefficient * fields.elastic_rate[dof.place];
            dof.before = [v, q];
            *velocity = v - dt * (q + rate);
        }
        // Relative motion before the step. Forces start from none, as those of the last step are not in a saved state.
        for (pushed, whole) in contact.pushed.iter_mut().zip(&contact.interferences) {
            *pushed = shares.map(|share| whole * share);
        }
        for point in &mut contact.points {
            let (dofs, entries) = (&contact.dofs, &contact.entries);
            point.before = point.rows.each_ref().map(|row| {
                let parts = entries[row.clone()]
                    .iter()
                    .map(|&(k, along)| along * dofs[k as usize].before[0]);
                parts.sum()
            });
            let parts = entries[point.rows[0].clone()]
                .iter()
                .map(|&(k, along)| along * fields.displacement[dofs[k as usize].place]);
            point.separation = parts.sum();
            point.force = [0.0; 3];
        }
        let is_settled = (0..MOST_SWEEPS).any(|_| {
            let [change, largest] = contact.sweep(dt);
            change <= TOLERANCE * largest
        });
        self.unconverged_steps += u64::from(!is_settled);
        // The forces, once, into the accelerations.
        for point in &contact.points {
            for (row, force) in point.rows.iter().zip(point.force) {
                for &(k, along) in &contact.entries[row.clone()] {
                    let dof = &contact.dofs[k as usize];
                    fields.elastic[dof.place] -= force * along * dof.inverse_mass;
                }
            }
        }
        self.show(&mut contact);
        self.points = Some(contact);
    }

    /// Forces and status of the nodes from those of their points: a node slips where a point of it does, sticks where one
    /// sticks and none slips.
    fn show(&mut self, contact: &mut PointContact) {
        for (i, node) in contact.nodes.iter().enumerate() {
            let (mut sums, mut status) = ([0.0; 3], ContactStatus::Open);
            for &(p, share) in &node.points {
                let point = &contact.points[p];
                sums[0] += share * point.force[0];
                sums[1] += share * point.friction[0];
                sums[2] += share * point.friction[1];
                status = match (status, point.status) {
                    (ContactStatus::Slip, _) | (_, ContactStatus::Slip) => ContactStatus::Slip,
                    (ContactStatus::Stick, _) | (_, ContactStatus::Stick) => ContactStatus::Stick,
                    _ => ContactStatus::Open,
                };
            }
            [self.normal_force[i], self.tangential_force[i], contact.across[i]] = sums;
            self.status[i] = status;
        }
    }

    /// [`Self::settle`] at points; statuses are counted by points.
    pub(super) fn settle_at_points(
        &self,
        fields: &mut MotionFields,
        dt: f64,
    ) -> (ContactPowers, StatusCounts) {
        let (mut powers, mut counts) = (ContactPowers::default(), StatusCounts::default());
        let Some(contact) = &self.points else {
            return (powers, counts);
        };
        for dof in &contact.dofs {
            fields.elastic[dof.place] = dof.before[1] + dt * fields.elastic_rate[dof.place];
        }
        for springs in contact.springs.iter().flatten() {
            powers.damping += springs.dissipation.iter().sum::<f64>();
        }
        for point in &contact.points {
            let [mean_n, mean_t, mean_a] = point.rows.each_ref().map(|row| {
                let entries = contact.entries[row.clone()].iter();
                let parts = entries.map(|&(k, along)| {
                    let dof = &contact.dofs[k as usize];
                    along * (dof.before[0] + fields.velocity[dof.place])
                });
                0.5 * parts.sum::<f64>()
            });
            let [along, across] = point.friction;
            let power = along * mean_t + across * mean_a;
            match point.status {
                ContactStatus::Open => {
                    counts.open += 1;
                    continue;
                }
                ContactStatus::Stick => {
                    counts.stick += 1;
                    powers.stick += power;
                }
                ContactStatus::Slip => {
                    counts.slip += 1;
                    powers.slide += power;
                }
            }
            // (9) and (10).
            powers.external += along * point.speed;
            powers.contact_dissipated += along * point.speed - power;
            powers.normal += point.force[0]
                * match &contact.springs[point.contact.0] {
                    None => mean_n,
                    Some(_) => {
                        let [earlier, _, later] = contact.pushed[point.contact.0];
                        0.5 * (later - earlier) / dt
                    }
                };
            powers.damping += point.dashpot * (mean_t * mean_t + mean_a * mean_a);
        }
        (powers, counts)
    }

    /// Energy in the springs at points at the half step before `u`, J.
    pub(super) fn energy_at_points(&self, fields: &MotionFields, shares: [f64; 2], dt: f64) -> f64 {
        let Some(contact) = &self.points else {
            return 0.0;
        };
        let energy = |point: &TouchingPoint| {
            let springs = contact.springs[point.contact.0].as_ref()?;
            let entries = contact.entries[point.rows[0].clone()].iter();
            let parts = entries.map(|&(k, along)| {
                let place = contact.dofs[k as usize].place;
                along * (fields.displacement[place] - 0.5 * dt * fields.velocity[place])
            });
            let pushed =
                contact.interferences[point.contact.0] * 0.5 * (shares[0] + shares[1]) - point.gap;
            Some(springs.energy(point.contact.1, pushed - parts.sum::<f64>()))
        };
        contact.points.iter().filter_map(energy).sum()
    }
}
