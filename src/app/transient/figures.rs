//! Figures of a transient.

use crate::app::Failure;
use crate::case::Case;
use crate::results::transient::{RunFigures, TransientSummary, draw};
use crate::results::{DrawingOptions, OutputFolder};
use crate::study::transient::TransientStudy;
use crate::study::{LinearStage, extent_of};
use crate::transient::Recorder;

/// The modes that the figures mark; where there are none to be had, the log says why.
pub fn linear_stage(case: &Case) -> LinearStage {
    LinearStage::of(case).unwrap_or_else(|error| {
        tracing::warn!("figures without modes of the eigenvalue analysis: {error}");
        LinearStage::default()
    })
}

/// Draws the figures and the report of a record.
pub(super) fn draw_record(
    folder: &OutputFolder,
    study: &TransientStudy<'_>,
    record: &Recorder,
    summary: &TransientSummary,
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let case = study.case;
    let stage = linear_stage(case);
    let run = RunFigures {
        record,
        analysis: &study.analyse(record),
        mesh: &study.stepped.mesh,
        solid: study.stepped.sector.as_ref(),
        has_harmonics: case.has_sectors(),
        material: case.materials(),
        thickness: study.stepped.thickness(case),
        extent: extent_of(case),
        peripheral_speed: study.shown_speed(),
        references: stage.references,
        growth_rates: stage.growth_rates,
        mode_rates: stage.mode_rates,
    };
    draw(folder, &run, summary, options)?;
    Ok(())
}
