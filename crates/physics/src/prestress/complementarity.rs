//! The contact state by complementarity: which points are pressed, over a range of friction coefficients.

use super::contact_system::ContactSystem;
use super::polynomials::{LEAST_RANGE, polynomial_state};
use super::pressed_range::{Asked, CHANGE_WIDTH, PressedRange};
use super::pressed_state::ContactState;
use super::{PrestressError, Result};
use crate::linalg::Bracket;

/// Sets of pressed points that are tried at one friction coefficient before the state is called missing.
const MAX_SETS: usize = 200;

/// Smallest range of friction coefficients over which a polynomial follows one set of points.
const SHORTEST_RANGE: f64 = 1e-3;

/// Share of all contact forces that round-off leaves of a sum that is zero.
const UNPRESSED: f64 = 1e-9;
/// Share of the force that the bodies themselves would take where they are pushed in that is none.
const NO_FORCE: f64 = 1e-12;

/// Share of the largest force up to which a violated condition is round-off.
const ROUND_OFF: f64 = 1e-12;

/// States at every one of `friction_coefficients`, each from the state at friction 0, of which there is one: it is the same whatever other
/// values are asked for. What is `known` of the same bodies is not solved again.
pub(super) fn range(bodies: &mut ContactSystem<'_>, asked: Asked<'_>) -> Result<PressedRange> {
    let (friction_coefficients, known) = asked;
    let mut order: Vec<usize> = (0..friction_coefficients.len()).collect();
    crate::order::sort_by_number(&mut order, |&a| friction_coefficients[a]);
    let mut found = PressedRange {
        friction_coefficients: friction_coefficients.to_vec(),
        state_of: vec![0; friction_coefficients.len()],
        ..PressedRange::default()
    };
    let mut sets: Vec<(Vec<bool>, f64)> = Vec::new(); // The sets in turn, and the lowest friction coefficient of each.
    let all = vec![true; bodies.pressing().points.len()];
    let at_rest = pressed_points(bodies, 0.0, &all).unwrap_or(all);
    let mut before = 0.0;
    for &i in &order {
        let friction = friction_coefficients[i];
        let set = known.set_at(friction).map(|set| Ok(set.to_vec()));
        let set = set.unwrap_or_else(|| pressed_points(bodies, friction, &at_rest))?;
        if !set.contains(&true) {
            return Err(bodies.pressing().gap_everywhere());
        }
        let last = sets.last().map(|own| &own.0);
        if last != Some(&set) {
            if let Some(last) = last {
                found.changes.push(end_between((bodies, known), last, [before, friction])?);
            }
            sets.push((set, friction));
        }
        found.state_of[i] = sets.len() - 1;
        before = friction;
    }
    follow(bodies, &sets, &mut found, known)?;
    Ok(found)
}

/// The state of each set, followed from one change to the next; between the end of the set before and the beginning of its own,
/// others hold.
fn follow(
    bodies: &mut ContactSystem<'_>,
    sets: &[(Vec<bool>, f64)],
    found: &mut PressedRange,
    known: &PressedRange,
) -> Result<()> {
    // Downwards from where it was found each set but the first begins where it breaks.
    for (&change, (set, lowest)) in found.changes.iter().zip(sets.iter().skip(1)) {
        let begin = end_between((bodies, known), set, [*lowest, change])?;
        found.begins.push(begin.max(change));
    }
    for (k, (set, lowest)) in sets.iter().enumerate() {
        let (asked, [lower, upper]) = (found.asked_of(k), found.span(k));
        let is_over = |k: &usize| known.span(*k) == [lower, upper] && known.asked_of(*k) == asked;
        let is_known = |k: &usize| known.states[*k].is_pressed == *set && is_over(k);
        if let Some(own) = (0..known.states.len()).find(is_known) {
            found.left_out = found.left_out.max(known.left_out);
            found.states.push(known.states[own].clone());
            continue;
        }
        // The first set holds below what is asked, too: as far as its polynomial needs.
        let own_range = |bodies: &mut ContactSystem<'_>| {
            let begin = match k.checked_sub(1) {
                Some(before) => found.begins[before],
                None => {
                    let least = lower.min(upper - LEAST_RANGE).max(0.0);
                    end_between((bodies, known), set, [lowest.min(upper), least])?
                }
            };
            Ok([begin.min(upper - SHORTEST_RANGE), upper]) // Long enough for a polynomial.
        };
        bodies.begin(set)?;
        let own = polynomial_state(bodies, set, ([lower, upper], &own_range), &asked)?;
        found.left_out = found.left_out.max(own.left_out);
        found.states.push(own.state);
    }
    Ok(())
}

/// The pressed points at one friction coefficient, by the primal-dual active set (a semismooth Newton iteration on
/// the complementarity) from `start`; where that runs in circles, one point at a time.
pub(super) fn pressed_points(
    bodies: &mut ContactSystem<'_>,
    friction_coefficient: f64,
    start: &[bool],
) -> Result<Vec<bool>> {
    let mut set = start.to_vec();
    let mut seen: Vec<Vec<bool>> = Vec::new();
    let mut was_circling = false;
    for _ in 0..MAX_SETS {
        let state = bodies.state_of(friction_coefficient, &set)?; // N_i and c_i where these points touch and no others.
        if state.separations.iter().any(|c| !c.is_finite()) {
            break;
        }
        let excesses = excesses(bodies, &state, &set);
        let bound = bound(&state);
        // Pressed points that pull, open ones that penetrate: done where there are none.
        let wrong = excesses.iter().enumerate().filter(|(_, e)| **e > bound);
        let Some((worst, _)) = wrong.clone().max_by(|a, b| a.1.total_cmp(b.1)) else {
            return Ok(set);
        };
        let is_circling = seen.contains(&set);
        if is_circling && !was_circling {
            check_pressed(bodies)?;
        }
        was_circling |= is_circling;
        seen.push(set.clone());
        // All wrong points at once; from a set met before on the worst alone.
        let worst = bodies.pressing().together_with(worst);
        let turned = wrong.filter(|(i, _)| !is_circling || worst.contains(i));
        turned.for_each(|(i, _)| set[i] = !set[i]);
    }
    check_pressed(bodies)?;
    Err(PrestressError::NoState { friction_coefficient })
}

/// Refuses a contact that nothing presses: without friction the forces on all its points are in balance by themselves, or none at all
/// beside what pushes the bodies in.
fn check_pressed(bodies: &mut ContactSystem<'_>) -> Result<()> {
    let all = vec![true; bodies.pressing().points.len()];
    let forces = bodies.state_of(0.0, &all)?.normal_forces.into_iter();
    let mut forces = forces.map(|force| if force.is_finite() { force } else { 0.0 }); // 0 / 0.
    let all: f64 = forces.clone().map(f64::abs).sum();
    for (name, count) in &bodies.pressing().contacts {
        let sum: f64 = forces.by_ref().take(*count).sum();
        if sum.abs() <= (UNPRESSED * all).max(NO_FORCE * bodies.push()) {
            return Err(PrestressError::Asked(format!(
                "nothing presses the two sides of {name} together: one of them is held by the contact alone. Press it with a boundary \
                 pressure or an interference, or hold it by springs"
            )));
        }
    }
    Ok(())
}

/// How far each point violates its condition, N: the pull on a pressed one, the force of the point's own stiffness over
/// the penetration of an open one; negative where the condition holds. Points that touch together have their sum.
fn excesses(bodies: &ContactSystem<'_>, state: &ContactState, is_pressed: &[bool]) -> Vec<f64> {
    let pushed = &bodies.pressing().pushed;
    let excess = |i: usize| match is_pressed[i] {
        true => -state.normal_forces[i],
        false => (pushed[i] - state.separations[i]) * bodies.stiffness_at(i),
    };
    let of_all = |i: usize| bodies.pressing().together_with(i).map(excess).sum();
    (0..is_pressed.len()).map(of_all).collect()
}

/// What may be round-off: it must not flip a point that just touches.
fn bound(state: &ContactState) -> f64 {
    ROUND_OFF * state.normal_forces.iter().map(|force| force.abs()).fold(0.0_f64, f64::max)
}

/// The friction coefficient up to which the set at `inside` holds on the way to `outside`, which may be smaller: the root of the largest
/// violation; `outside` where it holds all the way.
fn end_between(
    (bodies, known): (&mut ContactSystem<'_>, &PressedRange),
    set: &[bool],
    [inside, outside]: [f64; 2],
) -> Result<f64> {
    if let Some(end) = known.end_of(set, [inside, outside]) {
        return Ok(end);
    }
    let mut violation = |friction: f64| -> Result<f64> {
        let state = bodies.state_of(friction, set)?;
        let largest = excesses(bodies, &state, set).into_iter().fold(f64::NEG_INFINITY, f64::max);
        Ok(largest - bound(&state))
    };
    // The largest violation is negative where the set holds, and changes sign at its end.
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
