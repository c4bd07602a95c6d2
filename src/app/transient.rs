//! `frictionsim transient`: the disc from first expansion to limit cycle.

mod continuation;
mod conversion;
mod figures;
mod initial;
mod watch;

pub use figures::{draw_beside, redraw};
pub use initial::cycle_fields;

use super::{Failure, RunOptions, Session};
use crate::case::{Case, Transient};
use crate::cycle::Family;
use crate::fem::operator::{SimdLevel, StiffnessOperator};
use crate::mesh::{AnnulusMesh, Mesh2d, SolidSector};
use crate::results::transient::{
    CHECKPOINT, Checkpoint, TransientReport, print, summary, write, write_checkpoint,
};
use crate::results::{Manifest, OutputFolder, object, read_record};
use crate::transient::{
    CentralDifference, InitialState, Recorder, RecorderSettings, RunEnd, StepPlan,
    TransientAnalysis, TransientBody, TransientSettings,
};
use clap::Args;
use serde_json::Value;
use std::sync::Arc;
use std::time::Instant;
use watch::{Checkpoints, Watch};

/// Explicit contact transient
///
/// Ctrl-C and SIGTERM stop the run cleanly: what was computed is written, and --resume goes on from there to the
/// same bytes as a run that was never stopped.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    /// Go on from the checkpoint in the output folder; without one, start from the beginning
    #[arg(long, conflicts_with = "force")]
    resume: bool,
}

/// A case made ready for the time loop.
struct Prepared<'a> {
    case: &'a Case,
    transient: &'a Transient,
    annulus: Option<AnnulusMesh>,
    mesh: Arc<Mesh2d>,
    /// One sector of a body in three dimensions, of which `mesh` is the section across the axis.
    sector: Option<SolidSector>,
    simd: SimdLevel,
    settings: TransientSettings,
}

impl<'a> Prepared<'a> {
    fn new(case: &'a Case, simd: &str) -> Result<Self, Failure> {
        let transient = case.require_transient()?;
        let generate = || AnnulusMesh::generate(&case.annulus).map_err(Failure::usage);
        let is_plane = case.is_annulus() && case.solid.is_none();
        let annulus = is_plane.then(generate).transpose()?;
        let sector = case.solid.as_ref().map(SolidSector::generate);
        let sector = sector.transpose().map_err(Failure::usage)?;
        let mesh = match (&sector, &annulus, &case.body) {
            (Some(sector), ..) => Arc::new(sector.section().map_err(Failure::usage)?),
            (_, None, Some(body)) => Arc::clone(&body.mesh),
            _ => case.mesh().map_err(Failure::usage)?,
        };
        Ok(Self {
            case,
            transient,
            annulus,
            mesh,
            sector,
            simd: SimdLevel::choose(simd).map_err(Failure::usage)?,
            settings: conversion::settings(case, transient),
        })
    }

    fn body(&self) -> TransientBody<'_> {
        let sector = self.sector.as_ref();
        conversion::body(self.case, &self.mesh, self.annulus.as_ref(), sector)
    }

    fn operator(&self) -> Result<Box<dyn StiffnessOperator>, Failure> {
        let choice = self.transient.operator;
        let operator = self.body().operator(choice, self.simd);
        operator.map_err(|error| self.failure(&error))
    }

    /// The run from its initial state.
    fn start<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
    ) -> Result<CentralDifference<'b>, Failure> {
        let started = match self.settings.initial {
            InitialState::LimitCycle { harmonic, onset } => {
                let family = Family { harmonic, onset };
                let plan = StepPlan::of(self.body(), operator, &self.settings)
                    .map_err(|error| self.failure(&error))?;
                let [u, v] = initial::limit_cycle(self.case, family, plan.time_step)?;
                CentralDifference::start_from(self.body(), operator, &self.settings, &u, v)
            }
            _ => CentralDifference::start(self.body(), operator, &self.settings),
        };
        started.map_err(|error| self.failure(&error))
    }

    /// The run and its record where a checkpoint left them.
    fn resume<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
        saved: Checkpoint,
        folder: &OutputFolder,
    ) -> Result<(CentralDifference<'b>, Recorder), Failure> {
        let run = CentralDifference::resume(self.body(), operator, &self.settings, &saved.state)
            .map_err(|error| self.failure(&error))?;
        let plan = run.plan();
        if run.steps_done() > plan.total_steps() {
            let reached = (run.steps_done() - 1) as f64 * plan.time_step;
            return Err(Failure::usage(format!(
                "the run in {} has come to {reached:.6} s, beyond transient.duration = {:?} s: raise that, or start \
                 over without --resume",
                folder.path().display(),
                self.settings.duration,
            )));
        }
        let record = match saved.record {
            Some(record) => record,
            None => read_record(folder.path())?,
        };
        let record = record.resume(&run, &self.recorder_settings());
        Ok((run, record.map_err(|error| self.failure(&error))?))
    }

    fn recorder_settings(&self) -> RecorderSettings {
        conversion::recorder_settings(self.case, self.transient)
    }

    /// Reads a record.
    fn analyse(&self, record: &Recorder) -> TransientAnalysis {
        let perturbation = &self.settings.perturbation;
        // Noise seeds every harmonic.
        let seeded = match perturbation.noise {
            0.0 => perturbation.harmonics(),
            _ => record.significant_harmonics(),
        };
        TransientAnalysis::of(record, &seeded)
    }

    fn failure(&self, error: &crate::transient::TransientError) -> Failure {
        conversion::failure(self.case, error)
    }

    fn report<'b>(
        &'b self,
        run: &CentralDifference<'_>,
        record: &'b Recorder,
        analysis: &'b TransientAnalysis,
        operator: &'b str,
    ) -> TransientReport<'b> {
        TransientReport {
            title: &self.case.title,
            mesh: &self.mesh,
            solid: self.sector.as_ref(),
            material: self.case.materials(),
            thickness: self.thickness(),
            friction_coefficient: self.case.contact.sliding.friction_coefficient,
            initial: conversion::initial_name(self.transient),
            perturbation: &self.settings.perturbation,
            places: self
                .case
                .output
                .placed_probes
                .iter()
                .map(|p| (p.node, p.asked))
                .collect(),
            operator,
            plan: *run.plan(),
            record,
            analysis,
            steps: run.steps_done(),
            steps_timed: run.steps_done(),
            stepping_s: 0.0,
            wall_s: 0.0,
            is_finished: true,
        }
    }
}

/// Runs the subcommand.
///
/// # Errors
/// A bad case or folder; a run that is stopped or becomes unstable; a folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("transient", &arguments.options)?;
    let prepared = Prepared::new(&session.case, &session.manifest.simd)?;
    let cost = session.case.cost();
    let record_bytes = cost.transient.map_or(0.0, |cost| cost.memory_bytes);
    session.check_memory(cost.mesh_memory_bytes + record_bytes)?;
    let operator = prepared.operator()?;
    // Whatever is wrong with the case is said before the folder is touched.
    let fresh = prepared.start(operator.as_ref())?;
    let recorder = Recorder::new(&fresh, &prepared.recorder_settings())
        .map_err(|error| prepared.failure(&error))?;
    let folder = open(&session, arguments.resume)?;
    let saved = match arguments.resume {
        true => continuation::find(&session, &folder)?,
        false => None,
    };
    let goes_on = saved.is_some();
    let (mut loop_, record) = match saved {
        None => (fresh, recorder),
        Some(saved) => prepared.resume(operator.as_ref(), saved, &folder)?,
    };
    let stepped = step(&session, &prepared, &folder, &mut loop_, record)?;

    let analysis = prepared.analyse(&stepped.record);
    let report = TransientReport {
        steps_timed: stepped.steps,
        stepping_s: stepped.stepping_s,
        wall_s: session.wall_seconds(),
        is_finished: stepped.is_finished,
        ..prepared.report(&loop_, &stepped.record, &analysis, operator.name())
    };
    // The last checkpoint goes with the record of the folder; while that is replaced, one with a record of its own
    // holds the place of the last.
    let (case_hash, state) = (continuation::run_hash(&session), loop_.state());
    if goes_on {
        write_checkpoint(&folder, &case_hash, &state, Some(&stepped.record))?;
    }
    let summary = write(&folder, &report)?;
    write_checkpoint(&folder, &case_hash, &state, None)?;
    if !stepped.is_finished {
        return Err(stopped(folder, &loop_));
    }
    let output = &arguments.options.output;
    if !output.no_figures {
        let drawing = output.figures.drawing();
        figures::draw_record(&folder, &prepared, &stepped.record, &summary, &drawing)?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    let table = print(&summary, analysis.settling.state);
    let object = object(&summary).map_err(Failure::run)?;
    session.print(&table, &object, &path)
}

/// What came of the time loop.
struct Stepped {
    record: Recorder,
    /// Whether the run reached its end, or where it settles.
    is_finished: bool,
    /// Steps done by this process.
    steps: u64,
    /// Their wall time, s.
    stepping_s: f64,
}

/// Steps to the end, with checkpoints on the way.
fn step(
    session: &Session,
    prepared: &Prepared<'_>,
    folder: &OutputFolder,
    run: &mut CentralDifference<'_>,
    record: Recorder,
) -> Result<Stepped, Failure> {
    let first_step = run.steps_done();
    let case_hash = continuation::run_hash(session);
    let checkpoints = Checkpoints {
        folder,
        case_hash: &case_hash,
        interval_s: session.case.output.checkpoint_interval,
    };
    let is_over = record.has_stopped;
    let is_quiet = session.options.output.is_quiet();
    let mut watch = Watch::new(record, run.plan(), is_quiet, Some(checkpoints));
    watch::catch_signals();
    let clock = Instant::now();
    let end = match is_over {
        true => Ok(RunEnd::Finished),
        // On a thread of the pool: a step hands parts of itself to the others.
        false => rayon::scope(|_| run.run(&mut watch)),
    };
    let stepping_s = clock.elapsed().as_secs_f64();
    let record = watch.finish()?;
    let end = end.map_err(|error| prepared.failure(&error))?;
    Ok(Stepped {
        is_finished: end == RunEnd::Finished || record.has_stopped,
        record,
        steps: run.steps_done() - first_step,
        stepping_s,
    })
}

/// Runs a case without writing a file, and gives its summary.
///
/// # Errors
/// A bad case; a run that becomes unstable.
pub fn summarize(case: &Case, manifest: &Manifest) -> Result<Value, Failure> {
    let start = Instant::now();
    let prepared = Prepared::new(case, &manifest.simd)?;
    let operator = prepared.operator()?;
    let mut loop_ = prepared.start(operator.as_ref())?;
    // What would only go to files is not kept.
    let settings = RecorderSettings {
        stop_when_settled: prepared.transient.stop_when_settled,
        ..RecorderSettings::default()
    };
    let mut record = Recorder::new(&loop_, &settings).map_err(|error| prepared.failure(&error))?;
    let clock = Instant::now();
    rayon::scope(|_| loop_.run(&mut record)).map_err(|error| prepared.failure(&error))?;
    let stepping_s = clock.elapsed().as_secs_f64();
    let analysis = prepared.analyse(&record);
    let report = TransientReport {
        stepping_s,
        wall_s: start.elapsed().as_secs_f64(),
        ..prepared.report(&loop_, &record, &analysis, operator.name())
    };
    object(&summary(&report, manifest)).map_err(Failure::run)
}

/// The time step that a case's run takes, s.
///
/// # Errors
/// A bad case.
pub fn time_step(case: &Case, manifest: &Manifest) -> Result<f64, Failure> {
    let prepared = Prepared::new(case, &manifest.simd)?;
    let operator = prepared.operator()?;
    let plan = StepPlan::of(prepared.body(), operator.as_ref(), &prepared.settings);
    Ok(plan.map_err(|error| prepared.failure(&error))?.time_step)
}

/// Sets a run up to its first step: finds out whether it can start, and gives its time step.
///
/// # Errors
/// A bad case; a base state that does not exist.
pub fn preflight(case: &Case, simd: &str) -> Result<StepPlan, Failure> {
    let prepared = Prepared::new(case, simd)?;
    let operator = prepared.operator()?;
    let refuse = |error| prepared.failure(&error);
    if matches!(prepared.settings.initial, InitialState::LimitCycle { .. }) {
        // The cycle itself would have to be found.
        let damping = &case.damping.rayleigh;
        return StepPlan::new(operator.as_ref(), damping, &prepared.settings).map_err(refuse);
    }
    let fresh = prepared.start(operator.as_ref())?;
    Recorder::new(&fresh, &prepared.recorder_settings()).map_err(refuse)?;
    Ok(*fresh.plan())
}

fn open(session: &Session, resume: bool) -> Result<OutputFolder, Failure> {
    if resume {
        return continuation::reopen(session);
    }
    let folder = session.open_folder()?;
    // A checkpoint of an earlier run must not outlive the results it belongs to.
    folder.discard(CHECKPOINT);
    Ok(folder)
}

/// Ends a run that a signal stopped: what there is stays, and the message says how to go on.
fn stopped(folder: OutputFolder, run: &CentralDifference<'_>) -> Failure {
    let path = folder.path().to_owned();
    if let Err(error) = folder.finish() {
        return error.into();
    }
    let time = run
        .plan()
        .sample_time((run.steps_done() - 1) / run.plan().steps_per_sample);
    Failure::Interrupted(format!(
        "stopped at t = {time:.6} s of {:.6} s; results so far are in {}; the same command with --resume goes on \
         from there",
        run.plan().end_time(),
        path.display(),
    ))
}
