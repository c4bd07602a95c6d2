//! Complex eigenvalue analysis: the stability of steady sliding.

mod spectrum;

pub use spectrum::{ComplexMode, FrictionPoint, FrictionSweep, UnstableInterval};
