//! The projected matrices at one friction coefficient, and single modes of them.

use super::mode::ReducedMode;
use super::packed::forms;
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

/// `P^T A P` of a small matrix `A` and orthonormal columns `P`.
pub(super) fn projected(small: &Mat<f64>, columns: &Mat<f64>) -> Mat<f64> {
    let image = product(small.as_ref(), columns.as_ref());
    transpose_product(columns.as_ref(), image.as_ref())
}

impl ProjectedMatrices {
    /// The matrices projected once more, on orthonormal `columns` of coordinates.
    pub fn within(&self, columns: &Mat<f64>) -> Self {
        let within = |p: &Mat<f64>| projected(p, columns);
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
        let mut mode = guess.clone();
        // Where stiffness follows the frequency the vectors gain fewer digits in a step.
        let steps = QUOTIENT_STEPS * if self.tabled.is_empty() { 1 } else { 3 };
        for _ in 0..steps {
            let lambda = mode.eigenvalue;
            let slope = Mat::from_fn(m, m, |i, j| {
                lambda * (2.0 * self.mass[(i, j)]) + self.damping[(i, j)]
            });
            let lu = ComplexDenseLu::factorize(self.pencil(lambda));
            let column =
                |v: &[c64]| Mat::from_fn(m, 1, |i, _| v.get(i).copied().unwrap_or_default());
            let mut right = &slope * column(&mode.right);
            let mut left = slope.transpose() * column(&mode.left);
            lu.solve_in_place(right.as_mut());
            lu.solve_transpose_in_place(left.as_mut());
            let unit = |v: Mat<c64>| v.col(0).iter().map(|own| own / v.norm_l2()).collect();
            (mode.right, mode.left) = (unit(right), unit(left));

            // What the eigenvalue is too large by, to first order.
            let own = std::slice::from_ref(&mode);
            let slope = self.overlaps(own, own)[(0, 0)];
            let change = self.pencil_forms(own, own)[(0, 0)] / slope;
            let step = self.followed(&mode, change, slope);
            mode.eigenvalue -= step;
            if !(step.norm() < guess.eigenvalue.norm()) {
                return None;
            }
            if step.norm() <= QUOTIENT_TOLERANCE * mode.eigenvalue.norm() {
                return Some(mode);
            }
        }
        None
    }

    /// `w_i^T T(lambda_j) x_j`, or with the derivatives by friction `w_i^T T'(lambda_j) x_j`.
    pub fn pencil_forms(&self, lefts: &[ReducedMode], rights: &[ReducedMode]) -> Mat<c64> {
        let one = |_: c64| c64::new(1.0, 0.0);
        let mut sum = Mat::zeros(lefts.len(), rights.len());
        let mut add = |p: &Mat<f64>, factor: &dyn Fn(c64) -> c64| {
            let own = forms(lefts, p, rights);
            for (j, mode) in rights.iter().enumerate() {
                let factor = factor(mode.eigenvalue);
                (0..lefts.len()).for_each(|i| sum[(i, j)] += factor * own[(i, j)]);
            }
        };
        add(&self.mass, &|lambda| lambda * lambda);
        add(&self.damping, &|lambda| lambda);
        add(&self.stiffness, &one);
        self.structural.iter().for_each(|h| add(h, &|_| c64::new(0.0, 1.0)));
        self.tabled.iter().for_each(|(gain, k)| add(k, &|lambda| gain.at(lambda)));
        sum
    }

    /// `w_i^T ((lambda_i + lambda_j) M + C) x_j`: zero for different modes of one problem.
    pub fn overlaps(&self, lefts: &[ReducedMode], rights: &[ReducedMode]) -> Mat<c64> {
        let [inert, damped] = [&self.mass, &self.damping].map(|p| forms(lefts, p, rights));
        Mat::from_fn(lefts.len(), rights.len(), |i, j| {
            (lefts[i].eigenvalue + rights[j].eigenvalue) * inert[(i, j)] + damped[(i, j)]
        })
    }

    /// The change of the eigenvalue of a mode where it would be `change` at fixed stiffness, and `w^T T'(lambda) x` of its vectors is
    /// `slope` then.
    pub fn followed(&self, mode: &ReducedMode, change: c64, slope: c64) -> c64 {
        let own = std::slice::from_ref(mode);
        let parts = self.tabled.iter();
        let parts = parts.map(|(gain, k)| gain.slope(mode.eigenvalue) * forms(own, k, own)[(0, 0)]);
        match self.tabled.is_empty() {
            true => change,
            false => own_frequency_step(change, parts.sum::<c64>() / slope),
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
