//! One progress bar over a sweep, with the points in flight.

use crate::app::terminal::progress_in;
use crate::results::sweep::{PointRecord, swept_text};
use indicatif::ProgressBar;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::sync::Mutex;

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

    /// A point that was finished already, or that another process runs.
    pub fn skip(&self) {
        self.bar.inc(1);
    }

    /// A point starts.
    pub fn begin(&self, point: usize, swept: &Map<String, Value>) {
        self.change(|in_flight| {
            in_flight.insert(point, swept_text(swept));
        });
    }

    /// A point is done.
    pub fn end(&self, record: &PointRecord, wall_s: f64) {
        self.change(|in_flight| {
            in_flight.remove(&record.point);
        });
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
        let mut in_flight = match self.in_flight.lock() {
            Ok(in_flight) => in_flight,
            Err(poisoned) => poisoned.into_inner(),
        };
        edit(&mut in_flight);
        let texts: Vec<String> =
            in_flight.iter().map(|(point, swept)| format!("{point}: {swept}")).collect();
        self.bar.set_message(texts.join("  |  "));
    }
}
