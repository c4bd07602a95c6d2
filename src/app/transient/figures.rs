//! Figures of a transient: after the run, and again from its record.

use super::Prepared;
use crate::app::Failure;
use crate::app::linear_stage::LinearStage;
use crate::case::Case;
use crate::results::run_figures::RunFigures;
use crate::results::transient::{TransientSummary, draw};
use crate::results::{DrawingOptions, OutputFolder, read_record, refuse_misfit};
use crate::transient::Recorder;
use serde::Deserialize;
use serde_json::Value;

/// Draws the figures and the report of a record.
///
/// # Errors
/// Those of the drawing and of the folder.
pub(super) fn draw_record(
    folder: &OutputFolder,
    prepared: &Prepared<'_>,
    record: &Recorder,
    summary: &TransientSummary,
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let case = prepared.case;
    let sliding = &case.contact.sliding;
    let stage = LinearStage::of(case);
    let run = RunFigures {
        record,
        analysis: &prepared.analyse(record),
        mesh: &prepared.annulus.mesh,
        material: &case.material,
        thickness: case.thickness,
        peripheral_speed: sliding.rotation_speed * case.annulus.inner_radius,
        references: stage.references,
        growth_rates: stage.growth_rates,
    };
    draw(folder, &run, summary, options)?;
    Ok(())
}

/// Draws the figures of a folder again, from its `record.bin`.
///
/// # Errors
/// A folder without a whole record; those of the drawing and of the folder.
pub fn redraw(
    folder: &OutputFolder,
    case: &Case,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let prepared = Prepared::new(case, "scalar")?;
    let record: Recorder = read_record(folder.path())?;
    let mesh = &prepared.annulus.mesh;
    let fits = record.fits(mesh.node_count(), mesh.inner_edge.nodes.len());
    refuse_misfit(folder.path(), fits)?;
    let summary = TransientSummary::deserialize(summary).map_err(|error| {
        let path = folder.path().display();
        Failure::usage(format!(
            "the summary.json of {path} is of another version ({error}): run it again"
        ))
    })?;
    draw_record(folder, &prepared, &record, &summary, options)
}
