//! From frequency responses to modes and Rayleigh coefficients, in the order of the files.
//!
//! A response becomes peaks with half-power bands ([`half_power()`]). They start the fit of one modal model to all
//! responses ([`fit_modes`]). Its model functions are in `basis`, the weighted problem in `least_squares`, its noise in
//! `noise`. The damping factors give the coefficients ([`fit_rayleigh`]). [`identify`] is the whole way.

mod basis;
mod fit;
mod half_power;
mod identification;
mod least_squares;
mod noise;
mod normal_equations;
mod rayleigh;

pub use basis::{ModalModel, ModalShare, Pole};
pub use fit::{FittedMode, ModalFit, fit_modes};
pub use half_power::{HalfPowerBand, ResonanceNote, half_power, prominence};
pub use identification::{Identification, identify};
pub use noise::NoiseModel;
pub use rayleigh::{Estimate, RayleighFit, fit_rayleigh};
