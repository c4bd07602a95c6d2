//! The search for the limit cycles of a case.

use super::along::{along, changes};
use crate::app::{Failure, terminal};
use crate::case::{Case, Cycle, ModeSelection, OnsetChoice, StabilityChoice};
use crate::cea::ModeLimit;
use crate::cycle::{
    CycleError, CycleSolver, CycleStability, DiscModel, Family, LimitCycle, MODES, MeshStepping,
    Onset, OperatingPoint, Parameter,
};
use crate::fem::operator::SimdLevel;
use crate::mesh::AnnulusMesh;
use crate::results::cycle::{
    Absence, CycleFrame, CycleReport, CycleResult, CycleSummary, known, summary,
};
use crate::results::cycle_figures::FamilyRecord;
use crate::results::{Manifest, object};
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde_json::Value;
use std::time::Instant;

/// The solver of a family, or why it has none.
type Sought = Result<CycleSolver, (Family, CycleError)>;

/// What a case asks for: cycles of which harmonics, where, and followed over what.
pub struct Search<'a> {
    case: &'a Case,
    /// What the case says of its cycles.
    pub choices: &'a Cycle,
    annulus: AnnulusMesh,
    simd: SimdLevel,
    point: OperatingPoint,
    continuation: Option<(Parameter, Vec<f64>)>,
    /// Every onset below the case's friction coefficient; where there is none, those of the harmonics sought.
    onsets: Vec<Onset>,
    solvers: Vec<Sought>,
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
        super::check_memory(case)?;
        let point = OperatingPoint {
            contact: case.contact.sliding,
            damping: case.damping.rayleigh,
        };
        let friction = point.contact.friction_coefficient;
        let mut onsets = disc_model(case)
            .onsets(friction, mode_limit(case))
            .map_err(Failure::run)?;
        let solvers = solvers(case, choices, &onsets)?;
        if onsets.is_empty() {
            onsets = solvers.iter().flatten().map(|s| *s.onset()).collect();
            onsets.extend(next_onset(case, friction));
            onsets.sort_by(|a, b| a.friction_coefficient.total_cmp(&b.friction_coefficient));
        }
        Ok(Self {
            case,
            choices,
            annulus: AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?,
            simd: SimdLevel::choose(&manifest.simd).map_err(Failure::usage)?,
            point,
            continuation: continuation(case, choices)?,
            solvers,
            onsets,
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
        let solve = |solver: &Sought| {
            let result = match solver {
                Ok(solver) => self.solve(solver, frames),
                Err((family, error)) => self.absent(*family, error),
            };
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
            friction_coefficient: self.point.contact.friction_coefficient,
            lowest_onset: self.onsets.first().copied(),
            results,
            wall_s,
        }
    }

    /// The summary with the branches' `curves`.
    pub fn summary(
        &self,
        results: Vec<CycleResult>,
        manifest: &Manifest,
        start: Instant,
    ) -> Result<Value, Failure> {
        let curves: Vec<FamilyRecord> = results.iter().map(FamilyRecord::of).collect();
        let report = self.report(results, start.elapsed().as_secs_f64());
        let summary = CycleSummary {
            curves: Some(serde_json::to_value(curves).map_err(Failure::run)?),
            ..summary(&report, manifest)
        };
        object(&summary).map_err(Failure::run)
    }

    fn onsets_of(&self, harmonic: usize) -> Vec<Onset> {
        let own = self.onsets.iter().filter(|o| o.harmonic == harmonic);
        own.copied().collect()
    }

    /// Why a family whose onset is known has no cycle.
    fn absence(&self, solver: &CycleSolver, error: &CycleError) -> Absence {
        let (friction, onset) = (
            self.point.contact.friction_coefficient,
            solver.onset().friction_coefficient,
        );
        let is_stable = friction < onset;
        Absence {
            reason: match is_stable {
                true => {
                    format!("{friction} < {onset:.4}: steady sliding is stable against this wave")
                }
                false => error.to_string(),
            },
            is_stable,
        }
    }

    /// The result of a family that cannot be sought at all.
    fn absent(&self, family: Family, error: &CycleError) -> CycleResult {
        CycleResult {
            family,
            onsets: self.onsets_of(family.harmonic),
            cycle: Err(Absence {
                reason: error.to_string(),
                is_stable: matches!(error, CycleError::NoOnset { .. }),
            }),
            frames: Vec::new(),
            phases: 0,
            confirmation: None,
            stability: None,
            branch_stability: Vec::new(),
            stability_changes: Vec::new(),
            branch: None,
            wall_s: 0.0,
        }
    }

    /// The cycle of a family with everything asked for: branch, stability, confirmation, fields.
    fn solve(&self, solver: &CycleSolver, frame_count: usize) -> CycleResult {
        let start = Instant::now();
        let stability = self.choices.stability;
        let found = solver.find(&self.point);
        let mut branch = match (&found, &self.continuation) {
            (Ok(cycle), Some((parameter, values))) => {
                Some(solver.follow(cycle, *parameter, values))
            }
            _ => None,
        };
        let frames = found
            .as_ref()
            .map_or(Vec::new(), |cycle| frames(solver, cycle, frame_count));
        let mut result = CycleResult {
            family: solver.family(),
            phases: solver.grid().points,
            onsets: self.onsets_of(solver.family().harmonic),
            cycle: found.map_err(|error| self.absence(solver, &error)),
            frames,
            confirmation: None,
            stability: None,
            branch_stability: Vec::new(),
            stability_changes: Vec::new(),
            branch: None,
            wall_s: 0.0,
        };
        // What the mesh's own time stepping makes of it.
        if let Ok(cycle) = &mut result.cycle {
            match solver.stepping(self.simd) {
                Ok(stepping) => {
                    if stability != StabilityChoice::None {
                        result.stability = Some(settle(&stepping, cycle));
                    }
                    let periods = self.choices.confirmation_periods;
                    let known = known(&result.stability);
                    result.confirmation = (periods > 0).then(|| {
                        stepping
                            .confirm(cycle, known, periods)
                            .map_err(|e| e.to_string())
                    });
                    if let (Some(branch), StabilityChoice::Branch) = (&mut branch, stability) {
                        let settled = along(&stepping, &mut branch.cycles);
                        result.stability_changes = changes(&stepping, branch.parameter, &settled);
                        result.branch_stability = settled
                            .into_iter()
                            .map(|settled| Some(settled.map(|settled| settled.stability)))
                            .collect();
                    }
                }
                Err(error) => result.confirmation = Some(Err(error.to_string())),
            }
        }
        result.branch = branch;
        result.wall_s = start.elapsed().as_secs_f64();
        result
    }
}

/// Stability of a cycle; its powers and fractions become those of the transient.
fn settle(stepping: &MeshStepping<'_>, cycle: &mut LimitCycle) -> Result<CycleStability, String> {
    let settled = stepping.settle(cycle, None).map_err(|e| e.to_string())?;
    *cycle = settled.cycle;
    Ok(settled.stability)
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

/// The first onset above a friction coefficient, for the sentence that steady sliding is stable there.
fn next_onset(case: &Case, friction: f64) -> Option<Onset> {
    let mut highest = 2.0 * friction;
    while highest <= 2.0 {
        let found = disc_model(case).onsets(highest, mode_limit(case)).ok()?;
        if let Some(first) = found.into_iter().next() {
            return Some(first);
        }
        highest *= 2.0;
    }
    None
}

/// The disc of a case as its limit cycles see it.
pub fn disc_model(case: &Case) -> DiscModel {
    DiscModel {
        specification: case.annulus,
        material: case.material,
        damping: case.damping.rayleigh,
    }
}

/// The modes whose onsets are looked for: those of the case's own eigenvalue analysis, else the lowest.
pub fn mode_limit(case: &Case) -> ModeLimit {
    match case.cea.as_ref().map(|cea| cea.modes) {
        Some(ModeSelection::BelowHz(limit)) => ModeLimit::MaxFrequency(limit),
        Some(ModeSelection::Lowest(count)) => ModeLimit::Lowest(count),
        None => ModeLimit::Lowest(MODES),
    }
}

/// One solver for each family asked for; where no harmonic is named, for every wave that is unstable at the case's
/// friction. A harmonic that is named is sought even where steady sliding is stable: its cycles may outlive their birth.
fn solvers(case: &Case, cycle: &Cycle, onsets: &[Onset]) -> Result<Vec<Sought>, Failure> {
    let (model, limit) = (disc_model(case), mode_limit(case));
    let mut harmonics: Vec<usize> = match &cycle.harmonics {
        Some(harmonics) => harmonics.clone(),
        None => onsets.iter().map(|onset| onset.harmonic).collect(),
    };
    harmonics.sort_unstable();
    harmonics.dedup();
    let mut solvers = Vec::new();
    for harmonic in harmonics {
        let own = onsets.iter().filter(|onset| onset.harmonic == harmonic);
        let mut own: Vec<Onset> = own.copied().collect();
        if own.is_empty() {
            match model.onset_of(Family::lowest(harmonic), limit) {
                Ok(onset) => own.push(onset),
                Err(error) => {
                    solvers.push(Err((Family::lowest(harmonic), error)));
                    continue;
                }
            }
        }
        if cycle.onsets == OnsetChoice::Lowest {
            own.truncate(1);
        }
        for (rank, onset) in own.iter().enumerate() {
            let family = Family {
                harmonic,
                onset: rank + 1,
            };
            match CycleSolver::born_at(&model, family, onset, cycle.phases) {
                Ok(solver) => solvers.push(Ok(solver)),
                Err(error @ CycleError::Undamped { .. }) => solvers.push(Err((family, error))),
                Err(error) => return Err(Failure::usage(error)),
            }
        }
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
