//! The spectrum of a case for those who study it: no files, no base fields, no shapes.

use super::model::mode_limit;
use super::solve::{solve, solve_modes};
use super::{SlidingModel, StudyError};
use crate::case::{Case, Cea, CeaMethod, ModeSelection};
use crate::cea::cyclic::{self, Sensitivity};
use crate::cea::{ComplexMode, SweepRequest, UnstableInterval};
use crate::fem::MassKind;
use crate::study::tangent_options;

/// What `[cea]` says of a case, or its defaults, for these friction coefficients and modes up to a frequency.
fn analysis(case: &Case, frictions: &[f64], limit_hz: f64) -> Cea {
    let (modes, shapes_at) = (ModeSelection::BelowHz(limit_hz), Vec::new());
    let friction_coefficients = frictions.to_vec();
    match &case.cea {
        Some(cea) => Cea {
            friction_coefficients,
            modes,
            shapes_at,
            map: None,
            ..cea.clone()
        },
        None => Cea {
            friction_coefficients,
            modes,
            method: CeaMethod::Auto,
            mass: MassKind::Consistent,
            geometric_stiffness: true,
            shapes_at,
            map: None,
        },
    }
}

/// The modes of a case below `limit_hz` at its own friction coefficient, and of bodies of revolution with `with_rates` their
/// sensitivities.
///
/// # Errors
/// Those of the solver.
pub fn modes_below(
    case: &Case,
    limit_hz: f64,
    with_rates: bool,
) -> Result<(Vec<ComplexMode>, Vec<Sensitivity>), StudyError> {
    let friction = case.contact.sliding.friction_coefficient;
    let cea = analysis(case, &[friction], limit_hz);
    let (sweep, sensitivities) = match is_plane_annulus(case, &cea) {
        false => {
            let model = SlidingModel::new(case, &cea)?;
            let found = match with_rates {
                true => solve(case, &cea, &model, &|_| {})?,
                false => solve_modes(case, &cea, &model)?,
            };
            let rates = found.sensitivities.map(|rates| rates.branches);
            (found.sweep, rates.unwrap_or_default())
        }
        true => {
            let request = SweepRequest {
                friction_coefficients: &cea.friction_coefficients,
                limit: mode_limit(&cea),
                shapes_at: &[],
            };
            let options = tangent_options(case, cea.mass);
            let sliding = &case.contact.sliding;
            let found =
                cyclic::sweep(&case.annulus, case.materials(), &options, sliding, &request)?;
            let sensitivities = match with_rates {
                true => cyclic::sensitivities(&found, friction)?,
                false => Vec::new(),
            };
            (found.sweep, sensitivities)
        }
    };
    let point = sweep.points.into_iter().next();
    Ok((
        point.map_or_else(Vec::new, |point| point.modes),
        sensitivities,
    ))
}

/// Whether the harmonics of a plane annulus are solved; bodies in three dimensions have theirs, all others the whole mesh.
fn is_plane_annulus(case: &Case, cea: &Cea) -> bool {
    case.solid.is_none() && super::model::method_of(case, cea) != CeaMethod::Sparse
}

/// The ranges of friction over which branches of a case are unstable, from 0 to the largest of `frictions`, and the
/// harmonics that hold modes.
///
/// With `harmonics` those alone are looked at, without a proof that none is missed.
///
/// # Errors
/// Those of the solver; a frequency limit below the first mode.
pub fn unstable_intervals(
    case: &Case,
    frictions: &[f64],
    harmonics: Option<&[usize]>,
) -> Result<(Vec<UnstableInterval>, Vec<usize>), StudyError> {
    let own = case.require_cea()?;
    let cea = Cea {
        modes: own.modes,
        ..analysis(case, frictions, f64::INFINITY)
    };
    if !is_plane_annulus(case, &cea) {
        let model = SlidingModel::new(case, &cea)?;
        let sweep = solve_modes(case, &cea, &model)?.sweep;
        super::refuse_no_modes(case, &cea, &sweep)?;
        return Ok((sweep.intervals, Vec::new()));
    }
    let request = SweepRequest {
        friction_coefficients: frictions,
        limit: mode_limit(&cea),
        shapes_at: &[],
    };
    let options = tangent_options(case, cea.mass);
    let sliding = &case.contact.sliding;
    if let Some(harmonics) = harmonics {
        let (annulus, material) = (&case.annulus, case.materials());
        // A branch that meets another needs the larger margin that the proof has.
        if let Ok(found) = cyclic::onsets(annulus, material, &options, sliding, &request, harmonics)
        {
            return Ok((found, Vec::new()));
        }
    }
    let found = cyclic::sweep(&case.annulus, case.materials(), &options, sliding, &request)?;
    super::refuse_no_modes(case, &cea, &found.sweep)?;
    Ok((found.sweep.intervals, found.coverage.followed))
}
