//! Limit cycles of bodies without symmetry and of bodies in three dimensions: fixed points of the period map of the explicit transient.
//!
//! A body of any shape has no rotating waves, and its limit cycle is a motion `x(t + T) = x(t)` of the whole mesh. It is sought where the
//! transient itself has it. `P(x, T)` are `N` steps of `T / N` of the time loop with its Lagrange multipliers, stick, slip, lift-off and
//! impacts included. A cycle is `P(x, T) = x` ([`PeriodMap`]). So cycle and transient are one discrete motion, and the energy balance of
//! the time loop is that of the cycle.
//!
//! The search ([`find`]) is Newton's method on the few directions in which perturbations die slowly or grow, and plain periods on all
//! others. Instead of a basis of slow directions, differences of the last iterates and of their residuals serve as secants. They cost no
//! period of their own. The map is continuous but has a kink wherever a node changes its status; it needs no derivative. Source: Lust,
//! Roose, Spence and Champneys, An adaptive Newton-Picard algorithm with subspace iteration, SIAM J. Sci. Comput. 19 (1998). It starts on
//! the shape of a growing mode, at the amplitude at which friction stops to feed it ([`balanced_start`]). Floquet multipliers come from
//! Arnoldi's process on differences of the map ([`super::FloquetMultipliers`]). What is tried where the first start leads nowhere or to the
//! cycle of another mode says [`find_from`].
//!
//! Along a parameter `p` ([`BranchRequest`]) motion, period and `p` are found together, `P(x, T, p) = x` with a closure that ties the point
//! down. That is a value of `p`, or a length along the tangent in the plane of `p` and of the amplitude. The latter is Keller's
//! pseudo-arclength, in two measures instead of all unknowns. The secants of one point serve the next, so most points take a few periods.
//! The same search finds stable and unstable motions, and goes through folds.
//!
//! Everything here takes any body that the time loop steps, plane or solid: it sees a state, a step and the contact nodes. How loud a
//! cycle is tells [`Sound`], and which of two wins from which start [`ModeContest`].

mod branch;
mod contest;
mod corrector;
mod folds;
mod follower;
mod ladder;
mod map;
mod motion;
mod multipliers;
mod search;
mod secants;
mod sound;
mod two_frequencies;

pub use branch::{BranchMotion, BranchRequest, PeriodicBranch};
pub use contest::ModeContest;
pub use corrector::Point;
pub use ladder::{ASTRAY, GrowingMode, balanced_start, find_from, shortest};
pub use map::{PeriodImage, PeriodMap, PeriodicState};
pub use motion::{
    MotionFrame, MotionHarmonic, MotionRequest, PeriodicMotion, REFERENCE_VELOCITY, REMAINDER,
    velocity_level,
};
pub use search::{ACCEPTED, Found, TOLERANCE, find};
pub use sound::{AIR, FlatFace, REFERENCE_POWER, Sound};
