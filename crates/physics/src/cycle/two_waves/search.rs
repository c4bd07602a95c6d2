//! From a cycle that loses its stability to the motion of two frequencies beside it.

use super::super::stepping::MeshStepping;
use super::super::system::Closure;
use super::super::{CycleError, LimitCycle, Parameter};
use super::history::{History, Measured};
use super::{TwoWaveMotion, TwoWaves};
use crate::cea::SweepWatch;

/// Velocity of the seed of the second wave, in units of the slip speed.
const SEED: f64 = 0.05;
/// Periods between two looks at the amplitudes, and of the last look, from which the search starts.
const WINDOWS: [usize; 2] = [100, 200];
/// Most looks.
const LOOKS: usize = 24;
/// Change of the second amplitude from one look to the next that is none.
const CONSTANT: f64 = 0.01;
/// Amplitude of one wave, over that of the other, at which it has gone.
const GONE: f64 = 0.05;
/// Relative difference of the frequencies of a transient that stays on the motion.
const AGREES: f64 = 1e-3;

/// A motion of two frequencies beside a cycle.
pub struct TwoWaveSearch {
    /// Its grid of phases.
    pub waves: TwoWaves,
    /// Itself.
    pub motion: TwoWaveMotion,
    /// What a transient that started on it has after some hundred periods, where both waves still live.
    pub confirmation: Option<Measured>,
    /// What the transient from the cycle has settled on.
    pub settled: Measured,
}

impl TwoWaveSearch {
    /// Whether the transient from the motion still has its frequencies, within a thousandth.
    pub fn agrees(&self) -> bool {
        let own = self.motion.state.frequencies();
        self.confirmation.is_some_and(|found| {
            found.frequencies.iter().zip(own).all(|(a, b)| (a / b - 1.0).abs() < AGREES)
        })
    }
}

impl MeshStepping<'_> {
    /// The motion in which the wave of a cycle lives together with one of harmonic `second` (negative for a wave with the rotor), on
    /// a grid of `side` points along either phase or as many as resolve them.
    ///
    /// A transient leaves the cycle, seeded with the second wave, until both amplitudes are constant; its contact forces over both
    /// phases are the start of the balance. A transient from what is found confirms it. `watch` keeps it, and recalls what an
    /// interrupted search has found.
    ///
    /// # Errors
    /// [`CycleError::NotFound`] where a transient from the cycle comes to no such motion, or its balance does not converge;
    /// [`CycleError::Mesh`] and [`CycleError::Stepping`].
    pub fn two_waves(
        &self,
        cycle: &LimitCycle,
        second: isize,
        side: Option<usize>,
        watch: &dyn SweepWatch,
    ) -> Result<TwoWaveSearch, CycleError> {
        let harmonics = [self.solver.wave.body.harmonic, second];
        let grid = |settled: &Measured| {
            TwoWaves::new(&self.solver.model, harmonics, settled.frequencies, side)
        };
        const NAME: &str = "found";
        if let Some((settled, confirmation, state)) = watch.recalled(NAME) {
            let waves = grid(&settled)?;
            let motion = waves.motion(state);
            return Ok(TwoWaveSearch { waves, motion, confirmation, settled });
        }
        let (settled, history) = self.settled_waves(cycle, harmonics)?;

        // The balance of both waves, and a transient from it.
        let point = &cycle.state.point;
        let waves = grid(&settled)?;
        let start = history.state(&waves, &settled, point);
        let parameter = Parameter::FrictionCoefficient;
        let value = Closure::Value(point.contact.friction_coefficient); // The friction of the cycle itself: it stands still.
        let [a, b] = settled.frequencies.map(|omega| omega / std::f64::consts::TAU);
        let state = waves.solved(&start, parameter, value);
        let not_converged = || {
            CycleError::NotFound(format!(
                "the balance of both waves does not converge from the motion of {a:.1} and \
                 {b:.1} Hz that a transient settles on"
            ))
        };
        let motion = waves.motion(state.ok_or_else(not_converged)?);
        let (mut run, steps) = self.start_from(cycle, None, |time| waves.field(&motion, time))?;
        let confirmation = History::of(&mut run, harmonics, steps, WINDOWS[1]).measured();
        watch.keep_value(NAME, &(settled, confirmation, &motion.state));
        Ok(TwoWaveSearch { waves, motion, confirmation, settled })
    }

    /// What a transient from a cycle, seeded with a second wave, settles on.
    fn settled_waves(
        &self,
        cycle: &LimitCycle,
        harmonics: [isize; 2],
    ) -> Result<(Measured, History), CycleError> {
        let (point, other) = (&cycle.state.point, harmonics[1].unsigned_abs());
        let surface_speed = point.contact.rotation_speed * self.solver.wave.body.radius;
        let (mut run, steps) = self.start(cycle, Some((other, SEED * surface_speed)))?;
        let [window, last] = WINDOWS;
        let (mut before, mut is_constant) = (f64::NAN, false);
        for _ in 0..LOOKS {
            let history = History::of(&mut run, harmonics, steps, window);
            let Some([first, second]) = history.measured().map(|found| found.amplitudes) else {
                before = f64::NAN; // Nothing to compare with.
                continue;
            };
            if first < GONE * second {
                return Err(CycleError::NotFound(format!(
                    "a transient from the cycle ends on the wave of {other} nodal diameters alone"
                )));
            }
            is_constant = (second / before - 1.0).abs() < CONSTANT;
            before = second;
            if is_constant {
                break;
            }
        }
        let periods = LOOKS * window;
        let vanishes = || {
            CycleError::NotFound(format!(
                "a transient from the cycle has no second wave of {other} nodal diameters after \
                 {periods} periods"
            ))
        };
        if !is_constant {
            if before.is_nan() {
                return Err(vanishes());
            }
            return Err(CycleError::NotFound(format!(
                "the amplitudes of both waves still change after {periods} periods of a transient"
            )));
        }
        let history = History::of(&mut run, harmonics, steps, last); // A longer record: lines to the inverse of its length.
        let settled = history.measured().ok_or_else(vanishes)?;
        Ok((settled, history))
    }
}
