//! The parameters that a case asks to be fitted, and what a reader of their values must know.

use super::free_part::{STEP, free_part, rates};
use super::{FitError, FitProblem, MeasuredMode, ModelMode, fit};
use crate::eigenvalues::{Solver, analysis, rates_of_waves};
use crate::*;
use crate::{eigenvalues, mac::MeasuredShapes};
use frictionsim_case::Fit;
use frictionsim_physics::cea::ModeBranch;
use frictionsim_physics::cea::cyclic::{WavePair, wave_pairs};
use frictionsim_results::fit::{FitSummary, LineSummary, ModeSummary};
use frictionsim_results::plural;

/// Modes are computed up to this much above the highest line.
const MARGIN: f64 = 1.15;

/// Fits the parameters of a case to measured modes, with measured shapes of some of the lines. The name of the
/// measurement is left open.
///
/// # Errors
/// A case without `[fit]`; a fit that cannot be made; shapes that belong to no line, points off the body.
pub fn fit_case(
    case: &Case,
    lines: &[MeasuredMode],
    shapes: Option<&MeasuredShapes>,
) -> Result<FitSummary, StudyError> {
    let wanted = case.require_fit()?;
    if let Some(cea) = &case.cea {
        // What every point would be refused for.
        Solver::of(case, cea.method)?;
    }
    let shape_of = match shapes {
        Some(shapes) => shapes.of_lines(case, lines)?,
        None => vec![None; lines.len()],
    };
    let limit_hz = MARGIN * lines.iter().map(|line| line.frequency_hz).fold(0.0, f64::max);
    let model = |values: &[f64], with_rates: bool| {
        modes(case, (wanted, shapes), values, limit_hz, with_rates)
    };
    let own = wanted.parameters.iter().map(|parameter| case.number(&parameter.parameter.key));
    let problem = FitProblem { model: &model, wanted, lines, shape_of, own: own.collect() };
    let mut found = fit(&problem)?;

    // The case as it is written need not have a solution.
    let before = eigenvalues::modes_below(case, limit_hz).unwrap_or_default();
    let told = |mode: &ComplexMode| ModelMode::of(mode, case.body.has_sectors()).told;
    found.modes_of_case = before.iter().map(told).collect();
    let values = wanted
        .parameters
        .iter()
        .filter_map(|own| Some((&own.parameter, found.parameters.get(&own.parameter.key)?.value)));
    let fitted = case.with_parameters(values); // Friction may be one of them.
    let fitted = fitted.as_ref().unwrap_or(case);
    found.friction_coefficient = fitted.contact.sliding.friction_coefficient;
    found.notes = notes(case, wanted, &found);
    Ok(found)
}

/// Lines of a table of modes beyond which it is hardly one: assigning them grows with the cube of their number.
const MOST_LINES: usize = 1000;

/// Frequencies that a measured mode has, Hz.
const FREQUENCIES_HZ: [f64; 2] = [1e-3, 1e9];

/// Refuses fewer measured numbers than there are parameters, more lines than modes that anybody measures, and
/// frequencies that are none.
///
/// # Errors
/// [`StudyError::Case`] for a case without `[fit]`, and at `fit.parameters`; [`StudyError::Fit`] for such a table.
pub fn refuse_too_few(case: &Case, lines: &[MeasuredMode]) -> Result<(), StudyError> {
    let wanted = case.require_fit()?;
    if lines.len() > MOST_LINES {
        let lines = lines.len();
        return Err(FitError::Table(format!(
            "the table has {lines} lines, at most {MOST_LINES} modes can be fitted: give the modes \
             alone, not a frequency response"
        ))
        .into());
    }
    let [least, most] = FREQUENCIES_HZ;
    let is_outside = |line: &&MeasuredMode| !(least..=most).contains(&line.frequency_hz);
    if let Some(line) = lines.iter().find(is_outside) {
        return Err(FitError::Table(format!(
            "line {} of the table: {:e} Hz is no frequency of a mode, which lies between {least:e} and {most:e} Hz",
            line.line, line.frequency_hz
        ))
        .into());
    }
    let data = lines.iter().map(|line| 1 + usize::from(line.real_hz.is_some())).sum();
    let parameters = wanted.parameters.len();
    if data >= parameters {
        return Ok(());
    }
    let message = FitError::too_few_data(parameters, data).to_string();
    let label = format!("{data} numbers are measured");
    Err(case.error_at("fit.parameters", message, label, None).into())
}

/// The modes of the case with its parameters at some values, with their derivatives by each parameter and their
/// likeness to the measured shapes.
fn modes(
    case: &Case,
    (wanted, shapes): (&Fit, Option<&MeasuredShapes>),
    values: &[f64],
    limit_hz: f64,
    with_rates: bool,
) -> Result<Vec<ModelMode>, String> {
    let parameters = wanted.parameters.iter().map(|parameter| &parameter.parameter);
    let parameters = parameters.zip(values.iter().copied());
    let case = case.with_parameters(parameters.clone())?;
    let is_free = with_rates && free_part(&case).is_some();
    let own = [case.contact.sliding.friction_coefficient];
    let shapes_at = &own[..usize::from(is_free || shapes.is_some())];
    let solved = eigenvalues::modes_with_waves_below(&case, limit_hz, shapes_at);
    let (modes, waves) = solved.map_err(|error| match error {
        StudyError::Eigenvalues(CeaError::NoModes { lowest_hz, .. }) => format!(
            "the lowest mode of the model is at {lowest_hz:.1} Hz, above all lines of the table. Check the unit of the \
             frequencies, the case, and the bounds of fit.parameters"
        ),
        other => other.line(),
    })?;
    let assurances = match shapes {
        Some(shapes) => shapes.assurances(&case, &modes).map_err(|error| error.line())?,
        None => vec![Vec::new(); modes.len()],
    };
    let cea = analysis(&case, &own, limit_hz);
    let by_parameter = match waves {
        _ if is_free => rates(&case, cea.mass, &modes, parameters),
        Some(waves) if with_rates => wave_rates((&case, &cea), &modes, &waves, (wanted, values)),
        _ => vec![vec![None; modes.len()]; wanted.parameters.len()],
    };
    let of = |(i, (mode, assurances)): (usize, (&ComplexMode, Vec<f64>))| ModelMode {
        rates: by_parameter.iter().map(|rates| rates[i]).collect(),
        assurances,
        ..ModelMode::of(mode, case.body.has_sectors())
    };
    Ok(modes.iter().zip(assurances).enumerate().map(of).collect())
}

/// Derivatives of modes of a body solved harmonic by harmonic by each parameter, with the keys that follow it; `None`
/// where there is none.
fn wave_rates(
    (case, cea): (&Case, &Cea),
    modes: &[ComplexMode],
    waves: &WaveSweep,
    (wanted, values): (&Fit, &[f64]),
) -> Vec<Vec<Option<c64>>> {
    let friction = case.contact.sliding.friction_coefficient;
    let branch_of = |mode: &ComplexMode| {
        let is_it = |b: &&ModeBranch| {
            (b.harmonic, b.branch, b.direction) == (mode.harmonic, mode.branch, mode.direction)
        };
        waves.branches.iter().find(is_it)
    };
    let branches: Vec<_> = modes.iter().map(branch_of).collect();
    let all: Vec<_> = branches.iter().flatten().map(|branch| (*branch, friction)).collect();
    let mut found = wave_pairs(&waves.tangent, &all).into_iter();
    let pairs: Vec<Option<WavePair>> =
        branches.iter().map(|branch| branch.and_then(|_| found.next()?)).collect();
    let by_parameter = wanted.parameters.iter().zip(values).map(|(parameter, &value)| {
        // From zero the range says what is little.
        let scale = if value == 0.0 { parameter.to - parameter.from } else { value.abs() };
        let moved = |offset: f64| case.with_parameters([(&parameter.parameter, value + offset)]);
        let own = (&pairs[..], &waves.tangent.contact.is_pressed[..]);
        let rates = rates_of_waves((case, cea), own, (STEP * scale, false), &moved);
        rates.unwrap_or_else(|_| vec![None; pairs.len()])
    });
    by_parameter.collect()
}

/// Share of its frequency within which an unmeasured mode is said to lie beside a line.
const BESIDE: f64 = 0.05;

/// What a reader of the numbers must know.
pub fn notes(case: &Case, wanted: &Fit, found: &FitSummary) -> Vec<String> {
    let mut notes = Vec::new();
    let keys = wanted.parameters.iter().map(|own| &own.parameter.key);
    let estimates = keys.filter_map(|key| Some((key, found.parameters.get(key)?)));
    for (key, estimate) in estimates {
        let [from, to] = estimate.bounds;
        if estimate.at_bound.is_some() {
            notes.push(format!(
                "{key} is at its bound {:e}: the data favour a value outside; widen the bounds if that is plausible",
                estimate.value
            ));
        }
        let interval = estimate.low.zip(estimate.high);
        if interval.is_some_and(|(low, high)| low <= from && high >= to) {
            notes.push(format!(
                "the data do not determine {key}: its 95 % interval holds all values between its bounds"
            ));
        }
    }
    if !found.other_minima.is_empty() {
        notes.push(format!(
            "{} the data as well, at other values of the parameters: see other_minima",
            plural(found.other_minima.len(), ["other minimum fits", "other minima fit"])
        ));
    }
    let has_harmonic = |line: &LineSummary| line.harmonic.is_some();
    if !case.body.has_sectors() && found.residuals.iter().any(has_harmonic) {
        notes.push("modes of an imported body have no harmonic: the column is not used".to_owned());
    }
    if found.residuals.iter().any(|line| line.unstable) {
        let eigenvalue = |mode: &ModeSummary| (mode.real_hz, mode.frequency_hz);
        let is_heard = |mode: &ModeSummary| {
            found.residuals.iter().any(|line| eigenvalue(&line.mode) == eigenvalue(mode))
        };
        let unheard = found.modes.iter().filter(|mode| mode.is_unstable() && !is_heard(mode));
        notes.extend(unheard.map(|mode| {
            let is_beside = |line: &&LineSummary| {
                (mode.frequency_hz - line.frequency_hz).abs() <= BESIDE * line.frequency_hz
            };
            let beside = found.residuals.iter().find(is_beside).map_or(String::new(), |line| {
                format!(", beside the line at {:.0} Hz", line.frequency_hz)
            });
            let (name, frequency, growth) = (mode.name(), mode.frequency_hz, mode.real_hz);
            format!("unstable but not measured: {name} at {frequency:.0} Hz, growth {growth:+.1} Hz{beside}")
        }));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The range of the modes comes from the table: no key of the case raises it.
    #[test]
    fn lines_below_all_modes_are_not_answered_by_a_key_that_does_nothing() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/fit-table-1.toml");
        let sets = [
            "mesh.circumferential_elements=36",
            "mesh.radial_elements=7",
            "fit.starts=2",
            "cea={ method = \"sparse\", modes = 8, friction_coefficients = [0.0] }",
        ];
        let case =
            Case::parse("disc", &std::fs::read(path).unwrap(), &sets.map(str::to_owned)).unwrap();
        let line = |k: u8| MeasuredMode {
            line: usize::from(k) + 1,
            frequency_hz: 100.0 * f64::from(k),
            real_hz: None,
            harmonic: None,
            sigma_hz: None,
            is_unstable: false,
        };
        let error = fit_case(&case, &[2, 3, 4].map(line), None).unwrap_err().to_string();
        assert!(error.contains("unit of the frequencies") && !error.contains("cea."), "{error}");
    }
}
