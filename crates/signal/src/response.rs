//! Frequency response functions.

use super::error::{SignalError, check_finite, too_short};
use faer::c64;
use std::f64::consts::TAU;

/// What a frequency response relates to a unit force, by its number of time derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResponseQuantity {
    /// Displacement, m/N.
    Receptance,
    /// Velocity, m/s/N.
    Mobility,
    /// Acceleration, m/s2/N.
    Accelerance,
}

impl ResponseQuantity {
    /// Number of time derivatives of the displacement: receptance times `(i omega)^this`.
    pub fn derivatives(self) -> i32 {
        self as i32
    }

    /// Name as written in headers, cases and options.
    pub const fn name(self) -> &'static str {
        match self {
            ResponseQuantity::Receptance => "receptance",
            ResponseQuantity::Mobility => "mobility",
            ResponseQuantity::Accelerance => "accelerance",
        }
    }
}

/// Response to a unit harmonic force over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyResponse {
    frequencies_hz: Vec<f64>,
    values: Vec<c64>,
    quantity: ResponseQuantity,
    has_phase: bool,
    /// Variance of each line in units of the typical one, at least 1.
    variance_factors: Vec<f64>,
}

impl FrequencyResponse {
    /// A complex response at rising frequencies, Hz.
    ///
    /// # Errors
    /// [`SignalError`] for arrays of different or too small length (8), values that are not finite,
    /// or frequencies that are negative or do not rise.
    pub fn new(
        frequencies_hz: Vec<f64>,
        values: Vec<c64>,
        quantity: ResponseQuantity,
    ) -> Result<Self, SignalError> {
        Self::measured(frequencies_hz, values, quantity, true)
    }

    /// A response of which, without a phase, the moduli of the real parts alone count.
    pub fn measured(
        frequencies_hz: Vec<f64>,
        mut values: Vec<c64>,
        quantity: ResponseQuantity,
        has_phase: bool,
    ) -> Result<Self, SignalError> {
        if !has_phase {
            values.iter_mut().for_each(|z| *z = c64::new(z.re.abs(), 0.0));
        }
        if frequencies_hz.len() != values.len() {
            let (left, right) = (frequencies_hz.len(), values.len());
            let message = format!("{left} frequencies but {right} response values");
            return Err(SignalError::Unfit(message));
        }
        if values.len() < 8 {
            let remedy = "measure more frequency lines";
            return Err(too_short("the frequency response", values.len(), 8, remedy));
        }
        check_finite("frequency", &frequencies_hz)?;
        let parts: Vec<f64> = values.iter().map(|z| z.re + z.im).collect();
        check_finite("response value", &parts)?;
        for (i, f) in frequencies_hz.iter().enumerate() {
            if *f < 0.0 || (i > 0 && *f <= frequencies_hz[i - 1]) {
                return Err(SignalError::Unfit(format!(
                    "frequency number {} ({f} Hz) is not above the one before it: sort the table",
                    i + 1
                )));
            }
        }
        let variance_factors = vec![1.0; values.len()];
        Ok(Self { frequencies_hz, values, quantity, has_phase, variance_factors })
    }

    /// The same with lines of low coherence counting less in a fit.
    ///
    /// The relative variance of an H1 estimate goes as `(1 - c) / c` with the coherence `c`; lines above its
    /// median keep their weight, lines below lose it in that ratio, at most 1e4 times. Does not take noise for
    /// known: its size is found from the response. One coherence for each line.
    ///
    /// Source: J. S. Bendat and A. G. Piersol, "Random Data", 4th ed. (2010), section 9.2.
    pub fn with_coherence(mut self, coherence: &[f64]) -> Self {
        let variance = |c: &f64| {
            let c = c.clamp(1e-4, 1.0 - 1e-6);
            (1.0 - c) / c
        };
        let variances: Vec<f64> = coherence.iter().map(variance).collect();
        let typical = super::statistics::median(&variances).max(f64::MIN_POSITIVE);
        for (factor, variance) in self.variance_factors.iter_mut().zip(&variances) {
            *factor = (variance / typical).clamp(1.0, 1e4);
        }
        self
    }

    /// Takes the complex conjugate: the response under the other sign of `exp(i omega t)`.
    pub fn conjugate(&mut self) {
        self.values.iter_mut().for_each(|z| *z = z.conj());
    }

    /// Whether the phase rises through the resonances, as it does under `exp(-i omega t)`.
    ///
    /// Every resonance draws a circle in the complex plane, clockwise under `exp(i omega t)`: twice the area
    /// swept, `sum Im(conj(H_k) H_{k+1})`, is `-pi/2` times the square of its diameter. A third of that for
    /// the largest modulus, of the other sign, is no chance of noise.
    pub fn turns_backwards(&self) -> bool {
        let pairs = self.values.windows(2);
        let area: f64 = pairs.map(|pair| (pair[0].conj() * pair[1]).im).sum();
        let largest = self.values.iter().map(|z| z.norm_sqr()).fold(0.0, f64::max);
        self.has_phase && area > 0.5 * largest
    }

    /// Variance of each line in units of the typical one, at least 1.
    pub fn variance_factors(&self) -> &[f64] {
        &self.variance_factors
    }

    /// Frequencies, Hz, rising.
    pub fn frequencies_hz(&self) -> &[f64] {
        &self.frequencies_hz
    }

    /// Response values, SI; real and non-negative where the phase is unknown.
    pub fn values(&self) -> &[c64] {
        &self.values
    }

    /// Moduli of the response.
    pub fn magnitudes(&self) -> Vec<f64> {
        self.values.iter().map(|z| z.norm()).collect()
    }

    /// Receptance, mobility or accelerance.
    pub fn quantity(&self) -> ResponseQuantity {
        self.quantity
    }

    /// Whether the phase is known.
    pub fn has_phase(&self) -> bool {
        self.has_phase
    }

    /// The same response as another quantity: values times `(i omega)^k`, `k` the difference in
    /// time derivatives. A line at 0 Hz, which cannot be integrated, is left out.
    ///
    /// # Errors
    /// [`SignalError::Unfit`] if fewer than 8 lines remain.
    pub fn converted(&self, quantity: ResponseQuantity) -> Result<Self, SignalError> {
        let power = quantity.derivatives() - self.quantity.derivatives();
        let skip = usize::from(power < 0 && self.frequencies_hz[0] == 0.0);
        let frequencies_hz = self.frequencies_hz[skip..].to_vec();
        let factor = |f: &f64| match self.has_phase {
            true => c64::new(0.0, TAU * f).powi(power),
            false => c64::new((TAU * f).powi(power), 0.0),
        };
        let pairs = frequencies_hz.iter().zip(&self.values[skip..]);
        let values = pairs.map(|(f, z)| z * factor(f)).collect();
        let converted = Self::measured(frequencies_hz, values, quantity, self.has_phase)?;
        Ok(Self { variance_factors: self.variance_factors[skip..].to_vec(), ..converted })
    }

    /// The lines between two frequencies, both included, Hz.
    ///
    /// # Errors
    /// [`SignalError::Unfit`] if fewer than 8 lines remain.
    pub fn within(&self, low_hz: f64, high_hz: f64) -> Result<Self, SignalError> {
        let first = self.frequencies_hz.partition_point(|f| *f < low_hz);
        let last = self.frequencies_hz.partition_point(|f| *f <= high_hz).max(first);
        let frequencies_hz = self.frequencies_hz[first..last].to_vec();
        let values = self.values[first..last].to_vec();
        let part = Self::measured(frequencies_hz, values, self.quantity, self.has_phase)?;
        Ok(Self { variance_factors: self.variance_factors[first..last].to_vec(), ..part })
    }
}
