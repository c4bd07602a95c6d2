//! All eigenvalues of a small dense quadratic problem, over any range of sizes.

use crate::cea::*;
use crate::linalg::dense_eigen::real_eigenvalues;

/// Ratio of the shifts of neighbouring windows.
const WINDOW: f64 = 10.0;

/// An eigenpair of `(lambda^2 M + lambda C + K) x = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticMode {
    /// Eigenvalue `lambda`, `Im >= 0`: complex ones come in conjugate pairs, of which this is one.
    pub eigenvalue: c64,
    /// Right vector, largest entry one.
    pub vector: Vec<c64>,
    /// `|T x| / ((|lambda|^2 |M| + |lambda| |C| + |K|) |x|)` of the problem whose rows and columns are scaled to the size of one: the
    /// relative change of the matrices that makes the pair exact.
    pub residual: f64,
    /// What rounding of the matrices moves the eigenvalue by, relative to its size.
    pub uncertainty: f64,
}

impl QuadraticMode {
    /// Whether it grows by more than rounding.
    pub fn is_unstable(&self) -> bool {
        self.eigenvalue.re > self.uncertainty * self.eigenvalue.norm()
    }
}

/// All eigenpairs of a real quadratic problem, by size.
///
/// The spectrum is taken window by window in `|lambda|`: with the shift `sigma > 0` amid a window, rows and columns are scaled by
/// powers of two until `|K| + sigma |C| + sigma^2 |M|` is of the size of one, and
///
/// ```text
/// [ (X - 1) / sigma   - sigma Y ]
/// [ X / sigma         - sigma Y ],   X = T(sigma)^-1 K,  Y = T(sigma)^-1 M,   unknowns (x, lambda x / sigma)
/// ```
///
/// has the eigenvalues `1 / (lambda - sigma)`, accurate for those of its window. Windows go on until nothing is left on either side, so
/// sizes that lie many orders apart cost more windows, not digits. Zero and infinite eigenvalues are left out, and rounding of zero, as
/// rigid motions have it.
///
/// # Errors
/// [`CeaError::Linalg`] where an entry is not finite or a decomposition fails, or all are singular together.
///
/// # Panics
/// If the matrices are not square and of one size.
pub fn quadratic_modes(
    mass: MatRef<'_, f64>,
    damping: MatRef<'_, f64>,
    stiffness: MatRef<'_, f64>,
) -> Result<Vec<QuadraticMode>, CeaError> {
    let n = mass.nrows();
    for matrix in [mass, damping, stiffness] {
        assert_eq!([matrix.nrows(), matrix.ncols()], [n, n]);
        if !matrix.is_all_finite() {
            return Err(LinalgError::dense_eigen(n).into());
        }
    }
    let problem = Problem { matrices: [mass, damping, stiffness] };
    let ratio = (stiffness.norm_max() / mass.norm_max()).sqrt(); // Eigenvalues lie about sqrt(K / M): the first window is there.
    let first = if ratio.is_finite() && ratio > 0.0 { 0.7 * ratio } else { 1.0 };
    let mut values = Vec::new();
    let [below, above] = problem.window(first, &mut values)?;
    for (direction, mut left, mut step) in [(-1, below, 0), (1, above, 0)] {
        // What lies beyond 16 windows is zero or infinite to working precision.
        while left > 0 && step < 2 * MOST_ATTEMPTS as i32 {
            step += 1;
            let shift = first * WINDOW.powi(direction * step);
            left = match problem.window(shift, &mut values) {
                Ok(beyond) => beyond[usize::from(direction > 0)],
                // Singular to working precision: what is left is zero or infinite.
                Err(CeaError::Failed(_)) => break,
                Err(error) => return Err(error),
            };
        }
    }
    values.retain(|value| value.im >= 0.0);
    values.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
    let modes = values.iter().map(|value| problem.mode(*value));
    Ok(modes.filter(|mode| mode.uncertainty < 1.0).collect())
}

struct Problem<'a> {
    matrices: [MatRef<'a, f64>; 3],
}

impl Problem<'_> {
    /// Adds the eigenvalues of a window about `shift`; the numbers of smaller and of larger ones.
    fn window(&self, shift: f64, values: &mut Vec<c64>) -> Result<[usize; 2], CeaError> {
        let n = self.matrices[0].nrows();
        let ([mass, damping, stiffness], _) = self.scaled(shift);
        let sum = Mat::from_fn(n, n, |i, j| stiffness[(i, j)] + damping[(i, j)] + mass[(i, j)]); // T(sigma) of the scaled matrices.
        let factors = DenseLu::factorize(sum);
        let (mut x, mut y) = (stiffness, mass);
        factors.solve_in_place(x.as_mut());
        factors.solve_in_place(y.as_mut());
        if !(x.is_all_finite() && y.is_all_finite()) {
            return Err(CeaError::Failed(format!(
                "the mass, damping and stiffness matrices of {n} unknowns are singular together: \
                 some motion has neither mass nor stiffness. Remove unknowns that depend on each \
                 other"
            )));
        }
        // Of `sigma / (lambda - sigma)`, with `sigma^2 M` and `sigma C` in place of `M` and `C`.
        let one = |i: usize, j: usize| f64::from(u8::from(i == j));
        let inverse = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, true) => x[(i, j)] - one(i, j),
            (true, false) => -y[(i, j - n)],
            (false, true) => x[(i - n, j)],
            (false, false) => -y[(i - n, j - n)],
        });
        let (mut below, mut above) = (0, 0);
        let half = WINDOW.sqrt();
        for value in real_eigenvalues(inverse.as_ref())? {
            let relative = value.inv() + 1.0; // lambda / sigma = 1 + 1 / mu.
            match relative.norm() {
                size if size < 1.0 / half => below += 1,
                // Zero stands for infinity.
                size if !(size < half) => above += 1,
                _ => values.push(shift * relative),
            }
        }
        Ok([below, above])
    }

    /// `sigma^2 M`, `sigma C`, `K` with rows and columns scaled by powers of two, and the factors of the columns.
    fn scaled(&self, shift: f64) -> ([Mat<f64>; 3], Vec<f64>) {
        let n = self.matrices[0].nrows();
        let [mass, damping, stiffness] = self.matrices;
        let size = Mat::from_fn(n, n, |i, j| {
            let [m, c, k] = [mass[(i, j)], damping[(i, j)], stiffness[(i, j)]].map(f64::abs);
            k + shift * (c + shift * m)
        });
        let (mut rows, mut columns) = (vec![1.0; n], vec![1.0; n]);
        let root = |largest: f64| (-0.5 * largest.max(f64::MIN_POSITIVE).log2()).round().exp2(); // Half to the row, half to the column.
        for _ in 0..MOST_ATTEMPTS {
            for i in 0..n {
                let entries = (0..n).map(|j| size[(i, j)] * rows[i] * columns[j]);
                // The largest entry of each row and column comes to one, to a power of two.
                rows[i] *= root(entries.fold(0.0, f64::max));
            }
            for j in 0..n {
                let entries = (0..n).map(|i| size[(i, j)] * rows[i] * columns[j]);
                columns[j] *= root(entries.fold(0.0, f64::max));
            }
        }
        let scaled = |matrix: MatRef<'_, f64>, factor: f64| {
            Mat::from_fn(n, n, |i, j| factor * matrix[(i, j)] * rows[i] * columns[j])
        };
        let matrices =
            [scaled(mass, shift * shift), scaled(damping, shift), scaled(stiffness, 1.0)];
        (matrices, columns)
    }

    /// The pair of an eigenvalue, by inverse iteration in scaled unknowns, of which none is small by its unit alone.
    fn mode(&self, eigenvalue: c64) -> QuadraticMode {
        let n = self.matrices[0].nrows();
        let size = eigenvalue.norm();
        let ([mass, damping, stiffness], columns) = self.scaled(size);
        let pencil = |at: c64| {
            Mat::from_fn(n, n, |i, j| {
                stiffness[(i, j)] + at * (damping[(i, j)] + at * mass[(i, j)])
            })
        };

        let unit = eigenvalue / size;
        let lu = ComplexDenseLu::factorize(pencil(unit * (1.0 + 1e-12))); // Off the eigenvalue by more than its round-off.
        let mut x = Mat::from_fn(n, 1, |i, _| c64::new(1.0 + (1.7 * i as f64).sin(), 0.0)); // No symmetry hides the mode from it.
        for _ in 0..3 {
            lu.solve_in_place(x.as_mut());
            let length = x.norm_l2();
            (0..n).for_each(|i| x[(i, 0)] /= length);
        }
        let forces = pencil(unit) * &x;
        let sizes = mass.norm_l2() + damping.norm_l2() + stiffness.norm_l2();
        let rate = |i: usize, j: usize| damping[(i, j)] + 2.0 * unit * mass[(i, j)];
        let slope = (x.adjoint() * (Mat::from_fn(n, n, rate) * &x))[(0, 0)]; // x^H (2 lambda M + C) x.

        // Back in the unknowns of the problem, the largest one.
        let own: Vec<c64> = (0..n).map(|i| x[(i, 0)] * columns[i]).collect();
        let longer = |a: c64, b: &c64| if b.norm() > a.norm() { *b } else { a };
        let largest = own.iter().fold(c64::ZERO, longer);
        QuadraticMode {
            eigenvalue,
            residual: forces.norm_l2() / sizes, // |x| = 1, and the shift takes |lambda| out.
            uncertainty: ROUNDING_ERRORS * f64::EPSILON * sizes / slope.norm(),
            vector: own.iter().map(|v| v / largest).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uncoupled oscillators in closed form, their sizes 14 orders apart, one of them overdamped, in badly scaled coordinates.
    #[test]
    fn oscillators_of_sizes_many_orders_apart_keep_all_digits() {
        let frequencies = [1e-6, 3e-4, 2.0, 7e5, 1e8];
        let damping = [0.01, 0.2, 3.0, 0.0, 0.5];
        let diagonal = |entry: &dyn Fn(usize) -> f64| {
            // The same coordinate change on the left and the right of every matrix.
            let scale = |i: usize| 1e3_f64.powi(i as i32 - 2);
            Mat::from_fn(5, 5, |i, j| if i == j { entry(i) * scale(i) } else { 0.0 })
        };
        let mass = diagonal(&|_| 1.0);
        let damper = diagonal(&|i| 2.0 * damping[i] * frequencies[i]);
        let stiffness = diagonal(&|i| frequencies[i] * frequencies[i]);
        let found = quadratic_modes(mass.as_ref(), damper.as_ref(), stiffness.as_ref()).unwrap();
        // Four pairs, of which one of each is listed, and two real eigenvalues.
        assert_eq!(found.len(), 6);
        for (w, d) in frequencies.iter().zip(damping) {
            let root = c64::new(d * d - 1.0, 0.0).sqrt();
            let exact = c64::new(-w * d, 0.0) + root * *w;
            let distance = |mode: &QuadraticMode| (mode.eigenvalue - exact).norm() / exact.norm();
            assert!(found.iter().map(distance).fold(f64::INFINITY, f64::min) < 1e-14);
        }
        let residuals = found.iter().map(|mode| mode.residual);
        assert!(residuals.fold(0.0, f64::max) < 1e-11, "{found:?}");
    }

    #[test]
    fn matrices_that_are_singular_together_are_refused() {
        let zero = Mat::<f64>::zeros(2, 2);
        let one = Mat::from_fn(2, 2, |i, j| f64::from(u8::from(i == 0 && j == 0)));
        let found = quadratic_modes(one.as_ref(), zero.as_ref(), one.as_ref());
        assert!(found.unwrap_err().to_string().contains("singular together"));
    }

    /// Rigid motions and undamped ones of a free frame of springs, and of a chain whose stiffness is singular to the last bit.
    #[test]
    fn rigid_motions_are_no_modes_and_rounding_is_no_growth() {
        let place = |i: usize| [(2.3 * i as f64).sin(), (1.1 * (i * i) as f64).cos()];
        let frame = |i: usize, j: usize| {
            let across = [0, 1].map(|c| place(i)[c] - place(j)[c]);
            let length = across[0].hypot(across[1]);
            across.map(|c| c / length)
        };
        let mut stiffness = Mat::zeros(24, 24);
        for (i, j) in (0..12).flat_map(|i| (0..i).map(move |j| (i, j))) {
            for (a, b) in [(i, i), (j, j), (i, j), (j, i)] {
                for (c, d) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let value = 1e9 * frame(i, j)[c] * frame(i, j)[d];
                    stiffness[(2 * a + c, 2 * b + d)] += if a == b { value } else { -value };
                }
            }
        }
        let chain = Mat::from_fn(12, 12, |i, j| match i.abs_diff(j) {
            0 => {
                if i % 11 == 0 {
                    1e8
                } else {
                    2e8
                }
            }
            1 => -1e8,
            _ => 0.0,
        });
        for (stiffness, rigid) in [(stiffness, 3), (chain, 1)] {
            let n = stiffness.nrows();
            let mass = Mat::from_fn(n, n, |i, j| if i == j { 0.01 } else { 0.0 });
            for beta in [0.0, 1e-7] {
                let damping = Mat::from_fn(n, n, |i, j| beta * stiffness[(i, j)]);
                let found = quadratic_modes(mass.as_ref(), damping.as_ref(), stiffness.as_ref());
                let found = found.unwrap();
                assert_eq!(found.len(), n - rigid, "{beta}");
                assert!(found.iter().all(|mode| mode.eigenvalue.im > 1e3 && !mode.is_unstable()));
            }
        }
    }
}
