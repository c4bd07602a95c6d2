//! `L D L^T` of symmetric banded matrices, row by row over contiguous rows.

use super::BandedMatrix;
use crate::interruption;

/// `L D L^T` factorization without pivoting of `a - shift b`, for bands too wide for [`super::BandedLdl`].
///
/// The same factors, computed from the other side: each pivot is taken out of the rows below it, whose entries lie next to
/// each other.
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
    use super::super::BandedLdl;
    use super::*;

    #[test]
    fn factors_agree_with_those_taken_row_by_row() {
        let (n, h) = (37, 6);
        let (mut a, mut b) = (BandedMatrix::zeros(n, h), BandedMatrix::zeros(n, h));
        for i in 0..n {
            for j in i..(i + h + 1).min(n) {
                let value = ((i * 31 + j * 17) as f64).sin() + if i == j { 5.0 } else { 0.0 };
                a.add(i, j, value);
                b.add(i, j, 0.1 * value * value);
                if i != j {
                    a.add(j, i, value);
                    b.add(j, i, 0.1 * value * value);
                }
            }
        }
        for shift in [0.0, 1.3, 4.0] {
            let (one, other) = (BandedFactor::new(&a, &b, shift), BandedLdl::new(&a, &b, shift));
            assert_eq!(one.negative_count(), other.negative_count());
            let right: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
            let (mut x, mut y) = (right.clone(), right);
            one.solve(&mut x);
            other.solve(&mut y);
            let size = y.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            // Indefinite without pivoting: a few digits lost.
            assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-10 * size));
        }
    }
}
