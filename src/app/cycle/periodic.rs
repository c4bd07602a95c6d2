//! `frictionsim cycle` on a body without symmetry.

use crate::app::{Failure, Session, terminal};
use crate::case::{Body, Case};
use crate::mesh::SolidSector;
use crate::results::cea::KeptSteps;
use crate::results::periodic::{
    PeriodicFigures, PeriodicRecord, PeriodicReport, PeriodicResult, doubt, draw, print,
    summary_of, write,
};
use crate::results::{DrawingOptions, FolderError, OutputFolder, read_record, refuse_misfit};
use crate::study::cycle::PeriodicStudy;
use serde_json::Value;

/// What an interrupted search leaves.
const KEPT: &str = "cycles and points of branches that are done are kept (done-modeK.json tells of a mode that is done): the same \
                    command with --resume goes on";

/// Name of the file that keeps a result while the search goes on.
fn kept_name(result: &PeriodicResult) -> String {
    format!("done-{}.json", result.tag())
}

/// Keeps the summary of a result while the search goes on.
fn keep(
    folder: &OutputFolder,
    report: &PeriodicReport<'_>,
    result: &PeriodicResult,
) -> Result<(), FolderError> {
    let summary = summary_of(report, result);
    folder.write(&kept_name(result), |out| Ok(serde_json::to_writer_pretty(out, &summary)?))?;
    Ok(())
}

/// Runs the search.
///
/// # Errors
/// A bad case, a search that finds no cycle at all, an output folder that cannot be written.
pub fn run(session: &Session, is_continued: bool) -> Result<(), Failure> {
    let case = &session.case;
    session.check_memory(case.memory("cycle").0)?;
    let study = PeriodicStudy::new(case, session.simd)?;
    let folder = match is_continued {
        true => session.reopen_folder()?,
        false => session.open_folder()?,
    };
    let steps = KeptSteps::new(&folder, is_continued, &|_| {})?;
    let sought = study.sought_count() as u64;
    let bar = terminal::progress(session.options.output.is_quiet(), sought, "modes");
    terminal::catch_signals(KEPT);
    let empty = study.report(Vec::new(), 0.0);
    let results = study.run(study.choices.frames, &steps, &|result| {
        bar.inc(1);
        if let Err(error) = keep(&folder, &empty, result) {
            tracing::warn!("{error}");
        }
    })?;
    bar.finish_and_clear();
    let report = study.report(results, session.wall_seconds());
    PeriodicStudy::refuse_nothing(&report)?;
    for result in &report.results {
        if let Some(doubt) = doubt(&report, result) {
            tracing::warn!("{doubt}");
        }
    }
    let summary = write(&folder, &report)?;
    let mut kept = report.results.iter().map(kept_name);
    kept.try_for_each(|name| folder.discard(&name))?;
    if let Some(drawing) = session.options.output.drawing() {
        draw_record(&folder, case, &summary, &drawing)?;
    }
    steps.discard()?;
    let output = &session.options.output;
    output.finish(folder, &print(&report), &summary)
}

/// Draws the figures and the report of the record in the folder.
///
/// # Errors
/// A folder without a whole record; those of the drawing and of the folder.
pub fn draw_record(
    folder: &OutputFolder,
    case: &Case,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let record: PeriodicRecord = read_record(folder.path())?;
    let sector = match &case.body {
        Body::Revolution(body) => {
            Some(SolidSector::generate(&body.specification).map_err(Failure::usage)?)
        }
        _ => None,
    };
    let mesh = case.mesh().map_err(Failure::usage)?;
    let whole = sector
        .as_ref()
        .map_or(mesh.node_count(), |sector| sector.node_count() * sector.sector_count());
    let dofs = case.body.dimension() * whole;
    let mut cycles = record.cycles.iter();
    let is_own = record.nodes.iter().all(|&node| (node as usize) < whole)
        && cycles.all(|motion| {
            motion.displacement_field.len() == dofs && motion.velocity_field.len() == dofs
        });
    refuse_misfit(folder.path(), is_own)?;
    let contacts = case.body.assembly().into_iter();
    let contacts = contacts.flat_map(|body| &body.contacts);
    let data = PeriodicFigures {
        record: &record,
        mesh: &mesh,
        solid: sector.as_ref(),
        surfaces: contacts.map(|own| (own.name.clone(), own.surface)).collect(),
        materials: case.materials(),
    };
    draw(folder, &data, summary, options)?;
    Ok(())
}
