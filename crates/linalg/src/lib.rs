//! Sparse factorizations and eigenvalue iterations over faer.
//!
//! The only crate that calls faer: its algorithms are compiled here once, for every crate above.

pub mod banded;
mod bracket;
mod contour;
pub mod dense;
pub mod dense_eigen;
mod dense_lu;
mod dissection;
mod distribution;
mod error;
mod gaussian_noise;
pub mod gram;
pub mod interruption;
mod krylov_schur;
mod linear_family;
mod newton;
mod pattern;
mod polynomial;
mod sparse_lu;
mod sparse_product;
mod symmetric_pairs;
pub mod vectors;

pub use faer::traits::ComplexField;
pub use faer::{Mat, MatMut, MatRef, Scale, c64};

pub use bracket::Bracket;
pub use contour::{Uncounted, ZeroCount, count_zeros};
pub use dense_lu::{ComplexDenseLu, DenseLu};
pub use distribution::Distribution;
pub use error::LinalgError;
pub use gaussian_noise::GaussianNoise;
pub use krylov_schur::{BlockOperator, KrylovSchurSettings, RealPairs, krylov_schur};
pub use linear_family::LinearFamily;
pub use newton::newton_root;
pub use pattern::SparsityPattern;
pub use polynomial::{FrictionWeights, MatrixPolynomial};
pub use sparse_lu::{ComplexSparseLu, LuAnalysis, SparseLu};
pub use symmetric_pairs::{SymmetricPairs, SymmetricPencil, symmetric_pairs};
