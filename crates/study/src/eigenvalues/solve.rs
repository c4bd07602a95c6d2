//! Solution of the eigenvalue analysis of a case, and the notes on its results.

use super::notes::{
    MISSING_SHOWN, count_notes, coverage_note, damping_note, ended_notes, friction_note,
    instead_note, overdamped_note, ratio_note, table_notes, uncertainty_note, weak_note,
};
use super::reading::{lefts_needed, read, shapes_needed};
use super::{
    SlidingModel, Solution, contact::open_note, model::Model, no_modes,
    sensitivity::body_sensitivities,
};
use crate::*;
use frictionsim_physics::prestress::PrestressError;
use frictionsim_results::cea::SensitivityReport;
use std::borrow::Cow;

/// Solves the case's eigenproblems with its method; `progress` hears of every friction value solved. Without one there
/// are no sensitivities, and nothing is read from the modes.
pub fn solve(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    progress: Option<&dyn SweepWatch>,
) -> Result<Solution, StudyError> {
    let with_reading = progress.is_some();
    // Branches are known up to the largest friction coefficient of the sweep.
    let friction = case.contact.sliding.friction_coefficient;
    let frictions = cea.solved_friction_coefficients();
    let waves_at: &[f64] = if with_reading { &frictions } else { &[] };
    let modes = case.cost().cea.map_or(0, |cost| cost.modes) as f64;
    let (mut shown, mut lefts_at) = (cea.shapes_at.clone(), None);
    if with_reading {
        shown.extend(shapes_needed(case, &model.model, &frictions, modes));
        lefts_at = lefts_needed(case, cea.mass, &shown);
    }
    let request = SweepRequest {
        shapes_at: &shown,
        lefts_at,
        count_modes: cea.count_modes && with_reading,
        ..SweepRequest::new(&frictions, cea.modes)
    };
    let progress = progress.unwrap_or(&Unwatched);
    let found = model.model.spectrum_with_waves(case, (&request, waves_at), progress);
    let (mut found, waves) = found.map_err(|error| at_key(case, &error))?;
    let waves = waves.as_ref();
    // Those of waves cost a tenth of the run of an annulus, up to three fifths of that of bricks.
    let is_asked = cea.sensitivities.unwrap_or(waves.is_some());
    let is_asked = is_asked && with_reading && frictions.iter().any(|&mu| mu >= friction);
    let mut rate_note = None;
    if is_asked {
        (found.sensitivities, rate_note) = body_rates(case, cea, &found.sweep, waves);
    }

    let mut notes: Vec<String> =
        waves.map(|waves| coverage_note(&waves.coverage)).into_iter().collect();
    notes.extend(count_notes(cea, &found.sweep, waves.is_some()));
    notes.append(&mut found.notes);
    notes.extend(waves.and_then(|waves| overdamped_note(case, model, &waves.overdamped)));
    notes.extend(model.solid.as_ref().and_then(open_note));
    notes.extend(table_notes(case));
    notes.extend(ratio_note(case));
    notes.extend(rate_note);
    notes.extend(uncertainty_note(case, &found.sweep));
    notes.extend(damping_note(case, &found.sweep));
    notes.extend(ended_notes(&found.sweep));
    notes.extend(weak_note(&found.sweep));
    notes.extend(friction_note(case, model));
    found.notes = notes;
    if with_reading {
        found.reading = read(case, model, waves.map(|waves| &waves.tangent), &mut found.sweep);
    }
    // Shapes and waves that only the reading needed.
    for point in &mut found.sweep.points {
        point.modes.iter_mut().for_each(|mode| mode.wave = None);
        if !cea.shapes_at.contains(&point.friction_coefficient) {
            point.modes.iter_mut().for_each(|mode| mode.shape = None);
        }
    }
    Ok(found)
}

/// Sensitivities of a body; why there are none, or what is missing of them.
fn body_rates(
    case: &Case,
    cea: &Cea,
    sweep: &FrictionSweep,
    waves: Option<&WaveSweep>,
) -> (Option<SensitivityReport>, Option<String>) {
    let friction = case.contact.sliding.friction_coefficient;
    if sweep.modes_at(friction).is_empty() {
        let note = format!(
            "no sensitivities: there are no modes at contact.friction_coefficient = {friction}; name it in \
             cea.friction_coefficients"
        );
        return (None, Some(note));
    }
    match body_sensitivities(case, cea, sweep, waves) {
        Ok((report, mut missing)) => {
            let has_gaps = !missing.is_empty();
            if missing.len() > MISSING_SHOWN {
                missing.truncate(MISSING_SHOWN);
                missing.push("...".to_owned());
            }
            let note = format!("sensitivities.csv has gaps: {}", missing.join("; "));
            (Some(report), has_gaps.then_some(note))
        }
        // The spectrum is there all the same.
        Err(error) => (None, Some(format!("no sensitivities: {}", error.line()))),
    }
}

/// An error about a key of the case where that is given; any other as it is.
pub(super) fn at_key(case: &Case, error: &CeaError) -> StudyError {
    match error {
        CeaError::BeyondTable { key, .. } => {
            refusal!(case, key, "{error}"; "does not cover the modes";
                "extend the table, or lower cea.max_frequency_hz or cea.modes")
            .into()
        }
        CeaError::NoModes { .. } => no_modes(case, error.to_string()),
        other => other.clone().into(),
    }
}

/// A case as it was solved.
pub struct Solved<'a> {
    /// It, on its whole mesh where its harmonics could not be followed.
    pub case: Cow<'a, Case>,
    /// What was solved.
    pub model: SlidingModel,
    /// What came of it.
    pub solution: Solution,
}

/// [`SlidingModel::new`] and [`solve`]. Where `auto` chose the harmonics of a body and a branch of them cannot be
/// followed, its whole mesh is solved.
pub fn solved<'a>(
    case: &'a Case,
    cea: &Cea,
    progress: Option<&dyn SweepWatch>,
) -> Result<Solved<'a>, StudyError> {
    let model = SlidingModel::new(case, cea)?;
    let has_whole = cea.method == CeaMethod::Auto && matches!(model.model, Model::Waves(_));
    let error = match solve(case, cea, &model, progress) {
        Err(StudyError::Eigenvalues(error)) if has_whole && is_lost(&error) => error,
        other => return Ok(Solved { case: Cow::Borrowed(case), solution: other?, model }),
    };
    on_whole_mesh(case, cea, error, progress)
}

/// The case's whole mesh solved, after its harmonics ended in `error`.
fn on_whole_mesh<'a>(
    case: &'a Case,
    cea: &Cea,
    error: CeaError,
    progress: Option<&dyn SweepWatch>,
) -> Result<Solved<'a>, StudyError> {
    let Ok(case) = case.on_whole_mesh() else { return Err(error.into()) };
    let (mut case, whole) = (case.into_owned(), Cea { method: CeaMethod::Sparse, ..cea.clone() });
    // Nor waves around it.
    case.cea = case.cea.map(|own| Cea { method: CeaMethod::Sparse, ..own });
    let model = SlidingModel::new(&case, &whole)?;
    let mut solution = solve(&case, &whole, &model, progress)?;
    solution.notes.insert(0, instead_note(&error));
    Ok(Solved { case: Cow::Owned(case), model, solution })
}

/// Whether the harmonics of a body could not be followed.
fn is_lost(error: &CeaError) -> bool {
    matches!(
        error,
        CeaError::LostHarmonic { .. }
            | CeaError::Unproven { .. }
            | CeaError::Harmonic(_)
            | CeaError::Prestress(PrestressError::Singular)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Harmonics that cannot be followed leave a body of revolution its whole mesh.
    #[test]
    fn the_whole_mesh_is_solved_where_a_branch_of_a_harmonic_is_lost() {
        let cases = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases");
        let bytes = std::fs::read(format!("{cases}/disc-three-dimensions.toml")).unwrap();
        let sets = [
            "mesh.circumferential_elements=12",
            "mesh.radial_elements=3",
            "mesh.axial_elements=1",
            "mesh.element=\"quad4\"",
            "cea.friction_coefficients=[0.0, 0.3]",
            "cea.max_frequency_hz=12000",
            "contact.rotation_speed_rpm=-610",
        ];
        let case = Case::parse("disc", &bytes, &sets.map(str::to_owned)).unwrap();
        let cea = case.require_cea().unwrap();
        let waves = solved(&case, cea, None).unwrap();
        let error = CeaError::LostHarmonic { harmonic: 3, friction: 0.3 };
        let whole = on_whole_mesh(&case, cea, error, None).unwrap();
        assert_eq!((waves.solution.method, whole.solution.method), ("cyclic", "sparse"));
        let note = "a branch of harmonic 3 could not be followed up to friction 0.3: the whole mesh was solved instead";
        assert!(whole.solution.notes[0].starts_with(note), "{:?}", whole.solution.notes);
        // A friction traction in three dimensions is along the sliding, whatever its sense.
        let shears = [&waves, &whole].map(|own| own.model.base_state(&case).shear_pa[0]);
        assert!(shears[0] > 0.0 && (shears[1] / shears[0] - 1.0).abs() < 0.02, "{shears:?}");
        let points = waves.solution.sweep.points.iter().zip(&whole.solution.sweep.points);
        for (waves, whole) in points {
            assert_eq!(waves.modes.len(), whole.modes.len());
            for (wave, mode) in waves.modes.iter().zip(&whole.modes) {
                let error = (wave.frequency_hz() - mode.frequency_hz()).abs();
                assert!(error < 1e-6 * mode.frequency_hz(), "{error}");
            }
        }
    }

    /// What lies above the list is in no table; of what grows there both ways to solve a body tell the same.
    #[test]
    fn modes_above_the_list_are_told_and_have_no_sensitivities() {
        let cases = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases");
        let bytes = std::fs::read(format!("{cases}/polycarbonate-disc.toml")).unwrap();
        for method in ["cyclic", "sparse"] {
            let sets = [
                "mesh.circumferential_elements=24".to_owned(),
                "mesh.radial_elements=4".to_owned(),
                "cea.friction_coefficients=[0.0, 0.3]".to_owned(),
                "cea.max_frequency_hz=9847".to_owned(),
                "cea.sensitivities=true".to_owned(),
                format!("cea.method=\"{method}\""),
            ];
            let case = Case::parse("disc", &bytes, &sets).unwrap();
            let found = solved(&case, case.require_cea().unwrap(), Some(&Unwatched)).unwrap();
            let Solution { sensitivities, notes, sweep, .. } = found.solution;
            let above = "an unstable mode lies above those listed: 10540 Hz at friction 0.3";
            assert!(notes.iter().any(|note| note.starts_with(above)), "{notes:?}");
            let rows = sensitivities.unwrap().rows;
            assert_eq!(rows.len(), sweep.modes_at(0.3).len());
            assert!(rows.iter().all(|row| row.eigenvalue.im < TAU * 9847.0));
        }
    }

    #[test]
    fn a_motion_that_does_not_oscillate_at_rest_is_not_one_that_was_lost_on_the_way() {
        let note = instead_note(&CeaError::LostHarmonic { harmonic: 0, friction: 0.0 });
        assert!(note.starts_with("a motion of harmonic 0 does not oscillate at friction 0"));
    }
}
