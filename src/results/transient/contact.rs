//! `contact.npz`: the contact edge over time, node by node.

use crate::results::npz::NpzArchive;
use crate::transient::Recorder;
use std::io;

/// Writes the arrays `time_s (F)`, `angle_rad (N)`, `status (F, N)`, `pressure_pa (F, N)` and `shear_pa (F, N)` for `F`
/// frames and `N` contact nodes, as NumPy reads them; the numbers `interval_s` between frames, and `status_open` (0),
/// `status_stick` (1), `status_slip` (2), which say what the codes of `status` mean. A body in three dimensions has
/// `shear_across_pa (F, N)` too, along `e_z` on its inner edge and `e_r` on its top.
///
/// A frame is the state of one step; frames may lie several samples apart.
pub fn encode_contact(record: &Recorder) -> io::Result<Vec<u8>> {
    let mut archive = NpzArchive::default();
    let frames = &record.frames;
    let shape = [frames.len(), record.contact_angles.len()];
    archive.array("time_s", &shape[..1], frames.iter().map(|f| f.time))?;
    archive.array("angle_rad", &shape[1..], record.contact_angles.iter().copied())?;
    let status = frames.iter().flat_map(|f| f.status.iter().copied());
    archive.array("status", &shape, status)?;
    let pressure = frames.iter().flat_map(|f| f.pressure.iter().copied());
    archive.array("pressure_pa", &shape, pressure)?;
    let shear = frames.iter().flat_map(|f| f.shear().iter().copied());
    archive.array("shear_pa", &shape, shear)?;
    if frames.iter().any(|frame| !frame.shear_across().is_empty()) {
        let across = frames.iter().flat_map(|f| f.shear_across().iter().copied());
        archive.array("shear_across_pa", &shape, across)?;
    }
    let interval = record.frame_stride as f64 * record.sample_interval;
    archive.array("interval_s", &[], std::iter::once(interval))?;
    archive.status_codes()?;
    archive.finish()
}
