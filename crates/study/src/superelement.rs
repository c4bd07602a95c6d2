//! The eigenvalues of a superelement that stands free.

use crate::*;
use frictionsim_case::FreeSystem;
use frictionsim_physics::{cea::quadratic_modes, linalg::MarketMatrix};
use frictionsim_results::matrices::{FreeSpectrum, FreeSpectrumSummary};

/// The oscillating modes that a case asks for, out of all eigenvalues of its matrices.
///
/// # Errors
/// Matrices that are singular together.
pub fn free_spectrum(system: &FreeSystem) -> Result<FreeSpectrum, StudyError> {
    let own = &system.superelement;
    let [mass, damping, stiffness] = [&own.mass, &own.damping, &own.stiffness].map(dense);
    let all = quadratic_modes(mass.as_ref(), damping.as_ref(), stiffness.as_ref())?;
    let total = all.len();
    let oscillating = all.into_iter().filter(|mode| mode.eigenvalue.im > 0.0);
    let mut modes = sorted(oscillating, |mode| mode.eigenvalue.im);
    let overdamped = total - modes.len();
    modes.truncate(system.modes.selected(modes.iter().map(|mode| mode.eigenvalue.im)));
    let summary = FreeSpectrumSummary {
        superelement: own.name.clone(),
        dofs: own.mass.rows,
        method: "dense".to_owned(),
        modes: modes.len(),
        unstable: modes.iter().filter(|mode| mode.is_unstable()).count(),
        overdamped,
        max_residual: modes.iter().map(|mode| mode.residual).fold(0.0, f64::max),
    };
    Ok(FreeSpectrum { title: system.title.clone(), modes, summary })
}

fn dense(matrix: &MarketMatrix) -> Mat<f64> {
    let mut dense = Mat::zeros(matrix.rows, matrix.columns);
    for &(row, column, value) in &matrix.entries {
        dense[(row, column)] += value;
    }
    dense
}
