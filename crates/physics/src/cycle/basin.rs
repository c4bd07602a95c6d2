//! Basin boundary of two waves: the amplitude ratio at saturation that separates them.

use super::body::DiscModel;
use super::field::{amplitude, slips};
use super::{CycleError, OperatingPoint};
use crate::contact::ContactStatus;
use crate::fem::operator::{SimdLevel, StiffnessOperator, largest_frequency};
use crate::linalg::interruption;
use crate::mesh::AnnulusMesh;
use crate::output::Described;
use crate::transient::{
    CentralDifference, OperatorChoice, Perturbation, SAFETY, StandingWave, TimeStep,
    TransientModel, TransientSettings, stable_step_limit,
};
use serde::Serialize;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Velocity of the larger seed, in units of what saturates a wave, the slip speed or the interference times its frequency: a
/// few e-folds below saturation, in which waves with the rotor die.
pub(super) const SEED: f64 = 0.01;
/// Looks at the edge in each period of the first wave.
const LOOKS: usize = 8;
/// Periods over which amplitudes are averaged before they are compared.
pub(super) const WINDOW: usize = 10;
/// A wave with less than this share of the other's amplitude has lost, if it goes on falling.
pub(super) const LOST: f64 = 0.02;
/// Change of the amplitude ratio over one window that is none.
pub(super) const CONSTANT: f64 = 2e-3;
/// Windows after saturation that must agree on the end.
const AGREEING_WINDOWS: usize = 3;
/// Share within which a ratio that stands still goes up and down: windows are no whole periods of an overtone of the winner, which
/// has the shape of the other and does not go.
const STILL: f64 = 0.03;

/// What is asked of two competing waves.
#[derive(Clone, Debug, PartialEq)]
pub struct BasinRequest {
    /// Circumferential harmonics of the two.
    pub harmonics: [usize; 2],
    /// Of a body without rotating waves the numbers of the modes that compete, one or two; `None` takes the two that grow fastest,
    /// or the one that grows fastest or decays slowest.
    pub modes: Option<Vec<usize>>,
    /// Smallest and largest ratio of their seeds, second over first.
    pub seed_ratios: [f64; 2],
    /// Factor between the two bounds of the boundary at which the search ends.
    pub tolerance: f64,
    /// Most periods of one transient.
    pub periods: usize,
}

/// One transient from steady sliding, both waves seeded.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct BasinRun {
    /// Seed of the second wave over that of the first.
    pub seed_ratio: f64,
    /// Ratio of their amplitudes when the first node sticks or opens.
    pub saturation_ratio: Option<f64>,
    /// The wave that wins.
    pub winner: usize,
    /// Whether that is settled.
    pub is_settled: bool,
    /// Simulated time, s.
    pub duration_s: f64,
}

/// The boundary between the basins of two waves.
#[derive(Clone, Debug, PartialEq)]
pub struct BasinBoundary {
    /// Largest ratio at saturation at which the first wave still wins; `None` if the second does at all that were tried.
    pub low: Option<f64>,
    /// Smallest ratio at which the second wins; `None` if the first does at all that were tried.
    pub high: Option<f64>,
    /// All transients, in the order of the search.
    pub runs: Vec<BasinRun>,
}

impl BasinRequest {
    /// Bisects the ratio of two seeds for the one at which the second of two rivals wins. Steady sliding is the rival 0.
    ///
    /// # Errors
    /// Those of a run.
    pub fn boundary<E>(
        &self,
        [first, second]: [usize; 2],
        mut run: impl FnMut(f64) -> Result<BasinRun, E>,
    ) -> Result<BasinBoundary, E> {
        // The ends of the range first: one that wins at both has no rival, but for a cycle that large kicks miss as small ones do.
        let [from, to] = self.seed_ratios;
        let mut runs = vec![run(from)?, run(to)?];
        for part in [0.5, 0.25, 0.75] {
            if first == 0 && runs.iter().all(|run| run.winner == first) {
                runs.push(run(from * (to / from).powf(part))?);
            }
        }
        let end = *runs[1..].iter().find(|run| run.winner == second).unwrap_or(&runs[1]);
        let mut bounds = [None, None];
        for run in [runs[0], end] {
            let bound = &mut bounds[usize::from(run.winner == second)];
            // The second one's bound is its smallest ratio, the first's its largest.
            if run.winner == first || bound.is_none() {
                *bound = run.saturation_ratio;
            }
        }
        let mut range = [from, end.seed_ratio];
        let is_contested = runs[0].winner == first && end.winner == second;
        while is_contested && range[1] / range[0] > self.tolerance {
            let run = run((range[0] * range[1]).sqrt())?; // Geometric mean: seeds differ by factors.
            let side = usize::from(run.winner == second);
            (range[side], bounds[side]) = (run.seed_ratio, run.saturation_ratio); // The winner's end of the range moves in.
            runs.push(run);
        }
        Ok(BasinBoundary { low: bounds[0], high: bounds[1], runs })
    }
}

impl DiscModel {
    /// Bisects the ratio of two seeds until it is known at which amplitude ratio at saturation the second wave wins.
    ///
    /// Each step is a transient from steady sliding. One boundary is looked for: where a ratio between the ends of the range
    /// changes the winner more than once, one of the changes is found.
    ///
    /// # Errors
    /// [`CycleError::Stepping`] where a transient cannot start, [`CycleError::NotFound`] where one of the waves does not grow.
    pub fn basin(
        &self,
        point: &OperatingPoint,
        request: &BasinRequest,
        simd: SimdLevel,
    ) -> Result<BasinBoundary, CycleError> {
        let annulus = AnnulusMesh::generate(&self.specification)?;
        let model =
            TransientModel::of_annulus(&annulus, &self.material, point.damping, point.contact);
        let operator = model.operator(OperatorChoice::Auto, simd)?;
        let contest = Contest {
            model,
            operator: operator.as_ref(),
            step: SAFETY * stable_step_limit(largest_frequency(operator.as_ref()), &point.damping),
            period: self.slowest_period(point, request)?,
            request,
        };
        request.boundary(request.harmonics, |ratio| contest.run(ratio))
    }

    /// Period of the slower of the two waves, s, which both grow: another one wins from no small start.
    fn slowest_period(&self, at: &OperatingPoint, asked: &BasinRequest) -> Result<f64, CycleError> {
        let friction = at.contact.friction_coefficient;
        let onsets = self.onsets(friction, crate::cea::ModeLimit::Lowest(super::MODES))?;
        let growing: BTreeSet<usize> = onsets.iter().map(|onset| onset.harmonic).collect();
        if let Some(still) = asked.harmonics.iter().find(|own| !growing.contains(own)) {
            return Err(CycleError::NotFound(format!(
                "steady sliding is stable against waves of {still} nodal diameters at \
                 contact.friction_coefficient = {friction}: they win from no small start. Raise \
                 it, or name others in basin.harmonics (harmonics that grow: {growing:?})"
            )));
        }
        let own = onsets.iter().filter(|onset| asked.harmonics.contains(&onset.harmonic));
        Ok(TAU / own.map(|onset| onset.frequency).fold(f64::INFINITY, f64::min))
    }
}

/// Everything that the transients of one search share.
struct Contest<'a> {
    model: TransientModel<'a>,
    operator: &'a dyn StiffnessOperator,
    step: f64,
    period: f64,
    request: &'a BasinRequest,
}

impl<'a> Contest<'a> {
    fn run(&self, seed_ratio: f64) -> Result<BasinRun, CycleError> {
        let mut run = self.start(seed_ratio)?;
        let steps = (self.period / run.plan().time_step).round().max(1.0) as usize;
        let rivals = self.request.harmonics;
        // Amplitudes of both harmonics of the edge's tangential displacement.
        let amplitudes = |run: &CentralDifference<'a>| {
            let edge = slips(run);
            rivals.map(|harmonic| amplitude(&edge, harmonic as isize).norm())
        };
        let rivalry = Rivalry { rivals, amplitudes, even: 1.0, constant: CONSTANT, open: 0 };
        Ok(rivalry.run(&mut run, (seed_ratio, None), [self.request.periods, steps]))
    }

    /// Steady sliding with both waves seeded, the larger with a fixed share of what saturates it.
    fn start(&self, seed_ratio: f64) -> Result<CentralDifference<'a>, CycleError> {
        let contact = &self.model.contact;
        let surface_speed = self.model.interface().surface_speed(contact.rotation_speed).abs();
        let opening = contact.interference * TAU / self.period; // omega delta: a wave of amplitude delta opens the contact.
        let scale = SEED * surface_speed.min(opening) / seed_ratio.max(1.0); // max(a_1, a_2) = SEED min(V, omega delta).
        let seeds = [scale, scale * seed_ratio];
        let duration = self.request.periods as f64 * self.period;
        let wave = |(harmonic, velocity)| StandingWave { harmonic, velocity, phase: 0.0 };
        let waves = self.request.harmonics.into_iter().zip(seeds).map(wave).collect();
        let settings = TransientSettings {
            perturbation: Perturbation { waves, ..Perturbation::default() },
            ..TransientSettings::sliding(duration, TimeStep::Seconds(self.step), self.step)
        };
        Ok(CentralDifference::start(self.model, self.operator, &settings)?)
    }
}

/// A transient in which two motions compete, and how they are told apart.
pub(super) struct Rivalry<A> {
    /// Both, by their numbers.
    pub rivals: [usize; 2],
    /// Their amplitudes, m.
    pub amplitudes: A,
    /// Ratio of these, second over first, above which the second has won.
    pub even: f64,
    /// Change of that over one window that is none.
    pub constant: f64,
    /// Contact nodes that are open in steady sliding.
    pub open: usize,
}

impl<'a, A: Fn(&CentralDifference<'a>) -> [f64; 2]> Rivalry<A> {
    /// Steps to its end, `steps` in a period, window by window until enough of them in a row say the same. The ratio at `saturation`,
    /// when a node sticks or more of them open, may be known before.
    pub fn run(
        &self,
        run: &mut CentralDifference<'a>,
        (seed_ratio, mut saturation_ratio): (f64, Option<f64>),
        [periods, steps]: [usize; 2],
    ) -> BasinRun {
        let look_every = (steps / LOOKS).max(1);
        let (mut sums, mut share, mut agreeing, mut step) = ([0.0; 2], seed_ratio, 0, 0);
        let (mut level, mut standing) = (seed_ratio, 0.0); // What the ratio stands at, and for how many windows.
        while step < periods * steps && agreeing < AGREEING_WINDOWS {
            interruption::check();
            run.advance();
            step += 1;
            let status = &run.contact().status;
            if saturation_ratio.is_none()
                && (status.contains(&ContactStatus::Stick) || open_nodes(run) > self.open)
            {
                let [first, second] = (self.amplitudes)(run);
                saturation_ratio = Some(second / first);
            }
            if step % look_every == 0 {
                let found = (self.amplitudes)(run);
                sums.iter_mut().zip(found).for_each(|(sum, a)| *sum += a);
            }
            if step % (WINDOW * steps) == 0 {
                let before = std::mem::replace(&mut share, sums[1] / sums[0]); // A_2 / A_1, both averaged over the window.
                sums = [0.0; 2];
                let is_level = (share / level - 1.0).abs() < STILL;
                (level, standing) = if is_level { (level, standing + 1.0) } else { (share, 0.0) };
                // It stays as it is from one window to the next, leaves one motion less and less, or stands twice as long as a
                // change that counts takes to leave the level.
                let change = share / before - 1.0;
                let is_lost = share < LOST && change < 0.0 || share > 1.0 / LOST && change > 0.0;
                let is_still =
                    change.abs() < self.constant || standing * self.constant > 2.0 * STILL;
                let is_end = saturation_ratio.is_some() && (is_lost || is_still);
                agreeing = if is_end { agreeing + 1 } else { 0 };
            }
        }
        BasinRun {
            seed_ratio,
            saturation_ratio,
            winner: self.rivals[usize::from(share > self.even)],
            is_settled: agreeing >= AGREEING_WINDOWS,
            duration_s: step as f64 * run.plan().time_step,
        }
    }
}

/// Contact nodes that are open.
pub(super) fn open_nodes(run: &CentralDifference<'_>) -> usize {
    let status = run.contact().status.iter();
    status.filter(|status| **status == ContactStatus::Open).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cycle that large kicks miss as small ones do is found by kicks between, to the tolerance.
    #[test]
    fn a_kick_may_be_too_large_for_a_cycle() {
        let request = BasinRequest {
            harmonics: [1, 2],
            modes: None,
            seed_ratios: [0.02, 50.0],
            tolerance: 1.1,
            periods: 100,
        };
        for [from, to] in [[0.033, 2.0], [0.03, 0.3], [3.0, 20.0]] {
            let run = |ratio: f64| {
                let winner = if (from..to).contains(&ratio) { 6 } else { 0 };
                let saturation_ratio = Some(ratio);
                let is_settled = true;
                let run = BasinRun {
                    seed_ratio: ratio,
                    saturation_ratio,
                    winner,
                    is_settled,
                    duration_s: 1.0,
                };
                Ok::<_, CycleError>(run)
            };
            let found = request.boundary([0, 6], run).unwrap();
            let [low, high] = [found.low, found.high].map(Option::unwrap);
            assert!(low < from && from <= high && high / low < 1.1, "{from} {to}: {low} {high}");
        }
    }
}
