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
    #[inline]
    pub fn below(&self, x: f64) -> f64 {
        match *self {
            Self::Normal { mean, deviation } => normal_below((x - mean) / deviation),
            Self::LogNormal { .. } if x <= 0.0 => 0.0,
            Self::LogNormal { median, deviation } => normal_below((x / median).ln() / deviation),
            Self::Uniform { from, to } => ((x - from) / (to - from)).clamp(0.0, 1.0),
        }
    }

    /// The value below which others lie with a probability strictly between 0 and 1.
    #[inline]
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

/// Probability that a normal variable of mean 0 and deviation 1 lies below `x`; absolute error below 1e-15, relative error
/// of far tails below 1e-8.
///
/// G. West, "Better approximations to cumulative normal functions", Wilmott (2005), after J. F. Hart.
fn normal_below(x: f64) -> f64 {
    const NUMERATOR: [f64; 7] = [
        3.52624965998911e-2,
        0.700383064443688,
        6.37396220353165,
        33.912866078383,
        112.079291497871,
        221.213596169931,
        220.206867912376,
    ];
    const DENOMINATOR: [f64; 8] = [
        8.83883476483184e-2,
        1.75566716318264,
        16.064177579207,
        86.7807322029461,
        296.564248779674,
        637.333633378831,
        793.826512519948,
        440.413735824752,
    ];
    let size = x.abs();
    let horner = |c: &[f64]| c.iter().fold(0.0, |sum, c| sum * size + c);
    let density = (-0.5 * size * size).exp();
    let tail = if size > 37.0 {
        0.0
    } else if size < 5.0 * SQRT_2 {
        density * horner(&NUMERATOR) / horner(&DENOMINATOR)
    } else {
        let fraction = [4.0, 3.0, 2.0, 1.0].iter().fold(size + 0.65, |b, k| size + k / b);
        density / fraction / (2.0 * PI).sqrt()
    };
    if x > 0.0 { 1.0 - tail } else { tail }
}

/// Inverse of [`normal_below`]: a first value (Abramowitz and Stegun 26.2.23), then Halley's steps.
fn normal_quantile(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability);
    let t = (-2.0 * tail.ln()).sqrt();
    let numerator = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let mut x = numerator / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308))) - t;
    for _ in 0..3 {
        let density = (-0.5 * x * x).exp() / (2.0 * PI).sqrt();
        let newton = (normal_below(x) - tail) / density;
        x -= newton / (1.0 + 0.5 * x * newton);
    }
    if probability > 0.5 { -x } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_distribution_is_that_of_the_error_function() {
        for i in -80..=80 {
            let x = 0.1 * f64::from(i);
            let exact = 0.5 * libm::erfc(-x / SQRT_2);
            let tail = exact.min(1.0 - exact);
            assert!((normal_below(x) - exact).abs() < 1e-8 * tail.min(1e-7) + 3e-16, "{x}");
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
