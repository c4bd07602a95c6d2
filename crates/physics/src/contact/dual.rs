//! Dual bases of mortar methods.

use nalgebra::DMatrix;

/// Weights `w psi_i` at quadrature points, from the weight `w` of each and the values of `count` functions `N_j` there.
///
/// `psi = D M^-1 N` is the basis that is dual to these, with the diagonal of `D`, `∫ N_i`, and `M`, `∫ N_i N_j`; `None` where
/// there is none. Shape: a row of `count` weights for each point.
pub(super) fn dual_weights(count: usize, points: &[(f64, Vec<f64>)]) -> Option<Vec<Vec<f64>>> {
    let mut mass = DMatrix::<f64>::zeros(count, count);
    let mut diagonal = vec![0.0; count];
    for (weight, basis) in points {
        for i in 0..count {
            diagonal[i] += weight * basis[i];
            for j in 0..count {
                mass[(i, j)] += weight * basis[i] * basis[j];
            }
        }
    }
    let inverse = mass.try_inverse()?;
    let weights = points.iter().map(|(weight, basis)| {
        let dual = |i: usize| {
            let row = basis.iter().enumerate().map(|(j, value)| inverse[(i, j)] * value);
            weight * diagonal[i] * row.sum::<f64>()
        };
        (0..count).map(dual).collect()
    });
    Some(weights.collect())
}
