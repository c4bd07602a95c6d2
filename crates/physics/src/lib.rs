//! Bodies in frictional contact, from a mesh to their motion: no case, no result, no command.
//!
//! Each step has one module, and its equations stand there: [`mesh`], [`fem`], [`contact`], [`prestress`], and around the
//! steady sliding state [`cea`], [`transient`], [`frf`] and [`cycle`].

pub mod cea;
pub mod contact;
pub mod cycle;
pub mod fem;
pub mod frf;
/// Sparse, banded and dense linear algebra: a crate of its own, with the matrices of files.
pub mod linalg {
    pub use frictionsim_formats::{MarketMatrix, MatrixMarketError};
    pub use frictionsim_linalg::*;
}
pub mod mesh;
pub mod order;
pub mod parallel;
pub mod prestress;
pub mod transient;

use frictionsim_output as output;
use frictionsim_signal as signal;
