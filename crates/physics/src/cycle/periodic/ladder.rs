//! The cycle that a growing mode leads to, by one start after the other.

use super::map::{PeriodMap, PeriodicState};
use super::search::{Found, find, find_settled};
use super::start::{GrowingMode, balanced_start};
use super::two_frequencies::transient_from;
use crate::cycle::CycleError;
use crate::cycle::vector::{add, difference};
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
    let start = balanced_start(map, mode);
    let steps = map.steps();
    let mut found = find(map, start.clone());
    let retries: &[f64] = match &found {
        Err(CycleError::Died(_)) => &LARGER,
        Err(CycleError::Separated) => &[SMALLER],
        _ => &[],
    };
    for factor in retries {
        map.step_in(steps);
        found = find(map, scaled(map, mode, &start, *factor));
        if found.is_ok() {
            break;
        }
    }
    if let Err(CycleError::NotConverged { .. }) = found {
        map.step_in(steps);
        if let Some(end) = transient_from(map, &start)? {
            found = find(map, end);
        }
    }
    let found = shortest(map, found?);
    if off(mode, &found) <= ASTRAY {
        return Ok(found);
    }

    // Far off the mode.
    let own_steps = map.steps();
    map.step_in(steps);
    if let Ok(other) = find_settled(map, start) {
        let other = shortest(map, other);
        if off(mode, &other) < off(mode, &found) {
            return Ok(other);
        }
    }
    map.step_in(own_steps);
    Ok(found)
}

/// Difference of a cycle's frequency from that of its mode, relative.
fn off(mode: &GrowingMode<'_>, found: &Found) -> f64 {
    (TAU / (found.state.period * mode.eigenvalue.im) - 1.0).abs()
}

/// A start with its distance from steady sliding so many times as large.
fn scaled(
    map: &PeriodMap<'_>,
    mode: &GrowingMode<'_>,
    start: &PeriodicState,
    factor: f64,
) -> PeriodicState {
    let mut state = mode.state(map, 0.0);
    let vibration = difference(&start.motion, &state.motion);
    add(&mut state.motion, factor, &vibration);
    state
}

/// The same motion over the shortest period after which it repeats itself.
fn shortest(map: &mut PeriodMap<'_>, found: Found) -> Found {
    let steps = map.steps();
    for count in (2..=REPETITIONS).rev() {
        let mut state = found.state.clone();
        state.period /= count as f64;
        map.step_in(1);
        map.fit(state.period);
        if map.image(&state).relative_residual() < REPEATED
            && let Ok(own) = find(map, state.clone())
            && (own.state.period / state.period - 1.0).abs() < REPEATED
        {
            return Found { periods: found.periods + own.periods, ..own };
        }
    }
    map.step_in(steps);
    found
}
