//! Errors of a signal or a frequency response.

/// A signal or frequency response that cannot be analysed as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SignalError {
    /// Samples, lines or modes that are too few, not finite, out of order or in one place: which, and the remedy.
    #[error("{0}")]
    Unfit(String),
    /// A number asked for that is not positive, or a resolution that the record cannot give: what to change.
    #[error("{0}")]
    Asked(String),
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
    /// Resonances exist, but none can be resolved: what the resolution is, and the remedy.
    #[error("{0}")]
    Unresolved(String),
}

/// A fit that cannot be computed.
pub(super) fn failed_fit(why: &str) -> SignalError {
    SignalError::Unfit(format!("the modal fit failed: {why}"))
}

/// Fewer samples than the analysis needs.
pub(super) fn too_short(what: &str, count: usize, needed: usize, remedy: &str) -> SignalError {
    SignalError::Unfit(format!("{what} has {count} samples; {needed} or more are needed: {remedy}"))
}

/// Checks that every sample is finite.
pub(super) fn check_finite(what: &'static str, samples: &[f64]) -> Result<(), SignalError> {
    let Some(place) = samples.iter().position(|v| !v.is_finite()) else { return Ok(()) };
    let (number, value) = (place + 1, samples[place]);
    let remedy = "remove it or repair the measurement";
    Err(SignalError::Unfit(format!("{what} number {number} is {value}: {remedy}")))
}

/// A number that must be positive and finite and is not; the remedy begins with punctuation, or is nothing.
pub(super) fn not_positive(what: &str, value: f64, remedy: &str) -> SignalError {
    SignalError::Asked(format!("{what} = {value} must be a positive finite number{remedy}"))
}

/// Checks that a parameter is positive and finite.
pub(super) fn check_positive(
    what: &'static str,
    value: f64,
    remedy: &'static str,
) -> Result<(), SignalError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(not_positive(what, value, remedy)) }
}
