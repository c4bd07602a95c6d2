//! The period map of a body: so many steps of the explicit transient, from a state to where it comes.

use crate::contact::SlidingContact;
use crate::cycle::CyclePowers;
use crate::cycle::moving::MovingDofs;
use crate::fem::operator::{StiffnessOperator, scatter};
use crate::linalg::dense::{add, difference, dot, norm};
use crate::linalg::{c64, interruption};
use crate::transient::{
    CentralDifference, SAFETY, StatusCounts, TimeStep, TransientError, TransientModel,
    TransientSettings,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Share of the longest step that a period begins with: it may grow by the rest before it takes another number of steps.
const FILLED: f64 = 0.97;

/// Steps of a period, at least, where no step is given: with so many the frequency of a cycle is known to a few thousandths.
const FEWEST_STEPS: usize = 100;

/// Looks at the kinetic energy within a period.
const LOOKS: usize = 32;

/// A state of motion, and the time after which it should come back.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeriodicState {
    /// `(omega sqrt(m) u_0, sqrt(m) v_{-1/2})` of every moving dof, root of J/m: its square is an energy.
    pub motion: Vec<f64>,
    /// `T`, s.
    pub period: f64,
}

impl PeriodicState {
    /// The state whose motion is so many times as far from another one.
    pub(super) fn stretched(&self, from: &[f64], by: f64) -> Self {
        let mut motion = from.to_vec();
        add(&mut motion, by, &difference(&self.motion, from)); // from + by (motion - from).
        Self { motion, ..*self }
    }
}

/// Where a state comes after its period.
#[derive(Clone, Debug, Default)]
pub struct PeriodImage {
    /// As [`PeriodicState::motion`].
    pub motion: Vec<f64>,
    /// Its rate there, 1/s.
    pub rate: Vec<f64>,
    /// What it misses its start by.
    pub residual: Vec<f64>,
    /// Root of twice the largest kinetic energy: the amplitude that residuals are relative to.
    pub vibration: f64,
    /// Root of twice the mean kinetic energy over the period: the same at every phase.
    pub amplitude: f64,
    /// Mean powers, W/m.
    pub powers: CyclePowers,
    /// Statuses over all nodes and steps.
    pub counts: StatusCounts,
}

impl PeriodImage {
    /// `|P(x) - x|` over the amplitude of the vibration.
    pub fn relative_residual(&self) -> f64 {
        norm(&self.residual) / self.vibration
    }

    /// The period that a state which comes back a little early or late should have had, less the one that it had: the shift
    /// along the motion that makes up for most of the residual, s.
    pub fn delay(&self) -> f64 {
        -dot(&self.residual, &self.rate) / dot(&self.rate, &self.rate) // Least |r + tau x'|, r the residual.
    }

    /// Whether every number is one.
    pub fn is_finite(&self) -> bool {
        let sum: f64 = self.motion.iter().sum();
        sum.is_finite() && self.vibration.is_finite()
    }
}

/// `P(x, T)`: `N` steps of `T / N` of the transient of a body, `N` a whole number that keeps the step below its limit.
///
/// The map is that of the time loop itself ([`CentralDifference`]), continuous in state and period, with a kink wherever a node
/// changes its status at another step. For each metre of thickness, of a body in three dimensions for the whole.
pub struct PeriodMap<'a> {
    pub(in crate::cycle) run: CentralDifference<'a>,
    pub(super) moving: MovingDofs,
    longest_step: f64,
    fewest_steps: usize,
    steps: usize,
    periods: usize,
}

impl<'a> PeriodMap<'a> {
    /// The map of a body for motions of about so high a frequency, rad/s, with steps no longer than `longest_step`, s, where one
    /// is given, else with no fewer than 100 in a period.
    ///
    /// # Errors
    /// A body that the time loop cannot take.
    pub fn new(
        model: TransientModel<'a>,
        operator: &'a dyn StiffnessOperator,
        frequency: f64,
        longest_step: Option<f64>,
    ) -> Result<Self, TransientError> {
        let period = TAU / frequency;
        let settings = TransientSettings::sliding(2.0 * period, TimeStep::Auto, period);
        let still = vec![0.0; operator.dof_count()];
        let run = CentralDifference::start_from(model, operator, &settings, &still, still.clone())?;
        let longest = SAFETY * run.plan().limit;
        let mut map = Self {
            moving: MovingDofs::of(operator, frequency),
            longest_step: longest_step.map_or(longest, |given| given.min(longest)),
            fewest_steps: longest_step.map_or(FEWEST_STEPS, |_| 1),
            steps: 1,
            periods: 0,
            run,
        };
        map.fit(period);
        Ok(map)
    }

    /// Chooses the number of steps where those of a period would be too long or too few, and says whether it has changed.
    pub fn fit(&mut self, period: f64) -> bool {
        let is_short = self.steps < self.fewest_steps;
        let is_long = period / self.steps as f64 > self.longest_step;
        if is_long || is_short {
            let own = (period / (FILLED * self.longest_step)).ceil() as usize; // A little short: the period may grow.
            self.steps = own.max(self.fewest_steps);
        }
        is_long || is_short
    }

    /// Takes a number of steps that a motion was found with.
    pub fn step_in(&mut self, steps: usize) {
        self.steps = steps;
    }

    /// Mass that moves, kg/m, of a body in three dimensions kg: the mean over its directions.
    pub fn mass(&self) -> f64 {
        self.moving.mass() / self.run.model().components() as f64
    }

    /// Length of a state's motion.
    pub fn unknowns(&self) -> usize {
        2 * self.moving.count()
    }

    /// Steps of a period.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Periods stepped so far.
    pub fn periods(&self) -> usize {
        self.periods
    }

    /// The same body with another contact: friction law, speed, interference.
    ///
    /// # Errors
    /// A compliant contact whose springs have no base state.
    pub fn retune(&mut self, contact: SlidingContact) -> Result<(), TransientError> {
        self.run.retune(contact)
    }

    /// Goes on where the map of another variant of the body was: with as many steps at least, and its count of periods.
    pub fn follow(&mut self, other: &Self) {
        self.steps = self.steps.max(other.steps);
        self.periods = other.periods;
    }

    /// The state of a displacement `u_0` (m) and a velocity `v_{-1/2}` (m/s) over all dofs in nodal frames.
    pub fn state(&self, displacement: &[f64], velocity: &[f64], period: f64) -> PeriodicState {
        let [u, v] = [displacement, velocity].map(|field| scatter(self.run.operator(), field));
        PeriodicState { motion: self.moving.motion(&u, &v), period }
    }

    /// The motion that the time loop is in.
    pub(super) fn motion(&self) -> Vec<f64> {
        let fields = self.run.fields();
        self.moving.motion(&fields.displacement, &fields.velocity)
    }

    /// Puts the time loop at the start of a period.
    pub(in crate::cycle) fn place(&mut self, state: &PeriodicState) {
        let time_step = state.period / self.steps as f64;
        self.run.restart(time_step, |fields| self.moving.place(&state.motion, fields));
    }

    /// Where a state comes after its period, which [`Self::fit`] must know.
    pub fn image(&mut self, state: &PeriodicState) -> PeriodImage {
        interruption::check();
        self.periods += 1;
        self.place(state);
        let look_every = (self.steps / LOOKS).max(1);
        let (mut largest, mut sum, mut looks) = (0.0_f64, 0.0, 0);
        for step in 0..self.steps - 1 {
            self.run.advance();
            if step.is_multiple_of(look_every) {
                let energy = self.moving.twice_kinetic_energy(&self.run.fields().velocity);
                (largest, sum, looks) = (largest.max(energy), sum + energy, looks + 1);
            }
        }
        let before = self.motion();
        self.run.advance();
        let motion = self.motion();

        // Mean powers, and the rate of the last step.
        let per_step = self.steps as f64 / state.period;
        let mut rate = difference(&motion, &before);
        rate.iter_mut().for_each(|value| *value *= per_step); // x' = (x_N - x_{N-1}) / dt.
        let (contact, material_damping, counts) = self.run.take_sums();
        PeriodImage {
            residual: difference(&motion, &state.motion),
            motion,
            rate,
            vibration: largest.max(f64::MIN_POSITIVE).sqrt(),
            amplitude: (sum / f64::from(looks.max(1))).sqrt(),
            powers: CyclePowers { contact, material_damping }.scaled(1.0 / self.steps as f64), // Sums over the steps so far.
            counts,
        }
    }

    /// Fourier series of some values over the coming period, `a_k = 2 / N sum_n v_n e^{-2 pi i k n / N}` of harmonics 1 to `count`.
    pub(in crate::cycle) fn harmonics(
        &mut self,
        count: usize,
        values: impl Fn(&CentralDifference<'a>) -> Vec<f64>,
    ) -> Vec<Vec<c64>> {
        let mut amplitudes = vec![Vec::new(); count];
        for step in 0..self.steps {
            if step.is_multiple_of(1000) {
                interruption::check();
            }
            self.run.advance();
            let values = values(&self.run);
            for (k, own) in (1..).zip(&mut amplitudes) {
                let [turns, steps] = [(k * step) % self.steps, self.steps].map(|own| own as f64);
                let turn = c64::from_polar(2.0 / steps, -TAU * turns / steps);
                own.resize(values.len(), c64::ZERO);
                own.iter_mut().zip(&values).for_each(|(sum, value)| *sum += turn * value);
            }
        }
        amplitudes
    }

    /// Mean over the period that begins with a state.
    pub fn mean(&mut self, state: &PeriodicState) -> Vec<f64> {
        self.periods += 1;
        self.place(state);
        let mut mean = vec![0.0; state.motion.len()];
        let share = 1.0 / self.steps as f64;
        for _ in 0..self.steps {
            self.run.advance();
            add(&mut mean, share, &self.motion());
        }
        mean
    }
}
