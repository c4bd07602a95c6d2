//! Which of two motions wins on a body without symmetry: transients from steady sliding with modes seeded.

use super::ladder::GrowingMode;
use super::map::PeriodMap;
use crate::contact::ContactStatus;
use crate::cycle::basin::{AGREEING_WINDOWS, CONSTANT, LOOKS, LOST, SEED, WINDOW, is_final};
use crate::cycle::{BasinRequest, BasinRun};
use crate::linalg::dense::{add, difference, dot, norm};
use crate::linalg::{c64, interruption};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Share of the rate of the mode itself below which an amplitude does not change.
const OWN_RATE: f64 = 0.05;

/// A mode that is seeded.
struct Seeded<'m> {
    number: usize,
    mode: GrowingMode<'m>,
    /// Slip amplitude at which the first contact node sticks, m.
    sticking: f64,
    /// The motions of its shape at two phases a quarter of a period apart.
    patterns: [Vec<f64>; 2],
}

/// Transients of one body from steady sliding with one or two modes seeded.
pub struct ModeContest<'m, 'a> {
    map: PeriodMap<'a>,
    modes: Vec<Seeded<'m>>,
    request: &'m BasinRequest,
    base: Vec<f64>,
    /// Takes a motion's products with the patterns to the amplitudes of these.
    inverse: DMatrix<f64>,
    period: f64,
    /// Contact nodes that are open in steady sliding.
    open: usize,
}

impl<'m, 'a> ModeContest<'m, 'a> {
    /// A contest between the motions of two modes that grow, or, of one mode alone, between that and steady sliding (number 0).
    pub fn new(
        mut map: PeriodMap<'a>,
        modes: &[(usize, GrowingMode<'m>)],
        request: &'m BasinRequest,
    ) -> Self {
        let slowest = modes.iter().map(|(_, mode)| mode.eigenvalue.im);
        let period = TAU / slowest.fold(f64::INFINITY, f64::min);
        map.fit(period);
        let rest = modes[0].1.state(&map, 0.0);
        let seeded = modes.iter().map(|&(number, mode)| {
            let slip = mode.slips(&map).iter().map(|slip| slip.norm()).fold(0.0, f64::max);
            // The shape as it is, and a quarter of a period later.
            let turned: Vec<c64> = mode.shape.iter().map(|u| u * c64::I).collect();
            let later = GrowingMode { shape: &turned, ..mode };
            let pattern = |mode: &GrowingMode<'_>| {
                let own = difference(&mode.state(&map, 1.0).motion, &rest.motion);
                own.into_iter().map(|value| value / slip).collect() // For each metre of its largest slip.
            };
            Seeded {
                number,
                mode,
                sticking: slip * mode.sticking_amplitude(&map),
                patterns: [pattern(&mode), pattern(&later)],
            }
        });
        let seeded: Vec<Seeded<'m>> = seeded.collect();
        let patterns: Vec<&Vec<f64>> = seeded.iter().flat_map(|own| &own.patterns).collect();
        let count = patterns.len();
        let gram = DMatrix::from_fn(count, count, |i, j| dot(patterns[i], patterns[j]));
        let zeros = DMatrix::zeros(count, count);
        let inverse = gram.pseudo_inverse(1e-12).unwrap_or(zeros); // Least squares: s = (P^T P)^+ P^T (motion - base).
        // One step of steady sliding tells which nodes are open.
        map.place(&rest);
        map.run.advance();
        let open = open_nodes(&map);
        Self { map, modes: seeded, request, base: rest.motion, inverse, period, open }
    }

    /// The two that compete, by their numbers: of one mode, steady sliding (0) and that mode.
    pub fn rivals(&self) -> [usize; 2] {
        match &self.modes[..] {
            [one] => [0, one.number],
            several => [several[0].number, several[1].number],
        }
    }

    /// The transient of one ratio of the seeds: of two modes, of their velocities at the contact; of one, of its amplitude to the
    /// one at which the first contact node sticks.
    pub fn run(&mut self, ratio: f64) -> BasinRun {
        self.start(ratio);
        let steps = self.map.steps();
        let look_every = (steps / LOOKS).max(1);
        let is_alone = self.modes.len() == 1;
        let mut saturation = is_alone.then_some(ratio);
        let (mut share, mut agreeing, mut periods) = (ratio, 0, 0);
        // Window by window, until enough of them in a row say the same.
        while periods < self.request.periods && agreeing < AGREEING_WINDOWS {
            interruption::check();
            let mut sums = vec![0.0; self.modes.len()];
            for step in 1..=WINDOW * steps {
                self.map.run.advance();
                if saturation.is_none() && self.is_saturated() {
                    let found = self.amplitudes();
                    saturation = Some(found[1] / found[0]);
                }
                if step % look_every == 0 {
                    let found = self.amplitudes();
                    sums.iter_mut().zip(found).for_each(|(sum, a)| *sum += a);
                }
            }
            periods += WINDOW;
            // Mean amplitude over that of sticking of one mode, the ratio of both of two.
            let looks = (WINDOW * steps / look_every) as f64;
            let before = share;
            share = match is_alone {
                true => sums[0] / looks / self.modes[0].sticking,
                false => sums[1] / sums[0],
            };
            let is_end = match is_alone {
                true => self.is_over(before, share),
                false => saturation.is_some() && is_final(before, share),
            };
            agreeing = if is_end { agreeing + 1 } else { 0 };
        }
        let limit = if is_alone { LOST } else { 1.0 }; // Whoever has more in the end has won.
        BasinRun {
            seed_ratio: ratio,
            saturation_ratio: saturation,
            winner: self.rivals()[usize::from(share > limit)],
            is_settled: agreeing >= AGREEING_WINDOWS,
            duration_s: periods as f64 * self.period,
        }
    }

    /// Whether the amplitude of one mode ends where it is from one window to the next: gone, or changing much more slowly than the
    /// mode itself grows or decays, as on a cycle.
    fn is_over(&self, before: f64, share: f64) -> bool {
        let rate = self.modes[0].mode.eigenvalue.re.abs();
        let slow = OWN_RATE * rate * WINDOW as f64 * self.period; // A share of the logarithm of what the mode gains in a window.
        let change = share / before - 1.0;
        share < LOST && change < 0.0 || change.abs() < slow.min(CONSTANT)
    }

    /// Steady sliding with the modes seeded.
    fn start(&mut self, ratio: f64) {
        let slips: Vec<f64> = match &self.modes[..] {
            [one] => vec![ratio * one.sticking],
            modes => {
                // The larger with a fixed share of what makes a node stick.
                let speeds = modes.iter().map(|own| own.sticking * own.mode.eigenvalue.norm());
                let largest = SEED * speeds.fold(f64::INFINITY, f64::min);
                let first = largest / ratio.max(1.0);
                let velocities = [first, first * ratio];
                let pairs = modes.iter().zip(velocities);
                pairs.map(|(own, v)| v / own.mode.eigenvalue.norm()).collect() // |slip| = v / |lambda|.
            }
        };
        let mut state = self.modes[0].mode.state(&self.map, 0.0);
        state.period = self.period;
        for (own, slip) in self.modes.iter().zip(slips) {
            add(&mut state.motion, slip, &own.patterns[0]);
        }
        self.map.place(&state);
    }

    /// Slip amplitude of each mode in the motion, m: that of least squares. One mode alone stands for whatever vibrates: only what is
    /// at rest is steady sliding.
    fn amplitudes(&self) -> Vec<f64> {
        let motion = difference(&self.map.motion(), &self.base);
        if let [one] = &self.modes[..] {
            return vec![norm(&motion) / norm(&one.patterns[0])];
        }
        let patterns = self.modes.iter().flat_map(|own| &own.patterns);
        let products = DVector::from_iterator(
            2 * self.modes.len(),
            patterns.map(|pattern| dot(pattern, &motion)),
        );
        let found = &self.inverse * products;
        found.as_slice().chunks_exact(2).map(|pair| pair[0].hypot(pair[1])).collect() // Both phases: s_1 cos + s_2 sin.
    }

    /// Whether a node sticks, or more of them are open than in steady sliding.
    fn is_saturated(&self) -> bool {
        let status = &self.map.run.contact().status;
        open_nodes(&self.map) > self.open || status.contains(&ContactStatus::Stick)
    }
}

fn open_nodes(map: &PeriodMap<'_>) -> usize {
    let status = map.run.contact().status.iter();
    status.filter(|status| **status == ContactStatus::Open).count()
}
