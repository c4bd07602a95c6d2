//! Fields of the base state, of the feed and of mode shapes.

use super::shape::{ModeShape, size};
use super::{BaseField, CeaReport, feed};
use crate::common::*;
use crate::{write_universal_mesh, write_universal_mode};

/// Writes `prestress.vtu` (of a body that no mesh file gives in three dimensions also with friction coefficient and
/// power of the whole), `feed.vtu` and the mode shapes.
pub fn write_fields(
    folder: &OutputFolder,
    report: &CeaReport<'_>,
    field: &BaseField,
) -> Result<(), FolderError> {
    let (body, base) = (&report.body, &report.base);
    let state = [("friction_coefficient", base.friction_coefficient), ("power_w", base.power_w)];
    let whole = if body.is_assembly() { &[][..] } else { &state[..] };
    folder.write_bulk("prestress.vtu", |out| {
        write_vtu(out, &body.encoded()?, whole, &field.fields(body), &[])
    })?;
    if let Some(reading) = report.solution.reading.as_ref().filter(|own| !own.feed.is_empty()) {
        feed::write_fields(folder, report, field, &reading.feed)?;
    }
    write_shapes(folder, report)
}

/// Writes the shapes that the modes carry: one VTU each with the real and the imaginary part of the
/// displacement, so that `Re(phi e^{i omega t})` can be animated, and `modes.pvd` over them.
fn write_shapes(folder: &OutputFolder, report: &CeaReport<'_>) -> Result<(), FolderError> {
    let shapes: Vec<ModeShape<'_>> = ModeShape::all(report).collect();
    if shapes.is_empty() {
        return Ok(());
    }
    let mesh = report.body.encoded();
    let mesh = mesh.map_err(|error| FolderError::io("write", folder.path(), error))?;
    let mut entries = Vec::new();
    // Compression takes the time: a batch of files side by side, written in order.
    for batch in shapes.chunks(rayon::current_num_threads().max(1)) {
        let encoded: Vec<io::Result<Vec<u8>>> =
            frictionsim_physics::parallel::map(batch, |shape| encode_shape(report, &mesh, shape));
        for (&ModeShape { friction, number, mode, .. }, bytes) in batch.iter().zip(encoded) {
            let name = format!("modes/mu-{friction}-mode-{number:03}.vtu");
            folder.write_bulk(&name, |out| out.write_all(&bytes?))?;
            entries.push(PvdEntry {
                time: time_of(mode, &entries),
                group: format!("mu {friction}, mode {number}, {:.1} Hz", mode.frequency_hz()),
                file: name,
            });
        }
    }
    folder.write("modes.pvd", |out| write_pvd(out, &entries))
}

/// Writes the mesh and the shapes that the modes carry as a universal file, `modes.unv`.
///
/// # Errors
/// Those of the folder; an element that universal files do not have.
pub fn write_universal(folder: &OutputFolder, report: &CeaReport<'_>) -> Result<(), FolderError> {
    let mesh = report.body.whole();
    folder.write_bulk("modes.unv", |out| {
        write_universal_mesh(out, &mesh)?;
        for (k, ModeShape { friction, number, mode, .. }) in ModeShape::all(report).enumerate() {
            let name = format!("friction {friction}, mode {number}, {:.2} Hz", mode.frequency_hz());
            let parts = [|z: &c64| z.re, |z: &c64| z.im].map(|of| part_of(mode, of));
            let [real, imaginary] = parts.map(|part| cartesian_vectors(&mesh, &part));
            write_universal_mode(out, &mesh, (&name, k + 1), mode.eigenvalue, [&real, &imaginary])?;
        }
        Ok(())
    })
}

/// The time of a mode in the collection: its frequency, Hz, by which ParaView animates modes. It takes files of one
/// time for parts of one body: of equal frequencies the later one stands a hair higher.
fn time_of(mode: &ComplexMode, before: &[PvdEntry]) -> f64 {
    let mut time = mode.frequency_hz();
    while before.iter().any(|entry| rounded(entry.time, 12) == rounded(time, 12)) {
        time += 1e-9 * time.max(1.0);
    }
    time
}

fn encode_shape(
    report: &CeaReport<'_>,
    mesh: &EncodedMesh,
    &ModeShape { friction, mode, .. }: &ModeShape<'_>,
) -> io::Result<Vec<u8>> {
    let body = &report.body;
    let shape = mode.shape.as_deref().unwrap_or_default();
    let fields = [
        body.vectors("displacement_real", &part_of(mode, |z| z.re)),
        body.vectors("displacement_imaginary", &part_of(mode, |z| z.im)),
        Field::scalars("amplitude", shape.chunks_exact(body.dimension()).map(size)),
    ];
    let whole = [
        ("frequency_hz", mode.frequency_hz()),
        ("real_hz", mode.real_hz()),
        ("friction_coefficient", friction),
    ];
    let mut bytes = Vec::new();
    write_vtu(&mut bytes, mesh, &whole, &fields, &[])?;
    Ok(bytes)
}

/// One part of the shape of a mode, in nodal frames.
fn part_of(mode: &ComplexMode, of: fn(&c64) -> f64) -> Vec<f64> {
    mode.shape.as_deref().unwrap_or_default().iter().map(of).collect()
}
