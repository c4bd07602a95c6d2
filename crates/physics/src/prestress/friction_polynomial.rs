//! Vectors that are polynomials in the friction coefficient.

/// Coefficients by power of the polynomial through `values` at `points` (Newton's divided differences), without
/// trailing ones that are round-off within the `reach` of zero.
pub(super) fn interpolated(points: &[f64], mut values: Vec<Vec<f64>>, reach: f64) -> Vec<Vec<f64>> {
    let count = points.len();
    let size = |values: &Vec<f64>| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let scale = values.iter().map(size).fold(0.0_f64, f64::max);
    // f[k-order..k] = (f[k] - f[k-1]) / (mu_k - mu_k-order), in place from the last on.
    for order in 1..count {
        for k in (order..count).rev() {
            let (before, after) = values.split_at_mut(k);
            let span = points[k] - points[k - order];
            for (value, previous) in after[0].iter_mut().zip(&before[k - 1]) {
                *value = (*value - previous) / span;
            }
        }
    }
    // Horner's scheme from Newton's form to powers.
    let mut powers: Vec<Vec<f64>> = vec![values[count - 1].clone()];
    for k in (0..count - 1).rev() {
        powers.insert(0, vec![0.0; values[k].len()]);
        for power in 0..powers.len() {
            for at in 0..values[k].len() {
                let above = powers.get(power + 1).map_or(0.0, |p| p[at]);
                powers[power][at] -= points[k] * above; // p <- p (mu - mu_k).
            }
        }
        for (sum, value) in powers[0].iter_mut().zip(&values[k]) {
            *sum += value;
        }
    }
    // A power whose whole reach is round-off of the largest value goes.
    let counts = |power: usize| size(&powers[power]) * reach.powi(power as i32) > 1e-11 * scale;
    let last = (1..powers.len()).rev().find(|&power| counts(power)).unwrap_or(0);
    powers.truncate(last + 1);
    powers
}

/// `sum_p c_p mu^p`.
pub(super) fn evaluate(coefficients: &[Vec<f64>], friction_coefficient: f64) -> Vec<f64> {
    let mut powers = coefficients.iter().rev();
    let mut values = powers.next().cloned().unwrap_or_default();
    for coefficient in powers {
        for (value, constant) in values.iter_mut().zip(coefficient) {
            *value = constant + friction_coefficient * *value;
        }
    }
    values
}
