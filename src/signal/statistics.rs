//! Quantiles and correlation, for confidence intervals.

/// Two-sided 95 % quantile of the normal distribution.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Two-sided 95 % quantile of Student's t with `degrees >= 1` degrees of freedom.
///
/// Cornish-Fisher expansion about the normal quantile from 6 degrees on (error below 1e-3),
/// tabulated below, where the expansion fails (Abramowitz and Stegun 26.7.5).
pub(super) fn student_95(degrees: f64) -> f64 {
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

/// Median; 0 of nothing.
pub(super) fn median(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let half = sorted.len() / 2;
    if sorted.len() % 2 == 1 {
        sorted[half]
    } else {
        0.5 * (sorted[half - 1] + sorted[half])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn student_quantiles_match_the_published_table() {
        for (n, t) in [
            (1.0, 12.706),
            (5.0, 2.571),
            (6.0, 2.447),
            (10.0, 2.228),
            (30.0, 2.042),
        ] {
            assert!((student_95(n) - t).abs() < 2e-3, "{n}: {}", student_95(n));
        }
    }
}
