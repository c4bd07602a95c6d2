//! Dense LU factorization, sequential and instantiated once for each scalar.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::Perm;
use faer::{Conj, Mat, MatMut, Par, c64};

macro_rules! dense_lu {
    ($(#[$doc:meta])* $name:ident, $scalar:ty) => {
        $(#[$doc])*
        ///
        /// It does not report singularity: the solutions are then not finite, or huge.
        #[derive(Clone, Debug)]
        pub struct $name {
            factors: Mat<$scalar>,
            rows: Perm<usize>,
            swaps: usize,
        }

        impl $name {
            /// Factorizes a square matrix with partial pivoting.
            pub fn factorize(mut matrix: Mat<$scalar>) -> Self {
                let n = matrix.nrows();
                let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
                let scratch = factor::lu_in_place_scratch::<usize, $scalar>(
                    n,
                    n,
                    Par::Seq,
                    Default::default(),
                );
                let (info, _) = factor::lu_in_place(
                    matrix.as_mut(),
                    &mut forward,
                    &mut inverse,
                    Par::Seq,
                    MemStack::new(&mut MemBuffer::new(scratch)),
                    Default::default(),
                );
                Self {
                    factors: matrix,
                    rows: Perm::new_checked(forward.into(), inverse.into(), n),
                    swaps: info.transposition_count,
                }
            }

            /// Determinant of the row permutation, +1 or -1.
            pub fn permutation_sign(&self) -> f64 {
                if self.swaps.is_multiple_of(2) { 1.0 } else { -1.0 }
            }

            /// Solves `A x = b` for each column, in place.
            pub fn solve_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                let (n, width) = (self.factors.nrows(), right_sides.ncols());
                let scratch =
                    solve::solve_in_place_scratch::<usize, $scalar>(n, width, Par::Seq);
                solve::solve_in_place_with_conj(
                    self.factors.as_ref(),
                    self.factors.as_ref(),
                    self.rows.as_ref(),
                    Conj::No,
                    right_sides,
                    Par::Seq,
                    MemStack::new(&mut MemBuffer::new(scratch)),
                );
            }

            /// Solves `A^T x = b` for each column, in place.
            pub fn solve_transpose_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                let (n, width) = (self.factors.nrows(), right_sides.ncols());
                let scratch =
                    solve::solve_transpose_in_place_scratch::<usize, $scalar>(n, width, Par::Seq);
                solve::solve_transpose_in_place_with_conj(
                    self.factors.as_ref(),
                    self.factors.as_ref(),
                    self.rows.as_ref(),
                    Conj::No,
                    right_sides,
                    Par::Seq,
                    MemStack::new(&mut MemBuffer::new(scratch)),
                );
            }
        }
    };
}

dense_lu!(
    /// LU factors of a real dense matrix.
    DenseLu,
    f64
);
dense_lu!(
    /// LU factors of a complex dense matrix.
    ComplexDenseLu,
    c64
);

impl ComplexDenseLu {
    /// `det A / |det A|`; zero for a singular matrix.
    pub fn determinant_phase(&self) -> c64 {
        let diagonal = (0..self.factors.nrows()).map(|i| self.factors[(i, i)]);
        diagonal.fold(c64::new(self.permutation_sign(), 0.0), |phase, pivot| {
            let size = pivot.norm();
            if size > 0.0 {
                phase * (pivot / size)
            } else {
                c64::new(0.0, 0.0)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::dense::random_columns;

    #[test]
    fn dense_factors_solve_with_the_matrix_and_its_transpose() {
        let (re, im) = (random_columns(20, 20, 1), random_columns(20, 20, 2));
        let a = Mat::from_fn(20, 20, |i, j| c64::new(re[(i, j)], im[(i, j)]));
        let x = Mat::from_fn(20, 3, |i, j| c64::new(i as f64, j as f64 - 1.0));
        let lu = ComplexDenseLu::factorize(a.clone());
        let mut b = &a * &x;
        lu.solve_in_place(b.as_mut());
        assert!((b - &x).norm_max() < 1e-11);
        let mut b = a.transpose() * &x;
        lu.solve_transpose_in_place(b.as_mut());
        assert!((b - &x).norm_max() < 1e-11);
    }

    #[test]
    fn phase_of_a_determinant_follows_row_swaps_and_scaling() {
        let i = c64::new(0.0, 1.0);
        let mut a = Mat::<c64>::zeros(2, 2);
        a[(0, 1)] = i * 3.0;
        a[(1, 0)] = c64::new(2.0, 0.0);
        let phase = ComplexDenseLu::factorize(a).determinant_phase();
        assert!((phase + i).norm() < 1e-15);
        let singular = ComplexDenseLu::factorize(Mat::zeros(2, 2));
        assert_eq!(singular.determinant_phase().norm(), 0.0);
    }
}
