//! Following a branch of limit cycles over a parameter, whatever finds its points: the values asked for, the way of each half to
//! its end, both halves.
//!
//! What differs between rotating waves, pairs of waves and motions of the whole mesh is one step of a half ([`Way`]): how a
//! point is corrected from a guess, and how far the next guess dares to go.

use crate::cea::SweepWatch;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Why a branch ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BranchEnd {
    /// The range asked for ends there.
    Range,
    /// The whole edge slips: the cycle shrinks into steady sliding.
    Birth,
    /// The curve could not be followed any further.
    Lost,
    /// The most steps were spent.
    Steps,
    /// The body leaves its counterface.
    Separated,
    /// The wave is no motion of the disc, see [`LimitCycle::is_physical`](super::LimitCycle::is_physical).
    Unphysical,
}

impl BranchEnd {
    /// In words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Range => "the range ends",
            Self::Birth => "the cycle shrinks into steady sliding",
            Self::Lost => "the curve cannot be followed",
            Self::Steps => "too many steps were spent",
            Self::Separated => "the body leaves its counterface",
            Self::Unphysical => {
                "the wave opens inside the cylinder or draws energy from the normal contact: \
                 refine the mesh"
            }
        }
    }
}

/// Values of the parameter at which points are wanted, SI, rising.
pub(super) struct Values(Vec<f64>);

impl Values {
    /// Those of a list in any order.
    pub fn new(values: &[f64]) -> Self {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        values.dedup();
        Self(values)
    }

    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Smallest and largest.
    pub fn range(&self) -> [f64; 2] {
        [self.0[0], self.0[self.0.len() - 1]]
    }

    /// Whether one is asked for.
    pub fn contains(&self, value: f64) -> bool {
        self.0.contains(&value)
    }

    /// Whether a way from `start` leads out of the range at once.
    pub fn end_at(&self, start: f64, is_rising: bool) -> bool {
        let [least, most] = self.range();
        if is_rising { start >= most } else { start <= least }
    }

    /// Those between two, farther than `slightly` from both, in the order from the one to the other.
    pub fn between(&self, from: f64, to: f64, slightly: f64) -> Vec<f64> {
        let [low, high] = [from.min(to) + slightly, from.max(to) - slightly]; // Open at both ends: those are known.
        let between = self.0.iter().filter(|&&value| value > low && value < high);
        if to < from { between.rev().copied().collect() } else { between.copied().collect() }
    }

    /// Those farther than `slightly` beyond one, nearest first.
    pub fn ahead(&self, value: f64, is_rising: bool, slightly: f64) -> Vec<f64> {
        let end = if is_rising { f64::INFINITY } else { f64::NEG_INFINITY };
        self.between(value, end, slightly)
    }
}

/// The places where a branch turns back, told from the steps back that single points of the grid make as their contact changes.
#[derive(Clone, Debug)]
pub(super) struct Turning {
    /// Sense of the parameter, +1 or -1.
    direction: f64,
    /// Farthest value in that sense.
    farthest: f64,
    /// Share of a value that a turning branch goes back by.
    share: f64,
    /// Where it has turned.
    pub folds: Vec<f64>,
}

impl Turning {
    /// A branch on a grid of so many points that leaves `value` in a sense of the parameter.
    ///
    /// The boundaries of stick, slip and opening move from point to point: a grid of `N` points knows the parameter to
    /// `1 / N` of its value.
    pub fn new(value: f64, direction: f64, points: usize) -> Self {
        Self { direction, farthest: value, share: 1.0 / points as f64, folds: Vec::new() }
    }

    /// The next value along the branch.
    pub fn follow(&mut self, value: f64) {
        let ahead = (value - self.farthest) * self.direction;
        if ahead >= 0.0 {
            self.farthest = value;
        } else if -ahead > self.share * self.farthest.abs() {
            self.folds.push(self.farthest); // Farther back than the grid's error: a fold.
            self.direction = -self.direction;
            self.farthest = value;
        }
    }
}

/// A half of a branch on its way to its end.
pub(super) trait Way {
    /// What ends the whole search.
    type Error;
    /// Everything that the way on depends on.
    type Kept: Serialize + DeserializeOwned;
    /// Points between two looks at which what is done is kept; all at once where that is nothing.
    const BLOCK: usize = usize::MAX;

    /// Points so far.
    fn count(&self) -> usize {
        0
    }

    /// Further points, or why there are none.
    fn advance(&mut self) -> Result<Option<BranchEnd>, Self::Error>;

    /// Forgets what is not kept, so that a search which goes on takes the same course as one that was never interrupted.
    fn begin_block(&mut self) {}

    /// What is kept of it.
    fn kept(&self) -> Self::Kept;

    /// Takes up what was kept; nothing where it is of another half.
    fn take_up(&mut self, kept: Self::Kept) -> Option<()>;

    /// Goes on to the end, keeping what is done under a name.
    fn run(&mut self, name: &str, watch: &dyn SweepWatch) -> Result<BranchEnd, Self::Error> {
        let mut end = None;
        if let Some((known, kept)) = watch.recalled(name)
            && self.take_up(kept).is_some()
        {
            end = known; // None: it was interrupted on the way.
        }
        while end.is_none() {
            self.begin_block();
            let next = self.count().saturating_add(Self::BLOCK);
            while end.is_none() && self.count() < next {
                end = self.advance()?;
            }
            watch.keep_value(name, &(end, self.kept()));
        }
        Ok(end.unwrap_or(BranchEnd::Lost))
    }
}

/// Both halves of a branch through a point at `start`, the falling one first, each with why it ends; `half` begins one towards
/// falling (-1) or rising values (+1).
pub(super) fn both_halves<W: Way + Send>(
    values: &Values,
    start: f64,
    watch: &dyn SweepWatch,
    half: impl Fn(f64) -> Result<W, W::Error> + Sync,
) -> Result<[(W, BranchEnd); 2], W::Error>
where
    W::Error: Send,
{
    let follow = |name: &str, direction: f64| {
        let mut way = half(direction)?;
        // A start outside the range has nothing to find on the way out.
        let is_out = values.end_at(start, direction > 0.0);
        let end = if is_out { BranchEnd::Range } else { way.run(name, watch)? };
        Ok((way, end))
    };
    let (down, up) = rayon::join(|| follow("down", -1.0), || follow("up", 1.0)); // They share nothing: one thread gives the same bytes.
    Ok([down?, up?])
}

/// What the falling half has, from its end on, what lies between both, and what the rising one has.
pub(super) fn joined<T>(down: Vec<T>, between: Option<T>, up: Vec<T>) -> Vec<T> {
    down.into_iter().rev().chain(between).chain(up).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_in_the_order_on_the_way() {
        let values = Values::new(&[3.0, 1.0, 2.0, 2.0, 4.0]);
        assert_eq!(values.between(1.0, 4.0, 0.0), [2.0, 3.0]);
        assert_eq!(values.between(4.0, 1.5, 0.6), [3.0]);
        assert_eq!(values.ahead(3.5, false, 0.1), [3.0, 2.0, 1.0]);
        assert!(values.end_at(4.0, true) && values.end_at(0.5, false));
        assert!(!values.end_at(4.0, false));
        assert_eq!(joined(vec![2, 1], Some(3), vec![4, 5]), [1, 2, 3, 4, 5]);
    }

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
