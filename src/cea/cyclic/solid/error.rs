//! Estimated error of the reduction of a harmonic.

use super::reduction::Reduction;
use super::rest::Pencil;
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use crate::prestress::{SolidHarmonic, moving_unknowns};

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
    harmonic: &SolidHarmonic,
    pencil: &Pencil,
    pair: &ReducedPair<'_>,
) -> f64 {
    let (lambda, turn) = (pair.eigenvalue, c64::new(0.0, pair.friction_coefficient));
    let x = reduction.expand(pair.right);
    let mut y = reduction.expand(pair.left);
    // A normal equation in rigid contact, times `i mu`, is part of the tangential one.
    for &(normal, tangential, factor) in &harmonic.rigid {
        y[normal] = tangential.map_or(c64::new(0.0, 0.0), |t| (turn * factor).conj() * y[t]);
    }
    let one = c64::new(1.0, 0.0);
    let [k0, k1] = &harmonic.stiffness;
    let [c0, c1] = &harmonic.damping;
    let friction = pair.friction_coefficient * one;
    let terms = [
        (one, k0),
        (turn, k1),
        (lambda, c0),
        (lambda * turn, c1),
        (lambda * friction, &harmonic.across),
        (lambda * lambda, &harmonic.mass),
    ];
    let mut right = vec![c64::new(0.0, 0.0); x.len()];
    let mut left = right.clone();
    for (factor, matrix) in terms {
        add_product(&mut right, factor, matrix, &x, false);
        add_product(&mut left, factor.conj(), matrix, &y, true);
    }
    for &(normal, tangential, factor) in &harmonic.rigid {
        if let Some(tangential) = tangential {
            let force = turn * factor * right[normal];
            right[tangential] += force;
        }
    }
    let mut slope = vec![c64::new(0.0, 0.0); x.len()];
    for (factor, matrix) in
        [(one, c0), (turn, c1), (friction, &harmonic.across), (lambda + lambda, &harmonic.mass)]
    {
        add_product(&mut slope, factor, matrix, &x, false);
    }
    let moving = moving_unknowns(x.len(), &harmonic.rigid);
    let part = |of: fn(&c64) -> f64| {
        let mut part: Vec<f64> = moving.iter().map(|&unknown| of(&right[unknown])).collect();
        pencil.factor.solve(&mut part);
        part
    };
    let (real, imaginary) = (part(|v| v.re), part(|v| v.im));
    let answers = real.iter().zip(&imaginary).map(|(re, im)| c64::new(*re, *im));
    let missing: c64 =
        moving.iter().zip(answers).map(|(&unknown, v)| left[unknown].conj() * v).sum();
    let slope: c64 = y.iter().zip(&slope).map(|(y, v)| y.conj() * v).sum();
    (missing / (slope * lambda)).norm()
}

/// Adds `factor A x`, or `factor A^T x`.
fn add_product(sum: &mut [c64], factor: c64, matrix: &BandedMatrix, x: &[c64], transposed: bool) {
    for row in 0..matrix.dimension() {
        let columns = matrix.columns(row);
        let first = columns.start + matrix.half_bandwidth() - row;
        for (column, &value) in columns.zip(&matrix.row(row)[first..]) {
            if value != 0.0 {
                let (to, from) = if transposed { (column, row) } else { (row, column) };
                sum[to] += factor * value * x[from];
            }
        }
    }
}
