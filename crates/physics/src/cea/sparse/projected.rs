//! The projected matrices at one friction coefficient, and single modes of them.

use super::packed::forms;
use super::term::projected;
use crate::cea::sparse::*;
use crate::fem::own_frequency_step;
use crate::linalg::FrictionWeights;
use crate::linalg::dense::product;
use crate::prestress::LossGain;

/// `V^T P V` of the matrices `P`, or of their derivatives, at one friction coefficient.
pub type ProjectedMatrices = MotionMatrices<Mat<f64>>;

/// The sum of square matrices times their factors.
pub fn weighted_sum(terms: &[(c64, &Mat<f64>)]) -> Mat<c64> {
    let m = terms[0].1.nrows();
    let mut sum = Mat::zeros(m, m);
    for (factor, p) in terms {
        for j in 0..m {
            let entries = sum.col_mut(j).iter_mut().zip(column(p.as_ref(), j));
            entries.for_each(|(t, p): (&mut c64, _)| *t += factor * *p);
        }
    }
    sum
}

impl ProjectedMatrices {
    /// The matrices projected once more, on orthonormal `columns` of coordinates.
    pub fn within(&self, columns: &Mat<f64>) -> Self {
        self.map(|p| projected(p, columns))
    }

    /// `T(lambda) = lambda^2 M + lambda C + K + sum_p g_p K_p`, the last at the frequency of `lambda`.
    pub fn pencil(&self, lambda: c64) -> Mat<c64> {
        weighted_sum(&self.inert_first(lambda))
    }

    /// The same with the stiffness that tables give at one frequency, as structural damping and stiffness of a problem without.
    pub fn frozen(&self, frequency_hz: f64) -> Self {
        let lambda = c64::new(0.0, TAU * frequency_hz);
        let m = self.mass.nrows();
        let mut stiffness = self.stiffness.clone();
        let mut structural = Mat::zeros(m, m);
        for (gain, own) in &self.losses {
            let factor = gain.at(lambda);
            stiffness += Scale(factor.re) * own;
            structural += Scale(factor.im) * own; // K + Re g K_p, H = Im g K_p.
        }
        Self {
            stiffness,
            damping: self.damping.clone(),
            mass: self.mass.clone(),
            losses: vec![(LossGain(None), structural)],
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
        let (mut factors, mut before) = (None, f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let lambda = mode.eigenvalue;
            // By factors at the eigenvalue what the slope makes of the vectors; by those from before what these leave is taken away.
            let is_reused = factors.is_some();
            let lu = factors.get_or_insert_with(|| ComplexDenseLu::factorize(self.pencil(lambda)));
            let terms = match is_reused {
                true => self.inert_first(lambda),
                false => vec![(2.0 * lambda, &self.mass), (c64::new(1.0, 0.0), &self.damping)], // T' = 2 lambda M + C.
            };
            let mut moved = 0.0_f64;
            let [right, left] = [(&mode.right, false), (&mode.left, true)].map(|(own, is_left)| {
                let own = Mat::from_fn(m, 1, |i, _| own.get(i).copied().unwrap_or_default());
                let mut new = times(&terms, &own, is_left);
                match is_left {
                    true => lu.solve_transpose_in_place(new.as_mut()),
                    false => lu.solve_in_place(new.as_mut()),
                }
                let along = (own.adjoint() * &new)[(0, 0)] / own.squared_norm_l2(); // Along the vector a change is none.
                let across = &new - Mat::from_fn(m, 1, |i, _| along * own[(i, 0)]);
                let of = if is_reused { own.norm_l2() } else { new.norm_l2() };
                moved = moved.max(across.norm_l2() / of);
                if is_reused {
                    new = own - across;
                }
                let length = new.norm_l2();
                new.col(0).iter().map(|v| v / length).collect()
            });
            (mode.right, mode.left) = (right, left);

            let own = std::slice::from_ref(&mode);
            let slope = self.overlaps(own, own)[(0, 0)];
            let change = self.pencil_forms(own, own)[(0, 0)] / slope; // What lambda is too large by: w^T T x / (w^T T' x).
            let step = self.followed(&mode, change, slope);
            mode.eigenvalue -= step;
            if !(step.norm() < guess.eigenvalue.norm()) {
                return None;
            }
            let is_settled = match is_reused {
                true => moved <= SETTLED,
                // Of two modes as close as that a combination passes for one, until its vectors stay.
                false => {
                    let is_near = step.norm() <= HALF_THE_DIGITS * mode.eigenvalue.norm();
                    is_near && moved <= HALF_THE_DIGITS.sqrt()
                }
            };
            if is_settled {
                return Some(mode);
            }
            if is_reused {
                factors = factors.filter(|_| moved <= LITTLE * before); // New ones cost as much as all steps by those from before.
                before = moved;
            }
        }
        None
    }

    /// The matrices with their factors, in the order of falling powers of `lambda`.
    fn inert_first(&self, lambda: c64) -> Vec<(c64, &Mat<f64>)> {
        let mut terms = self.terms(lambda);
        terms.swap(0, 2); // K, C, M become M, C, K.
        terms
    }

    /// `w_i^T T(lambda_j) x_j`, or with the derivatives by friction `w_i^T T'(lambda_j) x_j`.
    pub fn pencil_forms(&self, lefts: &[ReducedMode], rights: &[ReducedMode]) -> Mat<c64> {
        let terms: Vec<_> = rights.iter().map(|mode| self.inert_first(mode.eigenvalue)).collect();
        let mut sum = Mat::zeros(lefts.len(), rights.len());
        for k in 0..terms.first().map_or(0, Vec::len) {
            let own = forms(lefts, terms[0][k].1, rights);
            sum += Mat::from_fn(own.nrows(), own.ncols(), |i, j| terms[j][k].0 * own[(i, j)]);
        }
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
        let parts = self.own_rates(mode.eigenvalue);
        let sum: c64 = parts.map(|(rate, k)| rate * forms(own, k, own)[(0, 0)]).sum();
        own_frequency_step(change, sum / slope)
    }
}

/// `sum f P x` of matrices with factors, or `sum f P^T x` of a left vector.
fn times(terms: &[(c64, &Mat<f64>)], x: &Mat<c64>, is_left: bool) -> Mat<c64> {
    let parts = Mat::from_fn(x.nrows(), 2, |i, j| if j == 0 { x[(i, 0)].re } else { x[(i, 0)].im });
    let mut sum = Mat::zeros(x.nrows(), 1);
    for (factor, p) in terms {
        let image = match is_left {
            true => transpose_product(p.as_ref(), parts.as_ref()),
            false => product(p.as_ref(), parts.as_ref()),
        };
        sum += Mat::from_fn(x.nrows(), 1, |i, _| factor * c64::new(image[(i, 0)], image[(i, 1)])); // P (p + i q), by one real product.
    }
    sum
}

/// `V^T P(mu) V` of the `terms` of `P`, or of `dP/dmu`.
pub fn summed(terms: &[Term], weights: FrictionWeights, mu: f64, is_slope: bool) -> Mat<f64> {
    let size = terms[0].projected.nrows();
    let mut sum = Mat::zeros(size, size);
    for (place, factor, weight) in weights.steps(terms.len(), mu, is_slope) {
        // In one pass: these matrices are larger than the caches.
        for j in 0..size {
            let own = column(terms[place].projected.as_ref(), j);
            let entries = column_mut(&mut sum, j).iter_mut().zip(own);
            entries.for_each(|(s, c)| *s = factor * *s + weight * c);
        }
    }
    sum
}
