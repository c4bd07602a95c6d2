//! Linear elasticity of a region, isotropic or orthotropic, and Rayleigh damping.

use super::orthotropy::{Elasticity, Orthotropy};
use super::{MaxwellChain, ModulusTable};
use crate::linalg::c64;
use std::sync::Arc;

/// Which out-of-plane quantity vanishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneFormulation {
    /// `epsilon_zz = 0`.
    PlaneStrain,
    /// `sigma_zz = 0`.
    PlaneStress,
    /// Nothing: a body of revolution with a thickness; its plane sections are taken in plane strain.
    ThreeDimensional,
}

/// Linear elastic material, isotropic unless it has an orthotropy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticMaterial {
    /// Young's modulus `E`, Pa; of an orthotropic material the mean over all directions, for estimates alone.
    pub young_modulus: f64,
    /// Poisson's ratio `nu`; of an orthotropic material as [`Orthotropy::mean_constants`] gives it.
    pub poisson_ratio: f64,
    /// Density `rho`, kg/m3.
    pub density: f64,
    /// Plane strain or plane stress.
    pub formulation: PlaneFormulation,
    /// Constants and axes in place of the two above, for a material that is not the same in every direction.
    pub orthotropy: Option<Orthotropy>,
    /// Structural damping `eta`: stiffness `K (1 + i eta)` at positive frequencies.
    pub loss_factor: f64,
}

/// Which material fills each region of a mesh.
pub trait MaterialField: Sync + std::fmt::Debug {
    /// The material of region `region`.
    fn of(&self, region: usize) -> &ElasticMaterial;

    /// Damping of its own that region `region` has.
    fn own_damping(&self, _region: usize) -> Option<RayleighDamping> {
        None
    }

    /// Modulus and loss factor over frequency of region `region`, whose material has the modulus of the lowest frequency.
    fn table(&self, _region: usize) -> Option<&Arc<ModulusTable>> {
        None
    }

    /// What region `region` has in time beside its elasticity, which is then the one at rest.
    fn chain(&self, _region: usize) -> Option<&MaxwellChain> {
        None
    }
}

/// The same everywhere.
impl MaterialField for ElasticMaterial {
    fn of(&self, _region: usize) -> &ElasticMaterial {
        self
    }
}

/// Material of one region.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionMaterial {
    /// Elasticity and density: with a table that of its lowest frequency, with a chain that at rest.
    pub elastic: ElasticMaterial,
    /// Rayleigh coefficients of its own, else those of the whole body.
    pub damping: Option<RayleighDamping>,
    /// Modulus and loss factor over frequency.
    pub table: Option<Arc<ModulusTable>>,
    /// What it has in time beside its elasticity.
    pub chain: Option<MaxwellChain>,
}

/// Depends on nothing, and is damped as the whole body.
impl From<ElasticMaterial> for RegionMaterial {
    fn from(elastic: ElasticMaterial) -> Self {
        Self { elastic, damping: None, table: None, chain: None }
    }
}

impl RegionMaterial {
    /// What a region has in time: one with damping that belongs to frequencies the elasticity of its chain at rest, and the chain.
    pub fn in_time(
        materials: &dyn MaterialField,
        region: usize,
        chain: Option<MaxwellChain>,
    ) -> Self {
        let at_rest = chain.as_ref().map_or(1.0, |chain| chain.at_rest);
        let elastic = materials.of(region).scaled(at_rest);
        Self {
            damping: materials.own_damping(region),
            chain,
            ..ElasticMaterial { loss_factor: 0.0, ..elastic }.into()
        }
    }
}

/// One for each region.
impl MaterialField for Vec<RegionMaterial> {
    fn of(&self, region: usize) -> &ElasticMaterial {
        &self[region].elastic
    }

    fn own_damping(&self, region: usize) -> Option<RayleighDamping> {
        self[region].damping
    }

    fn table(&self, region: usize) -> Option<&Arc<ModulusTable>> {
        self[region].table.as_ref()
    }

    fn chain(&self, region: usize) -> Option<&MaxwellChain> {
        self[region].chain.as_ref()
    }
}

impl ElasticMaterial {
    /// What a material has that says no more: isotropic, in plane strain; without stiffness or mass until they are given.
    pub const PLAIN: Self = Self {
        young_modulus: 0.0,
        poisson_ratio: 0.0,
        density: 0.0,
        formulation: PlaneFormulation::PlaneStrain,
        orthotropy: None,
        loss_factor: 0.0,
    };

    /// The same with all its stiffness multiplied by a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |values: [f64; 3]| values.map(|value| factor * value);
        Self {
            young_modulus: factor * self.young_modulus,
            orthotropy: self.orthotropy.map(|own| Orthotropy {
                young_moduli: scaled(own.young_moduli),
                shear_moduli: scaled(own.shear_moduli),
                ..own
            }),
            ..*self
        }
    }

    /// Lamé constants `[lambda, G]` of the plane problem, Pa:
    /// `sigma = lambda tr(epsilon) I + 2 G epsilon` with the in-plane trace; of an orthotropic material those of its mean.
    ///
    /// Plane strain: `lambda = E nu / ((1 + nu)(1 - 2 nu))`; plane stress: `lambda = E nu / (1 - nu^2)`. Both: `G = E / (2 (1 + nu))`.
    pub fn lame_constants(&self) -> [f64; 2] {
        let (e, nu) = (self.young_modulus, self.poisson_ratio);
        let lambda = match self.formulation {
            PlaneFormulation::PlaneStress => e * nu / (1.0 - nu * nu),
            _ => e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
        };
        [lambda, e / (2.0 * (1.0 + nu))]
    }

    /// Elasticity matrix `D` in `sigma = D epsilon` at a place, Pa, over `(xx, yy, zz, xy, yz, zx)` with engineering shear
    /// strains `2 epsilon_xy, ...`; what a plane formulation says of the third direction is in it, so that strains of a plane
    /// body, which have none, give its stresses in the plane.
    pub fn elasticity_at(&self, place: [f64; 3]) -> Elasticity {
        let Some(orthotropy) = &self.orthotropy else { return self.isotropic_elasticity() };
        let mut law = orthotropy.elasticity_at(place);
        if self.formulation == PlaneFormulation::PlaneStress {
            // sigma_zz = 0 gives epsilon_zz = -(D_zx epsilon_xx + D_zy epsilon_yy + ...) / D_zz.
            let across = law[2];
            for (row, coupling) in across.iter().enumerate() {
                for (column, other) in across.iter().enumerate() {
                    law[row][column] -= coupling * other / across[2];
                }
            }
            law[2] = [0.0; 6];
            law.iter_mut().for_each(|row| row[2] = 0.0);
        }
        law
    }

    fn isotropic_elasticity(&self) -> Elasticity {
        let [lambda, g] = self.lame_constants();
        let p = lambda + 2.0 * g;
        let [z, zz] = match self.formulation {
            PlaneFormulation::PlaneStress => [0.0, 0.0],
            _ => [lambda, p],
        };
        [
            [p, lambda, z, 0.0, 0.0, 0.0],
            [lambda, p, z, 0.0, 0.0, 0.0],
            [z, z, zz, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, g, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, g, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, g],
        ]
    }

    /// Stress `(xx, yy, zz, xy, yz, zx)`, Pa, of a strain `(xx, yy, zz, 2 xy, 2 yz, 2 zx)` at a place: `sigma = D epsilon`, of
    /// an isotropic material `lambda tr(epsilon) I + 2 G epsilon`.
    pub fn stress(&self, strain: &[f64; 6], place: [f64; 3]) -> [f64; 6] {
        if self.orthotropy.is_some() {
            let law = self.elasticity_at(place);
            return law.map(|row| row.iter().zip(strain).map(|(d, e)| d * e).sum());
        }
        let [lambda, g] = self.lame_constants();
        let volume = lambda * (strain[0] + strain[1] + strain[2]);
        let normal = |k: usize| volume + 2.0 * g * strain[k];
        let across = match self.formulation {
            PlaneFormulation::PlaneStress => 0.0,
            _ => normal(2),
        };
        [normal(0), normal(1), across, g * strain[3], g * strain[4], g * strain[5]]
    }
}

/// Rayleigh damping, `C = alpha_R M + beta_R K` (equation (2) of Brunetti et al.).
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RayleighDamping {
    /// `alpha_R`, 1/s.
    pub mass_coefficient: f64,
    /// `beta_R`, s.
    pub stiffness_coefficient: f64,
}

impl RayleighDamping {
    /// Modal damping factor `zeta = (alpha_R / omega + beta_R omega) / 2` (equation (3)) at the undamped angular frequency `omega`, rad/s.
    pub fn damping_factor(&self, omega: f64) -> f64 {
        0.5 * (self.mass_coefficient / omega + self.stiffness_coefficient * omega)
    }

    /// The eigenvalue `lambda` with `Im >= 0`, rad/s, of `lambda^2 + alpha_R lambda + (1 + beta_R lambda) kappa = 0`,
    /// where `K x = kappa M x`; with `Im = 0` for an overdamped mode.
    ///
    /// The relation to which proportional damping (2) reduces `(lambda^2 M + lambda C + K) x = 0`, which is (1) for `e^{lambda t} x`.
    pub fn eigenvalue(&self, kappa: c64) -> c64 {
        let half = (self.mass_coefficient + self.stiffness_coefficient * kappa) * 0.5;
        c64::I * (kappa - half * half).sqrt() - half
    }

    /// `d lambda / d kappa` of [`Self::eigenvalue`] at a root `lambda` of `kappa`.
    pub fn eigenvalue_slope(&self, lambda: c64, kappa: c64) -> c64 {
        -(1.0 + self.stiffness_coefficient * lambda)
            / (2.0 * lambda + self.mass_coefficient + self.stiffness_coefficient * kappa)
    }

    /// The `kappa` of which `lambda` is a root, `-lambda (lambda + alpha_R) / (1 + beta_R lambda)`.
    pub fn kappa(&self, lambda: c64) -> c64 {
        -lambda * (lambda + self.mass_coefficient) / (1.0 + self.stiffness_coefficient * lambda)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalue_and_kappa_are_inverse_and_the_slope_is_their_derivative() {
        let damping = RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 };
        let kappa = c64::new(4e9, 3e8);
        let lambda = damping.eigenvalue(kappa);
        assert!(lambda.im > 0.0);
        assert!((damping.kappa(lambda) - kappa).norm() < 1e-13 * kappa.norm());
        let h = 1e3;
        let difference =
            (damping.eigenvalue(kappa + h) - damping.eigenvalue(kappa - h)) / (2.0 * h);
        // Central difference: error of order (h / kappa)^2 and round-off of lambda over h.
        let slope = damping.eigenvalue_slope(lambda, kappa);
        assert!((slope - difference).norm() < 1e-8 * slope.norm());
    }
}
