//! `M^-1 K` as 3 x 3 block rows, for solid bodies of any mesh.

use super::block_rows::move_places;
use super::kernel::{dispatched, multiply_add};
use super::node_order::cuthill_mckee;
use super::{MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator};
use crate::fem::Triplets;
use rayon::prelude::*;
use std::ops::Range;

/// Nodes that one thread takes at a time, and up to how many a body is one piece.
const PIECE: usize = 1024;
const UNDIVIDED: usize = 4096;

/// A dof that follows others: its place, theirs with their shares.
type Follower = (u32, Vec<(u32, f64)>);

/// Compressed rows of 3 x 3 blocks, each row by row.
#[derive(Clone, Debug, Default)]
pub(super) struct SolidRows {
    /// First block of each node's row.
    starts: Vec<u32>,
    /// First place of each block's column node.
    columns: Vec<u32>,
    blocks: Vec<[f64; 9]>,
}

/// All components of one node row times `x`: a sum for each of the nine products, so that they are formed side by side.
#[inline(always)]
fn solid_row<const FUSED: bool>(rows: &SolidRows, range: Range<usize>, x: &[f64]) -> [f64; 3] {
    let mut sum = [0.0; 9];
    let blocks = rows.columns[range.clone()].iter().zip(&rows.blocks[range]);
    for (&column, block) in blocks {
        let part = &x[column as usize..column as usize + 3];
        for k in 0..9 {
            sum[k] = multiply_add::<FUSED>(block[k], part[k % 3], sum[k]);
        }
    }
    [0, 3, 6].map(|k| sum[k] + sum[k + 1] + sum[k + 2])
}

#[inline(always)]
fn accumulate_solid_body<const FUSED: bool>(
    rows: &SolidRows,
    first: usize,
    velocity: &[f64],
    time_step: f64,
    [elastic, elastic_rate]: [&mut [f64]; 2],
) {
    let outputs = elastic.as_chunks_mut::<3>().0.iter_mut();
    let outputs = outputs.zip(elastic_rate.as_chunks_mut::<3>().0);
    for ((q, z), range) in outputs.zip(rows.starts[first..].windows(2)) {
        *z = solid_row::<FUSED>(rows, range[0] as usize..range[1] as usize, velocity);
        for c in 0..3 {
            q[c] = multiply_add::<FUSED>(time_step, z[c], q[c]);
        }
    }
}

#[inline(always)]
fn multiply_solid_body<const FUSED: bool>(
    rows: &SolidRows,
    first: usize,
    x: &[f64],
    y: &mut [f64],
) {
    let y = y.as_chunks_mut::<3>().0.iter_mut();
    for (y, range) in y.zip(rows.starts[first..].windows(2)) {
        *y = solid_row::<FUSED>(rows, range[0] as usize..range[1] as usize, x);
    }
}

// `z <- M^-1 K v`, `q <- q + dt z` on the node rows from `first` that `[q, z]` have room for.
dispatched!(accumulate_solid, accumulate_solid_body, (
    rows: &SolidRows, first: usize, velocity: &[f64], time_step: f64,
    accelerations: [&mut [f64]; 2]) -> ());
// `y <- M^-1 K x` on the node rows from `first` that `y` has room for.
dispatched!(multiply_solid, multiply_solid_body, (
    rows: &SolidRows, first: usize, x: &[f64], y: &mut [f64]) -> ());

/// `M^-1 K` over all nodes of solid bodies as compressed rows of 3 x 3 blocks; dofs that are held or follow others have
/// empty rows and no mass, and followers are given their motion after each step.
///
/// Three places in a row are the components of one node. Large bodies are stepped in pieces on the threads of the current rayon
/// pool; each row is summed by one thread, so the result is the same, bit for bit, for any number of threads. Their matrix does
/// not fit the cache of a core: the step takes the time of reading it, and its nodes are put in an order that reads the
/// velocities from the cache at least.
#[derive(Clone, Debug)]
pub struct AssembledOperator {
    rows: SolidRows,
    /// First place of each node.
    places: Vec<u32>,
    /// Mass of each place.
    masses: Vec<f64>,
    followers: Vec<Follower>,
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
        masses: Vec<f64>,
        followers: Vec<Follower>,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        let blocks = node_blocks(stiffness, &masses)?;
        let nodes = blocks.len();
        let order: Vec<u32> = match nodes > UNDIVIDED {
            true => cuthill_mckee(&neighbours(&blocks)),
            false => (0..nodes as u32).collect(),
        };
        let mut places = vec![0; nodes];
        for (k, &node) in order.iter().enumerate() {
            places[node as usize] = 3 * k as u32;
        }
        let place = |dof: u32| places[dof as usize / 3] + dof % 3;
        let mut rows = SolidRows { starts: vec![0], ..SolidRows::default() };
        let mut placed_masses = Vec::with_capacity(3 * nodes + 8);
        for node in order.iter().map(|&node| node as usize) {
            let mut row = blocks[node].clone();
            row.iter_mut().for_each(|block| block.0 = places[block.0 as usize]);
            row.sort_unstable_by_key(|block| block.0);
            rows.columns.extend(row.iter().map(|block| block.0));
            rows.blocks.extend(row.iter().map(|block| block.1));
            rows.starts.push(rows.columns.len() as u32);
            placed_masses.extend(&masses[3 * node..3 * node + 3]);
        }
        placed_masses.resize((3 * nodes).next_multiple_of(8), 0.0);
        let followers = followers.into_iter().map(|(dof, shares)| {
            let shares = shares.into_iter();
            (place(dof), shares.map(|(dof, share)| (place(dof), share)).collect())
        });
        Ok(Self {
            followers: followers.collect(),
            masses: placed_masses,
            rows,
            places,
            simd: simd.min(SimdLevel::detect()),
        })
    }

    /// Bytes that a step reads and writes where nothing stays in a cache: the blocks with their columns once; displacement,
    /// velocity, `M^-1 K u` and its rate read and written, the masses read.
    pub fn bytes_per_step(&self) -> usize {
        76 * self.rows.blocks.len() + 4 * self.rows.starts.len() + 8 * 9 * self.masses.len()
    }

    fn is_divided(&self) -> bool {
        self.places.len() > UNDIVIDED
    }

    fn follow(&self, field: &mut [f64]) {
        for (place, shares) in &self.followers {
            let values = shares.iter().map(|&(other, share)| share * field[other as usize]);
            field[*place as usize] = values.sum();
        }
    }
}

/// Block of 3 x 3 by rows and its column node.
type NodeBlock = (u32, [f64; 9]);

/// Blocks of `M^-1 K` by row, each with its column node, ascending.
fn node_blocks(stiffness: &Triplets, masses: &[f64]) -> Result<Vec<Vec<NodeBlock>>, OperatorError> {
    let mut rows: Vec<Vec<NodeBlock>> = vec![Vec::new(); masses.len() / 3];
    for &(row, column, value) in &stiffness.entries {
        if masses[row] == 0.0 || masses[column] == 0.0 {
            continue;
        }
        if !(masses[row] > 0.0) {
            let (node, mass) = (row / 3 + 1, masses[row]);
            return Err(OperatorError::Massless { node, mass });
        }
        let (own, other) = (&mut rows[row / 3], column as u32 / 3);
        let at = match own.binary_search_by_key(&other, |block| block.0) {
            Ok(at) => at,
            Err(at) => {
                own.insert(at, (other, [0.0; 9]));
                at
            }
        };
        own[at].1[3 * (row % 3) + column % 3] += value / masses[row];
    }
    Ok(rows)
}

/// Nodes that each node is coupled to, itself left out.
fn neighbours(blocks: &[Vec<(u32, [f64; 9])>]) -> Vec<Vec<u32>> {
    let row = |(node, row): (usize, &Vec<(u32, [f64; 9])>)| {
        let columns = row.iter().map(|block| block.0);
        columns.filter(|&column| column as usize != node).collect()
    };
    blocks.iter().enumerate().map(row).collect()
}

impl StiffnessOperator for AssembledOperator {
    fn name(&self) -> &'static str {
        "sparse"
    }

    fn simd(&self) -> SimdLevel {
        self.simd
    }

    fn dof_count(&self) -> usize {
        3 * self.places.len()
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        self.places[dof / 3] as usize + dof % 3
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        if !self.is_divided() {
            return multiply_solid(self.simd, &self.rows, 0, x, y);
        }
        let (x, used) = (&*x, 3 * self.places.len());
        y[..used]
            .par_chunks_mut(3 * PIECE)
            .enumerate()
            .for_each(|(k, y)| multiply_solid(self.simd, &self.rows, k * PIECE, x, y));
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        let dt = coefficients.time_step;
        let MotionFields { displacement: u, velocity: v, elastic: q, elastic_rate: z } = fields;
        if !self.is_divided() {
            let power = move_places(self.simd, &self.masses, [u, v], [q, z], coefficients);
            self.follow(u);
            self.follow(v);
            accumulate_solid(self.simd, &self.rows, 0, v, dt, [q, z]);
            return power;
        }
        let piece = 3 * PIECE;
        let moved = u.par_chunks_mut(piece).zip(v.par_chunks_mut(piece));
        let powers: Vec<f64> = moved
            .zip(q.par_chunks(piece).zip(z.par_chunks(piece)))
            .zip(self.masses.par_chunks(piece))
            .map(|(((u, v), (q, z)), m)| move_places(self.simd, m, [u, v], [q, z], coefficients))
            .collect();
        self.follow(u);
        self.follow(v);
        let used = 3 * self.places.len();
        let accelerations = q[..used].par_chunks_mut(piece);
        let accelerations = accelerations.zip(z[..used].par_chunks_mut(piece)).enumerate();
        accelerations.for_each(|(k, (q, z))| {
            accumulate_solid(self.simd, &self.rows, k * PIECE, v, dt, [q, z]);
        });
        powers.iter().sum()
    }
}
