//! Krylov iteration for quadratic eigenproblems on half-length vectors.

use super::dense::{GrowingColumns, dot, orthonormalize, product};
use super::dense_eigen::{RealEigen, real_eigen};
use super::{LinalgError, interruption};
use faer::{Mat, MatRef, c64};

/// The two blocks `A` and `B` of the operator `S = [A B; I 0]`.
pub trait QuadraticOperator {
    /// Length of the vectors.
    fn dimension(&self) -> usize;
    /// `A x + B y` for each pair of columns.
    fn apply(&self, x: MatRef<'_, f64>, y: MatRef<'_, f64>) -> Mat<f64>;
}

/// Complex eigenpairs of `S`, largest modulus first, one of each conjugate pair.
#[derive(Clone, Debug)]
pub struct QuadraticPairs {
    /// Eigenvalues `s`, `Im(s) > 0`.
    pub values: Vec<c64>,
    /// Upper halves of the vectors, two columns for each value: real and imaginary part.
    pub vectors: Mat<f64>,
    /// Operator applications spent, in vectors.
    pub applications: usize,
}

/// What [`quadratic_krylov`] looks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadraticKrylovSettings {
    /// Conjugate pairs wanted, largest modulus first; eigenvalues that are real or almost so ([`STANDSTILL`]) are not counted.
    pub pairs: usize,
    /// Pairs of these that must have converged when all applications are spent: the others are given as they are then.
    pub least: usize,
    /// Bound on `|S z - s z| / |s z|`.
    pub tolerance: f64,
    /// Operator applications (in vectors) after which the iteration gives up.
    pub max_applications: usize,
    /// `c >= 0` where `1 / s = nu - c` of the `nu` that are sought.
    pub centre: f64,
}

/// `|Im s| / |s|`, which is `|Im lambda| / |lambda|` as well, below which a motion decays without oscillating: its damping factor is
/// above 0.995. Motions beyond critical damping have real eigenvalues only where nothing couples two of them.
pub const STANDSTILL: f64 = 0.1;

/// Whether an eigenvalue, `s` or `lambda = 1 / s`, has a positive imaginary part and is that of a motion that oscillates
/// or grows.
#[inline]
pub fn is_vibration(value: c64) -> bool {
    value.im > 0.0 && (value.re > 0.0 || value.im > STANDSTILL * value.norm())
}

/// Dimension up to which a dense decomposition of the whole operator is as cheap, and misses nothing ...
const SMALL: usize = 200;
/// ... and up to which it stands in for an iteration that does not converge.
const LARGEST_WHOLE: usize = 600;
/// Krylov vectors for each wanted pair before the first look at the projected problem.
const FIRST_LOOK: f64 = 5.0;
/// Krylov vectors from look to look, for each there is: a look costs the cube of their number.
const NEXT_LOOK: f64 = 0.1;
/// Part of a new vector that must lie beyond the known ones.
const INDEPENDENT: f64 = 1e-13;

/// Eigenvalues of largest modulus of `S = [A B; I 0]` among those that oscillate, above [`STANDSTILL`].
///
/// `S z = s z` with `z = (s w, w)` is `s^2 w = s A w + B w`. The Arnoldi vectors `(U a, U b)` share one orthonormal
/// basis `U` of their two halves, which grows by one vector a step: memory and work are half those of an iteration on
/// vectors of full length. There is no restart: the start (columns `x`, `y` of each block) should be rich in the
/// wanted vectors. A single start vector resolves distinct eigenvalues; an eigenvalue of higher multiplicity than
/// there are start vectors is found that often only.
///
/// # Errors
/// [`LinalgError::NotConverged`] after `max_applications` with fewer pairs than `least`; [`LinalgError::DenseEigen`].
///
/// Source: D. Lu, Y. Su, Z. Bai, Stability analysis of the two-level orthogonal Arnoldi procedure, SIAM J. Matrix Anal.
/// Appl. 37 (2016); here in blocks.
pub fn quadratic_krylov(
    operator: &dyn QuadraticOperator,
    start: [MatRef<'_, f64>; 2],
    settings: &QuadraticKrylovSettings,
) -> Result<QuadraticPairs, LinalgError> {
    if operator.dimension() <= SMALL {
        return whole(operator, settings);
    }
    let mut process = TwoLevelArnoldi::new(operator, start);
    let mut next_look = (FIRST_LOOK * settings.pairs as f64) as usize;
    loop {
        interruption::check();
        process.expand();
        let is_spent = process.expanded >= settings.max_applications;
        if process.expanded < next_look && !process.is_exhausted() && !is_spent {
            continue;
        }
        let next = (NEXT_LOOK * process.expanded as f64) as usize;
        next_look = process.expanded + next.max(settings.pairs / 3).max(4);
        let eigen = real_eigen(process.projection().as_ref(), false, 2 * settings.pairs)?;
        let leading = leading_pairs(&eigen.values, settings);
        let residuals = process.residuals(&eigen, &leading);
        let is_converged = |residual: &&f64| **residual <= settings.tolerance;
        let converged = residuals.iter().filter(is_converged).count();
        if converged == settings.pairs || process.is_exhausted() {
            return Ok(process.pairs(&eigen, &leading));
        }
        if is_spent && operator.dimension() <= LARGEST_WHOLE {
            return whole(operator, settings);
        }
        if is_spent && converged >= settings.least {
            return Ok(process.pairs(&eigen, &leading));
        }
        if is_spent {
            return Err(LinalgError::NotConverged {
                converged,
                wanted: settings.pairs,
                tolerance: settings.tolerance,
                applications: process.expanded,
            });
        }
    }
}

/// The pairs by a dense decomposition of `S`.
fn whole(
    operator: &dyn QuadraticOperator,
    settings: &QuadraticKrylovSettings,
) -> Result<QuadraticPairs, LinalgError> {
    let n = operator.dimension();
    let (one, zero) = (Mat::identity(n, n), Mat::zeros(n, n));
    let a = operator.apply(one.as_ref(), zero.as_ref());
    let b = operator.apply(zero.as_ref(), one.as_ref());
    let full = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => a[(i, j)],
        (true, false) => b[(i, j - n)],
        (false, _) => f64::from(i - n == j),
    });
    let eigen = real_eigen(full.as_ref(), false, 2 * settings.pairs)?;
    let leading = leading_pairs(&eigen.values, settings);
    Ok(QuadraticPairs {
        values: leading.iter().map(|&j| eigen.values[j]).collect(),
        vectors: Mat::from_fn(n, 2 * leading.len(), |i, j| {
            eigen.right[(i, leading[j / 2] + j % 2)]
        }),
        applications: 2 * n,
    })
}

/// Columns of the first of each conjugate pair among the `count` pairs of largest modulus that oscillate.
fn leading_pairs(values: &[c64], settings: &QuadraticKrylovSettings) -> Vec<usize> {
    // The reciprocal has the conjugate phase, `s = 1 / (nu - centre)` the sign of `Im(nu)` turned round.
    let oscillates = |s: c64| match settings.centre {
        0.0 => is_vibration(s),
        centre => s.im > 0.0 && is_vibration((s.inv() + centre).conj()),
    };
    let mut columns: Vec<usize> = (0..values.len()).filter(|&i| oscillates(values[i])).collect();
    columns.sort_by(|&i, &j| values[j].norm().total_cmp(&values[i].norm()));
    columns.truncate(settings.pairs);
    columns
}

/// `S Q = Q H + Q' B` with orthonormal `[Q Q']`, `q_j = (U a_j, U b_j)`.
struct TwoLevelArnoldi<'a> {
    operator: &'a dyn QuadraticOperator,
    /// `U`.
    basis: GrowingColumns,
    /// `(a_j, b_j)`, as long as `U` was wide when they were made.
    coordinates: Vec<[Vec<f64>; 2]>,
    /// Columns of `[H; B]`, as long as there were vectors when they were made.
    projected: Vec<Vec<f64>>,
    /// Leading vectors that `S` was applied to.
    expanded: usize,
}

impl<'a> TwoLevelArnoldi<'a> {
    fn new(operator: &'a dyn QuadraticOperator, [x, y]: [MatRef<'_, f64>; 2]) -> Self {
        let count = x.ncols();
        let mut process = Self {
            operator,
            basis: GrowingColumns::new(operator.dimension()),
            coordinates: Vec::new(),
            projected: Vec::new(),
            expanded: 0,
        };
        let tops = process.absorb(x.to_owned());
        let bottoms = process.absorb(y.to_owned());
        for j in 0..count {
            process.append([tops[j].clone(), bottoms[j].clone()]);
        }
        process
    }

    /// Coordinates of vectors in the basis, which takes up what it lacks of them.
    fn absorb(&mut self, vectors: Mat<f64>) -> Vec<Vec<f64>> {
        let found = orthonormalize(self.basis.columns(), vectors, INDEPENDENT);
        self.basis.append(found.columns.as_ref());
        let column = |j: usize| {
            let known = found.against.col(j).iter();
            known.chain(found.within.col(j).iter()).copied().collect()
        };
        (0..found.against.ncols()).map(column).collect()
    }

    /// Orthonormalizes a vector in coordinates against all and appends it, if anything is left of it; its coefficients.
    fn append(&mut self, mut vector: [Vec<f64>; 2]) -> Vec<f64> {
        let length = |v: &[Vec<f64>; 2]| v.iter().map(|half| dot(half, half)).sum::<f64>().sqrt();
        let whole = length(&vector);
        let mut coefficients = vec![0.0; self.coordinates.len()];
        for _ in 0..2 {
            for (coefficient, known) in coefficients.iter_mut().zip(&self.coordinates) {
                let halves = || known.iter().zip(&vector);
                let overlap: f64 = halves().map(|(q, v)| dot(q, &v[..q.len()])).sum();
                *coefficient += overlap;
                for (q, v) in known.iter().zip(&mut vector) {
                    for (v, q) in v.iter_mut().zip(q) {
                        *v -= overlap * q;
                    }
                }
            }
        }
        let rest = length(&vector);
        if rest > INDEPENDENT * whole {
            vector.iter_mut().flatten().for_each(|v| *v /= rest);
            coefficients.push(rest);
            self.coordinates.push(vector);
        }
        coefficients
    }

    /// Whether the vectors span an invariant subspace: nothing is left to expand.
    fn is_exhausted(&self) -> bool {
        self.expanded == self.coordinates.len()
    }

    /// Applies `S` to the vectors that it was not applied to yet.
    fn expand(&mut self) {
        let open = self.expanded..self.coordinates.len();
        let width = self.basis.count();
        // Both halves of each in one product: the basis is read once.
        let count = open.len();
        let own = &self.coordinates[open.clone()];
        let coordinates = Mat::from_fn(width, 2 * count, |i, j| {
            own[j % count][j / count].get(i).copied().unwrap_or(0.0)
        });
        let halves = product(self.basis.columns(), coordinates.as_ref());
        let (x, y) = halves.as_ref().split_at_col(count);
        let image = self.operator.apply(x, y);
        let tops = self.absorb(image);
        for (j, mut top) in open.zip(tops) {
            let width = self.basis.count();
            let mut bottom = self.coordinates[j][0].clone();
            top.resize(width, 0.0);
            bottom.resize(width, 0.0);
            let column = self.append([top, bottom]);
            self.projected.push(column);
            self.expanded += 1;
        }
    }

    /// `H`.
    fn projection(&self) -> Mat<f64> {
        let count = self.expanded;
        Mat::from_fn(count, count, |i, j| self.projected[j].get(i).copied().unwrap_or(0.0))
    }

    /// `|B y| / (|s| |y|)` of the Ritz pairs whose vectors start in these columns.
    fn residuals(&self, eigen: &RealEigen, columns: &[usize]) -> Vec<f64> {
        let count = self.expanded;
        let overflow = |j: usize, row: usize| -> f64 {
            let columns = self.projected.iter().enumerate();
            let entries = columns.filter_map(|(k, column)| Some((k, column.get(row)?)));
            entries.map(|(k, value)| value * eigen.right[(k, j)]).sum()
        };
        let square = |j: usize| -> f64 {
            let rows = count..self.coordinates.len();
            rows.map(|row| overflow(j, row).powi(2)).sum()
        };
        let residual = |&j: &usize| {
            let length =
                eigen.right.col(j).squared_norm_l2() + eigen.right.col(j + 1).squared_norm_l2();
            ((square(j) + square(j + 1)) / length).sqrt() / eigen.values[j].norm()
        };
        columns.iter().map(residual).collect()
    }

    /// The Ritz pairs whose vectors start in these columns.
    fn pairs(&self, eigen: &RealEigen, columns: &[usize]) -> QuadraticPairs {
        let tops = Mat::from_fn(self.basis.count(), self.expanded, |i, j| {
            self.coordinates[j][0].get(i).copied().unwrap_or(0.0)
        });
        let ritz = Mat::from_fn(self.expanded, 2 * columns.len(), |i, j| {
            eigen.right[(i, columns[j / 2] + j % 2)]
        });
        let coordinates = product(tops.as_ref(), ritz.as_ref());
        QuadraticPairs {
            values: columns.iter().map(|&j| eigen.values[j]).collect(),
            vectors: product(self.basis.columns(), coordinates.as_ref()),
            applications: self.expanded,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::random_columns;

    struct Dense([Mat<f64>; 2]);

    impl QuadraticOperator for Dense {
        fn dimension(&self) -> usize {
            self.0[0].nrows()
        }

        fn apply(&self, x: MatRef<'_, f64>, y: MatRef<'_, f64>) -> Mat<f64> {
            product(self.0[0].as_ref(), x) + product(self.0[1].as_ref(), y)
        }
    }

    /// `A` and `B` of a lightly damped unsymmetric problem with frequencies `1, 2, ...`.
    fn oscillators(size: usize) -> Dense {
        let (r, s) = (random_columns(size, size, 3), random_columns(size, size, 4));
        let inertia = |i: usize, j: usize| -f64::from(i == j) / ((1 + i) as f64).powi(2);
        Dense([
            Mat::from_fn(size, size, |i, j| -2e-3 * r[(i, j)] / ((1 + i) * (1 + j)) as f64),
            Mat::from_fn(size, size, |i, j| {
                inertia(i, j) + 1e-2 * s[(i, j)] / ((1 + i) * (1 + j)) as f64
            }),
        ])
    }

    #[test]
    fn leading_pairs_satisfy_the_quadratic_equation_and_agree_with_the_full_matrix() {
        let size = SMALL + 20;
        let operator = oscillators(size);
        let start = [random_columns(size, 1, 1), random_columns(size, 1, 2)];
        let settings = QuadraticKrylovSettings {
            pairs: 8,
            least: 8,
            tolerance: 1e-12,
            max_applications: 2 * size,
            centre: 0.0,
        };
        let found =
            quadratic_krylov(&operator, [start[0].as_ref(), start[1].as_ref()], &settings).unwrap();
        assert!(found.applications < 2 * size);
        let full = Mat::from_fn(2 * size, 2 * size, |i, j| match (i < size, j < size) {
            (true, true) => operator.0[0][(i, j)],
            (true, false) => operator.0[1][(i, j - size)],
            (false, _) => f64::from(i - size == j),
        });
        let all = real_eigen(full.as_ref(), false, usize::MAX).unwrap();
        let exact = leading_pairs(&all.values, &settings);
        for (k, &column) in exact.iter().enumerate() {
            let s = found.values[k];
            assert!((s - all.values[column]).norm() < 1e-10 * s.norm());
            let w = |i: usize| c64::new(found.vectors[(i, 2 * k)], found.vectors[(i, 2 * k + 1)]);
            let (mut error, mut length) = (0.0, 0.0);
            for i in 0..size {
                let a: c64 = (0..size).map(|j| w(j) * operator.0[0][(i, j)]).sum();
                let b: c64 = (0..size).map(|j| w(j) * operator.0[1][(i, j)]).sum();
                error += (s * s * w(i) - s * a - b).norm_sqr();
                length += (s * s * w(i)).norm_sqr();
            }
            assert!(error < 1e-18 * length, "{k}: {}", (error / length).sqrt());
        }
    }

    #[test]
    fn growth_that_hardly_oscillates_is_sought_all_the_same() {
        let [decay, growth] = [-1.0, 1.0].map(|re| c64::new(re, 0.03));
        assert!(!is_vibration(decay) && is_vibration(growth));
        assert!(!is_vibration(growth.conj()) && is_vibration(c64::new(-1.0, 0.2)));
    }

    /// Exact: motions of large `|s|` that decay without oscillating, `|Im s| / |s| = 0.03`, take no places of those that oscillate.
    #[test]
    fn decay_that_hardly_oscillates_takes_no_place() {
        for size in [SMALL, SMALL + 20] {
            let mut operator = oscillators(size);
            let settings = QuadraticKrylovSettings {
                pairs: 8,
                least: 8,
                tolerance: 1e-12,
                max_applications: 4 * size,
                centre: 0.0,
            };
            // Decoupled: s^2 - 2 p s + p^2 + q^2 = 0.
            for i in size - 4..size {
                for j in 0..size {
                    for half in &mut operator.0 {
                        half[(i, j)] = 0.0;
                        half[(j, i)] = 0.0;
                    }
                }
                let p = -5.0 - (size - i) as f64;
                operator.0[0][(i, i)] = 2.0 * p;
                operator.0[1][(i, i)] = -p * p * (1.0 + 0.03 * 0.03);
            }
            let start = [random_columns(size, 1, 1), random_columns(size, 1, 2)];
            let start = [start[0].as_ref(), start[1].as_ref()];
            let found = quadratic_krylov(&operator, start, &settings).unwrap();
            assert_eq!(found.values.len(), 8);
            for (k, s) in found.values.iter().enumerate() {
                // Of the oscillators 1, 2, ... the first eight, coupled to a hundredth.
                assert!((s.norm().recip() - (k + 1) as f64).abs() < 0.2, "{s}");
            }
        }
    }

    /// Exact: with its applications spent an iteration gives what it has if enough of it converged, else an error.
    #[test]
    fn spent_iteration_gives_the_pairs_it_has_where_that_is_allowed() {
        let size = LARGEST_WHOLE + 20;
        let operator = oscillators(size);
        let start = [random_columns(size, 1, 1), random_columns(size, 1, 2)];
        let start = [start[0].as_ref(), start[1].as_ref()];
        let settings = |least: usize| QuadraticKrylovSettings {
            pairs: 8,
            least,
            tolerance: 1e-6,
            max_applications: 24,
            centre: 0.0,
        };
        let found = quadratic_krylov(&operator, start, &settings(2)).unwrap();
        assert_eq!((found.values.len(), found.applications), (8, 24));
        let Err(LinalgError::NotConverged { converged, .. }) =
            quadratic_krylov(&operator, start, &settings(8))
        else {
            panic!("eight pairs cannot converge in 24 applications");
        };
        assert!((2..8).contains(&converged), "{converged}");
    }

    #[test]
    fn invariant_subspace_ends_the_iteration_with_what_there_is() {
        let operator = oscillators(3);
        let start = [random_columns(3, 1, 1), random_columns(3, 1, 2)];
        let settings = QuadraticKrylovSettings {
            pairs: 8,
            least: 8,
            tolerance: 1e-12,
            max_applications: 100,
            centre: 0.0,
        };
        let found =
            quadratic_krylov(&operator, [start[0].as_ref(), start[1].as_ref()], &settings).unwrap();
        assert_eq!(found.values.len(), 3);
    }
}
