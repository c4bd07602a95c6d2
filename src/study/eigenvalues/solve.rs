//! Solution of the eigenvalue analysis of a case, and the notes on its results.

use super::model::{Model, Solver, mode_limit};
use super::notes::{
    MISSING_SHOWN, count_notes, coverage_note, damping_note, ended_notes, friction_note,
    instead_note, overdamped_note, table_notes, uncertainty_note,
};
use super::reading::{read, shapes_needed};
use super::sensitivity::body_sensitivities;
use super::solid::SolidBody;
use super::{Progress, SlidingModel, Solution, StudyError};
use crate::case::{Case, Cea, CeaMethod};
use crate::cea::cyclic::Sensitivity;
use crate::cea::{CeaError, FrictionSweep, SweepRequest, Unwatched};
use crate::contact::NormalLaw;
use crate::fem::{RayleighDamping, RegionMaterial};
use crate::linalg::c64;
use crate::results::cea::{SensitivityReport, SensitivityRow};

/// Solves the case's eigenproblems with its method; `progress` hears of every friction value solved.
///
/// # Errors
/// Those of the solver.
pub fn solve(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    progress: &Progress<'_>,
) -> Result<Solution, StudyError> {
    solve_with(case, cea, model, (true, progress))
}

/// [`solve`] without the sensitivities.
///
/// # Errors
/// Those of the solver.
pub fn solve_modes(case: &Case, cea: &Cea, model: &SlidingModel) -> Result<Solution, StudyError> {
    solve_with(case, cea, model, (false, &Unwatched))
}

fn solve_with(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    (with_rates, progress): (bool, &Progress<'_>),
) -> Result<Solution, StudyError> {
    // Branches are known up to the largest friction coefficient of the sweep.
    let friction = case.contact.sliding.friction_coefficient;
    let frictions = cea.solved_friction_coefficients();
    let with_reading = with_rates;
    let with_rates = with_rates
        && cea.sensitivities != Some(false)
        && frictions.iter().any(|&mu| mu >= friction);
    let waves_at: &[f64] = if with_reading { &frictions } else { &[] };
    let shapes_at = |of: &Model| {
        let modes = case.cost().cea.map_or(0, |cost| cost.modes) as f64;
        let needed = with_reading.then(|| shapes_needed(case, of, &frictions, modes));
        [cea.shapes_at.as_slice(), &needed.unwrap_or_default()].concat()
    };
    let solve = |of: &Model| {
        let request = SweepRequest {
            friction_coefficients: &frictions,
            limit: mode_limit(cea),
            shapes_at: &shapes_at(of),
            count_modes: cea.count_modes && with_reading,
        };
        of.spectrum_with_waves(case, (&request, waves_at), with_rates, progress)
    };
    let solved = solve(&model.model);
    let (mut found, method, instead) = match solved {
        Ok(found) => (found, model.model.method(), None),
        Err(error) => {
            let whole = whole_mesh_instead(case, cea, model, &error)?;
            let whole = whole.ok_or_else(|| at_table(case, &error))?;
            let found = solve(&whole)?;
            (found, whole.method(), Some(instead_note(&error)))
        }
    };
    let is_asked = with_rates && cea.sensitivities == Some(true);
    let (of_body, rate_note) = match is_asked && method == "sparse" {
        true => body_rates(case, cea, &found.sweep),
        false => (None, None),
    };

    let mut notes: Vec<String> =
        found.coverage.iter().map(|c| coverage_note(&model.model, c)).collect();
    notes.extend(count_notes(cea, &found.sweep, found.coverage.is_some()));
    notes.extend(instead);
    notes.extend(found.notes);
    notes.extend(overdamped_note(case, model, &found.overdamped));
    notes.extend(model.solid().and_then(SolidBody::note));
    notes.extend(table_notes(case));
    if found.without_sensitivities > 0 {
        notes.push(format!(
            "sensitivities.csv leaves {} of the branches out, which could not be found again at friction {friction}",
            found.without_sensitivities
        ));
    }
    notes.extend(rate_note);
    notes.extend(uncertainty_note(case, &found.sweep));
    notes.extend(damping_note(case, &found.sweep));
    notes.extend(ended_notes(&found.sweep));
    notes.extend(friction_note(case, model));
    let reading = match with_reading {
        true => read(case, model, found.tangent.as_ref(), &found.sweep),
        false => None,
    };
    // Shapes and waves that only the reading needed.
    for point in &mut found.sweep.points {
        point.modes.iter_mut().for_each(|mode| mode.wave = None);
        if !cea.shapes_at.contains(&point.friction_coefficient) {
            point.modes.iter_mut().for_each(|mode| mode.shape = None);
        }
    }
    let sensitivities = found.sensitivities;
    Ok(Solution {
        reading,
        dofs: found.dofs,
        method: if found.is_by_diameters { "cyclic" } else { method },
        sensitivities: match of_body {
            Some(of_body) => Some(of_body),
            None => sensitivities.map(|branches| sensitivity_report(case, &branches)),
        },
        notes,
        sweep: found.sweep,
    })
}

/// Sensitivities of a body solved on its whole mesh; why there are none, or what is missing of them.
fn body_rates(
    case: &Case,
    cea: &Cea,
    sweep: &FrictionSweep,
) -> (Option<SensitivityReport>, Option<String>) {
    let friction = case.contact.sliding.friction_coefficient;
    let mut points = sweep.points.iter();
    if !points.any(|p| p.friction_coefficient == friction && !p.modes.is_empty()) {
        let note = format!(
            "no sensitivities: there are no modes at contact.friction_coefficient = {friction}; name it in \
             cea.friction_coefficients"
        );
        return (None, Some(note));
    }
    match body_sensitivities(case, cea, sweep) {
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

/// An error about a table of moduli at the key that names it; any other as it is.
fn at_table(case: &Case, error: &CeaError) -> StudyError {
    let help = "extend the table, or lower cea.max_frequency_hz or cea.modes";
    match error {
        CeaError::BeyondTable { key, .. } => {
            let label = "does not cover the modes".to_owned();
            let help = Some(help.to_owned());
            case.error_at(key, error.to_string(), label, help).into()
        }
        other => other.clone().into(),
    }
}

/// The whole mesh of a plane annulus, where `auto` chose its harmonics and a branch of them could not be followed.
///
/// # Errors
/// No state of steady sliding.
fn whole_mesh_instead(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    error: &CeaError,
) -> Result<Option<Model>, CeaError> {
    let is_lost = matches!(error, CeaError::LostHarmonic { .. } | CeaError::Unproven { .. });
    match &model.model {
        Model::Sectors(_, options) if is_lost && cea.method == CeaMethod::Auto => {
            let frictions = cea.solved_friction_coefficients();
            Model::with_solver(case, Solver::WholeMesh, *options, &frictions).map(Some)
        }
        _ => Ok(None),
    }
}

/// A parameter of a body solved harmonic by harmonic: its short name, its value in a case (0 where the case has none), and the
/// derivative of a branch by it.
struct Parameter {
    name: &'static str,
    value: fn(&Case) -> f64,
    derivative: fn(&Sensitivity) -> Option<c64>,
}

const fn parameter(
    name: &'static str,
    value: fn(&Case) -> f64,
    derivative: fn(&Sensitivity) -> Option<c64>,
) -> Parameter {
    Parameter { name, value, derivative }
}

/// The friction coefficient, whose value is that of the branch, comes first.
const PARAMETERS: [Parameter; 17] = [
    parameter("friction_coefficient", |_| f64::NAN, |s| Some(s.friction)),
    parameter("normal_stiffness", normal_stiffness, |s| s.normal_stiffness),
    parameter(
        "mass_coefficient",
        |c| c.damping.rayleigh.mass_coefficient,
        |s| Some(s.mass_coefficient),
    ),
    parameter(
        "stiffness_coefficient",
        |c| c.damping.rayleigh.stiffness_coefficient,
        |s| Some(s.stiffness_coefficient),
    ),
    parameter("young_modulus", |c| c.material.young_modulus, |s| s.young_modulus),
    parameter("poisson_ratio", |c| c.material.poisson_ratio, |s| s.poisson_ratio),
    parameter("density", |c| c.material.density, |s| Some(s.density)),
    parameter(
        "static_friction_ratio",
        |c| c.contact.sliding.decay.map_or(1.0, |law| law.static_ratio),
        |s| s.static_friction_ratio,
    ),
    parameter(
        "decay_speed",
        |c| c.contact.sliding.decay.map_or(0.0, |law| law.decay_speed),
        |s| s.decay_speed,
    ),
    parameter("shaft_young_modulus", |c| shaft(c).elastic.young_modulus, |s| s.shaft[0]),
    parameter("shaft_poisson_ratio", |c| shaft(c).elastic.poisson_ratio, |s| s.shaft[1]),
    parameter("shaft_density", |c| shaft(c).elastic.density, |s| s.shaft[2]),
    parameter("shaft_mass_coefficient", |c| shaft_damping(c).mass_coefficient, |s| s.shaft[3]),
    parameter(
        "shaft_stiffness_coefficient",
        |c| shaft_damping(c).stiffness_coefficient,
        |s| s.shaft[4],
    ),
    parameter("cubic_stiffness", |c| of_law(c)[0], |s| s.normal_law[0]),
    parameter("reference_pressure", |c| of_law(c)[1], |s| s.normal_law[1]),
    parameter("height", |c| of_law(c)[2], |s| s.normal_law[2]),
];

/// Of those, the columns that every table has.
const ALWAYS: usize = 7;

fn normal_stiffness(case: &Case) -> f64 {
    case.contact.stiffness.normal_stiffness.unwrap_or(0.0)
}

/// The shaft of a case; asked for where a branch has derivatives by it.
fn shaft(case: &Case) -> RegionMaterial {
    let shaft = case.body.annulus().and_then(|annulus| annulus.materials.shaft);
    shaft.expect("a branch with derivatives by a shaft has one")
}

fn shaft_damping(case: &Case) -> RayleighDamping {
    shaft(case).damping.unwrap_or_default()
}

/// Cubic stiffness, reference pressure and height of contact that stiffens.
fn of_law(case: &Case) -> [f64; 3] {
    match case.contact.stiffness.law {
        Some(NormalLaw::Cubic { cubic_stiffness, .. }) => [cubic_stiffness, 0.0, 0.0],
        Some(NormalLaw::Exponential { reference_pressure, height }) => {
            [0.0, reference_pressure, height]
        }
        None => [0.0; 3],
    }
}

/// Sensitivities with the values that the case gives its parameters: of falling friction, a shaft and contact that stiffens where
/// the case has them.
fn sensitivity_report(case: &Case, branches: &[Sensitivity]) -> SensitivityReport {
    let of_some = |own: &Parameter| branches.iter().any(|b| (own.derivative)(b).is_some());
    let all = PARAMETERS.iter().enumerate();
    let used: Vec<&Parameter> =
        all.filter(|(i, own)| *i < ALWAYS || of_some(own)).map(|(_, own)| own).collect();
    let rows = branches.iter().map(|branch| SensitivityRow {
        friction_coefficient: branch.friction_coefficient,
        harmonic: Some(branch.harmonic),
        branch: branch.branch,
        direction: Some(branch.direction),
        eigenvalue: branch.eigenvalue,
        derivatives: used.iter().map(|own| (own.derivative)(branch)).collect(),
        onset: None,
    });
    SensitivityReport {
        parameters: used.iter().map(|own| own.name.to_owned()).collect(),
        values: used.iter().map(|own| (own.value)(case)).collect(),
        rows: rows.collect(),
        has_onsets: false,
    }
}
