//! The parameters that a case asks to be fitted.

use super::free_part::{free_part, rates, shaped_modes};
use super::{
    BoundedParameter, FitError, FitProblem, Fitted, MeasuredMode, MeasuredShapes, ModelMode, fit,
    summary,
};
use crate::case::{Case, Fit, FitParameter, ModelParameter, Spacing};
use crate::cea::ComplexMode;
use crate::cea::cyclic::Sensitivity;
use crate::linalg::c64;
use crate::results::fit::FitSummary;
use crate::study::eigenvalues::{Solver, analysis};
use crate::study::{StudyError, eigenvalues};

/// Modes are computed up to this much above the highest line.
const MARGIN: f64 = 1.15;

/// Modes are computed up to this frequency.
fn limit_hz(lines: &[MeasuredMode]) -> f64 {
    MARGIN * lines.iter().map(|line| line.frequency_hz).fold(0.0, f64::max)
}

/// Fits the parameters of a case to measured modes.
///
/// # Errors
/// A case without `[fit]`; a fit that cannot be made.
pub fn fit_case(case: &Case, lines: &[MeasuredMode]) -> Result<Fitted, StudyError> {
    fit_case_with_shapes(case, lines, None)
}

/// [`fit_case`] with measured shapes of some of the lines.
///
/// # Errors
/// As [`fit_case`]; shapes that belong to no line, points off the body.
pub fn fit_case_with_shapes(
    case: &Case,
    lines: &[MeasuredMode],
    shapes: Option<MeasuredShapes<'_>>,
) -> Result<Fitted, StudyError> {
    let wanted = case.require_fit()?;
    if let Some(cea) = &case.cea {
        // What every point would be refused for.
        Solver::of(case, cea.method)?;
    }
    let shape_of = match &shapes {
        Some(shapes) => {
            shapes.check(case)?;
            shapes.of_lines(lines)?
        }
        None => vec![None; lines.len()],
    };
    let limit_hz = limit_hz(lines);
    let model = |values: &[f64], with_rates: bool| {
        modes(case, (wanted, shapes), values, limit_hz, with_rates)
    };
    let parameters: Vec<BoundedParameter> = wanted.parameters.iter().map(bounded).collect();
    let problem = FitProblem {
        model: &model,
        parameters: &parameters,
        lines,
        shape_of,
        shape_weight: wanted.shape_weight,
        starts: wanted.starts,
        own: own_values(case, wanted),
    };
    Ok(fit(&problem)?)
}

/// The summary of a fit, without its source, time and manifest.
///
/// # Errors
/// A case without `[fit]`.
pub fn summarize(
    case: &Case,
    lines: &[MeasuredMode],
    fitted: &Fitted,
) -> Result<FitSummary, StudyError> {
    // The case as it is written need not have a solution.
    let before = eigenvalues::modes_below(case, limit_hz(lines), false)
        .map_or_else(|_| Vec::new(), |found| found.0);
    Ok(summary::of(case, case.require_fit()?, fitted, &before))
}

/// Lines of a table of modes beyond which it is hardly one: assigning them to modes grows with the cube of their number.
const MOST_LINES: usize = 1000;

/// Frequencies that a measured mode has, Hz.
const FREQUENCIES_HZ: [f64; 2] = [1e-3, 1e9];

/// Refuses fewer measured numbers than there are parameters, more lines than modes that anybody measures, and frequencies
/// that are none.
///
/// # Errors
/// [`StudyError::Case`] for a case without `[fit]`, and at `fit.parameters`; [`StudyError::Fit`] for such a table.
pub fn refuse_too_few(case: &Case, lines: &[MeasuredMode]) -> Result<(), StudyError> {
    let wanted = case.require_fit()?;
    if lines.len() > MOST_LINES {
        let (lines, most) = (lines.len(), MOST_LINES);
        return Err(FitError::TooManyLines { lines, most }.into());
    }
    let [least, most] = FREQUENCIES_HZ;
    let is_outside = |line: &&MeasuredMode| !(least..=most).contains(&line.frequency_hz);
    if let Some(line) = lines.iter().find(is_outside) {
        return Err(FitError::Frequency {
            line: line.line,
            frequency_hz: line.frequency_hz,
            least,
            most,
        }
        .into());
    }
    let data = lines.iter().map(|line| 1 + usize::from(line.real_hz.is_some())).sum();
    let parameters = wanted.parameters.len();
    if data >= parameters {
        return Ok(());
    }
    let message = FitError::TooFewData { parameters, data }.to_string();
    let label = format!("{data} numbers are measured");
    let errors = case.error_at("fit.parameters", message, label, None);
    Err(errors.into())
}

fn bounded(parameter: &FitParameter) -> BoundedParameter {
    BoundedParameter {
        name: parameter.parameter.key.clone(),
        from: parameter.from,
        to: parameter.to,
        is_logarithmic: parameter.scale == Spacing::Logarithmic,
    }
}

/// The values that the case itself gives the parameters, where it gives them all.
fn own_values(case: &Case, wanted: &Fit) -> Option<Vec<f64>> {
    let own = wanted.parameters.iter().map(|parameter| case.number(&parameter.parameter.key));
    own.collect()
}

/// The modes of the case with its parameters at some values.
fn modes(
    case: &Case,
    (wanted, shapes): (&Fit, Option<MeasuredShapes<'_>>),
    values: &[f64],
    limit_hz: f64,
    with_rates: bool,
) -> Result<Vec<ModelMode>, String> {
    let parameters = wanted.parameters.iter().map(|parameter| &parameter.parameter);
    let case = case.with_parameters(parameters.clone().zip(values.iter().copied()))?;
    if with_rates && free_part(&case).is_some() {
        let values = parameters.zip(values.iter().copied());
        return modes_of_free_part(&case, shapes, values, limit_hz);
    }
    let own = [case.contact.sliding.friction_coefficient];
    let shapes_at = &own[..usize::from(shapes.is_some())];
    let solved = eigenvalues::modes_with_shapes_below(&case, limit_hz, with_rates, shapes_at);
    let (modes, sensitivities) = solved.map_err(said)?;
    let assurances = assurances(&case, shapes, &modes)?;
    let has_harmonics = case.has_sectors();
    let of = |(mode, assurances): (&ComplexMode, Vec<f64>)| {
        let is_it = |s: &&Sensitivity| {
            (s.harmonic, s.branch, s.direction) == (mode.harmonic, mode.branch, mode.direction)
        };
        let own = sensitivities.iter().find(is_it);
        ModelMode {
            eigenvalue: mode.eigenvalue,
            harmonic: has_harmonics.then_some(mode.harmonic),
            branch: mode.branch,
            direction: mode.direction,
            rates: parameters.clone().map(|p| rate(own?, p)).collect(),
            assurances,
        }
    };
    Ok(modes.iter().zip(assurances).map(of).collect())
}

/// Modal assurance of the measured shapes with each mode; nothing without any.
fn assurances(
    case: &Case,
    shapes: Option<MeasuredShapes<'_>>,
    modes: &[ComplexMode],
) -> Result<Vec<Vec<f64>>, String> {
    match shapes {
        Some(shapes) => shapes.assurances(case, modes).map_err(said),
        None => Ok(vec![Vec::new(); modes.len()]),
    }
}

fn said(failure: StudyError) -> String {
    failure.messages().join("; ")
}

/// The modes of a part that nothing holds, damps or touches, with all derivatives.
fn modes_of_free_part<'p>(
    case: &Case,
    shapes: Option<MeasuredShapes<'_>>,
    parameters: impl Iterator<Item = (&'p ModelParameter, f64)>,
    limit_hz: f64,
) -> Result<Vec<ModelMode>, String> {
    let cea = analysis(case, &[case.contact.sliding.friction_coefficient], limit_hz);
    let modes = shaped_modes(case, &cea).map_err(said)?;
    let by_parameter = rates(case, &cea, &modes, parameters);
    let assurances = assurances(case, shapes, &modes)?;
    let of = |(i, (mode, assurances)): (usize, (&ComplexMode, Vec<f64>))| ModelMode {
        eigenvalue: mode.eigenvalue,
        harmonic: None,
        branch: mode.branch,
        direction: mode.direction,
        rates: by_parameter.iter().map(|rates| rates[i]).collect(),
        assurances,
    };
    Ok(modes.iter().zip(assurances).enumerate().map(of).collect())
}

/// Derivative of an eigenvalue by a parameter, with the keys that follow it; `None` where it is not known.
fn rate(sensitivity: &Sensitivity, parameter: &ModelParameter) -> Option<c64> {
    let of = |key: &String| match key.as_str() {
        "contact.friction_coefficient" => Some(sensitivity.friction),
        "contact.normal_stiffness" => sensitivity.normal_stiffness,
        "contact.cubic_stiffness" => sensitivity.normal_law[0],
        "contact.reference_pressure" => sensitivity.normal_law[1],
        "contact.height" => sensitivity.normal_law[2],
        "damping.mass_coefficient" => Some(sensitivity.mass_coefficient),
        "damping.stiffness_coefficient" => Some(sensitivity.stiffness_coefficient),
        "material.young_modulus" => sensitivity.young_modulus,
        "material.poisson_ratio" => sensitivity.poisson_ratio,
        "material.density" => Some(sensitivity.density),
        _ => None,
    };
    let keys = std::iter::once(&parameter.key).chain(&parameter.also);
    keys.map(of).sum()
}
