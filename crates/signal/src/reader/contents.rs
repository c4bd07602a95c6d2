//! Contents of a file of measurements.

use super::super::FrequencyResponse;

/// A response and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedResponse {
    /// Name of its column without the words for real and imaginary part, or `response k`.
    pub name: String,
    /// The response.
    pub response: FrequencyResponse,
}

/// Frequency responses and what the reader had to decide.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFile {
    /// The responses, at least one.
    pub responses: Vec<NamedResponse>,
    /// Decisions a user should know of: rows sorted, repeated rows dropped, quantity assumed.
    pub notes: Vec<String>,
}

/// One column of a signal table.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name as written, or `channel k`.
    pub name: String,
    /// Samples, in the unit of the file.
    pub samples: Vec<f64>,
}

/// Equidistant samples of one or more channels.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalFile {
    /// Sampling rate, Hz.
    pub sampling_rate: f64,
    /// Time of the first sample, s.
    pub start: f64,
    /// Channels in the order of their columns, of one length, at least one.
    pub channels: Vec<Channel>,
    /// Decisions a user should know of.
    pub notes: Vec<String>,
}
