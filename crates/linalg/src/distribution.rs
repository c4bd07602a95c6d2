//! Distributions of one random number.

use std::f64::consts::{PI, SQRT_2};

/// How a number is distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Gauss's.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
    /// The logarithm is normally distributed.
    LogNormal {
        /// Median.
        median: f64,
        /// Standard deviation of the natural logarithm.
        deviation: f64,
    },
    /// Every value between two ends alike.
    Uniform {
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
}

impl Distribution {
    /// Probability of a value below `x`.
    pub fn below(&self, x: f64) -> f64 {
        match *self {
            Self::Normal { mean, deviation } => normal_below((x - mean) / deviation),
            Self::LogNormal { .. } if x <= 0.0 => 0.0, // Nothing lies there, and it has no logarithm.
            Self::LogNormal { median, deviation } => normal_below((x / median).ln() / deviation),
            Self::Uniform { from, to } => ((x - from) / (to - from)).clamp(0.0, 1.0),
        }
    }

    /// The value below which others lie with a probability strictly between 0 and 1.
    pub fn quantile(&self, probability: f64) -> f64 {
        match *self {
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(probability),
            Self::LogNormal { median, deviation } => {
                median * (deviation * normal_quantile(probability)).exp()
            }
            Self::Uniform { from, to } => from + probability * (to - from),
        }
    }
}

/// Probability that a normal variable of mean 0 and deviation 1 lies below `x`.
fn normal_below(x: f64) -> f64 {
    0.5 * libm::erfc(-x / SQRT_2) // In the lower tail 1 + erf would cancel.
}

/// Inverse of [`normal_below`]: a first value (Abramowitz and Stegun 26.2.23), then Halley's steps.
fn normal_quantile(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability);
    let t = (-2.0 * tail.ln()).sqrt();
    let numerator = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let mut x = numerator / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308))) - t;
    for _ in 0..3 {
        let density = (-0.5 * x * x).exp() / (2.0 * PI).sqrt(); // Halley: x -= u / (1 + x u / 2), u = (P(x) - p) / P'(x).
        let newton = (normal_below(x) - tail) / density;
        x -= newton / (1.0 + 0.5 * x * newton);
    }
    // The upper tail is the mirror image of the lower one.
    if probability > 0.5 { -x } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tabulated: far tails keep their digits.
    #[test]
    fn the_normal_distribution_has_its_tabulated_values() {
        let table = [
            (-8.0, 6.220_960_574_271_785e-16),
            (-5.0, 2.866_515_718_791_939e-7),
            (-1.959_963_984_540_054, 0.025),
            (0.0, 0.5),
            (1.0, 0.841_344_746_068_542_9),
        ];
        for (x, exact) in table {
            assert!((normal_below(x) / exact - 1.0).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn quantiles_invert_the_distribution() {
        let all = [
            Distribution::Normal { mean: 2.0, deviation: 0.5 },
            Distribution::LogNormal { median: 7.4e12, deviation: 0.3 },
            Distribution::Uniform { from: -1.0, to: 3.0 },
        ];
        for distribution in all {
            for p in [1e-9, 1e-4, 0.025, 0.3, 0.5, 0.7, 0.975, 1.0 - 1e-6] {
                let found = distribution.below(distribution.quantile(p));
                assert!((found - p).abs() < 1e-11 * p + 1e-15, "{distribution:?} {p} {found}");
            }
        }
    }
}
