//! Runs the points of a sweep on worker threads, and tells how far it is.

use crate::app::embedded;
use crate::app::prelude::*;
use crate::app::terminal::progress_in;
use crate::results::sweep::{Found, PointClock, PointRecord, SweepFolder, swept_text};
use crate::study::{SweepPlan, one_line};
use indicatif::ProgressBar;
use serde_json::Map;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Runs the analyses of one point and gives the summary of each by its name.
pub type PointRunner<'a> = dyn Fn(&Case) -> Result<Map<String, Value>, Failure> + Sync + 'a;

/// What an interrupted sweep leaves.
pub const KEPT: &str = "finished points are kept: go on with --resume";

/// Hash of a point's case; its summaries, or its error in words.
pub type PointOutcome = (String, Result<Map<String, Value>, String>);

/// A sweep on its way.
pub struct SweepRun<'a> {
    /// Its points.
    pub plan: &'a SweepPlan<'a>,
    /// Where they go.
    pub folder: &'a SweepFolder,
    /// What is told of them on the way.
    pub progress: &'a SweepProgress,
    /// What makes them.
    pub runner: &'a PointRunner<'a>,
}

impl SweepRun<'_> {
    /// Runs those of `points` that are neither finished nor claimed by another process, and returns how many that were.
    ///
    /// Workers take the next point when they are done with one. Inside a point the threads that
    /// are left over work: one, unless there are fewer points than threads.
    ///
    /// # Errors
    /// A folder that cannot be written; other workers finish the points they have. A point that fails has its record.
    pub fn run(&self, points: &[usize], threads: usize) -> Result<usize, Failure> {
        let workers = threads.clamp(1, points.len().max(1));
        let (next, is_stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = || {
            let mut ran = 0;
            while !is_stopped.load(Ordering::Relaxed) {
                let Some(&point) = points.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
                let is_new = self.run_point(point);
                ran +=
                    usize::from(is_new.inspect_err(|_| is_stopped.store(true, Ordering::Relaxed))?);
            }
            Ok(ran)
        };
        let pools = (0..workers)
            .map(|_| embedded::inherited_pool((threads / workers).max(1)))
            .collect::<Result<Vec<_>, _>>()
            .map_err(Failure::run)?;
        std::thread::scope(|scope| {
            let started = pools.iter().map(|pool| scope.spawn(move || pool.install(work)));
            let started: Vec<_> = started.collect();
            let stopped = |_| Err(Failure::run("a worker of the sweep stopped"));
            started.into_iter().map(|worker| worker.join().unwrap_or_else(stopped)).sum()
        })
    }

    /// Runs one point and tells of it; whether it was this process that ran it.
    fn run_point(&self, point: usize) -> Result<bool, Failure> {
        let swept = self.plan.swept(point);
        let work = || {
            self.progress.begin(point, &swept);
            self.compute(point)
        };
        let kept = keep_piece(self.folder, (point, &swept), work)?;
        match &kept {
            Some((record, clock)) => self.progress.end(record, clock.wall_s),
            None => self.progress.bar.inc(1),
        }
        Ok(kept.is_some())
    }

    /// Hash and summaries of a point, or its error in words.
    fn compute(&self, point: usize) -> Result<PointOutcome, Failure> {
        let case = match self.plan.point_case(point) {
            Ok(case) => case,
            Err(error) => return Ok((String::new(), Err(error))),
        };
        // A point that panics must not take the others with it.
        let outcome = catch_unwind(AssertUnwindSafe(|| (self.runner)(&case)));
        let outcome = match outcome {
            Ok(result) => result.map_err(|failure| one_line(&failure.messages().join("; "))),
            Err(cause) if embedded::is_stopped(cause.as_ref()) => {
                return Err(Failure::Interrupted(format!("interrupted; {KEPT}")));
            }
            Err(cause) => Err(format!("panic: {}", embedded::panic_text(cause.as_ref()))),
        };
        Ok((case.raw.hash(), outcome))
    }
}

/// Does a piece of work and keeps what comes of it and how long that took; `None` where it is finished already or
/// another process has it.
pub fn keep_piece(
    folder: &SweepFolder,
    (point, swept): (usize, &Map<String, Value>),
    work: impl FnOnce() -> Result<PointOutcome, Failure>,
) -> Result<Option<(PointRecord, PointClock)>, Failure> {
    let Some(_claim) = folder.take(point)? else { return Ok(None) };
    let (start, busy) = (Instant::now(), thread_core_seconds());
    let (case_hash, outcome) = work()?;
    let wall_s = start.elapsed().as_secs_f64();
    let core_s = match (busy, thread_core_seconds(), rayon::current_num_threads()) {
        (Some(before), Some(after), 1) => after - before,
        (_, _, threads) => wall_s * threads as f64,
    };
    let error = outcome.as_ref().err().cloned();
    let mut summaries = outcome.unwrap_or_default();
    let clock = PointClock::taken_from(wall_s, core_s, &mut summaries);
    let manifest = folder.output().manifest();
    let record = PointRecord {
        point,
        swept: swept.clone(),
        error,
        summaries,
        case_hash,
        sweep_hash: manifest.case_hash.clone(),
        version: manifest.version.clone(),
        simd: manifest.simd.clone(),
    };
    folder.write_point(&record, &clock)?;
    Ok(Some((record, clock)))
}

/// The finished ones of `count` pieces in their order; the log says which are damaged.
pub fn kept_pieces(folder: &SweepFolder, count: usize) -> Result<Vec<PointRecord>, Failure> {
    let mut records = Vec::new();
    for point in 1..=count {
        match folder.read(point)? {
            Found::Point(record) => records.push(*record),
            Found::Damaged(reason) => {
                let path = folder.point_path(point);
                tracing::warn!(
                    "{} is damaged ({reason}): the point counts as missing; --resume runs it again",
                    path.display()
                );
            }
            Found::Nothing => {}
        }
    }
    Ok(records)
}

/// Time that this thread has been on a core, s, where the system says so.
fn thread_core_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

/// What is told of a sweep while it runs: a bar on a terminal, else a log line for each point.
pub struct SweepProgress {
    bar: ProgressBar,
    in_flight: Mutex<BTreeMap<usize, String>>,
}

impl SweepProgress {
    /// Progress over `points` points; with `quiet` only failures are told.
    pub fn new(quiet: bool, points: usize) -> Self {
        let template = "sweep {track}{count} points  {elapsed_precise}{left}\n{wide_msg}";
        Self { bar: progress_in(quiet, points as u64, template), in_flight: Mutex::default() }
    }

    /// A point starts.
    pub fn begin(&self, point: usize, swept: &Map<String, Value>) {
        self.change(|in_flight| drop(in_flight.insert(point, swept_text(swept))));
    }

    /// A point is done.
    pub fn end(&self, record: &PointRecord, wall_s: f64) {
        self.change(|in_flight| drop(in_flight.remove(&record.point)));
        self.bar.inc(1);
        let (point, swept) = (record.point, swept_text(&record.swept));
        if let Some(error) = &record.error {
            self.bar.suspend(|| tracing::warn!("point {point} failed ({swept}): {error}"));
        } else if self.bar.is_hidden() {
            tracing::info!("point {point} ({swept}): {wall_s:.1} s");
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn change(&self, edit: impl FnOnce(&mut BTreeMap<usize, String>)) {
        // Progress is worth no panic: a poisoned map is shown as it is.
        let mut in_flight = self.in_flight.lock().unwrap_or_else(PoisonError::into_inner);
        edit(&mut in_flight);
        let texts: Vec<String> =
            in_flight.iter().map(|(point, swept)| format!("{point}: {swept}")).collect();
        self.bar.set_message(texts.join("  |  "));
    }
}
