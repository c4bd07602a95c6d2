//! Estimated error of the reduction of a harmonic.

use super::pencil::Pencil;
use super::reduction::Reduction;
use crate::cea::vectors::dot;
use crate::linalg::c64;
use crate::prestress::HarmonicTangent;

/// One eigenvalue of a reduced harmonic with its vectors in the reduced space.
pub(super) struct ReducedPair<'a> {
    pub friction_coefficient: f64,
    pub eigenvalue: c64,
    pub right: &'a [c64],
    pub left: &'a [c64],
}

/// Estimate of the error of an eigenvalue relative to it.
///
/// The reduced vectors leave the residuals `r = T x` and `l = T^H y`, `T = lambda^2 M + lambda C + K`, to which the unknowns that the
/// space does not hold answer as at rest, `K^-1`: to second order
///
/// ```text
/// delta lambda = l^H K^-1 r / (y^H T' x)
/// ```
pub(super) fn reduction_error(
    reduction: &Reduction,
    harmonic: &HarmonicTangent,
    pencil: &Pencil,
    pair: &ReducedPair<'_>,
) -> f64 {
    let (at, lambda) = (harmonic.at(pair.friction_coefficient), pair.eigenvalue);
    let [x, y] = [pair.right, pair.left].map(|vector| reduction.expand(vector));
    let right = at.apply(lambda, &x, false);
    let left = at.apply(lambda, &y, true);
    let part = |of: fn(&c64) -> f64| {
        let mut part: Vec<f64> = right.iter().map(of).collect();
        pencil.factor.solve(&mut part);
        part
    };
    let (real, imaginary) = (part(|v| v.re), part(|v| v.im));
    let answers = real.iter().zip(&imaginary).map(|(re, im)| c64::new(*re, *im));
    let missing: c64 = left.iter().zip(answers).map(|(l, v)| l.conj() * v).sum();
    let slope = dot(&y, &at.apply_slope(lambda, &x, false));
    (missing / (slope * lambda)).norm()
}
