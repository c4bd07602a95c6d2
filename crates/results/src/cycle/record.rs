//! What the tables and figures of a limit cycle show.

use super::branch::{BranchRecord, BranchRows, FamilyRecord};
use super::summary::{CycleName, OnsetSummary, SoughtCycle};
use super::verdicts::Perturbation;
use crate::extent::Extent;
use frictionsim_physics::contact::ContactStatus;
use frictionsim_physics::cycle::PhasePoint;
use frictionsim_physics::cycle::periodic::MotionHarmonic;

impl FamilyRecord {
    /// Of a cycle that was sought and the rows of its branch.
    pub(super) fn of(own: SoughtCycle, rows: Option<BranchRows>, extent: Extent) -> Self {
        let onset = |own: &OnsetSummary| [own.critical_friction, own.frequency_hz];
        let (harmonic, onset, mode, onsets) = match &own.name {
            CycleName::Wave(own) => {
                (own.harmonic, own.onset, None, own.onsets.iter().map(onset).collect())
            }
            CycleName::Mode(own) => (0, 0, Some(own.mode.mode), Vec::new()),
        };
        let cycle =
            own.cycle.map(|own| [own.main_frequency_hz, own.amplitude_m.unwrap_or(f64::NAN)]);
        let branch = own.branch.zip(rows);
        let branch = branch.map(|(summary, rows)| BranchRecord::of(summary, &rows, extent));
        Self { harmonic, onset, mode, onsets, cycle, branch }
    }
}

/// One limit cycle.
pub(super) struct MotionRecord {
    /// Part of a file name: `n2` or `mode15`.
    pub tag: String,
    /// Nodal diameters of a wave; 0 of a motion of the whole mesh.
    pub diameters: usize,
    /// Number of the mode that leads to a motion of the whole mesh; 0 of a wave.
    pub mode: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Contact and motion over the period: of the contact node that moves most, of a wave of any.
    pub history: Vec<PhasePoint>,
    /// All contact nodes at time zero, of a wave along the phase.
    pub edge: Vec<PhasePoint>,
    /// Statuses of all contact nodes, instant by instant; none of a wave.
    pub status: Vec<ContactStatus>,
    /// Contact node that moves most, among those of the edge.
    pub node: usize,
    /// Speed of the counterface there, m/s.
    pub counterface_speed: f64,
    /// Friction coefficient there; none where it falls with the slip speed.
    pub friction_coefficient: Option<f64>,
    /// The contact nodes over the period; none of a wave.
    pub nodes: Vec<ContactNode>,
    /// The harmonics in time in which it is told; none of a wave.
    pub harmonics: Vec<MotionHarmonic>,
    /// Displacement (m) and velocity (m/s) of every dof in nodal frames at time zero, where they are known.
    pub fields: [Vec<f64>; 2],
    /// Its exponents or multipliers, where they are known; those of waves with the value of the parameter of the
    /// branch.
    pub exponents: Option<Vec<(Option<f64>, Perturbation)>>,
    /// The cycles of its branch.
    pub branch: Option<BranchRows>,
}

/// A contact node over the period.
pub(crate) struct ContactNode {
    pub node: usize,
    pub place: [f64; 3],
    pub shares: [f64; 3],
    pub mean_pressure: f64,
    pub mean_shear: f64,
    /// Half the range of the displacement along the normal and along the counterface, m.
    pub amplitude: [f64; 2],
}

impl MotionRecord {
    /// Whether it is a wave of a disc.
    pub(super) fn is_wave(&self) -> bool {
        self.diameters > 0
    }

    /// Whose it is: `2 nodal diameters`, or its frequency.
    pub(super) fn whose(&self) -> String {
        match self.diameters {
            0 => format!("{:.2} Hz", self.frequency_hz),
            n => format!("{n} nodal diameters"),
        }
    }

    /// The heading of its pictures.
    pub(super) fn heading(&self) -> String {
        let name = match self.diameters {
            0 => format!("mode {}", self.mode),
            n => format!("*n* = {n}"),
        };
        format!("{name}, {:.2} kHz", self.frequency_hz * 1e-3)
    }

    /// Status of the node of the history, over time.
    pub(super) fn node_statuses(&self) -> Vec<ContactStatus> {
        self.history.iter().map(|row| row.status).collect()
    }

    /// One quantity of the history.
    pub(super) fn over_time(&self, of: impl Fn(&PhasePoint) -> f64) -> Vec<f64> {
        self.history.iter().map(of).collect()
    }
}
