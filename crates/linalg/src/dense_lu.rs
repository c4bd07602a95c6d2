//! Dense LU factorization, sequential and instantiated once for each scalar.

use super::interruption;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, MatMut, c64};

macro_rules! dense_lu {
    ($(#[$doc:meta])* $name:ident, $scalar:ty) => {
        $(#[$doc])*
        ///
        /// It does not report singularity: the solutions are then not finite, or huge.
        #[derive(Clone, Debug)]
        pub struct $name(PartialPivLu<$scalar>);

        impl $name {
            /// Factorizes a square matrix with partial pivoting.
            pub fn factorize(matrix: Mat<$scalar>) -> Self {
                interruption::check();
                Self(PartialPivLu::new(matrix.as_ref()))
            }

            /// Solves `A x = b` for each column, in place.
            pub fn solve_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                self.0.solve_in_place(right_sides);
            }

            /// Solves `A^T x = b` for each column, in place.
            pub fn solve_transpose_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                self.0.solve_transpose_in_place(right_sides);
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
