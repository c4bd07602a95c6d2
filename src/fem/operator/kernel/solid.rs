//! Inner loops of a body of revolution in three dimensions.

use super::{LANES, SUMS, add_up, move_places, multiply_add};
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

/// Where the lines of a solid's field lie: three for each sheet node, around the circumference, in the order of the sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::fem::operator) struct SheetLayout {
    /// Sectors.
    pub count: usize,
    /// Values from one line to the next, a multiple of 8, with room for the copies across the seam.
    pub stride: usize,
    /// Sheet nodes.
    pub nodes: usize,
    /// Largest distance of two nodes of an element in their numbering.
    pub reach: usize,
}

impl SheetLayout {
    pub(in crate::fem::operator) fn new(count: usize, nodes: usize, reach: usize) -> Self {
        Self { count, stride: (count + 2).next_multiple_of(LANES), nodes, reach }
    }

    /// First value of a component's line.
    #[inline(always)]
    pub(in crate::fem::operator) fn line(&self, node: usize, component: usize) -> usize {
        LANES + (3 * node + component) * self.stride
    }

    pub(in crate::fem::operator) fn field_length(&self) -> usize {
        self.line(self.nodes, 0) + LANES
    }
}

/// Couplings of each sheet node; none for one that is held altogether.
pub(in crate::fem::operator) type SheetRows = [Vec<SheetCoupling>];

/// Writes the copies of the nodes across the seam of one sheet node's lines, and zeros into the rest of their padding.
#[inline(always)]
fn close_seams(layout: &SheetLayout, node: usize, x: &mut [f64]) {
    for component in 0..3 {
        let start = layout.line(node, component);
        x[start - 1] = x[start + layout.count - 1];
        x[start + layout.count] = x[start];
        x[start + layout.count + 1..start + layout.stride - 1].fill(0.0);
    }
}

/// The lines of `field` at one sheet node.
#[inline(always)]
fn lines_of<'a>(layout: &SheetLayout, node: usize, field: &'a mut [f64]) -> [&'a mut [f64]; 3] {
    let (start, width) = (layout.line(node, 0), layout.stride);
    let (radial, others) = field[start..start + 3 * width].split_at_mut(width);
    let (tangential, axial) = others.split_at_mut(width);
    [radial, tangential, axial]
}

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
    layout: &SheetLayout,
    couplings: &[SheetCoupling],
    node: usize,
    x: &[f64],
    y: &mut [f64],
) {
    let lines = layout.line(node, 0)..layout.line(node + 1, 0);
    y[lines].fill(0.0);
    for coupling in couplings {
        couple::<FUSED>(coupling, layout.stride, x, lines_of(layout, node, y));
    }
}

/// The whole step in one sweep over the sheet: node `k` moves, then node `k - reach`, whose neighbours have all moved, gets its
/// new accelerations, while both are in the cache.
#[inline(always)]
fn solid_advance_body<const FUSED: bool>(
    layout: &SheetLayout,
    rows: &SheetRows,
    masses: &[f64],
    fields: &mut MotionFields,
    coefficients: &StepCoefficients,
) -> f64 {
    let mut sums = [0.0; SUMS];
    for step in 0..layout.nodes + layout.reach {
        if step < layout.nodes {
            let range = layout.line(step, 0)..layout.line(step + 1, 0);
            move_places::<FUSED>(range, masses, fields, coefficients, &mut sums);
            close_seams(layout, step, &mut fields.velocity);
        }
        let Some(node) = step.checked_sub(layout.reach) else {
            continue;
        };
        let (velocity, rate) = (&fields.velocity, &mut fields.elastic_rate);
        apply_node::<FUSED>(layout, &rows[node], node, velocity, rate);
        let range = layout.line(node, 0)..layout.line(node + 1, 0);
        let rates = fields.elastic_rate[range.clone()].iter();
        for (q, z) in fields.elastic[range].iter_mut().zip(rates) {
            *q = multiply_add::<FUSED>(coefficients.time_step, *z, *q);
        }
    }
    add_up(&sums)
}

#[inline(always)]
fn solid_multiply_body<const FUSED: bool>(
    layout: &SheetLayout,
    rows: &SheetRows,
    x: &mut [f64],
    y: &mut [f64],
) {
    (0..layout.nodes).for_each(|node| close_seams(layout, node, x));
    for (node, couplings) in rows.iter().enumerate() {
        apply_node::<FUSED>(layout, couplings, node, x, y);
    }
}

dispatched!(solid_advance, solid_advance_body, (
    layout: &SheetLayout, rows: &SheetRows, masses: &[f64], fields: &mut MotionFields,
    coefficients: &StepCoefficients) -> f64);
dispatched!(solid_multiply, solid_multiply_body, (
    layout: &SheetLayout, rows: &SheetRows, x: &mut [f64], y: &mut [f64]) -> ());
