//! A limit cycle put to the test: does a transient that starts beside it stay there?

use super::field::{amplitude, slips};
use super::limit_cycle::LimitCycle;
use super::periodic::{Found, PeriodMap, PeriodicState};
use super::stepping::MeshStepping;
use super::{CycleError, FloquetMultiplier, FloquetMultipliers, Verdict};
use crate::linalg::{GaussianNoise, c64, interruption};
use std::f64::consts::TAU;

/// Velocity of the seed in the harmonic of the leading perturbation of a wave, in units of the slip speed.
const SEED: f64 = 0.01;
/// Length of the random perturbation of a motion of the whole mesh, relative to its amplitude.
const RANDOM_SEED: f64 = 0.01;
/// E-folds of the leading perturbation over which the transient runs: by them it grows from the seed beyond the wave; of a random start
/// it is a small part.
const E_FOLDS: f64 = 5.0;
const E_FOLDS_OF_RANDOM: f64 = 8.0;
/// Most periods that are spent on a slow perturbation.
const MOST_PERIODS: usize = 200;
/// Looks at the edge in each period, and as many half way between them for what turns fast.
const LOOKS: usize = 16;
/// Harmonics of the edge that are looked at, besides the wave's own.
const HARMONICS: usize = 8;

/// Largest difference between a wave and a transient that stays on it: of the frequency and of the external power,
/// relative, and of the fractions of contact nodes. On the coarsest meshes that carry waves of the disc (60 x 14) the
/// three are at most 0.003, 0.016 and 0.034; a wave that is no motion of the disc is left within a few periods.
const NEAR_WAVE: [f64; 3] = [0.01, 0.05, 0.1];
/// The same of a motion of the whole mesh, which the transient itself has.
const NEAR_MOTION: [f64; 3] = [1e-3, 0.02, 0.02];

/// The last fifth of a short transient that started beside a limit cycle, a wave or a motion of the whole mesh; for each metre of
/// thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confirmation {
    /// Length of the run in periods of the cycle.
    pub periods: usize,
    /// Frequency of the largest harmonic of the contact edge, or of the contact nodes, Hz; `None` if it has stopped to vibrate.
    pub main_frequency_hz: Option<f64>,
    /// That harmonic, of 1 to 8 and the wave's own; none of motions of the whole mesh.
    pub main_harmonic: Option<usize>,
    /// Fractions of contact nodes that `[stick, slip, open]`.
    pub status: [f64; 3],
    /// Power of the counterface, W/m.
    pub external_power: f64,
    /// E-folds of the leading perturbation over the run; negative where it decays, 0 where it is not known.
    pub e_folds: f64,
    /// Whether the transient still is on the cycle.
    pub agrees: bool,
}

impl Confirmation {
    /// With whether the transient still is on a cycle of this harmonic, `[frequency (Hz), power of the counterface (W/m)]` and
    /// fractions of contact nodes, within bounds to each.
    fn held_to(
        self,
        harmonic: Option<usize>,
        wanted: [f64; 2],
        fractions: [f64; 3],
        bounds: [f64; 3],
    ) -> Self {
        let found = [self.main_frequency_hz.unwrap_or(0.0), self.external_power];
        let is_near = |i: usize| (found[i] / wanted[i] - 1.0).abs() <= bounds[i];
        let mut statuses = self.status.iter().zip(fractions);
        let agrees = self.main_harmonic == harmonic
            && (0..2).all(is_near)
            && statuses.all(|(found, wanted)| (found - wanted).abs() <= bounds[2]);
        Self { agrees, ..self }
    }
}

/// Periods that tell: `least`, or as many as the leading perturbation, where it may grow, needs for so many e-folds, `e_folds`
/// divided by the period.
fn telling_periods(leading: Option<&FloquetMultiplier>, e_folds: f64, least: usize) -> usize {
    let growing = leading.filter(|own| own.verdict() != Verdict::Stable);
    let rate = growing.map(|own| own.growth_rate.abs().max(own.uncertainty)); // So many e-folds of what may grow.
    let wanted = rate.map_or(0, |rate| (e_folds / rate).ceil() as usize);
    least.max(wanted.min(MOST_PERIODS))
}

/// Angle that an amplitude turns through, rad.
fn turned(amplitudes: &[c64]) -> f64 {
    amplitudes.windows(2).map(|pair| (pair[1] * pair[0].conj()).arg()).sum() // Known where looks are closer than half a turn.
}

/// The same from looks that stand half an interval apart: from every second one where the turns between these are told without doubt.
/// A wave of harmonic 8 in a cycle of harmonic 1 turns through half a turn between them, either way.
fn turned_by_halves(looks: &[c64]) -> f64 {
    let whole: Vec<c64> = looks.iter().step_by(2).copied().collect();
    let is_slow = whole.windows(2).all(|pair| (pair[1] * pair[0].conj()).re > 0.0); // Less than a quarter turn.
    turned(if is_slow { &whole } else { looks })
}

impl MeshStepping<'_> {
    /// Steps the disc through `periods` periods or more from a cycle, seeded in the harmonic of its leading perturbation, and
    /// reads the last fifth.
    ///
    /// # Errors
    /// [`CycleError::Stepping`] if the transient cannot start.
    pub fn confirm(
        &self,
        cycle: &LimitCycle,
        stability: Option<&FloquetMultipliers>,
        periods: usize,
    ) -> Result<Confirmation, CycleError> {
        // A seed in the direction that grows fastest, and periods in which it would show.
        let leading = stability.and_then(FloquetMultipliers::leading);
        let periods = telling_periods(leading, E_FOLDS * cycle.frequency_hz(), periods);
        let surface_speed = cycle.state.point.contact.rotation_speed * self.solver.wave.body.radius;
        let mode = leading.and_then(|found| found.mode);
        let seed = mode.map(|mode| (mode.harmonic, SEED * surface_speed));
        let (mut run, steps) = self.start(cycle, seed)?;
        let look_every = (steps / LOOKS).max(2);
        let first = (periods - periods / 5) * steps;
        for _ in 0..=first {
            interruption::check();
            run.advance();
        }

        // The last fifth.
        run.take_sums();
        let counted = periods * steps - first - 1;
        let mut looks = vec![slips(&run)];
        for step in 1..=counted {
            interruption::check();
            run.advance();
            if [0, look_every / 2].contains(&(step % look_every)) {
                looks.push(slips(&run));
            }
        }
        looks.truncate((looks.len() - 1) / 2 * 2 + 1); // Whole intervals.
        let (powers, _, counts) = run.take_sums();
        let duration = (looks.len() / 2 * look_every) as f64 * run.plan().time_step;

        // The largest harmonic, if it is one.
        let highest = HARMONICS.min(run.interface().len() / 2);
        let own = (cycle.harmonic > highest).then_some(cycle.harmonic);
        let harmonics = (1..=highest).chain(own).map(|m| {
            (m, looks.iter().map(|edge| amplitude(edge, m as isize)).collect::<Vec<c64>>())
        });
        let size = |own: &[c64]| own.iter().map(|a| a.norm()).sum::<f64>() / own.len() as f64;
        let main = harmonics.max_by(|a, b| size(&a.1).total_cmp(&size(&b.1)));
        let least = 1e-4 * cycle.state.point.contact.interference;
        let main = main.filter(|(_, own)| size(own) > least);
        let turns = main.as_ref().map(|(_, own)| turned_by_halves(own).abs() / TAU);
        let found = Confirmation {
            periods,
            main_frequency_hz: turns.map(|turns| turns / duration),
            main_harmonic: main.map(|(harmonic, _)| harmonic),
            status: counts.fractions(),
            external_power: powers.external / counted as f64,
            e_folds: leading
                .map_or(0.0, |found| found.growth_rate * periods as f64 / cycle.frequency_hz()),
            agrees: false,
        };
        let wanted = [cycle.frequency_hz(), cycle.powers.contact.external];
        Ok(found.held_to(Some(cycle.harmonic), wanted, cycle.fractions, NEAR_WAVE))
    }
}

impl Confirmation {
    /// Steps the body through `least` periods or more from a cycle that is perturbed by a hundredth of its amplitude at random,
    /// and reads the last fifth.
    pub fn beside(
        map: &mut PeriodMap<'_>,
        found: &Found,
        leading: Option<&FloquetMultiplier>,
        least: usize,
    ) -> Self {
        let (state, image) = (&found.state, &found.image);
        let periods = telling_periods(leading, E_FOLDS_OF_RANDOM / state.period, least);
        let start = perturbed(state, image.vibration);
        map.place(&start);
        // The last fifth: its first harmonic period by period, its powers and statuses.
        let first = periods - periods / 5;
        (0..first).for_each(|_| drop(map.harmonics(1, slips)));
        map.run.take_sums();
        let looks = (first..periods).map(|_| map.harmonics(1, slips).remove(0));
        let looks: Vec<Vec<c64>> = looks.collect(); // Of the slips of the contact nodes.
        // How far the motion has turned against that of the first period looked at.
        let turn = |own: &Vec<c64>| own.iter().zip(&looks[0]).map(|(a, w)| a * w.conj()).sum();
        let turns: Vec<c64> = looks.iter().map(turn).collect();
        // What the first harmonic turns by from period to period is the difference of the frequencies.
        let (powers, _, counts) = map.run.take_sums();
        let share = turned(&turns) / TAU / (turns.len() - 1).max(1) as f64;
        let steps = (periods - first) * map.steps();
        let found = Self {
            periods,
            main_frequency_hz: Some((1.0 + share) / state.period),
            main_harmonic: None,
            status: counts.fractions(),
            external_power: powers.external / steps as f64,
            e_folds: leading.map_or(0.0, |found| found.growth_rate * periods as f64 * state.period),
            agrees: false,
        };
        let wanted = [1.0 / state.period, image.powers.contact.external];
        found.held_to(None, wanted, image.counts.fractions(), NEAR_MOTION)
    }
}

/// A state with a random velocity of a hundredth of the amplitude of its vibration.
fn perturbed(state: &PeriodicState, vibration: f64) -> PeriodicState {
    let mut noise = GaussianNoise::new(2);
    let half = state.motion.len() / 2;
    let scale = RANDOM_SEED * vibration / (half as f64).sqrt(); // A share of the vibration in the norm of all velocities.
    let mut start = state.clone();
    start.motion[half..].iter_mut().for_each(|value| *value += scale * noise.draw().re);
    start
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_that_turns_half_around_between_two_looks_has_a_sense() {
        for turns in [-8.0, -1.0, 1.0, 8.0] {
            // Over a period whose looks hardly wait for equal times.
            let angle =
                |k: usize| TAU * turns * (k as f64 + 0.01 * (k as f64).sin()) / (2 * LOOKS) as f64;
            let looks: Vec<c64> = (0..=2 * LOOKS).map(|k| c64::from_polar(1.0, angle(k))).collect();
            assert!((turned_by_halves(&looks) - TAU * turns).abs() < 0.1, "{turns}");
        }
    }
}
