//! Search of a case for the basin boundary of two waves, or of two modes of a body without symmetry.
//! `cargo run --example studies` runs one.

use super::cycle::{Steady, disc_model, longest_step, operating_point};
use super::transient::SteppedMesh;
use crate::prelude::*;
use frictionsim_physics::cycle::periodic::{GrowingMode, ModeContest, PeriodMap};
use frictionsim_physics::cycle::{BasinBoundary, BasinRequest};
use frictionsim_physics::transient::OperatorChoice;
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

/// The boundary between the basins of two modes that grow, or between that of one mode and steady sliding, and the
/// numbers of the two rivals, 0 for steady sliding.
pub fn boundary_of_modes(
    case: &Case,
    request: &BasinRequest,
    simd: SimdLevel,
) -> Result<([usize; 2], BasinBoundary), StudyError> {
    let stepped = SteppedMesh::of(case)?;
    let steady = Steady::of(case, &stepped)?;
    let places = rivals(case, request, &steady)?;
    let modes: Vec<(usize, GrowingMode<'_>)> =
        places.into_iter().map(|place| (place + 1, steady.mode(place))).collect();
    let body = stepped.body(case);
    let operator = body.operator(OperatorChoice::Auto, simd)?;
    let fastest = modes.iter().map(|(_, mode)| mode.eigenvalue.im).fold(0.0, f64::max);
    let map = PeriodMap::new(body, operator.as_ref(), fastest, longest_step(case))?;
    let mut contest = ModeContest::new(map, &modes, request);
    let rivals = contest.rivals();
    Ok((rivals, request.boundary(rivals, |ratio| Ok::<_, StudyError>(contest.run(ratio)))?))
}

/// Places of the modes that compete: those asked for, else the two that grow fastest, else the least stable one.
fn rivals(case: &Case, request: &BasinRequest, steady: &Steady) -> Result<Vec<usize>, StudyError> {
    let growing = steady.growing();
    let Some(asked) = &request.modes else {
        return Ok(match growing.len() {
            0 => steady.least_stable().into_iter().collect(),
            _ => growing.into_iter().take(2).collect(),
        });
    };
    let count = steady.modes.len();
    if let Some(beyond) = asked.iter().find(|&&mode| mode > count) {
        return Err(StudyError::Case(refusal!(case, "basin.modes",
            "basin.modes: there is no mode {beyond}, {count} are looked at"; "1 to {count}";
            "raise cea.modes, or cea.max_frequency_hz")));
    }
    let still = asked.iter().find(|&&mode| !growing.contains(&(mode - 1)));
    if let ([_, _], Some(still)) = (&asked[..], still) {
        let numbers = number_ranges(&growing.iter().map(|place| place + 1).collect::<Vec<_>>());
        return Err(StudyError::Case(refusal!(case, "basin.modes",
            "basin.modes: mode {still} does not grow at contact.friction_coefficient = {}, and wins from no small \
             start (modes that grow: {})", case.contact.sliding.friction_coefficient,
            if growing.is_empty() { "none" } else { &numbers };
            "two modes that grow"; "name others, or one mode alone against steady sliding")));
    }
    Ok(asked.iter().map(|mode| mode - 1).collect())
}
