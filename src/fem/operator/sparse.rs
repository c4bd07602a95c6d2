//! `M^-1 K` as 2 x 2 block rows, for any mesh.

use super::kernel::{self, BlockRows};
use super::{MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator};
use crate::fem::{MaterialField, assemble_stiffness, assemble_supports, lumped_masses};
use crate::mesh::{BoundaryCondition, Mesh2d};
use std::collections::BTreeMap;

/// `M^-1 K` over all nodes as compressed rows of 2 x 2 blocks, supports included; clamped nodes have empty rows.
#[derive(Clone, Debug)]
pub struct SparseOperator {
    rows: BlockRows,
    masses: Vec<f64>,
    dof_count: usize,
    simd: SimdLevel,
}

impl SparseOperator {
    /// Assembles the operator of `mesh` with its boundary conditions.
    ///
    /// # Errors
    /// [`OperatorError::Massless`] for a node without mass; [`super::SimdLevel::available`] must have
    /// accepted `simd` (a level that the processor lacks falls back to the best it has).
    pub fn assemble(
        mesh: &Mesh2d,
        material: &dyn MaterialField,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        let node_masses = free_masses(mesh, material)?;
        let mut blocks: Vec<BTreeMap<u32, [f64; 4]>> = vec![BTreeMap::new(); mesh.node_count()];
        let dof_count = 2 * mesh.node_count();
        let mut dof_masses: Vec<f64> = node_masses.iter().flat_map(|&mass| [mass; 2]).collect();
        mesh.held_dofs().for_each(|dof| dof_masses[dof] = 0.0);
        let [springs, _] = assemble_supports(mesh);
        let body = assemble_stiffness(mesh, material).entries;
        for (row, column, value) in body.into_iter().chain(springs.entries) {
            // A clamped node neither moves nor pushes.
            if dof_masses[row] > 0.0 && dof_masses[column] > 0.0 {
                let block = blocks[row / 2].entry(column as u32 / 2).or_default();
                block[row % 2 + 2 * (column % 2)] += value;
            }
        }
        let mut rows = BlockRows {
            starts: vec![0],
            ..BlockRows::default()
        };
        for (row, mass) in blocks.iter().zip(&node_masses) {
            for (column, block) in row {
                rows.columns.push(2 * column);
                rows.values.push(block.map(|value| value / mass));
            }
            rows.starts.push(rows.columns.len() as u32);
        }
        let mut masses = dof_masses;
        masses.resize(dof_count.next_multiple_of(8), 0.0);
        Ok(Self {
            rows,
            masses,
            dof_count,
            simd: simd.min(SimdLevel::detect()),
        })
    }
}

/// Lumped mass of each node, zero for clamped ones.
pub(super) fn free_masses(
    mesh: &Mesh2d,
    material: &dyn MaterialField,
) -> Result<Vec<f64>, OperatorError> {
    let mut masses = lumped_masses(mesh, material);
    if let Some((node, &mass)) = masses.iter().enumerate().find(|(_, mass)| !(**mass > 0.0)) {
        let node = node + 1;
        return Err(OperatorError::Massless { node, mass });
    }
    for boundary in &mesh.boundaries {
        if boundary.condition == BoundaryCondition::Clamped {
            boundary
                .nodes
                .iter()
                .for_each(|&node| masses[node as usize] = 0.0);
        }
    }
    Ok(masses)
}

impl StiffnessOperator for SparseOperator {
    fn name(&self) -> &'static str {
        "sparse"
    }

    fn simd(&self) -> SimdLevel {
        self.simd
    }

    fn dof_count(&self) -> usize {
        self.dof_count
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        dof
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        kernel::sparse_multiply(self.simd, &self.rows, x, y);
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        kernel::sparse_advance(self.simd, &self.rows, &self.masses, fields, coefficients)
    }
}
