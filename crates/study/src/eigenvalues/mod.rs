//! Complex eigenvalues of the steady sliding of a case: its model, and the sweep over friction by
//! the solver it gets. The spectrum alone is for those who study it.
//!
//! ```no_run
//! use frictionsim::case::Case;
//! use frictionsim::study::eigenvalues::modes_and_onsets;
//!
//! let bytes = std::fs::read("cases/polycarbonate-disc.toml")?;
//! let case = Case::parse("disc", &bytes, &["contact.friction_coefficient=0.25".to_owned()])?;
//! let sweep = modes_and_onsets(&case)?;
//! println!("{:?}", sweep.intervals.first());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contact;
mod model;
mod notes;
mod reading;
mod sensitivity;
mod sliding;
mod solve;
mod spectrum;
mod states;
mod whole;

pub use contact::SolidState;
pub use model::{Model, Solver, asked_modes, wave_tangent};
pub use sensitivity::body_sensitivities;
pub(super) use sensitivity::rates::{is_like, rates_of_waves};
pub use sliding::{SlidingModel, dampings};
pub use solve::{Solved, solve, solved};
pub(super) use spectrum::analysis;
pub use spectrum::{
    OnsetSearch, modes_at_own_friction, modes_below, modes_with_waves_below, unstable_intervals,
};
pub(crate) use whole::BasePoint;
pub use whole::WholeMesh;

use crate::*;
use frictionsim_case::Diagnostic;
use frictionsim_physics::linalg::{LuAnalysis, SparseLu};
use frictionsim_physics::{cea::sparse::FrictionlessModes, linalg::banded::BandedFactor};
use frictionsim_results::cea::CeaReport;
pub use frictionsim_results::cea::Solution;
use solve::at_key;

/// Modes at the case's own friction coefficient and the onsets over its sweep; mode shapes only of a body without
/// symmetry, whose modes are recognised by nothing else.
///
/// # Errors
/// Those of the mesh, of steady sliding and of the solver; a frequency limit below the first mode.
pub fn modes_and_onsets(case: &Case) -> Result<FrictionSweep, StudyError> {
    let cea = Cea {
        shapes_at: vec![case.contact.sliding.friction_coefficient],
        ..case.require_cea()?.clone()
    };
    let frictions = cea.solved_friction_coefficients();
    let shapes_at: &[f64] = if case.body.has_sectors() { &[] } else { &cea.shapes_at };
    let request = SweepRequest { shapes_at, ..SweepRequest::new(&frictions, cea.modes) };
    let sweep = Model::new(case, &cea)?.spectrum(case, &request)?.sweep;
    refuse_no_modes(case, &cea, &sweep)?;
    Ok(sweep)
}

/// Motions below a frequency limit up to which they are told apart, for so many may be rigid; unknowns up to which
/// tables are tried.
const MOST_RIGID: usize = 12;
const MOST_TABLED: usize = 3_000;

/// Refuses what a run refuses before it follows branches: no steady sliding, no mode below the limit, modes beyond a
/// table.
///
/// Modes without friction are counted: by one factorization of `K - omega^2 M`, or by one of each harmonic.
pub fn preflight(case: &Case, cea: &Cea) -> Result<(), StudyError> {
    let SlidingModel { model, mesh, .. } = SlidingModel::new(case, cea)?;
    // Tables hold the frequencies of all modes, or not. There may be fewer modes than asked for where these are many.
    let is_many = matches!(cea.modes, ModeLimit::Lowest(count) if 5 * count > mesh.dof_count());
    if (is_many || case.body.tables().next().is_some()) && mesh.dof_count() <= MOST_TABLED {
        let one =
            Cea { friction_coefficients: vec![cea.friction_coefficients[0]], ..cea.of_tables() };
        let solution = solve(case, &one, &SlidingModel::new(case, &one)?, None)?;
        return refuse_no_modes(case, &one, &solution.sweep);
    }
    let ModeLimit::MaxFrequency(limit_hz) = cea.modes else { return Ok(()) };
    let kappa = (TAU * limit_hz).powi(2);
    let has_modes = match &model {
        Model::Whole(whole) => {
            let first = &whole.range.states[whole.range.state_of[0]];
            let tangent = whole.tangent(case, first)?.referred_to(limit_hz);
            let [k, m] = [&tangent.stiffness, &tangent.mass].map(|own| own.evaluate(0.0));
            let shifted: Vec<f64> = k.iter().zip(&m).map(|(k, m)| k - kappa * m).collect();
            let analysis = LuAnalysis::new(tangent.stiffness.pattern()).map_err(CeaError::from)?;
            let counted = SparseLu::symmetric(&analysis, shifted);
            counted.is_ok_and(|f| f.negative_count() > MOST_RIGID) || {
                let found = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(1));
                found.is_ok_and(|own| own.frequencies[0] < TAU * limit_hz)
            }
        }
        Model::Waves(options) => {
            let waves = wave_tangent(case, options)?.expect("a body of sectors");
            let has_modes = |n: usize| {
                let [mass, stiffness] = waves.at_rest(n);
                BandedFactor::new(&stiffness, &mass, kappa).negative_count() > 0
            };
            (0..=waves.largest_harmonic()).any(has_modes)
        }
    };
    if has_modes {
        return Ok(());
    }
    // Friction may bring a mode below the limit. There is little to follow.
    let frictions = cea.solved_friction_coefficients();
    let request = SweepRequest::new(&frictions, cea.modes);
    let found = model.spectrum(case, &request).map_err(|error| at_key(case, &error))?;
    refuse_no_modes(case, cea, &found.sweep)
}

/// A frequency limit below the first mode is an error of the case.
pub fn refuse_no_modes(case: &Case, cea: &Cea, sweep: &FrictionSweep) -> Result<(), StudyError> {
    match cea.modes {
        ModeLimit::MaxFrequency(limit) if sweep.points.iter().all(|own| own.modes.is_empty()) => {
            let message = format!("cea.max_frequency_hz = {limit}: there are no modes below it");
            Err(no_modes(case, message))
        }
        _ => Ok(()),
    }
}

fn no_modes(case: &Case, message: String) -> StudyError {
    let error = Diagnostic::error(
        message,
        "below the first mode",
        case.raw.place("cea.max_frequency_hz"),
        Some("raise it, or ask for the lowest ones with `modes = 10` instead".to_owned()),
    );
    // A slip of units comes first: the missing modes are its consequence.
    let all = [case.warnings.as_slice(), &[error]].concat();
    StudyError::Case(case.raw.errors(all))
}

/// What there is to report of a solution.
pub fn report<'a>(
    case: &'a Case,
    cea: &'a Cea,
    model: &'a SlidingModel,
    solution: &'a Solution,
    wall_s: f64,
) -> CeaReport<'a> {
    CeaReport {
        title: &case.title,
        body: model.body(),
        has_harmonics: case.body.has_sectors(),
        selection: match cea.modes {
            ModeLimit::MaxFrequency(limit) => format!("below {limit} Hz"),
            ModeLimit::Lowest(count) => format!("the {count} lowest"),
        },
        friction_coefficients: &cea.friction_coefficients,
        solution,
        contact_changes: model.contact_changes(),
        base: model.base_state(case),
        wall_s,
    }
}
