//! Numbers as text, units with prefixes, ranges and scales.

use serde::{Deserialize, Serialize};

/// A number with `decimals` decimals and a true minus sign.
pub fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{:.*}", decimals, value.abs());
    let is_zero = text.chars().all(|c| c == '0' || c == '.');
    if value < 0.0 && !is_zero { format!("−{text}") } else { text }
}

/// A number with `digits` significant digits, in plain or scientific notation (mark-up).
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { "–".into() };
    }
    let power = value.abs().log10().floor() as i32;
    if (-3..5).contains(&power) {
        return signed(value, (digits as i32 - 1 - power).max(0) as usize);
    }
    let mantissa = signed(value / 10f64.powi(power), digits.saturating_sub(1));
    format!("{mantissa}·10^{{{}}}", signed(f64::from(power), 0))
}

/// Factor and prefixed unit that bring values up to `reach` near 1 to 1000: `(1e-3, "kW")`.
pub fn prefixed(reach: f64, unit: &str) -> (f64, String) {
    #[rustfmt::skip]
    const PREFIXES: [(f64, &str); 9] = [
        (1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""),
        (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"), (1e-15, "f"),
    ];
    let is_meant = |size: f64| reach.is_finite() && reach.abs() >= size;
    let (size, prefix) = PREFIXES.into_iter().find(|known| is_meant(known.0)).unwrap_or((1.0, ""));
    (1.0 / size, format!("{prefix}{unit}"))
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_follow_the_size() {
        assert_eq!(prefixed(1370.0, "W"), (1e-3, "kW".into()));
        assert_eq!(prefixed(3e-5, "m").1, "µm");
        assert_eq!(prefixed(0.0, "J"), (1.0, "J".into()));
    }
}
