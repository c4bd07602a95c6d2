//! Consistency checks of a record that was read from a file.

use super::{ContactFrame, HARMONIC_COUNT, Recorder};

/// Largest node number and more harmonics than any mesh has: products of them must not overflow.
const LARGEST: usize = 1 << 31;

impl Recorder {
    /// Whether every list has the length that the others ask for, so that observing and drawing find what they expect.
    pub fn is_consistent(&self) -> bool {
        let (samples, contact) = (self.rows.len(), self.contact_angles.len());
        let harmonics = HARMONIC_COUNT + self.higher_harmonics.len();
        let times: Vec<f64> = self.rows.iter().map(|row| row.time).collect();
        let probes_fit = self.probes.len() == self.probe_rows.len()
            && self.probes.iter().all(|node| (1..LARGEST).contains(node))
            && self.probe_rows.iter().all(|rows| rows.len() == samples);
        let axial_fits = self.axial_rows.is_empty()
            || self.axial_rows.len() == self.probes.len()
                && self.axial_rows.iter().all(|rows| rows.len() == samples);
        let raw_fits = self.raw_accelerations.as_ref().is_none_or(|raw| {
            raw.len() == self.probes.len() && raw.iter().all(|rows| rows.len() == samples)
        });
        let of_edge = |frame: &ContactFrame| {
            [frame.status.len(), frame.pressure.len()] == [contact; 2]
                && [contact, contact.saturating_mul(2)].contains(&frame.shears.len())
                && frame.status.iter().all(|&code| code <= 2)
        };
        let snapshots_fit = self.snapshots.iter().all(|snapshot| {
            snapshot.time.is_finite()
                && snapshot.displacement.len() == snapshot.velocity.len()
                && of_edge(&snapshot.contact)
                && snapshot.gap.len() == contact
        });
        samples > 0
            && times.windows(2).all(|pair| pair[0] < pair[1])
            && times.iter().all(|time| time.is_finite())
            && probes_fit
            && axial_fits
            && raw_fits
            && self.frames.iter().all(of_edge)
            && self.sample_interval > 0.0
            && self.sample_interval.is_finite()
            && snapshots_fit
            && self.frame_stride > 0
            && self.higher_harmonics.iter().all(|&n| n < LARGEST)
            && self.tributary_lengths.len() == contact
            && self.waves.len() == contact.saturating_mul(harmonics)
            && self.higher_amplitudes.len() == samples.saturating_mul(self.higher_harmonics.len())
    }

    /// Whether probes, fields and contact nodes can be those of a mesh of `dofs`, some `components` to a node.
    pub fn fits(&self, dofs: usize, components: usize, contact_nodes: usize) -> bool {
        let across = if components == 3 { contact_nodes } else { 0 };
        let snapshots = || self.snapshots.iter();
        let mut frames = self.frames.iter().chain(snapshots().map(|snapshot| &snapshot.contact));
        self.contact_angles.len() == contact_nodes
            && self.probes.iter().all(|&probe| probe * components <= dofs)
            && frames.all(|frame| frame.shear_across().len() == across)
            && snapshots().all(|snapshot| snapshot.displacement.len() == dofs)
    }
}
