//! Dense LU factorization, sequential and instantiated once for each scalar.

use super::interruption;
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
        }

        impl $name {
            /// Factorizes a square matrix with partial pivoting.
            pub fn factorize(mut matrix: Mat<$scalar>) -> Self {
                interruption::check();
                let n = matrix.nrows();
                let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
                let scratch = factor::lu_in_place_scratch::<usize, $scalar>(
                    n,
                    n,
                    Par::Seq,
                    Default::default(),
                );
                factor::lu_in_place(
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
                }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::random_columns;

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
}
