//! Progress, checkpoints and signals beside the time loop.

use super::continuation::run_hash;
use crate::app::embedded;
use crate::app::prelude::*;
use crate::results::FolderError;
use crate::results::transient::write_checkpoint;
use crate::transient::{Observer, Recorder, Sample, StepPlan};
use indicatif::ProgressBar;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{ops::ControlFlow, time::Duration};

/// Set by Ctrl-C and SIGTERM.
static IS_INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C and SIGTERM stop the run at its next sample; a second one ends the process at once.
pub fn catch_signals() {
    if embedded::current().is_some() {
        // Stopped by whoever started it: see the recorder.
        return;
    }
    // A second run of the same process finds the handler in place.
    let _ = ctrlc::set_handler(|| {
        if IS_INTERRUPTED.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(terminal::INTERRUPTED));
        }
    });
}

/// Records, and looks after the run.
pub struct Watch<'a> {
    record: Recorder,
    session: &'a Session,
    folder: &'a OutputFolder,
    /// Hash that checkpoints of the run are known by.
    case_hash: String,
    bar: ProgressBar,
    end_time: f64,
    last_message: Instant,
    last_checkpoint: Instant,
    failure: Option<FolderError>,
}

impl<'a> Watch<'a> {
    /// For a run of a session, which keeps its checkpoints in a folder.
    pub fn new(
        session: &'a Session,
        folder: &'a OutputFolder,
        plan: &StepPlan,
        record: Recorder,
    ) -> Self {
        let is_quiet = session.options.output.is_quiet();
        let bar = terminal::progress(is_quiet, plan.samples, "transient");
        let now = Instant::now();
        bar.set_position(record.rows.len() as u64);
        bar.reset_eta();
        Self {
            record,
            session,
            folder,
            case_hash: run_hash(session),
            bar,
            end_time: plan.end_time(),
            last_message: now,
            last_checkpoint: now,
            failure: None,
        }
    }

    /// The record, unless a checkpoint could not be written.
    pub fn finish(self) -> Result<Recorder, Failure> {
        self.bar.finish_and_clear();
        self.failure.map_or(Ok(self.record), |error| Err(error.into()))
    }

    fn tell(&mut self, sample: &Sample<'_>) {
        let counts = sample.row.counts;
        let steps = (counts.stick + counts.slip + counts.open).max(1) as f64;
        let nodes = sample.contact().status.len() as f64;
        let [stick, slip, open] = [counts.stick, counts.slip, counts.open]
            .map(|count| (nodes * count as f64 / steps).round());
        let [now, end] = [sample.row.time, self.end_time].map(|time| 1e3 * time);
        self.bar.set_position(sample.index + 1);
        let shares = format!("stick {stick} slip {slip} open {open}");
        self.bar.set_message(format!("{now:.3} of {end:.3} ms, {shares}"));
    }

    fn save(&mut self, sample: &Sample<'_>) -> Result<(), FolderError> {
        let interval_s = self.session.case.output.checkpoint_interval;
        if self.last_checkpoint.elapsed().as_secs_f64() < interval_s {
            return Ok(());
        }
        write_checkpoint(self.folder, &self.case_hash, &sample.state(), Some(&self.record))?;
        self.last_checkpoint = Instant::now();
        Ok(())
    }
}

impl Observer for Watch<'_> {
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()> {
        let settled = self.record.observe(sample);
        if self.last_message.elapsed() > Duration::from_millis(100) {
            self.last_message = Instant::now();
            self.tell(sample);
        }
        if settled.is_break() || IS_INTERRUPTED.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        if let Err(error) = self.save(sample) {
            self.failure = Some(error);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}
