//! Figures of a transient: after the run, and again from its record.

use super::Prepared;
use crate::app::Failure;
use crate::app::linear_stage::LinearStage;
use crate::case::Case;
use crate::results::transient::{RunEnd, RunFigures, TransientSummary, draw, shear_stress_beside};
use crate::results::{
    DrawingError, DrawingOptions, OutputFolder, draw_all, read_record, refuse_misfit, write_figures,
};
use crate::transient::Recorder;
use serde::Deserialize;
use serde_json::Value;
use std::path::PathBuf;

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
    let stage = LinearStage::of(case);
    let run = RunFigures {
        record,
        analysis: &prepared.analyse(record),
        mesh: &prepared.mesh,
        solid: prepared.sector.as_ref(),
        material: case.materials(),
        thickness: prepared.thickness(),
        peripheral_speed: prepared.shown_speed(),
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
    let fits = prepared.is_of(&record);
    refuse_misfit(folder.path(), fits)?;
    let summary = TransientSummary::deserialize(summary).map_err(|error| {
        let path = folder.path().display();
        Failure::usage(format!(
            "the summary.json of {path} is of another version ({error}): run it again"
        ))
    })?;
    draw_record(folder, &prepared, &record, &summary, options)
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
        let prepared = Prepared::new(case, "scalar")?;
        let record: Recorder = read_record(path)?;
        case.require_plane("pictures of stresses side by side are of")?;
        let fits = prepared.is_of(&record);
        refuse_misfit(path, fits)?;
        records.push((prepared, record));
    }
    let mut ends = Vec::new();
    for ((path, case), (prepared, record)) in runs.iter().zip(&records) {
        let last = record.snapshots.last();
        ends.push(RunEnd {
            mesh: &prepared.mesh,
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

impl Prepared<'_> {
    /// Whether a record can be one of this body.
    pub(super) fn is_of(&self, record: &Recorder) -> bool {
        let components = self.body().components();
        let nodes = match &self.sector {
            Some(sector) => sector.node_count() * sector.sector_count(),
            None => self.mesh.node_count(),
        };
        record.fits(
            components * nodes,
            components,
            self.body().interface().len(),
        )
    }

    /// Speed of the counterface where figures show the contact, m/s: of several rings of nodes at the middle one.
    pub(super) fn shown_speed(&self) -> f64 {
        let speed = self.case.contact.sliding.rotation_speed;
        match &self.sector {
            Some(sector) => speed * sector.rings[sector.rings.len() / 2].radius,
            None => self.body().interface().surface_speed(speed),
        }
    }

    /// What records are multiplied by: those of a body in three dimensions are of the whole.
    pub(super) fn thickness(&self) -> f64 {
        self.sector.as_ref().map_or(self.case.thickness, |_| 1.0)
    }
}
