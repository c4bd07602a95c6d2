//! Rows of 2 x 2 blocks, their product and their step.

use super::kernel::{SUMS, add_up, dispatched, move_range, multiply_add};
use super::{SimdLevel, StepCoefficients};

/// Compressed rows of 2 x 2 blocks; `values` holds `[a_11, a_21, a_12, a_22]`.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockRows {
    /// First block of each node row.
    pub starts: Vec<u32>,
    /// First place of each block's column node.
    pub columns: Vec<u32>,
    pub values: Vec<[f64; 4]>,
}

/// Both components of one node row times `x`.
#[inline(always)]
fn block_row<const FUSED: bool>(
    rows: &BlockRows,
    range: std::ops::Range<usize>,
    x: &[f64],
) -> [f64; 2] {
    let mut sum = [0.0; 4];
    let blocks = rows.columns[range.clone()].iter().zip(&rows.values[range]);
    for (&column, block) in blocks {
        let pair = &x[column as usize..column as usize + 2];
        let spread = [pair[0], pair[0], pair[1], pair[1]];
        for k in 0..4 {
            sum[k] = multiply_add::<FUSED>(block[k], spread[k], sum[k]);
        }
    }
    [sum[0] + sum[2], sum[1] + sum[3]]
}

#[inline(always)]
fn move_body<const FUSED: bool>(
    masses: &[f64],
    moved: [&mut [f64]; 2],
    accelerations: [&[f64]; 2],
    coefficients: &StepCoefficients,
) -> f64 {
    let mut sums = [0.0; SUMS];
    move_range::<FUSED>(masses, moved, accelerations, coefficients, &mut sums);
    add_up(&sums)
}

#[inline(always)]
fn accumulate_body<const FUSED: bool>(
    rows: &BlockRows,
    first: usize,
    velocity: &[f64],
    time_step: f64,
    [elastic, elastic_rate]: [&mut [f64]; 2],
) {
    let outputs = elastic.as_chunks_mut::<2>().0.iter_mut();
    let outputs = outputs.zip(elastic_rate.as_chunks_mut::<2>().0);
    for ((q, z), range) in outputs.zip(rows.starts[first..].windows(2)) {
        *z = block_row::<FUSED>(rows, range[0] as usize..range[1] as usize, velocity);
        q[0] = multiply_add::<FUSED>(time_step, z[0], q[0]);
        q[1] = multiply_add::<FUSED>(time_step, z[1], q[1]);
    }
}

#[inline(always)]
fn multiply_body<const FUSED: bool>(rows: &BlockRows, first: usize, x: &[f64], y: &mut [f64]) {
    let y = y.as_chunks_mut::<2>().0.iter_mut();
    for (y, range) in y.zip(rows.starts[first..].windows(2)) {
        *y = block_row::<FUSED>(rows, range[0] as usize..range[1] as usize, x);
    }
}

// `[u, v]` of a range of places from its `[q, z]`; returns the power of damping, W/m.
dispatched!(move_places, move_body, (
    masses: &[f64], moved: [&mut [f64]; 2], accelerations: [&[f64]; 2],
    coefficients: &StepCoefficients) -> f64);
// `z <- M^-1 K v`, `q <- q + dt z` on the node rows from `first` that `[q, z]` have room for.
dispatched!(accumulate, accumulate_body, (
    rows: &BlockRows, first: usize, velocity: &[f64], time_step: f64,
    accelerations: [&mut [f64]; 2]) -> ());
// `y <- M^-1 K x` on the node rows from `first` that `y` has room for.
dispatched!(multiply, multiply_body, (
    rows: &BlockRows, first: usize, x: &[f64], y: &mut [f64]) -> ());
