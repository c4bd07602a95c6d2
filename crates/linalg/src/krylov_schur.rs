//! Block Krylov-Schur iteration for the eigenvalues of largest modulus of a real operator.

use super::dense::{
    GrowingColumns, Orthonormalized, add_product, orthonormalize, product, random_columns,
    transpose_product,
};
use super::dense_eigen::{RealEigen, real_eigen};
use super::gram::orthonormal_columns;
use super::{LinalgError, interruption};
use faer::{Mat, MatRef, c64};

/// A real linear operator that is applied to blocks of vectors.
pub trait BlockOperator {
    /// Length of the vectors.
    fn dimension(&self) -> usize;
    /// `S x` for each column of `x`.
    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64>;
}

/// Settings of [`krylov_schur`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KrylovSchurSettings {
    /// Eigenvalues wanted, largest modulus first; one more where their number would split a conjugate pair.
    pub wanted: usize,
    /// Bound on `|S x - theta x| / |theta x|`.
    pub tolerance: f64,
    /// Width of the random start block.
    pub block: usize,
    /// Operator applications (in vectors) after which the iteration gives up.
    pub max_applications: usize,
}

/// Real eigenpairs in real storage, largest modulus first.
///
/// Conjugate pairs are neighbours, the positive imaginary part first, their vector stored as
/// `(Re, Im)` in two neighbouring columns.
#[derive(Clone, Debug)]
pub struct RealPairs {
    /// Eigenvalues `theta`.
    pub values: Vec<c64>,
    /// Vectors of unit length (pair: of the complex vector), `dimension x values.len()`.
    pub vectors: Mat<f64>,
    /// `|S x - theta x| / |theta|` of each.
    pub residuals: Vec<f64>,
    /// Operator applications spent, in vectors.
    pub applications: usize,
}

/// Eigenvalues of largest modulus of `S`, with vectors.
///
/// Block Arnoldi, `S Q = Q H + Q' B`, with thick restarts; the vectors returned are one application of
/// `S` further than the Ritz vectors, which damps what the operator damps. The start is
/// pseudo-random and always the same. Complete up to the multiplicity that the block width resolves at once; a multiple eigenvalue beyond it converges
/// later, through round-off.
///
/// # Errors
/// If pairs remain unconverged after `max_applications`; none of them is returned then.
///
/// Source: G. W. Stewart, A Krylov-Schur algorithm for large eigenproblems, SIAM J. Matrix Anal.
/// Appl. 23 (2001); here in blocks, and with an orthonormal basis of the Ritz subspace for the Schur
/// vectors.
pub fn krylov_schur(
    operator: &dyn BlockOperator,
    settings: &KrylovSchurSettings,
) -> Result<RealPairs, LinalgError> {
    let n = operator.dimension();
    let (count, seed) = (settings.wanted, random_columns(n, settings.block.min(n), 0x5eed));
    if 2 * count + 8 * seed.ncols() >= n {
        return whole(operator, count);
    }
    let mut process = BlockArnoldi::new(operator, seed);
    let mut looked_at = 0;
    loop {
        interruption::check();
        process.expand();
        let too_small = process.dimension() < count;
        // A dense decomposition costs as much as many applications: look when the basis has grown by a tenth.
        let too_early = 10 * process.dimension() < 11 * looked_at;
        if (too_small || too_early) && !process.is_exhausted() {
            continue;
        }
        looked_at = process.dimension();
        let eigen = real_eigen(process.projection.as_ref(), false, count)?;
        let order = by_modulus(&eigen.values);
        let residuals = process.ritz_residuals(&eigen);
        let wanted = wanted_count(&eigen, &order, count);
        let is_converged = |i: &&usize| residuals[**i] <= settings.tolerance;
        let converged = order[..wanted].iter().filter(is_converged).count();
        if converged == wanted || process.is_exhausted() {
            return process.finish(&eigen, &order[..wanted], settings);
        }
        if process.applications >= settings.max_applications {
            return Err(LinalgError::NotConverged {
                converged,
                wanted,
                tolerance: settings.tolerance,
                applications: process.applications,
            });
        }
        let target = wanted.max(process.width());
        let limit = 2 * target + 8 * process.width();
        if process.dimension() + process.width() > limit.min(n) {
            let keep = target + (process.dimension() - target) / 3;
            process.restart(&eigen, &order[..keep.min(order.len())]);
            looked_at = process.dimension();
        }
    }
}

/// The `count` largest pairs of a small operator by a dense decomposition: a basis of twice their number would be nearly all of
/// its space.
fn whole(operator: &dyn BlockOperator, count: usize) -> Result<RealPairs, LinalgError> {
    let n = operator.dimension();
    let matrix = operator.apply(Mat::identity(n, n).as_ref());
    let eigen = real_eigen(matrix.as_ref(), false, count)?;
    let order = by_modulus(&eigen.values);
    let own = wanted_count(&eigen, &order, count);
    let chosen = &order[..own];
    let values: Vec<c64> = chosen.iter().map(|&i| eigen.values[i]).collect();
    let ritz = Mat::from_fn(n, own, |i, j| eigen.right[(i, chosen[j])]);
    let mut vectors = product(matrix.as_ref(), ritz.as_ref());
    let residuals = pair_residuals(&values, &ritz, &vectors);
    normalize_pairs(&values, &mut vectors);
    Ok(RealPairs { values, vectors, residuals, applications: n })
}

/// Indices of the eigenvalues, largest modulus first, pairs unbroken.
fn by_modulus(values: &[c64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    // A stable sort: the two members of a pair have bitwise equal modulus and stay neighbours.
    order.sort_by(|&a, &b| values[b].norm().total_cmp(&values[a].norm()));
    order
}

/// How many leading eigenvalues are wanted, of those that there are.
fn wanted_count(eigen: &RealEigen, order: &[usize], count: usize) -> usize {
    let count = count.min(order.len());
    let splits_pair = count > 0 && eigen.values[order[count - 1]].im > 0.0;
    count + usize::from(splits_pair)
}

/// `S Q = Q H + Q' B` with `[Q Q']` orthonormal.
struct BlockArnoldi<'a> {
    operator: &'a dyn BlockOperator,
    /// `Q`.
    basis: GrowingColumns,
    /// `Q'`, the next block.
    next: Mat<f64>,
    /// `H`.
    projection: Mat<f64>,
    /// `B`.
    coupling: Mat<f64>,
    applications: usize,
}

impl<'a> BlockArnoldi<'a> {
    fn new(operator: &'a dyn BlockOperator, start: Mat<f64>) -> Self {
        let n = operator.dimension();
        let empty = Mat::<f64>::zeros(n, 0);
        let next = orthonormalize(empty.as_ref(), start, 1e-10).columns;
        Self {
            operator,
            coupling: Mat::zeros(next.ncols(), 0),
            next,
            basis: GrowingColumns::new(n),
            projection: Mat::zeros(0, 0),
            applications: 0,
        }
    }

    fn dimension(&self) -> usize {
        self.basis.count()
    }

    fn width(&self) -> usize {
        self.next.ncols()
    }

    /// Whether the basis spans an invariant subspace: nothing is left to add.
    fn is_exhausted(&self) -> bool {
        self.width() == 0
    }

    /// Moves the next block into the basis and computes the one after it.
    fn expand(&mut self) {
        let image = self.operator.apply(self.next.as_ref());
        self.applications += self.width();
        let (old, width) = (self.dimension(), self.width());
        self.basis.append(self.next.as_ref());
        let result = orthonormalize_block(self.basis.columns(), image);
        let mut projection = Mat::zeros(old + width, old + width);
        for j in 0..old + width {
            for i in 0..old + width {
                projection[(i, j)] = match (i < old, j < old) {
                    (true, true) => self.projection[(i, j)],
                    (false, true) => self.coupling[(i - old, j)],
                    (_, false) => result.against[(i, j - old)],
                };
            }
        }
        let mut coupling = Mat::zeros(result.columns.ncols(), old + width);
        for j in 0..width {
            for i in 0..result.columns.ncols() {
                coupling[(i, old + j)] = result.within[(i, j)];
            }
        }
        self.next = result.columns;
        self.projection = projection;
        self.coupling = coupling;
    }

    /// `|B y| / |theta|` of every Ritz pair, `|y| = 1`.
    fn ritz_residuals(&self, eigen: &RealEigen) -> Vec<f64> {
        let overflow = product(self.coupling.as_ref(), eigen.right.as_ref());
        (0..eigen.values.len())
            .map(|i| {
                let (first, last) = pair_columns(&eigen.values, i);
                let norm = |m: &Mat<f64>| {
                    (first..=last).map(|j| m.col(j).squared_norm_l2()).sum::<f64>().sqrt()
                };
                norm(&overflow) / (norm(&eigen.right) * eigen.values[i].norm())
            })
            .collect()
    }

    /// Shrinks the basis to the Ritz vectors `kept`, with the next block unchanged.
    fn restart(&mut self, eigen: &RealEigen, kept: &[usize]) {
        let mut kept = kept.to_vec();
        if let Some(&last) = kept.last()
            && eigen.values[last].im > 0.0
        {
            kept.pop();
        }
        let ritz = Mat::from_fn(self.dimension(), kept.len(), |i, j| eigen.right[(i, kept[j])]);
        let empty = Mat::<f64>::zeros(self.dimension(), 0);
        let vectors = orthonormalize(empty.as_ref(), ritz, 1e-12).columns;
        self.basis.combine(vectors.as_ref());
        let image = product(self.projection.as_ref(), vectors.as_ref());
        self.projection = product(vectors.transpose(), image.as_ref());
        self.coupling = product(self.coupling.as_ref(), vectors.as_ref());
    }

    /// Purified eigenvectors of the chosen Ritz pairs, each held to the tolerance once more.
    fn finish(
        mut self,
        eigen: &RealEigen,
        chosen: &[usize],
        settings: &KrylovSchurSettings,
    ) -> Result<RealPairs, LinalgError> {
        let values: Vec<c64> = chosen.iter().map(|&i| eigen.values[i]).collect();
        let coefficients =
            Mat::from_fn(self.dimension(), chosen.len(), |i, j| eigen.right[(i, chosen[j])]);
        let ritz = product(self.basis.columns(), coefficients.as_ref());
        let mut vectors = self.operator.apply(ritz.as_ref());
        self.applications += chosen.len();
        let residuals = pair_residuals(&values, &ritz, &vectors);
        // The explicit residual has a floor of round-off that the recurrence does not see.
        let bound = settings.tolerance.max(1e-10);
        let converged = residuals.iter().filter(|&&r| r <= bound).count();
        if converged < values.len() {
            return Err(LinalgError::NotConverged {
                converged,
                wanted: values.len(),
                tolerance: bound,
                applications: self.applications,
            });
        }
        normalize_pairs(&values, &mut vectors);
        Ok(RealPairs { values, vectors, residuals, applications: self.applications })
    }
}

/// [`orthonormalize`] by Gram matrices, unless columns depend on one another.
fn orthonormalize_block(basis: MatRef<'_, f64>, mut w: Mat<f64>) -> Orthonormalized {
    let mut against = Mat::zeros(basis.ncols(), w.ncols());
    for _ in 0..2 {
        let overlap = transpose_product(basis, w.as_ref());
        add_product(w.as_mut(), -1.0, basis, overlap.as_ref());
        against += overlap;
    }
    match orthonormal_columns(w) {
        Ok(factors) => {
            Orthonormalized { columns: factors.columns, against, within: factors.within }
        }
        Err(w) => {
            let mut rest = orthonormalize(basis, w, 1e-14);
            rest.against += against;
            rest
        }
    }
}

/// First and last column of the pair (or single vector) that column `i` belongs to.
fn pair_columns(values: &[c64], i: usize) -> (usize, usize) {
    match values[i].im {
        im if im > 0.0 => (i, i + 1),
        im if im < 0.0 => (i - 1, i),
        _ => (i, i),
    }
}

/// `|S x - theta x| / |theta x|` of each pair from `x` and `S x`.
fn pair_residuals(values: &[c64], x: &Mat<f64>, image: &Mat<f64>) -> Vec<f64> {
    (0..values.len())
        .map(|i| {
            let (first, last) = pair_columns(values, i);
            let theta = values[first];
            let (mut error, mut length) = (0.0, 0.0);
            for row in 0..x.nrows() {
                let at = |m: &Mat<f64>| {
                    let imaginary = if last > first { m[(row, last)] } else { 0.0 };
                    c64::new(m[(row, first)], imaginary)
                };
                error += (at(image) - theta * at(x)).norm_sqr();
                length += (theta * at(x)).norm_sqr();
            }
            (error / length).sqrt()
        })
        .collect()
}

/// Scales each vector, real or complex, to unit length.
fn normalize_pairs(values: &[c64], vectors: &mut Mat<f64>) {
    let mut i = 0;
    while i < values.len() {
        let (first, last) = pair_columns(values, i);
        let length = (first..=last).map(|j| vectors.col(j).squared_norm_l2()).sum::<f64>().sqrt();
        for j in first..=last {
            vectors.col_mut(j).iter_mut().for_each(|v| *v /= length);
        }
        i = last + 1;
    }
}
