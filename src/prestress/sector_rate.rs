//! Derivatives of an annulus's tangent with respect to the parameters of the model.

use super::PrestressError;
use super::sector_tangent::{FrictionPolynomial, HarmonicTangent, SectorTangent};
use super::sector_terms::{Terms, friction_dashpots, stress_stiffness, sum, turning};
use crate::fem::sector::{self, SectorMatrix};
use crate::fem::{
    ElasticMaterial, MaterialField, PlaneFormulation, RayleighDamping, RegionMaterial,
};

/// A parameter that eigenvalues respond to, besides the friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `contact.static_friction_ratio`.
    StaticFrictionRatio,
    /// `contact.decay_speed`, m/s.
    DecaySpeed,
    /// `contact.normal_stiffness`, Pa/m.
    NormalStiffness,
    /// `damping.mass_coefficient`, 1/s.
    MassCoefficient,
    /// `damping.stiffness_coefficient`, s.
    StiffnessCoefficient,
    /// `material.young_modulus`, Pa.
    YoungModulus,
    /// `material.poisson_ratio`.
    PoissonRatio,
    /// `material.density`, kg/m3.
    Density,
}

/// Derivative of a [`SectorTangent`] with respect to one [`Parameter`].
#[derive(Clone, Debug)]
pub struct TangentRate {
    terms: Terms,
    rayleigh: RayleighDamping,
    /// Relative change of the drag of steady sliding.
    drag: f64,
}

impl SectorTangent {
    /// Derivative of the matrices of harmonic `n`; `damping` is always given.
    pub fn harmonic_rate(&self, rate: &TangentRate, n: usize) -> HarmonicTangent {
        if rate.drag != 0.0 {
            return self.drag_rate(rate, n);
        }
        let follows = self.damping(&rate.terms, self.options.damping, false, n);
        let shared = self.damping(&self.terms, rate.rayleigh, false, n);
        let own = self.project(vec![self.harmonic_of(&rate.terms.own_damping, n)]);
        HarmonicTangent {
            harmonic: n,
            contact: self.contact_unknowns(),
            shares: None,
            mass: self.mass(&rate.terms, n),
            stiffness: self.stiffness(&rate.terms, n),
            damping: Some(sum(sum(follows, shared), own)),
            friction_dashpots: self.friction_dashpots(&rate.terms),
            rayleigh: rate.rayleigh,
        }
    }

    /// Every factor `mu` is one `mu mu(V) / mu`: a term of power `p` changes `p` times as much as the drag.
    fn drag_rate(&self, rate: &TangentRate, n: usize) -> HarmonicTangent {
        let scaled = |mut polynomial: FrictionPolynomial| {
            for (power, coefficient) in polynomial.iter_mut().enumerate() {
                coefficient.scale(power as f64 * rate.drag);
            }
            polynomial
        };
        let own = self.harmonic(n);
        HarmonicTangent {
            mass: scaled(own.mass),
            stiffness: scaled(own.stiffness),
            damping: own.damping.map(scaled),
            friction_dashpots: self.friction_dashpots(&rate.terms),
            rayleigh: RayleighDamping::default(),
            ..own
        }
    }

    /// Derivative with respect to `parameter`, the base state following; `None` for a normal stiffness or
    /// a friction law that the contact does not have.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] as for the base state itself.
    pub fn rate(&self, parameter: Parameter) -> Result<Option<TangentRate>, PrestressError> {
        let mut terms = Terms {
            elastic: None,
            supports: None,
            own_damping: None,
            mass: None,
            stress: None,
            turning: vec![0.0; self.terms.turning.len()],
            normal_stiffness: self
                .terms
                .normal_stiffness
                .as_ref()
                .map(|k| vec![0.0; k.len()]),
            friction_dashpots: None,
        };
        let mut drag = 0.0;
        let mut share = RayleighDamping::default();
        let scaled = |matrix: &SectorMatrix, value: f64| matrix.scaled(1.0 / value);
        match parameter {
            Parameter::MassCoefficient => {
                share.mass_coefficient = 1.0;
                terms.own_damping = self.own_damping_rate(share);
            }
            Parameter::StiffnessCoefficient => {
                share.stiffness_coefficient = 1.0;
                terms.own_damping = self.own_damping_rate(share);
            }
            Parameter::StaticFrictionRatio | Parameter::DecaySpeed => {
                let Some(decay) = self.contact.decay else {
                    return Ok(None);
                };
                let speed = self.sector.specification.inner_radius * self.contact.rotation_speed;
                let [by_ratio, by_decay_speed] = decay.rates(speed);
                let [share, slope] = match parameter {
                    Parameter::DecaySpeed => by_decay_speed,
                    _ => by_ratio,
                };
                drag = share / decay.share(speed);
                terms.friction_dashpots = friction_dashpots(&self.base, slope);
            }
            Parameter::NormalStiffness => {
                if terms.normal_stiffness.is_none() {
                    return Ok(None);
                }
                terms.normal_stiffness = Some(self.sector.tributary_lengths().to_vec());
            }
            Parameter::Density => {
                let density = self.annulus_material().density;
                terms.mass = self.terms.mass.as_ref().map(|m| scaled(m, density));
                if self.materials.len() > 1 {
                    let unit = self.of_annulus(ElasticMaterial {
                        density: 1.0,
                        ..*self.annulus_material()
                    });
                    terms.mass = Some(sector::mass(&self.sector, &unit, self.options.mass));
                }
            }
            Parameter::YoungModulus => {
                let e = self.annulus_material().young_modulus;
                if self.terms.supports.is_some() || self.materials.len() > 1 {
                    let unit = ElasticMaterial {
                        young_modulus: 1.0,
                        ..*self.annulus_material()
                    };
                    self.stiffness_rate(&mut terms, &self.of_annulus(unit))?;
                    return Ok(Some(TangentRate {
                        terms,
                        rayleigh: share,
                        drag,
                    }));
                }
                // The base displacements do not depend on E, so every stress is proportional to it.
                terms.elastic = self.terms.elastic.as_ref().map(|k| scaled(k, e));
                let stress = self.terms.stress.as_ref();
                terms.stress = stress.map(|[a, b]| [scaled(a, e), scaled(b, e)]);
                terms.turning = self.terms.turning.iter().map(|value| value / e).collect();
                let dashpots = self.terms.friction_dashpots.as_ref();
                terms.friction_dashpots = dashpots.map(|d| d.iter().map(|v| v / e).collect());
            }
            Parameter::PoissonRatio => {
                let rate = poisson_rate_material(self.annulus_material());
                self.stiffness_rate(&mut terms, &self.of_annulus(rate))?;
            }
        }
        Ok(Some(TangentRate {
            terms,
            rayleigh: share,
            drag,
        }))
    }

    fn stiffness_rate(
        &self,
        terms: &mut Terms,
        rate: &dyn MaterialField,
    ) -> Result<(), PrestressError> {
        let Some(elastic) = &self.terms.elastic else {
            return Ok(());
        };
        let elastic_rate = sector::stiffness(&self.sector, rate);
        if self.terms.stress.is_some() || self.terms.friction_dashpots.is_some() {
            let supported = match &self.terms.supports {
                Some([springs, _]) => elastic.plus(springs),
                None => elastic.clone(),
            };
            let base_rate = self.base.rate(&self.sector, &supported, &elastic_rate)?;
            terms.friction_dashpots = friction_dashpots(&base_rate, self.base.friction.slope);
            if self.terms.stress.is_some() {
                let moved = stress_stiffness(&self.sector, &self.materials, &base_rate);
                let stiffened = stress_stiffness(&self.sector, rate, &self.base);
                terms.stress = Some([moved[0].plus(&stiffened[0]), moved[1].plus(&stiffened[1])]);
                terms.turning = turning(&self.sector, &self.options, &base_rate);
            }
        }
        terms.elastic = Some(elastic_rate);
        Ok(())
    }

    fn annulus_material(&self) -> &ElasticMaterial {
        &self.materials[0].elastic
    }

    /// A material of the annulus and none of the shaft: what `[material]` alone is the cause of.
    fn of_annulus(&self, material: ElasticMaterial) -> Vec<RegionMaterial> {
        let nothing = ElasticMaterial {
            young_modulus: 0.0,
            density: 0.0,
            ..material
        };
        let regions = (0..self.materials.len()).map(|region| RegionMaterial {
            elastic: if region == 0 { material } else { nothing },
            damping: None,
        });
        regions.collect()
    }

    /// A body with damping of its own has no part in the change of the common coefficients.
    fn own_damping_rate(&self, share: RayleighDamping) -> Option<SectorMatrix> {
        let (kind, unchanged) = (self.options.mass, RayleighDamping::default());
        let fixed: Vec<RegionMaterial> = self
            .materials
            .iter()
            .map(|material| RegionMaterial {
                damping: material.damping.map(|_| unchanged),
                ..*material
            })
            .collect();
        sector::extra_damping(&self.sector, &fixed, kind, share)
    }
}

/// A material whose Lamé constants are the derivatives of `material`'s with respect to Poisson's ratio,
/// so that whatever is linear in the Lamé constants differentiates itself.
fn poisson_rate_material(material: &ElasticMaterial) -> ElasticMaterial {
    let (e, nu) = (material.young_modulus, material.poisson_ratio);
    let shear = -e / (2.0 * (1.0 + nu).powi(2));
    let lambda = match material.formulation {
        PlaneFormulation::PlaneStrain | PlaneFormulation::ThreeDimensional => {
            e * (1.0 + 2.0 * nu * nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)).powi(2)
        }
        PlaneFormulation::PlaneStress => e * (1.0 + nu * nu) / (1.0 - nu * nu).powi(2),
    };
    ElasticMaterial {
        young_modulus: shear * (3.0 * lambda + 2.0 * shear) / (lambda + shear),
        poisson_ratio: lambda / (2.0 * (lambda + shear)),
        density: material.density,
        formulation: PlaneFormulation::PlaneStrain,
    }
}
