//! Eigenvalue decomposition of dense real matrices.

use super::dense::{column, column_mut, orthogonalize, product, random_columns};
use super::vectors::{length, normalize};
use super::{ComplexDenseLu, LinalgError, interruption};
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{
    ComputeEigenvectors, EvdError, EvdParams, SelfAdjointEvdParams, evd_cplx, evd_real,
    evd_scratch, self_adjoint_evd, self_adjoint_evd_scratch,
};
use faer::traits::ComplexField;
use faer::{Auto, Mat, MatMut, MatRef, Par, Spec, c64};

/// Residual, relative to the eigenvalue, above which an eigenvector is computed anew.
const VECTOR_TOLERANCE: f64 = 1e-9;
/// Part of a vector that must lie beyond the others of an equal eigenvalue.
const INDEPENDENT: f64 = 1e-3;

/// Eigenvalues and eigenvectors of a real matrix `A`, in real storage.
///
/// A real eigenvalue owns one column. A complex pair owns two neighbouring columns `(p, q)`: its
/// first value, with positive imaginary part, has the vector `p + i q`, its second the conjugate.
#[derive(Clone, Debug)]
pub struct RealEigen {
    /// Eigenvalues; conjugate pairs are neighbours, positive imaginary part first.
    pub values: Vec<c64>,
    /// Right vectors, `A x = lambda x`.
    pub right: Mat<f64>,
    /// Left vectors, `y^H A = lambda y^H`, where they were asked for.
    pub left: Option<Mat<f64>>,
}

/// Eigenvalues, rising, and orthonormal eigenvectors of a symmetric matrix, of which the lower triangle is read; nothing where
/// the iteration fails.
pub fn symmetric_eigen(matrix: &Mat<f64>) -> (Vec<f64>, Mat<f64>) {
    interruption::check();
    let n = matrix.nrows();
    // By the QR algorithm: dividing and conquering leaves errors of thousands of roundings in the smallest values (faer 0.24).
    let auto = <SelfAdjointEvdParams as Auto<f64>>::auto();
    let by_qr = Spec::new(SelfAdjointEvdParams { recursion_threshold: usize::MAX, ..auto });
    let (mut values, mut vectors) = (Diag::<f64>::zeros(n), Mat::<f64>::zeros(n, n));
    let with = ComputeEigenvectors::Yes;
    let scratch = self_adjoint_evd_scratch::<f64>(n, with, Par::Seq, by_qr);
    let outcome = self_adjoint_evd(
        matrix.as_ref(),
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        by_qr,
    );
    match outcome {
        Ok(()) => (values.column_vector().iter().copied().collect(), vectors),
        Err(_) => (Vec::new(), Mat::zeros(n, 0)),
    }
}

/// Eigenvalues of a complex square matrix, in no particular order, without vectors.
///
/// # Errors
/// If the QR iteration does not converge, or the matrix is not finite.
pub fn complex_eigenvalues(matrix: MatRef<'_, c64>) -> Result<Vec<c64>, LinalgError> {
    complex_decomposed(matrix, [None, None])
}

/// Eigenvalues `lambda` of a complex square matrix `A`, right vectors `A x = lambda x` and left ones `y^H A = lambda y^H`, as columns, in no
/// particular order.
///
/// # Errors
/// As [`complex_eigenvalues`].
pub fn complex_eigen(matrix: MatRef<'_, c64>) -> Result<(Vec<c64>, [Mat<c64>; 2]), LinalgError> {
    let [mut right, mut left] = [(); 2].map(|()| Mat::zeros(matrix.nrows(), matrix.nrows()));
    let values = complex_decomposed(matrix, [Some(&mut left), Some(&mut right)])?;
    Ok((values, [right, left]))
}

/// Eigenvalues of a complex square matrix, with the vectors that there is room for, left and right ones.
fn complex_decomposed(
    matrix: MatRef<'_, c64>,
    room: [Option<&mut Mat<c64>>; 2],
) -> Result<Vec<c64>, LinalgError> {
    let (mut values, params) = (Diag::<c64>::zeros(matrix.nrows()), Spec::default());
    decompose(matrix, room, params, |[left, right], stack| {
        evd_cplx(matrix, values.as_mut(), left, right, Par::Seq, stack, params)
    })?;
    Ok(values.column_vector().iter().copied().collect())
}

/// Decomposes a matrix `by` the library, which is given the room for vectors and its memory, unless the matrix is not finite.
fn decompose<T: ComplexField>(
    matrix: MatRef<'_, T>,
    room: [Option<&mut Mat<T>>; 2],
    params: Spec<EvdParams, T>,
    by: impl FnOnce([Option<MatMut<'_, T>>; 2], &mut MemStack) -> Result<(), EvdError>,
) -> Result<(), LinalgError> {
    interruption::check();
    let dimension = matrix.nrows();
    let [left, right] = room.each_ref().map(|own| match own {
        Some(_) => ComputeEigenvectors::Yes,
        None => ComputeEigenvectors::No,
    });
    let scratch = evd_scratch::<T>(dimension, left, right, Par::Seq, params);
    let room = room.map(|own| own.map(|own| own.as_mut()));
    let found =
        matrix.is_all_finite().then(|| by(room, MemStack::new(&mut MemBuffer::new(scratch))));
    found.and_then(Result::ok).ok_or_else(|| LinalgError::dense_eigen(dimension))
}

/// Eigenvalues of a real square matrix, in no particular order, without vectors.
///
/// # Errors
/// As [`complex_eigenvalues`].
pub fn real_eigenvalues(matrix: MatRef<'_, f64>) -> Result<Vec<c64>, LinalgError> {
    decomposed(matrix, [None, None])
}

/// [`complex_decomposed`] of a real square matrix.
fn decomposed(
    matrix: MatRef<'_, f64>,
    room: [Option<&mut Mat<f64>>; 2],
) -> Result<Vec<c64>, LinalgError> {
    let [mut real, mut imaginary] = [(); 2].map(|()| Diag::<f64>::zeros(matrix.nrows()));
    // Aggressive early deflation sorts 2 x 2 blocks without end where eigenvalues are equal (faer 0.24): double shifts alone.
    let mut params: EvdParams = Auto::<f64>::auto();
    params.schur.blocking_threshold = usize::MAX;
    decompose(matrix, room, params.into(), |[left, right], stack| {
        let (re, im) = (real.as_mut(), imaginary.as_mut());
        evd_real(matrix, re, im, left, right, Par::Seq, stack, params.into())
    })?;
    let parts = real.column_vector().iter().zip(imaginary.column_vector().iter());
    Ok(parts.map(|(re, im)| c64::new(*re, *im)).collect())
}

/// Eigenvalue decomposition of a real square matrix.
///
/// The vectors of the `leading` eigenvalues of largest modulus are held to their equation and computed
/// anew where they miss it by inverse iteration; the others come as the decomposition leaves them.
///
/// # Errors
/// If the QR iteration does not converge, or the matrix is not finite.
pub fn real_eigen(
    matrix: MatRef<'_, f64>,
    with_left: bool,
    leading: usize,
) -> Result<RealEigen, LinalgError> {
    real_eigen_above(matrix, with_left, &|values| {
        let mut moduli: Vec<f64> = values.iter().map(|v| v.norm()).collect();
        moduli.sort_by(|a, b| b.total_cmp(a));
        moduli.get(leading).copied().unwrap_or(0.0)
    })
}

/// [`real_eigen`] with the modulus from which on vectors are held to their equation, said for the eigenvalues found.
///
/// # Errors
/// As [`real_eigen`].
pub fn real_eigen_above(
    matrix: MatRef<'_, f64>,
    with_left: bool,
    smallest: &dyn Fn(&[c64]) -> f64,
) -> Result<RealEigen, LinalgError> {
    let n = matrix.nrows();
    let mut right = Mat::<f64>::zeros(n, n);
    let mut left = with_left.then(|| Mat::<f64>::zeros(n, n));
    let mut values = decomposed(matrix, [left.as_mut(), Some(&mut right)])?;
    order_conjugate_pairs(&mut values, &mut right, left.as_mut());
    let smallest = smallest(&values);
    repair(matrix, &values, smallest, &mut right);
    if let Some(left) = &mut left {
        // Conjugates of left vectors are right vectors of the transpose.
        conjugate(&values, left);
        repair(matrix.transpose(), &values, smallest, left);
        conjugate(&values, left);
    }
    Ok(RealEigen { values, right, left })
}

/// Makes the positive imaginary part come first in every pair.
fn order_conjugate_pairs(
    values: &mut [c64],
    right: &mut Mat<f64>,
    mut left: Option<&mut Mat<f64>>,
) {
    let mut i = 0;
    while i < values.len() {
        if values[i].im == 0.0 {
            i += 1;
            continue;
        }
        if values[i].im < 0.0 {
            values.swap(i, i + 1);
            for vectors in [Some(&mut *right), left.as_deref_mut()].into_iter().flatten() {
                column_mut(vectors, i + 1).iter_mut().for_each(|v| *v = -*v); // p - i q belongs to the other one.
            }
        }
        i += 2;
    }
}

/// Replaces the columns of `vectors` by their conjugates.
fn conjugate(values: &[c64], vectors: &mut Mat<f64>) {
    for (j, value) in values.iter().enumerate() {
        if value.im < 0.0 {
            column_mut(vectors, j).iter_mut().for_each(|v| *v = -*v); // q stands in the column of the second value.
        }
    }
}

/// Recomputes eigenvectors, of eigenvalues of at least the modulus `smallest`, that do not satisfy their equation.
///
/// The back substitution of the decomposition loses up to all digits in the vectors of repeated complex eigenvalues. Inverse iteration
/// restores them; projections against the sound vectors of equal eigenvalues keep them independent.
fn repair(matrix: MatRef<'_, f64>, values: &[c64], smallest: f64, vectors: &mut Mat<f64>) {
    let images = product(matrix, vectors.as_ref());
    let first_columns =
        (0..values.len()).filter(|&j| values[j].im >= 0.0 && values[j].norm() >= smallest);
    let (mut sound, mut unsound) = (Vec::new(), Vec::new());
    for j in first_columns {
        let vector = complex_column(values, vectors.as_ref(), j);
        let image = complex_column(values, images.as_ref(), j);
        let pairs = image.iter().zip(&vector);
        // |A x - lambda x|, and what x has beyond sound vectors of the same lambda.
        let error = pairs.map(|(a, x)| (a - values[j] * x).norm_sqr()).sum::<f64>().sqrt();
        let mut beyond = vector.clone();
        orthogonalize(&mut beyond, &alike(values, vectors, &sound, j));
        let is_independent = length(&beyond) > INDEPENDENT * length(&vector);
        let is_sound = error <= VECTOR_TOLERANCE * values[j].norm() * length(&vector);
        if is_independent && is_sound { &mut sound } else { &mut unsound }.push(j);
    }
    for j in unsound {
        let known = alike(values, vectors, &sound, j); // Each new vector is one more that the next ones keep off.
        let vector = inverse_iteration(matrix, values[j], &known, j as u64);
        for (i, v) in vector.iter().enumerate() {
            vectors[(i, j)] = v.re;
            if values[j].im > 0.0 {
                vectors[(i, j + 1)] = v.im;
            }
        }
        sound.push(j);
    }
}

/// An orthonormal basis of the vectors of those `sound` eigenvalues that equal eigenvalue `j`.
fn alike(values: &[c64], vectors: &Mat<f64>, sound: &[usize], j: usize) -> Vec<Vec<c64>> {
    let is_equal = |k: usize| (values[k] - values[j]).norm() < 1e-8 * values[j].norm();
    let mut basis: Vec<Vec<c64>> = Vec::new();
    for &k in sound.iter().filter(|&&k| is_equal(k)) {
        let mut vector = complex_column(values, vectors.as_ref(), k);
        orthogonalize(&mut vector, &basis);
        normalize(&mut vector);
        basis.push(vector);
    }
    basis
}

/// An eigenvector of `value` orthogonal to `known`, which span others of the same eigenvalue.
fn inverse_iteration(
    matrix: MatRef<'_, f64>,
    value: c64,
    known: &[Vec<c64>],
    seed: u64,
) -> Vec<c64> {
    let n = matrix.nrows();
    // Off the eigenvalue by more than its round-off, by far less than its distance to others.
    let shift = value * (1.0 + 1e-11);
    let shifted = Mat::from_fn(n, n, |i, j| {
        c64::new(matrix[(i, j)], 0.0) - if i == j { shift } else { c64::ZERO }
    });
    let lu = ComplexDenseLu::factorize(shifted);
    let mut vector: Vec<c64> =
        column(random_columns(n, 1, seed).as_ref(), 0).iter().map(|&v| v.into()).collect();
    for _ in 0..3 {
        // (A - s)^-1 of what is orthogonal to the known ones.
        orthogonalize(&mut vector, known);
        normalize(&mut vector);
        lu.solve_in_place(MatMut::from_column_major_slice_mut(&mut vector, n, 1));
    }
    // The last step is a solution, not a projection: it leaves nothing of other eigenvectors, and within
    // the eigenspace it only scales, so the vector stays independent of the known ones.
    normalize(&mut vector);
    vector
}

/// The vector of eigenvalue `j`, of columns as in [`RealEigen`].
pub fn complex_column(values: &[c64], vectors: MatRef<'_, f64>, j: usize) -> Vec<c64> {
    let sign = if values[j].im == 0.0 { 0.0 } else { values[j].im.signum() };
    let first = if sign < 0.0 { j - 1 } else { j }; // A pair has p + i q in two columns.
    let [p, q] = [first, first + usize::from(sign != 0.0)].map(|k| column(vectors, k));
    p.iter().zip(q).map(|(&p, &q)| c64::new(p, sign * q)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DenseLu;
    use crate::dense::transpose_product;

    #[test]
    fn eigenvalues_of_a_complex_triangle_are_its_diagonal() {
        let (re, im) = (random_columns(12, 12, 3), random_columns(12, 12, 4));
        let entry = |i: usize, j: usize| c64::new(re[(i, j)], im[(i, j)]);
        let triangle = Mat::from_fn(12, 12, |i, j| if i <= j { entry(i, j) } else { c64::ZERO });
        let found = complex_eigenvalues(triangle.as_ref()).unwrap();
        assert_eq!(found.len(), 12);
        for i in 0..12 {
            let distances = found.iter().map(|value| (value - entry(i, i)).norm());
            assert!(distances.fold(f64::INFINITY, f64::min) < 1e-12);
        }
    }

    #[test]
    fn eigenvectors_of_a_random_real_matrix_satisfy_both_equations() {
        let a = random_columns(40, 40, 7);
        let eigen = real_eigen(a.as_ref(), true, usize::MAX).unwrap();
        let left = eigen.left.unwrap();
        let (ar, al) = (
            product(a.as_ref(), eigen.right.as_ref()),
            transpose_product(a.as_ref(), left.as_ref()),
        );
        let mut j = 0;
        while j < 40 {
            let lambda = eigen.values[j];
            let width = if lambda.im == 0.0 { 1 } else { 2 };
            assert!(width == 1 || (lambda.im > 0.0 && eigen.values[j + 1] == lambda.conj()));
            for i in 0..40 {
                let at = |m: &Mat<f64>| {
                    c64::new(m[(i, j)], if width == 2 { m[(i, j + 1)] } else { 0.0 })
                };
                assert!((at(&ar) - lambda * at(&eigen.right)).norm() < 1e-12);
                assert!((at(&al) - lambda.conj() * at(&left)).norm() < 1e-12);
            }
            j += width;
        }
    }

    #[test]
    fn vectors_of_a_repeated_complex_pair_are_independent_and_satisfy_their_equation() {
        // Two equal rotation blocks and a few others, in a random basis.
        let n = 24;
        let mut blocks = Mat::<f64>::zeros(n, n);
        for k in 0..n / 2 {
            let (re, im) = if k < 4 { (-0.01, 0.7) } else { (-0.01 * k as f64, 1.0 / k as f64) };
            blocks[(2 * k, 2 * k)] = re;
            blocks[(2 * k + 1, 2 * k + 1)] = re;
            blocks[(2 * k, 2 * k + 1)] = im;
            blocks[(2 * k + 1, 2 * k)] = -im;
        }
        let basis = random_columns(n, n, 11);
        let mut inverse = Mat::<f64>::identity(n, n);
        DenseLu::factorize(basis.clone()).solve_in_place(inverse.as_mut());
        let a = product(product(basis.as_ref(), blocks.as_ref()).as_ref(), inverse.as_ref());
        let eigen = real_eigen(a.as_ref(), true, usize::MAX).unwrap();
        let images = product(a.as_ref(), eigen.right.as_ref());
        for j in (0..n).filter(|&j| eigen.values[j].im > 0.0) {
            let x = complex_column(&eigen.values, eigen.right.as_ref(), j);
            let image = complex_column(&eigen.values, images.as_ref(), j);
            for (p, q) in image.iter().zip(&x) {
                assert!((p - eigen.values[j] * q).norm() < 2e-9 * length(&x));
            }
        }
        // Independent vectors: the matrix of all of them, in real storage, is not near singular.
        let mut inverse = Mat::<f64>::identity(n, n);
        DenseLu::factorize(eigen.right).solve_in_place(inverse.as_mut());
        assert!(inverse.norm_max() < 1e4);
    }
}
