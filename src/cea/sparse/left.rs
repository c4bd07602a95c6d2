//! Left vectors that a basis of right ones does not hold.

use super::StiffnessFactors;
use crate::linalg::{Mat, MatrixPolynomial, c64};
use crate::prestress::SlidingTangent;

/// Corrections of a left vector; each takes two digits or so where the contact is.
const CORRECTIONS: usize = 4;

/// A mode over the unknowns.
pub struct OpenPair {
    /// Eigenvalue, rad/s.
    pub eigenvalue: c64,
    /// Right vector `x`.
    pub right: Vec<c64>,
    /// Left vector `w`.
    pub left: Vec<c64>,
}

/// `T(lambda)^T` and `T'(lambda)^T` at a friction coefficient, parts without tables.
struct Transposed<'a> {
    /// Mass, damping, stiffness and structural damping, with their entries at the friction coefficient.
    parts: [Option<(&'a MatrixPolynomial, Vec<f64>)>; 4],
}

impl<'a> Transposed<'a> {
    fn at(tangent: &'a SlidingTangent, mu: f64) -> Self {
        let at = |matrix: &'a MatrixPolynomial| (matrix, matrix.evaluate(mu));
        let own = [&tangent.mass, &tangent.damping, &tangent.stiffness];
        let [mass, damping, stiffness] = own.map(|matrix| Some(at(matrix)));
        let structural = tangent.structural.as_ref().map(at);
        Self {
            parts: [mass, damping, stiffness, structural],
        }
    }

    /// `sum_k factors_k A_k^T w`.
    fn image(&self, factors: [c64; 4], w: &[c64]) -> Vec<c64> {
        let mut image = vec![c64::new(0.0, 0.0); w.len()];
        for (part, factor) in self.parts.iter().zip(factors) {
            let Some((matrix, values)) = part else {
                continue;
            };
            for (i, value) in w.iter().enumerate() {
                let own = factor * value;
                for (position, j) in matrix.pattern().row(i) {
                    image[j] += own * values[position];
                }
            }
        }
        image
    }

    fn residual(&self, lambda: c64, w: &[c64]) -> Vec<c64> {
        let one = c64::new(1.0, 0.0);
        self.image([lambda * lambda, lambda, one, c64::new(0.0, 1.0)], w)
    }

    fn slope(&self, lambda: c64, w: &[c64]) -> Vec<c64> {
        let [zero, one] = [0.0, 1.0].map(|v| c64::new(v, 0.0));
        self.image([lambda * 2.0, one, zero, zero], w)
    }
}

/// Corrects left vectors by the stiffness without friction, `P`,
///
/// ```text
/// w <- w - P^-1 T(lambda)^T w
/// ```
///
/// as long as the energy of the correction falls, and scales them to `w^T (2 lambda M + C) x = 1`. Right vectors at several friction
/// coefficients span what is global in a left one; what is missing is near the contact, where the normal force works on its slip, and
/// follows the load as in statics.
pub fn correct_lefts(
    tangent: &SlidingTangent,
    factors: &StiffnessFactors,
    mu: f64,
    pairs: &mut [OpenPair],
) {
    let transposed = Transposed::at(tangent, mu);
    let size = tangent.unknowns.len();
    let mut energies = vec![f64::INFINITY; pairs.len()];
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    for _ in 0..CORRECTIONS {
        let residuals = open.iter().map(|&k| {
            let OpenPair {
                eigenvalue, left, ..
            } = &pairs[k];
            transposed.residual(*eigenvalue, left)
        });
        let residuals: Vec<Vec<c64>> = residuals.collect();
        let mut corrections = Mat::from_fn(size, 2 * open.len(), |i, column| {
            let value = residuals[column / 2][i];
            if column % 2 == 0 { value.re } else { value.im }
        });
        factors.solve_in_place(&mut corrections);
        let mut still_open = Vec::new();
        for (at, (&k, residual)) in open.iter().zip(&residuals).enumerate() {
            let [re, im] = [2 * at, 2 * at + 1].map(|column| corrections.col(column));
            let parts = || re.iter().zip(im.iter()).zip(residual);
            let energy = parts()
                .map(|((re, im), r)| re * r.re + im * r.im)
                .sum::<f64>()
                .abs();
            if energy < energies[k] {
                energies[k] = energy;
                let entries = pairs[k].left.iter_mut().zip(parts());
                entries.for_each(|(w, ((re, im), _))| *w -= c64::new(*re, *im));
                still_open.push(k);
            }
        }
        open = still_open;
    }
    for pair in pairs {
        let slope = transposed.slope(pair.eigenvalue, &pair.left);
        let scale: c64 = slope.iter().zip(&pair.right).map(|(s, x)| s * x).sum();
        pair.left.iter_mut().for_each(|w| *w /= scale);
    }
}
