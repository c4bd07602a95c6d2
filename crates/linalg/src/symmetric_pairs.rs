//! Leading pairs of symmetric pencils.

use super::dense::{combine, pick_columns, product, random_columns, transpose_product};
use super::dense_eigen::symmetric_eigen;
use super::gram::complement;
use super::{BlockOperator, KrylovSchurSettings, LinalgError, krylov_schur};
use faer::{Mat, MatRef};

/// A symmetric pencil `(A, M)`, both positive definite: the operator `A^-1 M`.
pub trait SymmetricPencil: BlockOperator {
    /// `M x`.
    fn mass_times(&self, x: MatRef<'_, f64>) -> Mat<f64>;
}

/// Pairs `A^-1 M x = theta x` by falling `theta`, with `x^T M x = 1`.
pub struct SymmetricPairs {
    /// How many of them keep the tolerance: all, unless the iteration was spent or a decomposition of its forms failed.
    pub converged: usize,
    /// `theta`.
    pub values: Vec<f64>,
    /// `x`, a column each.
    pub vectors: Mat<f64>,
}

/// The `count` pairs of largest `theta` of `A^-1 M x = theta x`, each to a residual `tolerance` relative to its own `theta`.
///
/// [`krylov_schur`] with blocks of `width` columns, at least the largest multiplicity that is likely, finds the space of the pairs;
/// the method of Rayleigh and Ritz in the inner product of `M` finds the pairs in it: vectors of equal and of close `theta` come
/// out orthonormal. Small `theta` are as accurate, relative to themselves, as round-off relative to the largest allows.
///
/// # Errors
/// As [`krylov_schur`].
pub fn symmetric_pairs(
    pencil: &dyn SymmetricPencil,
    count: usize,
    width: usize,
    tolerance: f64,
) -> Result<SymmetricPairs, LinalgError> {
    let n = pencil.dimension();
    let (wanted, width) = (count.min(n), width.min(n));
    let max_applications = 10 * (wanted + 20 * width);
    let settings =
        KrylovSchurSettings { wanted, tie: 1.0, tolerance, max_applications, dense_up_to: 0 };
    let start = random_columns(n, width, 0x5eed);
    let found = krylov_schur(pencil, start, &|_| true, &settings)?;
    let converged = found.residuals.iter().filter(|own| **own <= tolerance).count();

    // Orthonormal columns, plainly first and then in the inner product of the mass.
    let mut basis = complement(Mat::zeros(n, 0).as_ref(), found.vectors, 0.0);
    let momenta = pencil.mass_times(basis.as_ref());
    let (squares, mut turn) = symmetric_eigen(&transpose_product(basis.as_ref(), momenta.as_ref()));
    // V^T M V = T S T^T: V T S^-1/2 is orthonormal in M.
    for (j, square) in squares.iter().enumerate() {
        turn.col_mut(j).iter_mut().for_each(|v| *v /= square.sqrt());
    }
    combine(&mut basis, turn.as_ref());

    // The pairs in their space.
    let momenta = pencil.mass_times(basis.as_ref());
    let images = pencil.apply(basis.as_ref());
    // V^T M A^-1 M V y = theta y.
    let (rising, ritz) = symmetric_eigen(&transpose_product(momenta.as_ref(), images.as_ref()));
    let falling: Vec<usize> = (0..rising.len()).rev().take(wanted).collect();
    let ritz = pick_columns(&ritz, &falling);
    let values: Vec<f64> = falling.iter().map(|&j| rising[j]).collect();
    let converged = converged.min(values.len());
    Ok(SymmetricPairs { converged, values, vectors: product(basis.as_ref(), ritz.as_ref()) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `diag(a)`, `diag(m)`.
    struct Diagonal(Vec<f64>, Vec<f64>);

    impl BlockOperator for Diagonal {
        fn dimension(&self) -> usize {
            self.0.len()
        }

        fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
            Mat::from_fn(x.nrows(), x.ncols(), |i, j| self.1[i] * x[(i, j)] / self.0[i])
        }
    }

    impl SymmetricPencil for Diagonal {
        fn mass_times(&self, x: MatRef<'_, f64>) -> Mat<f64> {
            Mat::from_fn(x.nrows(), x.ncols(), |i, j| self.1[i] * x[(i, j)])
        }
    }

    /// Closed form: eigenvalues that come up to seven times, and clusters, are found that often, each to its own accuracy.
    #[test]
    fn multiple_and_clustered_eigenvalues_are_found_as_often_as_they_are() {
        let n = 400;
        let mass: Vec<f64> = (0..n).map(|i| 1.0 + (i % 7) as f64).collect();
        let kappa: Vec<f64> = (0..n)
            .map(|i| match i {
                0..6 => 1.0,
                6..13 => 900.0 * (1.0 + 1e-9 * i as f64),
                _ => 1000.0 + 25.0 * (i / 3) as f64,
            })
            .collect();
        let stiffness: Vec<f64> = kappa.iter().zip(&mass).map(|(k, m)| k * m).collect();
        let pencil = Diagonal(stiffness, mass);
        let pairs = symmetric_pairs(&pencil, 30, 8, 1e-11).unwrap();
        assert_eq!(pairs.converged, 30);
        for (theta, expected) in pairs.values.iter().zip(&kappa) {
            assert!((theta.recip() / expected - 1.0).abs() < 1e-12, "{} {expected}", theta.recip());
        }
        let momenta = pencil.mass_times(pairs.vectors.as_ref());
        let gram = transpose_product(pairs.vectors.as_ref(), momenta.as_ref());
        let identity = Mat::<f64>::identity(30, 30);
        assert!((gram - identity).norm_max() < 1e-12);
    }
}
