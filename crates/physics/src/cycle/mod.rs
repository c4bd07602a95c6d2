//! Limit cycles found directly: rotating waves as steady contact problems.
//!
//! In a rotationally symmetric disc the limit cycle of an unstable wave is `u(r, theta, t) = U(r, xi)` with `xi = n theta + omega t`. Every
//! contact node goes through the same motion, one after the other. So the cycle is a *steady* frictional contact problem along the phase
//! `xi`, with one unknown frequency. The body is a 2 x 2 receptance for each temporal harmonic (`WaveBody`); Signorini's and Coulomb's
//! laws hold at points along the phase. A branch of cycles is followed from its birth in steady sliding through every change of contact
//! state ([`CycleSolver`]). Cycles are born where the eigenvalue analysis has its onsets ([`DiscModel`]); their stability is that of the
//! transient's own step, linearized over one period ([`MeshStepping`]). Two waves that live together, each at its own frequency, are a
//! steady contact problem along both phases ([`TwoWaves`]).
//!
//! How a branch goes on from step to step to its ends, whatever finds its points, is said once, in `continuation`.
//!
//! Bodies without symmetry have no rotating waves; their cycles are periodic motions of the whole mesh ([`periodic`]).

mod arnoldi;
mod basin;
mod body;
mod branch;
mod confirmation;
mod continuation;
mod error;
mod family;
mod field;
mod floquet;
mod grid;
mod limit_cycle;
mod moving;
mod onset;
mod parameter;
pub mod periodic;
mod solver;
mod stability;
mod state;
mod stepping;
mod system;
mod two_waves;
mod wave;

pub use basin::{BasinBoundary, BasinRequest, BasinRun};
pub use body::DiscModel;
pub use confirmation::Confirmation;
pub use continuation::BranchEnd;
pub use error::CycleError;
pub use family::{Family, LARGEST_FRICTION};
pub use floquet::SteppedCycle;
pub use limit_cycle::{CyclePowers, LimitCycle, PhasePoint};
pub use onset::{MODES, Onset};
pub use parameter::{OperatingPoint, Parameter};
pub use solver::{CycleBranch, CycleSolver};
pub use stability::{FloquetMultiplier, FloquetMultipliers, RidingMode};
pub use stability::{StabilityChange, Verdict, differing};
pub use state::{PointState, WaveState};
pub use stepping::{MeshStepping, Period};
pub use two_waves::{Measured, TwoWaveBranch, TwoWaveMotion, TwoWaveSearch, TwoWaves};
