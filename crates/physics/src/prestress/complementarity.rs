//! The contact state by complementarity: which points are pressed, over a range of friction coefficients.

use super::PrestressError;
use super::pressed_range::{CHANGE_WIDTH, PressedRange};
use super::pressed_state::{ContactState, LEAST_RANGE, PressedBodies, polynomial_state};
use crate::linalg::Bracket;

/// Sets of pressed points that are tried at one friction coefficient before the state is called missing.
const MAX_SETS: usize = 200;

/// Smallest range of friction coefficients over which a polynomial follows one set of points.
const SHORTEST_RANGE: f64 = 1e-3;

/// Share of the largest force up to which a violated condition is round-off.
const ROUND_OFF: f64 = 1e-12;

/// States at every one of `friction_coefficients`: rising values, each starting from the set of the last.
pub(super) fn range(
    bodies: &mut impl PressedBodies,
    friction_coefficients: &[f64],
) -> Result<PressedRange, PrestressError> {
    let mut order: Vec<usize> = (0..friction_coefficients.len()).collect();
    crate::order::sort_by_number(&mut order, |&a| friction_coefficients[a]);
    let mut sets: Vec<Vec<bool>> = Vec::new();
    let mut state_of = vec![0; friction_coefficients.len()];
    let mut changes = Vec::new();
    let mut start = vec![true; bodies.pressing().points.len()];
    for (rank, &i) in order.iter().enumerate() {
        let friction = friction_coefficients[i];
        let known = bodies.pressing().known.and_then(|known| known.set_at(friction));
        let set = match known.map(<[bool]>::to_vec) {
            Some(set) => set,
            None => pressed_points(bodies, friction, &start)?,
        };
        if !set.contains(&true) {
            return Err(bodies.pressing().gap_everywhere());
        }
        if sets.last().is_none_or(|last| *last != set) {
            if rank > 0 {
                let before = friction_coefficients[order[rank - 1]];
                let known = bodies.pressing().known;
                let known = known.and_then(|known| known.end_of(&start, [before, friction]));
                let end = known.map_or_else(|| end_between(bodies, &start, [before, friction]), Ok);
                changes.push(end?);
            }
            sets.push(set.clone());
        }
        state_of[i] = sets.len() - 1;
        start = set;
    }

    // Each state is followed from one change to the next; between the end of the set before and the beginning of its own, others hold.
    let asked_of = |state: usize| -> Vec<f64> {
        let with_state = state_of.iter().zip(friction_coefficients);
        with_state.filter_map(|(own, friction)| (*own == state).then_some(*friction)).collect()
    };
    let lowest = |asked: &[f64]| asked.iter().copied().fold(f64::INFINITY, f64::min);
    let begins = changes.iter().enumerate().map(|(k, &change)| {
        let (set, between) = (&sets[k + 1], [lowest(&asked_of(k + 1)), change]);
        let known = bodies.pressing().known.and_then(|known| known.end_of(set, between));
        Ok(known.map_or_else(|| end_between(bodies, set, between), Ok)?.max(change))
    });
    let begins = begins.collect::<Result<Vec<f64>, PrestressError>>()?;
    let end = |rank: Option<&usize>| rank.map_or(0.0, |&i| friction_coefficients[i]);
    let (first, last) = (end(order.first()), end(order.last()));
    let mut left_out = 0.0_f64;
    let states = sets.into_iter().enumerate().map(|(k, set)| {
        let asked = asked_of(k);
        let lower = k.checked_sub(1).map_or(first, |before| changes[before]);
        let upper = changes.get(k).copied().unwrap_or(last);
        let known = bodies.pressing().known;
        if let Some(state) = known.and_then(|known| known.state_over(&set, [lower, upper])) {
            left_out = left_out.max(known.map_or(0.0, |known| known.left_out));
            return Ok(state.clone());
        }
        let own_range = |bodies: &mut _, set: &[bool]| {
            let begin = match k.checked_sub(1) {
                Some(before) => begins[before],
                None => {
                    let least = lower.min(upper - LEAST_RANGE).max(0.0);
                    end_between(bodies, set, [lowest(&asked).min(upper), least])?
                }
            };
            Ok([begin.min(upper - SHORTEST_RANGE), upper])
        };
        let found = polynomial_state(bodies, &set, ([lower, upper], &own_range), &asked)?;
        left_out = left_out.max(found.left_out);
        Ok(found.state)
    });
    let states = states.collect::<Result<Vec<_>, PrestressError>>()?;
    let friction_coefficients = friction_coefficients.to_vec();
    Ok(PressedRange { states, friction_coefficients, state_of, changes, begins, left_out })
}

/// The pressed points at one friction coefficient, by the primal-dual active set (a semismooth Newton iteration on
/// the complementarity) from `start`; where that runs in circles, one point at a time.
fn pressed_points(
    bodies: &mut impl PressedBodies,
    friction_coefficient: f64,
    start: &[bool],
) -> Result<Vec<bool>, PrestressError> {
    let mut set = start.to_vec();
    let mut seen: Vec<Vec<bool>> = Vec::new();
    let mut was_circling = false;
    for _ in 0..MAX_SETS {
        let state = bodies.state_of(friction_coefficient, &set)?;
        if state.separations.iter().any(|c| !c.is_finite()) {
            break;
        }
        let excesses = excesses(bodies, &state, &set);
        let bound = bound(&state);
        let wrong = excesses.iter().enumerate().filter(|(_, e)| **e > bound);
        let Some((worst, _)) = wrong.clone().max_by(|a, b| a.1.total_cmp(b.1)) else {
            return Ok(set);
        };
        let is_circling = seen.contains(&set);
        if is_circling && !was_circling {
            // Without friction the points of a contact that nothing presses pull as much as they push.
            let all = bodies.state_of(0.0, &vec![true; set.len()])?;
            if let Some(error) = bodies.pressing().unpressed(&all.normal_forces) {
                return Err(error);
            }
        }
        was_circling |= is_circling;
        seen.push(set.clone());
        if is_circling {
            set[worst] = !set[worst];
        } else {
            wrong.for_each(|(i, _)| set[i] = !set[i]);
        }
    }
    Err(PrestressError::NoState { friction_coefficient })
}

/// How far each point violates its condition, N: the pull on a pressed one, the force of the point's own stiffness over
/// the penetration of an open one; negative where the condition holds.
fn excesses(bodies: &impl PressedBodies, state: &ContactState, is_pressed: &[bool]) -> Vec<f64> {
    let pushed = &bodies.pressing().pushed;
    let excess = |i: usize| match is_pressed[i] {
        true => -state.normal_forces[i],
        false => (pushed[i] - state.separations[i]) * bodies.stiffness_at(i),
    };
    (0..is_pressed.len()).map(excess).collect()
}

/// What may be round-off: it must not flip a point that just touches.
fn bound(state: &ContactState) -> f64 {
    ROUND_OFF * state.normal_forces.iter().map(|force| force.abs()).fold(0.0_f64, f64::max)
}

/// The friction coefficient up to which the set at `inside` holds on the way to `outside`, which may be smaller: the root of the largest
/// violation; `outside` where it holds all the way.
fn end_between(
    bodies: &mut impl PressedBodies,
    set: &[bool],
    [inside, outside]: [f64; 2],
) -> Result<f64, PrestressError> {
    let mut violation = |friction: f64| -> Result<f64, PrestressError> {
        let state = bodies.state_of(friction, set)?;
        let largest = excesses(bodies, &state, set).into_iter().fold(f64::NEG_INFINITY, f64::max);
        Ok(largest - bound(&state))
    };
    let [at_inside, at_outside] = [violation(inside)?, violation(outside)?];
    if at_outside <= 0.0 {
        return Ok(outside);
    }
    let mut bracket = Bracket::new([(inside, at_inside), (outside, at_outside)]);
    while bracket.width() > CHANGE_WIDTH {
        bracket.narrow(&mut violation)?;
    }
    Ok(bracket.middle())
}
