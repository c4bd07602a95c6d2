//! `frictionsim transient`: the disc from first expansion to limit cycle.

mod continuation;
mod watch;

use super::prelude::*;
use crate::results::transient::{
    CHECKPOINT, Checkpoint, LinearStage, RecordedRun, SolvedTransient, document, draw_run, write,
    write_checkpoint,
};
use crate::results::{read_record, write_page};
use crate::study;
use crate::study::transient::TransientStudy;
use crate::transient::{CentralDifference, Recorder, RunEnd};
use crate::{fem::operator::StiffnessOperator, linalg::interruption};
use watch::Watch;

/// How the vibration grows and saturates, step by step in time
///
/// Ctrl-C keeps the results so far; --resume continues to the same bytes. Needs a section `[transient]`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    /// Continue from the checkpoint in the output folder, or start from the beginning
    #[arg(long, conflicts_with = "force")]
    resume: bool,
}

/// The run and its record where a checkpoint left them.
fn resume<'b>(
    study: &'b TransientStudy<'_>,
    operator: &'b dyn StiffnessOperator,
    saved: Checkpoint,
    folder: &Path,
) -> Result<(CentralDifference<'b>, Recorder), Failure> {
    let (body, settings) = (study.body(), &study.transient.settings);
    let run = study.told(CentralDifference::resume(body, operator, settings, &saved.state))?;
    let plan = run.plan();
    if run.steps_done() > plan.total_steps() {
        let reached = (run.steps_done() - 1) as f64 * plan.time_step;
        return Err(Failure::usage(format!(
            "the run in {} has come to {reached:.6} s, beyond transient.duration = {:?} s: raise that, or start \
             over without --resume",
            folder.display(),
            settings.duration,
        )));
    }
    let record = saved.record.map_or_else(|| read_record(folder), Ok)?;
    let record = study.told(record.resume(&run, &study.case.output.recorder))?;
    Ok((run, record))
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let session = Session::start("transient", &asked.options)?;
    let study = TransientStudy::new(&session.case, session.simd)?;
    session.check_memory(session.case.memory("transient").0)?;
    let operator = study.operator()?;
    // Whatever is wrong with the case is said before the folder is touched.
    let fresh = study.start(operator.as_ref())?;
    let recorder = study.told(Recorder::new(&fresh, &study.case.output.recorder))?;
    let saved = if asked.resume { continuation::find(&session)? } else { None };
    let goes_on = saved.is_some();
    let (mut loop_, record) = match saved {
        None => (fresh, recorder),
        Some(saved) => resume(&study, operator.as_ref(), saved, &continuation::place(&session))?,
    };
    let folder = match asked.resume {
        true => continuation::reopen(&session, goes_on)?,
        // A checkpoint of an earlier run must not outlive the results it belongs to.
        false => {
            let folder = session.open_folder(false)?;
            folder.discard(CHECKPOINT)?;
            folder
        }
    };
    let solved = step(&session, &study, &folder, (&mut loop_, operator.name()), record)?;

    let report = study.report(&solved, session.wall_seconds());
    // The last checkpoint goes with the record of the folder; while that is replaced, one with a record of its own
    // holds the place of the last.
    let (case_hash, state) = (continuation::run_hash(&session), loop_.state());
    if goes_on {
        write_checkpoint(&folder, &case_hash, &state, Some(&solved.record))?;
    }
    let (summary, object) = write(&folder, &report)?;
    write_checkpoint(&folder, &case_hash, &state, None)?;
    if !solved.is_finished {
        return Err(stopped(folder, &loop_));
    }
    let (output, title) = (&asked.options.output, &study.case.title);
    if let Some(options) = output.drawing() {
        let (material, stage) = (study.case.materials(), linear_stage(study.case));
        let run = RecordedRun { material, stage, ..report.clone() };
        let document = document(&run, &summary).titled(title);
        write_page(&folder, document, draw_run(&run), &options)?;
    }
    let document = document(&report, &summary);
    output.finish(folder, &document.titled(title).to_text(), &object)
}

/// The modes that the figures mark; where there are none to be had, the log says why.
pub fn linear_stage(case: &Case) -> LinearStage {
    study::linear_stage(case).unwrap_or_else(|error| {
        tracing::warn!("figures without modes of the eigenvalue analysis: {error}");
        LinearStage::default()
    })
}

/// Steps to the end, with checkpoints on the way.
fn step(
    session: &Session,
    study: &TransientStudy<'_>,
    folder: &OutputFolder,
    (run, operator): (&mut CentralDifference<'_>, &'static str),
    record: Recorder,
) -> Result<SolvedTransient, Failure> {
    let first_step = run.steps_done();
    let is_over = record.has_stopped;
    let mut watch = Watch::new(session, folder, run.plan(), record);
    watch::catch_signals();
    let clock = Instant::now();
    let end = match is_over {
        true => Ok(RunEnd::Finished),
        // On a thread of the pool: a step hands parts of itself to the others.
        false => rayon::scope(|_| run.run(&mut watch)),
    };
    let stepping_s = clock.elapsed().as_secs_f64();
    let record = watch.finish()?;
    let end = study.told(end)?;
    // What there is is written in peace.
    interruption::acknowledge();
    Ok(SolvedTransient {
        is_finished: end == RunEnd::Finished || record.has_stopped,
        analysis: study.analyse(&record),
        record,
        plan: *run.plan(),
        operator,
        steps: run.steps_done(),
        steps_timed: run.steps_done() - first_step,
        stepping_s,
    })
}

/// Ends a run that a signal stopped: what there is stays, and the message says how to go on.
fn stopped(folder: OutputFolder, run: &CentralDifference<'_>) -> Failure {
    let path = match folder.suspend() {
        Ok(path) => path,
        Err(error) => return error.into(),
    };
    let time = run.plan().sample_time((run.steps_done() - 1) / run.plan().steps_per_sample);
    Failure::Interrupted(format!(
        "stopped at t = {time:.6} s of {:.6} s; results so far are in {}; the same command with --resume goes on \
         from there",
        run.plan().end_time(),
        path.display(),
    ))
}
