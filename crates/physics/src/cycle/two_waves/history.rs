//! What a transient of the mesh says of two waves: frequencies, phases, and the contact forces over both phases.

use super::super::field::{amplitude, slips};
use super::super::parameter::OperatingPoint;
use super::super::state::{Phase, PointState, WaveState};
use super::TwoWaves;
use crate::linalg::{c64, interruption};
use crate::signal::rotating_lines;
use crate::transient::{CentralDifference, rms};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Looks at the contact in each period of the first wave.
const LOOKS: usize = 48;
/// Share of the first wave's amplitude below which another line is no second wave.
const WEAKEST: f64 = 0.02;
/// Mean normal force, over that of all points, of a point that is open, and share of the friction limit of one that slips.
const OPEN: f64 = 0.1;
const DRAGGED: f64 = 0.8;
/// Distance, relative, of two frequencies that are one and the same.
const APART: f64 = 2e-3;

/// Two waves as a transient has them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// `omega_1, omega_2`, rad/s.
    pub frequencies: [f64; 2],
    /// Amplitudes of the tangential displacement of the edge, m.
    pub amplitudes: [f64; 2],
    /// Phases at the first look, rad.
    origins: [f64; 2],
}

/// The contact edge of a transient, look by look.
pub struct History {
    /// Time between two looks, s.
    interval: f64,
    /// Harmonics `n_1, n_2` of the tangential displacement at each look, m.
    waves: [Vec<c64>; 2],
    /// Mean normal and tangential forces of each node from one look to the next, N/m.
    forces: Vec<[Vec<f64>; 2]>,
    harmonics: [isize; 2],
}

impl History {
    /// Goes on with a transient over so many periods of `steps` steps.
    pub fn of(
        run: &mut CentralDifference<'_>,
        harmonics: [isize; 2],
        steps: usize,
        periods: usize,
    ) -> Self {
        let every = (steps / LOOKS).max(1);
        let mut history = Self {
            interval: every as f64 * run.plan().time_step,
            waves: [Vec::new(), Vec::new()],
            forces: Vec::new(),
            harmonics,
        };
        let count = run.interface().len();
        for _ in 0..periods * steps / every {
            interruption::check();
            let mut sums = [vec![0.0; count], vec![0.0; count]];
            for step in 0..every {
                run.advance();
                let law = run.contact();
                let forces = [&law.normal_force, &law.tangential_force];
                let pairs = sums.iter_mut().zip(forces);
                for (sum, force) in pairs.flat_map(|(sums, forces)| sums.iter_mut().zip(forces)) {
                    *sum += force / every as f64;
                }
                if step == every / 2 {
                    let edge = slips(run); // Amid the steps over which forces are averaged.
                    for (wave, &harmonic) in history.waves.iter_mut().zip(&harmonics) {
                        wave.push(amplitude(&edge, harmonic));
                    }
                }
            }
            history.forces.push(sums);
        }
        history
    }

    /// Frequencies, amplitudes and phases of the strongest line of the first harmonic, and of the strongest one of the second that
    /// is no multiple of it; `None` where there is no second wave.
    pub fn measured(&self) -> Option<Measured> {
        let strongest = |wave: usize, foreign: Option<f64>, weakest: f64| {
            let lines = rotating_lines(&self.waves[wave], 1.0 / self.interval, weakest);
            let mut own = lines.into_iter().filter(|line| {
                line.frequency_hz > 0.0
                    && foreign.is_none_or(|first| {
                        let multiple = (line.frequency_hz / first).round() * first; // Such lines are of the first wave.
                        (line.frequency_hz - multiple).abs() > APART * first
                    })
            });
            own.next()
        };
        let first = strongest(0, None, WEAKEST * rms(&self.waves[0]))?;
        let second = strongest(1, Some(first.frequency_hz), WEAKEST * first.amplitude)?;
        let lines = [first, second];
        let refined = [0, 1].map(|wave| self.refined(wave, TAU * lines[wave].frequency_hz));
        Some(Measured {
            frequencies: refined.map(|own| own[0]),
            amplitudes: refined.map(|own| own[1]),
            origins: refined.map(|own| own[2]),
        })
    }

    /// Frequency (rad/s), amplitude and phase of one wave near a frequency, by the drift of its phase from the first half of the
    /// looks to the second.
    fn refined(&self, wave: usize, mut frequency: f64) -> [f64; 3] {
        let series = &self.waves[wave];
        let demodulated = |frequency: f64, from: usize, count: usize| {
            let terms = (0..count).map(|i| {
                // Hann's window, so that other lines leave nothing.
                let weight = 1.0 - (TAU * (i as f64 + 0.5) / count as f64).cos();
                let turn = -frequency * self.interval * (from + i) as f64;
                series[from + i] * c64::from_polar(weight / count as f64, turn)
            });
            terms.sum::<c64>()
        };
        let half = series.len() / 2;
        for _ in 0..3 {
            let [early, late] = [0, half].map(|from| demodulated(frequency, from, half));
            frequency += (late * early.conj()).arg() / (half as f64 * self.interval); // Drift of the phase from one half to the other.
        }
        let whole = demodulated(frequency, 0, series.len()); // Weights of mean 1 leave the amplitude as it is.
        [frequency, whole.norm(), whole.arg()]
    }

    /// The forces over both phases, as a state to start from.
    pub fn state(
        &self,
        waves: &TwoWaves,
        measured: &Measured,
        point: &OperatingPoint,
    ) -> WaveState {
        let sides = waves.sides;
        let points = sides[0] * sides[1];
        let (mut sums, mut counts) = ([vec![0.0; points], vec![0.0; points]], vec![0.0; points]);
        for (look, forces) in self.forces.iter().enumerate() {
            let time = look as f64 * self.interval;
            let count = forces[0].len();
            for node in 0..count {
                let angle = TAU * node as f64 / count as f64;
                let place = [0, 1].map(|wave| {
                    let phase = self.harmonics[wave] as f64 * angle
                        + measured.frequencies[wave] * time
                        + measured.origins[wave];
                    let share = (phase / TAU).rem_euclid(1.0);
                    (share * sides[wave] as f64).round() as usize % sides[wave]
                });
                let at = place[1] * sides[0] + place[0]; // The first phase runs first.
                counts[at] += 1.0;
                sums[0][at] += forces[0][node];
                sums[1][at] += forces[1][node];
            }
        }
        let [normal, tangential] = sums.map(|sum| -> Vec<f64> {
            sum.iter().zip(&counts).map(|(sum, count)| sum / f64::max(*count, 1.0)).collect() // Where no node has been there is no force.
        });
        // Contact states as the mean forces have them.
        let scale = normal.iter().sum::<f64>() / points as f64;
        let contact = normal.iter().zip(&tangential).map(|(normal, shear)| {
            let limit = DRAGGED * point.contact.friction_coefficient * normal;
            PointState::of(*normal < OPEN * scale, *shear, limit)
        });
        let contact = contact.collect();
        let phase = |frequency: f64| Phase { frequency, origin: 0.0 }; // The places hold the origins already.
        let phases = measured.frequencies.map(phase).to_vec();
        WaveState { normal, tangential, contact, phases, point: *point }
    }
}
