//! Harmonics followed as they stand, with a proof that no mode is missed: a plane annulus with viscous damping.

use super::completeness::{self, Verdict};
use super::found::{Found, MARGIN, Wanted, WaveSweep};
use super::modes::points;
use super::modes_below::{self, AtRest, at_rest, modes_below};
use super::paths::{HarmonicPaths, follow_pairs};
use super::problem::HarmonicProblem;
use crate::cea::{CeaError, FrictionSweep, ModeLimit, SweepRequest};
use crate::prestress::WaveTangent;
use std::f64::consts::TAU;

/// How often the margin is raised, by its own factor, where a branch comes from above it.
const MARGIN_ATTEMPTS: usize = 4;

/// Whether the bands are narrow, and the waves `+n` and `-n` of one real problem.
pub(super) fn applies(tangent: &WaveTangent) -> bool {
    tangent.components == 2 && !tangent.is_lossy()
}

/// The sweep of a body to which this [`applies`].
pub(super) fn solve(tangent: WaveTangent, wanted: &Wanted<'_>) -> Result<WaveSweep, CeaError> {
    let mut margin = MARGIN;
    let mut failure = None;
    for _ in 0..MARGIN_ATTEMPTS {
        match follow(&tangent, wanted, margin, None) {
            Ok(found) => {
                let verdict =
                    completeness::verify(&tangent, &found.followed, found.limit, wanted.grid);
                let Some(harmonic) = verdict.missed else {
                    return Ok(found.sweep(tangent, verdict, true));
                };
                failure = Some(CeaError::Unproven { harmonic, margin });
            }
            // The branch that it meets may lie above the margin.
            Err(error @ CeaError::LostHarmonic { .. }) => failure = Some(error),
            Err(error) => return Err(error),
        }
        margin *= MARGIN;
    }
    Err(failure.unwrap_or_else(CeaError::no_friction))
}

/// A sweep over some harmonics, without a proof that no mode is missed: for the many samples of a model for some of which a
/// whole one has said which harmonics hold modes. `None` of a body whose harmonics are reduced first.
///
/// # Errors
/// As [`super::wave_sweep`].
pub fn onsets(
    tangent: WaveTangent,
    request: &SweepRequest<'_>,
    harmonics: &[usize],
) -> Result<Option<FrictionSweep>, CeaError> {
    if !applies(&tangent) {
        return Ok(None);
    }
    let wanted = Wanted { request, waves_at: &[], grid: &request.rising_grid()? };
    request.limit.check()?;
    let found = follow(&tangent, &wanted, MARGIN, Some(harmonics))?;
    Ok(Some(found.sweep(tangent, Verdict::default(), false).sweep))
}

pub(super) fn follow(
    tangent: &WaveTangent,
    wanted: &Wanted<'_>,
    margin: f64,
    harmonics: Option<&[usize]>,
) -> Result<Found, CeaError> {
    let limit = wanted.request.limit;
    let (bound, known) = modes_below::bound(tangent, limit)?;
    let kappa = bound * margin * margin;
    let found = match (harmonics, limit) {
        (Some(own), ModeLimit::MaxFrequency(_)) => {
            let found: Result<Vec<_>, CeaError> =
                crate::parallel::map(own, |&n| at_rest(tangent, (n, None), kappa));
            found?.into_iter().flatten().collect()
        }
        _ => modes_below(tangent, kappa, known)?.0,
    };
    let largest = modes_below::wanted(tangent, &found, limit, bound)? * margin * margin;
    let kept = wanted.kept();
    let followed: Result<Vec<HarmonicPaths>, CeaError> =
        crate::parallel::map(found, |AtRest { harmonic: n, mut modes, .. }| {
            let problem = HarmonicProblem::new(tangent.harmonic(n), tangent.is_standing(n));
            modes.retain(|(kappa, _)| *kappa < largest);
            follow_pairs(problem, &modes, wanted.grid, &kept)
        });
    let mut followed = followed?;
    followed.retain(|paths| !paths.paths.is_empty());
    let points = points(tangent, &followed, wanted);
    let highest = points.iter().filter_map(|point| point.modes.last());
    let highest = highest.fold(0.0_f64, |top, mode| top.max(mode.eigenvalue.im));
    Ok(Found {
        limit: match limit {
            ModeLimit::Lowest(_) => highest,
            ModeLimit::MaxFrequency(value) => TAU * value,
        },
        followed,
        points,
        margin: largest.sqrt(),
        reduction_error: 0.0,
        overdamped: Vec::new(),
    })
}
