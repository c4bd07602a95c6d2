//! Measured and computed signals: spectra, spectrograms, growth rates, modal damping.
//!
//! Two roads lead through this module. A *time signal* becomes a spectrum ([`averaged_spectrum`]), a [`spectrogram`],
//! spectral lines with their superharmonics ([`spectral_lines`]) and the rate of its exponential stage
//! ([`exponential_stage`], [`harmonic_growth`]). A *frequency response* becomes modal frequencies and damping factors
//! ([`half_power`], [`fit_modes`]), and these Rayleigh's coefficients ([`fit_rayleigh`]). [`identify`] does all of it.
//!
//! [`reader`] turns files into either kind. Nothing here touches a file.

mod error;
#[cfg(test)]
mod fixtures;
mod growth;
mod lines;
mod modal;
pub mod reader;
mod response;
mod rotating;
mod spectrogram;
mod spectrum;
mod statistics;
mod transform;
mod window;

pub use error::SignalError;
pub use growth::{
    ExponentialStage, NoGrowth, exponential_stage, harmonic_growth, round_off_floor,
    strongest_vibration,
};
pub use lines::{SpectralLine, SpectralResolution, Superharmonic, main_frequency, spectral_lines};
pub use modal::{
    Estimate, FittedMode, HalfPowerBand, Identification, ModalFit, ModalModel, ModalShare,
    NoiseModel, Pole, RayleighFit, ResonanceNote, fit_modes, fit_rayleigh, half_power, identify,
    prominence,
};
pub use response::{FrequencyResponse, ResponseQuantity};
pub use rotating::{RotatingLine, rotating_lines};
pub use spectrogram::{Spectrogram, USUAL_WINDOW, spectrogram};
pub use spectrum::{AmplitudeSpectrum, averaged_spectrum, centred, top_of};
pub use statistics::student_95;
pub use transform::{Fft, forward_transform, inverse_transform};
pub use window::Window;
