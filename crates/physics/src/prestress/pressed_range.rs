//! Base states over a range of friction coefficients.

use crate::contact::PressedState;
use std::ops::Range;

/// Width to which a friction coefficient is located at which contact points open or close.
pub(super) const CHANGE_WIDTH: f64 = 1e-9;

/// Share of the largest force that the polynomial of a state may leave out.
pub(super) const RESOLVED: f64 = 1e-8;

/// Friction coefficients, and what states of the same bodies are known.
pub(super) type Asked<'a> = (&'a [f64], &'a PressedRange);

/// States over a range of friction coefficients.
#[derive(Clone, Debug, Default)]
pub struct PressedRange {
    /// One state for each set of pressed points, in order of the friction coefficient.
    pub states: Vec<PressedState>,
    /// The friction coefficients asked for.
    pub friction_coefficients: Vec<f64>,
    /// Which state each of them has.
    pub state_of: Vec<usize>,
    /// Friction coefficients up to which each state but the last holds.
    pub changes: Vec<f64>,
    /// Friction coefficients from which each state but the first holds: above the change before it where other sets of pressed points hold
    /// between, none of them at a friction coefficient that was asked for.
    pub begins: Vec<f64>,
    /// Share of the largest contact force that the polynomials of the states leave out at most, estimated.
    pub left_out: f64,
}

impl PressedRange {
    /// One state that holds at some friction coefficients.
    pub(super) fn of_one(state: PressedState, friction_coefficients: &[f64]) -> Self {
        Self {
            states: vec![state],
            friction_coefficients: friction_coefficients.to_vec(),
            state_of: vec![0; friction_coefficients.len()],
            ..Self::default()
        }
    }

    /// Friction coefficients between which a state holds.
    pub(super) fn span(&self, state: usize) -> [f64; 2] {
        let [first, last] = crate::order::range(self.friction_coefficients.iter().copied());
        let lower = state.checked_sub(1).map_or(first, |before| self.changes[before]); // From where the one before gives way.
        [lower, self.changes.get(state).copied().unwrap_or(last)]
    }

    /// Those asked for that have a state.
    pub(super) fn asked_of(&self, state: usize) -> Vec<f64> {
        let own = self.state_of.iter().zip(&self.friction_coefficients);
        own.filter(|own| *own.0 == state).map(|own| *own.1).collect()
    }

    /// The pressed points at one of the friction coefficients asked for.
    pub(super) fn set_at(&self, friction: f64) -> Option<&[bool]> {
        let place = self.friction_coefficients.iter().position(|own| *own == friction)?;
        Some(&self.states[self.state_of[place]].is_pressed)
    }

    /// Where a set of pressed points ceases to hold on the way from one friction coefficient to another, up or down, if that is known.
    pub(super) fn end_of(&self, set: &[bool], [from, to]: [f64; 2]) -> Option<f64> {
        let (bounds, first) = if from < to { (&self.changes, 0) } else { (&self.begins, 1) };
        let is_own = |k: &usize| self.states[k + first].is_pressed == set;
        let mut own = (0..bounds.len()).filter(is_own).map(|k| bounds[k]);
        own.find(|end| (from.min(to)..from.max(to)).contains(end))
    }

    /// Friction coefficients between the state `before` and the next one at which neither is known to hold; empty where one gives way to
    /// the other.
    pub fn unknown_between(&self, before: usize) -> Range<f64> {
        let (end, begin) = (self.changes[before], self.begins[before]);
        let is_empty = begin - end <= 4.0 * CHANGE_WIDTH; // Either is known to a width of its own.
        end..if is_empty { end } else { begin }
    }
}
