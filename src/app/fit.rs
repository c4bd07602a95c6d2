//! `frictionsim fit`: parameters of a case from measured modes.

mod summary;

use super::options::{input_name, read_input};
use super::{Failure, RunOptions, Session, terminal};
use crate::case::{Case, Fit, ModelParameter};
use crate::cea::cyclic::Sensitivity;
use crate::linalg::c64;
use crate::results::fit::{FitSummary, draw_report, write};
use crate::results::{DrawingOptions, OutputFolder, read_summary};
use crate::signal::reader::{MeasuredMode, read_modes};
use crate::study::eigenvalues;
use crate::study::fit::{BoundedParameter, FitError, FitProblem, Fitted, ModelMode, fit};
use clap::{Args, ValueHint};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Parameters of a case from measured modes or squeal frequencies
///
/// Fits the keys of fit.parameters, each between its bounds, to a table of frequencies, real parts or damping factors;
/// says how sure each value is, which mode is which line, and what the data cannot tell. Needs a fit section in the case.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    /// Measured modes: frequency_hz and, where known, real_hz or damping_factor, harmonic, sigma_hz, unstable (1: heard)
    #[arg(value_name = "MODES.csv", value_hint = ValueHint::FilePath)]
    modes: PathBuf,
}

/// Modes are computed up to this much above the highest line.
const MARGIN: f64 = 1.15;

/// Runs the subcommand.
///
/// # Errors
/// A bad case or table (exit code 2); a fit that cannot be made (1); an output folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut session = Session::start("fit", &arguments.options)?;
    let wanted = session.case.require_fit()?.clone();
    let bytes = read_input(&arguments.modes)?;
    let lines = read_modes(&bytes, &input_name(&arguments.modes))?;
    session.manifest.case_hash = joint_hash(&session.manifest.case_hash, &bytes);
    session.check_memory(session.case.cost().mesh_memory_bytes)?;
    refuse_too_few(&session.case, &wanted, &lines)?;
    let folder = session.open_folder()?;
    terminal::catch_signals(terminal::NOTHING_KEPT);

    let case = &session.case;
    let fitted = fit_case(case, &lines)?;
    let limit_hz = limit_hz(&lines);
    // The case as it is written need not have a solution.
    let before = eigenvalues::modes_below(case, limit_hz, false)
        .map_or_else(|_| Vec::new(), |found| found.0);
    let mut found = summary::summarize(case, &wanted, &fitted, &before);
    found.measurement = input_name(&arguments.modes);
    found.wall_s = session.wall_seconds();
    found.manifest = folder.manifest().clone();
    for note in &found.notes {
        tracing::warn!("{note}");
    }
    let object = write(&folder, &found)?;
    if !session.options.output.no_figures {
        draw_report(&folder, &found, &session.options.output.figures.drawing())?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&found.text(), &object, &path)
}

/// Modes are computed up to this frequency.
fn limit_hz(lines: &[MeasuredMode]) -> f64 {
    MARGIN
        * lines
            .iter()
            .map(|line| line.frequency_hz)
            .fold(0.0, f64::max)
}

/// Fits the parameters of a case to measured modes.
///
/// # Errors
/// A case without `[fit]`; a fit that cannot be made.
pub fn fit_case(case: &Case, lines: &[MeasuredMode]) -> Result<Fitted, Failure> {
    let wanted = case.require_fit()?;
    let limit_hz = limit_hz(lines);
    let model =
        |values: &[f64], with_rates: bool| modes(case, wanted, values, limit_hz, with_rates);
    let parameters: Vec<BoundedParameter> = wanted.parameters.iter().map(bounded).collect();
    let problem = FitProblem {
        model: &model,
        parameters: &parameters,
        lines,
        starts: wanted.starts,
        own: own_values(case, wanted),
    };
    fit(&problem).map_err(Failure::run)
}

/// Draws the figure and the report of a folder from its summary.
///
/// # Errors
/// A folder without a whole summary; those of the folder.
pub fn redraw(folder: &OutputFolder, options: &DrawingOptions) -> Result<(), Failure> {
    let summary: FitSummary = read_summary(folder.path())?;
    Ok(draw_report(folder, &summary, options)?)
}

/// One hash for case and table: results belong to both.
fn joint_hash(case_hash: &str, table: &[u8]) -> String {
    let mut hash = Sha256::new();
    hash.update(case_hash.as_bytes());
    hash.update(table);
    hash.finalize()
        .iter()
        .fold(String::new(), |mut text, byte| {
            let _ = write!(text, "{byte:02x}");
            text
        })
}

fn refuse_too_few(case: &Case, wanted: &Fit, lines: &[MeasuredMode]) -> Result<(), Failure> {
    let data = lines
        .iter()
        .map(|line| 1 + usize::from(line.real_hz.is_some()))
        .sum();
    let parameters = wanted.parameters.len();
    if data >= parameters {
        return Ok(());
    }
    let message = FitError::TooFewData { parameters, data }.to_string();
    let label = format!("{data} numbers are measured");
    Err(case.error_at("fit.parameters", message, label, None).into())
}

fn bounded(parameter: &crate::case::FitParameter) -> BoundedParameter {
    BoundedParameter {
        name: parameter.parameter.key.clone(),
        from: parameter.from,
        to: parameter.to,
        is_logarithmic: parameter.scale == crate::case::Spacing::Logarithmic,
    }
}

/// The values that the case itself gives the parameters, where it gives them all.
fn own_values(case: &Case, wanted: &Fit) -> Option<Vec<f64>> {
    let own = wanted
        .parameters
        .iter()
        .map(|parameter| case.number(&parameter.parameter.key));
    own.collect()
}

/// The modes of the case with its parameters at some values.
fn modes(
    case: &Case,
    wanted: &Fit,
    values: &[f64],
    limit_hz: f64,
    with_rates: bool,
) -> Result<Vec<ModelMode>, String> {
    let parameters = wanted
        .parameters
        .iter()
        .map(|parameter| &parameter.parameter);
    let case = case.with_parameters(parameters.clone().zip(values.iter().copied()))?;
    let solved = eigenvalues::modes_below(&case, limit_hz, with_rates);
    let (modes, sensitivities) = solved.map_err(|failure| failure.messages().join("; "))?;
    let has_harmonics = case.is_annulus();
    let of = |mode: &crate::cea::ComplexMode| {
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
        }
    };
    Ok(modes.iter().map(of).collect())
}

/// Derivative of an eigenvalue by a parameter, with the keys that follow it; `None` where it is not known.
fn rate(sensitivity: &Sensitivity, parameter: &ModelParameter) -> Option<c64> {
    let of = |key: &String| match key.as_str() {
        "contact.friction_coefficient" => Some(sensitivity.friction),
        "contact.normal_stiffness" => sensitivity.normal_stiffness,
        "damping.mass_coefficient" => Some(sensitivity.mass_coefficient),
        "damping.stiffness_coefficient" => Some(sensitivity.stiffness_coefficient),
        "material.young_modulus" => Some(sensitivity.young_modulus),
        "material.poisson_ratio" => Some(sensitivity.poisson_ratio),
        "material.density" => Some(sensitivity.density),
        _ => None,
    };
    let keys = std::iter::once(&parameter.key).chain(&parameter.also);
    keys.map(of).sum()
}
