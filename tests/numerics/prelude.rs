//! What most of these tests name.

pub use crate::body::{options, rectangle};
pub use crate::cea_cyclic::paper;
pub use crate::common::prelude::*;
pub use crate::common::waves::{AnnulusModel, WaveModel};
pub use crate::continuum::{Annulus, Contact, Eigenvalue, Rayleigh, radial::gauss_legendre};
pub use crate::matrices::lossy_eigenvalues;
pub use crate::shaft::AnnulusMaterials;
pub use crate::sliding_bodies::{holds_for_all, sums};
pub use crate::solid_elements::{Pencil, passes_the_patch_test, sample};
pub use crate::solids::model::SolidModel;
pub use crate::structural_damping::{dense, dense_eigenvalues};
pub use crate::waves::{Differences, STEP, is_of, pairs, rates};
pub use faer::linalg::solvers::Solve;
pub use frictionsim::cea::cyclic::WaveSweep;
pub use frictionsim::cea::sparse::sweep;
pub use frictionsim::frf::Direction::{Axial, Radial, Tangential};
pub use frictionsim::linalg::dense::random_columns;
pub use frictionsim::study::eigenvalues::{SlidingModel, Solution, solve};
pub use frictionsim::study::matrices::matrices;
pub use nalgebra::{Matrix3, Rotation3, Vector3};

/// Holds a number to another, to a share of it.
#[track_caller]
pub fn near(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() < share, "{found} {expected}");
}

/// A case's body in its base state, and its eigenvalue analysis.
pub fn solution(case: &Case) -> (SlidingModel, Solution) {
    let cea = case.cea.as_ref().unwrap();
    let model = SlidingModel::new(case, cea).unwrap();
    let found = solve(case, cea, &model, Some(&Unwatched)).unwrap();
    (model, found)
}
