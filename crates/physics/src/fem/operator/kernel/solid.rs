//! Inner loops of a body of revolution in three dimensions.

use super::{LineLayout, SUMS, add_up, move_places, multiply_add};
use crate::fem::operator::{MotionFields, SimdLevel, StepCoefficients};

/// What one sheet node does to another of its own sector and of the two beside it, already divided by the mass.
///
/// Index `[c][d]` is from component `d` to component `c` of `(u_r, u_theta, u_z)`. With `s` and `d` the sum and the
/// difference of the neighbours in the next and in the last sector, mirror symmetry leaves for `p, q` in `{r, z}`
///
/// ```text
/// y_p = sum_q here x_q + beside s(x_q) + odd_p d(x_t)
/// y_t = here_t x_t + beside_t s(x_t) + sum_q odd_q d(x_q)
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::fem::operator) struct SheetCoupling {
    /// First value of the neighbour's radial line; the other components follow it by a stride each.
    pub start: usize,
    /// `rr, rz, zr, zz, tt` in the same sector.
    pub here: [f64; 5],
    /// The same in the sectors beside it.
    pub beside: [f64; 5],
    /// `rt, zt, tr, tz` there.
    pub odd: [f64; 4],
}

/// Couplings of each sheet node; none for one that is held altogether.
pub(in crate::fem::operator) type SheetRows = [Vec<SheetCoupling>];

/// Adds what one neighbour does to the lines `y`.
#[inline(always)]
fn couple<const FUSED: bool>(
    coupling: &SheetCoupling,
    width: usize,
    x: &[f64],
    y: [&mut [f64]; 3],
) {
    let line = |component: usize| {
        let start = coupling.start + component * width;
        &x[start - 1..start + width + 1]
    };
    let (r, t, z) = (line(0), line(1), line(2));
    let [y_r, y_t, y_z] = y;
    let (y_r, y_t, y_z) = (&mut y_r[..width], &mut y_t[..width], &mut y_z[..width]);
    let SheetCoupling { here, beside, odd, .. } = *coupling;
    for j in 0..width {
        let sum = |x: &[f64]| x[j + 2] + x[j];
        let difference = |x: &[f64]| x[j + 2] - x[j];
        let (s_r, s_t, s_z) = (sum(r), sum(t), sum(z));
        let (d_r, d_t, d_z) = (difference(r), difference(t), difference(z));
        let mut sums = [y_r[j], y_t[j], y_z[j]];
        let terms = [
            (0, here[0], r[j + 1]),
            (1, here[4], t[j + 1]),
            (2, here[3], z[j + 1]),
            (0, here[1], z[j + 1]),
            (1, beside[4], s_t),
            (2, here[2], r[j + 1]),
            (0, beside[0], s_r),
            (1, odd[2], d_r),
            (2, beside[3], s_z),
            (0, beside[1], s_z),
            (1, odd[3], d_z),
            (2, beside[2], s_r),
            (0, odd[0], d_t),
            (2, odd[1], d_t),
        ];
        for (c, coefficient, value) in terms {
            sums[c] = multiply_add::<FUSED>(coefficient, value, sums[c]);
        }
        [y_r[j], y_t[j], y_z[j]] = sums;
    }
}

/// `y = M^-1 K x` at one sheet node.
#[inline(always)]
fn apply_node<const FUSED: bool>(
    layout: &LineLayout,
    couplings: &[SheetCoupling],
    node: usize,
    x: &[f64],
    y: &mut [f64],
) {
    y[layout.lines(node)].fill(0.0);
    for coupling in couplings {
        couple::<FUSED>(coupling, layout.stride, x, layout.lines_of(node, y));
    }
}

/// The whole step in one sweep over the sheet: node `k` moves, then node `k - reach`, whose neighbours have all moved, gets its
/// new accelerations, while both are in the cache.
#[inline(always)]
fn sheet_advance_body<const FUSED: bool>(
    layout: &LineLayout,
    (rows, reach): (&SheetRows, usize),
    masses: &[f64],
    fields: &mut MotionFields,
    coefficients: &StepCoefficients,
) -> f64 {
    let mut sums = [0.0; SUMS];
    for step in 0..rows.len() + reach {
        if step < rows.len() {
            move_places::<FUSED>(layout.lines(step), masses, fields, coefficients, &mut sums);
            layout.close_seams(step, &mut fields.velocity);
        }
        let Some(node) = step.checked_sub(reach) else { continue };
        let (velocity, rate) = (&fields.velocity, &mut fields.elastic_rate);
        apply_node::<FUSED>(layout, &rows[node], node, velocity, rate);
        let rates = fields.elastic_rate[layout.lines(node)].iter();
        for (q, z) in fields.elastic[layout.lines(node)].iter_mut().zip(rates) {
            *q = multiply_add::<FUSED>(coefficients.time_step, *z, *q);
        }
    }
    add_up(&sums)
}

#[inline(always)]
fn sheet_multiply_body<const FUSED: bool>(
    layout: &LineLayout,
    rows: &SheetRows,
    x: &mut [f64],
    y: &mut [f64],
) {
    (0..rows.len()).for_each(|node| layout.close_seams(node, x));
    for (node, couplings) in rows.iter().enumerate() {
        apply_node::<FUSED>(layout, couplings, node, x, y);
    }
}

dispatched!(sheet_advance, sheet_advance_body, (
    layout: &LineLayout, rows: (&SheetRows, usize), masses: &[f64], fields: &mut MotionFields,
    coefficients: &StepCoefficients) -> f64);
dispatched!(sheet_multiply, sheet_multiply_body, (
    layout: &LineLayout, rows: &SheetRows, x: &mut [f64], y: &mut [f64]) -> ());
