//! Figures of limit cycles: after the search, and again from its record.

use crate::app::Failure;
use crate::case::Case;
use crate::mesh::AnnulusMesh;
use crate::results::cycle_figures::{CycleFigures, CycleRecord, draw};
use crate::results::{DrawingOptions, OutputFolder, read_record, read_summary, refuse_misfit};
use serde_json::Value;

/// Draws the figures of a folder again, from its `record.bin`.
///
/// # Errors
/// As [`draw_record`].
pub fn redraw(folder: &OutputFolder, case: &Case, options: &DrawingOptions) -> Result<(), Failure> {
    let summary = read_summary(folder.path())?;
    match case.has_rotating_waves() {
        true => draw_record(folder, case, &summary, options),
        false => super::periodic::draw_record(folder, case, &summary, options),
    }
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
    let record: CycleRecord = read_record(folder.path())?;
    let (waves, search) = ("limit cycles are rotating waves, which", "limit cycles are sought in");
    let specification = &case.require_annulus(waves, search)?.specification;
    let annulus = AnnulusMesh::generate(specification).map_err(Failure::usage)?;
    let waves = record.families.iter().filter_map(|family| family.cycle.as_ref());
    let mut fields = waves.flat_map(|wave| [&wave.displacement_field, &wave.velocity_field]);
    let dofs = 2 * annulus.mesh.node_count();
    refuse_misfit(folder.path(), fields.all(|field| field.len() == dofs))?;
    let data = CycleFigures {
        record: &record,
        mesh: &annulus.mesh,
        material: &case.material,
        contact: case.contact.sliding,
        inner_radius: specification.inner_radius,
    };
    draw(folder, &data, summary, options)?;
    Ok(())
}
