//! Krylov spaces in which many lines are solved at once.

use crate::linalg::dense::{dot, orthogonalize};
use crate::linalg::{ComplexDenseLu, ComplexField, Mat, c64};

/// Relative residual of the projected systems at which the space is large enough.
const RESIDUAL: f64 = 1e-15;
/// Vectors between two looks at the residuals.
const STRIDE: usize = 6;

/// Real or complex entries of vectors.
pub(super) trait Entry: ComplexField<Real = f64> + Copy + Into<c64> {
    /// Most vectors of a space: about what complex factorizations of all its lines cost.
    const MOST_VECTORS: usize;
}

impl Entry for f64 {
    const MOST_VECTORS: usize = 72;
}

impl Entry for c64 {
    const MOST_VECTORS: usize = 42;
}

/// The space `g, B g, B^2 g, ...` for systems `(1 - d B) x = g` with many `d`.
pub(super) struct KrylovSpace<T> {
    /// Orthonormal vectors, one more than [`Self::images`].
    vectors: Vec<Vec<T>>,
    /// Column `k`: coefficients of `B v_k` in the vectors.
    images: Vec<Vec<c64>>,
    /// `|g|`.
    length: f64,
}

impl<T: Entry> KrylovSpace<T> {
    /// The space of `g` alone.
    pub fn new(start: Vec<T>) -> Self {
        let length = norm(&start);
        Self { vectors: vec![scaled(start, 1.0 / length)], images: Vec::new(), length }
    }

    /// Coordinates of the solution at each distance `d`.
    ///
    /// The space grows by `multiply`, `v -> B v`, until all residuals are those of round-off, it is
    /// complete, or it has [`Entry::MOST_VECTORS`]: the caller looks what the solutions are worth.
    pub fn solve(&mut self, distances: &[c64], multiply: impl Fn(&[T]) -> Vec<T>) -> Vec<Vec<c64>> {
        loop {
            let is_closed = (0..STRIDE).any(|_| {
                let image = multiply(&self.vectors[self.vectors.len() - 1]);
                !self.extend(image)
            });
            let (solved, residuals): (Vec<_>, Vec<f64>) =
                distances.iter().map(|d| self.project(*d)).unzip();
            let is_enough = residuals.iter().all(|residual| *residual <= RESIDUAL);
            if is_closed || is_enough || self.images.len() >= T::MOST_VECTORS {
                return solved;
            }
        }
    }

    /// The first `count` entries of the vector of these coordinates.
    pub fn combined(&self, coordinates: &[c64], count: usize) -> Vec<c64> {
        let mut sum = vec![c64::ZERO; count];
        for (coordinate, vector) in coordinates.iter().zip(&self.vectors) {
            sum.iter_mut().zip(vector).for_each(|(sum, b)| *sum += (*b).into() * coordinate);
        }
        sum
    }

    /// One more vector, from the image of the last; `false` if the space is complete.
    fn extend(&mut self, mut image: Vec<T>) -> bool {
        let before = norm(&image);
        let shares = orthogonalize(&mut image, &self.vectors);
        let mut coefficients: Vec<c64> = shares.into_iter().map(Into::into).collect();
        let left = norm(&image);
        let is_new = left > f64::EPSILON * before;
        coefficients.push(c64::new(if is_new { left } else { 0.0 }, 0.0));
        self.images.push(coefficients);
        if is_new {
            self.vectors.push(scaled(image, 1.0 / left));
        }
        is_new
    }

    /// Coordinates of the Galerkin solution of `(1 - distance B) x = g`, and its relative residual.
    fn project(&self, distance: c64) -> (Vec<c64>, f64) {
        let m = self.images.len();
        let matrix = Mat::<c64>::from_fn(m, m, |i, j| {
            let image = self.images[j].get(i).copied().unwrap_or(c64::ZERO);
            let unit = if i == j { 1.0 } else { 0.0 };
            c64::new(unit, 0.0) - distance * image
        });
        let mut y =
            Mat::from_fn(m, 1, |i, _| c64::new(if i == 0 { self.length } else { 0.0 }, 0.0));
        ComplexDenseLu::factorize(matrix).solve_in_place(y.as_mut());
        let y: Vec<c64> = (0..m).map(|i| y[(i, 0)]).collect();
        let size = y.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
        let next = self.images[m - 1][m];
        let residual = (distance * next * y[m - 1]).norm() / size;
        (y, residual)
    }
}

fn norm<T: Entry>(a: &[T]) -> f64 {
    T::real_part_impl(&dot(a, a)).sqrt()
}

fn scaled<T: Entry>(mut a: Vec<T>, factor: f64) -> Vec<T> {
    a.iter_mut().for_each(|value| *value = T::mul_real_impl(value, &factor));
    a
}
