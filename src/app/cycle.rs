//! `frictionsim cycle`: limit cycles found directly, and followed over a parameter.

mod figures;

pub use figures::redraw;

use super::{Failure, RunOptions, Session};
use crate::case::{Case, Cycle, StabilityChoice};
use crate::cycle::{
    CycleBranch, CycleError, CycleSolver, LimitCycle, OperatingPoint, Parameter, StabilityChange,
};
use crate::mesh::AnnulusMesh;
use crate::results::DOTS_PER_INCH;
use crate::results::cycle::{CycleReport, CycleResult, print, write};
use crate::results::cycle_fields::CycleFrame;
use crate::results::cycle_stability::{Verdict, known};
use clap::Args;
use rayon::prelude::*;
use std::time::Instant;

/// Highest harmonic that is looked at where the case names none.
const HIGHEST_HARMONIC: usize = 8;

/// Limit cycles without time stepping
#[derive(Args)]
pub struct Arguments {
    /// The case and how to run it.
    #[command(flatten)]
    pub options: RunOptions,
}

/// Runs the subcommand.
///
/// # Errors
/// A bad case, a search that finds no cycle at all, an output folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("cycle", &arguments.options)?;
    let case = &session.case;
    let cycle = case.require_cycle()?;
    let point = OperatingPoint {
        contact: case.contact.sliding,
        damping: case.damping.rayleigh,
    };
    let continuation = continuation(case, cycle)?;
    let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
    let solvers = solvers(case, cycle, &point)?;
    let folder = session.open_folder()?;

    let results: Vec<CycleResult> = solvers
        .par_iter()
        .map(|solver| solve(solver, &point, continuation.as_ref(), cycle))
        .collect();
    refuse_nothing(&results)?;

    let report = CycleReport {
        title: &case.title,
        mesh: &annulus.mesh,
        inner_radius: case.annulus.inner_radius,
        thickness: case.thickness,
        results,
        wall_s: session.wall_seconds(),
    };
    let summary = write(&folder, &report)?;
    if !session.options.no_figures {
        figures::redraw(&folder, case, &summary, DOTS_PER_INCH)?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&print(&report), &summary, &path)
}

/// The parameter of `[cycle.continuation]` and its SI values.
fn continuation(case: &Case, cycle: &Cycle) -> Result<Option<(Parameter, Vec<f64>)>, Failure> {
    let Some(continuation) = &cycle.continuation else {
        return Ok(None);
    };
    let Some(parameter) = Parameter::from_key(&continuation.key) else {
        let known: Vec<&str> = Parameter::ALL.iter().map(|known| known.key()).collect();
        return Err(Failure::Case(case.error_at(
            "cycle.continuation.key",
            format!("limit cycles cannot be followed over {}", continuation.key),
            "not one of the parameters of a cycle".to_owned(),
            Some(format!("one of {}", known.join(", "))),
        )));
    };
    if continuation.from.min(continuation.to) < 0.0 {
        return Err(Failure::Case(case.error_at(
            "cycle.continuation.from",
            format!("{} cannot be negative along a branch", continuation.key),
            "must not be negative".to_owned(),
            None,
        )));
    }
    let values = continuation.values().into_iter();
    let values = values.map(|value| value * parameter.unit()).collect();
    Ok(Some((parameter, values)))
}

/// One solver for each harmonic asked for; where none is, for those unstable at the case's friction.
fn solvers(
    case: &Case,
    cycle: &Cycle,
    point: &OperatingPoint,
) -> Result<Vec<CycleSolver>, Failure> {
    let new = |harmonic| {
        CycleSolver::new(
            &case.annulus,
            &case.material,
            &case.damping.rayleigh,
            harmonic,
            cycle.phases,
        )
        .map_err(Failure::usage)
    };
    if let Some(harmonics) = &cycle.harmonics {
        return harmonics.iter().map(|&harmonic| new(harmonic)).collect();
    }
    let highest = HIGHEST_HARMONIC.min(case.annulus.circumferential_elements / 2);
    let mut solvers = Vec::new();
    for harmonic in 1..=highest {
        let solver = new(harmonic)?;
        let onsets = solver.onsets(&point.damping);
        let friction = point.contact.friction_coefficient;
        if onsets
            .iter()
            .any(|onset| onset.friction_coefficient < friction)
        {
            solvers.push(solver);
        }
    }
    if solvers.is_empty() {
        return Err(Failure::run(format!(
            "steady sliding is stable against waves of 1 to {highest} nodal diameters at \
             contact.friction_coefficient = {}: there is no limit cycle to find; raise it, or name \
             cycle.harmonics",
            point.contact.friction_coefficient
        )));
    }
    Ok(solvers)
}

fn solve(
    solver: &CycleSolver,
    point: &OperatingPoint,
    continuation: Option<&(Parameter, Vec<f64>)>,
    choices: &Cycle,
) -> CycleResult {
    let stability = choices.stability;
    let start = Instant::now();
    let found = solver.find(point);
    let branch = match (&found, continuation) {
        (Ok(cycle), Some((parameter, values))) => Some(solver.follow(cycle, *parameter, values)),
        _ => None,
    };
    let verdict = |cycle: &LimitCycle| {
        let stability = solver.stability(cycle);
        Some(stability.map_err(|error| error.to_string()))
    };
    let own = match &found {
        Ok(cycle) if stability != StabilityChoice::None => verdict(cycle),
        _ => None,
    };
    let branch_stability = match &branch {
        Some(branch) if stability == StabilityChoice::Branch => along(&branch.cycles, verdict),
        _ => Vec::new(),
    };
    CycleResult {
        harmonic: solver.body().harmonic(),
        phases: solver.grid().points,
        stability: own,
        stability_changes: branch.as_ref().map_or(Vec::new(), |branch| {
            changes(solver, branch, &branch_stability)
        }),
        branch_stability,
        onsets: solver.onsets(&point.damping),
        frames: found
            .as_ref()
            .map_or(Vec::new(), |cycle| frames(solver, cycle, choices.frames)),
        cycle: found.map_err(|error: CycleError| error.to_string()),
        branch,
        wall_s: start.elapsed().as_secs_f64(),
    }
}

/// The whole field at `count` times over one period.
fn frames(solver: &CycleSolver, cycle: &LimitCycle, count: usize) -> Vec<CycleFrame> {
    let period = 1.0 / cycle.frequency_hz();
    (0..count)
        .map(|i| {
            let time = period * i as f64 / count as f64;
            CycleFrame {
                time,
                fields: solver.field(cycle, time),
            }
        })
        .collect()
}

/// A verdict for each cycle of a branch. Where a wave only scales from one cycle to the next, its stability is the same.
fn along(cycles: &[LimitCycle], verdict: impl Fn(&LimitCycle) -> Verdict + Sync) -> Vec<Verdict> {
    let is_scaled = |a: &LimitCycle, b: &LimitCycle| {
        let drift = a.state.frequency / b.state.frequency - 1.0;
        a.state.contact == b.state.contact && drift.abs() < 1e-9
    };
    let groups: Vec<&[LimitCycle]> = cycles.chunk_by(is_scaled).collect();
    let verdicts: Vec<(Verdict, usize)> = groups
        .par_iter()
        .map(|group| (verdict(&group[0]), group.len()))
        .collect();
    verdicts
        .into_iter()
        .flat_map(|(verdict, count)| std::iter::repeat_n(verdict, count))
        .collect()
}

/// Where neighbours along a branch differ in stability.
fn changes(
    solver: &CycleSolver,
    branch: &CycleBranch,
    verdicts: &[Verdict],
) -> Vec<StabilityChange> {
    let known: Vec<(&LimitCycle, bool)> = branch
        .cycles
        .iter()
        .zip(verdicts)
        .filter_map(|(cycle, verdict)| Some((cycle, known(verdict)?.is_stable())))
        .collect();
    let pairs = known.windows(2).filter(|pair| pair[0].1 != pair[1].1);
    let found = pairs.filter_map(|pair| {
        let [(first, is_stable), (second, _)] = [pair[0], pair[1]];
        let (stable, unstable) = if is_stable {
            (first, second)
        } else {
            (second, first)
        };
        solver
            .stability_change(branch.parameter, stable, unstable)
            .ok()
    });
    found.collect()
}

fn refuse_nothing(results: &[CycleResult]) -> Result<(), Failure> {
    if results.iter().any(|result| result.cycle.is_ok()) {
        return Ok(());
    }
    let errors: Vec<String> = results
        .iter()
        .filter_map(|result| result.cycle.as_ref().err().cloned())
        .collect();
    Err(Failure::run(format!(
        "no limit cycle found: {}",
        errors.join("; ")
    )))
}
