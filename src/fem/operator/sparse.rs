//! `M^-1 K` as 2 x 2 block rows, for any mesh.

use super::block_rows::{self, BlockRows};
use super::node_order::cuthill_mckee;
use super::{MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator};
use crate::fem::{MaterialField, assemble_stiffness, assemble_supports, lumped_masses};
use crate::mesh::{BoundaryCondition, Mesh};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Places of a field that one thread takes at a time: enough work to hand over, few enough to share evenly.
const PIECE: usize = 4096;
/// Places of a field up to which it is one piece: handing parts of a step of less than half a millisecond to other
/// threads would take a good part of what they save.
const UNDIVIDED: usize = 1 << 16;

/// `M^-1 K` over all nodes as compressed rows of 2 x 2 blocks, supports included; clamped nodes have empty rows.
///
/// Large bodies are stepped in pieces on the threads of the current rayon pool. Pieces depend on the body alone and each
/// row is summed by one thread, so the result is the same, bit for bit, for any number of threads. Their matrix does not
/// fit the cache of a core: the step takes the time of reading it, and its nodes are put in an order that reads the
/// velocities from the cache at least.
#[derive(Clone, Debug)]
pub struct SparseOperator {
    rows: BlockRows,
    masses: Vec<f64>,
    /// First place of each node.
    places: Vec<u32>,
    simd: SimdLevel,
}

impl SparseOperator {
    /// Assembles the operator of `mesh` with its boundary conditions.
    ///
    /// # Errors
    /// [`OperatorError::Massless`] for a node without mass; [`super::SimdLevel::available`] must have
    /// accepted `simd` (a level that the processor lacks falls back to the best it has).
    pub fn assemble(
        mesh: &Mesh,
        material: &dyn MaterialField,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        let node_masses = free_masses(mesh, material)?;
        let mut dof_masses: Vec<f64> = node_masses.iter().flat_map(|&mass| [mass; 2]).collect();
        mesh.held_dofs().for_each(|dof| dof_masses[dof] = 0.0);
        let blocks = node_blocks(mesh, material, &dof_masses);
        let field_length = dof_masses.len().next_multiple_of(8);
        let order: Vec<u32> = match field_length > UNDIVIDED {
            true => cuthill_mckee(&neighbours(&blocks)),
            false => (0..mesh.node_count() as u32).collect(),
        };
        let mut places = vec![0; mesh.node_count()];
        for (k, &node) in order.iter().enumerate() {
            places[node as usize] = 2 * k as u32;
        }
        let mut rows = BlockRows { starts: vec![0], ..BlockRows::default() };
        let mut masses = Vec::with_capacity(field_length);
        for node in order.iter().map(|&node| node as usize) {
            let mass = node_masses[node];
            let mut row: Vec<_> = blocks[node]
                .iter()
                .map(|(&column, block)| (places[column as usize], block.map(|value| value / mass)))
                .collect();
            row.sort_unstable_by_key(|&(place, _)| place);
            rows.columns.extend(row.iter().map(|&(place, _)| place));
            rows.values.extend(row.iter().map(|&(_, block)| block));
            rows.starts.push(rows.columns.len() as u32);
            masses.extend(&dof_masses[2 * node..2 * node + 2]);
        }
        masses.resize(field_length, 0.0);
        Ok(Self { rows, masses, places, simd: simd.min(SimdLevel::detect()) })
    }

    fn is_divided(&self) -> bool {
        self.masses.len() > UNDIVIDED
    }
}

/// Blocks `[k_11, k_21, k_12, k_22]` of `K` by row and column node, supports included, N/m for each metre of thickness; a dof
/// without mass, which is held, neither moves nor pushes.
fn node_blocks(
    mesh: &Mesh,
    material: &dyn MaterialField,
    masses: &[f64],
) -> Vec<BTreeMap<u32, [f64; 4]>> {
    let mut blocks: Vec<BTreeMap<u32, [f64; 4]>> = vec![BTreeMap::new(); mesh.node_count()];
    let [springs, _] = assemble_supports(mesh);
    let body = assemble_stiffness(mesh, material).entries;
    for (row, column, value) in body.into_iter().chain(springs.entries) {
        if masses[row] > 0.0 && masses[column] > 0.0 {
            let block = blocks[row / 2].entry(column as u32 / 2).or_default();
            block[row % 2 + 2 * (column % 2)] += value;
        }
    }
    blocks
}

/// Nodes that each node is coupled to, itself left out.
fn neighbours(blocks: &[BTreeMap<u32, [f64; 4]>]) -> Vec<Vec<u32>> {
    let row = |(node, row): (usize, &BTreeMap<u32, _>)| {
        let columns = row.keys().copied();
        columns.filter(|&column| column as usize != node).collect()
    };
    blocks.iter().enumerate().map(row).collect()
}

/// Lumped mass of each node, zero for clamped ones.
pub(super) fn free_masses(
    mesh: &Mesh,
    material: &dyn MaterialField,
) -> Result<Vec<f64>, OperatorError> {
    let mut masses = lumped_masses(mesh, material);
    if let Some((node, &mass)) = masses.iter().enumerate().find(|(_, mass)| !(**mass > 0.0)) {
        let node = node + 1;
        return Err(OperatorError::Massless { node, mass });
    }
    for boundary in &mesh.boundaries {
        if boundary.condition == BoundaryCondition::Clamped {
            boundary.nodes.iter().for_each(|&node| masses[node as usize] = 0.0);
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
        2 * self.places.len()
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        self.places[dof / 2] as usize + dof % 2
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        if !self.is_divided() {
            return block_rows::multiply(self.simd, &self.rows, 0, x, y);
        }
        let x = &*x;
        y.par_chunks_mut(PIECE)
            .enumerate()
            .for_each(|(k, y)| block_rows::multiply(self.simd, &self.rows, k * PIECE / 2, x, y));
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        let dt = coefficients.time_step;
        let MotionFields { displacement: u, velocity: v, elastic: q, elastic_rate: z } = fields;
        if !self.is_divided() {
            let power =
                block_rows::move_places(self.simd, &self.masses, [u, v], [q, z], coefficients);
            block_rows::accumulate(self.simd, &self.rows, 0, v, dt, [q, z]);
            return power;
        }
        let moved = u.par_chunks_mut(PIECE).zip(v.par_chunks_mut(PIECE));
        let powers: Vec<f64> = moved
            .zip(q.par_chunks(PIECE).zip(z.par_chunks(PIECE)))
            .zip(self.masses.par_chunks(PIECE))
            .map(|(((u, v), (q, z)), m)| {
                block_rows::move_places(self.simd, m, [u, v], [q, z], coefficients)
            })
            .collect();
        let accelerations = q.par_chunks_mut(PIECE).zip(z.par_chunks_mut(PIECE));
        accelerations.enumerate().for_each(|(k, (q, z))| {
            block_rows::accumulate(self.simd, &self.rows, k * PIECE / 2, v, dt, [q, z]);
        });
        powers.iter().sum()
    }
}
