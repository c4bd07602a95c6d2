//! Forces of supports, boundary pressures and regions with damping of their own.

use crate::fem::Triplets;
use crate::fem::operator::{MotionFields, StiffnessOperator};

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
        for row in &mut self.rows {
            let own = &self.entries[start..row.end];
            row.damping = own.iter().map(|&(place, value)| value * fields.velocity[place]).sum();
            row.before = [fields.elastic[row.place], fields.velocity[row.place]];
            fields.elastic[row.place] += (row.damping - share * row.force) / row.mass;
            start = row.end;
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
