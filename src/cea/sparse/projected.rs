//! The projected matrices at one friction coefficient, and single modes of them.

use super::mode::ReducedMode;
use crate::fem::own_frequency_step;
use crate::linalg::dense::{column, column_mut, product, transpose_product};
use crate::linalg::{ComplexDenseLu, Mat, Scale, c64};
use crate::prestress::TabledGain;
use std::f64::consts::TAU;

/// Rayleigh quotients after which a mode counts as not found; three or four do.
const QUOTIENT_STEPS: usize = 8;
/// Relative change of the eigenvalue that ends the iteration: its error is about the cube of that.
const QUOTIENT_TOLERANCE: f64 = 1e-8;

/// `K`, `C` and `M` (or their derivatives) projected, at one friction coefficient.
pub struct ProjectedMatrices {
    /// `V^T K V`.
    pub stiffness: Mat<f64>,
    /// `V^T C V`.
    pub damping: Mat<f64>,
    /// `V^T M V`.
    pub mass: Mat<f64>,
    /// `V^T H V` of structural damping.
    pub structural: Option<Mat<f64>>,
    /// `V^T K_p V` of parts whose stiffness depends on frequency.
    pub tabled: Vec<(TabledGain, Mat<f64>)>,
}

impl ProjectedMatrices {
    /// The matrices projected once more, on orthonormal `columns` of coordinates.
    pub fn within(&self, columns: &Mat<f64>) -> Self {
        let within = |p: &Mat<f64>| {
            let image = product(p.as_ref(), columns.as_ref());
            transpose_product(columns.as_ref(), image.as_ref())
        };
        let [stiffness, damping, mass] = [&self.stiffness, &self.damping, &self.mass].map(within);
        Self {
            stiffness,
            damping,
            mass,
            structural: self.structural.as_ref().map(within),
            tabled: self.tabled.iter().map(|(gain, k)| (gain.clone(), within(k))).collect(),
        }
    }

    /// `T(lambda) = lambda^2 M + lambda C + K + i H + sum_p g_p K_p`, `Im lambda > 0`, the last at the frequency of `lambda`.
    pub fn pencil(&self, lambda: c64) -> Mat<c64> {
        let m = self.mass.nrows();
        let mut pencil = Mat::from_fn(m, m, |i, j| {
            let lost = self.structural.as_ref().map_or(0.0, |h| h[(i, j)]);
            lambda * (lambda * self.mass[(i, j)] + self.damping[(i, j)])
                + c64::new(self.stiffness[(i, j)], lost)
        });
        for (gain, stiffness) in &self.tabled {
            let factor = gain.at(lambda);
            for j in 0..m {
                let entries = pencil.col_mut(j).iter_mut();
                let entries = entries.zip(stiffness.col(j).iter());
                entries.for_each(|(t, k)| *t += factor * *k);
            }
        }
        pencil
    }

    /// The same with the stiffness that tables give at one frequency, as structural damping and stiffness of a problem without.
    pub fn frozen(&self, frequency_hz: f64) -> Self {
        let lambda = c64::new(0.0, TAU * frequency_hz);
        let m = self.mass.nrows();
        let mut stiffness = self.stiffness.clone();
        let lost = self.structural.clone();
        let mut structural = lost.unwrap_or_else(|| Mat::zeros(m, m));
        for (gain, own) in &self.tabled {
            let factor = gain.at(lambda);
            stiffness += Scale(factor.re) * own;
            structural += Scale(factor.im) * own;
        }
        Self {
            stiffness,
            damping: self.damping.clone(),
            mass: self.mass.clone(),
            structural: Some(structural),
            tabled: Vec::new(),
        }
    }

    /// The mode near `guess`, by two-sided Rayleigh quotient iteration from its eigenvalue and vectors, without derivative and
    /// scale; nothing where that does not settle.
    ///
    /// Source: K. Schreiber, Nonlinear Eigenvalue Problems: Newton-type Methods and Nonlinear Rayleigh Functionals,
    /// thesis, TU Berlin (2008).
    pub fn mode_near(&self, guess: &ReducedMode) -> Option<ReducedMode> {
        let m = self.mass.nrows();
        let column = |v: &[c64]| Mat::from_fn(m, 1, |i, _| v.get(i).copied().unwrap_or_default());
        let (mut right, mut left) = (column(&guess.right), column(&guess.left));
        let mut lambda = guess.eigenvalue;
        // Where stiffness follows the frequency the vectors gain fewer digits in a step.
        let steps = QUOTIENT_STEPS * if self.tabled.is_empty() { 1 } else { 3 };
        for _ in 0..steps {
            let slope = Mat::from_fn(m, m, |i, j| {
                lambda * (2.0 * self.mass[(i, j)]) + self.damping[(i, j)]
            });
            let lu = ComplexDenseLu::factorize(self.pencil(lambda));
            (right, left) = (&slope * &right, slope.transpose() * &left);
            lu.solve_in_place(right.as_mut());
            lu.solve_transpose_in_place(left.as_mut());
            for vector in [&mut right, &mut left] {
                let length = vector.norm_l2();
                vector.col_mut(0).iter_mut().for_each(|v| *v /= length);
            }
            let step = self.quotient_step(lambda, &right, &left);
            lambda -= step;
            if !(step.norm() < guess.eigenvalue.norm()) {
                return None;
            }
            if step.norm() <= QUOTIENT_TOLERANCE * lambda.norm() {
                let entries = |v: &Mat<c64>| v.col(0).iter().copied().collect();
                return Some(ReducedMode {
                    eigenvalue: lambda,
                    inverse_value: guess.inverse_value,
                    derivative: c64::new(0.0, 0.0),
                    right: entries(&right),
                    left: entries(&left),
                });
            }
        }
        None
    }

    /// What an eigenvalue is too large by, to first order, for these vectors: `w^T T(lambda) x / w^T T'(lambda) x`.
    fn quotient_step(&self, lambda: c64, right: &Mat<c64>, left: &Mat<c64>) -> c64 {
        let m = self.mass.nrows();
        let form = |p: &Mat<f64>| -> c64 {
            let image = |i: usize| -> c64 { (0..m).map(|j| right[(j, 0)] * p[(i, j)]).sum() };
            (0..m).map(|i| left[(i, 0)] * image(i)).sum()
        };
        let [a, b, mut c] = [&self.mass, &self.damping, &self.stiffness].map(form);
        c += c64::new(0.0, 1.0) * self.structural.as_ref().map_or(c64::new(0.0, 0.0), form);
        let slope = a * lambda * 2.0 + b;
        let mut own = c64::new(0.0, 0.0);
        for (gain, stiffness) in &self.tabled {
            let form = form(stiffness);
            c += gain.at(lambda) * form;
            own += gain.slope(lambda) * form;
        }
        let step = ((a * lambda + b) * lambda + c) / slope;
        match self.tabled.is_empty() {
            true => step,
            false => own_frequency_step(step, own / slope),
        }
    }
}

/// `sum_p weight(p) P_p`.
pub fn weighted(coefficients: &[Mat<f64>], weight: impl Fn(usize) -> f64) -> Mat<f64> {
    let size = coefficients[0].nrows();
    let mut sum = Mat::zeros(size, size);
    for (place, c) in coefficients.iter().enumerate() {
        scale_and_add(&mut sum, 1.0, weight(place), c);
    }
    sum
}

/// `sum_{p >= first} weight(p) P_p mu^(p - first)`.
pub fn horner(
    coefficients: &[Mat<f64>],
    mu: f64,
    weight: impl Fn(usize) -> f64,
    first: usize,
) -> Mat<f64> {
    let size = coefficients[0].nrows();
    let mut sum = Mat::zeros(size, size);
    for (power, c) in coefficients.iter().enumerate().skip(first).rev() {
        scale_and_add(&mut sum, mu, weight(power), c);
    }
    sum
}

/// `sum <- factor sum + weight c`, in one pass: these matrices are larger than the caches.
fn scale_and_add(sum: &mut Mat<f64>, factor: f64, weight: f64, c: &Mat<f64>) {
    for j in 0..sum.ncols() {
        let entries = column_mut(sum, j).iter_mut().zip(column(c.as_ref(), j));
        entries.for_each(|(s, c)| *s = factor * *s + weight * c);
    }
}
