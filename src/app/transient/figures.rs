//! Figures of a transient: after the run, and again from its record.

use crate::app::Failure;
use crate::case::Case;
use crate::fem::operator::SimdLevel;
use crate::results::transient::{RunEnd, RunFigures, TransientSummary, draw, shear_stress_beside};
use crate::results::{
    DrawingError, DrawingOptions, OutputFolder, draw_all, read_record, read_summary, refuse_misfit,
    write_figures,
};
use crate::study::transient::TransientStudy;
use crate::study::{LinearStage, extent_of};
use crate::transient::Recorder;
use serde::Deserialize;
use serde_json::Value;
use std::path::PathBuf;

/// The modes that the figures mark; where there are none to be had, the log says why.
pub fn linear_stage(case: &Case) -> LinearStage {
    LinearStage::of(case).unwrap_or_else(|error| {
        tracing::warn!("figures without modes of the eigenvalue analysis: {error}");
        LinearStage::default()
    })
}

/// Draws the figures and the report of a record.
///
/// # Errors
/// Those of the drawing and of the folder.
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

/// Draws the figures of a folder again, from its `record.bin`.
///
/// # Errors
/// A folder without a whole record; those of the drawing and of the folder.
pub fn redraw(folder: &OutputFolder, case: &Case, options: &DrawingOptions) -> Result<(), Failure> {
    let summary: Value = read_summary(folder.path())?;
    let study = TransientStudy::new(case, SimdLevel::Scalar)?;
    let record: Recorder = read_record(folder.path())?;
    let fits = study.is_of(&record);
    refuse_misfit(folder.path(), fits)?;
    let summary = TransientSummary::deserialize(&summary).map_err(|error| {
        let path = folder.path().display();
        Failure::usage(format!(
            "the summary.json of {path} is of another version ({error}): run it again"
        ))
    })?;
    draw_record(folder, &study, &record, &summary, options)
}

/// Draws the last shear stress field of several finished runs side by side into the folder of the first.
///
/// # Errors
/// A run without a whole record or without snapshots; those of the drawing and of the folder.
pub fn draw_beside(
    folder: &OutputFolder,
    runs: &[(PathBuf, Case)],
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let mut records = Vec::new();
    for (path, case) in runs {
        let study = TransientStudy::new(case, SimdLevel::Scalar)?;
        let record: Recorder = read_record(path)?;
        case.require_plane("pictures of stresses side by side are of")?;
        let fits = study.is_of(&record);
        refuse_misfit(path, fits)?;
        records.push((study, record));
    }
    let mut ends = Vec::new();
    for ((path, case), (study, record)) in runs.iter().zip(&records) {
        let last = record.snapshots.last();
        ends.push(RunEnd {
            mesh: &study.stepped.mesh,
            material: case.materials(),
            damping: case.damping.rayleigh,
            snapshot: last.ok_or_else(|| {
                Failure::usage(format!(
                    "{} holds no snapshot: set output.snapshots",
                    path.display()
                ))
            })?,
        });
    }
    let figures = draw_all(vec![Box::new(|| Ok(shear_stress_beside(&ends)))], options);
    write_figures(folder, &figures.map_err(DrawingError::from)?, options)?;
    Ok(())
}
