//! What a limit cycle is, in the summary and in its tables and figures.

use super::name::CycleName;
use super::verdicts::Perturbation;
use crate::finding::finding;
use crate::summary::{MeanPowers, StatusFractions};
use frictionsim_output::Described;
use frictionsim_physics::contact::ContactStatus;
use frictionsim_physics::cycle::PhasePoint;
use frictionsim_physics::cycle::periodic::{MotionFrame, MotionHarmonic, Sound};
use serde::Serialize;

/// A limit cycle.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct CycleMotion {
    /// Frequency, Hz.
    pub main_frequency_hz: f64,
    /// Fractions of the contact nodes.
    pub status: StatusFractions,
    /// Mean powers.
    pub power_w: MeanPowers,
    /// Residual of the energy balance, relative to the external power.
    pub balance_residual: f64,
    /// Amplitude along the counterface, m: of the wave's own harmonic. On other bodies half the range of the contact
    /// node that moves most.
    pub amplitude_m: Option<f64>,
    /// Level of the velocity, root mean square over time and mass, over 5e-8 m/s, dB.
    pub velocity_level_db: Option<f64>,
    /// Amplitudes along the counterface, m: of a wave the harmonics 0 to 8 around the contact edge. On other bodies the
    /// harmonics 1, 2, ... in time, root mean square over the contact nodes.
    pub harmonics: Vec<f64>,
    /// What else there is to a motion that was stepped in time.
    #[serde(flatten)]
    pub stepped: Option<SteppedMotion>,
}

/// A motion of the whole mesh that was stepped in time.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct SteppedMotion {
    /// What the motion misses its start by after a period, relative to its amplitude.
    pub residual: f64,
    /// Periods stepped to find it.
    pub periods: usize,
    /// Steps of a period.
    pub steps: usize,
    /// Label of the contact node that moves most along the counterface.
    pub contact_node: usize,
    /// Velocity of a kick that tips stable sliding into this cycle: `2 pi f` times the amplitude of the unstable cycle
    /// between both, m/s.
    pub kick_velocity: Option<f64>,
    /// Estimate of the sound that it radiates, of a body with flat faces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sound: Option<Sound>,
    /// Harmonics in which the motion is told.
    pub harmonic_count: usize,
    /// Share of the vibration of the contact nodes that these leave.
    pub harmonic_remainder: f64,
    /// Harmonics that leave less than a thousandth.
    #[serde(skip)]
    pub harmonics_needed: usize,
}

/// One limit cycle over its period.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MotionRecord {
    /// What leads to it.
    pub name: CycleName,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Contact and motion over the period: of the contact node that moves most, of a wave of any.
    pub history: Vec<PhasePoint>,
    /// All contact nodes at time zero, of a wave along the phase.
    pub edge: Vec<PhasePoint>,
    /// All contact nodes over the period; none of a wave.
    pub instants: Vec<Vec<PhasePoint>>,
    /// Contact node that moves most, among those of the edge.
    pub node: usize,
    /// Speed of the counterface there, m/s.
    pub counterface_speed: f64,
    /// Friction coefficient there; none where it falls with the slip speed.
    pub friction_coefficient: Option<f64>,
    /// What each contact node does over the period; none of a wave.
    pub nodes: Vec<ContactNode>,
    /// The harmonics in time in which it is told; none of a wave.
    pub harmonics: Vec<MotionHarmonic>,
    /// The whole body at times over the period, from zero on, where it is known.
    pub frames: Vec<MotionFrame>,
    /// Its exponents or multipliers, where they are known; those of waves with the value of the parameter of the
    /// branch.
    pub exponents: Option<Vec<(Option<f64>, Perturbation)>>,
}

finding! {
    /// A contact node over the period.
    #[derive(Clone, Debug, PartialEq)]
    ContactNode, CONTACT_NODES {
        node: usize = "number of the node";
        x_m: f64 = "its place";
        y_m: f64 = "its place";
        z_m: f64 = "its place, of bodies in three dimensions";
        stick: f64 = "share of the period in which it sticks";
        slip: f64 = "share in which it slips";
        open: f64 = "share in which it is open";
        mean_pressure_pa: f64 = "mean contact pressure";
        mean_shear_pa: f64 = "mean contact shear";
        amplitude_n_m: f64 = "half the range of its displacement along the normal";
        amplitude_t_m: f64 = "half the range along the counterface";
    }
}

impl MotionRecord {
    /// Whether it is a wave of a disc.
    pub(super) fn is_wave(&self) -> bool {
        self.name.wave().is_some()
    }

    /// Nodal diameters of a wave; 0 of a motion of the whole mesh.
    pub(super) fn diameters(&self) -> usize {
        self.name.wave().map_or(0, |wave| wave.harmonic)
    }

    /// Whose it is: `2 nodal diameters`, or its frequency.
    pub(super) fn whose(&self) -> String {
        match &self.name {
            CycleName::Wave(wave) => format!("{} nodal diameters", wave.harmonic),
            CycleName::Mode(_) => format!("{:.2} Hz", self.frequency_hz),
        }
    }

    /// The heading of its pictures.
    pub(super) fn heading(&self) -> String {
        let name = match &self.name {
            CycleName::Wave(wave) => format!("*n* = {}", wave.harmonic),
            CycleName::Mode(own) => own.mode.to_string(),
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
