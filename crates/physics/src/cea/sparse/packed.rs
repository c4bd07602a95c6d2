//! Complex vectors of modes in real matrices, for real arithmetic.

use crate::cea::sparse::*;
use crate::linalg::dense::product;

/// `w_i^T P x_j` of the left vectors of some modes and the right ones of others, by one product of real matrices.
pub fn forms(lefts: &[ReducedMode], p: &Mat<f64>, rights: &[ReducedMode]) -> Mat<c64> {
    let parts = |modes: &[ReducedMode], of: fn(&ReducedMode) -> &Vec<c64>| {
        side_by_side(p.nrows(), &modes.iter().map(of).collect::<Vec<_>>())
    };
    let image = product(p.as_ref(), parts(rights, |mode| &mode.right).as_ref());
    let all = transpose_product(parts(lefts, |mode| &mode.left).as_ref(), image.as_ref());
    Mat::from_fn(lefts.len(), rights.len(), |i, j| {
        let own = |a: usize, b: usize| all[(2 * i + a, 2 * j + b)];
        c64::new(own(0, 0) - own(1, 1), own(0, 1) + own(1, 0)) // (a + i b)^T (c + i d), nothing conjugated.
    })
}

/// Real and imaginary parts of complex vectors in neighbouring columns, continued by zeros.
pub fn side_by_side<V: AsRef<[c64]>>(rows: usize, vectors: &[V]) -> Mat<f64> {
    Mat::from_fn(rows, 2 * vectors.len(), |i, j| {
        let value = vectors[j / 2].as_ref().get(i);
        value.map_or(0.0, |v| if j % 2 == 0 { v.re } else { v.im })
    })
}

/// The `k`-th of complex vectors [`side_by_side`].
pub fn joined(columns: &Mat<f64>, k: usize) -> Vec<c64> {
    let [re, im] = [2 * k, 2 * k + 1].map(|j| column(columns.as_ref(), j).iter());
    re.zip(im).map(|(&re, &im)| c64::new(re, im)).collect()
}

/// `target += factor source` on the `k`-th of complex vectors [`side_by_side`].
pub fn add_complex_multiple(target: &mut Mat<f64>, factor: c64, source: &Mat<f64>, k: usize) {
    let [real, imaginary] = [2 * k, 2 * k + 1].map(|j| column(source.as_ref(), j));
    let parts = || real.iter().zip(imaginary);
    let sum = column_mut(target, 2 * k).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * p - factor.im * q);
    let sum = column_mut(target, 2 * k + 1).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * q + factor.im * p);
}
