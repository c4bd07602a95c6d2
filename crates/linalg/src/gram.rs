//! Orthonormal columns by their Gram matrix: a block is read a few times as a whole, not once for each pair of columns.

use super::dense::{
    UNIT_REMAINDER, add_product, column_norms, combine, product, transpose_product,
};
use faer::{Mat, MatRef};

/// Part of a column beyond the others below which it counts as dependent: its square, `1e-12`, stands well above the
/// round-off of a Gram matrix of unit columns.
const DEPENDENT: f64 = 1e-6;

/// Orthonormal columns `q` and coefficients `r` of `w = q r`, longest remainder first, by the pivoted Cholesky factor of `w^T w`, twice;
/// gives `w` back where the remainder of one column beyond the others is shorter than a millionth of its length.
///
/// # Errors
/// The columns given, if they depend on one another.
///
/// Source: Y. Yamamoto, Y. Nakatsukasa, Y. Yanagisawa, T. Fukaya, Roundoff error analysis of the CholeskyQR2 algorithm,
/// Electron. Trans. Numer. Anal. 44 (2015); here with pivots.
pub fn orthonormal_columns(mut w: Mat<f64>) -> Result<[Mat<f64>; 2], Mat<f64>> {
    // w = Q_1 R_1, Q_1 = Q_2 R_2: w = Q_2 (R_2 R_1), orthonormal to round-off.
    let first = Pass::of(w.as_ref(), 0.0);
    if first.kept.len() < w.ncols() {
        return Err(w);
    }
    combine(&mut w, first.coefficients.as_ref());
    let second = Pass::of(w.as_ref(), 0.0);
    combine(&mut w, second.coefficients.as_ref());
    Ok([w, product(second.within.as_ref(), first.within.as_ref())])
}

/// Orthonormal basis of what the columns of `w` hold beyond an orthonormal `basis`: remainders shorter than `shortest`,
/// or than a millionth of their own length, are left out.
pub fn complement(basis: MatRef<'_, f64>, mut w: Mat<f64>, shortest: f64) -> Mat<f64> {
    // Always twice: a very stiff contact turns what round-off is left along the basis into modes of its own.
    for shortest in [shortest, UNIT_REMAINDER] {
        let against = transpose_product(basis, w.as_ref());
        add_product(w.as_mut(), -1.0, basis, against.as_ref());
        let pass = Pass::of(w.as_ref(), shortest);
        combine(&mut w, pass.coefficients.as_ref());
    }
    w
}

/// `w coefficients`, as orthonormal as round-off, magnified by the shortest remainders, leaves it.
struct Pass {
    /// Columns of `w` that have a remainder, in the order of their pivots.
    kept: Vec<usize>,
    /// What turns `w` into orthonormal columns.
    coefficients: Mat<f64>,
    /// What turns these into the columns kept; at `(slot, kept[slot])` the length of a remainder.
    within: Mat<f64>,
}

impl Pass {
    fn of(w: MatRef<'_, f64>, shortest: f64) -> Self {
        let lengths = column_norms(w);
        let raw = transpose_product(w, w);
        let count = w.ncols();
        // Of unit columns.
        let gram = Mat::from_fn(count, count, |i, j| raw[(i, j)] / (lengths[i] * lengths[j]));
        // Not a number where a column is zero: the comparison with its floor is false then.
        let floors = lengths.iter().map(|length| (shortest / length).max(DEPENDENT).powi(2));
        let (kept, upper) = pivoted_cholesky(gram, &floors.collect::<Vec<_>>());
        let inverse = inverse_of_upper(&kept, &upper); // Q = w D^-1 R^-1, with D the lengths.
        let mut coefficients = Mat::zeros(count, kept.len());
        let mut within = Mat::zeros(kept.len(), count);
        for (slot, &j) in kept.iter().enumerate() {
            for k in slot..kept.len() {
                coefficients[(j, k)] = inverse[(slot, k)] / lengths[j];
            }
            for i in 0..=slot {
                within[(i, j)] = upper[(i, j)] * lengths[j];
            }
        }
        Self { kept, coefficients, within }
    }
}

/// Columns in the order of their pivots, each above its floor, and `R`, `gram = R^T R` on these columns; the columns of
/// `R` are in the order given.
fn pivoted_cholesky(gram: Mat<f64>, floors: &[f64]) -> (Vec<usize>, Mat<f64>) {
    let count = gram.ncols();
    let mut upper = Mat::zeros(count, count);
    let mut remainders: Vec<f64> = (0..count).map(|j| gram[(j, j)]).collect();
    let (mut kept, mut open) = (Vec::new(), (0..count).collect::<Vec<_>>());
    loop {
        open.retain(|&j| remainders[j] > floors[j]);
        let largest = |&&i: &&usize, &&j: &&usize| {
            // The first of equal ones, so that an orthonormal block keeps its order.
            remainders[i].total_cmp(&remainders[j]).then(j.cmp(&i))
        };
        let Some(&pivot) = open.iter().max_by(largest) else {
            return (kept, upper);
        };
        open.retain(|&j| j != pivot);
        let row = kept.len();
        upper[(row, pivot)] = remainders[pivot].sqrt();
        for &j in &open {
            // r_pj = (g_pj - sum_i r_ip r_ij) / r_pp.
            let known: f64 = (0..row).map(|i| upper[(i, pivot)] * upper[(i, j)]).sum();
            upper[(row, j)] = (gram[(pivot, j)] - known) / upper[(row, pivot)];
            remainders[j] -= upper[(row, j)] * upper[(row, j)];
        }
        kept.push(pivot);
    }
}

/// Inverse of the upper triangle whose columns are the columns `kept` of `upper`.
fn inverse_of_upper(kept: &[usize], upper: &Mat<f64>) -> Mat<f64> {
    let count = kept.len();
    let mut inverse = Mat::zeros(count, count);
    for k in 0..count {
        for i in (0..=k).rev() {
            let known: f64 = (i + 1..=k).map(|j| upper[(i, kept[j])] * inverse[(j, k)]).sum();
            let right = f64::from(i == k); // R R^-1 = 1, column by column from below.
            inverse[(i, k)] = (right - known) / upper[(i, kept[i])];
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::random_columns;

    fn deviation_from_orthonormal(q: &Mat<f64>) -> f64 {
        let gram = transpose_product(q.as_ref(), q.as_ref());
        (gram - Mat::<f64>::identity(q.ncols(), q.ncols())).norm_max()
    }

    #[test]
    fn factors_reproduce_columns_of_any_length() {
        let mut w = random_columns(60, 6, 1);
        for i in 0..60 {
            w[(i, 2)] *= 1e-9;
            w[(i, 4)] = w[(i, 1)] + 1e-4 * w[(i, 4)];
        }
        let [columns, within] = orthonormal_columns(w.clone()).unwrap();
        assert_eq!(columns.ncols(), 6);
        assert!(deviation_from_orthonormal(&columns) < 1e-14);
        let back = product(columns.as_ref(), within.as_ref());
        assert!((back - w).norm_max() < 1e-14);
    }

    #[test]
    fn complement_leaves_out_dependent_short_and_known_columns() {
        let [basis, _] = orthonormal_columns(random_columns(60, 5, 2)).unwrap();
        let mut w = random_columns(60, 5, 3);
        for i in 0..60 {
            w[(i, 1)] = 2.0 * w[(i, 0)] - basis[(i, 3)];
            w[(i, 2)] *= 1e-7;
            w[(i, 3)] = basis[(i, 0)] + 1e-4 * w[(i, 3)];
        }
        let new = complement(basis.as_ref(), w, 1e-5);
        assert_eq!(new.ncols(), 3);
        assert!(deviation_from_orthonormal(&new) < 1e-14);
        assert!(transpose_product(basis.as_ref(), new.as_ref()).norm_max() < 1e-14);
    }

    #[test]
    fn round_off_of_long_columns_along_the_basis_is_no_direction() {
        let [all, _] = orthonormal_columns(random_columns(60, 6, 4)).unwrap();
        let basis = all.get(.., ..5);
        // What round-off leaves of the first is longer than the bound; the other is new.
        let w = Mat::from_fn(60, 2, |i, j| match j {
            0 => 1e15 * basis[(i, 0)] + 3e14 * basis[(i, 1)],
            _ => all[(i, 5)] + 1e3 * basis[(i, 2)],
        });
        let new = complement(basis, w, 1e-3);
        assert!(deviation_from_orthonormal(&new) < 1e-14);
        assert!(transpose_product(basis, new.as_ref()).norm_max() < 1e-14);
        let kept = transpose_product(new.as_ref(), all.get(.., 5..));
        // Round-off of unit length may take a part of it along.
        assert!(kept.norm_l2() > 0.9, "{}", kept.norm_l2());
    }
}
