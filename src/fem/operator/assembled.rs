//! `M^-1 K` as 3 x 3 block rows, for solid bodies of any mesh.

use super::block_rows::move_places;
use super::{MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator};
use crate::fem::Triplets;
use rayon::prelude::*;

/// Nodes that one thread takes at a time, and up to how many a body is one piece.
const PIECE: usize = 512;
const UNDIVIDED: usize = 4096;

/// A dof that follows others: its place, theirs with their shares.
type Follower = (u32, Vec<(u32, f64)>);

/// `M^-1 K` over all nodes of solid bodies as compressed rows of 3 x 3 blocks; dofs that are held or follow others have
/// empty rows and no mass, and followers are given their motion after each step.
///
/// Place `3 k + c` is component `c` of node `k`. Large bodies are stepped in pieces on the threads of the current rayon pool;
/// each row is summed by one thread, so the result is the same, bit for bit, for any number of threads.
#[derive(Clone, Debug)]
pub struct AssembledOperator {
    /// First block of each node's row.
    starts: Vec<u32>,
    /// First place of each block's column node.
    columns: Vec<u32>,
    /// Row by row.
    blocks: Vec<[f64; 9]>,
    masses: Vec<f64>,
    followers: Vec<Follower>,
    nodes: usize,
    simd: SimdLevel,
}

impl AssembledOperator {
    /// From the stiffness over the dofs that move by themselves (N/m), their lumped masses (kg; zero for all others), and those
    /// that follow them.
    ///
    /// # Errors
    /// [`OperatorError::Massless`] for a dof with stiffness whose mass is not positive.
    pub fn new(
        stiffness: &Triplets,
        mut masses: Vec<f64>,
        followers: Vec<Follower>,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        let nodes = masses.len() / 3;
        let mut rows: Vec<Vec<(u32, [f64; 9])>> = vec![Vec::new(); nodes];
        for &(row, column, value) in &stiffness.entries {
            if masses[row] == 0.0 || masses[column] == 0.0 {
                continue;
            }
            if !(masses[row] > 0.0) {
                let (node, mass) = (row / 3 + 1, masses[row]);
                return Err(OperatorError::Massless { node, mass });
            }
            let (own, other) = (&mut rows[row / 3], column as u32 / 3 * 3);
            let at = match own.binary_search_by_key(&other, |block| block.0) {
                Ok(at) => at,
                Err(at) => {
                    own.insert(at, (other, [0.0; 9]));
                    at
                }
            };
            own[at].1[3 * (row % 3) + column % 3] += value / masses[row];
        }
        let mut operator = Self {
            starts: vec![0],
            columns: Vec::new(),
            blocks: Vec::new(),
            masses: Vec::new(),
            followers,
            nodes,
            simd: simd.min(SimdLevel::detect()),
        };
        for row in rows {
            operator.columns.extend(row.iter().map(|block| block.0));
            operator.blocks.extend(row.iter().map(|block| block.1));
            operator.starts.push(operator.columns.len() as u32);
        }
        masses.resize((3 * nodes).next_multiple_of(8), 0.0);
        operator.masses = masses;
        Ok(operator)
    }

    /// The row of node `k` times `x`.
    #[inline(always)]
    fn row(&self, k: usize, x: &[f64]) -> [f64; 3] {
        let range = self.starts[k] as usize..self.starts[k + 1] as usize;
        let mut sum = [0.0; 3];
        for (&column, block) in self.columns[range.clone()].iter().zip(&self.blocks[range]) {
            let part = &x[column as usize..column as usize + 3];
            for (sum, row) in sum.iter_mut().zip(block.as_chunks::<3>().0) {
                *sum += row[0] * part[0] + row[1] * part[1] + row[2] * part[2];
            }
        }
        sum
    }

    /// Calls `update` with `k` and the row of node `k` times `x` on pieces of the fields `q` and `z`.
    fn sweep(
        &self,
        x: &[f64],
        [q, z]: [&mut [f64]; 2],
        update: impl Fn([f64; 3], &mut [f64], &mut [f64]) + Sync,
    ) {
        let piece = |first: usize, q: &mut [f64], z: &mut [f64]| {
            let own = q.as_chunks_mut::<3>().0.iter_mut();
            let own = own.zip(z.as_chunks_mut::<3>().0).enumerate();
            for (k, (q, z)) in own {
                update(self.row(first + k, x), q, z);
            }
        };
        let used = 3 * self.nodes;
        if self.nodes <= UNDIVIDED {
            return piece(0, &mut q[..used], &mut z[..used]);
        }
        let pieces = q[..used].par_chunks_mut(3 * PIECE);
        let pieces = pieces.zip(z[..used].par_chunks_mut(3 * PIECE)).enumerate();
        pieces.for_each(|(p, (q, z))| piece(p * PIECE, q, z));
    }

    fn follow(&self, field: &mut [f64]) {
        for (place, shares) in &self.followers {
            let values = shares
                .iter()
                .map(|&(other, share)| share * field[other as usize]);
            field[*place as usize] = values.sum();
        }
    }
}

impl StiffnessOperator for AssembledOperator {
    fn name(&self) -> &'static str {
        "sparse"
    }

    fn simd(&self) -> SimdLevel {
        self.simd
    }

    fn dof_count(&self) -> usize {
        3 * self.nodes
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
        let mut unused = vec![0.0; y.len()];
        self.sweep(x, [y, &mut unused], |row, y, _| y.copy_from_slice(&row));
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        let dt = coefficients.time_step;
        let MotionFields {
            displacement: u,
            velocity: v,
            elastic: q,
            elastic_rate: z,
        } = fields;
        let power = move_places(self.simd, &self.masses, [u, v], [q, z], coefficients);
        self.follow(u);
        self.follow(v);
        self.sweep(v, [q, z], |row, q, z| {
            for ((q, z), value) in q.iter_mut().zip(z).zip(row) {
                *z = value;
                *q += dt * value;
            }
        });
        power
    }
}
