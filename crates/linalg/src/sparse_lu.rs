//! Sparse LU factorization: one symbolic analysis for all values of a pattern, real or complex.

use super::dense::column_blocks;
use super::{LinalgError, SparsityPattern, interruption};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, Mat, MatMut, Par, c64};
use std::sync::Arc;

/// Backward error of a trial solve above which a factorization is rejected.
const BACKWARD_ERROR_BOUND: f64 = 1e-9;
/// Right-hand sides solved together: enough to stream the factors once for many of them, few enough
/// that a block of them stays in cache.
const BLOCK: usize = 16;

/// Fill-reducing ordering and structure of the LU factors of every matrix on one pattern.
#[derive(Clone, Debug)]
pub struct LuAnalysis {
    pattern: Arc<SparsityPattern>,
    symbolic: Arc<SymbolicLu<usize>>,
}

impl LuAnalysis {
    /// Analyses a pattern (column approximate minimum degree).
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    #[inline]
    pub fn new(pattern: &Arc<SparsityPattern>) -> Result<Self, LinalgError> {
        let symbolic = factorize_symbolic_lu(pattern.symbolic(), Default::default())
            .map_err(|error| failure(pattern.dimension(), error))?;
        Ok(Self { pattern: Arc::clone(pattern), symbolic: Arc::new(symbolic) })
    }

    /// The pattern analysed.
    #[inline]
    pub fn pattern(&self) -> &Arc<SparsityPattern> {
        &self.pattern
    }
}

fn failure(dimension: usize, error: impl std::fmt::Debug) -> LinalgError {
    LinalgError::Factorization { dimension, reason: format!("{error:?}") }
}

macro_rules! sparse_lu {
    ($(#[$doc:meta])* $name:ident, $scalar:ty) => {
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $name {
            analysis: LuAnalysis,
            numeric: NumericLu<usize, $scalar>,
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
                interruption::check();
                let mut numeric = NumericLu::new();
                let symbolic = &analysis.symbolic;
                let scratch = symbolic
                    .factorize_numeric_lu_scratch::<$scalar>(Par::Seq, Default::default());
                symbolic
                    .factorize_numeric_lu(
                        &mut numeric,
                        analysis.pattern.matrix(&values),
                        Par::Seq,
                        MemStack::new(&mut MemBuffer::new(scratch)),
                        Default::default(),
                    )
                    .map_err(|error| failure(symbolic.nrows(), error))?;
                let lu = Self {
                    analysis: analysis.clone(),
                    numeric,
                    values,
                };
                lu.check()?;
                Ok(lu)
            }

            /// Number of unknowns.
            #[inline]
            pub fn dimension(&self) -> usize {
                self.analysis.pattern.dimension()
            }

            /// Solves `A x = b` for each column of `right_sides`, in place.
            #[inline]
            pub fn solve_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                self.solve_blocks(right_sides, false);
            }

            /// Solves `A^T x = b` for each column of `right_sides`, in place.
            #[inline]
            pub fn solve_transpose_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                self.solve_blocks(right_sides, true);
            }

            /// Solves `A x = b` with one step of iterative refinement.
            #[inline]
            pub fn solve_refined(&self, right_side: &[$scalar]) -> Vec<$scalar> {
                let n = right_side.len();
                let mut x = Mat::from_fn(n, 1, |i, _| right_side[i]);
                self.solve_in_place(x.as_mut());
                let mut r = self.residual(&x, right_side);
                self.solve_in_place(r.as_mut());
                (0..n).map(|i| x[(i, 0)] + r[(i, 0)]).collect()
            }

            fn solve_blocks(&self, right_sides: MatMut<'_, $scalar>, transposed: bool) {
                let lu = LuRef::new_unchecked(&self.analysis.symbolic, &self.numeric);
                let width = right_sides.ncols().clamp(1, BLOCK);
                let scratch = self
                    .analysis
                    .symbolic
                    .solve_in_place_scratch::<$scalar>(width, Par::Seq);
                let mut memory = MemBuffer::new(scratch);
                for block in column_blocks(right_sides, width) {
                    let stack = MemStack::new(&mut memory);
                    if transposed {
                        lu.solve_transpose_in_place_with_conj(Conj::No, block, Par::Seq, stack);
                    } else {
                        lu.solve_in_place_with_conj(Conj::No, block, Par::Seq, stack);
                    }
                }
            }

            /// `b - A x`.
            fn residual(&self, x: &Mat<$scalar>, right_side: &[$scalar]) -> Mat<$scalar> {
                let pattern = &self.analysis.pattern;
                let mut r = Mat::from_fn(right_side.len(), 1, |i, _| right_side[i]);
                for column in 0..pattern.dimension() {
                    for (position, row) in pattern.column(column) {
                        r[(row, 0)] -= self.values[position] * x[(column, 0)];
                    }
                }
                r
            }

            /// The factorization itself reports no numerical singularity: a trial solve does.
            fn check(&self) -> Result<(), LinalgError> {
                let n = self.analysis.pattern.dimension();
                let right_side: Vec<$scalar> = (0..n)
                    .map(|i| <$scalar>::from(1.0 + (i as f64 * 0.618_033_988_749_895).fract()))
                    .collect();
                let mut x = Mat::from_fn(n, 1, |i, _| right_side[i]);
                self.solve_in_place(x.as_mut());
                let largest = x.norm_max();
                let scale = self.norm() * largest;
                let backward_error = self.residual(&x, &right_side).norm_max() / scale;
                // A solution this large says that the matrix has no inverse in double precision.
                let condition = scale / 2.0;
                if n > 0
                    && !(backward_error <= BACKWARD_ERROR_BOUND && condition < 1e15)
                {
                    return Err(LinalgError::Singular {
                        dimension: n,
                        backward_error,
                        bound: BACKWARD_ERROR_BOUND,
                    });
                }
                Ok(())
            }

            /// Largest row sum of absolute values.
            fn norm(&self) -> f64 {
                let pattern = &self.analysis.pattern;
                let mut sums = vec![0.0; pattern.dimension()];
                for (&row, value) in pattern.row_indices().iter().zip(&self.values) {
                    sums[row] += faer::traits::math_utils::abs(value);
                }
                sums.into_iter().fold(0.0, f64::max)
            }
        }
    };
}

sparse_lu!(
    /// LU factors of a real sparse matrix.
    SparseLu,
    f64
);
sparse_lu!(
    /// LU factors of a complex sparse matrix, on the analysis that also serves real ones.
    ComplexSparseLu,
    c64
);
