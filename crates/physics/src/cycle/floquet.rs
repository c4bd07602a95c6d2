//! Stability of rotating waves: leading multipliers, from the map of perturbations over one period, and where a branch changes it.

use super::arnoldi::{MultiplierSearch, Ritz, unit};
use super::field::amplitude;
use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;
use super::stability::{FloquetMultiplier, FloquetMultipliers, StabilityChange, crossing};
use super::stepping::{MeshStepping, Period};
use super::{CycleError, RidingMode};
use crate::linalg::c64;
use std::f64::consts::TAU;

/// Multipliers kept, and the residual of one that is worth listing.
const LISTED: (usize, f64) = (4, 0.2);
/// The leading ones that must have converged, and the residual of a converged multiplier, relative to it.
const CONVERGED: (usize, f64) = (2, 4e-3);
/// Smallest and largest dimension of the Krylov space, and steps between two looks at it.
const DIMENSIONS: [usize; 3] = [12, 90, 4];
/// An exponent within this share of `omega`, with this overlap with the shift of the wave, is the shift itself.
const NEUTRAL: [f64; 2] = [0.05, 0.8];
/// Share of `omega` that every rate may be wrong by: what steps and nodes leave open of where a wave lands.
const FLOOR: f64 = 2e-4;
/// Harmonics, from zero on, of a start that knows nothing.
const START_HARMONICS: usize = 13;
/// Share of a known start that such a one adds, lest a mode that comes up between two cycles is missed.
const UNKNOWN_SHARE: f64 = 0.1;
/// Halvings of the interval in which a branch changes its stability.
const HALVINGS: usize = 5;

/// A limit cycle as the mesh's own time stepping has it.
#[derive(Clone, Debug)]
pub struct SteppedCycle {
    /// The cycle, its powers and fractions those of the transient.
    pub cycle: LimitCycle,
    /// Its stability.
    pub stability: FloquetMultipliers,
    /// Sum of its leading modes: where to begin with those of a neighbour.
    modes: Vec<f64>,
}

impl SteppedCycle {
    /// A cycle of the same wave, larger or smaller: its exponents are the same. Its powers are its own, since they grow
    /// partly with the amplitude and partly with its square.
    #[must_use]
    pub fn scaled_to(&self, cycle: &LimitCycle) -> Self {
        Self { cycle: cycle.clone(), ..self.clone() }
    }
}

impl MeshStepping<'_> {
    /// Settles a cycle in the transient of its mesh, and finds its leading Floquet exponents there, by Arnoldi's process on the map of one
    /// period.
    ///
    /// `neighbour` is a cycle nearby, whose modes are a start. The exponent of the wave's own shift in phase is zero; what the steps of
    /// time and mesh make of it instead is how far the others may be trusted, by experience twice over: half of it, a five
    /// thousandth of `omega`, the residual and a hundredth of the rate make the uncertainty of each.
    ///
    /// # Errors
    /// [`CycleError::Stepping`] if the transient cannot start, [`CycleError::NotFound`] if the exponents do not converge.
    pub fn settle(
        &self,
        cycle: &LimitCycle,
        neighbour: Option<&SteppedCycle>,
    ) -> Result<SteppedCycle, CycleError> {
        let period = &self.period(cycle)?;
        let mut start = unit(unknown_start(period));
        if let Some(known) = neighbour.filter(|known| known.modes.len() == start.len()) {
            // A little of what the neighbour's modes may lack.
            start.iter_mut().zip(&known.modes).for_each(|(x, k)| *x = UNKNOWN_SHARE * *x + k);
        }
        let [reach, least] = NEUTRAL;
        let search = MultiplierSearch {
            dimensions: DIMENSIONS,
            converged: CONVERGED,
            listed: LISTED,
            is_shift: &|own| own.value.ln().norm() < reach * TAU && own.along > least,
            remedy: "transient.initial = \"limit-cycle\"",
        };
        let mut periods = 0;
        let found = search.run(&start, period.shift(), |direction| {
            periods += 1;
            period.map(direction)
        })?;
        // The shift along the cycle neither grows nor decays: what it does is the error.
        let neutral = found.shift.map(|shift| shift.ln() / period.duration); // lambda_0 = ln(rho_0) / T, exactly 0 in theory.
        let mut modes = vec![0.0; period.dimension()];
        let mut multipliers = Vec::new();
        for ritz in &found.listed {
            let vector = found.vector(ritz);
            modes.iter_mut().zip(&vector).for_each(|(x, v)| *x += v.re + v.im); // Re and Im span the plane of a complex mode.
            multipliers.push(multiplier(period, ritz, &vector, neutral));
        }
        let shift = found.shift.map(|own| own.norm());
        let &Period { powers, fractions, .. } = period;
        Ok(SteppedCycle {
            cycle: LimitCycle { powers, fractions, ..cycle.clone() },
            stability: FloquetMultipliers { multipliers, shift, periods },
            modes: unit(modes),
        })
    }

    /// Value of `parameter` (SI) at which the branch from one cycle to another, of different stability, changes it.
    ///
    /// The interval is halved five times, then the growth rate is interpolated. It ends early where the branch does not
    /// lead straight from one to the other.
    ///
    /// # Errors
    /// Those of [`Self::settle`].
    pub fn stability_change(
        &self,
        parameter: Parameter,
        stable: &SteppedCycle,
        unstable: &SteppedCycle,
    ) -> Result<StabilityChange, CycleError> {
        let mut ends = [stable.clone(), unstable.clone()];
        let at = |end: &SteppedCycle| parameter.of(&end.cycle.state.point);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (at(&ends[0]) + at(&ends[1])); // Halves of the interval between a stable and an unstable cycle.
            let Ok(cycle) = self.solver.continue_to(&ends[0].cycle, parameter, middle) else {
                break;
            };
            let settled = self.settle(&cycle, Some(&ends[1]))?;
            let leading = settled.stability.leading();
            let side = usize::from(leading.is_some_and(|found| found.growth_rate > 0.0));
            ends[side] = settled;
        }
        let growing = ends[1].stability.leading().and_then(|found| found.mode);
        let rate = |end: &SteppedCycle| end.stability.leading().map(|found| found.growth_rate);
        Ok(StabilityChange {
            value: crossing(ends.each_ref().map(|end| (at(end), rate(end)))),
            harmonic: growing.map_or(0, |found| found.harmonic),
            frequency_hz: growing.map_or(0.0, |found| found.frequency_hz),
        })
    }
}

/// A multiplier with the circumferential harmonic that moves the edge most and its frequency.
fn multiplier(
    period: &Period<'_>,
    ritz: &Ritz,
    vector: &[c64],
    neutral: Option<c64>,
) -> FloquetMultiplier {
    let omega = TAU / period.duration;
    let turning = ritz.value.arg() / period.duration; // Im lambda = arg(rho) / T, up to multiples of omega.
    let (sectors, per) = (period.sectors(), period.sector_dofs());
    let half = vector.len() / 2;
    // Amplitude of e^{i m theta} in one dof of the edge, of displacement or velocity.
    let amplitude = |m: isize, part: usize, dof: usize| {
        let edge = vector[part + dof..].iter().step_by(per).take(sectors);
        amplitude(&edge.copied().collect::<Vec<c64>>(), m)
    };
    // Resolved motion of the edge lives in low harmonics.
    let highest = (sectors / 2).min(40) as isize;
    let energy = |m: isize| amplitude(m, 0, 0).norm_sqr() + amplitude(m, 0, 1).norm_sqr();
    let harmonic = (-highest..=highest)
        .map(|m| (m, energy(m)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |largest| largest.0);
    let dof = usize::from(amplitude(harmonic, 0, 1).norm() > amplitude(harmonic, 0, 0).norm());
    // v / (omega u) of that harmonic tells its frequency, which the multiplier knows up to multiples of omega.
    let ratio = amplitude(harmonic, half, dof) / amplitude(harmonic, 0, dof);
    let whole = (ratio.im - turning / omega).round();
    let fixed = turning + whole * omega;
    // In the frame of the wave, harmonic p + k n has the frequency Im lambda + k omega.
    let (n, count) = (period.harmonic, period.harmonic.abs());
    let rest = harmonic.rem_euclid(count); // Harmonics that differ by multiples of n are of one class.
    let signed = if 2 * rest > count { rest - count } else { rest }; // The class: the harmonic of least size among p + k n.
    let turns = (harmonic - signed) / n; // k of m = p + k n.
    let residual = ritz.residual / period.duration;
    let shift = neutral.map_or(NEUTRAL[0] * omega, |neutral| 0.5 * neutral.norm());
    let mode = RidingMode {
        frequency: fixed - turns as f64 * omega,
        class: signed.unsigned_abs(),
        harmonic: harmonic.unsigned_abs(),
        frequency_hz: fixed.abs() / TAU,
    };
    let open = FLOOR * omega + shift + residual;
    FloquetMultiplier {
        mode: Some(mode),
        ..FloquetMultiplier::new(ritz.value, period.duration, open)
    }
}

/// Smooth velocities of the low harmonics in both components, largest at the edge: the same on every machine.
fn unknown_start(period: &Period<'_>) -> Vec<f64> {
    let (sectors, per) = (period.sectors(), period.sector_dofs());
    let half = period.dimension() / 2;
    let mut start = vec![0.0; 2 * half];
    for sector in 0..sectors {
        let angle = TAU * sector as f64 / sectors as f64;
        for dof in 0..per {
            let depth = (dof / 2) as f64 / (per / 2) as f64; // Waves of all low harmonics that bend over the depth.
            let component = dof % 2;
            start[half + sector * per + dof] = (0..START_HARMONICS)
                .map(|m| {
                    // Phases and shares without structure: multiples of irrational numbers.
                    let [one, other] = [2 * m + component + 1, m + 3 * component + 1];
                    let phase = TAU * (one as f64 * 0.618_033_988_749_894_9).fract();
                    let bend = 1.0 + (other as f64 * 0.754_877_666_246_692_7).fract();
                    (m as f64 * angle + phase).cos()
                        * (0.5 * std::f64::consts::PI * bend * depth).cos()
                })
                .sum::<f64>();
        }
    }
    start
}
