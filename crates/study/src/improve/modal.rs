//! What a change of the matrices does to the modes, all of them together.
//!
//! Right vectors `x_j` and left ones `w_i` of the modes and of their conjugates have `w_i^T (C + (lambda_i + lambda_j)
//! M) x_j = delta_ij`. Changes `dM`, `dC`, `dK` of any size leave, in the space of these modes, the eigenproblem
//!
//! ```text
//! lambda (delta_ij + c_ij + (lambda_i + lambda_j) m_ij) y_j = (lambda_i delta_ij - k_ij + lambda_i lambda_j m_ij) y_j
//! m_ij = w_i^T dM x_j,  c_ij and k_ij alike,
//! ```
//!
//! exact to the second order but for what modes beyond the listed ones give way.
//!
//! What they give way at some dofs is the residual compliance `R`. It is that of the full problem
//! at frequencies about the targets less that of the modes, `sum_k x_k w_k^T / (s - lambda_k)` over
//! modes and conjugates. With it a change `D(s)` of these dofs is one of `D (1 + R D)^-1` in the
//! space of the modes. It is a spring in series with what it stands on.

use super::attached::{NearModes, unit_loads};
use super::base::{Base, PairedMode};
use crate::eigenvalues::is_like;
use crate::*;
use frictionsim_physics::cea::sparse::FullProblem;
use frictionsim_physics::linalg::dense::transpose_product;
use frictionsim_physics::linalg::dense_eigen::complex_eigenvalues;
use frictionsim_physics::linalg::{ComplexDenseLu, ComplexSparseLu, LinalgError};
use frictionsim_results::improve::State;

/// Where the compliance of the other modes is taken, in units of the lowest and the highest frequency of the targets.
const BESIDE: [f64; 2] = [0.97, 1.03];

/// A change of the matrices in the space of the modes.
pub(super) struct Change {
    /// `[dM, dC, dK]` over modes and conjugates.
    projected: [Mat<c64>; 3],
    /// Of something attached to a node the eigenvalues of a closer model, in its range.
    attached: Option<Result<Vec<c64>, LinalgError>>,
}

/// The modes of a base as a reduced problem.
pub(super) struct ModalModel<'a> {
    base: &'a Base<'a>,
    /// Eigenvalues of the modes, then their conjugates.
    values: Vec<c64>,
    /// Vectors over the unknowns, real parts of all modes before the imaginary ones: right and left.
    unknowns: [Mat<f64>; 2],
    /// Frequencies below, above, amid the targets and above all modes, rad/s, and factors of the full problem there.
    dynamic: [(f64, ComplexSparseLu); 4],
    near: NearModes<'a>,
}

impl<'a> ModalModel<'a> {
    /// The modes of a base.
    ///
    /// # Errors
    /// If the full problem has no factors at the frequency of the fastest target.
    pub fn new(base: &'a Base<'a>) -> Result<Self, LinalgError> {
        let values: Vec<c64> = base.modes.iter().map(PairedMode::eigenvalue).collect();
        let conjugates = values.iter().map(|value| value.conj());
        let right = columns(base.modes.iter().map(|mode| mode.pair.right.as_slice()));
        let left = columns(base.modes.iter().map(|mode| mode.pair.left.as_slice()));
        let near = NearModes::of(base);
        Ok(Self {
            values: values.iter().copied().chain(conjugates).collect(),
            unknowns: [right, left],
            dynamic: dynamic_factors(base, near.range[1])?,
            near,
            base,
        })
    }

    /// Changes `[dM, dC, dK]` of the bodies over some dofs.
    pub fn local(&self, dofs: &[usize], changes: [&DMatrix<f64>; 3]) -> Change {
        let modes = &self.base.modes;
        let of = |dof: usize, j: usize, is_left: bool| {
            let mode = &modes[j % modes.len()];
            let value = if is_left { mode.left[dof] } else { mode.right[dof] };
            if j < modes.len() { value.re } else { value.im }
        };
        let part = |is_left: bool| {
            DMatrix::from_fn(dofs.len(), 2 * modes.len(), |i, j| of(dofs[i], j, is_left))
        };
        let (right, left) = (part(false), part(true));
        let projected = changes.map(|change| {
            let form = left.transpose() * (change * &right);
            paired(&Mat::from_fn(form.nrows(), form.ncols(), |i, j| form[(i, j)]))
        });
        Change { projected, attached: None }
    }

    /// As [`Self::local`], with what modes beyond the listed ones give way at these dofs, which touch no contact.
    ///
    /// `D (1 + R D)^-1` at two frequencies is taken for a stiffness, a mass and a dashpot.
    pub fn yielding(&self, dofs: &[usize], [m, c, k]: [&DMatrix<f64>; 3]) -> Change {
        let free = self.base.free(dofs);
        let own: Vec<usize> = free.iter().map(|&i| dofs[i]).collect();
        self.effective(&own, &|s| {
            Mat::from_fn(own.len(), own.len(), |i, j| {
                let at = (free[i], free[j]);
                s * (s * m[at] + c[at]) + k[at]
            })
        })
    }

    /// As [`Self::yielding`], of something attached to the dofs of one node, however large.
    pub fn attached(&self, dofs: &[usize], changes: [&DMatrix<f64>; 3]) -> Change {
        Change {
            attached: Some(self.near.attached(dofs, changes, &self.dynamic)),
            ..self.yielding(dofs, changes)
        }
    }

    /// Takes `[M, C, K]` of a patch away from the body: its dofs, and which of them other elements share.
    ///
    /// What is inside hangs on the shared dofs alone, so that the body loses the dynamic stiffness of the patch there,
    /// `D(s) = -(T_bb - T_bi T_ii^-1 T_ib)`, in series with what the body beside it gives way ([`Self::yielding`]).
    ///
    /// `None` where the patch shares no free dof with another element.
    pub fn removed(
        &self,
        (dofs, is_shared): (&[usize], &[bool]),
        [m, c, k]: [&DMatrix<f64>; 3],
    ) -> Option<Change> {
        let free = self.base.free(dofs);
        let (shared, inner): (Vec<usize>, Vec<usize>) =
            free.into_iter().partition(|&i| is_shared[i]);
        if shared.is_empty() {
            return None;
        }
        let own: Vec<usize> = shared.iter().map(|&i| dofs[i]).collect();
        Some(self.effective(&own, &|s| {
            let entry = |i: usize, j: usize| s * (s * m[(i, j)] + c[(i, j)]) + k[(i, j)];
            let block = |rows: &[usize], columns: &[usize]| {
                Mat::from_fn(rows.len(), columns.len(), |i, j| entry(rows[i], columns[j]))
            };
            let mut lost = block(&shared, &shared);
            if !inner.is_empty() {
                let mut carried = block(&inner, &shared);
                ComplexDenseLu::factorize(block(&inner, &inner)).solve_in_place(carried.as_mut());
                lost -= &block(&shared, &inner) * &carried;
            }
            -lost
        }))
    }

    /// The change that `D (1 + R D)^-1` of some dofs comes to about the targets.
    fn effective(&self, own: &[usize], change: &dyn Fn(c64) -> Mat<c64>) -> Change {
        let at = |place: usize| {
            let (omega, factors) = &self.dynamic[place];
            let s = c64::new(0.0, *omega);
            (*omega, self.in_series(own, change(s), (s, factors)))
        };
        let (low, high) = (at(0), at(1));
        let squares = [low.0 * low.0, high.0 * high.0];
        let count = own.len();
        let each = |of: &dyn Fn(c64, c64) -> f64| {
            DMatrix::from_fn(count, count, |i, j| of(low.1[(i, j)], high.1[(i, j)]))
        };
        // Re D = K - omega^2 M at both, Im D = omega C in the mean.
        let mass = each(&|a, b| (a.re - b.re) / (squares[1] - squares[0]));
        let stiffness =
            each(&|a, b| (a.re * squares[1] - b.re * squares[0]) / (squares[1] - squares[0]));
        let damping = each(&|a, b| 0.5 * (a.im / low.0 + b.im / high.0));
        self.local(own, [&mass, &damping, &stiffness])
    }

    /// `D (1 + R D)^-1 = (1 + D R)^-1 D` at `s` over some dofs that are unknowns.
    fn in_series(
        &self,
        own: &[usize],
        mut change: Mat<c64>,
        (s, factors): (c64, &ComplexSparseLu),
    ) -> Mat<c64> {
        let count = own.len();
        let residual = self.residual_compliance(own, (s, factors));
        let product = &change * &residual;
        let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
        let series = Mat::from_fn(count, count, |i, j| product[(i, j)] + unit(i, j));
        ComplexDenseLu::factorize(series).solve_in_place(change.as_mut());
        change
    }

    /// `R` at some dofs that are unknowns.
    fn residual_compliance(
        &self,
        dofs: &[usize],
        (s, factors): (c64, &ComplexSparseLu),
    ) -> Mat<c64> {
        let unknowns = &self.base.tangent.unknowns;
        let rows: Vec<usize> = dofs.iter().filter_map(|&dof| unknowns.unknown_of[dof]).collect();
        let mut response = unit_loads(unknowns.len(), &rows);
        factors.solve_in_place(response.as_mut());
        Mat::from_fn(dofs.len(), dofs.len(), |i, j| {
            let modes = self.base.modes.iter().map(|mode| {
                let (lambda, product) =
                    (mode.eigenvalue(), mode.right[dofs[i]] * mode.left[dofs[j]]);
                product / (s - lambda) + product.conj() / (s - lambda.conj())
            });
            modes.fold(response[(rows[i], j)], |rest, part| rest - part)
        })
    }

    /// The change to the tangent of another body with the same unknowns; `None` where they are others.
    pub fn to(&self, other: &SlidingTangent) -> Option<Change> {
        let own = &self.base.tangent;
        if !is_like(own, other) {
            return None;
        }
        let pairs = [
            (&own.mass, &other.mass),
            (&own.damping, &other.damping),
            (&own.stiffness, &other.stiffness),
        ];
        let [right, left] = &self.unknowns;
        let projected = pairs.map(|(a, b)| {
            // Both have the same nonzeros.
            let [a, b] = [a, b].map(|p| p.evaluate(self.base.friction));
            let change: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
            let image = own.stiffness.pattern().multiply(&change, right.as_ref());
            paired(&transpose_product(left.as_ref(), image.as_ref()))
        });
        Some(Change { projected, attached: None })
    }

    /// Eigenvalues with `Im > 0` after a change.
    fn spectrum(&self, change: &Change) -> Result<Vec<c64>, LinalgError> {
        let Some(attached) = &change.attached else { return self.of_listed(change) };
        // Modes beyond its range by the listed ones alone.
        let [low, high] = self.near.range;
        let is_all = self.near.modes.len() == self.base.modes.len();
        let mut found = if is_all { Vec::new() } else { self.of_listed(change)? };
        found.retain(|value| !(low..=high).contains(&value.im));
        found.extend(attached.clone()?);
        Ok(sorted(found, |own| own.im))
    }

    /// Eigenvalues in the space of the listed modes.
    fn of_listed(&self, change: &Change) -> Result<Vec<c64>, LinalgError> {
        let size = self.values.len();
        let [m, c, k] = &change.projected;
        let lambda = &self.values;
        let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
        let left = Mat::from_fn(size, size, |i, j| {
            c[(i, j)] + m[(i, j)] * (lambda[i] + lambda[j]) + unit(i, j)
        });
        let mut operator = Mat::from_fn(size, size, |i, j| {
            lambda[i] * unit(i, j) - k[(i, j)] + lambda[i] * lambda[j] * m[(i, j)]
        });
        ComplexDenseLu::factorize(left).solve_in_place(operator.as_mut());
        let found = complex_eigenvalues(operator.as_ref())?.into_iter();
        Ok(sorted(found.filter(|own| own.im > 0.0), |own| own.im))
    }

    /// What the modes come to after a change.
    pub fn outlook(&self, change: &Change) -> Result<State, LinalgError> {
        Ok(self.base.window.outlook(self.spectrum(change)?))
    }
}

/// Frequencies below, above, amid the targets and at the `end` of what is looked at, and factors of `T(i omega)` there.
fn dynamic_factors(base: &Base<'_>, end: f64) -> Result<[(f64, ComplexSparseLu); 4], LinalgError> {
    let targets = base.targets();
    let [low, high] = order::range(targets.iter().map(|mode| mode.eigenvalue().im));
    let problem = FullProblem::at(&base.tangent, base.friction);
    let factors = |omega: f64| Ok((omega, problem.factors(c64::new(0.0, omega))?));
    let [below, above] = [BESIDE[0] * low, BESIDE[1] * high];
    let amid = (below * above).sqrt();
    Ok([factors(below)?, factors(above)?, factors(amid)?, factors(end.max(BESIDE[1] * above))?])
}

/// Real parts of some complex vectors as columns, then their imaginary parts.
fn columns<'v>(vectors: impl ExactSizeIterator<Item = &'v [c64]>) -> Mat<f64> {
    let vectors: Vec<&[c64]> = vectors.collect();
    let count = vectors.len();
    let rows = vectors.first().map_or(0, |vector| vector.len());
    Mat::from_fn(rows, 2 * count, |i, j| {
        let value = vectors[j % count][i];
        if j < count { value.re } else { value.im }
    })
}

/// `w_i^T A x_j` over modes and conjugates from the products of real and imaginary parts.
fn paired(products: &Mat<f64>) -> Mat<c64> {
    let r = products.nrows() / 2;
    let form = |i: usize, j: usize, sign: f64| {
        // (a + i b)^T (c + i s d), with s = -1 for a conjugate on the right.
        let [ac, ad] = [j, j + r].map(|column| products[(i, column)]);
        let [bc, bd] = [j, j + r].map(|column| products[(i + r, column)]);
        c64::new(ac - sign * bd, bc + sign * ad)
    };
    Mat::from_fn(2 * r, 2 * r, |i, j| match (i < r, j < r) {
        (true, true) => form(i, j, 1.0),
        (true, false) => form(i, j - r, -1.0),
        (false, true) => form(i - r, j, -1.0).conj(),
        (false, false) => form(i - r, j - r, 1.0).conj(),
    })
}
