//! Sparse LU factorization and Krylov-Schur iteration over faer.

pub mod banded;
mod polynomial;

pub use polynomial::{MatrixPolynomial, SparsityPattern};
