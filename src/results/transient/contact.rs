//! `contact.npz`: the contact edge over time, node by node.

use crate::transient::Recorder;
use npyz::WriterBuilder;
use npyz::npz::NpzWriter;
use npyz::zip::{DateTime, write::FileOptions};
use std::io::{self, Cursor};

/// Writes the arrays `time_s (F)`, `angle_rad (N)`, `status (F, N)` with 0 open, 1 stick, 2 slip, `pressure_pa (F, N)`
/// and `shear_pa (F, N)` for `F` frames and `N` contact nodes, as NumPy reads them.
///
/// # Errors
/// Those of the archive.
pub fn encode_contact(record: &Recorder) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let mut archive = NpzWriter::new(&mut bytes);
    let (frames, nodes) = (
        record.frames.len() as u64,
        record.contact_angles.len() as u64,
    );
    let times = record.frames.iter().map(|frame| frame.time);
    array(&mut archive, "time_s", &[frames], times)?;
    let angles = record.contact_angles.iter().copied();
    array(&mut archive, "angle_rad", &[nodes], angles)?;
    let shape = [frames, nodes];
    let status = record
        .frames
        .iter()
        .flat_map(|frame| frame.status.iter().copied());
    array(&mut archive, "status", &shape, status)?;
    let pressure = record
        .frames
        .iter()
        .flat_map(|frame| frame.pressure.iter().copied());
    array(&mut archive, "pressure_pa", &shape, pressure)?;
    let shear = record
        .frames
        .iter()
        .flat_map(|frame| frame.shear.iter().copied());
    array(&mut archive, "shear_pa", &shape, shear)?;
    drop(archive);
    Ok(bytes.into_inner())
}

fn array<T: npyz::AutoSerialize>(
    archive: &mut NpzWriter<&mut Cursor<Vec<u8>>>,
    name: &str,
    shape: &[u64],
    values: impl Iterator<Item = T>,
) -> io::Result<()> {
    // No time of day: the same run writes the same bytes.
    let options = FileOptions::default().last_modified_time(DateTime::default());
    let mut writer = archive
        .array(name, options)?
        .default_dtype()
        .shape(shape)
        .begin_nd()?;
    writer.extend(values)?;
    writer.finish()
}
