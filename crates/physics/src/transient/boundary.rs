//! Forces of supports, boundary pressures and regions with damping of their own.

use super::force_rows::ForceRows;
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
    /// `D`.
    rows: ForceRows,
    /// Forces of the full pressure, N/m.
    pressures: Vec<f64>,
    /// Damping forces of this step, N/m.
    damping: Vec<f64>,
}

impl BoundaryForces {
    /// From the entries of `D` and the forces of the full pressure over all dofs; no forces for no pressure.
    pub fn of(mut damping: Triplets, pressure: &[f64], operator: &dyn StiffnessOperator) -> Self {
        let pressed = (0..pressure.len()).filter(|&dof| pressure[dof] != 0.0);
        damping.entries.extend(pressed.map(|dof| (dof, dof, 0.0)));
        let (dofs, rows) = ForceRows::of(damping, operator);
        let force = |&dof: &usize| pressure.get(dof).copied().unwrap_or(0.0);
        Self { pressures: dofs.iter().map(force).collect(), damping: vec![0.0; dofs.len()], rows }
    }

    /// Adds the forces of the coming step to the elastic accelerations; `share` of the pressure acts.
    pub fn apply(&mut self, fields: &mut MotionFields, share: f64) {
        self.rows.look(fields);
        self.rows.multiply(|j| self.rows.before[j][1], &mut self.damping);
        self.rows.apply(fields, |i| self.damping[i] - share * self.pressures[i]);
    }

    /// Takes them out again after the step, and returns the power that they took out of the body, W/m.
    pub fn settle(&self, fields: &mut MotionFields, time_step: f64, share: f64) -> [f64; 2] {
        self.rows.settle(fields, time_step);
        let (mut damping, mut pressure) = (0.0, 0.0);
        for (i, (&place, [_, velocity])) in
            self.rows.places.iter().zip(&self.rows.before).enumerate()
        {
            let mean = 0.5 * (velocity + fields.velocity[place]);
            damping += self.damping[i] * mean;
            pressure += share * self.pressures[i] * mean;
        }
        [damping, pressure]
    }
}
