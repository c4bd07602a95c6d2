//! A few eigenvalues of a dense matrix.

use super::dense::product;
use super::dense_eigen::RealEigen;
use super::{BlockOperator, KrylovSchurSettings, krylov_schur};
use faer::{Mat, MatRef};

/// How many times as many rows as eigenvalues are wanted a matrix has from which on an iteration is cheaper than the whole
/// decomposition.
const FEW_OF_MANY: usize = 5;
/// Residual of that iteration, relative to the eigenvalue, and the width of its start.
const FEW_TOLERANCE: f64 = 1e-13;
const FEW_BLOCK: usize = 4;

/// The `leading` eigenvalues of largest modulus of a matrix much larger than that, with right vectors, by an iteration:
/// nothing where the matrix is not so large, or the iteration does not converge.
pub fn few_eigenvalues(matrix: &Mat<f64>, leading: usize) -> Option<RealEigen> {
    if matrix.nrows() < FEW_OF_MANY * leading {
        return None;
    }
    let settings = KrylovSchurSettings {
        wanted: leading,
        tolerance: FEW_TOLERANCE,
        block: FEW_BLOCK,
        max_applications: 20 * leading,
    };
    let found = krylov_schur(&DenseOperator(matrix), &settings).ok()?;
    Some(RealEigen { values: found.values, right: found.vectors, left: None })
}

/// A dense matrix as an operator.
struct DenseOperator<'a>(&'a Mat<f64>);

impl BlockOperator for DenseOperator<'_> {
    fn dimension(&self) -> usize {
        self.0.nrows()
    }

    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        product(self.0.as_ref(), x)
    }
}
