//! Left vectors that a basis of right ones does not hold.

use super::StiffnessFactors;
use crate::linalg::dense::column;
use crate::linalg::{Mat, SparsityPattern, c64};
use crate::prestress::SlidingTangent;

/// Corrections of a left vector; each takes two digits or so where the contact is.
const CORRECTIONS: usize = 4;
/// Energy of a correction, relative to that of the vector, below which no more are made.
const NEGLIGIBLE: f64 = 1e-8;
/// Modes that are corrected together.
const PAIRS_AT_A_TIME: usize = 12;

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
    pattern: &'a SparsityPattern,
    /// Entries of mass, damping and stiffness at the friction coefficient.
    values: [Vec<f64>; 3],
    /// Those of structural damping.
    structural: Option<Vec<f64>>,
}

impl<'a> Transposed<'a> {
    fn at(tangent: &'a SlidingTangent, mu: f64) -> Self {
        let own = [&tangent.mass, &tangent.damping, &tangent.stiffness];
        let structural = tangent.structural.as_ref();
        Self {
            pattern: tangent.stiffness.pattern(),
            values: own.map(|matrix| matrix.evaluate(mu)),
            structural: structural.map(|matrix| matrix.evaluate(mu)),
        }
    }

    /// `sum_k factors_k A_k^T w` of several vectors, each with factors of its own.
    fn images(&self, vectors: &[(&[c64], [c64; 4])]) -> Vec<Vec<c64>> {
        let size = self.pattern.dimension();
        // Real and imaginary parts of all vectors side by side: each entry of the matrices is read once.
        let parts = Mat::from_fn(size, 2 * vectors.len(), |i, column| {
            let value = vectors[column / 2].0[i];
            if column % 2 == 0 { value.re } else { value.im }
        });
        let pattern = self.pattern;
        let values = self.values.each_ref().map(Vec::as_slice);
        let mut products = pattern.multiply_transpose_each(values, parts.as_ref()).to_vec();
        if let Some(values) = &self.structural {
            products.extend(pattern.multiply_transpose_each([values], parts.as_ref()));
        }
        let of = |(m, (_, factors)): (usize, &(&[c64], [c64; 4]))| {
            let mut image = vec![c64::new(0.0, 0.0); size];
            for (product, factor) in products.iter().zip(factors) {
                let pairs = [2 * m, 2 * m + 1].map(|c| column(product.as_ref(), c));
                let entries = pairs[0].iter().zip(pairs[1]);
                let sums = image.iter_mut().zip(entries);
                sums.for_each(|(sum, (re, im))| *sum += factor * c64::new(*re, *im));
            }
            image
        };
        vectors.iter().enumerate().map(of).collect()
    }

    /// `T(lambda)^T w` of some pairs.
    fn residuals(&self, pairs: &[&OpenPair]) -> Vec<Vec<c64>> {
        let own = pairs.iter().map(|pair| {
            let lambda = pair.eigenvalue;
            let factors = [lambda * lambda, lambda, c64::new(1.0, 0.0), c64::new(0.0, 1.0)];
            (pair.left.as_slice(), factors)
        });
        self.images(&own.collect::<Vec<_>>())
    }

    /// `T'(lambda)^T w` of some pairs.
    fn slopes(&self, pairs: &[&OpenPair]) -> Vec<Vec<c64>> {
        let own = pairs.iter().map(|pair| {
            let [zero, one] = [0.0, 1.0].map(|v| c64::new(v, 0.0));
            (pair.left.as_slice(), [pair.eigenvalue * 2.0, one, zero, zero])
        });
        self.images(&own.collect::<Vec<_>>())
    }
}

impl OpenPair {
    /// About twice the elastic energy of the left vector: `w^T (2 lambda M + C) x` is 1.
    fn left_energy(&self) -> f64 {
        let square: f64 = self.left.iter().map(|v| v.norm_sqr()).sum();
        let product: c64 = self.left.iter().zip(&self.right).map(|(w, x)| w * x).sum();
        0.5 * self.eigenvalue.norm() * square / product.norm()
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
    for group in pairs.chunks_mut(PAIRS_AT_A_TIME) {
        correct_group(&transposed, factors, group);
    }
}

fn correct_group(transposed: &Transposed<'_>, factors: &StiffnessFactors, pairs: &mut [OpenPair]) {
    let scales: Vec<f64> = pairs.iter().map(OpenPair::left_energy).collect();
    let mut energies = vec![f64::INFINITY; pairs.len()];
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    for _ in 0..CORRECTIONS {
        // The corrections of those that are open, real and imaginary parts side by side.
        let own: Vec<&OpenPair> = open.iter().map(|&k| &pairs[k]).collect();
        let residuals = transposed.residuals(&own);
        let size = residuals.first().map_or(0, Vec::len);
        let mut corrections = Mat::from_fn(size, 2 * open.len(), |i, column| {
            let value = residuals[column / 2][i];
            if column % 2 == 0 { value.re } else { value.im }
        });
        factors.solve_in_place(&mut corrections);
        // Each is taken as long as corrections become smaller and still matter.
        let mut still_open = Vec::new();
        for (at, (&k, residual)) in open.iter().zip(&residuals).enumerate() {
            let [re, im] = [2 * at, 2 * at + 1].map(|column| corrections.col(column));
            let parts = || re.iter().zip(im.iter()).zip(residual);
            let energy: f64 = parts().map(|((re, im), r)| re * r.re + im * r.im).sum();
            let energy = energy.abs();
            if energy >= energies[k] {
                continue;
            }
            energies[k] = energy;
            let entries = pairs[k].left.iter_mut().zip(parts());
            entries.for_each(|(w, ((re, im), _))| *w -= c64::new(*re, *im));
            if energy > NEGLIGIBLE * scales[k] {
                still_open.push(k);
            }
        }
        open = still_open;
        if open.is_empty() {
            break;
        }
    }
    let slopes = transposed.slopes(&pairs.iter().collect::<Vec<_>>());
    for (pair, slope) in pairs.iter_mut().zip(&slopes) {
        let scale: c64 = slope.iter().zip(&pair.right).map(|(s, x)| s * x).sum();
        pair.left.iter_mut().for_each(|w| *w /= scale);
    }
}
