//! A motion of two frequencies: powers, statuses, amplitudes, fields.

use super::super::limit_cycle::{CyclePowers, EdgeMotion, powers};
use super::super::state::WaveState;
use super::TwoWaves;
use crate::linalg::c64;
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
        let wave = self.wave();
        let edge = EdgeMotion::of(&wave, &state);
        let points = edge.points(&wave, &state);
        let count = wave.points() as f64;
        let own = |phase: usize| edge.displacement[wave.first(phase)][1].norm();
        TwoWaveMotion {
            amplitudes: [0, 1].map(|phase| 2.0 / count * own(phase)),
            powers: powers(&wave, &state, &edge, &points),
            fractions: state.fractions(),
            state,
        }
    }

    /// Displacement (m) and velocity (m/s) over all dofs of the mesh, `rays` nodes on each of so many sectors, in nodal frames, at
    /// a time (s).
    pub fn field(
        &self,
        motion: &TwoWaveMotion,
        time: f64,
        [rays, sectors]: [usize; 2],
    ) -> [Vec<f64>; 2] {
        let (wave, state) = (self.wave(), &motion.state);
        let edge = EdgeMotion::of(&wave, state);
        let mut fields = [0, 1].map(|_| vec![0.0; 2 * rays * sectors]);
        for (k, (u, &rate)) in edge.displacement.iter().zip(&edge.rates).enumerate() {
            let share = if k == 0 { 1.0 } else { 2.0 } / wave.points() as f64;
            let amplitude = u.map(|value| value * share);
            let profile = wave.profile(k, rate, &state.point.damping, amplitude);
            let later = wave.phase(k, state.frequencies()) * time;
            let around = wave.circumferential(k, self.harmonics);
            for sector in 0..sectors {
                // Whole turns taken out first, so that high harmonics lose no digits.
                let turns = (around * sector as isize).rem_euclid(sectors as isize);
                let turn = c64::from_polar(1.0, TAU * turns as f64 / sectors as f64 + later);
                for (i, value) in profile.iter().enumerate() {
                    for component in 0..2 {
                        let dof = 2 * (sector * rays + i) + component;
                        let amplitude = value[component] * turn;
                        fields[0][dof] += amplitude.re;
                        fields[1][dof] += (amplitude * rate).re;
                    }
                }
            }
        }
        fields
    }
}
