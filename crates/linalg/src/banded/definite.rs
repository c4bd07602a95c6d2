//! `L D L^T` of symmetric banded matrices, row by row over contiguous rows.

use super::BandedMatrix;
use crate::interruption;

/// `L D L^T` factorization without pivoting of a symmetric banded matrix `a - shift b`: each pivot is taken out of the rows below
/// it, whose entries lie next to each other.
///
/// The signs of `D` are those of the eigenvalues (Sylvester's law of inertia). Without pivoting the factorization of an indefinite
/// matrix can lose accuracy near a singular leading block; counts are to be confirmed by eigenpairs where they matter.
#[derive(Clone, Debug)]
pub struct BandedFactor {
    dimension: usize,
    half_bandwidth: usize,
    /// `D` and `L^T` row by row, columns `i ..= i + h`.
    upper: Vec<f64>,
}

impl BandedFactor {
    /// Factorizes `a - shift b`; only upper triangles are read.
    ///
    /// # Panics
    /// If the shapes differ.
    pub fn new(a: &BandedMatrix, b: &BandedMatrix, shift: f64) -> Self {
        interruption::check();
        let (n, h) = (a.dimension, a.half_bandwidth);
        assert_eq!((b.dimension, b.half_bandwidth), (n, h));
        let width = h + 1;
        let mut upper = vec![0.0; n * width];
        for (i, row) in upper.chunks_exact_mut(width).enumerate() {
            let terms = a.row(i)[h..].iter().zip(&b.row(i)[h..]);
            row.iter_mut().zip(terms).for_each(|(value, (a, b))| *value = a - shift * b);
        }
        for k in 0..n {
            let (done, below) = upper.split_at_mut((k + 1) * width);
            let top = &mut done[k * width..];
            // A zero pivot is one rounding error away from either sign.
            if top[0] == 0.0 {
                top[0] = f64::MIN_POSITIVE;
            }
            let inverse = 1.0 / top[0];
            let last = h.min(n - 1 - k);
            for (i, row) in below.chunks_exact_mut(width).take(last).enumerate() {
                let factor = top[i + 1] * inverse;
                if factor != 0.0 {
                    let pairs = row.iter_mut().zip(&top[i + 1..=last]);
                    pairs.for_each(|(value, above)| *value -= factor * above);
                }
            }
            top[1..=last].iter_mut().for_each(|value| *value *= inverse);
        }
        Self { dimension: n, half_bandwidth: h, upper }
    }

    fn pivots(&self) -> impl Iterator<Item = f64> + '_ {
        self.upper.iter().step_by(self.half_bandwidth + 1).copied()
    }

    /// Number of negative eigenvalues.
    #[inline]
    pub fn negative_count(&self) -> usize {
        self.pivots().filter(|d| *d < 0.0).count()
    }

    /// Whether no pivot overflowed or vanished beside the largest, but for rounding.
    #[inline]
    pub fn is_regular(&self) -> bool {
        let largest = self.pivots().fold(0.0_f64, |m, d| m.max(d.abs()));
        largest.is_finite() && self.pivots().all(|d| d.abs() > 1e-15 * largest)
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let (n, width) = (self.dimension, self.half_bandwidth + 1);
        for k in 0..n {
            let row = &self.upper[k * width..][..width.min(n - k)];
            let (value, rest) = x[k..].split_first_mut().expect("a row for each unknown");
            let known = *value;
            row[1..].iter().zip(rest).for_each(|(l, x)| *x -= l * known);
            *value /= row[0];
        }
        for k in (0..n).rev() {
            let row = &self.upper[k * width..][..width.min(n - k)];
            let sum = crate::dense::dot(&row[1..], &x[k + 1..k + row.len()]);
            x[k] -= sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertia_counts_the_eigenvalues_below_a_shift() {
        // Second differences: eigenvalues 2 - 2 cos(k pi / (n + 1)).
        let n = 40;
        let (mut a, mut b) = (BandedMatrix::zeros(n, 2), BandedMatrix::zeros(n, 2));
        for i in 0..n {
            a.add(i, i, 2.0);
            b.add(i, i, 1.0);
            if i > 0 {
                a.add(i, i - 1, -1.0);
                a.add(i - 1, i, -1.0);
            }
        }
        for shift in [0.001, 0.3, 1.7, 3.99] {
            let exact = (1..=n)
                .map(|k| 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / (n as f64 + 1.0)).cos())
                .filter(|value| *value < shift)
                .count();
            let factor = BandedFactor::new(&a, &b, shift);
            assert_eq!(factor.negative_count(), exact);
            let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
            let mut right = a.multiply(&x);
            for (r, v) in right.iter_mut().zip(&x) {
                *r -= shift * v;
            }
            factor.solve(&mut right);
            assert!(right.iter().zip(&x).all(|(r, v)| (r - v).abs() < 1e-9));
        }
    }
}
