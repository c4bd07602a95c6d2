//! Forces on some dofs of a body beside those that its operator knows.

use crate::fem::Triplets;
use crate::fem::operator::{MotionFields, StiffnessOperator};

/// A matrix over dofs that move. Its forces go into their elastic accelerations before a step and come out of them afterwards.
#[derive(Debug)]
pub(super) struct ForceRows {
    /// Places of the dofs in the fields, and their masses.
    pub places: Vec<usize>,
    masses: Vec<f64>,
    /// Row and column, by their numbers among the dofs, and value, row by row.
    entries: Vec<(u32, u32, f64)>,
    /// Elastic acceleration and velocity before the step.
    pub before: Vec<[f64; 2]>,
}

impl ForceRows {
    /// The dofs of a matrix that have a mass, rising, with their rows.
    pub fn of(mut matrix: Triplets, operator: &dyn StiffnessOperator) -> (Vec<usize>, Self) {
        let mass = |dof: usize| operator.masses()[operator.position(dof)];
        matrix.entries.retain(|&(row, column, _)| mass(row) > 0.0 && mass(column) > 0.0);
        matrix.merge();
        let mut dofs: Vec<usize> = matrix.entries.iter().map(|own| own.0).collect();
        dofs.dedup();
        let number = |dof: &usize| Some(dofs.binary_search(dof).ok()? as u32);
        let entries = matrix.entries.iter();
        let entries = entries.filter_map(|(i, j, value)| Some((number(i)?, number(j)?, *value)));
        let rows = Self {
            places: dofs.iter().map(|&dof| operator.position(dof)).collect(),
            masses: dofs.iter().map(|&dof| mass(dof)).collect(),
            before: vec![[0.0; 2]; dofs.len()],
            entries: entries.collect(),
        };
        (dofs, rows)
    }

    /// `y = A x`.
    pub fn multiply(&self, x: impl Fn(usize) -> f64, y: &mut [f64]) {
        for row in self.entries.chunk_by(|a, b| a.0 == b.0) {
            y[row[0].0 as usize] = row.iter().map(|&(_, j, value)| value * x(j as usize)).sum();
        }
    }

    /// Keeps the motion before the coming step.
    pub fn look(&mut self, fields: &MotionFields) {
        for (before, &place) in self.before.iter_mut().zip(&self.places) {
            *before = [fields.elastic[place], fields.velocity[place]];
        }
    }

    /// Adds forces of the body, N/m, to the elastic accelerations.
    pub fn apply(&self, fields: &mut MotionFields, force: impl Fn(usize) -> f64) {
        for (i, &place) in self.places.iter().enumerate() {
            fields.elastic[place] += force(i) / self.masses[i];
        }
    }

    /// Takes them out again after the step.
    pub fn settle(&self, fields: &mut MotionFields, time_step: f64) {
        for (&place, [elastic, _]) in self.places.iter().zip(&self.before) {
            fields.elastic[place] = elastic + time_step * fields.elastic_rate[place];
        }
    }
}
