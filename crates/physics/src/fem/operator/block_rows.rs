//! Rows of `D x D` blocks, their product and their step.

use super::kernel::{SUMS, add_up, dispatched, move_range, multiply_add};
use super::{SimdLevel, StepCoefficients};
use std::ops::Range;

/// Compressed rows of `D x D` blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockRows<const D: usize> {
    /// First block of each node row.
    pub starts: Vec<u32>,
    /// First place of each block's column node.
    pub columns: Vec<u32>,
    /// The blocks, column by column.
    pub blocks: Vec<[[f64; D]; D]>,
}

/// All components of one node row times `x`: a sum for each of the products, so that they are formed side by side. Plain loops:
/// calls of small functions would not be compiled for the instruction set.
#[inline(always)]
fn block_row<const FUSED: bool, const D: usize>(
    rows: &BlockRows<D>,
    range: Range<usize>,
    x: &[f64],
) -> [f64; D] {
    let mut sums = [[0.0; D]; D];
    let blocks = rows.columns[range.clone()].iter().zip(&rows.blocks[range]);
    for (&column, block) in blocks {
        let part = &x[column as usize..column as usize + D];
        for j in 0..D {
            for i in 0..D {
                sums[j][i] = multiply_add::<FUSED>(block[j][i], part[j], sums[j][i]);
            }
        }
    }
    let mut result = sums[0];
    for column in &sums[1..] {
        for i in 0..D {
            result[i] += column[i];
        }
    }
    result
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
fn accumulate_body<const FUSED: bool, const D: usize>(
    rows: &BlockRows<D>,
    first: usize,
    velocity: &[f64],
    time_step: f64,
    [elastic, elastic_rate]: [&mut [f64]; 2],
) {
    let outputs = elastic.as_chunks_mut::<D>().0.iter_mut();
    let outputs = outputs.zip(elastic_rate.as_chunks_mut::<D>().0);
    for ((q, z), range) in outputs.zip(rows.starts[first..].windows(2)) {
        *z = block_row::<FUSED, D>(rows, range[0] as usize..range[1] as usize, velocity);
        for c in 0..D {
            q[c] = multiply_add::<FUSED>(time_step, z[c], q[c]);
        }
    }
}

#[inline(always)]
fn multiply_body<const FUSED: bool, const D: usize>(
    rows: &BlockRows<D>,
    first: usize,
    x: &[f64],
    y: &mut [f64],
) {
    let y = y.as_chunks_mut::<D>().0.iter_mut();
    for (y, range) in y.zip(rows.starts[first..].windows(2)) {
        *y = block_row::<FUSED, D>(rows, range[0] as usize..range[1] as usize, x);
    }
}

// `[u, v]` of a range of places from its `[q, z]`; returns the power of damping, W/m.
dispatched!(move_places, move_body, (
    masses: &[f64], moved: [&mut [f64]; 2], accelerations: [&[f64]; 2],
    coefficients: &StepCoefficients) -> f64);
// `z <- M^-1 K v`, `q <- q + dt z` on the node rows from `first` that `[q, z]` have room for.
dispatched!(accumulate<D>, accumulate_body, (
    rows: &BlockRows<D>, first: usize, velocity: &[f64], time_step: f64,
    accelerations: [&mut [f64]; 2]) -> ());
// `y <- M^-1 K x` on the node rows from `first` that `y` has room for.
dispatched!(multiply<D>, multiply_body, (
    rows: &BlockRows<D>, first: usize, x: &[f64], y: &mut [f64]) -> ());
