//! What something attached to a node makes of the modes, however large it is.
//!
//! A mass, spring or dashpot adds `D(s) = s^2 m + s c + k` at the dofs of its node. The modes listed alone leave out
//! how the body gives way there beyond them. A fit of that at few frequencies fails where the attachment resonates with
//! it. So the whole problem is projected onto the modes about the targets together with responses to unit loads `E` at
//! the node. They are `T(i omega_a)^-1 E` on the right and `T(i omega_a)^-T E` on the left. The compliance at the node,
//! `E^T T(s)^-1 E`, of the projected problem is that of the body at each `omega_a`, with its
//! derivative, and has its poles. The small problem
//!
//! ```text
//! W^T (s^2 M + s C + K + E D(s) E^T) X q = 0
//! ```
//!
//! is solved with all of its eigenvalues, whatever the size of `D`.
//!
//! Source: E. J. Grimme, Krylov projection methods for model reduction, thesis, University of Illinois (1997), chapter
//! 3 (two-sided rational interpolation).

use super::base::{Base, PairedMode, REACH};
use crate::*;
use frictionsim_physics::linalg::dense::{dot, transpose_product};
use frictionsim_physics::linalg::dense_eigen::real_eigenvalues;
use frictionsim_physics::linalg::{ComplexSparseLu, LinalgError};

/// Modes taken into the space, the nearest to the targets.
const MOST_MODES: usize = 16;

/// Part of its length that a response must keep beside the others.
const LEAST_PART: f64 = 1e-8;

/// The modes about the targets, and what the projection has of them alone.
pub(super) struct NearModes<'a> {
    base: &'a Base<'a>,
    pub modes: Vec<&'a PairedMode>,
    /// Frequencies within which the projected problem is to be believed, rad/s.
    pub range: [f64; 2],
}

impl<'a> NearModes<'a> {
    /// The modes nearest to the targets of a base.
    pub fn of(base: &'a Base<'a>) -> Self {
        let targets: Vec<f64> = base.targets().iter().map(|t| t.eigenvalue().im).collect();
        let away = |mode: &PairedMode| {
            let own = mode.eigenvalue().im;
            targets.iter().map(|target| (own / target).ln().abs()).fold(f64::INFINITY, f64::min)
        };
        let mut modes = sorted(&base.modes, |mode| away(mode));
        modes.truncate(MOST_MODES);
        let [lowest, highest] = order::range(modes.iter().map(|mode| mode.eigenvalue().im));
        let below = base.modes.iter().any(|mode| mode.eigenvalue().im < lowest);
        let range = [if below { lowest / REACH } else { 0.0 }, REACH * highest];
        Self { base, modes, range }
    }

    /// Eigenvalues with `Im > 0` within the range, with `[M, C, K]` attached at some dofs, all of them unknowns that no
    /// contact touches. `dynamic` holds frequencies and the factors of the whole problem there.
    pub fn attached(
        &self,
        dofs: &[usize],
        attached: [&DMatrix<f64>; 3],
        dynamic: &[(f64, ComplexSparseLu)],
    ) -> Result<Vec<c64>, LinalgError> {
        let unknown_of = &self.base.tangent.unknowns.unknown_of;
        let free = self.base.free(dofs);
        let rows: Vec<usize> = free.iter().filter_map(|&i| unknown_of[dofs[i]]).collect();
        let [right, left] = self.space(&rows, dynamic);

        // The whole problem and what is attached, in the space.
        let tangent = &self.base.tangent;
        let whole = [&tangent.mass, &tangent.damping, &tangent.stiffness];
        let at = |basis: &Mat<f64>| {
            DMatrix::from_fn(rows.len(), basis.ncols(), |i, j| basis[(rows[i], j)])
        };
        let (right_there, left_there) = (at(&right), at(&left));
        let [mass, damping, stiffness] = [0, 1, 2].map(|i| {
            let values = whole[i].evaluate(self.base.friction);
            let image = tangent.stiffness.pattern().multiply(&values, right.as_ref());
            let form = transpose_product(left.as_ref(), image.as_ref());
            let own = attached[i].select_rows(&free).select_columns(&free);
            DMatrix::from_fn(form.nrows(), form.ncols(), |i, j| form[(i, j)])
                + left_there.transpose() * own * &right_there
        });
        let n = mass.nrows();
        let lu = mass.lu();
        let (Some(c), Some(k)) = (lu.solve(&damping), lu.solve(&stiffness)) else {
            return Ok(Vec::new());
        };
        // Unknowns (q, s q / omega): rows of one size.
        let [low, high] = self.range;
        let companion = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, true) => 0.0,
            (true, false) => high * f64::from(u8::from(i + n == j)),
            (false, true) => -k[(i - n, j)] / high,
            (false, false) => -c[(i - n, j - n)],
        });
        let found = real_eigenvalues(companion.as_ref())?.into_iter();
        let within = found.filter(|own| own.im > 0.0 && (low..=high).contains(&own.im));
        Ok(sorted(within, |own| own.im))
    }

    /// Right and left bases: modes and residual responses, real and imaginary parts, as many on either side.
    fn space(&self, rows: &[usize], dynamic: &[(f64, ComplexSparseLu)]) -> [Mat<f64>; 2] {
        let count = self.base.tangent.unknowns.len();
        let (mut right, mut left) = (Vec::new(), Vec::new());
        let mut push = |x: &dyn Fn(usize) -> c64, y: &dyn Fn(usize) -> c64| {
            for part in [|z: c64| z.re, |z: c64| z.im] {
                let parts = |of: &dyn Fn(usize) -> c64| (0..count).map(|i| part(of(i))).collect();
                add_column((&mut right, parts(x)), (&mut left, parts(y)));
            }
        };
        for mode in &self.modes {
            push(&|i| mode.pair.right[i], &|i| mode.pair.left[i]);
        }
        for (_, factors) in dynamic {
            let mut responses = [0, 1].map(|_| unit_loads(count, rows));
            factors.solve_in_place(responses[0].as_mut());
            factors.solve_transpose_in_place(responses[1].as_mut());
            let [x, y] = &responses;
            for j in 0..rows.len() {
                push(&|i| x[(i, j)], &|i| y[(i, j)]);
            }
        }
        [right, left]
            .map(|columns: Vec<Vec<f64>>| Mat::from_fn(count, columns.len(), |i, j| columns[j][i]))
    }
}

/// A unit load at each of some unknowns.
pub(super) fn unit_loads(count: usize, rows: &[usize]) -> Mat<c64> {
    let load = |i: usize, j: usize| if i == rows[j] { c64::ONE } else { c64::ZERO };
    Mat::from_fn(count, rows.len(), load)
}

/// Adds a column of unit length to either basis, orthogonal to those before it, where both keep a part of their length.
fn add_column(
    (right, mut x): (&mut Vec<Vec<f64>>, Vec<f64>),
    (left, mut y): (&mut Vec<Vec<f64>>, Vec<f64>),
) {
    let part = |basis: &[Vec<f64>], v: &mut Vec<f64>| -> f64 {
        let before = dot(v, v).sqrt();
        for _ in 0..2 {
            for q in basis {
                let along = dot(q, v);
                v.iter_mut().zip(q).for_each(|(v, q)| *v -= along * q);
            }
        }
        let length = dot(v, v).sqrt();
        v.iter_mut().for_each(|v| *v /= length);
        length / before
    };
    let parts = [part(right, &mut x), part(left, &mut y)];
    // Not so of what is not a number either.
    if parts.iter().all(|part| *part > LEAST_PART) {
        right.push(x);
        left.push(y);
    }
}
