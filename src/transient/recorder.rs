//! The observer that keeps what results need.

use super::{
    CentralDifference, ContactPowers, Observer, Sample, StatusCounts, TransientError,
    settings::StepPlan,
};
use crate::contact::ContactInterface;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Harmonics of the contact edge that are followed, `n = 0..=8`.
pub const HARMONIC_COUNT: usize = 9;

/// Contact frames kept at most; longer runs keep every second, third ... sample.
const FRAME_LIMIT: u64 = 5000;

/// What to keep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecorderSettings {
    /// Probe nodes, 1-based.
    pub probes: Vec<usize>,
    /// Times of whole fields, s; each is moved to the nearest sample.
    pub snapshots: Vec<f64>,
}

/// Energies, powers and statuses of one sample, for each metre of thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SampleRow {
    /// `t_n`, s.
    pub time: f64,
    /// Kinetic energy at `n + 1/2`, J/m.
    pub kinetic_energy: f64,
    /// Strain energy at `n + 1/2`, J/m.
    pub strain_energy: f64,
    /// Contact powers, means since the last sample, W/m.
    pub powers: ContactPowers,
    /// Power of material damping, mean since the last sample, W/m.
    pub material_damping: f64,
    /// Node statuses since the last sample.
    pub counts: StatusCounts,
    /// Energy that is not accounted for, relative to the largest so far.
    pub balance_residual: f64,
    /// `2 / sum w * sum_j w_j u_theta(theta_j) exp(-i n theta_j)` along the contact edge for `n = 0..=8` (half of it
    /// for `n = 0`), real and imaginary part, m.
    pub harmonics: [[f64; 2]; HARMONIC_COUNT],
}

/// Whole displacement and velocity fields at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// `t_n`, s.
    pub time: f64,
    /// `u_n` over all dofs in nodal frames, m.
    pub displacement: Vec<f64>,
    /// `v_n` over all dofs in nodal frames, m/s.
    pub velocity: Vec<f64>,
}

/// The contact edge at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactFrame {
    /// `t_n`, s.
    pub time: f64,
    /// [`crate::contact::ContactStatus`] of each node as a number.
    pub status: Vec<u8>,
    /// Contact pressure `N / w`, Pa.
    pub pressure: Vec<f32>,
    /// Contact shear `T / w`, Pa.
    pub shear: Vec<f32>,
}

/// Keeps samples, probes, contact frames and snapshots in memory; can be saved and loaded with the state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorder {
    /// Probe nodes, 1-based.
    pub probes: Vec<usize>,
    /// One row for each sample.
    pub rows: Vec<SampleRow>,
    /// For each probe and sample `u_r, u_t` (m), `v_r, v_t` (m/s), `a_r, a_t` (m/s2).
    pub probe_rows: Vec<Vec<[f64; 6]>>,
    /// Contact edge over time.
    pub frames: Vec<ContactFrame>,
    /// Samples from one frame to the next.
    pub frame_stride: u64,
    /// Fields at the snapshot times reached so far.
    pub snapshots: Vec<Snapshot>,
    snapshot_indices: Vec<u64>,
    tributary_lengths: Vec<f64>,
    /// Angle of each contact node, rad.
    pub contact_angles: Vec<f64>,
    /// `cos` and `sin` of `n theta_j`, weighted; by harmonic.
    waves: Vec<Vec<[f64; 2]>>,
    /// Sense of rotation of the cylinder, +1 counter-clockwise.
    pub rotation_direction: f64,
}

impl Recorder {
    /// An empty record of `run`.
    ///
    /// # Errors
    /// [`TransientError`] for a probe that is no node or a snapshot outside the run.
    pub fn new(
        run: &CentralDifference<'_>,
        settings: &RecorderSettings,
    ) -> Result<Self, TransientError> {
        let (plan, interface) = (run.plan(), run.interface());
        let count = run.operator().dof_count() / 2;
        let mut nodes = settings.probes.iter();
        if let Some(&probe) = nodes.find(|&&node| node == 0 || node > count) {
            return Err(TransientError::UnknownProbe { probe, count });
        }
        Ok(Self {
            probes: settings.probes.clone(),
            rows: Vec::with_capacity(plan.samples as usize),
            probe_rows: vec![Vec::with_capacity(plan.samples as usize); settings.probes.len()],
            frames: Vec::new(),
            frame_stride: plan.samples.div_ceil(FRAME_LIMIT).max(1),
            snapshots: Vec::new(),
            snapshot_indices: snapshot_indices(plan, &settings.snapshots)?,
            tributary_lengths: interface.tributary_lengths.clone(),
            contact_angles: interface.angles.clone(),
            waves: (0..HARMONIC_COUNT).map(|n| wave(interface, n)).collect(),
            rotation_direction: run.model().contact.sliding_direction(),
        })
    }

    fn harmonics(&self, sample: &Sample<'_>) -> [[f64; 2]; HARMONIC_COUNT] {
        let mut amplitudes = [[0.0; 2]; HARMONIC_COUNT];
        for i in 0..self.contact_angles.len() {
            let u = sample.contact_tangential_displacement(i);
            for (amplitude, wave) in amplitudes.iter_mut().zip(&self.waves) {
                amplitude[0] += u * wave[i][0];
                amplitude[1] -= u * wave[i][1];
            }
        }
        amplitudes
    }

    fn frame(&self, sample: &Sample<'_>) -> ContactFrame {
        let traction = |forces: &[f64]| {
            let pairs = forces.iter().zip(&self.tributary_lengths);
            pairs
                .map(|(force, length)| (force / length) as f32)
                .collect()
        };
        ContactFrame {
            time: sample.time,
            status: sample.status().iter().map(|&status| status as u8).collect(),
            pressure: traction(sample.normal_force()),
            shear: traction(sample.tangential_force()),
        }
    }
}

impl Observer for Recorder {
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()> {
        self.rows.push(SampleRow {
            time: sample.time,
            kinetic_energy: sample.kinetic_energy,
            strain_energy: sample.strain_energy,
            powers: sample.powers,
            material_damping: sample.material_damping,
            counts: sample.counts,
            balance_residual: sample.balance_residual,
            harmonics: self.harmonics(sample),
        });
        for (&node, rows) in self.probes.iter().zip(&mut self.probe_rows) {
            let (r, t) = (2 * (node - 1), 2 * (node - 1) + 1);
            rows.push([
                sample.displacement_at(r),
                sample.displacement_at(t),
                sample.velocity_at(r),
                sample.velocity_at(t),
                sample.acceleration_at(r),
                sample.acceleration_at(t),
            ]);
        }
        if sample.index.is_multiple_of(self.frame_stride) {
            self.frames.push(self.frame(sample));
        }
        if self.snapshot_indices.contains(&sample.index) {
            self.snapshots.push(Snapshot {
                time: sample.time,
                displacement: sample.displacement(),
                velocity: sample.velocity(),
            });
        }
        ControlFlow::Continue(())
    }
}

/// Sample nearest to each snapshot time, ascending.
fn snapshot_indices(plan: &StepPlan, times: &[f64]) -> Result<Vec<u64>, TransientError> {
    let mut indices = Vec::new();
    for &time in times {
        let index = (time / plan.sample_interval).round();
        if !(index >= 0.0 && index < plan.samples as f64) {
            let duration = plan.end_time();
            return Err(TransientError::SnapshotOutsideRun { time, duration });
        }
        indices.push(index as u64);
    }
    indices.sort_unstable();
    indices.dedup();
    Ok(indices)
}

fn wave(interface: &ContactInterface, harmonic: usize) -> Vec<[f64; 2]> {
    let total: f64 = interface.tributary_lengths.iter().sum();
    let scale = if harmonic == 0 { 1.0 } else { 2.0 } / total;
    let nodes = interface.angles.iter().zip(&interface.tributary_lengths);
    nodes
        .map(|(angle, length)| {
            let (sin, cos) = (harmonic as f64 * angle).sin_cos();
            [scale * length * cos, scale * length * sin]
        })
        .collect()
}
