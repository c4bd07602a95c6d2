//! Block Krylov-Schur iteration for the eigenvalues of largest modulus of a real operator.

use super::dense::{
    GrowingColumns, Orthonormalized, add_product, join_rows, orthonormalize, pick_columns, product,
    transpose_product,
};
use super::dense_eigen::{RealEigen, real_eigen, real_eigen_above};
use super::gram::orthonormal_columns;
use super::{LinalgError, interruption};
use faer::{Mat, MatRef, c64};
use std::ops::RangeInclusive;

/// Columns of the basis, for each eigenvalue wanted, at the first look at the projected problem: with fewer nothing has converged.
const FIRST_LOOK: usize = 2;
/// Part of the way to the tolerance, as the last two looks foretell it, after which there is another one: iterations become faster.
const NEXT_LOOK: f64 = 0.7;
/// Columns of the basis, for each eigenvalue wanted, from which on it is restarted: with fewer, restarts cost more than they save.
const LARGEST_BASIS: usize = 3;

/// A real linear operator that is applied to blocks of vectors.
pub trait BlockOperator {
    /// Length of the vectors.
    fn dimension(&self) -> usize;
    /// `S x` for each column of `x`.
    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64>;
}

/// What [`krylov_schur`] looks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KrylovSchurSettings {
    /// Eigenvalues wanted, largest modulus first; one more where their number would split a conjugate pair.
    pub wanted: usize,
    /// Modulus of the last one wanted over that of others which are given too, if they have converged as well.
    pub tie: f64,
    /// Bound on `|S x - theta x| / |theta x|`.
    pub tolerance: f64,
    /// Operator applications (in vectors) after which the pairs are given as they are.
    pub max_applications: usize,
    /// Dimension up to which a dense decomposition is as cheap, and misses nothing; up to three times as large, one stands in for an
    /// iteration that does not converge.
    pub dense_up_to: usize,
}

/// Real eigenpairs in real storage, largest modulus first.
///
/// Conjugate pairs are neighbours, the positive imaginary part first, their vector stored as `(Re, Im)` in two neighbouring columns.
#[derive(Clone, Debug)]
pub struct RealPairs {
    /// Eigenvalues `theta`.
    pub values: Vec<c64>,
    /// Vectors of unit length (pair: of the complex vector), `dimension x values.len()`.
    pub vectors: Mat<f64>,
    /// `|S x - theta x| / |theta|` of each, before the last application; zeros of a dense decomposition.
    pub residuals: Vec<f64>,
}

/// Eigenvalues of largest modulus of `S` among those that `is_wanted` holds for, with vectors; a conjugate pair is asked for by its
/// member with `Im > 0`.
///
/// Block Arnoldi, `S Q = Q H + Q' B`, from the `start`, with thick restarts. The vectors returned, `Q H y + Q' B y`, are one application
/// of `S` further than the Ritz vectors `Q y`, which damps what the operator damps. Complete up to the multiplicity that the block
/// width resolves at once; a multiple eigenvalue beyond it converges later, through round-off. Pairs that have not converged after
/// `max_applications` are returned as they are: their residuals tell.
///
/// # Errors
/// If a dense decomposition does not converge.
///
/// Source: G. W. Stewart, A Krylov-Schur algorithm for large eigenproblems, SIAM J. Matrix Anal. Appl. 23 (2001); here in blocks, and with
/// an orthonormal basis of the Ritz subspace for the Schur vectors.
pub fn krylov_schur(
    operator: &dyn BlockOperator,
    start: Mat<f64>,
    is_wanted: &dyn Fn(c64) -> bool,
    settings: &KrylovSchurSettings,
) -> Result<RealPairs, LinalgError> {
    let (n, width) = (operator.dimension(), start.ncols());
    if n <= settings.dense_up_to || LARGEST_BASIS * settings.wanted + 8 * width >= n {
        return whole(operator, is_wanted, settings);
    }
    let mut process = BlockArnoldi::new(operator, start); // S Q = Q H + Q' B, block by block.
    let (mut next_look, mut last_look) = (FIRST_LOOK * settings.wanted, (f64::INFINITY, 0));
    loop {
        interruption::check();
        process.expand();
        let is_spent = process.applications >= settings.max_applications;
        if process.applications < next_look && !process.is_exhausted() && !is_spent {
            continue;
        }
        let eigen = real_eigen(process.projections()[0], false, settings.wanted)?;
        let chosen = leading(&eigen.values, is_wanted, settings.wanted, 1.0); // Ritz values are those of H.
        let residuals = process.residuals(&eigen, &chosen);
        let is_converged = residuals.iter().all(|residual| *residual <= settings.tolerance);
        if is_spent && !is_converged && n <= 3 * settings.dense_up_to {
            return whole(operator, is_wanted, settings);
        }
        let is_complete = chosen.len() >= settings.wanted && is_converged;
        if is_complete || process.is_exhausted() || is_spent {
            let mut given = leading(&eigen.values, is_wanted, settings.wanted, settings.tie);
            let mut residuals = process.residuals(&eigen, &given);
            let beyond = residuals.iter().skip(chosen.len());
            let converged = beyond.take_while(|own| **own <= settings.tolerance).count();
            given.truncate(chosen.len() + converged); // Ties as far as they have converged.
            residuals.truncate(given.len());
            return Ok(process.finish(&eigen, &given, residuals));
        }

        // What is larger than the last one wanted stays, wanted or not, and a third of the rest.
        let order = by_modulus(&eigen.values);
        let last =
            chosen.last().map_or(0, |&own| 1 + order.iter().position(|&i| i == own).unwrap_or(0));
        let target = last.max(settings.wanted).max(process.width());
        let largest = LARGEST_BASIS * target + 8 * process.width();
        if process.dimension() + process.width() > largest {
            let keep = target + (process.dimension() - target) / 3;
            process.restart(&eigen, &order[..keep.min(order.len())]);
        }

        // A dense decomposition costs as much as many applications: the next one on the way to where the last two foretell the end, after
        // a tenth of the basis at least, and no later than its restart.
        let worst = residuals.iter().copied().fold(0.0, f64::max);
        let (before, then) = std::mem::replace(&mut last_look, (worst, process.applications));
        let rate = (before / worst).ln() / (process.applications - then) as f64;
        let foretold = NEXT_LOOK * (worst / settings.tolerance).ln() / rate;
        let [tenth, room] =
            [process.dimension().div_ceil(10), largest.saturating_sub(process.dimension())];
        // No number, of looks that foretell nothing, is none.
        next_look = process.applications + (foretold as usize).clamp(tenth, room.max(tenth));
    }
}

/// The pairs of a small operator by a dense decomposition.
fn whole(
    operator: &dyn BlockOperator,
    is_wanted: &dyn Fn(c64) -> bool,
    settings: &KrylovSchurSettings,
) -> Result<RealPairs, LinalgError> {
    let n = operator.dimension();
    let matrix = operator.apply(Mat::identity(n, n).as_ref());
    let chosen = |values: &[c64]| leading(values, is_wanted, settings.wanted, settings.tie);
    let smallest = |values: &[c64]| {
        let moduli = chosen(values).into_iter().map(|i| values[i].norm());
        moduli.fold(f64::INFINITY, f64::min)
    };
    let eigen = real_eigen_above(matrix.as_ref(), false, &smallest)?;
    let chosen = chosen(&eigen.values);
    let ritz = pick_columns(&eigen.right, &chosen);
    let vectors = product(matrix.as_ref(), ritz.as_ref()); // S x, one application further.
    let residuals = vec![0.0; chosen.len()];
    Ok(normalized(&eigen, &chosen, vectors, residuals))
}

/// The `wanted` leading ones of the eigenvalues that `is_wanted` holds for, and those that a `tie` holds for, pairs unbroken.
fn leading(values: &[c64], is_wanted: &dyn Fn(c64) -> bool, wanted: usize, tie: f64) -> Vec<usize> {
    let mut order = by_modulus(values);
    order.retain(|&i| is_wanted(c64::new(values[i].re, values[i].im.abs())));
    let last = order.get(wanted.wrapping_sub(1)).map(|&i| values[i]);
    let splits_pair = last.is_some_and(|last| last.im > 0.0);
    let count = wanted + usize::from(splits_pair); // The next one is its conjugate.
    let beyond = order.iter().skip(count);
    let smallest = last.map_or(f64::INFINITY, |last| last.norm() / tie);
    let tied = beyond.take_while(|&&i| tie > 1.0 && values[i].norm() >= smallest).count();
    order.truncate(count + tied);
    order
}

/// Indices of the eigenvalues, largest modulus first, pairs unbroken.
fn by_modulus(values: &[c64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    // A stable sort: the two members of a pair have bitwise equal modulus and stay neighbours.
    order.sort_by(|&a, &b| values[b].norm().total_cmp(&values[a].norm()));
    order
}

/// `S Q = Q H + Q' B` with `[Q Q']` orthonormal.
struct BlockArnoldi<'a> {
    operator: &'a dyn BlockOperator,
    /// `Q`.
    basis: GrowingColumns,
    /// `Q'`, the next block.
    next: Mat<f64>,
    /// `H` above `B`.
    images: Mat<f64>,
    applications: usize,
}

impl<'a> BlockArnoldi<'a> {
    fn new(operator: &'a dyn BlockOperator, start: Mat<f64>) -> Self {
        let n = operator.dimension();
        let empty = Mat::<f64>::zeros(n, 0);
        let next = orthonormalize(empty.as_ref(), start, 1e-10).columns;
        let images = Mat::zeros(next.ncols(), 0);
        Self { operator, basis: GrowingColumns::new(n), next, images, applications: 0 }
    }

    fn dimension(&self) -> usize {
        self.basis.count()
    }

    fn width(&self) -> usize {
        self.next.ncols()
    }

    /// `H` and `B`.
    fn projections(&self) -> [MatRef<'_, f64>; 2] {
        self.images.as_ref().split_at_row(self.dimension()).into()
    }

    /// Whether the basis spans an invariant subspace: nothing is left to add.
    fn is_exhausted(&self) -> bool {
        self.width() == 0
    }

    /// Moves the next block into the basis and computes the one after it.
    fn expand(&mut self) {
        let image = self.operator.apply(self.next.as_ref());
        self.applications += self.width();
        let old = self.dimension();
        self.basis.append(self.next.as_ref());
        let Orthonormalized { columns, against, within } =
            orthonormalize_block(self.basis.columns(), image);
        // The old coupling becomes the last rows of H; only the last block goes beyond the basis.
        let known = self.dimension();
        self.images.resize_with(known + columns.ncols(), known, |i, j| {
            match (i < known, j < old) {
                (true, _) => against[(i, j - old)],
                (false, true) => 0.0,
                (false, false) => within[(i - known, j - old)],
            }
        });
        self.next = columns;
    }

    /// `|B y| / |theta|`, `|y| = 1`, of the Ritz pairs `chosen`.
    fn residuals(&self, eigen: &RealEigen, chosen: &[usize]) -> Vec<f64> {
        let overflow = product(self.projections()[1], eigen.right.as_ref());
        let residual = |&i: &usize| {
            let pair = pair_columns(&eigen.values, i);
            let norm = |m: &Mat<f64>| length(m, pair.clone());
            norm(&overflow) / (norm(&eigen.right) * eigen.values[i].norm())
        };
        chosen.iter().map(residual).collect()
    }

    /// Shrinks the basis to the Ritz vectors `kept`, with the next block unchanged.
    fn restart(&mut self, eigen: &RealEigen, kept: &[usize]) {
        let mut kept = kept.to_vec();
        if let Some(&last) = kept.last()
            && eigen.values[last].im > 0.0
        {
            kept.pop(); // Half of a pair.
        }
        let ritz = pick_columns(&eigen.right, &kept);
        let empty = Mat::<f64>::zeros(self.dimension(), 0);
        let vectors = orthonormalize(empty.as_ref(), ritz, 1e-12).columns;
        let [projection, coupling] = self.projections().map(|own| product(own, vectors.as_ref()));
        let projection = transpose_product(vectors.as_ref(), projection.as_ref());
        self.images = join_rows(projection.as_ref(), coupling.as_ref()); // V^T H V above B V.
        self.basis.combine(vectors.as_ref());
    }

    /// The `chosen` Ritz pairs, one application of the operator further.
    fn finish(self, eigen: &RealEigen, chosen: &[usize], residuals: Vec<f64>) -> RealPairs {
        let ritz = pick_columns(&eigen.right, chosen);
        let [within, beyond] = self.projections().map(|own| product(own, ritz.as_ref()));
        let mut vectors = product(self.basis.columns(), within.as_ref());
        add_product(vectors.as_mut(), 1.0, self.next.as_ref(), beyond.as_ref()); // Q H y + Q' B y.
        normalized(eigen, chosen, vectors, residuals)
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
        Ok([columns, within]) => Orthonormalized { columns, against, within },
        Err(w) => {
            let mut rest = orthonormalize(basis, w, 1e-14); // Columns that depend on one another, one by one.
            rest.against += against;
            rest
        }
    }
}

/// Columns of the pair (or single vector) that column `i` belongs to.
fn pair_columns(values: &[c64], i: usize) -> RangeInclusive<usize> {
    match values[i].im {
        im if im > 0.0 => i..=i + 1,
        im if im < 0.0 => i - 1..=i,
        _ => i..=i,
    }
}

/// Length of the vector, real or complex, in some columns.
fn length(m: &Mat<f64>, columns: RangeInclusive<usize>) -> f64 {
    columns.map(|j| m.col(j).squared_norm_l2()).sum::<f64>().sqrt()
}

/// The `chosen` pairs with these vectors, real or complex, scaled to unit length.
fn normalized(
    eigen: &RealEigen,
    chosen: &[usize],
    mut vectors: Mat<f64>,
    residuals: Vec<f64>,
) -> RealPairs {
    let values: Vec<c64> = chosen.iter().map(|&i| eigen.values[i]).collect();
    let lengths = (0..values.len()).map(|i| length(&vectors, pair_columns(&values, i)));
    for (j, length) in lengths.collect::<Vec<_>>().into_iter().enumerate() {
        vectors.col_mut(j).iter_mut().for_each(|v| *v /= length);
    }
    RealPairs { values, vectors, residuals }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::random_columns;

    /// `[A B; I 0]`: eigenvalues `s` with `s^2 w = s A w + B w`.
    struct Companion(Mat<f64>);

    impl BlockOperator for Companion {
        fn dimension(&self) -> usize {
            self.0.nrows()
        }

        fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
            product(self.0.as_ref(), x)
        }
    }

    /// A lightly damped unsymmetric problem with frequencies `1, 2, ...`, and four motions of large `|s|` that decay and hardly oscillate,
    /// `|Im s| / |s| = 0.03`.
    fn oscillators(size: usize) -> Companion {
        let (r, s) = (random_columns(size, size, 3), random_columns(size, size, 4));
        let decay = |i: usize| (i + 4 >= size).then(|| -5.0 - (size - i) as f64);
        let is_free = |i: usize, j: usize| decay(i).or(decay(j)).is_none();
        let damped = |i: usize, j: usize| match decay(i).filter(|_| i == j) {
            Some(p) => 2.0 * p,
            None if is_free(i, j) => -2e-3 * r[(i, j)] / ((1 + i) * (1 + j)) as f64,
            None => 0.0,
        };
        let inert = |i: usize, j: usize| match decay(i).filter(|_| i == j) {
            Some(p) => -p * p * (1.0 + 0.03 * 0.03),
            None if is_free(i, j) => {
                let own = f64::from(u8::from(i == j)) / ((1 + i) as f64).powi(2);
                1e-2 * s[(i, j)] / ((1 + i) * (1 + j)) as f64 - own
            }
            None => 0.0,
        };
        Companion(Mat::from_fn(2 * size, 2 * size, |i, j| match (i < size, j < size) {
            (true, true) => damped(i, j),
            (true, false) => inert(i, j - size),
            (false, _) => f64::from(u8::from(i - size == j)),
        }))
    }

    fn oscillates(s: c64) -> bool {
        s.im > 0.1 * s.norm()
    }

    fn settings(max_applications: usize, dense_up_to: usize) -> KrylovSchurSettings {
        KrylovSchurSettings {
            wanted: 16,
            tie: 1.0,
            tolerance: 1e-12,
            max_applications,
            dense_up_to,
        }
    }

    /// Independent check: by the iteration and by a dense decomposition the same pairs, whose vectors satisfy the equation; what is not
    /// wanted takes no places.
    #[test]
    fn pairs_that_are_wanted_agree_with_a_dense_decomposition() {
        let operator = oscillators(150);
        let [found, exact] = [0, 300].map(|dense_up_to| {
            let start = random_columns(300, 2, 1);
            krylov_schur(&operator, start, &oscillates, &settings(4000, dense_up_to)).unwrap()
        });
        assert_eq!((found.values.len(), exact.values.len()), (16, 16));
        assert!(found.residuals.iter().all(|residual| *residual <= 1e-12));
        let images = operator.apply(found.vectors.as_ref());
        for (k, (s, other)) in found.values.iter().zip(&exact.values).enumerate() {
            assert!((s - other).norm() < 1e-10 * s.norm(), "{s} {other}");
            // Of the oscillators 1, 2, ... the first eight, coupled to a hundredth.
            assert!((s.norm().recip() - (k / 2 + 1) as f64).abs() < 0.2, "{s}");
            if s.im > 0.0 {
                let at = |m: &Mat<f64>, i: usize| c64::new(m[(i, k)], m[(i, k + 1)]);
                let errors =
                    (0..300).map(|i| (at(&images, i) - s * at(&found.vectors, i)).norm_sqr());
                assert!(errors.sum::<f64>().sqrt() < 1e-10 * s.norm());
            }
        }
    }

    /// Independent check: what lies near the last one wanted and has converged as well is given too, by either way.
    #[test]
    fn pairs_near_the_last_one_wanted_are_given_too() {
        let operator = oscillators(150);
        let [found, exact] = [0, 300].map(|dense_up_to| {
            let settings = KrylovSchurSettings { tie: 1.2, ..settings(4000, dense_up_to) };
            krylov_schur(&operator, random_columns(300, 2, 1), &oscillates, &settings).unwrap()
        });
        // Of the oscillators 1, 2, ... the ninth is 1.13 times as fast as the eighth.
        assert_eq!((found.values.len(), exact.values.len()), (18, 18));
        assert!(found.residuals.iter().all(|residual| *residual <= 1e-12));
        for (s, other) in found.values.iter().zip(&exact.values) {
            assert!((s - other).norm() < 1e-10 * s.norm(), "{s} {other}");
        }
    }

    /// Exact: with its applications spent an iteration gives the pairs that it has, and their residuals tell.
    #[test]
    fn spent_iteration_gives_the_pairs_it_has() {
        let operator = oscillators(150);
        let start = random_columns(300, 2, 1);
        let found = krylov_schur(&operator, start, &oscillates, &settings(40, 0)).unwrap();
        assert!(found.values.len() <= 16 && found.residuals.iter().any(|own| *own > 1e-12));
    }

    #[test]
    fn invariant_subspace_ends_the_iteration_with_what_there_is() {
        let diagonal = Mat::from_fn(90, 90, |i, j| f64::from(u8::from(i == j && i < 3)) * 2.0);
        let start = Mat::from_fn(90, 2, |i, j| f64::from(u8::from(i == j)));
        let operator = Companion(diagonal);
        let found = krylov_schur(&operator, start, &|s| s.norm() > 1.0, &settings(400, 0)).unwrap();
        assert_eq!(found.values, [c64::new(2.0, 0.0); 2]);
    }
}
