//! `M^-1 K` as rows of blocks, for bodies of any mesh.

use super::block_rows::{self, BlockRows};
use super::node_order::cuthill_mckee;
use super::{MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator};
use crate::fem::{MaterialField, Triplets, assemble_stiffness, assemble_supports, lumped_masses};
use crate::mesh::{BoundaryCondition, Mesh};
use rayon::prelude::*;

/// A dof that follows others: its place, theirs with their shares.
type Follower = (u32, Vec<(u32, f64)>);

/// `M^-1 K` over all nodes as compressed rows of `D x D` blocks; dofs that are held or follow others have empty rows and no
/// mass, and followers are given their motion after each step.
///
/// `D` places in a row are the components of one node. Large bodies are stepped in pieces on the threads of the current rayon
/// pool. Pieces depend on the body alone and each row is summed by one thread, so the result is the same, bit for bit, for any
/// number of threads. Their matrix does not fit the cache of a core: the step takes the time of reading it, and its nodes are
/// put in an order that reads the velocities from the cache at least.
#[derive(Clone, Debug)]
pub struct SparseOperator<const D: usize> {
    rows: BlockRows<D>,
    /// First place of each node.
    places: Vec<u32>,
    /// Mass of each place.
    masses: Vec<f64>,
    followers: Vec<Follower>,
    simd: SimdLevel,
}

impl SparseOperator<2> {
    /// The operator of a plane mesh with its boundary conditions and supports.
    pub fn assemble(
        mesh: &Mesh,
        material: &dyn MaterialField,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        let masses = free_masses(mesh, material)?;
        let mut masses: Vec<f64> = masses.iter().flat_map(|&mass| [mass; 2]).collect();
        mesh.held_dofs().for_each(|dof| masses[dof] = 0.0);
        let mut stiffness = assemble_stiffness(mesh, material);
        let [springs, _] = assemble_supports(mesh);
        stiffness.entries.extend(springs.entries);
        stiffness.merge();
        Self::new(&stiffness, masses, Vec::new(), simd)
    }
}

impl<const D: usize> SparseOperator<D> {
    /// Nodes that one thread takes at a time: enough work to hand over, few enough to share evenly.
    const PIECE: usize = if D == 2 { 2048 } else { 1024 };
    /// Nodes up to which a body is one piece: handing parts of a step of less than half a millisecond to other threads would take
    /// a good part of what they save.
    const UNDIVIDED: usize = if D == 2 { 1 << 15 } else { 4096 };

    /// From the stiffness over the dofs that move by themselves (N/m), their lumped masses (kg; zero for all others), and those
    /// that follow them; in the plane for each metre of thickness.
    ///
    /// [`super::SimdLevel::available`] must have accepted `simd`; a level that the processor lacks falls back to the best it has.
    ///
    /// # Errors
    /// [`OperatorError`] for a dof with stiffness whose mass is not positive.
    pub fn new(
        stiffness: &Triplets,
        masses: Vec<f64>,
        followers: Vec<Follower>,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        let blocks = node_blocks::<D>(stiffness, &masses)?;
        let nodes = blocks.len();
        let order: Vec<u32> = match nodes > Self::UNDIVIDED {
            true => cuthill_mckee(&neighbours(&blocks)),
            false => (0..nodes as u32).collect(),
        };
        let mut places = vec![0; nodes];
        order.iter().enumerate().for_each(|(k, &node)| places[node as usize] = (D * k) as u32);

        // Rows and masses in that order.
        let mut rows = BlockRows { starts: vec![0], columns: Vec::new(), blocks: Vec::new() };
        let mut placed_masses = Vec::with_capacity(D * nodes + 8);
        for node in order.iter().map(|&node| node as usize) {
            let mut row = blocks[node].clone();
            row.iter_mut().for_each(|block| block.0 = places[block.0 as usize]);
            row.sort_unstable_by_key(|block| block.0);
            rows.columns.extend(row.iter().map(|block| block.0));
            rows.blocks.extend(row.iter().map(|block| block.1));
            rows.starts.push(rows.columns.len() as u32);
            placed_masses.extend(&masses[D * node..D * (node + 1)]);
        }
        placed_masses.resize((D * nodes).next_multiple_of(8), 0.0);
        let place = |dof: u32| places[dof as usize / D] + dof % D as u32;
        let followers = followers.into_iter().map(|(dof, shares)| {
            (place(dof), shares.into_iter().map(|(dof, share)| (place(dof), share)).collect())
        });
        Ok(Self {
            followers: followers.collect(),
            masses: placed_masses,
            rows,
            places,
            simd: simd.min(SimdLevel::detect()),
        })
    }

    fn is_divided(&self) -> bool {
        self.places.len() > Self::UNDIVIDED
    }

    fn follow(&self, field: &mut [f64]) {
        for (place, shares) in &self.followers {
            let values = shares.iter().map(|&(other, share)| share * field[other as usize]);
            field[*place as usize] = values.sum();
        }
    }
}

/// A block with its column node.
type NodeBlock<const D: usize> = (u32, [[f64; D]; D]);

/// Blocks of `M^-1 K` by row, each with its column node, ascending; a dof without mass neither moves nor pushes.
fn node_blocks<const D: usize>(
    stiffness: &Triplets,
    masses: &[f64],
) -> Result<Vec<Vec<NodeBlock<D>>>, OperatorError> {
    let mut rows: Vec<Vec<NodeBlock<D>>> = vec![Vec::new(); masses.len() / D];
    for &(row, column, value) in &stiffness.entries {
        if masses[row] == 0.0 || masses[column] == 0.0 {
            continue;
        }
        if !(masses[row] > 0.0) {
            return Err(OperatorError::massless(row / D, masses[row]));
        }
        let (own, other) = (&mut rows[row / D], (column / D) as u32);
        let at = match own.binary_search_by_key(&other, |block| block.0) {
            Ok(at) => at,
            Err(at) => {
                own.insert(at, (other, [[0.0; D]; D]));
                at
            }
        };
        own[at].1[column % D][row % D] += value / masses[row];
    }
    Ok(rows)
}

/// Nodes that each node is coupled to, itself left out.
fn neighbours<const D: usize>(blocks: &[Vec<NodeBlock<D>>]) -> Vec<Vec<u32>> {
    let row = |(node, row): (usize, &Vec<NodeBlock<D>>)| {
        row.iter().map(|block| block.0).filter(|&column| column as usize != node).collect()
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
        return Err(OperatorError::massless(node, mass));
    }
    for boundary in &mesh.boundaries {
        if boundary.condition == BoundaryCondition::Clamped {
            boundary.nodes.iter().for_each(|&node| masses[node as usize] = 0.0);
        }
    }
    Ok(masses)
}

impl<const D: usize> StiffnessOperator for SparseOperator<D> {
    fn name(&self) -> &'static str {
        "sparse"
    }

    fn dof_count(&self) -> usize {
        D * self.places.len()
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        self.places[dof / D] as usize + dof % D
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        if !self.is_divided() {
            return block_rows::multiply(self.simd, &self.rows, 0, x, y);
        }
        let (x, used) = (&*x, self.dof_count());
        let pieces = y[..used].par_chunks_mut(D * Self::PIECE).enumerate();
        pieces.for_each(|(k, y)| {
            block_rows::multiply(self.simd, &self.rows, k * Self::PIECE, x, y);
        });
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        let dt = coefficients.time_step;
        let MotionFields { displacement: u, velocity: v, elastic: q, elastic_rate: z } = fields;
        if !self.is_divided() {
            let power =
                block_rows::move_places(self.simd, &self.masses, [u, v], [q, z], coefficients);
            self.follow(u);
            self.follow(v);
            block_rows::accumulate(self.simd, &self.rows, 0, v, dt, [q, z]);
            return power;
        }
        let piece = D * Self::PIECE;
        let moved = u.par_chunks_mut(piece).zip(v.par_chunks_mut(piece));
        let powers: Vec<f64> = moved
            .zip(q.par_chunks(piece).zip(z.par_chunks(piece)))
            .zip(self.masses.par_chunks(piece))
            .map(|(((u, v), (q, z)), m)| {
                block_rows::move_places(self.simd, m, [u, v], [q, z], coefficients)
            })
            .collect();
        self.follow(u);
        self.follow(v);
        let used = self.dof_count();
        let accelerations = q[..used].par_chunks_mut(piece);
        let accelerations = accelerations.zip(z[..used].par_chunks_mut(piece)).enumerate();
        accelerations.for_each(|(k, (q, z))| {
            block_rows::accumulate(self.simd, &self.rows, k * Self::PIECE, v, dt, [q, z]);
        });
        powers.iter().sum()
    }
}
