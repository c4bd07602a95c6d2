//! The figure of an identified damping, and what is kept to draw it again.

use crate::results::Record;
use crate::results::figures::{
    DampingIdentification, FigureError, Resonance, draw_damping_identification,
};
use crate::results::report::NamedFigure;
use crate::signal::{FrequencyResponse, Identification, ResponseQuantity};
use serde::{Deserialize, Serialize};

/// Everything that the figure shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IdentificationRecord {
    /// Frequencies of the response, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Magnitude of the response.
    pub magnitude: Vec<f64>,
    /// Magnitude of the fitted response; `None` outside the range of the fit.
    pub fitted: Vec<Option<f64>>,
    /// Its unit.
    pub magnitude_unit: String,
    /// Peak frequency, half-power frequencies (Hz) and damping factor of each resonance.
    pub resonances: Vec<[f64; 4]>,
    /// `alpha_R` and its 95 % interval, 1/s.
    pub mass_coefficient: [f64; 3],
    /// `beta_R` and its 95 % interval, s.
    pub stiffness_coefficient: [f64; 3],
}

impl Record for IdentificationRecord {
    const MAGIC: [u8; 8] = *b"FRICSIMI";
    const VERSION: u32 = 2;

    fn inconsistency(&self) -> Option<&'static str> {
        let count = self.frequencies_hz.len();
        let rises = self.frequencies_hz.windows(2).all(|pair| pair[0] < pair[1]);
        let is_whole = rises && count == self.magnitude.len() && count == self.fitted.len();
        (!is_whole).then_some("its frequencies and magnitudes do not fit together")
    }
}

impl IdentificationRecord {
    /// What the figure shows of the first response and what was found in it.
    pub fn of(response: &FrequencyResponse, found: &Identification) -> Self {
        let modes = found.modes.iter();
        let resonances = modes.filter_map(|mode| {
            let band = mode.half_power?;
            let (low, high) = band.band_hz?;
            let factor = mode.fitted.damping_factor.value;
            Some([band.frequency_hz, low, high, factor])
        });
        let (alpha, beta) = (
            found.rayleigh.mass_coefficient,
            found.rayleigh.stiffness_coefficient,
        );
        Self {
            frequencies_hz: response.frequencies_hz().to_vec(),
            magnitude: response.magnitudes(),
            fitted: (response.frequencies_hz().iter())
                .map(|f| found.fit.evaluate(0, *f).map(|h| h.norm()))
                .collect(),
            magnitude_unit: unit_of(response.quantity()).to_owned(),
            resonances: resonances.collect(),
            mass_coefficient: [alpha.value, alpha.low, alpha.high],
            stiffness_coefficient: [beta.value, beta.low, beta.high],
        }
    }
}

/// Unit of a response.
pub fn unit_of(quantity: ResponseQuantity) -> &'static str {
    match quantity {
        ResponseQuantity::Accelerance => "m/s²/N",
        ResponseQuantity::Mobility => "m/s/N",
        ResponseQuantity::Receptance => "m/N",
    }
}

/// Draws the response with its half-power points, and the damping factors with the fitted curve.
///
/// # Errors
/// That of the figure.
pub fn draw(record: &IdentificationRecord) -> Result<NamedFigure, FigureError> {
    let resonances = record.resonances.iter();
    let [alpha, beta] = [record.mass_coefficient, record.stiffness_coefficient];
    let svg = draw_damping_identification(&DampingIdentification {
        frequencies_hz: &record.frequencies_hz,
        magnitude: &record.magnitude,
        magnitude_unit: record.magnitude_unit.clone(),
        resonances: resonances
            .map(|&[frequency_hz, low, high, damping_factor]| Resonance {
                frequency_hz,
                half_power_hz: (low, high),
                damping_factor,
            })
            .collect(),
        mass_coefficient: alpha[0],
        stiffness_coefficient: beta[0],
        mass_interval: (alpha[1], alpha[2]),
        stiffness_interval: (beta[1], beta[2]),
    })?;
    Ok(NamedFigure {
        name: "identification".into(),
        caption: "Response with its half-power points, damping factors with the fit.".into(),
        svg,
    })
}
