//! Checks of a case without running it, through the code paths of the run.

use super::eigenvalues::Solver;
use super::{SweepPlan, eigenvalues, improve};
use super::{response::FrequencyStudy, transient::TransientStudy};
use crate::*;
use frictionsim_case::{Cost, Diagnostic, Location};

/// Nodes up to which matrices are set up to find out.
const MOST_NODES: u128 = 200_000;

/// Unknowns up to which a whole mesh is factorized to find out: in about a second.
const MOST_SOLVED: u128 = 20_000;

/// What is known of a case before it runs.
#[derive(Debug)]
pub struct Preflight {
    /// Cost of each analysis, with the time step of the run where it is cheaply had.
    pub cost: Cost,
    /// Whether time step and number of steps are the run's own.
    pub is_step_exact: bool,
    /// Memory of the hungriest command, bytes.
    pub memory_bytes: f64,
    /// Keys that an analysis of the case ignores.
    pub warnings: Vec<Diagnostic>,
}

/// Finds out whether the commands that a case is for can run on a machine with so much memory, bytes.
pub fn preflight(case: &Case, available: f64) -> Result<Preflight, StudyError> {
    let mut found = Preflight {
        cost: case.cost(),
        is_step_exact: false,
        memory_bytes: 0.0,
        warnings: Vec::new(),
    };
    let commands = commands(case);
    for command in &commands {
        let (bytes, _) = case.memory(command);
        refuse_memory(case, command, bytes, available)?;
        found.memory_bytes = found.memory_bytes.max(bytes);
        for warning in case.ignored_by(command) {
            if !found.warnings.contains(&warning) {
                found.warnings.push(warning);
            }
        }
    }
    if commands.contains(&"cycle") {
        case.require_cycle()?;
    }
    if commands.contains(&"sweep") {
        SweepPlan::new(case)?;
    }
    let is_small = found.cost.nodes <= MOST_NODES;
    let is_solved = found.cost.dofs <= MOST_SOLVED;
    if let Some(specification) = case.body.revolution()
        && is_small
    {
        SolidSector::generate(specification)?;
    }
    if case.raw.root.contains_key("improve") {
        improve::refuse_bodies(case)?;
    }
    if is_small && commands.contains(&"transient") {
        let plan = TransientStudy::new(case, SimdLevel::detect());
        let plan = found.tolerate("transient", plan.and_then(|study| study.preflight()))?;
        if let (Some(run), Some(plan)) = (&mut found.cost.transient, plan) {
            let steps = plan.total_steps();
            run.run.operations *= steps as f64 / run.steps as f64;
            run.time_step = plan.time_step;
            run.steps = steps;
            found.is_step_exact = true;
        }
    }
    if let Some(cea) = &case.cea
        && is_small
    {
        Solver::of_analysis(case, cea)?;
        // Harmonics are solved at once, and all methods find the same modes.
        if case.body.has_sectors() || is_solved {
            let auto = Cea { method: CeaMethod::Auto, ..cea.clone() };
            found.tolerate("cea", eigenvalues::preflight(case, &auto))?;
        }
    }
    if case.frf.is_some() && (is_solved || is_small && case.body.has_sectors()) {
        let tried = FrequencyStudy::new(case).map(|_| ());
        found.tolerate("frf", tried)?;
    }
    Ok(found)
}

impl Preflight {
    /// A run that would fail although its case is good is no error of the case: it is said.
    fn tolerate<T>(
        &mut self,
        command: &str,
        outcome: Result<T, StudyError>,
    ) -> Result<Option<T>, StudyError> {
        match outcome {
            Ok(value) => Ok(Some(value)),
            Err(error) if error.is_usage() => Err(error),
            Err(error) => {
                let message = format!("{command} would fail: {error}");
                let at = Location::default();
                self.warnings.push(Diagnostic::error(message, String::new(), at, None));
                Ok(None)
            }
        }
    }
}

/// Commands that a case has sections for, and whose elements can run.
fn commands(case: &Case) -> Vec<&'static str> {
    let is_linear = case.body.suits_transient();
    let has = [
        ("mesh", true),
        ("cea", case.cea.is_some()),
        ("transient", case.transient.is_some() && is_linear),
        ("cycle", case.cycle.is_some() && is_linear),
        ("basin", case.basin.is_some() && is_linear),
        ("frf", case.frf.is_some()),
        ("convergence", case.convergence.is_some()),
        ("sweep", case.sweep.is_some()),
    ];
    has.into_iter().filter(|pair| pair.1).map(|pair| pair.0).collect()
}

/// Refuses a command that takes more bytes than are available.
///
/// # Errors
/// Those of the case, at the key that asks for most of it.
pub fn refuse_memory(case: &Case, command: &str, bytes: f64, free: f64) -> Result<(), CaseErrors> {
    if bytes > free { Err(case.memory_error(command, bytes, free)) } else { Ok(()) }
}
