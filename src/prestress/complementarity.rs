//! The contact state by complementarity: which points are pressed, over a range of friction coefficients.

use super::PrestressError;
use super::elimination::Elimination;
use super::friction_polynomial::{evaluate, interpolated};
use crate::contact::{NormalLaw, Point, Row};
use crate::fem::{DofMap, Triplets};

/// Sets of pressed points that are tried at one friction coefficient before the state is called missing.
const MAX_SETS: usize = 200;

/// Width to which a friction coefficient is located at which contact points open or close.
const CHANGE_WIDTH: f64 = 1e-9;

/// Share of the largest force up to which a violated condition is round-off.
const ROUND_OFF: f64 = 1e-12;

/// What presses bodies together.
#[derive(Clone, Debug)]
pub struct Pressing<'a> {
    /// Stiffness over all dofs, supports included.
    pub stiffness: &'a Triplets,
    /// Load on all dofs, N (N/m in the plane).
    pub load: Vec<f64>,
    /// Held dofs and ties.
    pub elimination: Elimination,
    /// The contact points.
    pub points: &'a [Point],
    /// How far the counterface is pushed in at each, `delta_i - g_i`, m.
    pub pushed: Vec<f64>,
    /// Stiffness of the contact of each, N/m, without pressure where it stiffens; `None` is rigid contact.
    pub stiffnesses: Vec<Option<f64>>,
    /// Contact that stiffens, of each point; `None` is linear or rigid.
    pub laws: Vec<Option<NormalLaw>>,
}

impl Pressing<'_> {
    /// Rows `n` and `drag t` of the points over the unknowns.
    pub(super) fn rows(&self, unknowns: &DofMap) -> [Vec<Row>; 2] {
        let over_unknowns = |row: &Row| -> Row {
            let all = self.elimination.transposed(row).into_iter();
            all.filter_map(|(dof, a)| Some((unknowns.unknown_of[dof]?, a)))
                .collect()
        };
        let points = self.points.iter();
        let normals = points.clone().map(|point| over_unknowns(&point.normal));
        let drags = points.map(|point| {
            let slip = over_unknowns(&point.slip).into_iter();
            slip.map(|(dof, a)| (dof, point.friction.drag * a))
                .collect()
        });
        [normals.collect(), drags.collect()]
    }

    /// Load over the unknowns.
    pub(super) fn restricted_load(&self, unknowns: &DofMap) -> Vec<f64> {
        unknowns.restrict(&self.elimination.transposed_forces(&self.load))
    }

    fn gap_everywhere(&self) -> PrestressError {
        let distances = self.pushed.iter().map(|pushed| -pushed);
        let gaps = self.points.iter().zip(&self.pushed);
        PrestressError::GapEverywhere {
            total: self.points.len(),
            distance: distances.fold(f64::INFINITY, f64::min).max(0.0),
            interference: gaps
                .map(|(point, pushed)| pushed + point.gap)
                .fold(0.0, f64::max),
        }
    }
}

/// Separations and normal forces of the points under one set of pressed points.
#[derive(Clone)]
pub(super) struct ContactState {
    pub separations: Vec<f64>,
    pub normal_forces: Vec<f64>,
    /// Stiffness of each point, N/m, where contact stiffens.
    pub stiffnesses: Option<Vec<f64>>,
}

/// The bodies under one set of pressed points, as polynomials in the friction coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct PressedState {
    /// Displacement `u(mu)` of all dofs by power of `mu`, m.
    pub displacements: Vec<Vec<f64>>,
    /// Normal force on each contact point `N_i(mu)` by power of `mu`, N (N/m in the plane).
    pub normal_forces: Vec<Vec<f64>>,
    /// Stiffness of each contact point at its force by power of `mu`, N/m; none where no contact stiffens.
    pub stiffnesses: Vec<Vec<f64>>,
    /// Whether each contact point is pressed; the others are open.
    pub is_pressed: Vec<bool>,
    /// Friction coefficient below which the tangent keeps the state as it is there: the polynomials of contact that stiffens say
    /// nothing beyond their range, and the eigenvalue analysis starts without friction. 0 where they hold from there on.
    pub frozen_below: f64,
}

impl PressedState {
    /// Displacement over all dofs at a friction coefficient, m.
    pub fn displacement(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.displacements, friction_coefficient)
    }

    /// Normal force on each contact point, N; none of a state that is free of stress.
    pub fn normal_forces(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.normal_forces, friction_coefficient)
    }

    /// Stiffness of each contact point, N/m; none where no contact stiffens.
    pub fn springs(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.stiffnesses, friction_coefficient)
    }
}

/// States over a range of friction coefficients.
#[derive(Clone, Debug, Default)]
pub struct PressedRange {
    /// One state for each set of pressed points, in order of the friction coefficient.
    pub states: Vec<PressedState>,
    /// Which state each friction coefficient has.
    pub state_of: Vec<usize>,
    /// Friction coefficients at which one state gives way to the next.
    pub changes: Vec<f64>,
}

/// Bodies that answer to their contact points.
pub(super) trait PressedBodies {
    /// What presses them together.
    fn pressing(&self) -> &Pressing<'_>;

    /// Stiffness against the penetration of a point, N/m.
    fn stiffness_at(&self, point: usize) -> f64;

    /// Friction coefficients through which the polynomial of a state that holds in `range` goes.
    fn nodes(&self, range: [f64; 2]) -> Vec<f64>;

    /// The state in which exactly the points of `is_pressed` touch, whatever sign their forces have.
    fn state_of(
        &mut self,
        friction_coefficient: f64,
        is_pressed: &[bool],
    ) -> Result<ContactState, PrestressError>;

    /// Displacement of every dof from the state of the contact points.
    fn whole_displacement(&self, friction_coefficient: f64, state: &ContactState) -> Vec<f64>;
}

/// States at every one of `friction_coefficients`: rising values, each starting from the set of the last.
///
/// # Errors
/// [`PrestressError::NoState`] at the first friction coefficient without one; [`PrestressError::GapEverywhere`].
pub(super) fn range(
    bodies: &mut impl PressedBodies,
    friction_coefficients: &[f64],
) -> Result<PressedRange, PrestressError> {
    let mut order: Vec<usize> = (0..friction_coefficients.len()).collect();
    order.sort_by(|&a, &b| friction_coefficients[a].total_cmp(&friction_coefficients[b]));
    let mut sets: Vec<Vec<bool>> = Vec::new();
    let mut state_of = vec![0; friction_coefficients.len()];
    let mut changes = Vec::new();
    let mut start = vec![true; bodies.pressing().points.len()];
    for (rank, &i) in order.iter().enumerate() {
        let friction = friction_coefficients[i];
        let set = pressed_points(bodies, friction, &start)?;
        if !set.contains(&true) {
            return Err(bodies.pressing().gap_everywhere());
        }
        if sets.last().is_none_or(|last| *last != set) {
            if rank > 0 {
                let before = friction_coefficients[order[rank - 1]];
                changes.push(change_between(bodies, &start, [before, friction])?);
            }
            sets.push(set.clone());
        }
        state_of[i] = sets.len() - 1;
        start = set;
    }

    // Each state holds from one change to the next.
    let end = |rank: Option<&usize>| rank.map_or(0.0, |&i| friction_coefficients[i]);
    let (first, last) = (end(order.first()), end(order.last()));
    let states = sets.into_iter().enumerate().map(|(k, set)| {
        let lower = k.checked_sub(1).map_or(first, |before| changes[before]);
        let upper = changes.get(k).copied().unwrap_or(last);
        polynomial_state(bodies, set, [lower, upper])
    });
    Ok(PressedRange {
        states: states.collect::<Result<_, _>>()?,
        state_of,
        changes,
    })
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
        seen.push(set.clone());
        if is_circling {
            set[worst] = !set[worst];
        } else {
            wrong.for_each(|(i, _)| set[i] = !set[i]);
        }
    }
    Err(PrestressError::NoState {
        friction_coefficient,
    })
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
    let sizes = state.normal_forces.iter().map(|force| force.abs());
    ROUND_OFF * sizes.fold(0.0_f64, f64::max)
}

/// The friction coefficient up to which the set at `low` holds: the root of the largest violation, by regula falsi in the
/// Illinois form (Dowell and Jarratt 1971) with a bisection at every third step, as the violation has kinks.
fn change_between(
    bodies: &mut impl PressedBodies,
    set: &[bool],
    [mut low, mut high]: [f64; 2],
) -> Result<f64, PrestressError> {
    let mut violation = |friction: f64| -> Result<f64, PrestressError> {
        let state = bodies.state_of(friction, set)?;
        let excesses = excesses(bodies, &state, set);
        let largest = excesses.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Ok(largest - bound(&state))
    };
    let (mut at_low, mut at_high) = (violation(low)?, violation(high)?);
    let mut was_low = None;
    for step in 1.. {
        if high - low <= CHANGE_WIDTH {
            break;
        }
        let secant = (low * at_high - high * at_low) / (at_high - at_low);
        let is_inside = secant > low && secant < high;
        let middle = match is_inside && step % 3 != 0 {
            true => secant,
            false => 0.5 * (low + high),
        };
        let at_middle = violation(middle)?;
        let is_low = at_middle <= 0.0;
        // An end that stays twice counts half.
        let stays = if was_low == Some(is_low) { 0.5 } else { 1.0 };
        if is_low {
            (low, at_low) = (middle, at_middle);
            at_high *= stays;
        } else {
            (high, at_high) = (middle, at_middle);
            at_low *= stays;
        }
        was_low = Some(is_low);
    }
    Ok(0.5 * (low + high))
}

/// The state of one set of pressed points as a polynomial in the friction coefficient.
fn polynomial_state(
    bodies: &mut impl PressedBodies,
    is_pressed: Vec<bool>,
    range: [f64; 2],
) -> Result<PressedState, PrestressError> {
    let nodes = bodies.nodes(range);
    let (mut displacements, mut normal_forces, mut stiffnesses) =
        (Vec::new(), Vec::new(), Vec::new());
    for &friction in &nodes {
        let state = bodies.state_of(friction, &is_pressed)?;
        displacements.push(bodies.whole_displacement(friction, &state));
        normal_forces.push(state.normal_forces);
        stiffnesses.extend(state.stiffnesses);
    }
    let through = |values: Vec<Vec<f64>>| match values.is_empty() {
        true => values,
        false => interpolated(&nodes, values, range[1]),
    };
    let stiffnesses = through(stiffnesses);
    Ok(PressedState {
        displacements: through(displacements),
        normal_forces: through(normal_forces),
        frozen_below: if stiffnesses.len() > 1 { range[0] } else { 0.0 },
        stiffnesses,
        is_pressed,
    })
}

/// `count` Chebyshev points of a range.
pub(super) fn chebyshev_points(count: usize, [lower, upper]: [f64; 2]) -> Vec<f64> {
    let point = |k: usize| {
        let turn = std::f64::consts::PI * (k as f64 + 0.5) / count as f64;
        lower + 0.5 * (upper - lower) * (1.0 - turn.cos())
    };
    (0..count).map(point).collect()
}

pub(super) fn form(row: &Row, x: &[f64]) -> f64 {
    row.iter().map(|&(dof, a)| a * x[dof]).sum()
}
