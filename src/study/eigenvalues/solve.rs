//! Solution of the eigenvalue analysis of a case, and the notes on its results.

use super::model::{Model, Solver, Spectrum, mode_limit};
use super::notes::{
    MISSING_SHOWN, count_notes, coverage_note, damping_note, ended_notes, friction_note,
    instead_note, overdamped_note, table_notes, uncertainty_note, weak_note,
};
use super::reading::{lefts_needed, read, shapes_needed};
use super::sensitivity::body_sensitivities;
use super::solid::SolidBody;
use super::{Progress, SlidingModel, Solution, StudyError, no_modes};
use crate::case::{Case, Cea, CeaMethod};
use crate::cea::{CeaError, SweepRequest, Unwatched};
use crate::prestress::PrestressError;
use crate::results::cea::SensitivityReport;

/// Solves the case's eigenproblems with its method; `progress` hears of every friction value solved.
pub fn solve(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    progress: &Progress<'_>,
) -> Result<Solution, StudyError> {
    solve_with(case, cea, model, (true, progress))
}

/// [`solve`] without the sensitivities.
pub fn solve_modes(case: &Case, cea: &Cea, model: &SlidingModel) -> Result<Solution, StudyError> {
    solve_with(case, cea, model, (false, &Unwatched))
}

fn solve_with(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    (with_reading, progress): (bool, &Progress<'_>),
) -> Result<Solution, StudyError> {
    // Branches are known up to the largest friction coefficient of the sweep.
    let friction = case.contact.sliding.friction_coefficient;
    let frictions = cea.solved_friction_coefficients();
    let waves_at: &[f64] = if with_reading { &frictions } else { &[] };
    let modes = case.cost().cea.map_or(0, |cost| cost.modes) as f64;
    let solve = |of: &Model| {
        let (mut shown, mut lefts_at) = (cea.shapes_at.clone(), Vec::new());
        if with_reading {
            shown.extend(shapes_needed(case, of, &frictions, modes));
            lefts_at = lefts_needed(case, cea.mass, &shown, modes);
        }
        let request = SweepRequest {
            shapes_at: &shown,
            lefts_at: &lefts_at,
            count_modes: cea.count_modes && with_reading,
            ..SweepRequest::new(&frictions, mode_limit(cea))
        };
        of.spectrum_with_waves(case, (&request, waves_at), progress)
    };
    let solved = solve(&model.model);
    let (mut found, method, instead) = match solved {
        Ok(found) => (found, model.model.method(), None),
        Err(error) => {
            let whole = whole_mesh_instead(case, cea, model, &error)?;
            let whole = whole.ok_or_else(|| at_key(case, &error))?;
            let found = solve(&whole)?;
            (found, whole.method(), Some(instead_note(&error)))
        }
    };
    // Those of waves cost next to nothing.
    let is_asked = cea.sensitivities.unwrap_or(found.waves.is_some());
    let is_asked = is_asked && with_reading && frictions.iter().any(|&mu| mu >= friction);
    let (sensitivities, rate_note) = match is_asked {
        true => body_rates(case, cea, &found),
        false => (None, None),
    };

    let mut notes: Vec<String> = found.coverage.iter().map(coverage_note).collect();
    notes.extend(count_notes(cea, &found.sweep, found.coverage.is_some()));
    notes.extend(instead);
    notes.extend(found.notes);
    notes.extend(overdamped_note(case, model, &found.overdamped));
    notes.extend(model.solid().and_then(SolidBody::note));
    notes.extend(table_notes(case));
    notes.extend(rate_note);
    notes.extend(uncertainty_note(case, &found.sweep));
    notes.extend(damping_note(case, &found.sweep));
    notes.extend(ended_notes(&found.sweep));
    notes.extend(weak_note(&found.sweep));
    notes.extend(friction_note(case, model));
    let reading = match with_reading {
        true => read(case, model, found.waves.as_ref().map(|waves| &waves.tangent), &found.sweep),
        false => None,
    };
    // Shapes and waves that only the reading needed.
    for point in &mut found.sweep.points {
        point.modes.iter_mut().for_each(|mode| mode.wave = None);
        if !cea.shapes_at.contains(&point.friction_coefficient) {
            point.modes.iter_mut().for_each(|mode| mode.shape = None);
        }
    }
    Ok(Solution {
        reading,
        dofs: found.dofs,
        method: if found.is_by_diameters { "cyclic" } else { method },
        sensitivities,
        notes,
        sweep: found.sweep,
    })
}

/// Sensitivities of a body; why there are none, or what is missing of them.
fn body_rates(
    case: &Case,
    cea: &Cea,
    found: &Spectrum,
) -> (Option<SensitivityReport>, Option<String>) {
    let friction = case.contact.sliding.friction_coefficient;
    let (sweep, waves) = (&found.sweep, found.waves.as_ref());
    let mut points = sweep.points.iter();
    if waves.is_none() && !points.any(|p| p.friction_coefficient == friction && !p.modes.is_empty())
    {
        let note = format!(
            "no sensitivities: there are no modes at contact.friction_coefficient = {friction}; name it in \
             cea.friction_coefficients"
        );
        return (None, Some(note));
    }
    match body_sensitivities(case, cea, sweep, waves) {
        Ok(found) => {
            let missing = found.missing.iter().take(MISSING_SHOWN).cloned();
            let mut missing: Vec<String> = missing.collect();
            if found.missing.len() > MISSING_SHOWN {
                missing.push("...".to_owned());
            }
            let note = format!("sensitivities.csv has gaps: {}", missing.join("; "));
            let has_gaps = !found.missing.is_empty();
            (Some(found.report), has_gaps.then_some(note))
        }
        // The spectrum is there all the same.
        Err(error) => {
            let why = error.messages().join("; ");
            (None, Some(format!("no sensitivities: {why}")))
        }
    }
}

/// An error about a key of the case where that is given; any other as it is.
pub(super) fn at_key(case: &Case, error: &CeaError) -> StudyError {
    match error {
        CeaError::BeyondTable { key, .. } => {
            let help = "extend the table, or lower cea.max_frequency_hz or cea.modes";
            case.error_at(key, error.to_string(), "does not cover the modes", help).into()
        }
        CeaError::NoModes { .. } => no_modes(case, error.to_string()),
        other => other.clone().into(),
    }
}

/// The whole mesh of a plane annulus, where `auto` chose its harmonics and a branch of them could not be followed.
fn whole_mesh_instead(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    error: &CeaError,
) -> Result<Option<Model>, CeaError> {
    let is_lost = matches!(
        error,
        CeaError::LostHarmonic { .. }
            | CeaError::Unproven { .. }
            | CeaError::Unrefined { .. }
            | CeaError::Incomplete { .. }
            | CeaError::Prestress(PrestressError::Singular)
    );
    match &model.model {
        Model::Sectors(_, options) if is_lost && cea.method == CeaMethod::Auto => {
            let frictions = cea.solved_friction_coefficients();
            Model::with_solver(case, Solver::WholeMesh, *options, &frictions).map(Some)
        }
        _ => Ok(None),
    }
}
