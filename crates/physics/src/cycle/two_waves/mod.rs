//! Motions of two frequencies: two rotating waves that live together.
//!
//! On a rotating wave a perturbation of another wavelength may begin to grow, at a frequency of its own (a Neimark-Sacker bifurcation). The
//! disc then comes to a motion in which both waves turn, each at its frequency:
//!
//! ```text
//! u(r, theta, t) = U(r, xi_1, xi_2),   xi_a = n_a theta + omega_a t
//! ```
//!
//! with `U` periodic in both phases. Every contact node goes through the same torus of phases. So the motion is a steady frictional contact
//! problem on a grid of both, with two unknown frequencies ([`TwoWaves`]). It is harmonic balance in two dimensions, with one receptance of
//! the body for each harmonic `(k_1, k_2)`. That harmonic has `n = k_1 n_1 + k_2 n_2` around the circumference and the frequency `k_1
//! omega_1 + k_2 omega_2`. The motion is sought from what a transient of the mesh settles on ([`TwoWaveSearch`]), by Newton's method on all
//! contact states at once. It is followed over a parameter down to where one wave vanishes ([`TwoWaveBranch`]).

mod branch;
mod history;
mod motion;
mod newton;
mod search;

pub use branch::TwoWaveBranch;
pub use history::Measured;
pub use motion::TwoWaveMotion;
pub use newton::TwoWaves;
pub use search::TwoWaveSearch;
