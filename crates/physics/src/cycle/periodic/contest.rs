//! Which of two motions wins on a body without symmetry: transients from steady sliding with modes seeded.

use super::ladder::GrowingMode;
use super::map::PeriodMap;
use crate::cycle::basin::{CONSTANT, LOST, Rivalry, SEED, WINDOW, open_nodes};
use crate::cycle::{BasinRequest, BasinRun};
use crate::linalg::c64;
use crate::linalg::dense::{add, difference, dot, norm};
use crate::transient::CentralDifference;
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
        let open = open_nodes(&map.run);
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
        let asked = [self.request.periods, self.map.steps()];
        let (rivals, open, base, inverse) = (self.rivals(), self.open, &self.base, &self.inverse);
        let PeriodMap { run, moving, .. } = &mut self.map;
        let motion = |run: &CentralDifference<'a>| {
            let fields = run.fields();
            difference(&moving.motion(&fields.displacement, &fields.velocity), base)
        };
        if let [one] = &self.modes[..] {
            // It stands for whatever vibrates, beside sticking: only what is at rest is steady sliding. On a cycle its amplitude changes
            // much more slowly than the mode grows or decays: by a share of the logarithm of what that gains in a window.
            let slow = OWN_RATE * one.mode.eigenvalue.re.abs() * WINDOW as f64 * self.period;
            let constant = slow.min(CONSTANT);
            let amplitudes = |run: &_| [one.sticking, norm(&motion(run)) / norm(&one.patterns[0])];
            let rivalry = Rivalry { rivals, amplitudes, even: LOST, constant, open };
            return rivalry.run(run, (ratio, Some(ratio)), asked);
        }
        // Slip amplitudes of least squares.
        let patterns = || self.modes.iter().flat_map(|own| &own.patterns);
        let amplitudes = |run: &_| {
            let motion = motion(run);
            let products = patterns().map(|pattern| dot(pattern, &motion)).collect();
            let found = inverse * DVector::from_vec(products);
            [0, 2].map(|first| found[first].hypot(found[first + 1])) // Both phases: s_1 cos + s_2 sin.
        };
        let rivalry = Rivalry { rivals, amplitudes, even: 1.0, constant: CONSTANT, open };
        rivalry.run(run, (ratio, None), asked)
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
}
