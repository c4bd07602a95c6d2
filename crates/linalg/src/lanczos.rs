//! Block Lanczos iteration with thick restarts for symmetric pencils.

use super::dense::{
    add_product, column, column_mut, column_norms, combine, dot, join_columns, join_rows,
    pick_columns, product, random_columns, transpose_product,
};
use super::{LinalgError, interruption};
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{
    ComputeEigenvectors, SelfAdjointEvdParams, self_adjoint_evd, self_adjoint_evd_scratch,
};
use faer::{Auto, Mat, MatRef, Par, Spec};

/// Part of a new vector beyond the others of its block below which it is round-off: what is dropped is missing in residuals.
const DEPENDENT: f64 = 1e-13;

/// A symmetric pencil `(A, M)`, `M` positive definite: what the iteration asks of it.
pub trait SymmetricPencil {
    /// Number of unknowns.
    fn dimension(&self) -> usize;
    /// `M x`.
    fn mass_times(&self, x: MatRef<'_, f64>) -> Mat<f64>;
    /// `A^-1 x` for each column, in place.
    fn solve_in_place(&self, x: &mut Mat<f64>);
}

/// What is wanted, and how hard to try.
#[derive(Clone, Copy, Debug)]
pub struct LanczosSettings {
    /// Pairs of largest `theta`.
    pub count: usize,
    /// Largest residual `|A^-1 M x - theta x|_M`, relative to the pair's own `theta`.
    pub tolerance: f64,
    /// Vectors that are iterated together: at least the largest multiplicity that is likely.
    pub block: usize,
    /// Restarts before the iteration gives up.
    pub max_restarts: usize,
}

/// Pairs `A^-1 M x = theta x` by falling `theta`, with `x^T M x = 1`.
pub struct LanczosPairs {
    /// How many of them keep the tolerance: all, unless the restarts were spent.
    pub converged: usize,
    /// `theta`.
    pub values: Vec<f64>,
    /// `x`, a column each.
    pub vectors: Mat<f64>,
}

/// The pairs of largest `theta` of `A^-1 M x = theta x`, `A` positive definite.
///
/// Block Lanczos process in the inner product of `M`, each new block orthogonalized against all vectors, restarted with the
/// leading Ritz vectors. The projected matrix is symmetric: vectors of equal and of close `theta` come out orthonormal. Where
/// the space becomes invariant it goes on with random vectors, so that no multiplicity hides a pair. A pair is held to its own
/// `theta`: small ones are as accurate, relative to themselves, as round-off relative to the largest allows.
///
/// # Errors
/// [`LinalgError::DenseEigen`].
///
/// Source: R. G. Grimes, J. G. Lewis, H. D. Simon, A shifted block Lanczos algorithm for solving sparse symmetric generalized
/// eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994); K. Wu, H. Simon, Thick-restart Lanczos method, the same 22 (2000).
pub fn block_lanczos(
    pencil: &dyn SymmetricPencil,
    settings: &LanczosSettings,
) -> Result<LanczosPairs, LinalgError> {
    let n = pencil.dimension();
    let count = settings.count.min(n);
    let block = settings.block.clamp(1, n);
    let largest = (2 * count + 8 * block).min(n);
    let mut process = Process::new(pencil, block);
    process.append(random_columns(n, block, 0x5eed));
    let (mut restarts, mut next_look) = (0, count + 2 * block);
    loop {
        interruption::check();
        process.expand();
        let is_full = process.expanded >= largest || process.expanded == n;
        if process.expanded < next_look.min(largest) && !is_full {
            continue;
        }
        next_look = process.expanded + (process.expanded / 4).max(2 * block);
        let ritz = process.ritz()?;
        let residuals = process.residuals(&ritz, count);
        let converged = residuals.iter().filter(|r| **r <= settings.tolerance).count();
        let is_whole = process.expanded == n;
        let is_spent = is_full && restarts == settings.max_restarts;
        if converged == count || is_whole || is_spent {
            let vectors = product(process.leading(), ritz.vectors.get(.., ..count));
            let converged = if is_whole { count } else { converged };
            let values = ritz.values[..count].to_vec();
            return Ok(LanczosPairs { converged, values, vectors });
        }
        if !is_full {
            continue;
        }
        restarts += 1;
        process.restart(&ritz, count + (process.expanded - count) / 3);
        next_look = process.expanded + 2 * block;
    }
}

/// Ritz pairs by falling value.
struct Ritz {
    values: Vec<f64>,
    vectors: Mat<f64>,
}

/// `A^-1 M Q = Q T + remainder`, `Q^T M Q = I`; the last `Q.ncols() - expanded` vectors are yet to be multiplied.
struct Process<'a> {
    pencil: &'a dyn SymmetricPencil,
    block: usize,
    /// `Q`.
    basis: Mat<f64>,
    /// `M Q`.
    momenta: Mat<f64>,
    /// Columns of `Q^T M A^-1 M Q`, for the vectors that were multiplied.
    projected: Mat<f64>,
    expanded: usize,
    seed: u64,
}

impl<'a> Process<'a> {
    fn new(pencil: &'a dyn SymmetricPencil, block: usize) -> Self {
        let n = pencil.dimension();
        let (basis, momenta) = (Mat::zeros(n, 0), Mat::zeros(n, 0));
        let projected = Mat::zeros(0, 0);
        Self { pencil, block, basis, momenta, projected, expanded: 0, seed: 1 }
    }

    /// The vectors that were multiplied.
    fn leading(&self) -> MatRef<'_, f64> {
        self.basis.get(.., ..self.expanded)
    }

    /// Multiplies the open vectors and appends what is new of their images, or random vectors where nothing is.
    fn expand(&mut self) {
        let (open, total) = (self.expanded, self.basis.ncols());
        let mut images = self.momenta.get(.., open..total).to_owned();
        self.pencil.solve_in_place(&mut images);
        let within = transpose_product(self.momenta.as_ref(), images.as_ref());
        add_product(images.as_mut(), -1.0, self.basis.as_ref(), within.as_ref());
        self.expanded = total;
        self.append(images.clone());
        // Coefficients along the new vectors: the images less what is known already.
        let added = self.basis.ncols() - total;
        let beyond = transpose_product(self.momenta.get(.., total..), images.as_ref());
        let known = self.projected.nrows();
        let mut projected = Mat::zeros(total + added, total);
        projected.get_mut(..known, ..open).copy_from(&self.projected);
        projected.get_mut(..total, open..).copy_from(&within);
        projected.get_mut(total.., open..).copy_from(&beyond);
        self.projected = projected;
        while self.basis.ncols() == self.expanded && self.expanded < self.pencil.dimension() {
            let n = self.pencil.dimension();
            self.seed += 1;
            self.append(random_columns(n, self.block, self.seed));
            self.projected.resize_with(self.basis.ncols(), total, |_, _| 0.0);
        }
    }

    /// Orthonormalizes columns against all vectors and one another in the inner product of `M`, and appends what is left of them.
    fn append(&mut self, mut columns: Mat<f64>) {
        let room = self.pencil.dimension() - self.basis.ncols();
        let lengths = column_norms(columns.as_ref());
        for j in (0..columns.ncols()).filter(|&j| lengths[j] > 0.0) {
            columns.col_mut(j).iter_mut().for_each(|v| *v /= lengths[j]);
        }
        // Twice is enough for orthogonality to round-off.
        let mut momenta = Mat::zeros(0, 0);
        for pass in 0..2 {
            let along = transpose_product(self.momenta.as_ref(), columns.as_ref());
            add_product(columns.as_mut(), -1.0, self.basis.as_ref(), along.as_ref());
            momenta = self.pencil.mass_times(columns.as_ref());
            let shortest = if pass == 0 { DEPENDENT } else { 0.0 };
            [columns, momenta] = orthonormalized(columns, momenta, shortest);
        }
        let kept = columns.ncols().min(room);
        let first = self.basis.ncols();
        let n = columns.nrows();
        self.basis.resize_with(n, first + kept, |i, j| columns[(i, j - first)]);
        self.momenta.resize_with(n, first + kept, |i, j| momenta[(i, j - first)]);
    }

    fn ritz(&self) -> Result<Ritz, LinalgError> {
        let m = self.expanded;
        let t = Mat::from_fn(m, m, |i, j| 0.5 * (self.projected[(i, j)] + self.projected[(j, i)]));
        // By the QR algorithm: dividing and conquering leaves errors of thousands of roundings in the smallest values (faer 0.24).
        let auto = <SelfAdjointEvdParams as Auto<f64>>::auto();
        let by_qr = Spec::new(SelfAdjointEvdParams { recursion_threshold: usize::MAX, ..auto });
        let (mut values, mut vectors) = (Diag::<f64>::zeros(m), Mat::<f64>::zeros(m, m));
        let with = ComputeEigenvectors::Yes;
        let scratch = self_adjoint_evd_scratch::<f64>(m, with, Par::Seq, by_qr);
        self_adjoint_evd(
            t.as_ref(),
            values.as_mut(),
            Some(vectors.as_mut()),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            by_qr,
        )
        .map_err(|_| LinalgError::DenseEigen { dimension: m })?;
        Ok(Ritz {
            values: values.column_vector().iter().rev().copied().collect(),
            vectors: Mat::from_fn(m, m, |i, j| vectors[(i, m - 1 - j)]),
        })
    }

    /// `|B y| / theta` of the `count` leading pairs, `B` what couples the multiplied vectors with the open ones.
    fn residuals(&self, ritz: &Ritz, count: usize) -> Vec<f64> {
        let coupling = self.projected.get(self.expanded.., ..);
        let count = count.min(self.expanded);
        let open = product(coupling, ritz.vectors.get(.., ..count));
        let norms = column_norms(open.as_ref()).into_iter();
        norms.zip(&ritz.values).map(|(norm, theta)| norm / theta).collect()
    }

    /// Keeps the `kept` leading Ritz vectors and the open ones.
    fn restart(&mut self, ritz: &Ritz, kept: usize) {
        let (old, total) = (self.expanded, self.basis.ncols());
        let leading = ritz.vectors.get(.., ..kept);
        let coupling = product(self.projected.get(old.., ..), leading);
        for columns in [&mut self.basis, &mut self.momenta] {
            let mut head = columns.get(.., ..old).to_owned();
            combine(&mut head, leading);
            let open = columns.get(.., old..total).to_owned();
            *columns = join_columns(head.as_ref(), open.as_ref());
        }
        let own = Mat::from_fn(kept, kept, |i, j| if i == j { ritz.values[i] } else { 0.0 });
        self.projected = join_rows(own.as_ref(), coupling.as_ref());
        self.expanded = kept;
    }
}

/// Orthonormal columns in the inner product of `M` and their images, from `w` and `M w`, by modified Gram-Schmidt, longest remainder
/// first; remainders shorter than `shortest` of their column are left out.
fn orthonormalized(mut w: Mat<f64>, mut momenta: Mat<f64>, shortest: f64) -> [Mat<f64>; 2] {
    let length = |w: &Mat<f64>, momenta: &Mat<f64>, j: usize| {
        dot(column(w.as_ref(), j), column(momenta.as_ref(), j)).max(0.0).sqrt()
    };
    let whole: Vec<f64> = (0..w.ncols()).map(|j| length(&w, &momenta, j)).collect();
    let mut open: Vec<usize> = (0..w.ncols()).collect();
    let mut kept = Vec::new();
    while !open.is_empty() {
        let remainder = |j: usize| length(&w, &momenta, j) / whole[j];
        let longest = (0..open.len())
            .max_by(|&a, &b| remainder(open[a]).total_cmp(&remainder(open[b])).then(b.cmp(&a)));
        let own = open.remove(longest.unwrap_or(0));
        let own_length = length(&w, &momenta, own);
        if !(own_length > shortest * whole[own]) {
            break;
        }
        for columns in [&mut w, &mut momenta] {
            column_mut(columns, own).iter_mut().for_each(|v| *v /= own_length);
        }
        for &other in &open {
            let along = dot(column(momenta.as_ref(), own), column(w.as_ref(), other));
            for columns in [&mut w, &mut momenta] {
                let known = column(columns.as_ref(), own).to_vec();
                let target = column_mut(columns, other).iter_mut().zip(known);
                target.for_each(|(t, k)| *t -= along * k);
            }
        }
        kept.push(own);
    }
    [w, momenta].map(|columns| pick_columns(&columns, &kept))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `diag(a)`, `diag(m)`.
    struct Diagonal(Vec<f64>, Vec<f64>);

    impl SymmetricPencil for Diagonal {
        fn dimension(&self) -> usize {
            self.0.len()
        }

        fn mass_times(&self, x: MatRef<'_, f64>) -> Mat<f64> {
            Mat::from_fn(x.nrows(), x.ncols(), |i, j| self.1[i] * x[(i, j)])
        }

        fn solve_in_place(&self, x: &mut Mat<f64>) {
            for j in 0..x.ncols() {
                x.col_mut(j).iter_mut().zip(&self.0).for_each(|(v, a)| *v /= a);
            }
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
        let settings = LanczosSettings { count: 30, tolerance: 1e-11, block: 8, max_restarts: 30 };
        let pairs = block_lanczos(&pencil, &settings).unwrap();
        for (theta, expected) in pairs.values.iter().zip(&kappa) {
            assert!((theta.recip() / expected - 1.0).abs() < 1e-12, "{} {expected}", theta.recip());
        }
        let momenta = pencil.mass_times(pairs.vectors.as_ref());
        let gram = transpose_product(pairs.vectors.as_ref(), momenta.as_ref());
        let identity = Mat::<f64>::identity(30, 30);
        assert!((gram - identity).norm_max() < 1e-12);
    }
}
