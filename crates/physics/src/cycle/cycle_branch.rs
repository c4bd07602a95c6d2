//! Limit cycles along a parameter.

use super::continuation::BranchEnd;
use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;

/// Limit cycles along a parameter.
#[derive(Clone, Debug)]
pub struct CycleBranch {
    /// The parameter.
    pub parameter: Parameter,
    /// Cycles in the order of the branch; neighbours may lie on both sides of a fold.
    pub cycles: Vec<LimitCycle>,
    /// Parameter values, SI, at which the branch turns back by more than what one point of the grid is worth.
    pub folds: Vec<f64>,
    /// Why it ends, at its first and at its last cycle.
    pub ends: [BranchEnd; 2],
    /// Dense factorizations spent.
    pub factorizations: usize,
}

/// The places where a branch turns back, told from the steps back that single points of the grid make as their contact
/// changes.
#[derive(Clone, Debug)]
pub(super) struct Turning {
    /// Sense of the parameter, +1 or -1.
    direction: f64,
    /// Farthest value in that sense.
    farthest: f64,
    /// Share of a value that a turning branch goes back by.
    share: f64,
    /// Where it has turned.
    pub(super) folds: Vec<f64>,
}

impl Turning {
    /// A branch on a grid of so many points that leaves `value` in a sense of the parameter.
    ///
    /// The boundaries of stick, slip and opening move from point to point: a grid of `N` points knows the parameter to
    /// `1 / N` of its value.
    pub(super) fn new(value: f64, direction: f64, points: usize) -> Self {
        Self { direction, farthest: value, share: 1.0 / points as f64, folds: Vec::new() }
    }

    /// The next value along the branch.
    pub(super) fn follow(&mut self, value: f64) {
        let ahead = (value - self.farthest) * self.direction;
        if ahead >= 0.0 {
            self.farthest = value;
        } else if -ahead > self.share * self.farthest.abs() {
            self.folds.push(self.farthest);
            self.direction = -self.direction;
            self.farthest = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_branch_folds_where_it_turns_back_by_more_than_a_point_of_its_grid() {
        let followed = |values: &[f64]| {
            let mut turning = Turning::new(values[0], 1.0, 100);
            values.iter().for_each(|value| turning.follow(*value));
            turning.folds
        };
        // Steps back of a thousandth on the way up are those of single points.
        assert!(followed(&[1.0, 1.2, 1.1988, 1.3, 1.2987, 1.4]).is_empty());
        // An S: up to 1.5, back to 1.1 with a step of its own, and up again.
        assert_eq!(followed(&[1.0, 1.5, 1.4, 1.4007, 1.1, 1.2, 1.8]), [1.5, 1.1]);
    }
}
