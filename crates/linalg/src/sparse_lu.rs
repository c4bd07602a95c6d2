//! Sparse factors by elimination front by front: one symbolic analysis for all values of a pattern, real or complex.
//!
//! Unknowns of alike neighbours make a front. It is a dense matrix `F` of those that are eliminated
//! in it (1) and those that they leave coupled (2). With the pivots chosen within a front,
//!
//! ```text
//! P F11 = L U,    right = L^-1 P F12,    below = F21 U^-1,    F22 - below right,
//! ```
//!
//! and the last goes to the front that eliminates the first of its unknowns. Source: I. S. Duff and J. K. Reid, The multifrontal solution
//! of unsymmetric sets of linear equations, SIAM J. Sci. Stat. Comput. 5 (1984).
//!
//! Real fronts are symmetric until those are reached where friction acts: `P F11 P^T = L B L^T` with blocks of one or two rows in `B`
//! (Bunch and Kaufman), `U = B L^T P` and `right = B below^T`.

mod front;
mod order;

use super::dense::{column, column_blocks, trial_right_side};
use super::{LinalgError, SparsityPattern, interruption};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
    solve_unit_upper_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::traits::math_utils::abs;
use faer::{Accum, ColRef, Mat, MatMut, MatRef, Par, c64};
use front::{Eliminated, Remainder, Scalar};
use std::sync::Arc;

/// Right-hand sides solved together: enough to stream the factors once for many of them, few enough that a block of them stays in cache.
const BLOCK: usize = 32;

/// Order of elimination and fronts of every matrix on one pattern, symmetric in structure or not.
#[derive(Clone, Debug)]
pub struct LuAnalysis {
    pattern: Arc<SparsityPattern>,
    fronts: Arc<Vec<Front>>,
}

/// Unknowns that are eliminated together, and those that they leave coupled.
#[derive(Clone, Debug)]
struct Front {
    /// Unknowns of the matrix, those that are eliminated here first.
    unknowns: Vec<usize>,
    /// How many are eliminated here.
    width: usize,
    /// Nonzeros of the matrix: index among them, row and column here.
    entries: Vec<[u32; 3]>,
    /// Fronts whose remainder this one takes up.
    children: Vec<usize>,
    /// Places in the parent of the unknowns that remain.
    places: Vec<usize>,
}

impl LuAnalysis {
    /// Analyses a pattern.
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub fn new(pattern: &Arc<SparsityPattern>) -> Result<Self, LinalgError> {
        let fronts = Arc::new(order::fronts(pattern)?);
        Ok(Self { pattern: Arc::clone(pattern), fronts })
    }

    /// Eliminates front by front and hands each one on. Whether a front is symmetric is told by its entries, unless all are.
    fn eliminate<T: Scalar>(
        &self,
        values: &[T],
        are_symmetric: bool,
        mut take: impl FnMut(Eliminated<T>),
    ) {
        interruption::check();
        let mut left: Vec<Option<Remainder<T>>> = self.fronts.iter().map(|_| None).collect();
        for (k, front) in self.fronts.iter().enumerate() {
            let (own, rest) = self.front(k, values, are_symmetric, &left);
            front.children.iter().for_each(|&child| left[child] = None); // Taken up: their memory is free.
            left[k] = Some(rest);
            take(own);
        }
    }

    /// Eliminates one front, of which the children `left` these; what it leaves itself.
    fn front<T: Scalar>(
        &self,
        k: usize,
        values: &[T],
        are_symmetric: bool,
        left: &[Option<Remainder<T>>],
    ) -> (Eliminated<T>, Remainder<T>) {
        let front = &self.fronts[k];
        // Entries of the matrix.
        let size = front.unknowns.len();
        let mut matrix = Mat::<T>::zeros(size, size);
        for &[at, row, column] in &front.entries {
            matrix[(row as usize, column as usize)] = values[at as usize];
        }
        let of_child =
            |&child: &usize| left[child].as_ref().expect("a front comes after those it takes up");
        let is_alike = || T::IS_REAL && front::is_symmetric(matrix.as_ref(), front.width);
        let is_symmetric = (are_symmetric || is_alike())
            && front.children.iter().map(of_child).all(|own| own.is_symmetric);
        // What its children leave: of symmetric ones the lower triangle, which is enough for another symmetric one.
        for child in &front.children {
            let (update, places) = (of_child(child), &self.fronts[*child].places);
            for (j, &column) in places.iter().enumerate() {
                let first = if update.is_symmetric { j } else { 0 };
                for (i, &row) in places.iter().enumerate().skip(first) {
                    let value = update.matrix[(i, j)];
                    matrix[(row, column)] += value;
                    if update.is_symmetric && !is_symmetric && i != j {
                        matrix[(column, row)] += value; // The triangle that a symmetric one does not hold.
                    }
                }
            }
        }
        Eliminated::of(matrix, front.width, is_symmetric)
    }
}

/// Some rows of a block, in memory that serves for one front after the other.
fn gathered<'a, T: Copy>(
    x: &MatMut<'_, T>,
    rows: impl ExactSizeIterator<Item = usize> + Clone,
    memory: &'a mut Vec<T>,
) -> MatMut<'a, T> {
    memory.clear();
    for j in 0..x.ncols() {
        let own = column(x.as_ref(), j);
        memory.extend(rows.clone().map(|row| own[row]));
    }
    MatMut::from_column_major_slice_mut(memory, rows.len(), x.ncols())
}

/// Puts rows of a block in place.
fn scatter<T: Copy>(
    x: &mut MatMut<'_, T>,
    rows: impl Iterator<Item = usize> + Clone,
    own: MatRef<'_, T>,
) {
    for j in 0..own.ncols() {
        rows.clone().zip(column(own, j)).for_each(|(row, value)| x[(row, j)] = *value);
    }
}

/// Takes the product `a y` from rows of a block.
fn subtract<T: Scalar>(
    x: &mut MatMut<'_, T>,
    rows: &[usize],
    a: MatRef<'_, T>,
    y: MatRef<'_, T>,
    memory: &mut Vec<T>,
) {
    memory.clear();
    memory.resize(a.nrows() * y.ncols(), T::zero_impl());
    let mut change = MatMut::from_column_major_slice_mut(memory, a.nrows(), y.ncols());
    matmul(change.as_mut(), Accum::Replace, a, y, T::one_impl(), Par::Seq);
    for j in 0..change.ncols() {
        let changes = rows.iter().zip(column(change.as_ref(), j));
        changes.for_each(|(&row, change)| x[(row, j)] -= *change);
    }
}

macro_rules! sparse_lu {
    ($(#[$doc:meta])* $name:ident, $scalar:ty) => {
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $name {
            analysis: LuAnalysis,
            fronts: Vec<Eliminated<$scalar>>,
            values: Vec<$scalar>,
        }

        impl $name {
            /// Factorizes the matrix with nonzero `values` on the analysed pattern.
            ///
            /// # Errors
            /// If the factors are not finite or fail a trial solve: singular to working precision.
            pub fn factorize(
                analysis: &LuAnalysis,
                values: Vec<$scalar>,
            ) -> Result<Self, LinalgError> {
                Self::eliminated(analysis, values, false)
            }

            fn eliminated(
                analysis: &LuAnalysis,
                values: Vec<$scalar>,
                are_symmetric: bool,
            ) -> Result<Self, LinalgError> {
                let mut fronts = Vec::with_capacity(analysis.fronts.len());
                analysis.eliminate(&values, are_symmetric, |own| fronts.push(own));
                let lu = Self { analysis: analysis.clone(), fronts, values };
                lu.check()?;
                Ok(lu)
            }

            /// `ln det A` of the matrix with nonzero `values` on the analysed pattern, its imaginary part up to multiples of `2 pi`; no
            /// factors are kept. It is the product of all pivots with the signs of the exchanges; the order of elimination moves rows and
            /// columns alike.
            ///
            /// # Errors
            /// On a pivot of zero, or where entries grow so much that rounding would tell.
            pub fn ln_determinant(
                analysis: &LuAnalysis,
                values: &[$scalar],
            ) -> Result<c64, LinalgError> {
                let (mut sum, mut largest) = (c64::new(0.0, 0.0), 0.0_f64);
                analysis.eliminate(values, false, |own| {
                    sum += own.ln_determinant();
                    largest = largest.max(own.largest());
                });
                let is_regular = sum.re.is_finite() && sum.im.is_finite();
                let condition = if is_regular { 1.0 } else { f64::INFINITY };
                let given = values.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(abs(v)));
                let n = analysis.pattern.dimension();
                LinalgError::check(n, f64::EPSILON * largest / given, condition)?; // Growth times epsilon is a backward error.
                Ok(sum)
            }

            /// Solves `A x = b` for each column of `right_sides`, in place.
            pub fn solve_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                column_blocks(right_sides, BLOCK).for_each(|block| self.solve_block(block, false));
            }

            /// Solves `A^T x = b` for each column of `right_sides`, in place.
            pub fn solve_transpose_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                column_blocks(right_sides, BLOCK).for_each(|block| self.solve_block(block, true));
            }

            /// Solves `A x = b`.
            pub fn solve(&self, mut right_side: Vec<$scalar>) -> Vec<$scalar> {
                let n = right_side.len();
                self.solve_in_place(MatMut::from_column_major_slice_mut(&mut right_side, n, 1));
                right_side
            }

            /// Solves `A x = b` with one step of iterative refinement.
            pub fn solve_refined(&self, right_side: &[$scalar]) -> Vec<$scalar> {
                let mut x = self.solve(right_side.to_vec());
                let correction = self.solve(self.residual(&x, right_side)); // A^-1 (b - A x).
                x.iter_mut().zip(correction).for_each(|(x, r)| *x += r);
                x
            }

            /// `y = L^-1 P b`, then `x = U^-1 (y - right x)`; transposed `y = U^-T b`, then `x = P^T L^-T (y - below^T x)`. Of symmetric
            /// fronts `y = B^-1 L^-1 P b` and the latter.
            fn solve_block(&self, mut x: MatMut<'_, $scalar>, is_transposed: bool) {
                let [memory, other] = &mut [Vec::new(), Vec::new()];
                for (front, own) in self.analysis.fronts.iter().zip(&self.fronts) {
                    let (eliminated, others) = front.unknowns.split_at(front.width);
                    let (pivots, below) = own.columns.as_ref().split_at_row(front.width);
                    let is_left = own.is_symmetric() || !is_transposed;
                    let row = |i: usize| eliminated[if is_left { own.exchanges[i] } else { i }]; // Rows in the order of P.
                    let mut y = gathered(&x, (0..front.width).map(row), memory);
                    let beyond = match is_left {
                        true => {
                            solve_unit_lower_triangular_in_place(pivots, y.as_mut(), Par::Seq);
                            below
                        }
                        false => {
                            solve_lower_triangular_in_place(pivots.transpose(), y.as_mut(), Par::Seq);
                            own.right.transpose()
                        }
                    };
                    subtract(&mut x, others, beyond, y.as_ref(), other); // b_2 less below y, or right^T y.
                    if own.is_symmetric() {
                        own.divide(y.as_mut());
                    }
                    scatter(&mut x, eliminated.iter().copied(), y.as_ref());
                }
                for (front, own) in self.analysis.fronts.iter().zip(&self.fronts).rev() {
                    let (eliminated, others) = front.unknowns.split_at(front.width);
                    let (pivots, below) = own.columns.as_ref().split_at_row(front.width);
                    let is_left = own.is_symmetric() || is_transposed;
                    let beyond = if is_left { below.transpose() } else { own.right.as_ref() };
                    let known = gathered(&x, others.iter().copied(), memory);
                    subtract(&mut x, eliminated, beyond, known.as_ref(), other); // y less right x_2, or below^T x_2.
                    let mut y = gathered(&x, eliminated.iter().copied(), memory);
                    match is_left {
                        true => solve_unit_upper_triangular_in_place(pivots.transpose(), y.as_mut(), Par::Seq),
                        false => solve_upper_triangular_in_place(pivots, y.as_mut(), Par::Seq),
                    }
                    let row = |i: usize| eliminated[if is_left { own.exchanges[i] } else { i }];
                    scatter(&mut x, (0..front.width).map(row), y.as_ref());
                }
            }

            /// `b - A x`.
            fn residual(&self, x: &[$scalar], right_side: &[$scalar]) -> Vec<$scalar> {
                let mut r = right_side.to_vec();
                for (position, row, column) in self.analysis.pattern.nonzeros() {
                    r[row] -= self.values[position] * x[column];
                }
                r
            }

            /// The factorization itself reports no numerical singularity: a trial solve does.
            fn check(&self) -> Result<(), LinalgError> {
                let n = self.analysis.pattern.dimension();
                let right_side: Vec<$scalar> = trial_right_side(n).map(<$scalar>::from).collect();
                let x = self.solve(right_side.clone());
                let largest = |values: &[$scalar]| ColRef::from_slice(values).norm_max();
                let scale = self.norm() * largest(&x); // |A| |x|, with |b| below 2.
                let backward_error = largest(&self.residual(&x, &right_side)) / scale;
                // A large solution says that the matrix has no inverse in double precision.
                LinalgError::check(n, backward_error, scale / 2.0)
            }

            /// Largest row sum of absolute values.
            fn norm(&self) -> f64 {
                let pattern = &self.analysis.pattern;
                let mut sums = vec![0.0; pattern.dimension()];
                for (&row, value) in pattern.row_indices().iter().zip(&self.values) {
                    sums[row] += abs(value);
                }
                sums.into_iter().fold(0.0, f64::max)
            }
        }
    };
}

sparse_lu!(
    /// Factors of a real sparse matrix.
    SparseLu,
    f64
);
sparse_lu!(
    /// LU factors of a complex sparse matrix, on the analysis that also serves real ones.
    ComplexSparseLu,
    c64
);

impl SparseLu {
    /// Factorizes a symmetric matrix, definite or not: a lower triangle.
    ///
    /// # Errors
    /// As [`Self::factorize`].
    pub fn symmetric(analysis: &LuAnalysis, values: Vec<f64>) -> Result<Self, LinalgError> {
        Self::eliminated(analysis, values, true)
    }

    /// Order of elimination of its pattern, which serves others.
    pub fn analysis(&self) -> &LuAnalysis {
        &self.analysis
    }

    /// Number of negative eigenvalues of a symmetric matrix (Sylvester's law of inertia: those of `B`).
    pub fn negative_count(&self) -> usize {
        self.fronts.iter().map(|own| own.negative_count()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MatrixPolynomial;
    use crate::dense::{product, random_columns, transpose_product};
    use std::f64::consts::TAU;

    /// Exact: the determinant of a matrix without symmetry, in structure or in values, is that of dense elimination.
    #[test]
    fn determinants_are_those_of_dense_elimination() {
        for n in [1, 2, 37, 150] {
            let random = random_columns(n, 6, 7);
            let far = |i: usize, j: usize| ((random[(i, j)].abs() * 1e4) as usize * 7 + i) % n;
            let off = (0..n).flat_map(|i| [(i, far(i, 0)), (far(i, 1), i), (i, (i + 1) % n)]);
            let all = off.chain((0..n).map(|i| (i, i)));
            let pattern = Arc::new(SparsityPattern::from_positions(n, all));
            let value = |at: usize| {
                let at = (at % n, at / n);
                c64::new(random[(at.0, 2 + at.1 % 2)], random[(at.0, 4 + at.1 % 2)])
            };
            let values: Vec<c64> = (0..pattern.nonzero_count()).map(value).collect();
            let mut dense = Mat::<c64>::zeros(n, n);
            for column in 0..n {
                for (at, row) in pattern.column(column) {
                    dense[(row, column)] = values[at];
                }
            }
            let exact = dense.determinant();
            let analysis = LuAnalysis::new(&pattern).unwrap();
            let found = ComplexSparseLu::ln_determinant(&analysis, &values).unwrap();
            assert!((found.re - exact.norm().ln()).abs() < 1e-9, "{n}");
            let turns = (found.im - exact.arg()) / TAU;
            assert!((turns - turns.round()).abs() < 1e-9, "{n} {turns}");
        }
    }

    /// A chain of springs `K`, and a family: friction couples a few of its masses, or all, without symmetry.
    fn family(n: usize, shift: f64, coupled: &[usize]) -> MatrixPolynomial {
        let springs = (0..n).flat_map(|i| {
            let next = (i + 1 < n).then(|| [(i, i + 1, -1.0), (i + 1, i, -1.0)]);
            let far = (i + 7 < n).then(|| [(i, i + 7, -0.5), (i + 7, i, -0.5)]);
            [(i, i, 3.1 - shift)].into_iter().chain(next.into_iter().chain(far).flatten())
        });
        let pairs = coupled.iter().flat_map(|&i| coupled.iter().map(move |&j| (i, j)));
        let friction = pairs.map(|(i, j)| (i, j, ((3 * i + 5 * j) % 11) as f64 / 11.0));
        MatrixPolynomial::from_triplets(n, &[springs.collect(), friction.collect()])
    }

    /// Exact: factors of a family solve its matrices, transposed or not, definite or not, and so do its determinants, whether friction
    /// couples a few unknowns without symmetry, many or all.
    #[test]
    fn matrices_that_friction_makes_unsymmetric_in_part_are_solved_both_ways() {
        let n = 400;
        let (few, all) = ([17, 18, 19, 201], (0..n).collect::<Vec<_>>());
        let x = random_columns(n, 5, 3);
        for (coupled, shift) in [(&few[..], 0.0), (&few, 2.0), (&all[..40], 0.0), (&all, 0.0)] {
            let family = family(n, shift, coupled);
            let analysis = LuAnalysis::new(family.pattern()).unwrap();
            for values in [0.3, 0.0, 0.8].map(|mu| family.evaluate(mu)) {
                let matrix = family.pattern().multiply(&values, Mat::identity(n, n).as_ref());
                let lu = SparseLu::factorize(&analysis, values.clone()).unwrap();
                let [mut right, mut left] =
                    [product, transpose_product].map(|times| times(matrix.as_ref(), x.as_ref()));
                lu.solve_in_place(right.as_mut());
                lu.solve_transpose_in_place(left.as_mut());
                let bound = 1e-12 * x.norm_max() * n as f64;
                assert!([right, left].iter().all(|own| (own - &x).norm_max() < bound), "{shift}");
                let ln = SparseLu::ln_determinant(&analysis, &values).unwrap();
                let complex: Vec<c64> = values.into_iter().map(c64::from).collect();
                let exact = ComplexSparseLu::ln_determinant(&analysis, &complex).unwrap();
                assert!((ln.re - exact.re).abs() < 1e-9 * exact.re.abs());
                assert!((ln.im.cos() - exact.im.cos()).abs() < 1e-6);
            }
        }
    }

    /// A matrix without inverse has no logarithm.
    #[test]
    fn singular_matrix_is_refused() {
        let pattern = SparsityPattern::from_positions(2, [(0, 0), (0, 1), (1, 0), (1, 1)]);
        let analysis = LuAnalysis::new(&Arc::new(pattern)).unwrap();
        let one = c64::new(1.0, 0.0);
        let refused =
            ComplexSparseLu::ln_determinant(&analysis, &[one; 4]).unwrap_err().to_string();
        assert!(
            refused.ends_with("its condition number is at least inf, the bound is 1e15"),
            "{refused}"
        );
    }
}
