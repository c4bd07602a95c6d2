//! Sparse LU factorization and Krylov-Schur iteration over faer.

mod polynomial;

pub use polynomial::{MatrixPolynomial, SparsityPattern};
