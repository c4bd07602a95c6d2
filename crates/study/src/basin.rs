//! Search of a case for the basin boundary of two waves, or of two modes of a body without symmetry.
//! `cargo run --example studies` runs one.

use super::StudyError;
use super::cycle::{boundary_of_modes, disc_model, operating_point};
use frictionsim_case::Case;
use frictionsim_physics::cycle::BasinBoundary;
use frictionsim_physics::fem::operator::SimdLevel;
use frictionsim_results::Manifest;
use frictionsim_results::basin::BasinSummary;

/// Bisects for the amplitude ratio at saturation that decides between the two rivals of `[basin]`.
///
/// # Errors
/// [`StudyError::Case`] for a case without `[basin]`; steady sliding of rotating waves that is stable; a transient that
/// cannot start.
pub fn boundary(case: &Case, simd: SimdLevel) -> Result<BasinBoundary, StudyError> {
    Ok(contest(case, simd)?.1)
}

/// The rivals, nodal diameters of waves or numbers of modes, and the boundary between them.
fn contest(case: &Case, simd: SimdLevel) -> Result<([usize; 2], BasinBoundary), StudyError> {
    let request = case.require_basin()?;
    if !case.has_rotating_waves() {
        return boundary_of_modes(case, request, simd);
    }
    Ok((request.harmonics, disc_model(case)?.basin(&operating_point(case), request, simd)?))
}

/// As [`boundary`], in the words of its results.
pub fn summary(case: &Case, manifest: &Manifest) -> Result<BasinSummary, StudyError> {
    let (rivals, found) = contest(case, SimdLevel::choose(&manifest.simd)?)?;
    Ok(BasinSummary::new(rivals, !case.has_rotating_waves(), found))
}
