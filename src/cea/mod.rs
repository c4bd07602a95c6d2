//! Complex eigenvalue analysis: the stability of steady sliding.

pub mod cyclic;
mod spectrum;

pub use spectrum::{ComplexMode, FrictionPoint, FrictionSweep, UnstableInterval};
