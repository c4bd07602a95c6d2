//! The observer that keeps what results need.

mod consistency;
mod observation;

use super::{
    CentralDifference, ContactPowers, StatusCounts, StepPlan, SteppedBody, TransientError,
    TransientModel,
};
use crate::contact::ContactInterface;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::ops::Range;

/// Harmonics of the contact edge that every sample holds, `n = 0..=8`.
pub const HARMONIC_COUNT: usize = 9;

/// Highest harmonic that is followed although no perturbation names it: the third superharmonic of `n = 8`.
const HIGHEST_FOLLOWED: usize = 24;

/// Share of the largest harmonic above which one matters.
const SIGNIFICANT_SHARE: f64 = 1e-3;

/// What to keep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecorderSettings {
    /// Probe nodes, 1-based.
    pub probes: Vec<usize>,
    /// Times of whole fields, s; each is moved to the nearest sample.
    pub snapshots: Vec<f64>,
    /// Time between contact frames, s, moved to a multiple of the sample interval; `None` for every sample of a short
    /// run, every second, fourth ... of a longer one.
    pub contact_interval: Option<f64>,
    /// Whether to keep the acceleration of the sampled step as well as its mean.
    pub raw_acceleration: bool,
    /// Whether to stop where the run has settled.
    pub stop_when_settled: bool,
}

/// Energies, powers and statuses of one sample, for each metre of thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SampleRow {
    /// `t_n`, s.
    pub time: f64,
    /// Kinetic energy `1/2 v^T M v` at `n + 1/2`, J/m.
    pub kinetic_energy: f64,
    /// Strain energy `1/2 u_{n+1}^T K u_n`, J/m.
    pub strain_energy: f64,
    /// Energy of the springs of a compliant contact at `n + 1/2`, J/m.
    pub contact_energy: f64,
    /// Contact powers, means over the steps since the last sample, W/m.
    pub powers: ContactPowers,
    /// Power of material damping `v_n^T C v_{n-1/2}`, mean over the steps since the last sample, W/m.
    pub material_damping: f64,
    /// Node statuses counted over the steps since the last sample.
    pub counts: StatusCounts,
    /// Energy that is not accounted for, `|E_{n+1/2} - E_{-1/2} - work|` relative to the largest so far.
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
    /// The contact edge at the same step.
    pub contact: ContactFrame,
    /// Distance of each contact node from the cylinder, m; negative by round-off.
    pub gap: Vec<f64>,
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
    /// Contact shear `T / w`, Pa, of all nodes along the sliding; then, on a body in three dimensions, of all nodes across it.
    pub shears: Vec<f32>,
}

impl ContactFrame {
    /// Contact shear along the sliding, Pa.
    pub fn shear(&self) -> &[f32] {
        self.shears.get(..self.status.len()).unwrap_or_default()
    }

    /// Contact shear across the sliding, along `e_z` on the inner edge and `e_r` on the top, Pa; empty in the plane.
    pub fn shear_across(&self) -> &[f32] {
        self.shears.get(self.status.len()..).unwrap_or_default()
    }
}

/// Of a probe whose frame has the axes of its report.
const UNTURNED: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Keeps samples, probes, contact frames and snapshots in memory; can be saved and loaded with the state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorder {
    /// Probe nodes, 1-based.
    pub probes: Vec<usize>,
    /// From each probe's frame to the axes of its report, row by row.
    probe_turns: Vec<[[f64; 3]; 3]>,
    /// One row for each sample.
    pub rows: Vec<SampleRow>,
    /// For each probe and sample `u_r, u_t` (m), `v_r, v_t` (m/s), and the mean of `a_r, a_t` (m/s2) since the last
    /// sample, `(v_n - v_{n-1}) / interval`. An impact of one step, as a contact node has it, is in that mean whenever it
    /// comes; the acceleration of the sampled step alone shows it or not by chance.
    pub probe_rows: Vec<Vec<[f64; 6]>>,
    /// For each probe of a body in three dimensions and each sample `u_z` (m), `v_z` (m/s), the mean of `a_z` since the last
    /// sample and that of the sampled step (m/s2); empty in the plane.
    pub axial_rows: Vec<Vec<[f64; 4]>>,
    /// Acceleration `a_r, a_t` of the sampled step of each probe, m/s2, where it is asked for.
    pub raw_accelerations: Option<Vec<Vec<[f64; 2]>>>,
    /// Contact edge over time.
    pub frames: Vec<ContactFrame>,
    /// Samples from one frame to the next.
    pub frame_stride: u64,
    is_stride_given: bool,
    /// Time between samples, s.
    pub sample_interval: f64,
    /// Fields at the snapshot times reached so far.
    pub snapshots: Vec<Snapshot>,
    snapshot_indices: BTreeSet<u64>,
    tributary_lengths: Vec<f64>,
    /// Angle of each contact node, rad.
    pub contact_angles: Vec<f64>,
    /// Harmonics above 8 that are followed too: up to 24 where the mesh holds them, and those of the perturbation.
    pub higher_harmonics: Vec<usize>,
    /// Their amplitudes as in [`SampleRow::harmonics`], sample by sample, m.
    higher_amplitudes: Vec<[f32; 2]>,
    /// `cos` and `sin` of `n theta_j`, weighted; node by node, harmonics rising.
    waves: Vec<[f64; 2]>,
    /// Sense of rotation of the cylinder, +1 counter-clockwise.
    pub rotation_direction: f64,
    /// Speed of its surface, m/s.
    pub surface_speed: f64,
    /// Its expansion, m.
    pub interference: f64,
    /// When the perturbation is added, s.
    pub seed_time: f64,
    /// When the cylinder is fully expanded and the perturbation added, s.
    pub start_up_time: f64,
    pub(super) stop_when_settled: bool,
    /// Whether it stopped the run because that had settled.
    pub has_stopped: bool,
    /// Steps in which the forces between two bodies had not converged when their sweeps ended.
    pub unconverged_steps: u64,
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
        let components = run.model().components();
        let count = run.operator().dof_count() / components;
        let mut nodes = settings.probes.iter(); // Probes are nodes of the mesh, by their numbers from 1.
        if let Some(&probe) = nodes.find(|&&node| node == 0 || node > count) {
            let problem = format!(" holds {probe}: the mesh has nodes 1 to {count}");
            return Err(TransientError::setting("probes", format!("1 to {count}"), problem));
        }
        // Frames of the contact are samples too, one out of some.
        let stride = settings.contact_interval.unwrap_or(0.0) / plan.sample_interval;
        let higher_harmonics =
            higher_harmonics(run.model().highest_harmonic(), &run.perturbation.harmonics());
        // Space for all samples at once where their number is known.
        let (contact, probes) = (&run.model().contact, settings.probes.len());
        Ok(Self {
            probes: settings.probes.clone(),
            probe_turns: probe_turns(run.model(), &settings.probes),
            rows: Vec::with_capacity(plan.samples as usize),
            probe_rows: vec![Vec::with_capacity(plan.samples as usize); probes],
            axial_rows: vec![Vec::new(); if components == 3 { probes } else { 0 }],
            raw_accelerations: settings.raw_acceleration.then(|| vec![Vec::new(); probes]),
            frames: Vec::new(),
            frame_stride: (stride.round() as u64).max(1),
            is_stride_given: settings.contact_interval.is_some(),
            sample_interval: plan.sample_interval,
            snapshots: Vec::new(),
            snapshot_indices: snapshot_indices(plan, &settings.snapshots)?,
            tributary_lengths: interface.tributary_lengths.clone(),
            contact_angles: interface.angles.clone(),
            waves: waves(interface, &higher_harmonics),
            higher_harmonics,
            higher_amplitudes: Vec::new(),
            rotation_direction: contact.sliding_direction(),
            surface_speed: interface.surface_speed(contact.rotation_speed),
            interference: contact.interference,
            seed_time: run.perturbation.time,
            start_up_time: run.perturbation.time.max(run.expansion_time),
            stop_when_settled: settings.stop_when_settled,
            has_stopped: false,
            unconverged_steps: 0,
        })
    }

    /// Takes a saved record up again for a run that goes on, which may last longer than the one it was saved by.
    ///
    /// # Errors
    /// As [`Self::new`]; [`TransientError::ForeignRecord`] for a record that does not belong to `run` or is not whole.
    pub fn resume(
        mut self,
        run: &CentralDifference<'_>,
        settings: &RecorderSettings,
    ) -> Result<Self, TransientError> {
        let fresh = Self::new(run, settings)?;
        let dofs = run.operator().dof_count();
        let done = run.steps_done().div_ceil(run.plan().steps_per_sample) as usize;
        let is_whole = self.rows.len() == done
            && self.is_consistent()
            && self.fits(dofs, run.model().components(), fresh.contact_angles.len())
            && self.probes == fresh.probes
            && self.axial_rows.len() == fresh.axial_rows.len()
            && self.raw_accelerations.is_some() == fresh.raw_accelerations.is_some()
            && self.higher_harmonics == fresh.higher_harmonics
            && self.is_stride_given == fresh.is_stride_given
            && (!self.is_stride_given || self.frame_stride == fresh.frame_stride);
        if !is_whole {
            return Err(TransientError::ForeignRecord);
        }
        // What the run was made with stays; what is asked of it from here on is new.
        let rest = fresh.rows.capacity().saturating_sub(done);
        self.rows.reserve(rest);
        self.probe_rows.iter_mut().for_each(|rows| rows.reserve(rest));
        self.snapshot_indices = fresh.snapshot_indices;
        self.tributary_lengths = fresh.tributary_lengths;
        self.contact_angles = fresh.contact_angles;
        self.waves = fresh.waves;
        self.probe_turns = fresh.probe_turns;
        self.stop_when_settled = fresh.stop_when_settled;
        self.has_stopped &= self.stop_when_settled;
        Ok(self)
    }

    /// Whether the contact has springs or dashpots, whose energy and losses belong to the balance.
    pub fn has_contact_springs(&self) -> bool {
        let mut rows = self.rows.iter();
        rows.any(|row| row.contact_energy != 0.0 || row.powers.damping != 0.0)
    }

    /// Whether pressures on boundaries do work.
    pub fn has_pressures(&self) -> bool {
        self.rows.iter().any(|row| row.powers.pressure != 0.0)
    }

    /// Share of the steps of nodes in contact that could have ended in stick and in slip alike, since friction falls
    /// faster with speed than their inertia allows; `None` where there is none.
    pub fn ambiguous_share(&self) -> Option<f64> {
        let sum =
            |of: fn(&StatusCounts) -> u64| self.rows.iter().map(|row| of(&row.counts)).sum::<u64>();
        let ambiguous = sum(|counts| counts.ambiguous);
        let all = sum(|counts| counts.stick + counts.slip);
        (ambiguous > 0).then(|| ambiguous as f64 / all as f64)
    }

    /// Harmonics that are followed.
    pub fn followed_harmonics(&self) -> impl Iterator<Item = usize> + '_ {
        (0..HARMONIC_COUNT).chain(self.higher_harmonics.iter().copied())
    }

    /// Amplitude of a followed harmonic at a sample, real and imaginary part, m; `None` for one that is not followed.
    pub fn amplitude(&self, sample: usize, harmonic: usize) -> Option<[f64; 2]> {
        if harmonic < HARMONIC_COUNT {
            return Some(self.rows[sample].harmonics[harmonic]);
        }
        let followed = &self.higher_harmonics;
        let place = followed.iter().position(|&n| n == harmonic)?;
        let amplitude = self.higher_amplitudes[sample * followed.len() + place];
        Some(amplitude.map(f64::from))
    }

    /// Harmonics `0..=8`, and the higher ones that reach a thousandth of the largest of `n >= 1` at any time.
    pub fn significant_harmonics(&self) -> Vec<usize> {
        let largest = |harmonic: usize| {
            let amplitudes = (0..self.rows.len()).filter_map(|k| self.amplitude(k, harmonic));
            amplitudes.fold(0.0_f64, |m, [re, im]| m.max(re.hypot(im)))
        };
        let higher = self.significant(largest).into_iter().map(|own| own.0);
        (0..HARMONIC_COUNT).chain(higher.filter(|n| *n >= HARMONIC_COUNT)).collect()
    }

    /// The followed harmonics `n >= 1` of which a size is above a thousandth of the largest.
    pub(super) fn significant(&self, size: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let sizes = self.followed_harmonics().skip(1).map(|n| (n, size(n)));
        let mut sizes: Vec<(usize, f64)> = sizes.collect();
        let limit = SIGNIFICANT_SHARE * sizes.iter().fold(0.0, |m: f64, (_, a)| m.max(*a));
        sizes.retain(|(_, a)| *a > 0.0 && *a >= limit);
        sizes
    }

    /// Largest amplitude of the harmonics `0..=8` over some samples, or the expansion of the cylinder where that is larger, m.
    pub fn largest_motion(&self, samples: Range<usize>) -> f64 {
        let amplitudes = self.rows[samples].iter().flat_map(|row| row.harmonics);
        amplitudes.fold(self.interference.abs(), |m, [re, im]| m.max(re.hypot(im)))
    }
}

/// What takes each probe's motion from its frame to the axes of its report: of solid bodies x, y, z.
fn probe_turns(model: &TransientModel<'_>, probes: &[usize]) -> Vec<[[f64; 3]; 3]> {
    let turn = |&probe: &usize| match &model.body {
        SteppedBody::Plane { mesh, .. } => {
            let reported = mesh.reported_angle(probe - 1);
            let (sin, cos) = (mesh.frame_angles()[probe - 1] - reported).sin_cos();
            [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]
        }
        SteppedBody::Revolution { .. } => UNTURNED,
        SteppedBody::Assembly { assembly, .. } => assembly.mesh.frame(probe - 1).transpose().into(),
    };
    probes.iter().map(turn).collect()
}

/// Sample nearest to each snapshot time.
fn snapshot_indices(plan: &StepPlan, times: &[f64]) -> Result<BTreeSet<u64>, TransientError> {
    let index = |time: &f64| {
        let index = (time / plan.sample_interval).round();
        if index >= 0.0 && index < plan.samples as f64 {
            return Ok(index as u64);
        }
        let fitting = format!("0 to {}", plan.end_time());
        let problem = format!(" holds {time} s: the run covers {fitting} s");
        Err(TransientError::setting("snapshots", fitting, problem))
    };
    times.iter().map(index).collect()
}

/// Harmonics above 8 to follow on an edge that holds them up to `limit`.
fn higher_harmonics(limit: usize, seeded: &[usize]) -> Vec<usize> {
    let usual = HARMONIC_COUNT..=HIGHEST_FOLLOWED.min(limit);
    let beyond = |n: &usize| *n > HIGHEST_FOLLOWED && *n <= limit;
    let all: BTreeSet<usize> = usual.chain(seeded.iter().copied().filter(beyond)).collect();
    all.into_iter().collect()
}

/// `cos` and `sin` of each harmonic at each contact node, times the weight of its amplitude.
fn waves(interface: &ContactInterface, higher: &[usize]) -> Vec<[f64; 2]> {
    let total: f64 = interface.tributary_lengths.iter().sum();
    let nodes = interface.angles.iter().zip(&interface.tributary_lengths);
    nodes
        .flat_map(|(angle, length)| {
            (0..HARMONIC_COUNT).chain(higher.iter().copied()).map(move |harmonic| {
                let scale = if harmonic == 0 { 1.0 } else { 2.0 } / total;
                let (sin, cos) = (harmonic as f64 * angle).sin_cos();
                [scale * length * cos, scale * length * sin]
            })
        })
        .collect()
}
