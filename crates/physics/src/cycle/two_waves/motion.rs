//! A motion of two frequencies: powers, statuses, amplitudes, fields.

use super::super::field::field;
use super::super::limit_cycle::{CyclePowers, powers};
use super::super::state::WaveState;
use super::TwoWaves;
use std::f64::consts::TAU;

/// A motion of two rotating waves, for each metre of thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoWaveMotion {
    /// Contact forces over both phases, frequencies, operating point.
    pub state: WaveState,
    /// Amplitudes of the waves' own harmonics of the edge's tangential displacement, m.
    pub amplitudes: [f64; 2],
    /// Mean powers.
    pub powers: CyclePowers,
    /// Fractions of the contact edge that `[stick, slip, open]`, over time.
    pub fractions: [f64; 3],
}

impl TwoWaveMotion {
    /// Both frequencies, Hz.
    pub fn frequencies_hz(&self) -> [f64; 2] {
        self.state.frequencies().map(|omega| omega / TAU)
    }
}

impl TwoWaves {
    /// Reads a converged state.
    pub(super) fn motion(&self, state: WaveState) -> TwoWaveMotion {
        let wave = &self.wave;
        let edge = wave.displacements(&state);
        let count = wave.points() as f64;
        let own = |phase: usize| edge[wave.first(phase)][1].norm();
        TwoWaveMotion {
            amplitudes: [0, 1].map(|phase| 2.0 / count * own(phase)), // Unscaled transform, both signs of the harmonic.
            powers: powers(wave, &state, &edge),
            fractions: state.fractions(),
            state,
        }
    }

    /// Displacement (m) and velocity (m/s) over all dofs of the mesh, in nodal frames, at a time (s).
    pub fn field(&self, motion: &TwoWaveMotion, time: f64) -> [Vec<f64>; 2] {
        field(&self.wave, &motion.state, self.harmonics, time)
    }
}
