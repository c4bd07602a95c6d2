//! Forces of supports, boundary pressures and regions with damping of their own.

use crate::fem::Triplets;
use crate::fem::operator::{MotionFields, StiffnessOperator};

/// Rows that are summed side by side.
const SIDE_BY_SIDE: usize = 4;

/// What acts on a few nodes beside `K u` and `alpha_R M v + beta_R K v`, which the operator knows.
///
/// ```text
/// D v - f,   D = C_support - beta_R K_support + sum_e (alpha_e - alpha_R) M_e + (beta_e - beta_R) K_e
/// ```
///
/// with `f` the boundary pressures: the springs of a support are part of the operator's `K`, but `beta_R` stays on the body.
pub(super) struct BoundaryForces {
    rows: Vec<Row>,
    /// `(place, value)` of the entries of all rows, N s/m for each metre of thickness.
    entries: Vec<(usize, f64)>,
}

struct Row {
    place: usize,
    mass: f64,
    /// Force of the full pressure, N/m.
    force: f64,
    /// Where its entries end.
    end: usize,
    /// Damping force of this step, N/m.
    damping: f64,
    /// Elastic acceleration and velocity before the step.
    before: [f64; 2],
}

impl BoundaryForces {
    /// From the entries of `D` and the forces of the full pressure over all dofs; no forces for no pressure.
    pub fn of(mut damping: Triplets, pressure: &[f64], operator: &dyn StiffnessOperator) -> Self {
        let pressed = (0..pressure.len()).filter(|&dof| pressure[dof] != 0.0);
        damping.entries.extend(pressed.map(|dof| (dof, dof, 0.0)));
        damping.merge();
        let mut forces = Self { rows: Vec::new(), entries: Vec::new() };
        for row in damping.entries.chunk_by(|a, b| a.0 == b.0) {
            let dof = row[0].0;
            let place = operator.position(dof);
            let mass = operator.masses()[place];
            if mass > 0.0 {
                let entries = row.iter().map(|&(_, dof, value)| (operator.position(dof), value));
                forces.entries.extend(entries);
                forces.rows.push(Row {
                    place,
                    mass,
                    force: pressure.get(dof).copied().unwrap_or(0.0),
                    end: forces.entries.len(),
                    damping: 0.0,
                    before: [0.0; 2],
                });
            }
        }
        forces
    }

    /// Adds the forces of the coming step to the elastic accelerations; `share` of the pressure acts.
    pub fn apply(&mut self, fields: &mut MotionFields, share: f64) {
        let mut start = 0;
        for group in self.rows.chunks_mut(SIDE_BY_SIDE) {
            let mut own: [&[(usize, f64)]; SIDE_BY_SIDE] = [&[]; SIDE_BY_SIDE];
            for (entries, row) in own.iter_mut().zip(&*group) {
                *entries = &self.entries[start..row.end];
                start = row.end;
            }
            let sums = sums_side_by_side(own, &fields.velocity);
            for (row, sum) in group.iter_mut().zip(sums) {
                row.damping = sum;
                row.before = [fields.elastic[row.place], fields.velocity[row.place]];
            }
        }
        for row in &self.rows {
            fields.elastic[row.place] += (row.damping - share * row.force) / row.mass;
        }
    }

    /// Takes them out again after the step, and returns the power that they took out of the body, W/m.
    pub fn settle(&self, fields: &mut MotionFields, time_step: f64, share: f64) -> [f64; 2] {
        let (mut damping, mut pressure) = (0.0, 0.0);
        for row in &self.rows {
            let [elastic, velocity] = row.before;
            fields.elastic[row.place] = elastic + time_step * fields.elastic_rate[row.place];
            let mean = 0.5 * (velocity + fields.velocity[row.place]);
            damping += row.damping * mean;
            pressure += share * row.force * mean;
        }
        [damping, pressure]
    }
}

/// `sum_j a_ij x_j` of several rows `i` of entries `(j, a_ij)`, each summed in its own order: sums by themselves would wait for each of
/// their additions.
fn sums_side_by_side(rows: [&[(usize, f64)]; SIDE_BY_SIDE], x: &[f64]) -> [f64; SIDE_BY_SIDE] {
    let common = rows.iter().map(|row| row.len()).min().unwrap_or(0);
    let heads = rows.map(|row| &row[..common]);
    let mut sums = [-0.0; SIDE_BY_SIDE];
    for i in 0..common {
        for (sum, head) in sums.iter_mut().zip(&heads) {
            let (j, a) = head[i];
            *sum += a * x[j];
        }
    }
    for (sum, row) in sums.iter_mut().zip(rows) {
        for &(j, a) in &row[common..] {
            *sum += a * x[j];
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact: rows side by side, of any lengths, have the sums that each has by itself, bit for bit.
    #[test]
    fn rows_side_by_side_have_their_own_sums() {
        let x: Vec<f64> = (0..40).map(|i| f64::from(i).sin()).collect();
        let row = |length: usize, step: usize| -> Vec<(usize, f64)> {
            let entries = (0..length).map(|i| (i * step % 40, 0.1 + (i as f64).cos()));
            entries.collect()
        };
        for lengths in [[0, 1, 2, 3], [17, 33, 21, 39], [5, 5, 5, 5]] {
            let rows = lengths.map(|length| row(length, length + 1));
            let sums = sums_side_by_side(rows.each_ref().map(Vec::as_slice), &x);
            for (sum, row) in sums.iter().zip(&rows) {
                let own: f64 = row.iter().map(|&(j, a)| a * x[j]).sum();
                assert_eq!(sum.to_bits(), own.to_bits());
            }
        }
    }
}
