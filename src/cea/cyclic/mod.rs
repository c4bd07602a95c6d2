//! The eigenvalues of a rotationally symmetric annulus, harmonic by harmonic.
//!
//! In steady sliding all sectors of a uniform annulus are alike. So each circumferential harmonic
//! `n` is a small banded problem of its own (see [`crate::prestress::WaveTangent`]). Without
//! friction the problems are real and symmetric, and inertia counts their modes: none is missed.
//! Then each mode is followed continuously over the friction coefficient by two-sided Rayleigh
//! quotient iteration.

mod branch;
mod collision;
mod completeness;
mod definite;
mod follow;
mod modes;
mod path;
mod paths;
mod problem;
mod rest;
mod sensitivity;
mod solid;
mod sweep;
mod vectors;

pub use sensitivity::{Beside, WavePair, wave_pairs, wave_responses};
pub use solid::{SolidModel, solid_sweep, solid_sweep_with_waves};
pub use sweep::{Coverage, Overdamped, WaveSweep, onsets, sweep, sweep_with_waves};
