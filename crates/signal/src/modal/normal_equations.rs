//! Normal equations of weighted least squares, equilibrated and damped.

use crate::{SignalError, error::failed_fit};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, Par};
use nalgebra::{DMatrix, DVector};

/// Normal matrix `A^T A` and right side `A^T b` of `[A b]`, on one thread so that the bytes do not
/// depend on their number.
pub(super) fn gram(matrix: &Mat<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let n = matrix.ncols();
    let mut out = Mat::<f64>::zeros(n, n);
    triangular::matmul(
        out.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Replace,
        matrix.transpose(),
        BlockStructure::Rectangular,
        matrix.as_ref(),
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
    let normal = DMatrix::from_fn(n - 1, n - 1, |i, j| out[(i.max(j), i.min(j))]);
    let right = DVector::from_fn(n - 1, |i, _| out[(n - 1, i)]);
    (normal, right)
}

/// Column scales that give the normal matrix a unit diagonal.
fn scales(normal: &DMatrix<f64>) -> DVector<f64> {
    normal.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 1.0 })
}

/// Cholesky factor of the equilibrated matrix with `damping` on its diagonal, raised until it exists.
fn factor(
    normal: &DMatrix<f64>,
    scale: &DVector<f64>,
    damping: f64,
) -> Result<nalgebra::Cholesky<f64, nalgebra::Dyn>, SignalError> {
    let n = normal.nrows();
    let mut ridge = damping.max(1e-14);
    while ridge < 1e-2 + 10.0 * damping {
        let scaled = DMatrix::from_fn(n, n, |i, j| {
            let value = normal[(i, j)] * scale[i] * scale[j];
            if i == j { value + ridge } else { value }
        });
        if let Some(factor) = scaled.cholesky() {
            return Ok(factor);
        }
        ridge *= 100.0;
    }
    Err(failed_fit("the normal equations are singular; restrict the frequency range"))
}

/// Solution of the normal equations with `damping` on the diagonal of the equilibrated matrix.
pub(super) fn damped_step(
    normal: &DMatrix<f64>,
    gradient: &DVector<f64>,
    damping: f64,
) -> Result<DVector<f64>, SignalError> {
    let scale = scales(normal);
    let right = gradient.component_mul(&scale);
    let step = factor(normal, &scale, damping)?.solve(&right);
    Ok(step.component_mul(&scale))
}

/// Inverse of a normal matrix.
pub(super) fn inverse(normal: &DMatrix<f64>) -> Result<DMatrix<f64>, SignalError> {
    let scale = scales(normal);
    let inner = factor(normal, &scale, 0.0)?.inverse();
    let n = normal.nrows();
    Ok(DMatrix::from_fn(n, n, |i, j| inner[(i, j)] * scale[i] * scale[j]))
}
