//! Figures of a transient.

use crate::app::Failure;
use crate::case::Case;
use crate::results::transient::{
    LinearStage, RecordedRun, RunFigures, TransientReport, TransientSummary, draw,
};
use crate::results::{DrawingOptions, OutputFolder};
use crate::study;
use crate::study::transient::TransientStudy;

/// The modes that the figures mark; where there are none to be had, the log says why.
pub fn linear_stage(case: &Case) -> LinearStage {
    study::linear_stage(case).unwrap_or_else(|error| {
        tracing::warn!("figures without modes of the eigenvalue analysis: {error}");
        LinearStage::default()
    })
}

/// Draws the figures and the page of a run.
pub(super) fn draw_run(
    folder: &OutputFolder,
    study: &TransientStudy<'_>,
    report: &TransientReport<'_>,
    summary: &TransientSummary,
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let run = RunFigures {
        run: RecordedRun { material: study.case.materials(), ..report.run },
        peripheral_speed: study.shown_speed(),
        stage: linear_stage(study.case),
    };
    Ok(draw(folder, &run, report.title, summary, options)?)
}
