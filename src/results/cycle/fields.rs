//! Whole fields of limit cycles, for ParaView.

use super::{CycleReport, CycleResult};
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::vtu::{EncodedMesh, Field, PvdEntry, write_pvd, write_vtu};

/// The whole field of a limit cycle at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleFrame {
    /// Time, s.
    pub time: f64,
    /// Displacement (m) and velocity (m/s) over all dofs.
    pub fields: [Vec<f64>; 2],
}

/// Writes each frame as a VTU file, `cycles.pvd` over the waves at time zero and, where there are several frames,
/// `cycle-nN.pvd` over the time.
///
/// # Errors
/// Those of the folder.
pub fn write_fields(folder: &OutputFolder, report: &CycleReport<'_>) -> Result<(), FolderError> {
    let mut waves = Vec::new();
    for (place, result) in report.results.iter().enumerate() {
        let frames = write_frames(folder, report, result)?;
        if let Some(first) = frames.first() {
            waves.push(PvdEntry {
                time: (place + 1) as f64,
                ..first.clone()
            });
        }
        if frames.len() > 1 {
            let name = format!("cycle-{}.pvd", result.family.tag());
            folder.write(&name, |out| write_pvd(out, &frames))?;
        }
    }
    if !waves.is_empty() {
        folder.write("cycles.pvd", |out| write_pvd(out, &waves))?;
    }
    Ok(())
}

fn write_frames(
    folder: &OutputFolder,
    report: &CycleReport<'_>,
    result: &CycleResult,
) -> Result<Vec<PvdEntry>, FolderError> {
    let (tag, n) = (result.family.tag(), result.family.harmonic);
    let mut entries = Vec::new();
    for (i, frame) in result.frames.iter().enumerate() {
        let name = match i {
            0 => format!("cycle-{tag}.vtu"),
            _ => format!("cycle-{tag}-{i:03}.vtu"),
        };
        let [displacement, velocity] = &frame.fields;
        folder.write(&name, |out| {
            let fields = [
                Field::vectors("displacement_m", report.mesh, displacement),
                Field::vectors("velocity_m_per_s", report.mesh, velocity),
            ];
            let whole = [Field::number("time_s", frame.time)];
            write_vtu(out, &EncodedMesh::new(report.mesh)?, &whole, &fields, &[])
        })?;
        entries.push(PvdEntry {
            time: frame.time,
            group: format!("limit cycle of {n} nodal diameters"),
            file: name,
        });
    }
    Ok(entries)
}
