//! Errors of a signal or a frequency response.

/// A signal or frequency response that cannot be analysed as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SignalError {
    /// Fewer samples than the analysis needs.
    #[error("{what} has {count} samples; {needed} or more are needed: {remedy}")]
    TooShort {
        /// What is short.
        what: &'static str,
        /// Samples given.
        count: usize,
        /// Samples needed.
        needed: usize,
        /// What to change.
        remedy: &'static str,
    },
    /// A number that must be positive and finite is not.
    #[error("{what} = {value} must be a positive finite number{remedy}")]
    NotPositive {
        /// Name of the quantity.
        what: &'static str,
        /// Given value.
        value: f64,
        /// What to change, beginning with punctuation, or nothing.
        remedy: &'static str,
    },
    /// A sample is NaN or infinite.
    #[error("{what} number {index} is {value}: remove it or repair the measurement")]
    NotFinite {
        /// What is not finite.
        what: &'static str,
        /// 1-based position.
        index: usize,
        /// The value.
        value: f64,
    },
    /// Frequencies that do not rise.
    #[error("frequency number {index} ({value} Hz) is not above the one before it: sort the table")]
    NotRising {
        /// 1-based position.
        index: usize,
        /// The value, Hz.
        value: f64,
    },
    /// Two arrays that must have one length have not.
    #[error("{left} frequencies but {right} response values")]
    Length {
        /// Number of frequencies.
        left: usize,
        /// Number of values.
        right: usize,
    },
    /// No resonance stands out of the noise.
    #[error(
        "no resonance found between {low_hz} and {high_hz} Hz: no peak stands out from the noise; \
         widen the frequency range or average more measurements"
    )]
    NoResonance {
        /// Lowest frequency, Hz.
        low_hz: f64,
        /// Highest frequency, Hz.
        high_hz: f64,
    },
    /// Resonances exist, but none can be resolved.
    #[error(
        "the frequency resolution of {resolution_hz} Hz is too coarse: the half-power band of the \
         resonance at {frequency_hz} Hz holds fewer than {needed} lines. Measure longer, or zoom"
    )]
    Unresolved {
        /// Spacing of the frequency lines, Hz.
        resolution_hz: f64,
        /// Resonance, Hz.
        frequency_hz: f64,
        /// Lines a half-power band needs.
        needed: usize,
    },
    /// Too few damping factors for the two Rayleigh coefficients.
    #[error(
        "{0} usable damping factor(s): alpha_R and beta_R with an uncertainty need at least 2 \
         modes of known uncertainty, or 3 without. Widen the frequency range"
    )]
    TooFewModes(usize),
    /// A resolution of a spectrum that the record cannot give.
    #[error(
        "a resolution of {asked_hz} Hz is out of reach: this record gives {finest_hz} to \
         {coarsest_hz} Hz; change --resolution, or the interval"
    )]
    Resolution {
        /// Asked for, Hz.
        asked_hz: f64,
        /// Finest that the length gives, Hz.
        finest_hz: f64,
        /// Coarsest that the sampling rate gives, Hz.
        coarsest_hz: f64,
    },
    /// The fit cannot be computed.
    #[error("the modal fit failed: {0}")]
    Fit(&'static str),
}

/// Checks that every sample is finite.
pub(super) fn check_finite(what: &'static str, samples: &[f64]) -> Result<(), SignalError> {
    match samples.iter().position(|v| !v.is_finite()) {
        Some(i) => Err(SignalError::NotFinite { what, index: i + 1, value: samples[i] }),
        None => Ok(()),
    }
}

/// Checks that a parameter is positive and finite.
pub(super) fn check_positive(
    what: &'static str,
    value: f64,
    remedy: &'static str,
) -> Result<(), SignalError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(SignalError::NotPositive { what, value, remedy })
    }
}
