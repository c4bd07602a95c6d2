//! `frictionsim cycle`: limit cycles found directly, and followed over a parameter.

mod along;
mod figures;
mod search;

pub use figures::redraw;
pub use search::{disc_model, mode_limit};

use super::session::{available_memory, gibibytes};
use super::{Failure, RunOptions, Session, terminal};
use crate::case::Case;
use crate::results::Manifest;
use crate::results::cycle::{CycleReport, doubt, print, write};
use clap::Args;
use search::Search;
use serde_json::Value;
use std::time::Instant;

/// Limit cycles without time stepping
///
/// Finds the rotating wave that steady sliding gives way to, for each harmonic asked for, as a steady contact problem
/// along its phase; follows it over a parameter (cycle.continuation); says whether it is stable, and lets a short
/// transient confirm it. Needs a cycle section in the case.
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
    case.require_cycle()?;
    session.check_memory(case.memory("cycle").0)?;
    let mut search = Search::of(case, &session.manifest)?;
    let folder = session.open_folder()?;
    search.show_progress(session.options.output.is_quiet());
    terminal::catch_signals(terminal::NOTHING_KEPT);
    let results = search.run(search.choices.frames);
    let report = search.report(results, session.wall_seconds());
    refuse_nothing(&report)?;
    for result in &report.results {
        if let Some(doubt) = doubt(&report, result) {
            tracing::warn!("{doubt}");
        }
    }
    let summary = write(&folder, &report)?;
    if !session.options.output.no_figures {
        figures::redraw(
            &folder,
            case,
            &summary,
            &session.options.output.figures.drawing(),
        )?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&print(&report), &summary, &path)
}

/// Searches for the limit cycles of a case and gives the summary, without writing files: a point of a sweep. Its `curves`
/// hold the branches, of which the command itself writes tables.
///
/// # Errors
/// As [`run`].
pub fn summarize(case: &Case, manifest: &Manifest) -> Result<Value, Failure> {
    let start = Instant::now();
    let search = Search::of(case, manifest)?;
    let results = search.run(0);
    let report = search.report(results, 0.0);
    refuse_nothing(&report)?;
    search.summary(report.results, manifest, start)
}

/// As [`summarize`], but a search that finds nothing has a summary too, which says why: a level of a convergence study.
///
/// # Errors
/// A bad case.
pub fn attempt(case: &Case, manifest: &Manifest) -> Result<Value, Failure> {
    let start = Instant::now();
    let search = Search::of(case, manifest)?;
    search.summary(search.run(0), manifest, start)
}

/// Refuses phases whose dense matrices do not fit the machine's memory.
fn check_memory(case: &Case) -> Result<(), Failure> {
    let bytes = case.cost().cycle.map_or(0.0, |cycle| cycle.memory_bytes);
    let available = available_memory().unwrap_or(f64::INFINITY);
    if bytes <= available {
        return Ok(());
    }
    Err(Failure::Case(case.error_at(
        "cycle.phases",
        format!(
            "the search for limit cycles needs about {:.1} GiB of memory, {:.1} GiB are available",
            gibibytes(bytes),
            gibibytes(available)
        ),
        "too many phases for this machine".to_owned(),
        Some("lower cycle.phases, or leave it out".to_owned()),
    )))
}

/// That there is no cycle is an answer where steady sliding is stable, else a failure.
fn refuse_nothing(report: &CycleReport<'_>) -> Result<(), Failure> {
    let is_found = report.results.iter().any(|result| result.cycle.is_ok());
    if is_found || report.stable_sliding().is_some() {
        return Ok(());
    }
    let absences = report.results.iter().filter_map(|r| r.cycle.as_ref().err());
    let errors: Vec<&str> = absences.map(|absence| absence.reason.as_str()).collect();
    Err(Failure::run(format!(
        "no limit cycle found: {}",
        errors.join("; ")
    )))
}
