//! Proof that a harmonic holds no eigenvalue in a region, for a whole range of friction at once.

use crate::cea::cyclic::*;
use crate::linalg::banded::{BandedFactor, BandedMatrix};
use crate::linalg::vectors::dot;

/// The region `0 <= Re(kappa) <= real`, `|Im(kappa)| <= imaginary`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Region {
    pub real: f64,
    pub imaginary: f64,
}

/// Whether `K(mu) - kappa M(mu)` is regular for every `0 <= mu <= friction` and every `kappa` in the
/// region; `false` if this test cannot tell.
///
/// If `x` is an eigenvector, `x^H T (K - kappa M) x = 0` for any `T`, so none exists where the Hermitian
/// part `H` of `T (K - kappa M)` is positive definite. With `z = i mu` and the tangential contact rows `t`,
///
/// ```text
/// T = I + z sum_t e_t psi_t^T,   psi_t^T (K_0 - kappa_0 M_0) = - row_t of (K_1 - kappa_0 M_1)
/// ```
///
/// takes the friction, which is not small, out of `H` but for the part with `kappa - kappa_0`. `H` is a cubic in `mu` and affine in
/// `kappa`: its Bernstein coefficients at the corners of the region hold all others in their convex hull, so that a few factorizations
/// prove it for the whole range. Shifts are made with proportional damping in mind; the quadratic problem has another form.
pub(super) fn is_empty(
    tangent: &HarmonicTangent,
    tangential: &[usize],
    friction: f64,
    region: Region,
) -> bool {
    let center = 0.5 * region.real;
    let Some(test) = TestSpace::new(tangent, tangential, center) else {
        return false;
    };
    (0..=3).all(|corner| test.is_definite(&bernstein_weights(corner, friction), region))
}

/// Weights of the monomials `mu^0 .. mu^3` in the Bernstein coefficient `corner` of a cubic on `[0, length]`.
fn bernstein_weights(corner: usize, length: f64) -> [f64; 4] {
    let i = corner as f64; // b_i = sum_k C(i, k) / C(3, k) length^k a_k.
    [
        1.0,
        length * i / 3.0,
        length.powi(2) * i * (i - 1.0) / 6.0,
        length.powi(3) * i * (i - 1.0) * (i - 2.0) / 6.0,
    ]
}

struct TestSpace<'a> {
    tangent: &'a HarmonicTangent,
    tangential: &'a [usize],
    others: Vec<usize>,
    /// `psi_t^T K_k` and `psi_t^T M_k` for each tangential row and power.
    stiffness: Vec<Vec<Vec<f64>>>,
    mass: Vec<Vec<Vec<f64>>>,
}

impl<'a> TestSpace<'a> {
    fn new(tangent: &'a HarmonicTangent, tangential: &'a [usize], center: f64) -> Option<Self> {
        let rest = BandedFactor::new(&tangent.stiffness[0], &tangent.mass[0], center); // K_0 - kappa_0 M_0 must be definite for a start.
        if rest.negative_count() > 0 {
            return None;
        }
        let dimension = tangent.mass[0].dimension();
        let products = |psi: &[f64], matrices: &[BandedMatrix]| -> Vec<Vec<f64>> {
            matrices.iter().map(|matrix| multiply_left(psi, matrix)).collect()
        };
        let (mut stiffness, mut mass) = (Vec::new(), Vec::new());
        for &row in tangential {
            let mut psi = vec![0.0; dimension];
            for column in tangent.mass[0].columns(row) {
                let k = tangent.stiffness.get(1).map_or(0.0, |k| k.get(row, column));
                let m = tangent.mass.get(1).map_or(0.0, |m| m.get(row, column));
                psi[column] = center * m - k; // - row_t of (K_1 - kappa_0 M_1).
            }
            rest.solve(&mut psi);
            stiffness.push(products(&psi, &tangent.stiffness));
            mass.push(products(&psi, &tangent.mass));
        }
        Some(Self {
            tangent,
            tangential,
            others: (0..dimension).filter(|dof| !tangential.contains(dof)).collect(),
            stiffness,
            mass,
        })
    }

    /// Whether the Hermitian part with the given weights of `mu^k` is positive definite at all four corners of the region.
    fn is_definite(&self, weights: &[f64; 4], region: Region) -> bool {
        // Away from the tangential rows H is Hermitian as it stands and falls with Re(kappa): its inverse
        // at the largest one bounds all others.
        let interior = self.interior(weights, region.real);
        interior.is_definite()
            && [0.0, region.real].into_iter().all(|real| {
                [-region.imaginary, region.imaginary].into_iter().all(|imaginary| {
                    self.schur_is_definite(&interior, weights, c64::new(real, imaginary))
                })
            })
    }

    fn interior(&self, weights: &[f64; 4], shift: f64) -> BandedFactor<c64> {
        let half_bandwidth = self.tangent.mass[0].half_bandwidth();
        let entry = |row: usize, column: usize| {
            let inertia = c64::new(-shift * self.tangent.mass[0].get(row, column), 0.0); // sum_k i^k w_k K_k - kappa M_0.
            let powers = self.tangent.stiffness.iter().enumerate();
            powers
                .fold(inertia, |sum, (k, own)| sum + UNITS[k] * (weights[k] * own.get(row, column)))
        };
        let mut upper = Vec::with_capacity(self.others.len() * (half_bandwidth + 1));
        for (place, &row) in self.others.iter().enumerate() {
            let columns = (place..=place + half_bandwidth).map(|other| self.others.get(other));
            upper.extend(
                columns.map(|column| column.map_or(c64::ZERO, |&column| entry(row, column))),
            );
        }
        BandedFactor::of(half_bandwidth, upper)
    }

    /// Whether the Schur complement on the tangential rows is positive definite.
    fn schur_is_definite(
        &self,
        interior: &BandedFactor<c64>,
        weights: &[f64; 4],
        kappa: c64,
    ) -> bool {
        let count = self.tangential.len();
        let lines: Vec<[Vec<c64>; 2]> =
            (0..count).map(|index| self.tested_row_and_column(index, weights, kappa)).collect();
        let borders = lines.iter().map(|[row, column]| {
            let border = |&dof: &usize| 0.5 * (column[dof] + row[dof].conj()); // Hermitian part of T (K - kappa M).
            self.others.iter().map(border).collect()
        });
        let borders: Vec<Vec<c64>> = borders.collect();
        let mut upper = vec![c64::ZERO; count * count];
        for (j, border) in borders.iter().enumerate() {
            let mut solved = border.clone();
            interior.solve(&mut solved);
            for i in 0..=j {
                let (ti, tj) = (self.tangential[i], self.tangential[j]);
                let own = 0.5 * (lines[i][0][tj] + lines[j][0][ti].conj());
                upper[i * count + j - i] = own - dot(&borders[i], &solved); // H_tt - H_ti H_ii^-1 H_it.
            }
        }
        count == 0 || BandedFactor::of(count - 1, upper).is_definite()
    }

    /// Row `t` of `T (K - kappa M)`, and column `t` of `K - kappa M`.
    fn tested_row_and_column(&self, index: usize, weights: &[f64; 4], kappa: c64) -> [Vec<c64>; 2] {
        let place = self.tangential[index];
        let zeros = vec![c64::ZERO; self.tangent.mass[0].dimension()];
        let (mut row, mut column) = (zeros.clone(), zeros);
        let terms = [
            (&self.tangent.stiffness, &self.stiffness[index], c64::ONE),
            (&self.tangent.mass, &self.mass[index], -kappa),
        ];
        for (matrices, tested, factor) in terms {
            for (k, matrix) in matrices.iter().enumerate() {
                let plain = factor * UNITS[k] * weights[k]; // z^k A_k, and z times that from the row T adds.
                for other in matrix.columns(place) {
                    row[other] += plain * matrix.get(place, other);
                    column[other] += plain * matrix.get(other, place);
                }
                let turned = factor * UNITS[k + 1] * weights[k + 1]; // z^{k+1} psi^T A_k.
                for (sum, value) in row.iter_mut().zip(&tested[k]) {
                    *sum += turned * *value;
                }
            }
        }
        [row, column]
    }
}

/// Powers of `i`.
const UNITS: [c64; 4] = [c64::ONE, c64::I, c64::new(-1.0, 0.0), c64::new(0.0, -1.0)];

/// `psi^T A`.
fn multiply_left(psi: &[f64], matrix: &BandedMatrix) -> Vec<f64> {
    let mut result = vec![0.0; psi.len()];
    for (row, value) in psi.iter().enumerate() {
        for column in matrix.columns(row) {
            result[column] += value * matrix.get(row, column);
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::RayleighDamping;

    /// Three unknowns, the first tangential: its friction row takes its force from the second.
    fn example(coupling: f64) -> HarmonicTangent {
        let (mut mass, mut stiffness) = (BandedMatrix::zeros(3, 2), BandedMatrix::zeros(3, 2));
        let mut friction = BandedMatrix::zeros(3, 2);
        for (dof, value) in [4.0, 5.0, 6.0].into_iter().enumerate() {
            mass.add(dof, dof, 1.0);
            stiffness.add(dof, dof, value);
        }
        for (row, column) in [(0, 1), (1, 0)] {
            stiffness.add(row, column, 0.5);
        }
        friction.add(0, 1, coupling);
        HarmonicTangent {
            harmonic: 1,
            is_standing: false,
            mass: vec![mass],
            stiffness: vec![stiffness, friction],
            damping: None,
            friction_dashpots: None,
            losses: Vec::new(),
            shares: [0, 1].map(|_| BandedMatrix::zeros(3, 2)),
            rayleigh: RayleighDamping::default(),
        }
    }

    /// `kappa` nearest to the origin, `(4 - k)(5 - k) = 0.5 (0.5 + i mu coupling)`.
    fn lowest(coupling: f64, mu: f64) -> c64 {
        let product = c64::new(0.25, 0.5 * mu * coupling);
        4.5 - (0.25 + product).sqrt()
    }

    #[test]
    fn no_region_that_holds_an_eigenvalue_is_declared_empty() {
        for coupling in [0.5, 3.0, 20.0] {
            let tangent = example(coupling);
            for mu in [0.1, 0.5, 1.0] {
                let kappa = lowest(coupling, mu);
                for scale in [0.7, 0.95, 1.05, 1.5] {
                    let region = Region {
                        real: (scale * kappa.re).max(1e-3),
                        imaginary: 1.0 + kappa.im.abs(),
                    };
                    let is_inside = kappa.re >= 0.0 && kappa.re <= region.real;
                    assert!(!(is_inside && is_empty(&tangent, &[0], mu, region)));
                }
            }
        }
    }

    #[test]
    fn friction_much_stronger_than_the_stiffness_does_not_spoil_the_proof() {
        // Hermitian parts alone would need |coupling| < 2 sqrt(4 * 5).
        let region = Region { real: 0.05, imaginary: 0.02 };
        assert!(is_empty(&example(12.0), &[0], 1.0, region));
    }
}
