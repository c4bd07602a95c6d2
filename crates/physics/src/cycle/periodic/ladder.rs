//! The cycle that a growing mode leads to: where the search starts on it, and one start after the other.

use super::map::{PeriodMap, PeriodicState};
use super::search::{ACCEPTED, Found, find, find_settled};
use super::two_frequencies::transient_from;
use crate::cycle::CycleError;
use crate::fem::operator::scatter;
use crate::linalg::c64;
use crate::linalg::dense::{difference, norm};
use std::f64::consts::TAU;

/// Difference of a cycle's frequency from its mode's, relative, from which on another start may know a cycle nearer to the mode.
pub const ASTRAY: f64 = 0.1;
/// Amplitudes, over the first, from which a vibration that dies is tried again: steady sliding is a motion that repeats itself too.
const LARGER: [f64; 2] = [4.0, 16.0];
/// Amplitude from which a body that leaves its counterface is tried again.
const SMALLER: f64 = 0.25;
/// Most repetitions of a motion within the period that a search has found.
const REPETITIONS: usize = 5;
/// Residual after a part of the period at which it may be the whole one.
const REPEATED: f64 = 0.1;
/// Doublings of the amplitude that are tried.
const DOUBLINGS: usize = 8;
/// Halvings, of the logarithm, of the interval in which growth ends.
const BISECTIONS: usize = 3;

/// A mode that grows from steady sliding.
#[derive(Clone, Copy, Debug)]
pub struct GrowingMode<'a> {
    /// `lambda`, 1/s and rad/s.
    pub eigenvalue: c64,
    /// Its shape over all dofs in nodal frames.
    pub shape: &'a [c64],
    /// Displacement of steady sliding over all dofs, m.
    pub base: &'a [f64],
}

impl GrowingMode<'_> {
    /// The state of steady sliding with the mode at an amplitude (m where its shape has one).
    pub fn state(&self, map: &PeriodMap<'_>, amplitude: f64) -> PeriodicState {
        let (lambda, period) = (self.eigenvalue, TAU / self.eigenvalue.im);
        let earlier = lambda * (lambda * (-0.5 * period / map.steps() as f64)).exp(); // v half a step earlier: lambda e^{-lambda dt / 2}.
        let pairs = || self.base.iter().zip(self.shape);
        let displacement = pairs().map(|(base, shape)| base + amplitude * shape.re);
        let velocity = pairs().map(|(_, shape)| amplitude * (shape * earlier).re);
        let [displacement, velocity]: [Vec<f64>; 2] = [displacement.collect(), velocity.collect()];
        map.state(&displacement, &velocity, period)
    }

    /// Slip of every contact node in its shape.
    pub fn slips(&self, map: &PeriodMap<'_>) -> Vec<c64> {
        let (law, operator) = (map.run.contact(), map.run.operator());
        let part = |of: fn(&c64) -> f64| -> Vec<f64> { self.shape.iter().map(of).collect() };
        let [real, imaginary] = [part(|u| u.re), part(|u| u.im)].map(|u| scatter(operator, &u));
        let slip = |field: &[f64], i: usize| law.relative(i, field)[1];
        let nodes = 0..map.run.interface().len();
        nodes.map(|i| c64::new(slip(&real, i), slip(&imaginary, i))).collect()
    }

    /// The amplitude at which the mode brings the first contact node to the speed of its counterface.
    pub fn sticking_amplitude(&self, map: &PeriodMap<'_>) -> f64 {
        let law = map.run.contact();
        let amplitudes = self.slips(map).into_iter().enumerate().map(|(i, slip)| {
            let speed = (slip * self.eigenvalue).norm();
            law.counterface_speed(i).abs() / speed.max(f64::MIN_POSITIVE) // A |lambda s| = V.
        });
        amplitudes.fold(f64::INFINITY, f64::min)
    }
}

/// The cycle that a growing mode leads to, in the number of steps that the map is left with.
///
/// The first start is the mode at the amplitude at which it neither grows nor decays. A vibration that dies is tried again from
/// larger amplitudes, one that leaves its counterface from a smaller one. A cycle far off the frequency of its mode may be that of
/// another mode, into which the secants have led: a longer transient comes first, and the cycle nearer to the mode is taken. Where
/// no motion is found, one is sought at the end of a transient.
///
/// # Errors
/// As [`find`]; a transient of two frequencies.
pub fn find_from(map: &mut PeriodMap<'_>, mode: &GrowingMode<'_>) -> Result<Found, CycleError> {
    let (start, rest) = (balanced_start(map, mode), mode.state(map, 0.0).motion);
    let steps = map.steps();
    let mut found = find(map, start.clone());
    let retries: &[f64] = match &found {
        Err(CycleError::Died(_)) => &LARGER,
        Err(CycleError::Separated) => &[SMALLER],
        _ => &[],
    };
    for factor in retries {
        map.step_in(steps); // A search may have left it in other steps.
        found = find(map, start.stretched(&rest, *factor));
        if found.is_ok() {
            break;
        }
    }
    if let Err(CycleError::Separated | CycleError::NotConverged { .. }) = found {
        map.step_in(steps);
        // A step of the search, or a large start, may throw off a body that stays on its counterface.
        let has_left = retries == [SMALLER];
        let least = if has_left { start.stretched(&rest, SMALLER) } else { start.clone() };
        if let Some(end) = transient_from(map, &least)? {
            found = find(map, end);
        }
    }
    let found = shortest(map, found?);
    if off(mode, &found) <= ASTRAY {
        return Ok(found);
    }

    let own_steps = map.steps(); // Far off the mode.
    map.step_in(steps);
    let other = find_settled(map, start).map(|other| shortest(map, other));
    if let Some(other) = other.ok().filter(|other| off(mode, other) < off(mode, &found)) {
        return Ok(other);
    }
    map.step_in(own_steps);
    Ok(found)
}

/// Difference of a cycle's frequency from that of its mode, relative.
fn off(mode: &GrowingMode<'_>, found: &Found) -> f64 {
    (TAU / (found.state.period * mode.eigenvalue.im) - 1.0).abs()
}

/// The same motion over the shortest period after which it repeats itself, where it can in steps of that, else in its own.
pub fn shortest(map: &mut PeriodMap<'_>, found: Found) -> Found {
    let steps = map.steps();
    for count in (2..=REPETITIONS).rev() {
        let mut state = found.state.clone();
        state.period /= count as f64;
        map.step_in(1); // One is too few or too long: fit chooses anew.
        map.fit(state.period);
        if map.image(&state).relative_residual() < REPEATED
            && let Ok(own) = find(map, state.clone())
            && (own.state.period / state.period - 1.0).abs() < REPEATED
        {
            return Found { periods: found.periods + own.periods, ..own };
        }
        // The search may end elsewhere, or nowhere; in the same steps the part is the motion itself.
        map.step_in((steps / count).max(1));
        let image = map.image(&state);
        let residual = image.relative_residual();
        if steps.is_multiple_of(count) && residual <= ACCEPTED {
            return Found { state, image, residual, steps: steps / count, ..found };
        }
    }
    map.step_in(steps);
    found
}

/// The mode at the amplitude at which it neither grows nor decays over its first period: there friction feeds as much as the
/// body, stick and impacts take. Where no amplitude within a factor of 256 does so, the one at which a node first sticks.
pub fn balanced_start(map: &mut PeriodMap<'_>, mode: &GrowingMode<'_>) -> PeriodicState {
    let reference = mode.sticking_amplitude(map);
    let rest = mode.state(map, 0.0);
    map.fit(rest.period);
    let grows = |map: &mut PeriodMap<'_>, amplitude: f64| {
        let start = mode.state(map, amplitude);
        let image = map.image(&start);
        let size = |motion: &[f64]| norm(&difference(motion, &rest.motion)); // Root of an energy, distance from steady sliding.
        size(&image.motion) > size(&start.motion)
    };

    // Up where the mode still grows, down where it does not.
    let is_growing = grows(map, reference);
    let factor = if is_growing { 2.0 } else { 0.5 };
    let [mut inner, mut outer] = [reference; 2];
    let has_crossed = (0..DOUBLINGS).any(|_| {
        (inner, outer) = (outer, factor * outer);
        grows(map, outer) != is_growing
    });
    if !has_crossed {
        return mode.state(map, reference);
    }
    for _ in 0..BISECTIONS {
        let middle = (inner * outer).sqrt();
        if grows(map, middle) == is_growing { inner = middle } else { outer = middle }
    }
    mode.state(map, (inner * outer).sqrt())
}
