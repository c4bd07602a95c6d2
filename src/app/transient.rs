//! `frictionsim transient`: the disc from first expansion to limit cycle.

mod conversion;
mod figures;
mod initial;
mod watch;

pub use figures::redraw;
pub use initial::cycle_fields;

use super::{Failure, RunOptions, Session};
use crate::case::{Case, Transient};
use crate::cycle::Family;
use crate::fem::operator::{SimdLevel, StiffnessOperator};
use crate::mesh::AnnulusMesh;
use crate::results::transient::{
    CHECKPOINT, Checkpoint, CheckpointError, TransientReport, print, read_checkpoint, summary,
    write, write_checkpoint,
};
use crate::results::{Manifest, OutputFolder, refuse_misfit};
use crate::transient::{
    CentralDifference, InitialState, Recorder, RunEnd, StepPlan, TransientAnalysis, TransientModel,
    TransientSettings, build_operator,
};
use clap::Args;
use serde_json::Value;
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
    annulus: AnnulusMesh,
    simd: SimdLevel,
    settings: TransientSettings,
}

impl<'a> Prepared<'a> {
    fn new(case: &'a Case, simd: &str) -> Result<Self, Failure> {
        let transient = case.require_transient()?;
        Ok(Self {
            case,
            transient,
            annulus: AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?,
            simd: SimdLevel::choose(simd).map_err(Failure::usage)?,
            settings: conversion::settings(case, transient),
        })
    }

    fn model(&self) -> TransientModel<'_> {
        conversion::model(self.case, &self.annulus)
    }

    fn operator(&self) -> Result<Box<dyn StiffnessOperator>, Failure> {
        let choice = self.transient.operator;
        build_operator(&self.model(), choice, self.simd).map_err(|error| self.failure(&error))
    }

    /// The run from its initial state.
    fn start<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
    ) -> Result<CentralDifference<'b>, Failure> {
        let started = match self.settings.initial {
            InitialState::LimitCycle { harmonic, onset } => {
                let family = Family { harmonic, onset };
                let damping = &self.case.damping.rayleigh;
                let plan = StepPlan::new(operator, damping, &self.settings)
                    .map_err(|error| self.failure(&error))?;
                let [u, v] = initial::limit_cycle(self.case, family, plan.time_step)?;
                CentralDifference::start_from(self.model(), operator, &self.settings, &u, v)
            }
            _ => CentralDifference::start(self.model(), operator, &self.settings),
        };
        started.map_err(|error| self.failure(&error))
    }

    fn resume<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
        saved: &Checkpoint,
    ) -> Result<CentralDifference<'b>, Failure> {
        CentralDifference::resume(self.model(), operator, &self.settings, &saved.state)
            .map_err(|error| self.failure(&error))
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
            mesh: &self.annulus.mesh,
            material: &self.case.material,
            thickness: self.case.thickness,
            initial: conversion::initial_name(self.transient),
            perturbation: &self.settings.perturbation,
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
    let recorder = Recorder::new(&fresh, &conversion::recorder_settings(&session.case))
        .map_err(|error| prepared.failure(&error))?;
    let folder = open(&session, arguments.resume)?;
    let (mut loop_, record) = match find_checkpoint(&session, &folder, arguments.resume)? {
        None => (fresh, recorder),
        Some(saved) => {
            let mesh = &prepared.annulus.mesh;
            let fits = saved
                .record
                .fits(mesh.node_count(), mesh.inner_edge.nodes.len());
            refuse_misfit(folder.path(), fits)?;
            (prepared.resume(operator.as_ref(), &saved)?, saved.record)
        }
    };

    let first_step = loop_.steps_done();
    let checkpoints = Checkpoints {
        folder: &folder,
        interval_s: session.case.output.checkpoint_interval,
    };
    let mut watch = Watch::new(
        record,
        loop_.plan(),
        arguments.options.output.is_quiet(),
        Some(checkpoints),
    );
    watch::catch_signals();
    let clock = Instant::now();
    let end = loop_.run(&mut watch);
    let stepping_s = clock.elapsed().as_secs_f64();
    let record = watch.finish()?;
    let end = end.map_err(|error| prepared.failure(&error))?;

    let analysis = TransientAnalysis::of(&record, &prepared.settings.perturbation.harmonics());
    let report = TransientReport {
        steps_timed: loop_.steps_done() - first_step,
        stepping_s,
        wall_s: session.wall_seconds(),
        is_finished: end == RunEnd::Finished,
        ..prepared.report(&loop_, &record, &analysis, operator.name())
    };
    let summary = write(&folder, &report)?;
    if end == RunEnd::Stopped {
        write_checkpoint(&folder, &loop_.state(), &record)?;
        return Err(stopped(folder, &loop_));
    }
    if !arguments.options.output.no_figures {
        figures::draw_record(
            &folder,
            &prepared,
            &record,
            &summary,
            &arguments.options.output.figures.drawing(),
        )?;
    }
    folder.discard(CHECKPOINT);
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&print(&report), &summary, &path)
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
    let mut record = Recorder::new(&loop_, &crate::transient::RecorderSettings::default())
        .map_err(|error| prepared.failure(&error))?;
    let clock = Instant::now();
    loop_
        .run(&mut record)
        .map_err(|error| prepared.failure(&error))?;
    let stepping_s = clock.elapsed().as_secs_f64();
    let analysis = TransientAnalysis::of(&record, &prepared.settings.perturbation.harmonics());
    let report = TransientReport {
        stepping_s,
        wall_s: start.elapsed().as_secs_f64(),
        ..prepared.report(&loop_, &record, &analysis, operator.name())
    };
    Ok(summary(&report, manifest))
}

/// The time step that a case's run takes, s.
///
/// # Errors
/// A bad case.
pub fn time_step(case: &Case, manifest: &Manifest) -> Result<f64, Failure> {
    let prepared = Prepared::new(case, &manifest.simd)?;
    let operator = prepared.operator()?;
    let plan = StepPlan::new(
        operator.as_ref(),
        &case.damping.rayleigh,
        &prepared.settings,
    );
    Ok(plan.map_err(|error| prepared.failure(&error))?.time_step)
}

fn open(session: &Session, resume: bool) -> Result<OutputFolder, Failure> {
    if resume {
        return session.reopen_folder();
    }
    let folder = session.open_folder()?;
    // A checkpoint of an earlier run must not outlive the results it belongs to.
    folder.discard(CHECKPOINT);
    Ok(folder)
}

fn find_checkpoint(
    session: &Session,
    folder: &OutputFolder,
    resume: bool,
) -> Result<Option<Checkpoint>, Failure> {
    if !resume {
        return Ok(None);
    }
    match read_checkpoint(folder.path(), &session.manifest) {
        Ok(checkpoint) => Ok(Some(checkpoint)),
        Err(CheckpointError::Missing { path }) => {
            tracing::warn!(
                "{} does not exist: starting from the beginning",
                path.display()
            );
            Ok(None)
        }
        Err(error) => Err(Failure::usage(error)),
    }
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
