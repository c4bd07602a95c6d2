//! Whole fields of limit cycles, for ParaView.

use super::motions::encode_contact;
use super::{CycleReport, Search};
use crate::folder::{FolderError, OutputFolder};
use crate::pvd::{PvdEntry, write_pvd};
use crate::vtu::{EncodedMesh, Field, write_vtu};
use frictionsim_physics::cycle::periodic::MotionFrame;
use std::cell::LazyCell;
use std::io;
use std::ops::Deref;

/// Writes each frame as a VTU file, `cycles.pvd` over the waves at time zero and, where there are several frames,
/// `cycle-TAG.pvd` over the time; of a motion of two waves likewise `two-waves-nN-nM.vtu`, over one period of the
/// first. Of a motion of the whole mesh its contact comes with them, `contact-TAG.npz`.
pub(super) fn write_fields(
    folder: &OutputFolder,
    report: &CycleReport<'_>,
) -> Result<(), FolderError> {
    let mesh = LazyCell::new(|| report.body.encoded());
    let write = |stem: &str, group: &str, frames: &[MotionFrame]| {
        report.write_frames(folder, &mesh, (stem, group), frames)
    };
    match &report.search {
        Search::Waves(search) => {
            let mut waves = Vec::new();
            for (place, own) in search.results.iter().enumerate() {
                let group = format!("limit cycle of {} nodal diameters", own.family.harmonic);
                let stem = format!("cycle-{}", own.family.tag());
                let first = write(&stem, &group, &own.frames)?;
                waves.extend(first.map(|own| PvdEntry { time: (place + 1) as f64, ..own }));
            }
            for own in &search.two_waves {
                let [first, second] = own.harmonics;
                let group = format!("waves of {first} and {second} nodal diameters together");
                let stem = format!("two-waves-n{first}-n{second}");
                if let Ok(found) = &own.outcome {
                    write(&stem, &group, &found.frames)?;
                }
            }
            if !waves.is_empty() {
                folder.write("cycles.pvd", |out| write_pvd(out, &waves))?;
            }
        }
        Search::Motions(search) => {
            let found = search.results.iter().filter_map(|own| Some((own.tag(), own.own()?)));
            for (tag, found) in found {
                let motion = &found.motion;
                folder.write_bulk(&format!("contact-{tag}.npz"), |out| {
                    out.write_all(&encode_contact(&search.interface, motion)?)
                })?;
                let group = format!("limit cycle of {:.2} Hz", motion.frequency_hz);
                write(&format!("cycle-{tag}"), &group, &motion.frames)?;
            }
        }
    }
    Ok(())
}

impl CycleReport<'_> {
    /// Writes the frames of one motion of the `group`, whose files begin with `stem`, and of several a list over the
    /// time; gives the first.
    fn write_frames(
        &self,
        folder: &OutputFolder,
        mesh: &dyn Deref<Target = io::Result<EncodedMesh>>,
        (stem, group): (&str, &str),
        frames: &[MotionFrame],
    ) -> Result<Option<PvdEntry>, FolderError> {
        let mut entries = Vec::new();
        for (i, frame) in frames.iter().enumerate() {
            let name = match i {
                0 => format!("{stem}.vtu"),
                _ => format!("{stem}-{i:03}.vtu"),
            };
            folder.write(&name, |out| {
                let mesh = mesh.as_ref().map_err(|error| io::Error::from(error.kind()))?;
                let whole = [Field::number("time_s", frame.time)];
                write_vtu(out, mesh, &whole, &self.frame_fields(frame), &[])
            })?;
            entries.push(PvdEntry { time: frame.time, group: group.to_owned(), file: name });
        }
        if entries.len() > 1 {
            folder.write(&format!("{stem}.pvd"), |out| write_pvd(out, &entries))?;
        }
        Ok(entries.into_iter().next())
    }

    /// The fields of one frame: motion of all nodes; status, pressure and shear of those of the contact.
    fn frame_fields(&self, frame: &MotionFrame) -> Vec<Field> {
        let [displacement, velocity] = &frame.fields;
        let mut fields = vec![
            self.body.vectors("displacement_m", displacement),
            self.body.vectors("velocity_m_per_s", velocity),
        ];
        if let (Some(contact), Search::Motions(search)) = (&frame.contact, &self.search) {
            let count = displacement.len() / if self.body.is_solid() { 3 } else { 2 };
            let nodes = &search.interface.nodes;
            let tractions = [&contact.pressure[..], &contact.shear];
            let statuses = contact.status.iter().copied();
            fields.extend(Field::contact(count, nodes, statuses, tractions));
        }
        fields
    }
}
