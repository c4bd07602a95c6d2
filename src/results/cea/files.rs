//! `eigenvalues.csv`, `stability.csv`, `summary.json`, mode shapes.

use super::base::write_base;
use super::summary::summary;
use super::{CeaReport, ComplexMode, UnstableInterval};
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::summary::write_summary;
use crate::results::table::{Table, format_number};
use crate::results::vtu::{EncodedMesh, Field, PvdEntry, write_pvd, write_vtu};
use rayon::prelude::*;
use serde_json::Value;
use std::io::{self, Write};

/// Writes all files of the analysis and returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &CeaReport<'_>) -> Result<Value, FolderError> {
    folder.write("eigenvalues.csv", |out| write_eigenvalues(out, report))?;
    folder.write("stability.csv", |out| {
        write_stability(out, &report.sweep.intervals, report.has_harmonics)
    })?;
    if let Some(sensitivities) = report.sensitivities {
        folder.write("sensitivities.csv", |out| sensitivities.write(out))?;
    }
    if let Some(map) = report.map {
        folder.write("map.csv", |out| map.write(out))?;
    }
    match report.solid {
        Some(solid) => solid.write_base(folder)?,
        None => write_base(folder, report.mesh, report.field)?,
    }
    write_shapes(folder, report)?;
    write_summary(folder, &summary(report, folder.manifest()))
}

/// Writes one row for each mode and friction value, sorted by frequency within a value.
///
/// # Errors
/// Those of the writer.
pub fn write_eigenvalues(out: &mut dyn Write, report: &CeaReport<'_>) -> io::Result<()> {
    let mut columns = vec![
        "friction_coefficient",
        "mode",
        "real_hz",
        "frequency_hz",
        "damping_factor",
        "growth_rate_per_s",
        "harmonic",
        "branch",
        "direction",
        "unstable",
        "residual",
        "contact_share",
    ];
    columns.extend(report.solid.map(|_| "axial_share"));
    // A body without symmetry has modes without a harmonic.
    let named = |text: String| {
        if report.has_harmonics {
            text
        } else {
            String::new()
        }
    };
    let mut table = Table::new(out, &columns)?;
    for point in report.tabulated() {
        for (index, mode) in point.modes.iter().enumerate() {
            let row = [
                format_number(point.friction_coefficient),
                (index + 1).to_string(),
                format_number(mode.real_hz()),
                format_number(mode.frequency_hz()),
                format_number(mode.damping_factor()),
                format_number(mode.growth_rate()),
                named(mode.harmonic.to_string()),
                mode.branch.to_string(),
                named(mode.direction.to_string()),
                mode.is_unstable().to_string(),
                format_number(mode.residual),
                format_number(mode.contact_share),
            ];
            let axial = report.solid.and(mode.axial_share).map(format_number);
            table.row(row.into_iter().chain(axial))?;
        }
    }
    table.finish()
}

/// Writes one row for each crossing into instability; the last columns say where the branch turns
/// stable again (empty where it does not) and whether it was unstable from the first value on.
///
/// # Errors
/// Those of the writer.
pub fn write_stability(
    out: &mut dyn Write,
    intervals: &[UnstableInterval],
    has_harmonics: bool,
) -> io::Result<()> {
    let named = |text: String| if has_harmonics { text } else { String::new() };
    let columns = [
        "harmonic",
        "branch",
        "direction",
        "critical_friction",
        "frequency_hz",
        "restabilized_friction",
        "restabilized_frequency_hz",
        "unstable_from_start",
    ];
    let mut table = Table::new(out, &columns)?;
    for interval in intervals {
        let end = interval.restabilized.unwrap_or((f64::NAN, f64::NAN));
        table.row([
            named(interval.harmonic.to_string()),
            interval.branch.to_string(),
            named(interval.direction.to_string()),
            format_number(interval.critical_friction),
            format_number(interval.frequency_hz),
            format_number(end.0),
            format_number(end.1),
            interval.unstable_from_start.to_string(),
        ])?;
    }
    table.finish()
}

/// Writes the shapes that the modes carry: one VTU each with the real and the imaginary part of the
/// displacement, so that `Re(phi e^{i omega t})` can be animated, and `modes.pvd` over them.
fn write_shapes(folder: &OutputFolder, report: &CeaReport<'_>) -> Result<(), FolderError> {
    let numbered = report.sweep.points.iter().flat_map(|point| {
        let modes = point.modes.iter().enumerate();
        modes.map(move |(index, mode)| (point.friction_coefficient, index + 1, mode))
    });
    let shaped: Vec<(f64, usize, &ComplexMode)> = numbered
        .filter(|(_, _, mode)| mode.shape.is_some())
        .collect();
    if shaped.is_empty() {
        return Ok(());
    }
    let mesh = match report.solid {
        Some(solid) => EncodedMesh::solid(&solid.sector),
        None => EncodedMesh::new(report.mesh),
    };
    let mut entries = Vec::new();
    // Compression takes the time: a batch of files side by side, written in order.
    for batch in shaped.chunks(rayon::current_num_threads().max(1)) {
        let encoded: Vec<io::Result<Vec<u8>>> = batch
            .par_iter()
            .map(|(friction, _, mode)| encode_shape(report, &mesh, *friction, mode))
            .collect();
        for ((friction, number, mode), bytes) in batch.iter().zip(encoded) {
            let name = format!("modes/mu-{friction}-mode-{number:03}.vtu");
            folder.write_bulk(&name, |out| out.write_all(&bytes?))?;
            entries.push(PvdEntry {
                time: entries.len() as f64 + 1.0,
                group: format!(
                    "mu {friction}, mode {number}, {:.1} Hz",
                    mode.frequency_hz()
                ),
                file: name,
            });
        }
    }
    folder.write("modes.pvd", |out| write_pvd(out, &entries))?;
    Ok(())
}

fn encode_shape(
    report: &CeaReport<'_>,
    mesh: &io::Result<EncodedMesh>,
    friction_coefficient: f64,
    mode: &ComplexMode,
) -> io::Result<Vec<u8>> {
    let mesh = mesh
        .as_ref()
        .map_err(|error| io::Error::from(error.kind()))?;
    let fields = shape_fields(report, mode);
    let whole = [
        Field::number("frequency_hz", mode.frequency_hz()),
        Field::number("real_hz", mode.real_hz()),
        Field::number("friction_coefficient", friction_coefficient),
    ];
    let mut bytes = Vec::new();
    write_vtu(&mut bytes, mesh, &whole, &fields, &[])?;
    Ok(bytes)
}

fn shape_fields(report: &CeaReport<'_>, mode: &ComplexMode) -> [Field; 3] {
    let shape = mode.shape.as_deref().unwrap_or_default();
    if let Some(solid) = report.solid {
        return solid.shape_fields(shape);
    }
    let part = |of: fn(&crate::linalg::c64) -> f64| shape.iter().map(of).collect::<Vec<f64>>();
    let amplitude = shape
        .chunks_exact(2)
        .map(|pair| (pair[0].norm_sqr() + pair[1].norm_sqr()).sqrt())
        .collect();
    [
        Field::vectors("displacement_real", report.mesh, &part(|value| value.re)),
        Field::vectors(
            "displacement_imaginary",
            report.mesh,
            &part(|value| value.im),
        ),
        Field::scalars("amplitude", amplitude),
    ]
}
