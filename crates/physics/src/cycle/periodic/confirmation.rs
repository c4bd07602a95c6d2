//! A periodic motion put to the test: does a transient that starts beside it stay there?

use super::map::{PeriodMap, PeriodicState};
use super::motion::PeriodicMotion;
use crate::cycle::FloquetMultiplier;
use crate::cycle::confirmation::{Confirmation, telling_periods, turned};
use crate::cycle::field::slips;
use crate::linalg::{GaussianNoise, c64, interruption};
use std::f64::consts::TAU;

/// Length of the random perturbation at the start, relative to the amplitude.
const SEED: f64 = 0.01;
/// E-folds of a leading perturbation that may grow over which the transient runs: of a random start it is a small part.
const E_FOLDS: f64 = 8.0;

/// Largest difference between a cycle and a transient that stays on it: of the frequency and of the external power,
/// relative, and of the fractions of contact nodes.
const TOLERANCE: [f64; 3] = [1e-3, 0.02, 0.02];

impl Confirmation {
    /// Whether the transient still is on the motion.
    pub fn agrees_with(&self, motion: &PeriodicMotion) -> bool {
        let wanted = [motion.frequency_hz, motion.powers.contact.external];
        self.is_within(wanted, motion.fractions, TOLERANCE)
    }

    /// Steps the body through `least` periods or more from a cycle that is perturbed by a hundredth of its amplitude at random,
    /// and reads the last fifth.
    pub fn beside(
        map: &mut PeriodMap<'_>,
        state: &PeriodicState,
        leading: Option<&FloquetMultiplier>,
        least: usize,
    ) -> Self {
        let periods = telling_periods(leading, E_FOLDS / state.period, least);
        let start = perturbed(map, state);
        map.place(&start);
        // The last fifth: its first harmonic period by period, its powers and statuses.
        let first = periods - periods / 5;
        let mut turns: Vec<c64> = Vec::new();
        let mut weights: Vec<c64> = Vec::new();
        for period in 0..periods {
            interruption::check();
            if period == first {
                map.run.take_sums();
            }
            let amplitudes = first_harmonic(map);
            if period < first {
                continue;
            }
            // How far the motion has turned against that of the first period looked at.
            if weights.is_empty() {
                weights = amplitudes.iter().map(|a| a.conj()).collect();
            }
            turns.push(amplitudes.iter().zip(&weights).map(|(a, w)| a * w).sum());
        }
        // What the first harmonic turns by from period to period is the difference of the frequencies.
        let (powers, _, counts) = map.run.take_sums();
        let share = turned(&turns) / TAU / (turns.len() - 1).max(1) as f64;
        let steps = (periods - first) * map.steps();
        Self {
            periods,
            main_frequency_hz: Some((1.0 + share) / state.period),
            main_harmonic: None,
            status: counts.fractions(),
            external_power: powers.external / steps as f64,
            e_folds: leading.map_or(0.0, |found| found.growth_rate * periods as f64 * state.period),
        }
    }
}

/// A state with a random velocity of a hundredth of its amplitude; a first period damps what the body damps fast.
fn perturbed(map: &mut PeriodMap<'_>, state: &PeriodicState) -> PeriodicState {
    let vibration = map.image(state).vibration;
    let mut noise = GaussianNoise::new(2);
    let half = state.motion.len() / 2;
    let scale = SEED * vibration / (half as f64).sqrt();
    let mut start = state.clone();
    for value in &mut start.motion[half..] {
        *value += scale * noise.draw().re;
    }
    start
}

/// First harmonic over one period of the displacement of each contact node along the counterface.
fn first_harmonic(map: &mut PeriodMap<'_>) -> Vec<c64> {
    let mut sums = vec![c64::new(0.0, 0.0); map.run.interface().len()];
    let steps = map.steps();
    for step in 0..steps {
        map.run.advance();
        let turn = c64::from_polar(1.0, -TAU * step as f64 / steps as f64);
        sums.iter_mut().zip(slips(&map.run)).for_each(|(sum, slip)| *sum += slip * turn);
    }
    sums
}
