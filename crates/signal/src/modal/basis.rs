//! A frequency response as a sum of modes and a smooth remainder.

use super::NoiseModel;
use crate::{FrequencyResponse, ResponseQuantity};
use faer::{Mat, c64};

/// Lowest power of `s` in the remainder: damped rigid-body motion, `1/(s^2 + alpha s)`, expanded.
const LOWEST_POWER: i32 = -3;

/// An underdamped pole pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Damping factor.
    pub damping_factor: f64,
}

impl Pole {
    /// Width of the half-power band, Hz.
    pub fn bandwidth_hz(&self) -> f64 {
        2.0 * self.damping_factor * self.frequency_hz
    }
}

/// A modal model of one or more responses that share their poles:
/// `H(s) = s^p [ sum_k (a_k + b_k s) / (s^2 + 2 zeta_k u_k s + u_k^2) + sum_m c_m s^m ]` with
/// `s = i f / f_ref`, `u_k = f_k / f_ref` and real `a, b, c`: every response of a real linear system,
/// its out-of-band modes expanded; `p = 0, 1, 2` for receptance, mobility, accelerance.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalModel {
    /// Poles.
    pub poles: Vec<Pole>,
    /// What each response has of its own.
    pub shares: Vec<ModalShare>,
    /// `f_ref`, Hz.
    pub reference_hz: f64,
}

/// What one response has of its own in a [`ModalModel`].
#[derive(Clone, Debug, PartialEq)]
pub struct ModalShare {
    /// Quantity of the response.
    pub quantity: ResponseQuantity,
    /// `[a_k, b_k]` of each pole.
    pub numerators: Vec<[f64; 2]>,
    /// `c_m`, `m = -3, -2, ...`.
    pub remainder: Vec<f64>,
}

impl ModalModel {
    /// Response number `share` at a frequency above zero, Hz.
    pub fn evaluate(&self, share: usize, frequency_hz: f64) -> c64 {
        let share = &self.shares[share];
        let s = c64::new(0.0, frequency_hz / self.reference_hz);
        let mut sum = c64::new(0.0, 0.0);
        for c in share.remainder.iter().rev() {
            sum = sum * s + *c;
        }
        sum *= s.powi(LOWEST_POWER);
        for (pole, [a, b]) in self.poles.iter().zip(&share.numerators) {
            let u = pole.frequency_hz / self.reference_hz;
            sum += (s * *b + *a) / (s * s + s * (2.0 * pole.damping_factor * u) + u * u);
        }
        s.powi(share.quantity.derivatives()) * sum
    }
}

/// The frequency lines of a response with their weights, at which the functions of a model are needed.
pub(super) struct Lines<'a> {
    pub response: &'a FrequencyResponse,
    /// `1 / sigma` of one real component, for each line.
    pub weights: Vec<f64>,
    /// `f / f_ref`.
    x: Vec<f64>,
    /// `s^p` times the weight.
    factor: Vec<c64>,
    pub reference_hz: f64,
}

/// Fills a complex column of a real matrix: real parts above, imaginary parts below.
pub(super) fn fill(matrix: &mut Mat<f64>, k: usize, values: impl Iterator<Item = c64>) {
    let half = matrix.nrows() / 2;
    let (re, im) = matrix.col_as_slice_mut(k).split_at_mut(half);
    for ((re, im), value) in re.iter_mut().zip(im).zip(values) {
        (*re, *im) = (value.re, value.im);
    }
}

impl<'a> Lines<'a> {
    /// Weights from a noise model and the moduli (the data's own, or a model's), and from what is known of each line.
    pub(super) fn new(
        response: &'a FrequencyResponse,
        noise: &NoiseModel,
        moduli: &[f64],
        reference_hz: f64,
    ) -> Self {
        let weight = |(m, factor): (&f64, &f64)| 1.0 / (noise.variance(*m) * factor).sqrt();
        let weights: Vec<f64> =
            moduli.iter().zip(response.variance_factors()).map(weight).collect();
        let x: Vec<f64> = response.frequencies_hz().iter().map(|f| f / reference_hz).collect();
        let power = |x: &f64| c64::new(0.0, *x).powi(response.quantity().derivatives());
        let factor = x.iter().zip(&weights).map(|(x, w)| power(x) * *w).collect();
        Self { response, weights, x, factor, reference_hz }
    }

    /// Scaled frequency and scaled damping `(u, 2 zeta u)`.
    fn parts(&self, pole: Pole) -> (f64, f64) {
        let u = pole.frequency_hz / self.reference_hz;
        (u, 2.0 * pole.damping_factor * u)
    }

    /// Weighted functions in which the model is linear: two columns for each pole, then the
    /// remainder, from column `first` on.
    pub(super) fn fill_linear(
        &self,
        poles: &[Pole],
        remainder: usize,
        first: usize,
        matrix: &mut Mat<f64>,
    ) {
        for (k, pole) in poles.iter().enumerate() {
            let (u, d) = self.parts(*pole);
            let lines = self.x.iter().zip(&self.factor);
            let values = lines.map(|(x, factor)| factor * inverse(*x, u, d));
            fill(matrix, first + 2 * k, values);
            self.fill_times_s(first + 2 * k, matrix);
        }
        let from = first + 2 * poles.len();
        if remainder > 0 {
            let lines = self.x.iter().zip(&self.factor);
            let values = lines.map(|(x, factor)| factor * c64::new(0.0, *x).powi(LOWEST_POWER));
            fill(matrix, from, values);
        }
        for m in 1..remainder {
            self.fill_times_s(from + m - 1, matrix);
        }
    }

    /// Column `k + 1` becomes `s` times column `k`.
    fn fill_times_s(&self, k: usize, matrix: &mut Mat<f64>) {
        let half = matrix.nrows() / 2;
        for (i, x) in self.x.iter().enumerate() {
            let (re, im) = (matrix[(i, k)], matrix[(half + i, k)]);
            matrix[(i, k + 1)] = -im * x;
            matrix[(half + i, k + 1)] = re * x;
        }
    }

    /// Weighted derivatives of the model with respect to `ln f_k` and `ln zeta_k`: two columns for
    /// each pole from column 0 on.
    pub(super) fn fill_pole_derivatives(
        &self,
        poles: &[Pole],
        share: &ModalShare,
        matrix: &mut Mat<f64>,
    ) {
        for (k, (pole, [a, b])) in poles.iter().zip(&share.numerators).enumerate() {
            let (u, d) = self.parts(*pole);
            let lines = self.x.iter().zip(&self.factor);
            let by_damping = lines.map(|(&x, factor)| {
                let inverse = inverse(x, u, d);
                let slope = -(factor * c64::new(*a, b * x) * inverse * inverse);
                slope * c64::new(0.0, d * x)
            });
            fill(matrix, 2 * k + 1, by_damping);
            // The derivative in frequency is slope (2 u^2 + i d x); the slope is recovered from the
            // column above instead of divided for again.
            let half = matrix.nrows() / 2;
            for (i, x) in self.x.iter().enumerate() {
                let ratio = 2.0 * u * u / (d * x);
                let (re, im) = (matrix[(i, 2 * k + 1)], matrix[(half + i, 2 * k + 1)]);
                matrix[(i, 2 * k)] = re + ratio * im;
                matrix[(half + i, 2 * k)] = im - ratio * re;
            }
        }
    }

    /// The model on every line.
    pub(super) fn values(&self, poles: &[Pole], share: &ModalShare) -> Vec<c64> {
        let mut sums = vec![c64::new(0.0, 0.0); self.x.len()];
        for (k, x) in self.x.iter().enumerate() {
            // Horner over i x, then (i x)^-3 = i / x^3.
            let mut sum = c64::new(0.0, 0.0);
            for c in share.remainder.iter().rev() {
                sum = c64::new(c - x * sum.im, x * sum.re);
            }
            let cube = 1.0 / (x * x * x);
            sums[k] = c64::new(-sum.im * cube, sum.re * cube);
        }
        for (pole, [a, b]) in poles.iter().zip(&share.numerators) {
            let (u, d) = self.parts(*pole);
            for (sum, x) in sums.iter_mut().zip(&self.x) {
                *sum += c64::new(*a, b * x) * inverse(*x, u, d);
            }
        }
        let factors = self.factor.iter().zip(&self.weights);
        sums.iter().zip(factors).map(|(sum, (factor, weight))| sum * factor / *weight).collect()
    }

    /// Squared length of the projection of a weighted residual on the two functions of a pole,
    /// over the lines within `reach` bandwidths.
    pub(super) fn projection(&self, residual: &[c64], pole: Pole, reach: f64) -> f64 {
        let (u, d) = self.parts(pole);
        let first = self.x.partition_point(|x| *x < u - reach * d);
        let last = self.x.partition_point(|x| *x <= u + reach * d);
        let (mut gg, mut hh, mut gr, mut hr) = (0.0, 0.0, 0.0, 0.0);
        let lines = self.x[first..last].iter().zip(&self.factor[first..last]);
        for ((x, factor), r) in lines.zip(&residual[first..last]) {
            let g = factor * inverse(*x, u, d);
            // The second function is s g: g turned by a right angle and stretched by x, hence orthogonal to it.
            gg += g.norm_sqr();
            hh += g.norm_sqr() * x * x;
            gr += g.re * r.re + g.im * r.im;
            hr += x * (g.re * r.im - g.im * r.re);
        }
        if gg > 0.0 { gr * gr / gg + hr * hr / hh } else { 0.0 }
    }
}

/// `1 / (s^2 + d s + u^2)` at `s = i x`.
fn inverse(x: f64, u: f64, d: f64) -> c64 {
    let (re, im) = (u * u - x * x, d * x);
    let norm = re * re + im * im;
    c64::new(re / norm, -im / norm)
}
