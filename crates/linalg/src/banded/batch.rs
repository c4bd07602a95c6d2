//! Several complex banded systems of one shape, solved side by side.

use crate::interruption;
use faer::c64;

/// Systems solved side by side.
pub const LANES: usize = 8;

/// One complex number of each system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes {
    /// Real parts.
    pub re: [f64; LANES],
    /// Imaginary parts.
    pub im: [f64; LANES],
}

impl Lanes {
    /// Zero in every system.
    pub const ZERO: Self = Self { re: [0.0; LANES], im: [0.0; LANES] };

    /// The number `value(lane)` in each system.
    pub fn from_fn(value: impl Fn(usize) -> c64) -> Self {
        let mut result = Self::ZERO;
        for lane in 0..LANES {
            (result.re[lane], result.im[lane]) = (value(lane).re, value(lane).im);
        }
        result
    }

    /// The number of one system.
    #[inline]
    pub fn get(&self, lane: usize) -> c64 {
        c64::new(self.re[lane], self.im[lane])
    }

    /// Adds `factor * value`, the same `value` in each system.
    #[inline]
    pub fn add_scaled(&mut self, factor: &Self, value: c64) {
        for lane in 0..LANES {
            self.re[lane] += factor.re[lane] * value.re;
            self.im[lane] += factor.im[lane] * value.re;
        }
        if value.im != 0.0 {
            for lane in 0..LANES {
                self.re[lane] -= factor.im[lane] * value.im;
                self.im[lane] += factor.re[lane] * value.im;
            }
        }
    }

    #[inline]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        for lane in 0..LANES {
            self.re[lane] -= a.re[lane] * b.re[lane] - a.im[lane] * b.im[lane];
            self.im[lane] -= a.re[lane] * b.im[lane] + a.im[lane] * b.re[lane];
        }
    }

    #[inline]
    fn times(&self, b: &Self) -> Self {
        let mut result = Self::ZERO;
        for lane in 0..LANES {
            result.re[lane] = self.re[lane] * b.re[lane] - self.im[lane] * b.im[lane];
            result.im[lane] = self.re[lane] * b.im[lane] + self.im[lane] * b.re[lane];
        }
        result
    }

    #[inline]
    fn inverse(&self) -> Self {
        let mut result = Self::ZERO;
        for lane in 0..LANES {
            let square = self.re[lane] * self.re[lane] + self.im[lane] * self.im[lane]; // 1 / z = conj(z) / |z|^2.
            result.re[lane] = self.re[lane] / square;
            result.im[lane] = -self.im[lane] / square;
        }
        result
    }

    /// `|re| + |im|` of each system.
    #[inline]
    fn sizes(&self) -> [f64; LANES] {
        std::array::from_fn(|lane| self.re[lane].abs() + self.im[lane].abs())
    }
}

/// [`LANES`] complex banded systems, eliminated together without pivoting.
///
/// Not every matrix allows that: [`BandedBatch::solve`] returns the backward error of each solution,
/// and [`super::BandedLu`] solves what fails.
#[derive(Clone, Debug)]
pub struct BandedBatch {
    dimension: usize,
    half_bandwidth: usize,
    /// Laid out like [`super::BandedMatrix::values`].
    values: Vec<Lanes>,
    /// `U`, its diagonal inverted.
    factors: Vec<Lanes>,
    solution: Vec<Lanes>,
}

/// What a solution of one system is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// `|b - A x| / (|A| |x|)` in the largest norm; not a number if the elimination broke down.
    pub backward_error: f64,
    /// `|A| |x| / |b|`, a lower bound of the condition number.
    pub growth: f64,
}

impl BandedBatch {
    /// Space for the systems.
    pub fn new(dimension: usize, half_bandwidth: usize) -> Self {
        let zeros = vec![Lanes::ZERO; dimension * (2 * half_bandwidth + 1)];
        Self {
            dimension,
            half_bandwidth,
            factors: zeros.clone(),
            values: zeros,
            solution: vec![Lanes::ZERO; dimension],
        }
    }

    /// Sets `A = sum_t factor_t band_t` from bands laid out like [`super::BandedMatrix::values`].
    pub fn assemble(&mut self, terms: &[(Lanes, &[c64])]) {
        for (place, value) in self.values.iter_mut().enumerate() {
            *value = Lanes::ZERO;
            for (factor, band) in terms {
                value.add_scaled(factor, band[place]);
            }
        }
    }

    /// Band of one system.
    pub fn system(&self, lane: usize) -> Vec<c64> {
        self.values.iter().map(|value| value.get(lane)).collect()
    }

    /// Solves `A x = e_unknown` in each system.
    pub fn solve(&mut self, unknown: usize) -> [Quality; LANES] {
        interruption::check();
        self.solution.fill(Lanes::ZERO);
        self.solution[unknown].re = [1.0; LANES]; // The right side, solved in place.
        self.factors.copy_from_slice(&self.values);
        self.eliminate();
        self.substitute();
        self.quality(unknown)
    }

    /// The unknowns that [`Self::solve`] found.
    pub fn solution(&self) -> &[Lanes] {
        &self.solution
    }

    fn eliminate(&mut self) {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let width = 2 * h + 1;
        for k in 0..n {
            let last = (k + h).min(n - 1);
            let columns = last - k;
            let (above, below) = self.factors.split_at_mut((k + 1) * width);
            let top = &mut above[k * width + h..][..=columns];
            top[0] = top[0].inverse(); // row_i -= (a_ik / a_kk) row_k, the right side with it.
            let (known, unknown) = self.solution.split_at_mut(k + 1);
            for i in k + 1..=last {
                let start = (i - k - 1) * width + k + h - i; // Column k of row i stands k + h - i places in.
                let row = &mut below[start..=start + columns];
                let factor = row[0].times(&top[0]);
                for (value, above) in row[1..].iter_mut().zip(&top[1..]) {
                    value.subtract_product(&factor, above);
                }
                unknown[i - k - 1].subtract_product(&factor, &known[k]);
            }
        }
    }

    fn substitute(&mut self) {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let width = 2 * h + 1;
        for k in (0..n).rev() {
            let columns = (k + h).min(n - 1) - k;
            let row = &self.factors[k * width + h..][..=columns];
            let mut sum = self.solution[k]; // x_k = (b_k - sum_j u_kj x_j) / u_kk.
            for (value, known) in row[1..].iter().zip(&self.solution[k + 1..]) {
                sum.subtract_product(value, known);
            }
            self.solution[k] = sum.times(&row[0]);
        }
    }

    fn quality(&self, unknown: usize) -> [Quality; LANES] {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let mut residuals = [0.0; LANES];
        let mut solutions = [0.0; LANES];
        let mut norms = [0.0; LANES];
        for (i, row) in self.values.chunks_exact(2 * h + 1).enumerate() {
            let (first, last) = (i.saturating_sub(h), (i + h).min(n - 1));
            let mut residual = Lanes::ZERO;
            if i == unknown {
                residual.re = [1.0; LANES];
            }
            let mut sum = [0.0; LANES];
            let entries = &row[first + h - i..=last + h - i];
            for (value, x) in entries.iter().zip(&self.solution[first..=last]) {
                residual.subtract_product(value, x); // b - A x, and the row sum of |A|.
                let sizes = value.sizes();
                (0..LANES).for_each(|lane| sum[lane] += sizes[lane]);
            }
            raise(&mut residuals, residual.sizes());
            raise(&mut solutions, self.solution[i].sizes());
            raise(&mut norms, sum);
        }
        std::array::from_fn(|lane| {
            let growth = norms[lane] * solutions[lane]; // |A| |x|, with |b| = 1.
            Quality { backward_error: residuals[lane] / growth, growth }
        })
    }
}

/// Largest value so far; what is not a number stays so.
#[inline]
fn raise(largest: &mut [f64; LANES], sizes: [f64; LANES]) {
    for lane in 0..LANES {
        if sizes[lane] > largest[lane] || sizes[lane].is_nan() {
            largest[lane] = sizes[lane];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::BandedLu;
    use super::*;

    #[test]
    fn systems_side_by_side_have_the_solutions_of_a_pivoting_factorization() {
        let (n, h) = (17, 3);
        let entry = |k: usize| (k as f64 * 0.618_033_988_749_895).fract() - 0.5;
        // Places outside the matrix are zero in a band.
        let band = |seed: usize, diagonal: f64| -> Vec<c64> {
            let place = |k: usize| (k / (2 * h + 1), (k % (2 * h + 1)) as isize - h as isize);
            (0..n * (2 * h + 1))
                .map(|k| {
                    let (row, offset) = place(k);
                    let is_inside = (0..n as isize).contains(&(row as isize + offset));
                    let value = c64::new(entry(seed + 2 * k), entry(seed + 2 * k + 1));
                    let unit = if offset == 0 { diagonal } else { 0.0 };
                    if is_inside { value + unit } else { c64::ZERO }
                })
                .collect()
        };
        let (a, b) = (band(3, 4.0), band(1000, 0.0));
        let factor = Lanes::from_fn(|lane| c64::new(0.1 * lane as f64, 0.3));
        let mut batch = BandedBatch::new(n, h);
        batch.assemble(&[(Lanes::from_fn(|_| c64::ONE), &a), (factor, &b)]);
        let quality = batch.solve(5);
        for lane in 0..LANES {
            let mut lu = BandedLu::new(n, h);
            lu.factorize(&batch.system(lane));
            let mut x = vec![c64::ZERO; n];
            x[5] = c64::ONE;
            lu.solve(&mut x);
            for (found, known) in batch.solution().iter().zip(&x) {
                // Diagonally strong: condition of a few units.
                assert!((found.get(lane) - known).norm() < 1e-14);
            }
            assert!(quality[lane].backward_error < 1e-15);
        }
    }

    #[test]
    fn vanishing_pivot_is_seen_in_the_backward_error() {
        let [zero, one] = [0.0, 1.0].map(|re| c64::new(re, 0.0));
        // [[0, 1], [1, 0]], which needs pivoting.
        let band = [zero, zero, one, one, zero, zero];
        let mut batch = BandedBatch::new(2, 1);
        batch.assemble(&[(Lanes::from_fn(|_| one), &band)]);
        let quality = batch.solve(0);
        assert!(quality.iter().all(|q| q.backward_error.is_nan()));
    }
}
