//! Linear and logarithmic scales.

use serde::{Deserialize, Serialize};

/// Linear or logarithmic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios; values that are not positive have no place.
    Logarithmic,
}

impl Scale {
    /// Logarithmic for positive values over more than a factor.
    pub fn for_values(values: impl IntoIterator<Item = f64>, factor: f64) -> Self {
        match extremes(values) {
            (low, high) if low > 0.0 && high > factor * low => Self::Logarithmic,
            _ => Self::Linear,
        }
    }
}

/// Smallest and largest finite value; `(0, 1)` if there is none.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let ends =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if ends.0 > ends.1 { (0.0, 1.0) } else { ends }
}
