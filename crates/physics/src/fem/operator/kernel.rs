//! Inner loops of the stencil, compiled once for each instruction set, and what those of block rows share with them.
//!
//! Every kernel is one safe, always-inlined body; the wrappers only recompile it with more instructions enabled. The level is checked when
//! an operator is built (`SimdLevel::available`), which is what makes the calls sound.

use super::{MotionFields, SimdLevel, StepCoefficients};
use std::ops::Range;

/// Values in a cache line.
const LANES: usize = 8;

/// Partial sums of a dot product: enough for a row of the usual meshes, few enough for the first-level cache.
pub(super) const SUMS: usize = 512;

/// One row of a cyclic stencil (one radius), already divided by the node's mass.
///
/// Index `[k]` is the radial offset `k - 1`. With `s` and `d` the sum and the difference of the neighbours
/// at `j + 1` and `j - 1`, mirror symmetry leaves
///
/// ```text
/// y_r = sum_k rr0 x_r + rr1 s(x_r) + rt1 d(x_t)
/// y_t = sum_k tt0 x_t + tt1 s(x_t) + tr1 d(x_r)
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct RowStencil {
    pub rr0: [f64; 3],
    pub rr1: [f64; 3],
    pub rt1: [f64; 3],
    pub tt0: [f64; 3],
    pub tt1: [f64; 3],
    pub tr1: [f64; 3],
}

/// Where the lines of a field lie: one around for each component of each node of a sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LineLayout {
    /// Components of a displacement.
    pub components: usize,
    /// Sectors.
    pub count: usize,
    /// Values from one line to the next, a multiple of 8, at least `count + 2`: room for the copy
    /// of sector 0 behind the last one, and for the next line's copy of its last sector.
    stride: usize,
    /// Nodes that have lines.
    nodes: usize,
}

impl LineLayout {
    pub(super) fn new(components: usize, count: usize, nodes: usize) -> Self {
        Self { components, count, stride: (count + 2).next_multiple_of(LANES), nodes }
    }

    /// First value of a component's line; a cache line comes before the first.
    #[inline(always)]
    pub(super) fn line(&self, node: usize, component: usize) -> usize {
        LANES + (self.components * node + component) * self.stride
    }

    /// All lines of a node.
    #[inline(always)]
    fn lines(&self, node: usize) -> Range<usize> {
        self.line(node, 0)..self.line(node + 1, 0)
    }

    /// The lines of `field` at a node.
    #[inline(always)]
    fn lines_of<'a, const D: usize>(
        &self,
        node: usize,
        field: &'a mut [f64],
    ) -> [&'a mut [f64]; D] {
        let mut lines = field[self.lines(node)].chunks_exact_mut(self.stride);
        std::array::from_fn(|_| lines.next().expect("a node has a line for each component"))
    }

    /// A component's lines at the radii before, at and behind a node, in the plane, with the copies across the
    /// seam. No closure: those may be left uninlined, and nothing is vectorized then.
    #[inline(always)]
    fn around<'a>(&self, node: usize, component: usize, field: &'a [f64]) -> [&'a [f64]; 3] {
        let (start, step) = (self.line(node, component) - 1, 2 * self.stride);
        let length = self.stride + 2;
        [
            &field[start - step..][..length],
            &field[start..][..length],
            &field[start + step..][..length],
        ]
    }

    /// Writes the copies across the seam of a node's lines, and zeros into the rest of the padding.
    #[inline(always)]
    fn close_seams(&self, node: usize, x: &mut [f64]) {
        for component in 0..self.components {
            let start = self.line(node, component);
            x[start - 1] = x[start + self.count - 1];
            x[start + self.count] = x[start];
            x[start + self.count + 1..start + self.stride - 1].fill(0.0);
        }
    }

    pub(super) fn field_length(&self) -> usize {
        self.line(self.nodes, 0) + LANES
    }
}

#[inline(always)]
pub(super) fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Velocity and displacement of a range of places, given as its masses, `[u, v]` and `[q, z]`, in pieces of at
/// most [`SUMS`]; adds the power of damping at each place of a piece to `sums` at that place.
#[inline(always)]
pub(super) fn move_range<const FUSED: bool>(
    masses: &[f64],
    [displacement, velocity]: [&mut [f64]; 2],
    [elastic, elastic_rate]: [&[f64]; 2],
    coefficients: &StepCoefficients,
    sums: &mut [f64; SUMS],
) {
    let StepCoefficients { time_step, mass_coefficient, stiffness_coefficient } = *coefficients;
    for start in (0..masses.len()).step_by(SUMS) {
        let count = SUMS.min(masses.len() - start);
        let (masses, sums) = (&masses[start..][..count], &mut sums[..count]);
        let displacement = &mut displacement[start..][..count];
        let velocity = &mut velocity[start..][..count];
        let (elastic, rate) = (&elastic[start..][..count], &elastic_rate[start..][..count]);
        for k in 0..count {
            let (v, z) = (velocity[k], rate[k]);
            let damping = multiply_add::<FUSED>(mass_coefficient, v, stiffness_coefficient * z);
            let moved = multiply_add::<FUSED>(-time_step, elastic[k] + damping, v);
            let mean = 0.5 * (v + moved);
            sums[k] = multiply_add::<FUSED>(masses[k] * damping, mean, sums[k]);
            velocity[k] = moved;
            displacement[k] = multiply_add::<FUSED>(time_step, moved, displacement[k]);
        }
    }
}

/// Moves the places of `range` among all of `fields`.
#[inline(always)]
fn move_places<const FUSED: bool>(
    range: Range<usize>,
    masses: &[f64],
    fields: &mut MotionFields,
    coefficients: &StepCoefficients,
    sums: &mut [f64; SUMS],
) {
    move_range::<FUSED>(
        &masses[range.clone()],
        [&mut fields.displacement[range.clone()], &mut fields.velocity[range.clone()]],
        [&fields.elastic[range.clone()], &fields.elastic_rate[range]],
        coefficients,
        sums,
    );
}

/// `y = stencil x` on one row, handed to `store(j, y_r, y_t)`.
#[inline(always)]
fn apply_row<const FUSED: bool>(
    layout: &LineLayout,
    stencil: &RowStencil,
    row: usize,
    x: &[f64],
    mut store: impl FnMut(usize, f64, f64),
) {
    let width = layout.stride;
    let [radial, tangential] = [layout.around(row, 0, x), layout.around(row, 1, x)];
    let stencil = *stencil;
    for j in 0..width {
        let (mut y_r, mut y_t) = (0.0, 0.0);
        for k in 0..3 {
            let (r, t) = (radial[k], tangential[k]);
            let (sum_r, difference_r) = (r[j + 2] + r[j], r[j + 2] - r[j]);
            let (sum_t, difference_t) = (t[j + 2] + t[j], t[j + 2] - t[j]);
            y_r = multiply_add::<FUSED>(stencil.rr0[k], r[j + 1], y_r);
            y_t = multiply_add::<FUSED>(stencil.tt0[k], t[j + 1], y_t);
            y_r = multiply_add::<FUSED>(stencil.rr1[k], sum_r, y_r);
            y_t = multiply_add::<FUSED>(stencil.tt1[k], sum_t, y_t);
            y_r = multiply_add::<FUSED>(stencil.rt1[k], difference_t, y_r);
            y_t = multiply_add::<FUSED>(stencil.tr1[k], difference_r, y_t);
        }
        store(j, y_r, y_t);
    }
}

/// The whole step in one sweep: row `i` moves, then row `i - 1`, whose neighbours have all moved, gets its
/// new accelerations, while both are in the first-level cache. Rows of zeros enclose them.
#[inline(always)]
fn radial_advance_body<const FUSED: bool>(
    layout: &LineLayout,
    stencils: &[RowStencil],
    masses: &[f64],
    fields: &mut MotionFields,
    coefficients: &StepCoefficients,
) -> f64 {
    let mut sums = [0.0; SUMS];
    let time_step = coefficients.time_step;
    for row in 1..=stencils.len() + 1 {
        if row <= stencils.len() {
            move_places::<FUSED>(layout.lines(row), masses, fields, coefficients, &mut sums);
            layout.close_seams(row, &mut fields.velocity);
        }
        if row > 1 {
            // z <- M^-1 K v, q <- q + dt z.
            let (row, stencil) = (row - 1, &stencils[row - 2]);
            let [z_r, z_t] = layout.lines_of(row, &mut fields.elastic_rate);
            let [q_r, q_t] = layout.lines_of(row, &mut fields.elastic);
            apply_row::<FUSED>(layout, stencil, row, &fields.velocity, |j, y_r, y_t| {
                z_r[j] = y_r;
                z_t[j] = y_t;
                q_r[j] = multiply_add::<FUSED>(time_step, y_r, q_r[j]);
                q_t[j] = multiply_add::<FUSED>(time_step, y_t, q_t[j]);
            });
        }
    }
    add_up(&sums)
}

#[inline(always)]
fn radial_multiply_body<const FUSED: bool>(
    layout: &LineLayout,
    stencils: &[RowStencil],
    x: &mut [f64],
    y: &mut [f64],
) {
    (1..=stencils.len()).for_each(|row| layout.close_seams(row, x));
    for (row, stencil) in (1..).zip(stencils) {
        let [y_r, y_t] = layout.lines_of(row, y);
        apply_row::<FUSED>(layout, stencil, row, x, |j, r, t| {
            y_r[j] = r;
            y_t[j] = t;
        });
    }
}

/// Sum of all partial sums, in eight chains that are added pairwise.
#[inline(always)]
pub(super) fn add_up(sums: &[f64; SUMS]) -> f64 {
    let mut lanes = [0.0; LANES];
    for chunk in sums.as_chunks::<LANES>().0 {
        for lane in 0..LANES {
            lanes[lane] += chunk[lane];
        }
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// Compiles a body for every instruction set and picks one at run time.
macro_rules! dispatched {
    ($name:ident $(<$size:ident>)?, $body:ident, ($($argument:ident: $kind:ty),*) -> $result:ty) => {
        // The only unsafe code of the program: instructions that not every processor has.
        #[allow(unsafe_code)]
        pub(in crate::fem::operator) fn $name$(<const $size: usize>)?(
            level: SimdLevel, $($argument: $kind),*
        ) -> $result {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2,fma")]
                unsafe fn avx2$(<const $size: usize>)?($($argument: $kind),*) -> $result {
                    $body::<true $(, $size)?>($($argument),*)
                }
                #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
                unsafe fn avx512$(<const $size: usize>)?($($argument: $kind),*) -> $result {
                    $body::<true $(, $size)?>($($argument),*)
                }
                match level {
                    // SAFETY: operators are built with levels that `SimdLevel::available` found on
                    // this processor; the bodies themselves are safe code.
                    SimdLevel::Avx2 => return unsafe { avx2($($argument),*) },
                    // SAFETY: as above.
                    SimdLevel::Avx512 => return unsafe { avx512($($argument),*) },
                    SimdLevel::Scalar => {}
                }
            }
            let _ = level;
            $body::<false $(, $size)?>($($argument),*)
        }
    };
}
pub(super) use dispatched;

pub(super) mod solid;

dispatched!(radial_advance, radial_advance_body, (
    layout: &LineLayout, stencils: &[RowStencil], masses: &[f64], fields: &mut MotionFields,
    coefficients: &StepCoefficients) -> f64);
dispatched!(radial_multiply, radial_multiply_body, (
    layout: &LineLayout, stencils: &[RowStencil], x: &mut [f64], y: &mut [f64]) -> ());
