//! Steps of points whose rows share dofs: one after the other until no force changes.

use super::{LagrangeContact, PointForces, PointTurn, Step};
use crate::contact::ContactStatus;
use crate::fem::operator::MotionFields;

/// Sweeps over the points within one step, at most; a step that needs more is counted.
const MOST_SWEEPS: usize = 400;

/// Change of a force within a sweep, relative to the largest, at which the sweeps end.
const TOLERANCE: f64 = 1e-12;

impl LagrangeContact {
    /// [`Self::apply`] by sweeps.
    pub(super) fn apply_in_sweeps<const TANGENTS: usize>(
        &mut self,
        fields: &mut MotionFields,
        step: &Step,
    ) {
        self.gather(fields, step);
        let is_settled = (0..MOST_SWEEPS).any(|_| {
            let [change, largest] = self.sweep::<TANGENTS>(step);
            !self.is_coupled || change <= TOLERANCE * largest
        });
        self.unconverged_steps += u64::from(!is_settled);
        // The forces, once, into the accelerations.
        for (i, turn) in self.turns.iter().enumerate() {
            for c in 0..=TANGENTS {
                for &(k, along) in &self.entries[self.row(i, c)] {
                    let dof = &self.dofs[k as usize];
                    let force = turn.forces.whole[c] * along;
                    fields.elastic[dof.place] -= force * dof.inverse_mass;
                }
            }
        }
        self.show();
    }

    /// The motion before the step, and its end without contact. Forces start from none, as those of the last step are not in a saved state.
    fn gather(&mut self, fields: &MotionFields, step: &Step) {
        for (dof, velocity) in self.dofs.iter_mut().zip(&mut self.velocities) {
            let (v, q) = (fields.velocity[dof.place], fields.elastic[dof.place]);
            dof.before = [v, q];
            *velocity = step.coefficients.moved(v, q, fields.elastic_rate[dof.place]);
        }
        for i in 0..self.points.len() {
            let mut turn = PointTurn::default();
            turn.free.separation = self.along(i, 0, |dof| fields.displacement[dof.place]);
            for c in 0..=self.tangents {
                turn.free.before[c] = self.along(i, c, |dof| dof.before[0]);
            }
            self.turns[i] = turn;
        }
    }

    /// One sweep: each point's forces anew under those of all others. Returns the largest change and the largest force, N.
    fn sweep<const TANGENTS: usize>(&mut self, step: &Step) -> [f64; 2] {
        let dt = step.coefficients.time_step;
        let [mut change, mut largest] = [0.0_f64; 2];
        self.ambiguous = 0;
        let mut row = 0;
        let mut first = 0;
        for surfaces in &mut self.surfaces {
            for (place, i) in surfaces.points.clone().enumerate() {
                let mut rows: [&[(u32, f64)]; 3] = [&[]; 3]; // Rows of the point: along its normal and its tangents.
                for entries in &mut rows[..=TANGENTS] {
                    *entries = &self.entries[first..self.ends[row]];
                    first = self.ends[row];
                    row += 1;
                }
                // Velocities at the end of the step under the forces of all others.
                let (point, turn) = (&self.points[i], &mut self.turns[i]);
                let (old, free) = (turn.forces.whole, &mut turn.free);
                free.place = place;
                for c in 0..=TANGENTS {
                    let parts =
                        rows[c].iter().map(|&(k, along)| along * self.velocities[k as usize]);
                    let mass = point.mass[c.min(1)];
                    let own = if old[c] == 0.0 { 0.0 } else { dt * old[c] / mass };
                    free.free[c] = parts.sum::<f64>() - own;
                }
                turn.forces = surfaces.resolve::<TANGENTS>(point, free, step);
                self.ambiguous += u64::from(turn.forces.is_ambiguous);
                // What the change of its forces does to the velocities.
                for (c, entries) in rows[..=TANGENTS].iter().enumerate() {
                    let added = turn.forces.whole[c] - old[c];
                    change = change.max(added.abs());
                    largest = largest.max(turn.forces.whole[c].abs());
                    if added != 0.0 {
                        for &(k, along) in *entries {
                            let inverse_mass = self.dofs[k as usize].inverse_mass;
                            self.velocities[k as usize] += dt * added * along * inverse_mass;
                        }
                    }
                }
            }
        }
        [change, largest]
    }

    /// Forces and status of the nodes from those of their points: a node slips where a point of it does, sticks where one
    /// sticks and none slips.
    fn show(&mut self) {
        for (i, points) in self.nodes.iter().enumerate() {
            let (mut sums, mut status) = ([0.0; 3], ContactStatus::Open);
            for &(p, share) in points {
                let PointForces { whole, friction, status: own, .. } = self.turns[p].forces;
                for (sum, force) in sums.iter_mut().zip([whole[0], friction[0], friction[1]]) {
                    *sum += share * force;
                }
                status = match (status, own) {
                    (ContactStatus::Slip, _) | (_, ContactStatus::Slip) => ContactStatus::Slip,
                    (ContactStatus::Stick, _) | (_, ContactStatus::Stick) => ContactStatus::Stick,
                    _ => ContactStatus::Open,
                };
            }
            [self.normal_force[i], self.tangential_force[i], _] = sums;
            if let Some(across) = self.across_force.get_mut(i) {
                *across = sums[2];
            }
            self.status[i] = status;
        }
    }
}
