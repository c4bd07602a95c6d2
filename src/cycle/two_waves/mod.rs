//! Motions of two frequencies: two rotating waves that live together.
//!
//! Where a perturbation of another wavelength begins to grow on a rotating wave, at a frequency of its own (a Neimark-Sacker
//! bifurcation), the disc comes to a motion in which both waves turn, each at its frequency:
//!
//! ```text
//! u(r, theta, t) = U(r, xi_1, xi_2),   xi_a = n_a theta + omega_a t
//! ```
//!
//! with `U` periodic in both phases. Every contact node goes through the same torus of phases, so that the motion is a steady
//! frictional contact problem on a grid of both, with two unknown frequencies: harmonic balance in two dimensions, with one
//! receptance of the body for each harmonic `(k_1, k_2)` of `n = k_1 n_1 + k_2 n_2` around the circumference and of the frequency
//! `k_1 omega_1 + k_2 omega_2` ([`TwoWaves`]). It is found from what a transient of the mesh settles on ([`TwoWaveSearch`]), by Newton's
//! method on the contact states of all points at once, and followed over a parameter down to where one wave vanishes
//! ([`TwoWaveBranch`]).

mod branch;
mod history;
mod motion;
mod newton;
mod search;

pub use branch::TwoWaveBranch;
pub use history::Measured;
pub use motion::TwoWaveMotion;
pub use newton::TwoWaves;
pub use search::{NoTwoWaves, TwoWaveSearch};
