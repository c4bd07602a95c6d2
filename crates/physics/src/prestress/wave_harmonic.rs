//! The matrices of one harmonic, by power of the friction coefficient and at one of its values.

use super::{LossGain, MotionMatrices};
use crate::fem::RayleighDamping;
use crate::linalg::banded::{BandedMatrix, multiply_band};
use crate::linalg::c64;
use crate::linalg::vectors::product;
use std::borrow::Cow;

/// Entries of a row from which on it loses fewer digits in several sums.
const LONG_ROW: usize = 32;

/// A matrix that depends on the friction coefficient, `P(mu) = sum_p P_p (i mu)^p` with real `P_p`.
pub type FrictionPolynomial = Vec<BandedMatrix>;

/// `P(z)`, `z = i mu`.
pub fn evaluate(polynomial: &[BandedMatrix], z: c64) -> Vec<c64> {
    let mut values: Vec<c64> = polynomial[0].values().iter().map(|v| c64::new(*v, 0.0)).collect();
    let mut power = z; // P_0 + z P_1 + z^2 P_2 + ...
    for coefficient in &polynomial[1..] {
        for (value, v) in values.iter_mut().zip(coefficient.values()) {
            *value += power * *v;
        }
        power *= z;
    }
    values
}

/// Mass, damping and stiffness of one circumferential harmonic.
///
/// Unknowns are `(u_r, -i u_theta)`, in space `(u_r, -i u_theta, u_z)`, of each sector node, without held dofs and for rigid
/// contact without the contact normals; on a deformable shaft a contact normal of the annulus is the distance between the
/// two nodes of the pair. All matrices share one shape. The wave of harmonic `-n` sees the
/// complex conjugates. Of a plane body everything is for each metre of thickness.
#[derive(Clone, Debug)]
pub struct HarmonicTangent {
    /// Circumferential harmonic `n >= 0`.
    pub harmonic: usize,
    /// `+n` and `-n` are the same wave.
    pub is_standing: bool,
    /// `M_n(mu)`, kg.
    pub mass: FrictionPolynomial,
    /// `K_n(mu)`, N/m.
    pub stiffness: FrictionPolynomial,
    /// `C_n(mu)`, N s/m, where damping is not proportional; otherwise `alpha_R M_n + beta_R K_n`.
    pub damping: Option<FrictionPolynomial>,
    /// Dashpots of friction along and across the sliding: `mu` times this is a further part of `C_n`, N s/m.
    pub friction_dashpots: Option<FrictionPolynomial>,
    /// Stiffness of loss factors and of tables over frequency, which `K_n` has beside it with these factors, N/m.
    pub losses: Vec<(LossGain, FrictionPolynomial)>,
    /// Forms whose values over that of the mass are the shares of kinetic energy of the contact's nodes, of both bodies, and of axial
    /// motion.
    pub shares: [BandedMatrix; 2],
    /// Rayleigh coefficients.
    pub rayleigh: RayleighDamping,
}

/// [`HarmonicTangent`] at one friction coefficient, as bands laid out like [`BandedMatrix::values`].
#[derive(Clone, Debug)]
pub struct MovingHarmonic {
    /// Off-diagonals on either side.
    pub half_bandwidth: usize,
    /// `M`, `C`, `K`, and what [`Self::stiffness_at`] adds, kg, N s/m, N/m.
    pub matrices: MotionMatrices<Vec<c64>>,
}

impl HarmonicTangent {
    /// The matrices at a friction coefficient, the damping written out where it is proportional.
    pub fn at(&self, friction_coefficient: f64) -> MovingHarmonic {
        let (mu, z) = (friction_coefficient, c64::new(0.0, friction_coefficient));
        let [mass, stiffness] = [&self.mass, &self.stiffness].map(|p| evaluate(p, z));
        let mut damping = match &self.damping {
            Some(damping) => evaluate(damping, z),
            None => {
                let [alpha, beta] =
                    [self.rayleigh.mass_coefficient, self.rayleigh.stiffness_coefficient];
                // C = alpha M + beta K.
                mass.iter().zip(&stiffness).map(|(m, k)| m * alpha + k * beta).collect()
            }
        };
        if let Some(dashpots) = &self.friction_dashpots {
            damping.iter_mut().zip(evaluate(dashpots, z)).for_each(|(sum, c)| *sum += c * mu); // C + mu A(i mu).
        }
        let half_bandwidth = self.mass[0].half_bandwidth();
        let losses = self.losses.iter().map(|(gain, own)| (gain.clone(), evaluate(own, z)));
        let matrices = MotionMatrices { stiffness, damping, mass, losses: losses.collect() };
        MovingHarmonic { half_bandwidth, matrices }
    }
}

impl MovingHarmonic {
    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.matrices.mass.len() / (2 * self.half_bandwidth + 1)
    }

    /// `K` that an eigenvalue sees, losses and tables included.
    pub fn stiffness_at(&self, lambda: c64) -> Cow<'_, [c64]> {
        let mut sum = Cow::Borrowed(&self.matrices.stiffness[..]);
        for (gain, own) in &self.matrices.losses {
            let factor = gain.at(lambda);
            sum.to_mut().iter_mut().zip(own).for_each(|(sum, value)| *sum += factor * value); // K + sum_p g_p K_p.
        }
        sum
    }

    /// `(lambda^2 M + lambda C + K) x`, or the adjoint's product.
    pub fn apply(&self, lambda: c64, x: &[c64], adjoint: bool) -> Vec<c64> {
        let (stiffness, MotionMatrices { mass, damping, .. }) =
            (self.stiffness_at(lambda), &self.matrices);
        let terms = [(lambda * lambda, &mass[..]), (lambda, damping), (c64::ONE, &stiffness)];
        self.combine(terms, x, adjoint)
    }

    /// `(2 lambda M + C) x`, or the adjoint's product.
    pub fn apply_slope(&self, lambda: c64, x: &[c64], adjoint: bool) -> Vec<c64> {
        let MotionMatrices { mass, damping, .. } = &self.matrices;
        self.combine([(lambda + lambda, &mass[..]), (c64::ONE, damping)], x, adjoint)
    }

    /// `sum factor A x` of matrices laid out like these, or the adjoint's product.
    pub fn combine<const N: usize>(
        &self,
        terms: [(c64, &[c64]); N],
        x: &[c64],
        adjoint: bool,
    ) -> Vec<c64> {
        let mut sum = vec![c64::ZERO; x.len()];
        for (factor, band) in terms.into_iter().filter(|own| own.0 != c64::ZERO) {
            let factor = if adjoint { factor.conj() } else { factor }; // (f A)^H = conj(f) A^H.
            let image = self.image(band, x, adjoint);
            sum.iter_mut().zip(image).for_each(|(sum, value)| *sum += factor * value);
        }
        sum
    }

    fn image(&self, band: &[c64], x: &[c64], adjoint: bool) -> Vec<c64> {
        let (h, width) = (self.half_bandwidth, 2 * self.half_bandwidth + 1);
        if adjoint || width < LONG_ROW {
            return multiply_band(band, h, x, adjoint);
        }
        let row = |(row, band): (usize, &[c64])| {
            // Entries of the band that lie within the matrix.
            let (first, last) = (row.saturating_sub(h), (row + h + 1).min(x.len()));
            product(&band[first + h - row..last + h - row], &x[first..last])
        };
        band.chunks_exact(width).enumerate().map(row).collect()
    }
}
