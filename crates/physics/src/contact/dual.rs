//! Dual bases of mortar methods.

use nalgebra::DMatrix;

/// Coefficients `D M^-1` of the basis that is dual to `count` functions, from these at quadrature points with their weights: the
/// diagonal of `D`, `∫ N_i`, and the inverse of `M`, `∫ N_i N_j`; `None` where there is none.
pub(super) fn dual_basis<'a>(
    count: usize,
    points: impl Iterator<Item = (f64, &'a Vec<f64>)>,
) -> Option<(Vec<f64>, DMatrix<f64>)> {
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
    Some((diagonal, mass.try_inverse()?))
}
