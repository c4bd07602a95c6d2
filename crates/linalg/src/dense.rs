//! Dense kernels over faer, sequential and instantiated once for `f64`.

use super::gaussian_noise::splitmix64;
use faer::linalg::matmul::matmul;
use faer::prelude::{IntoConst, ReborrowMut};
use faer::traits::ComplexField;
use faer::{Accum, ColRef, Mat, MatMut, MatRef, Par, concat};

/// `a b`.
pub fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut c = Mat::zeros(a.nrows(), b.ncols());
    matmul(c.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    c
}

/// `a^T b`.
pub fn transpose_product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    product(a.transpose(), b)
}

/// `c += factor a b`.
pub fn add_product(c: MatMut<'_, f64>, factor: f64, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    matmul(c, Accum::Add, a, b, factor, Par::Seq);
}

/// Columns `a` followed by columns `b`.
pub fn join_columns(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    concat![[a, b]]
}

/// Columns that grow in place, moved only when their room is used up.
#[derive(Clone, Debug)]
pub struct GrowingColumns {
    storage: Mat<f64>,
    /// Columns that there is memory for.
    room: usize,
}

impl GrowingColumns {
    /// No columns of length `rows`.
    pub fn new(rows: usize) -> Self {
        Self { storage: Mat::zeros(rows, 0), room: 0 }
    }

    /// Number of columns.
    pub fn count(&self) -> usize {
        self.storage.ncols()
    }

    /// The columns.
    pub fn columns(&self) -> MatRef<'_, f64> {
        self.storage.as_ref()
    }

    /// Appends columns.
    pub fn append(&mut self, new: MatRef<'_, f64>) {
        let (rows, known) = (self.storage.nrows(), self.count());
        let total = known + new.ncols();
        if self.room < total {
            self.room = 4 * total; // Memory that no column fills yet is not touched.
            self.storage.reserve(rows, self.room);
        }
        self.storage.resize_with(rows, total, |i, j| new[(i, j - known)]);
    }

    /// Takes the columns' place by their combinations, see [`combine`].
    pub fn combine(&mut self, coefficients: MatRef<'_, f64>) {
        combine(&mut self.storage, coefficients);
    }
}

/// Puts combinations `a * coefficients`, no more than `a` has columns, in its place, a strip of rows after the other:
/// fresh memory for tall columns costs more than their product.
pub fn combine(a: &mut Mat<f64>, coefficients: MatRef<'_, f64>) {
    const STRIP: usize = 1024;
    let (rows, known, kept) = (a.nrows(), a.ncols(), coefficients.ncols());
    let mut image = Mat::zeros(STRIP.min(rows), kept);
    for first in (0..rows).step_by(STRIP) {
        let count = STRIP.min(rows - first);
        let mut image = image.as_mut().subrows_mut(0, count);
        let strip = a.as_ref().submatrix(first, 0, count, known);
        matmul(image.rb_mut(), Accum::Replace, strip, coefficients, 1.0, Par::Seq);
        let mut place = a.as_mut().submatrix_mut(first, 0, count, kept);
        place.copy_from(image);
    }
    a.truncate(rows, kept);
}

/// Rows `a` above rows `b`.
pub fn join_rows(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    concat![[a], [b]]
}

/// Column `j` as a slice.
///
/// # Panics
/// If the rows of the view are not contiguous.
pub fn column<T>(a: MatRef<'_, T>, j: usize) -> &[T] {
    let column = a.col(j).try_as_col_major();
    column.expect("columns are contiguous").as_slice()
}

/// Column `j` of an owned matrix as a slice to write.
pub fn column_mut(a: &mut Mat<f64>, j: usize) -> &mut [f64] {
    let column = a.col_mut(j).try_as_col_major_mut();
    column.expect("owned columns are contiguous").as_slice_mut()
}

/// The columns of `a`, each by itself.
pub fn columns_of(a: &Mat<f64>) -> Vec<Vec<f64>> {
    (0..a.ncols()).map(|j| column(a.as_ref(), j).to_vec()).collect()
}

/// The matrix of `rows` rows with these columns, if they are of that length.
pub fn from_columns(columns: &[Vec<f64>], rows: usize) -> Option<Mat<f64>> {
    let is_whole = columns.iter().all(|column| column.len() == rows);
    is_whole.then(|| Mat::from_fn(rows, columns.len(), |i, j| columns[j][i]))
}

/// Columns `columns` of `a`, in that order.
pub fn pick_columns(a: &Mat<f64>, columns: &[usize]) -> Mat<f64> {
    let mut picked = Mat::zeros(a.nrows(), columns.len());
    for (slot, &j) in columns.iter().enumerate() {
        column_mut(&mut picked, slot).copy_from_slice(column(a.as_ref(), j));
    }
    picked
}

/// Splits a matrix into blocks of at most `width` neighbouring columns.
pub fn column_blocks<T>(
    matrix: MatMut<'_, T>,
    width: usize,
) -> impl Iterator<Item = MatMut<'_, T>> {
    let mut rest = Some(matrix);
    std::iter::from_fn(move || {
        let current = rest.take().filter(|m| m.ncols() > 0)?;
        let split = width.min(current.ncols());
        let (block, tail) = current.split_at_col_mut(split);
        rest = Some(tail);
        Some(block)
    })
}

/// The sum of the products of entries, in eight fixed lanes so that it vectorizes.
#[inline]
pub fn product_sum<T: ComplexField + Copy>(a: &[T], b: &[T], product: impl Fn(T, T) -> T) -> T {
    let mut lanes = [T::zero_impl(); 8];
    let (a_chunks, b_chunks) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest = a_chunks.remainder().iter().zip(b_chunks.remainder());
    let tail = rest.fold(T::zero_impl(), |sum, (x, y)| sum + product(*x, *y));
    for (x, y) in a_chunks.zip(b_chunks) {
        for lane in 0..8 {
            lanes[lane] += product(x[lane], y[lane]);
        }
    }
    lanes.into_iter().fold(T::zero_impl(), |sum, lane| sum + lane) + tail
}

/// `a^H b`.
#[inline]
pub fn dot<T: ComplexField<Real = f64> + Copy>(a: &[T], b: &[T]) -> T {
    product_sum(a, b, |x, y| T::conj_impl(&x) * y)
}

/// `a - b`.
pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// `a += factor b`.
#[inline]
pub fn add<T: ComplexField + Copy>(a: &mut [T], factor: T, b: &[T]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * *b);
}

/// Takes the shares of the orthonormal `basis` out of `vector`, twice, and gives them.
pub fn orthogonalize<T: ComplexField<Real = f64> + Copy>(
    vector: &mut [T],
    basis: &[Vec<T>],
) -> Vec<T> {
    let mut shares = vec![T::zero_impl(); basis.len()];
    for _ in 0..2 {
        for (unit, share) in basis.iter().zip(&mut shares) {
            let part = dot(unit, vector); // v -= q (q^H v).
            *share += part;
            add(vector, -part, unit);
        }
    }
    shares
}

/// Sums of squares below this may have lost digits of single squares to underflow.
const SMALLEST_SQUARES: f64 = 1e-280;

/// Euclidean norm, from the plain sum of squares where this neither overflows nor underflows.
pub fn norm(a: &[f64]) -> f64 {
    let squares = dot(a, a);
    if (SMALLEST_SQUARES..=f64::MAX).contains(&squares) {
        return squares.sqrt();
    }
    ColRef::from_slice(a).norm_l2()
}

/// Euclidean norm of each column.
pub fn column_norms(a: MatRef<'_, f64>) -> Vec<f64> {
    (0..a.ncols()).map(|j| norm(column(a, j))).collect()
}

/// Columns of reproducible pseudo-random numbers in (-1, 1).
pub fn random_columns(rows: usize, columns: usize, seed: u64) -> Mat<f64> {
    let mut state = seed;
    let mut next = || splitmix64(&mut state) as i64 as f64 / 2f64.powi(63); // From -2^63 to 2^63.
    let mut a = Mat::zeros(rows, columns);
    for j in 0..columns {
        for i in 0..rows {
            a[(i, j)] = next();
        }
    }
    a
}

/// A right side for a trial solve, without a pattern of its own.
pub(super) fn trial_right_side(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(|i| 1.0 + (i as f64 * 0.618_033_988_749_895).fract())
}

/// What [`orthonormalize`] found: `w = basis * against + q * within`.
pub struct Orthonormalized {
    /// Orthonormal columns, orthogonal to the basis; fewer than those of `w` where some of these were dependent.
    pub columns: Mat<f64>,
    /// Coefficients along the basis.
    pub against: Mat<f64>,
    /// Coefficients along the new columns.
    pub within: Mat<f64>,
}

/// Orthonormalizes the columns of `w` against an orthonormal `basis` and one another.
///
/// Block classical Gram-Schmidt, twice, then modified Gram-Schmidt, twice, within the block; both once more for a column of which little is
/// left then. A column that keeps less than `drop_below` of its length is left out: its coefficients stand, its remainder is lost.
pub fn orthonormalize(basis: MatRef<'_, f64>, w: Mat<f64>, drop_below: f64) -> Orthonormalized {
    orthonormalize_down_to(basis, w, |length| drop_below * length)
}

/// Part of a column that is left of it below which round-off of what was taken away may be seen beside it.
const SHORT_REMAINDER: f64 = 0.1;

/// [`orthonormalize`] with the bound on the remainder of a column as a function of its length.
fn orthonormalize_down_to(
    basis: MatRef<'_, f64>,
    mut w: Mat<f64>,
    bound: impl Fn(f64) -> f64,
) -> Orthonormalized {
    let lengths = column_norms(w.as_ref());
    // w -= V (V^T w), twice: once leaves round-off of what was large.
    let mut against = transpose_product(basis, w.as_ref());
    add_product(w.as_mut(), -1.0, basis, against.as_ref());
    let correction = transpose_product(basis, w.as_ref());
    add_product(w.as_mut(), -1.0, basis, correction.as_ref());
    against += &correction;

    let count = w.ncols();
    let mut within = Mat::<f64>::zeros(count, count);
    let mut kept: Vec<usize> = Vec::with_capacity(count);
    for j in 0..count {
        for pass in 0..3 {
            // What the block takes away leaves round-off along the basis, which a short remainder does not bear.
            if pass == 2 && norm(column(w.as_ref(), j)) > SHORT_REMAINDER * lengths[j] {
                break;
            }
            if pass == 2 {
                let own = w.as_mut().subcols_mut(j, 1);
                let overlap = transpose_product(basis, own.as_ref());
                add_product(own, -1.0, basis, overlap.as_ref());
                (0..basis.ncols()).for_each(|i| against[(i, j)] += overlap[(i, 0)]);
            }
            for (slot, &k) in kept.iter().enumerate() {
                let (q, v) = two_columns(&mut w, k, j); // v -= q (q . v).
                let overlap = dot(q, v);
                within[(slot, j)] += overlap;
                add(v, -overlap, q);
            }
        }
        let norm = norm(column(w.as_ref(), j)); // What is left of it is a new column, unless it is short.
        if norm > bound(lengths[j]) && norm > 0.0 {
            within[(kept.len(), j)] = norm;
            w.col_mut(j).iter_mut().for_each(|v| *v /= norm);
            kept.push(j);
        }
    }
    let columns = pick_columns(&w, &kept);
    let within = within.get(..kept.len(), ..).to_owned();
    Orthonormalized { columns, against, within }
}

/// Length of a column of unit length, nearly orthonormal to others, beyond them: more than this unless it is nothing but round-off.
pub const UNIT_REMAINDER: f64 = 0.5;

/// Orthonormal basis of what the columns of `w` hold beyond an orthonormal `basis`, down to the length `drop_below` (absolute).
pub fn orthonormal_complement(basis: MatRef<'_, f64>, w: Mat<f64>, drop_below: f64) -> Mat<f64> {
    let new = orthonormalize_down_to(basis, w, |_| drop_below).columns;
    // Scaled to unit length, short remainders hold the round-off of long ones along the basis: once more.
    orthonormalize_down_to(basis, new, |_| UNIT_REMAINDER).columns
}

/// Column `k` to read and column `j > k` to write.
fn two_columns(w: &mut Mat<f64>, k: usize, j: usize) -> (&[f64], &mut [f64]) {
    let (head, tail) = w.as_mut().split_at_col_mut(j);
    let q = head.into_const().col(k).try_as_col_major().expect("owned columns are contiguous");
    let v = tail.col_mut(0).try_as_col_major_mut().expect("owned columns are contiguous");
    (q.as_slice(), v.as_slice_mut())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orthonormalization_reproduces_its_input_and_drops_dependent_columns() {
        let basis =
            orthonormalize(Mat::zeros(50, 0).as_ref(), random_columns(50, 5, 1), 1e-10).columns;
        let mut w = random_columns(50, 4, 2);
        for i in 0..50 {
            w[(i, 2)] = w[(i, 0)] - 3.0 * w[(i, 1)] + basis[(i, 3)];
        }
        let result = orthonormalize(basis.as_ref(), w.clone(), 1e-10);
        assert_eq!(result.columns.ncols(), 3);
        let back = product(basis.as_ref(), result.against.as_ref())
            + product(result.columns.as_ref(), result.within.as_ref());
        assert!((back - w).norm_max() < 1e-13);
        let gram = transpose_product(result.columns.as_ref(), result.columns.as_ref());
        assert!((gram - Mat::<f64>::identity(3, 3)).norm_max() < 1e-14);
        assert!(transpose_product(basis.as_ref(), result.columns.as_ref()).norm_max() < 1e-15);
    }

    /// Consistency check: columns that differ by little are orthonormal to the basis, too, and add up to what was given.
    #[test]
    fn short_remainders_within_a_block_stay_orthogonal_to_the_basis() {
        let none = Mat::zeros(50, 0);
        let basis = orthonormalize(none.as_ref(), random_columns(50, 20, 1), 1e-10).columns;
        let first = random_columns(50, 1, 2);
        let apart = random_columns(50, 4, 3);
        let w = Mat::from_fn(50, 4, |i, j| first[(i, 0)] + 1e-11 * j as f64 * apart[(i, j)]);
        let result = orthonormalize(basis.as_ref(), w.clone(), 1e-13);
        assert_eq!(result.columns.ncols(), 4);
        assert!(transpose_product(basis.as_ref(), result.columns.as_ref()).norm_max() < 1e-14);
        let gram = transpose_product(result.columns.as_ref(), result.columns.as_ref());
        assert!((gram - Mat::<f64>::identity(4, 4)).norm_max() < 1e-14);
        let back = product(basis.as_ref(), result.against.as_ref())
            + product(result.columns.as_ref(), result.within.as_ref());
        assert!((back - w).norm_max() < 1e-14);
    }

    /// Consistency check: what is hardly beyond a basis is orthonormal to it, too.
    #[test]
    fn short_remainders_become_orthonormal_columns() {
        let none = Mat::zeros(50, 0);
        let basis = orthonormalize(none.as_ref(), random_columns(50, 20, 1), 1e-10).columns;
        let mut w = product(basis.as_ref(), random_columns(20, 6, 2).as_ref());
        w += crate::Scale(1e-8) * random_columns(50, 6, 3);
        let new = orthonormal_complement(basis.as_ref(), w, 1e-9);
        assert_eq!(new.ncols(), 6);
        let gram = transpose_product(new.as_ref(), new.as_ref());
        assert!((gram - Mat::<f64>::identity(6, 6)).norm_max() < 1e-14);
        assert!(transpose_product(basis.as_ref(), new.as_ref()).norm_max() < 1e-14);
    }
}
