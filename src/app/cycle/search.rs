//! The search for the limit cycles of a case.

use super::confirmation::confirm;
use crate::app::{Failure, terminal};
use crate::case::{Case, Cycle, OnsetChoice, StabilityChoice};
use crate::cycle::{
    CycleBranch, CycleError, CycleSolver, Family, LimitCycle, OperatingPoint, Parameter,
    StabilityChange,
};
use crate::fem::operator::SimdLevel;
use crate::mesh::AnnulusMesh;
use crate::results::Manifest;
use crate::results::cycle::{CycleReport, CycleResult, summary};
use crate::results::cycle_confirmation::Confirmation;
use crate::results::cycle_fields::CycleFrame;
use crate::results::cycle_figures::FamilyRecord;
use crate::results::cycle_stability::{Verdict, known};
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::time::Instant;

/// Highest harmonic that is looked at where the case names none.
const HIGHEST_HARMONIC: usize = 8;

/// What a case asks for: cycles of which harmonics, where, and followed over what.
pub struct Search<'a> {
    case: &'a Case,
    /// What the case says of its cycles.
    pub choices: &'a Cycle,
    annulus: AnnulusMesh,
    simd: SimdLevel,
    point: OperatingPoint,
    continuation: Option<(Parameter, Vec<f64>)>,
    solvers: Vec<CycleSolver>,
    /// Counts the families done.
    bar: ProgressBar,
}

impl<'a> Search<'a> {
    /// What a case asks for.
    ///
    /// # Errors
    /// A bad case; steady sliding that is stable against every harmonic, where the case names none.
    pub fn of(case: &'a Case, manifest: &Manifest) -> Result<Self, Failure> {
        let choices = case.require_cycle()?;
        let point = OperatingPoint {
            contact: case.contact.sliding,
            damping: case.damping.rayleigh,
        };
        Ok(Self {
            case,
            choices,
            annulus: AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?,
            simd: SimdLevel::choose(&manifest.simd).map_err(Failure::usage)?,
            point,
            continuation: continuation(case, choices)?,
            solvers: solvers(case, choices, &point)?,
            bar: ProgressBar::hidden(),
        })
    }

    /// Shows a bar over the families while they are sought.
    pub fn show_progress(&mut self, quiet: bool) {
        self.bar = terminal::progress(quiet, self.solvers.len() as u64, "families");
    }

    /// The cycles, with the whole field at so many times over one period.
    pub fn run(&self, frames: usize) -> Vec<CycleResult> {
        let solvers = self.solvers.par_iter();
        let solve = |solver| {
            let result = self.solve(solver, frames);
            self.bar.inc(1);
            result
        };
        let results = solvers.map(solve).collect();
        self.bar.finish_and_clear();
        results
    }

    /// Everything that there is to report of the results.
    pub fn report(&self, results: Vec<CycleResult>, wall_s: f64) -> CycleReport<'_> {
        CycleReport {
            title: &self.case.title,
            mesh: &self.annulus.mesh,
            inner_radius: self.case.annulus.inner_radius,
            thickness: self.case.thickness,
            results,
            wall_s,
        }
    }

    /// The summary with the branches' `curves`.
    pub fn summary(&self, results: Vec<CycleResult>, manifest: &Manifest, start: Instant) -> Value {
        let curves: Vec<FamilyRecord> = results.iter().map(FamilyRecord::of).collect();
        let report = self.report(results, start.elapsed().as_secs_f64());
        let mut summary = summary(&report, manifest);
        summary["curves"] = json!(curves);
        summary
    }

    /// A transient that starts on a cycle, if the case asks for one.
    fn confirm(
        &self,
        solver: &CycleSolver,
        cycle: &LimitCycle,
    ) -> Option<Result<Confirmation, String>> {
        let periods = self.choices.confirmation_periods;
        let found = || confirm(self.case, &self.annulus, solver, cycle, periods, self.simd);
        (periods > 0).then(|| found().map_err(|error| error.to_string()))
    }

    fn solve(&self, solver: &CycleSolver, frame_count: usize) -> CycleResult {
        let (point, stability) = (&self.point, self.choices.stability);
        let start = Instant::now();
        let found = solver.find(point);
        let branch = match (&found, &self.continuation) {
            (Ok(cycle), Some((parameter, values))) => {
                Some(solver.follow(cycle, *parameter, values))
            }
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
            family: solver.family(),
            phases: solver.grid().points,
            confirmation: found
                .as_ref()
                .ok()
                .and_then(|cycle| self.confirm(solver, cycle)),
            stability: own,
            stability_changes: branch.as_ref().map_or(Vec::new(), |branch| {
                changes(solver, branch, &branch_stability)
            }),
            branch_stability,
            onsets: solver.onsets(&point.damping),
            frames: found
                .as_ref()
                .map_or(Vec::new(), |cycle| frames(solver, cycle, frame_count)),
            cycle: found.map_err(|error: CycleError| error.to_string()),
            branch,
            wall_s: start.elapsed().as_secs_f64(),
        }
    }
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

/// One solver for each family asked for; where no harmonic is named, for all that are unstable at the case's friction.
fn solvers(
    case: &Case,
    cycle: &Cycle,
    point: &OperatingPoint,
) -> Result<Vec<CycleSolver>, Failure> {
    let friction = point.contact.friction_coefficient;
    let damping = &point.damping;
    let of = |family| {
        CycleSolver::of_family(&case.annulus, &case.material, damping, family, cycle.phases)
            .map_err(Failure::usage)
    };
    let highest = HIGHEST_HARMONIC.min(case.annulus.circumferential_elements / 2);
    let harmonics = match &cycle.harmonics {
        Some(harmonics) => harmonics.clone(),
        None => (1..=highest).collect(),
    };
    let mut solvers = Vec::new();
    for harmonic in harmonics {
        let lowest = of(Family::lowest(harmonic))?;
        let onsets = lowest.onsets(damping);
        let unstable = onsets
            .iter()
            .filter(|onset| onset.friction_coefficient < friction);
        let mut count = unstable.count();
        if cycle.onsets == OnsetChoice::Lowest {
            count = count.min(1);
        }
        // A harmonic that is named is sought even where steady sliding is stable.
        if count > 0 || cycle.harmonics.is_some() {
            solvers.push(lowest);
        }
        for onset in 2..=count {
            solvers.push(of(Family { harmonic, onset })?);
        }
    }
    if solvers.is_empty() {
        return Err(Failure::run(format!(
            "steady sliding is stable against waves of 1 to {highest} nodal diameters at \
             contact.friction_coefficient = {friction}: there is no limit cycle to find; raise it, or name \
             cycle.harmonics"
        )));
    }
    Ok(solvers)
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
