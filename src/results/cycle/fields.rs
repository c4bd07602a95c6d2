//! Whole fields of limit cycles, for ParaView.

use super::CycleReport;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::pvd::{PvdEntry, write_pvd};
use crate::results::vtu::{EncodedMesh, Field, write_vtu};

/// The whole field of a limit cycle at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleFrame {
    /// Time, s.
    pub time: f64,
    /// Displacement (m) and velocity (m/s) over all dofs.
    pub fields: [Vec<f64>; 2],
}

/// Writes each frame as a VTU file, `cycles.pvd` over the waves at time zero and, where there are several frames,
/// `cycle-nN.pvd` over the time; of a motion of two waves likewise `two-waves-nN-nM.vtu`, over one period of the first.
///
/// # Errors
/// Those of the folder.
pub fn write_fields(folder: &OutputFolder, report: &CycleReport<'_>) -> Result<(), FolderError> {
    let mut waves = Vec::new();
    for (place, result) in report.results.iter().enumerate() {
        let n = result.family.harmonic;
        let group = format!("limit cycle of {n} nodal diameters");
        let stem = format!("cycle-{}", result.family.tag());
        let frames = write_frames(folder, report, &stem, &group, &result.frames)?;
        if let Some(first) = frames.first() {
            waves.push(PvdEntry { time: (place + 1) as f64, ..first.clone() });
        }
    }
    for own in &report.two_waves {
        let [first, second] = own.harmonics;
        let group = format!("waves of {first} and {second} nodal diameters together");
        let stem = format!("two-waves-n{first}-n{second}");
        if let Ok(found) = &own.outcome {
            write_frames(folder, report, &stem, &group, &found.frames)?;
        }
    }
    if !waves.is_empty() {
        folder.write("cycles.pvd", |out| write_pvd(out, &waves))?;
    }
    Ok(())
}

/// Writes the frames of one motion of the `group`, whose files begin with `stem`, and of several a list over the time.
fn write_frames(
    folder: &OutputFolder,
    report: &CycleReport<'_>,
    stem: &str,
    group: &str,
    frames: &[CycleFrame],
) -> Result<Vec<PvdEntry>, FolderError> {
    let mut entries = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        let name = match i {
            0 => format!("{stem}.vtu"),
            _ => format!("{stem}-{i:03}.vtu"),
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
        entries.push(PvdEntry { time: frame.time, group: group.to_owned(), file: name });
    }
    if entries.len() > 1 {
        folder.write(&format!("{stem}.pvd"), |out| write_pvd(out, &entries))?;
    }
    Ok(entries)
}
