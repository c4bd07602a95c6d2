//! Complex eigenvalue analysis: the stability of steady sliding.
//!
//! One theory: what is asked for, what comes out, branches over the friction coefficient, and where they turn
//! unstable. Two producers of problems: [`sparse`] for any body, [`cyclic`] harmonic by harmonic for a rotationally
//! symmetric one. [`quadratic_modes`] solves small dense matrices whole, wherever they come from.

mod accuracy;
mod branch;
mod counted;
pub mod cyclic;
mod error;
mod onset;
mod quadratic;
mod request;
pub mod sparse;
mod spectrum;
mod watch;

// What most files here name.
use crate::linalg::dense::{column, column_mut, join_columns, random_columns, transpose_product};
use crate::linalg::vectors::{length, normalize};
use crate::linalg::{
    BlockOperator, ComplexDenseLu, DenseLu, LinalgError, LuAnalysis, Mat, MatRef, MatrixPolynomial,
    Scale, SparseLu, SparsityPattern, c64,
};
use crate::prestress::{HarmonicTangent, MotionMatrices, SlidingTangent, WaveTangent};
use accuracy::*;
use std::f64::consts::TAU;
use std::sync::Arc;

pub use branch::{BranchPoint, ModeBranch};
pub use counted::{CountedRegion, ModeCount};
pub use error::CeaError;
pub use quadratic::{QuadraticMode, quadratic_modes};
pub use request::{ModeLimit, SweepProgress, SweepRequest, SweepStage};
pub use spectrum::{
    ComplexMode, EndedMode, FrictionPoint, FrictionSweep, ModeVectors, ModeWave, UnconvergedMode,
    UnstableInterval, keeping_ties,
};
pub use watch::{PartWatch, SweepWatch, Unwatched};
