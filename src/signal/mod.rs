//! Measured and computed signals: spectra, spectrograms, growth rates, modal damping.
//!
//! Two roads lead through this module. A *time signal* becomes a spectrum
//! ([`amplitude_spectrum`], [`averaged_spectrum`]), a [`spectrogram`], spectral lines with
//! their superharmonics ([`spectral_lines`]) and the rate of its exponential stage
//! ([`exponential_stage`], [`harmonic_growth`]). A *frequency response* becomes modal frequencies and damping factors
//! ([`half_power`], [`fit_modes`]) and from them the two Rayleigh coefficients of
//! `zeta = (alpha_R / omega + beta_R omega) / 2` ([`fit_rayleigh`]); [`identify`] does all of it.
//!
//! [`reader`] turns text tables into either kind. Nothing here touches a file.

mod error;
mod growth;
mod half_power;
mod identification;
mod least_squares;
mod lines;
mod modal_basis;
mod modal_fit;
mod noise;
mod rayleigh;
pub mod reader;
mod response;
mod spectrogram;
mod spectrum;
mod statistics;
mod window;

pub use error::SignalError;
pub use growth::{
    ExponentialStage, NoGrowth, exponential_stage, harmonic_growth, round_off_floor,
    strongest_vibration,
};
pub use half_power::{HalfPowerBand, ResonanceNote, half_power};
pub use identification::{Identification, IdentificationOptions, IdentifiedMode, identify};
pub use lines::{SpectralLine, SpectralResolution, main_frequency, spectral_lines};
pub use modal_basis::{ModalModel, Pole};
pub use modal_fit::{FittedMode, ModalFit, fit_modes};
pub use noise::NoiseModel;
pub use rayleigh::{DampingSample, Estimate, RayleighFit, fit_rayleigh};
pub use response::{FrequencyResponse, ResponseQuantity};
pub use spectrogram::{Spectrogram, SpectrogramOptions, spectrogram};
pub use spectrum::{AmplitudeSpectrum, amplitude_spectrum, averaged_spectrum};
pub use window::Window;
