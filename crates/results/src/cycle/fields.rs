//! Files of limit cycles: their tables, and whole fields for ParaView.

use super::{found::encode_contact, summary::CycleSummary, two_waves::TwoWaveSummary};
use crate::common::*;
use std::cell::OnceCell;

impl CycleSummary {
    /// Writes what its document has no table of: each cycle over its period and along its branch, and whole fields of
    /// the body.
    ///
    /// Each frame is a VTU file, with `cycles.pvd` over the waves at time zero and, where there are several frames,
    /// `cycle-TAG.pvd` over the time; of a motion of two waves likewise `two-waves-nN-nM.vtu`, over one period of the
    /// first. Of a motion of the whole mesh its contact comes with them, `contact-TAG.npz`.
    pub fn write(&self, folder: &OutputFolder, body: &ShownBody<'_>) -> Result<(), FolderError> {
        let interface = self.interface();
        let tables = self.cycles.iter().flat_map(|own| own.tables(body, interface));
        let pairs = self.two_waves.iter().filter_map(TwoWaveSummary::table);
        tables.chain(pairs).try_for_each(|table| write_table(folder, &table))?;
        let fields = Fields { folder, body, interface, mesh: OnceCell::new() };
        let mut waves = Vec::new();
        for (place, own) in self.cycles.iter().enumerate() {
            let tag = own.name.tag();
            if let Some(interface) = interface.filter(|_| own.cycle.is_some()) {
                folder.write_bulk(&format!("contact-{tag}.npz"), |out| {
                    out.write_all(&encode_contact(interface, &own.motion.instants)?)
                })?;
            }
            let group = format!("limit cycle of {}", own.whose());
            let first = fields.write(&format!("cycle-{tag}"), &group, &own.motion.frames)?;
            let first = first.filter(|_| own.is_wave());
            waves.extend(first.map(|own| PvdEntry { time: (place + 1) as f64, ..own }));
        }
        for own in &self.two_waves {
            let [first, second] = own.harmonics;
            let group = format!("waves of {first} and {second} nodal diameters together");
            let stem = format!("two-waves-n{first}-n{second}");
            fields.write(&stem, &group, &own.frames)?;
        }
        if !waves.is_empty() {
            folder.write("cycles.pvd", |out| write_pvd(out, &waves))?;
        }
        Ok(())
    }
}

/// The body whose fields go to a folder.
struct Fields<'a> {
    folder: &'a OutputFolder,
    body: &'a ShownBody<'a>,
    /// The contact of motions of the whole mesh.
    interface: Option<&'a ContactInterface>,
    /// Its mesh, once there is a field.
    mesh: OnceCell<io::Result<EncodedMesh>>,
}

impl Fields<'_> {
    /// Writes the frames of one motion of the `group`, whose files begin with `stem`, and of several a list over the
    /// time; gives the first.
    fn write(
        &self,
        stem: &str,
        group: &str,
        frames: &[MotionFrame],
    ) -> Result<Option<PvdEntry>, FolderError> {
        let mut entries = Vec::new();
        for (i, frame) in frames.iter().enumerate() {
            let name = if i == 0 { format!("{stem}.vtu") } else { format!("{stem}-{i:03}.vtu") };
            self.folder.write(&name, |out| {
                let mesh = self.mesh.get_or_init(|| self.body.encoded());
                let mesh = mesh.as_ref().map_err(|error| io::Error::from(error.kind()))?;
                let whole = [("time_s", frame.time)];
                write_vtu(out, mesh, &whole, &self.frame_fields(frame), &[])
            })?;
            entries.push(PvdEntry { time: frame.time, group: group.to_owned(), file: name });
        }
        if entries.len() > 1 {
            self.folder.write(&format!("{stem}.pvd"), |out| write_pvd(out, &entries))?;
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
        if let (Some(contact), Some(interface)) = (&frame.contact, self.interface) {
            let states = interface.nodes.iter().zip(contact);
            let states = states.map(|(&node, own)| (node, own.status, [own.pressure, own.shear]));
            fields.extend(Field::contact(displacement.len() / self.body.dimension(), states));
        }
        fields
    }
}
