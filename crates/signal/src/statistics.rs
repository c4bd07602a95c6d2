//! Quantiles and correlation, for confidence intervals.

/// Two-sided 95 % quantile of the normal distribution.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Two-sided 95 % quantile of Student's t with `degrees >= 1` degrees of freedom.
///
/// Cornish-Fisher expansion about the normal quantile from 6 degrees on (error below 1e-3),
/// tabulated below, where the expansion fails (Abramowitz and Stegun 26.7.5).
pub fn student_95(degrees: f64) -> f64 {
    const TABLE: [f64; 5] = [12.706_2, 4.302_65, 3.182_45, 2.776_45, 2.570_58];
    let n = degrees.max(1.0);
    if n < 6.0 {
        return TABLE[n.floor() as usize - 1];
    }
    let z = NORMAL_95;
    let z2 = z * z;
    z + z * (z2 + 1.0) / (4.0 * n)
        + z * ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * n * n)
        + z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * n * n * n)
}

/// Upper quantile of the normal distribution: exceeded with a probability of at most 0.5.
///
/// Absolute error below 4.5e-4 (Abramowitz and Stegun 26.2.23).
pub(super) fn normal_exceeded(probability: f64) -> f64 {
    let t = (-2.0 * probability.ln()).sqrt();
    let numerator = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    t - numerator / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)))
}

/// Quantiles of a mean of `count` exponential variables of mean 1 (Wilson and Hilferty): exceeded with
/// the probability at which a normal variable exceeds `z`.
pub(super) fn mean_power_exceeded(count: f64, z: f64) -> f64 {
    let share = 1.0 / (9.0 * count);
    (1.0 - share + z * share.sqrt()).powi(3)
}

/// Median; 0 of nothing.
pub(super) fn median(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let mut parted = values.to_vec();
    let half = parted.len() / 2;
    let (below, upper, _) = parted.select_nth_unstable_by(half, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp);
    if values.len() % 2 == 1 { *upper } else { 0.5 * (lower.unwrap_or(*upper) + *upper) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_noise_powers_match_closed_forms() {
        // Of one exponential variable the quantile is -ln p, and the median ln 2.
        for probability in [1e-2, 1e-4, 1e-7] {
            let found = mean_power_exceeded(1.0, normal_exceeded(probability));
            assert!((found / -probability.ln() - 1.0).abs() < 0.12, "{found}");
        }
        assert!((mean_power_exceeded(1.0, 0.0) / std::f64::consts::LN_2 - 1.0).abs() < 0.02);
        assert!((normal_exceeded(0.025) - NORMAL_95).abs() < 5e-4);
    }

    #[test]
    fn student_quantiles_match_the_published_table() {
        for (n, t) in [(1.0, 12.706), (5.0, 2.571), (6.0, 2.447), (10.0, 2.228), (30.0, 2.042)] {
            assert!((student_95(n) - t).abs() < 2e-3, "{n}: {}", student_95(n));
        }
    }
}
