//! `L D L^H` of Hermitian banded matrices, row by row over contiguous rows.

use super::BandedMatrix;
use crate::dense::product_sum;
use crate::interruption;
use faer::traits::ComplexField;

/// `L D L^H` factorization without pivoting of a Hermitian banded matrix: each pivot is taken out of the rows below it, whose entries
/// lie next to each other.
///
/// The signs of `D` are those of the eigenvalues (Sylvester's law of inertia). Without pivoting the factorization of an indefinite
/// matrix can lose accuracy near a singular leading block; counts are to be confirmed by eigenpairs where they matter.
#[derive(Clone, Debug)]
pub struct BandedFactor<T = f64> {
    dimension: usize,
    half_bandwidth: usize,
    /// `D` and `L^H` row by row, columns `i ..= i + h`.
    upper: Vec<T>,
}

impl BandedFactor {
    /// Factorizes the symmetric matrix `a - shift b`; only upper triangles are read.
    ///
    /// # Panics
    /// If the shapes differ.
    pub fn new(a: &BandedMatrix, b: &BandedMatrix, shift: f64) -> Self {
        let (n, h) = (a.dimension, a.half_bandwidth);
        assert_eq!((b.dimension, b.half_bandwidth), (n, h));
        let mut upper = vec![0.0; n * (h + 1)];
        for (i, row) in upper.chunks_exact_mut(h + 1).enumerate() {
            let terms = a.row(i)[h..].iter().zip(&b.row(i)[h..]);
            row.iter_mut().zip(terms).for_each(|(value, (a, b))| *value = a - shift * b);
        }
        Self::of(h, upper)
    }
}

impl<T: ComplexField<Real = f64> + Copy> BandedFactor<T> {
    /// Factorizes the matrix with this upper triangle: row by row, columns `i ..= i + h`, places outside the matrix zero.
    pub fn of(half_bandwidth: usize, mut upper: Vec<T>) -> Self {
        interruption::check();
        let (h, width) = (half_bandwidth, half_bandwidth + 1);
        let n = upper.len() / width;
        for k in 0..n {
            let (done, below) = upper.split_at_mut((k + 1) * width);
            let top = &mut done[k * width..];
            let mut pivot = T::real_part_impl(&top[0]);
            // A zero pivot is one rounding error away from either sign.
            if pivot == 0.0 {
                pivot = f64::MIN_POSITIVE;
            }
            top[0] = T::from_real_impl(&pivot);
            let inverse = T::from_real_impl(&(1.0 / pivot)); // a_ij -= conj(a_ki) a_kj / d_k.
            let last = h.min(n - 1 - k);
            for (i, row) in below.chunks_exact_mut(width).take(last).enumerate() {
                let factor = T::conj_impl(&top[i + 1]) * inverse;
                if factor != T::zero_impl() {
                    let pairs = row.iter_mut().zip(&top[i + 1..=last]);
                    pairs.for_each(|(value, above)| *value -= factor * *above);
                }
            }
            top[1..=last].iter_mut().for_each(|value| *value *= inverse); // Row k of L^H: a_kj / d_k.
        }
        Self { dimension: n, half_bandwidth: h, upper }
    }

    fn pivots(&self) -> impl Iterator<Item = f64> + '_ {
        self.upper.iter().step_by(self.half_bandwidth + 1).map(T::real_part_impl)
    }

    /// Number of negative eigenvalues.
    pub fn negative_count(&self) -> usize {
        self.pivots().filter(|d| *d < 0.0).count()
    }

    /// Whether all eigenvalues are positive; a pivot of zero, which stands as the least positive one, is none.
    pub fn is_definite(&self) -> bool {
        self.pivots().all(|d| d > f64::MIN_POSITIVE)
    }

    /// Whether no pivot overflowed or vanished beside the largest, but for rounding.
    pub fn is_regular(&self) -> bool {
        let largest = self.pivots().fold(0.0_f64, |m, d| m.max(d.abs()));
        largest.is_finite() && self.pivots().all(|d| d.abs() > 1e-15 * largest)
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [T]) {
        let (n, width) = (self.dimension, self.half_bandwidth + 1);
        for k in 0..n {
            let row = &self.upper[k * width..][..width.min(n - k)];
            let (value, rest) = x[k..].split_first_mut().expect("a row for each unknown");
            let known = *value; // L y = b, then D: each y_k out of the rows below it.
            row[1..].iter().zip(rest).for_each(|(l, x)| *x -= T::conj_impl(l) * known);
            *value = known * T::from_real_impl(&(1.0 / T::real_part_impl(&row[0])));
        }
        for k in (0..n).rev() {
            let row = &self.upper[k * width..][..width.min(n - k)];
            x[k] -= product_sum(&row[1..], &x[k + 1..k + row.len()], |l, x| l * x); // L^H x = y.
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::c64;

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

    /// Exact: a Hermitian matrix `A = B B^H + 1` with the solution known; its opposite has as many negative eigenvalues as rows.
    #[test]
    fn hermitian_matrices_have_solutions_and_an_inertia() {
        let (n, h) = (30, 2);
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => c64::new(3.0 + (i as f64).sin(), 0.0),
            apart if apart <= h => {
                let phase = c64::cis(1.7 * i.min(j) as f64 + apart as f64);
                0.6 * if i < j { phase } else { phase.conj() }
            }
            _ => c64::ZERO,
        };
        let upper = |sign: f64| -> Vec<c64> {
            let row = |i: usize| {
                (i..=i + h).map(move |j| if j < n { sign * entry(i, j) } else { c64::ZERO })
            };
            (0..n).flat_map(row).collect()
        };
        let factor = BandedFactor::of(h, upper(1.0));
        assert!(factor.is_definite() && factor.negative_count() == 0);
        assert_eq!(BandedFactor::of(h, upper(-1.0)).negative_count(), n);
        assert!(!BandedFactor::of(0, vec![c64::ONE, c64::ZERO]).is_definite());
        let x: Vec<c64> = (0..n).map(|i| c64::cis(i as f64)).collect();
        let mut right: Vec<c64> =
            (0..n).map(|i| (0..n).map(|j| entry(i, j) * x[j]).sum()).collect();
        factor.solve(&mut right);
        assert!(right.iter().zip(&x).all(|(r, v)| (r - v).norm() < 1e-13));
    }
}
