//! Sweep over the friction coefficient on any mesh, with sparse matrices.
//!
//! 1. [`FrictionlessModes`]: the lowest modes at `mu = 0` by Krylov-Schur iteration; the inertia of `K - sigma M` proves that none is
//!    missing.
//! 2. [`BasisBuilder`]: one basis that holds the modes of all friction coefficients. It takes up the modes at a few of these, chosen where
//!    residuals are largest, each from a Krylov iteration ([`crate::linalg::krylov_schur`]). Of a small body it spans all motions.
//! 3. [`SparseSweep::solve`]: the projected problem at each friction coefficient, in parallel; every mode is held to its residual in the
//!    full matrices. Where one fails a ladder is climbed: corrections by the factors without friction, then by factors of the full problem
//!    beside the modes ([`FullProblem`]). Strongly damped motions that fail then take no places.
//! 4. [`track`]: branches continued from `mu = 0`, so that none is lost on the way.
//! 5. [`ModeCounter`], where asked for: eigenvalues counted by the argument principle.
//! 6. [`SparseSweep::finish`]: critical friction coefficients by root finding on the branches.
//!
//! [`sweep`] does all of this; [`sweep_by_diameters`] does it for a body with cyclic symmetry, by waves around it.
//! Where stiffness depends on frequency every mode is solved at its own, in the projected problem and in its
//! residual. The basis then starts from the stiffness at the highest frequency wanted.

mod basis;
mod branches;
mod count;
mod edge;
#[cfg(test)]
mod fixtures;
mod frictionless;
mod full_problem;
mod linearization;
mod links;
mod meetings;
mod mode;
mod nodal_diameters;
mod own_frequency;
mod packed;
mod pairs;
mod point;
mod projected;
mod reduced;
mod structure;
mod sweep;
mod term;
mod waves;

// What most files here name.
use crate::cea::*;
use mode::{ModeAt, ModesAt, ReducedMode};
use projected::ProjectedMatrices;
use reduced::ReducedModel;
use term::Term;

pub use basis::BasisBuilder;
pub use branches::{BranchLabel, TrackedBranch, label_first, track};
pub use count::ModeCounter;
pub use edge::ContactEdge;
pub use frictionless::FrictionlessModes;
pub use full_problem::FullProblem;
pub use linearization::{Centre, Linearization};
pub use nodal_diameters::sweep_by_diameters;
pub use pairs::{ModePair, mode_pairs};
pub use point::{ModeCheck, SolvedPoint};
pub use structure::{ShiftInverted, StructureMatrices};
pub use sweep::{SparseSweep, sweep, sweep_sharing};
pub use waves::CyclicTangent;

/// Modes beyond the wanted ones that are computed along, so that crossings at the upper end of the range are seen.
const GUARD_MODES: usize = 5;
/// Modes held beyond the wanted ones, besides, where damping is not viscous alone: it moves modes past each other, and of two close ones
/// at the end corrections from the viscous modes may reach the wrong one.
const LOSSY_GUARD: usize = 3;
/// Modes beyond those to which a branch may be matched.
const TRACKING_MARGIN: usize = 6;
/// Distance of the overlap of two modes from 1 within which they are one branch beyond doubt.
const SAME: f64 = 0.1;
/// The same within which they may be one; part of a mode in the space of two branches from which on it is a combination of these.
const ALIKE: f64 = 0.5;
/// Part of an error that a round of a remedy or a step of an iteration may leave: with more it is worth no other one.
const LITTLE: f64 = 0.3;
/// Samples near a friction coefficient whose modes, together, come near its own and their left vectors.
const NEIGHBOURS: usize = 4;
/// Start vectors of an iteration: as many as equal eigenvalues may come together. With twice as many a half more are needed in all, which
/// costs as much as is won by reading matrices and factors once for more of them.
const SEARCH_WIDTH: usize = 4;
/// Columns of a dense operator up to which all of its pairs cost no more than an iteration for the leading ones: a second or two.
const WIDEST: usize = 600;
/// Vectors over the unknowns that are expanded, multiplied and solved for together.
const GROUP_WIDTH: usize = 24;
