//! Limit cycles along a parameter.

use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;

/// Limit cycles along a parameter.
#[derive(Clone, Debug)]
pub struct CycleBranch {
    /// The parameter.
    pub parameter: Parameter,
    /// Cycles in the order of the branch; neighbours may lie on both sides of a fold.
    pub cycles: Vec<LimitCycle>,
    /// Parameter values, SI, at which the branch turns back.
    pub folds: Vec<f64>,
    /// Why it ends, at its first and at its last cycle.
    pub ends: [BranchEnd; 2],
    /// Dense factorizations spent.
    pub factorizations: usize,
}

/// Why a branch ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BranchEnd {
    /// The range asked for ends there.
    Range,
    /// The whole edge slips: the cycle shrinks into steady sliding.
    Birth,
    /// The curve could not be followed any further.
    Lost,
    /// The most steps were spent.
    Steps,
    /// The wave is no motion of the disc, see [`LimitCycle::is_physical`].
    Unphysical,
}

impl BranchEnd {
    /// In words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Range => "the range ends",
            Self::Birth => "the cycle shrinks into steady sliding",
            Self::Lost => "the curve cannot be followed",
            Self::Steps => "too many changes of contact state",
            Self::Unphysical => {
                "the wave opens inside the cylinder or draws energy from the normal contact: refine the mesh"
            }
        }
    }
}
