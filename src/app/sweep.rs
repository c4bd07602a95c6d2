//! `frictionsim sweep`: an analysis at every point of a parameter study.

mod workers;

pub use crate::study::{Shard, SweepPlan};
pub use workers::{PointRunner, SweepProgress, SweepRun, keep_piece, kept_pieces};

use super::prelude::*;
use super::{session::machine_memory, share::ShareOptions, transient::linear_stage};
use crate::case::{Analysis, Choice};
use crate::results::summary_of;
use crate::results::sweep::{
    FailedPoint, PointRecord, SweepFolder, SweepSummary, document, draw_sweep,
};
use crate::study::{refuse_memory, summarize};
use serde_json::Map;

/// Run any analysis on a grid of parameters
///
/// Every finished point is a file of its own in the output folder. A sweep that is killed continues with --resume, and
/// several processes may work on one folder. Needs a section `[sweep]`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    #[command(flatten)]
    share: ShareOptions,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let session = Session::start("sweep", &asked.options)?;
    let plan = SweepPlan::new(&session.case)?;
    let threads = session.manifest.threads;
    // The analyses of a point run one after the other.
    let cost = plan.point_case(1).as_ref().unwrap_or(&session.case).cost();
    let cea = cost.cea.map_or(0.0, |cea| cea.run.memory_bytes);
    let transient = cost.transient.map_or(0.0, |own| own.run.memory_bytes);
    let of_point = cost.mesh_memory_bytes + cea.max(transient);
    session.check_memory(threads.min(plan.count()) as f64 * of_point)?;
    let points = asked.share.pieces(plan.count());
    let output = &asked.options.output;
    let folder = asked.share.open(&session, plan.count(), &points)?;

    terminal::catch_signals(workers::KEPT);
    let progress = SweepProgress::new(output.is_quiet(), points.len());
    let run = SweepRun {
        plan: &plan,
        folder: &folder,
        progress: &progress,
        runner: &|case| run_point(case, &plan.analyses, &session.manifest),
    };
    let outcome = run.run(&points, threads);
    progress.finish();
    let ran = outcome?;

    let found = SweepSummary { ran: Some(ran), ..finished(&plan, &folder)? };
    let (text, summary) = if found.missing.is_empty() {
        gather(output, &folder, (&session.case, &plan), session.head(), &found)?
    } else {
        let summary = summary_of(&session.manifest, session.head(), &found);
        let document = document(&found, false).titled(&session.case.title);
        (document.to_text(), summary.map_err(Failure::run)?)
    };
    output.print(&text, &summary, folder.output().path())?;
    let of_these = |own: &&FailedPoint| points.binary_search(&own.point).is_ok();
    match found.failed.iter().filter(of_these).count() {
        0 => Ok(()),
        failed => Err(Failure::run(format!(
            "{failed} of {} points failed; the results of the others are kept",
            points.len()
        ))),
    }
}

/// What there is to report of the finished points of a folder; who asks adds how many it ran.
pub fn finished(plan: &SweepPlan<'_>, folder: &SweepFolder) -> Result<SweepSummary, Failure> {
    let records = kept_pieces(folder, plan.count())?;
    let core_s = records.iter().map(|record| folder.read_clock(record.point).core_s).sum();
    let (keys, analyses) = (plan.keys(), plan.analysis_names());
    Ok(SweepSummary::of(keys, analyses, plan.count(), records, core_s))
}

/// The figures of a study, with the modes of the case at its own friction, if the points are transients that differ in
/// speed or friction alone.
fn figures(case: &Case, plan: &SweepPlan<'_>, records: &[PointRecord]) -> Vec<Figure> {
    let is_same_body = |key: &String| key.starts_with("contact.");
    let has_modes =
        plan.analyses.contains(&Analysis::Transient) && plan.keys().iter().all(is_same_body);
    let modes = if has_modes { linear_stage(case).references } else { Vec::new() };
    draw_sweep(records, case.contact.sliding.friction_coefficient, &modes)
}

/// Writes the tables, the figures and the summary of the finished points; gives what is printed of them, for people and
/// as an object.
pub fn gather(
    output: &OutputOptions,
    folder: &SweepFolder,
    (case, plan): (&Case, &SweepPlan<'_>),
    head: Head<'_>,
    found: &SweepSummary,
) -> Result<(String, Value), Failure> {
    let told = Told {
        text: document(found, false).titled(&case.title).to_text(),
        ..Told::of(head, document(found, true))
    };
    let figures = || figures(case, plan, &found.records);
    output.write_result(folder.output(), told, found, figures)
}

/// Runs the analyses of one point up to the first that fails, and gives the summary of each by its name.
fn run_point(
    case: &Case,
    analyses: &[Analysis],
    manifest: &Manifest,
) -> Result<Map<String, Value>, Failure> {
    let mut summaries = Map::new();
    for &analysis in analyses {
        if analysis == Analysis::Cycle {
            refuse_memory(case, "cycle", case.memory("cycle").0, machine_memory())?;
        }
        summaries.insert(analysis.word().to_owned(), summarize(case, analysis, manifest)?);
    }
    Ok(summaries)
}
