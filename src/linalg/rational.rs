//! Poles of a function known on points of the complex plane.

use faer::{Mat, c64};

/// A rational function in barycentric form through samples of another one, by the AAA algorithm.
///
/// ```text
/// r(z) = sum_j w_j f_j / (z - z_j)  /  sum_j w_j / (z - z_j)
/// ```
///
/// Support points are taken greedily where the error is largest; the weights minimize the linearized error over all
/// other samples (Nakatsukasa, Sete, Trefethen, SIAM J. Sci. Comput. 40, 2018, A1494).
#[derive(Clone, Debug)]
pub struct RationalFit {
    supports: Vec<c64>,
    weights: Vec<c64>,
    /// Largest error on the samples, relative to the largest sample.
    pub error: f64,
}

impl RationalFit {
    /// Fits until the relative error is below `tolerance`, or with `most` support points. `None` for fewer than three
    /// samples, or values that are not finite.
    pub fn new(points: &[c64], values: &[c64], tolerance: f64, most: usize) -> Option<Self> {
        let count = points.len();
        let largest = values.iter().fold(0.0_f64, |m, value| m.max(value.norm()));
        if count < 3 || !largest.is_finite() || largest == 0.0 {
            return None;
        }
        let mean = values.iter().sum::<c64>() / count as f64;
        let mut fitted = vec![mean; count];
        let mut supports: Vec<usize> = Vec::new();
        let mut best = None;
        while supports.len() < most.min(count / 2) {
            let rest = (0..count).filter(|i| !supports.contains(i));
            let worst = rest.max_by(|&i, &j| {
                let error = |k: usize| (values[k] - fitted[k]).norm();
                error(i).total_cmp(&error(j))
            })?;
            supports.push(worst);
            let weights = weights(points, values, &supports)?;
            let mut error = 0.0_f64;
            for i in 0..count {
                if supports.contains(&i) {
                    fitted[i] = values[i];
                    continue;
                }
                let (mut above, mut below) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
                for (&j, weight) in supports.iter().zip(&weights) {
                    let share = weight / (points[i] - points[j]);
                    above += share * values[j];
                    below += share;
                }
                fitted[i] = above / below;
                error = error.max((values[i] - fitted[i]).norm() / largest);
            }
            let done = error < tolerance;
            best = Some(Self {
                supports: supports.iter().map(|&j| points[j]).collect(),
                weights,
                error,
            });
            if done {
                break;
            }
        }
        best
    }

    /// Its poles, the zeros of `sum_j w_j / (z - z_j)`.
    ///
    /// With `x_j = 1 / (z - z_j)`: `w^T x = 0` makes `x` an eigenvector of `D - 1 (w^T D) / (w^T 1)`, `D = diag(z_j)`.
    /// That matrix has the origin as an eigenvalue besides, so the origin is moved away from every support point.
    pub fn poles(&self) -> Vec<c64> {
        let count = self.supports.len();
        let reach = self.supports.iter().fold(0.0_f64, |m, z| m.max(z.norm()));
        let origin = c64::new(-4.0 * reach, 0.0);
        let sum: c64 = self.weights.iter().sum();
        let moved: Vec<c64> = self.supports.iter().map(|z| z - origin).collect();
        let matrix = Mat::from_fn(count, count, |i, j| {
            let own = if i == j { moved[i] } else { c64::new(0.0, 0.0) };
            own - self.weights[j] * moved[j] / sum
        });
        let mut values = matrix.eigenvalues().unwrap_or_default();
        values.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        values
            .into_iter()
            .skip(1)
            .map(|value| value + origin)
            .collect()
    }
}

/// Right singular vector of the smallest singular value of the Loewner matrix over all other samples.
fn weights(points: &[c64], values: &[c64], supports: &[usize]) -> Option<Vec<c64>> {
    let rest: Vec<usize> = (0..points.len())
        .filter(|i| !supports.contains(i))
        .collect();
    let loewner = Mat::from_fn(rest.len(), supports.len(), |row, column| {
        let (i, j) = (rest[row], supports[column]);
        (values[i] - values[j]) / (points[i] - points[j])
    });
    let svd = loewner.thin_svd().ok()?;
    let last = supports.len() - 1;
    Some((0..=last).map(|j| svd.V()[(j, last)]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poles_of_a_sum_of_resonances_are_found_to_round_off() {
        let poles = [
            c64::new(-2.0, 5.0),
            c64::new(-1.0, 6.0),
            c64::new(0.5, 3.0),
            c64::new(-3.0, 9.0),
        ];
        let points: Vec<c64> = (0..80)
            .map(|i| c64::new(0.0, 0.15 * f64::from(i)))
            .collect();
        let values: Vec<c64> = points
            .iter()
            .map(|z| {
                let sum: c64 = poles.iter().map(|p| 1.0 / (z - p)).sum();
                sum + 0.3
            })
            .collect();
        let fit = RationalFit::new(&points, &values, 1e-13, 30).unwrap();
        let found = fit.poles();
        for pole in poles {
            let nearest = found
                .iter()
                .map(|z| (z - pole).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-9, "{pole}: {nearest}");
        }
    }

    #[test]
    fn too_few_or_infinite_samples_have_no_fit() {
        let points = [c64::new(0.0, 0.0), c64::new(1.0, 0.0)];
        assert!(RationalFit::new(&points, &points, 1e-13, 5).is_none());
        let points: Vec<c64> = (0..9).map(|i| c64::new(f64::from(i), 0.0)).collect();
        let values = vec![c64::new(f64::NAN, 0.0); 9];
        assert!(RationalFit::new(&points, &values, 1e-13, 5).is_none());
    }
}
