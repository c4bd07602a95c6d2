//! Complex eigenvalue analysis: the stability of steady sliding.

pub mod cyclic;
pub mod sparse;
mod spectrum;

pub use spectrum::{ComplexMode, FrictionPoint, FrictionSweep, UnstableInterval, keeping_ties};
