//! Colours and colour maps.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Text, axes and outlines.
pub const INK: &str = "#222222";
/// Grid lines.
pub const GRID: &str = "#dddddd";
/// Second-rank lines and text.
pub const MUTED: &str = "#666666";

/// Okabe and Ito's colour-blind-safe set, with grey for its yellow, too light for lines, and its black, that of sums.
pub const SERIES: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#808080"];

/// Red, green and blue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Colour(pub [u8; 3]);

impl From<&str> for Colour {
    /// The colour of `#rrggbb`; black of any other text.
    fn from(hex: &str) -> Self {
        Self([1, 3, 5].map(|at| {
            let digits = hex.get(at..at + 2);
            digits.map_or(0, |digits| u8::from_str_radix(digits, 16).unwrap_or(0))
        }))
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([red, green, blue]) = self;
        write!(out, "#{red:02x}{green:02x}{blue:02x}")
    }
}

/// A perceptually uniform colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ColourMap {
    /// Dark blue to yellow, for amplitudes.
    Viridis,
    /// Black to pale yellow, for spectra.
    Inferno,
    /// Blue through white to red, for signed values.
    Diverging,
}

impl ColourMap {
    /// Colour at `position` from 0 to 1.
    pub fn at(self, position: f64) -> [u8; 3] {
        let position = if position.is_finite() { position.clamp(0.0, 1.0) } else { 0.0 };
        let colour = match self {
            Self::Viridis => colorous::VIRIDIS.eval_continuous(position),
            Self::Inferno => colorous::INFERNO.eval_continuous(position),
            Self::Diverging => colorous::RED_BLUE.eval_continuous(1.0 - position),
        };
        [colour.r, colour.g, colour.b]
    }
}
