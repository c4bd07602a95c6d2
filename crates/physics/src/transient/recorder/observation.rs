//! The part of a sample that is kept.

use super::{ContactFrame, HARMONIC_COUNT, Recorder, SampleRow, Snapshot, UNTURNED};
use crate::linalg::interruption;
use crate::transient::{Observer, Sample, Settling};
use std::ops::ControlFlow;

/// Contact frames kept at most where no interval is asked for; longer runs keep every second, fourth ... sample.
const FRAME_LIMIT: usize = 10_000;

/// Samples before a run is first asked whether it has settled, and by what factor the later questions lie apart.
const FIRST_QUESTION: u64 = 256;
const NEXT_QUESTION: f64 = 1.05;

impl Observer for Recorder {
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()> {
        let amplitudes = self.harmonics(sample);
        let higher = amplitudes[HARMONIC_COUNT..].iter();
        self.higher_amplitudes.extend(higher.map(|parts| parts.map(|part| part as f32)));
        let harmonics = std::array::from_fn(|n| amplitudes[n]);
        self.rows.push(SampleRow { harmonics, ..sample.row });
        self.unconverged_steps += sample.unconverged_steps;
        self.observe_probes(sample);
        self.observe_contact(sample);
        if self.snapshot_indices.contains(&sample.index) {
            let nodes = 0..self.contact_angles.len();
            self.snapshots.push(Snapshot {
                time: sample.row.time,
                displacement: sample.displacement(),
                velocity: sample.velocity(),
                contact: self.frame(sample),
                gap: nodes.map(|i| sample.gap(i)).collect(),
            });
        }
        let is_asked = self.stop_when_settled && is_question(sample.index);
        if is_asked && Settling::of(self).is_settled() {
            self.has_stopped = true;
            return ControlFlow::Break(());
        }
        if interruption::is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Recorder {
    /// Amplitudes of all followed harmonics, real and imaginary part, m.
    fn harmonics(&self, sample: &Sample<'_>) -> Vec<[f64; 2]> {
        let mut amplitudes = vec![[0.0; 2]; HARMONIC_COUNT + self.higher_harmonics.len()];
        // Node by node, so that the harmonics of one node are summed side by side.
        for (i, waves) in self.waves.chunks_exact(amplitudes.len()).enumerate() {
            let u = sample.contact_tangential_displacement(i);
            for (amplitude, wave) in amplitudes.iter_mut().zip(waves) {
                amplitude[0] += u * wave[0];
                amplitude[1] -= u * wave[1];
            }
        }
        amplitudes
    }

    fn frame(&self, sample: &Sample<'_>) -> ContactFrame {
        let traction = |forces: &[f64]| {
            let pairs = forces.iter().zip(&self.tributary_lengths);
            pairs.map(|(force, length)| (force / length) as f32).collect::<Vec<f32>>()
        };
        let law = sample.contact();
        ContactFrame {
            time: sample.row.time,
            status: law.status.iter().map(|&status| status as u8).collect(),
            pressure: traction(&law.normal_force),
            shears: [traction(&law.tangential_force), traction(&law.across_force)].concat(),
        }
    }

    fn observe_probes(&mut self, sample: &Sample<'_>) {
        let components = if self.axial_rows.is_empty() { 2 } else { 3 };
        for (place, &node) in self.probes.iter().enumerate() {
            let turn = self.probe_turns[place];
            let reported = |of: &dyn Fn(usize) -> f64| {
                let mut own = [0.0; 3];
                (0..components).for_each(|c| own[c] = of(components * (node - 1) + c));
                // Equal frames leave every bit as it is.
                match turn == UNTURNED {
                    true => own,
                    false => turn.map(|[a, b, c]| a * own[0] + b * own[1] + c * own[2]),
                }
            };
            let [u_r, u_t, u_z] = reported(&|dof| sample.displacement_at(dof));
            let [v_r, v_t, v_z] = reported(&|dof| sample.velocity_at(dof));
            let step = reported(&|dof| sample.acceleration_at(dof));
            let mean = |before: f64, after: f64| (after - before) / self.sample_interval;
            // The first sample has only its own step to be a mean of.
            let rows = &mut self.probe_rows[place];
            let [a_r, a_t] = match rows.last() {
                Some(last) => [mean(last[2], v_r), mean(last[3], v_t)],
                None => [step[0], step[1]],
            };
            rows.push([u_r, u_t, v_r, v_t, a_r, a_t]);
            if let Some(rows) = self.axial_rows.get_mut(place) {
                let a_z = rows.last().map_or(step[2], |last| mean(last[1], v_z));
                rows.push([u_z, v_z, a_z, step[2]]);
            }
            if let Some(raw) = &mut self.raw_accelerations {
                raw[place].push([step[0], step[1]]);
            }
        }
    }

    /// Keeps every frame, and from a limit on every second, fourth ...: which ones depends on the number of samples so
    /// far alone, so that a run that is extended keeps what a longer one would have kept.
    fn observe_contact(&mut self, sample: &Sample<'_>) {
        if !sample.index.is_multiple_of(self.frame_stride) {
            return;
        }
        self.frames.push(self.frame(sample));
        if self.frames.len() > FRAME_LIMIT && !self.is_stride_given {
            self.frames = std::mem::take(&mut self.frames).into_iter().step_by(2).collect();
            self.frame_stride *= 2;
        }
    }
}

/// Whether a run is asked at a sample whether it has settled: a sequence that depends on nothing but the index.
fn is_question(index: u64) -> bool {
    let next = |last: &u64| Some((*last as f64 * NEXT_QUESTION).ceil() as u64);
    std::iter::successors(Some(FIRST_QUESTION), next).find(|own| *own >= index) == Some(index)
}
