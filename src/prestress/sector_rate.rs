//! Derivatives of an annulus's tangent with respect to the parameters of the model.

use super::FrictionPolynomial;
use super::PrestressError;
use super::sector_tangent::{HarmonicTangent, SectorTangent};
use super::sector_terms::{Terms, friction_dashpots, stress_stiffness, sum, turning};
use crate::contact::LawParameter;
use crate::fem::sector::{self, SectorMatrix};
use crate::fem::{ElasticMaterial, MaterialField, RayleighDamping, RegionMaterial};

/// A parameter that eigenvalues respond to, besides the friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `contact.static_friction_ratio`.
    StaticFrictionRatio,
    /// `contact.decay_speed`, m/s.
    DecaySpeed,
    /// `contact.normal_stiffness`, Pa/m.
    NormalStiffness,
    /// `contact.cubic_stiffness`, `reference_pressure` or `height`.
    NormalLaw(LawParameter),
    /// `damping.mass_coefficient`, 1/s.
    MassCoefficient,
    /// `damping.stiffness_coefficient`, s.
    StiffnessCoefficient,
    /// `young_modulus` of a region, Pa: 0 is `[material]`, 1 the shaft.
    YoungModulus(usize),
    /// `poisson_ratio` of a region.
    PoissonRatio(usize),
    /// `density` of a region, kg/m3.
    Density(usize),
    /// `mass_coefficient` that the shaft has of its own, 1/s.
    OwnMassCoefficient,
    /// `stiffness_coefficient` that the shaft has of its own, s.
    OwnStiffnessCoefficient,
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
            friction_dashpots: self.friction_dashpots(&rate.terms).map(|c| vec![c]),
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
            friction_dashpots: self.friction_dashpots(&rate.terms).map(|c| vec![c]),
            rayleigh: RayleighDamping::default(),
            ..own
        }
    }

    /// Derivative with respect to `parameter`, the base state following; `None` for a normal stiffness or a friction law that
    /// the contact does not have, for a region that is not there, and for damping that the shaft has not of its own.
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
            normal_stiffness: self.terms.normal_stiffness.as_ref().map(|k| vec![0.0; k.len()]),
            friction_dashpots: None,
        };
        let mut drag = 0.0;
        let mut share = RayleighDamping::default();
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
            Parameter::NormalLaw(_) | Parameter::NormalStiffness
                if self.options.contact.law.is_some() =>
            {
                let own = match parameter {
                    Parameter::NormalLaw(own) => own,
                    _ => LawParameter::Stiffness,
                };
                let law = self.options.contact.law;
                if law.and_then(|law| law.rates(own, 0.0)).is_none() {
                    return Ok(None);
                }
                self.base_rate(&mut terms, None, Some(own))?;
            }
            Parameter::NormalLaw(_) => return Ok(None),
            Parameter::NormalStiffness => {
                if terms.normal_stiffness.is_none() {
                    return Ok(None);
                }
                terms.normal_stiffness = Some(self.sector.tributary_lengths().to_vec());
            }
            Parameter::OwnMassCoefficient => {
                share.mass_coefficient = 1.0;
                return Ok(self.shaft_damping_rate(terms, share));
            }
            Parameter::OwnStiffnessCoefficient => {
                share.stiffness_coefficient = 1.0;
                return Ok(self.shaft_damping_rate(terms, share));
            }
            Parameter::YoungModulus(region)
            | Parameter::PoissonRatio(region)
            | Parameter::Density(region) => {
                let Some(material) = self.materials.get(region) else {
                    return Ok(None);
                };
                // An orthotropic material has neither of the constants of isotropy.
                let is_density = matches!(parameter, Parameter::Density(_));
                if material.elastic.orthotropy.is_some() && !is_density {
                    return Ok(None);
                }
                self.material_rate(&mut terms, parameter, region)?;
            }
        }
        Ok(Some(TangentRate { terms, rayleigh: share, drag }))
    }

    /// Derivative with respect to a constant of a region's material.
    fn material_rate(
        &self,
        terms: &mut Terms,
        parameter: Parameter,
        region: usize,
    ) -> Result<(), PrestressError> {
        let material = self.materials[region].elastic;
        let scaled = |matrix: &SectorMatrix, value: f64| matrix.scaled(1.0 / value);
        let is_alone = self.materials.len() == 1;
        // Matrices are linear in density and Lame's constants.
        let rate = match parameter {
            Parameter::Density(_) => {
                ElasticMaterial { density: 1.0, ..material.without_stiffness() }
            }
            Parameter::YoungModulus(_) => {
                ElasticMaterial { young_modulus: 1.0, density: 0.0, ..material }
            }
            _ => ElasticMaterial { density: 0.0, ..material.poisson_rate() },
        };
        let rate = self.of_region(region, rate);
        terms.own_damping =
            sector::extra_damping(&self.sector, &rate, self.options.mass, self.options.damping);
        match parameter {
            Parameter::Density(_) if is_alone => {
                let mass = self.terms.mass.as_ref();
                terms.mass = mass.map(|m| scaled(m, material.density));
            }
            Parameter::Density(_) => {
                terms.mass = Some(sector::mass(&self.sector, &rate, self.options.mass));
            }
            Parameter::YoungModulus(_)
                if is_alone
                    && self.terms.supports.is_none()
                    && self.options.contact.law.is_none() =>
            {
                // The base displacements do not depend on E, so every stress is proportional to it.
                let e = material.young_modulus;
                terms.elastic = self.terms.elastic.as_ref().map(|k| scaled(k, e));
                let stress = self.terms.stress.as_ref();
                terms.stress = stress.map(|[a, b]| [scaled(a, e), scaled(b, e)]);
                terms.turning = self.terms.turning.iter().map(|value| value / e).collect();
                let dashpots = self.terms.friction_dashpots.as_ref();
                terms.friction_dashpots = dashpots.map(|d| d.iter().map(|v| v / e).collect());
            }
            _ => self.stiffness_rate(terms, &rate)?,
        }
        Ok(())
    }

    fn stiffness_rate(
        &self,
        terms: &mut Terms,
        rate: &dyn MaterialField,
    ) -> Result<(), PrestressError> {
        if self.terms.elastic.is_none() {
            return Ok(());
        }
        let elastic_rate = sector::stiffness(&self.sector, rate);
        self.base_rate(terms, Some((&elastic_rate, rate)), None)?;
        terms.elastic = Some(elastic_rate);
        Ok(())
    }

    /// What the change of the base state does, of the stiffness of the bodies or of a number of the contact's law.
    fn base_rate(
        &self,
        terms: &mut Terms,
        material: Option<(&SectorMatrix, &dyn MaterialField)>,
        law_parameter: Option<LawParameter>,
    ) -> Result<(), PrestressError> {
        let law = self.options.contact.law;
        let has_base = self.terms.stress.is_some() || self.terms.friction_dashpots.is_some();
        let Some(elastic) = &self.terms.elastic else {
            return Ok(());
        };
        if !has_base && law.is_none() {
            return Ok(());
        }
        let supported = match &self.terms.supports {
            Some([springs, _]) => elastic.plus(springs),
            None => elastic.clone(),
        };
        let law = law.map(|law| (law, law_parameter));
        let elastic_rate = material.map(|(rate, _)| rate);
        let base_rate = self.base.rate(&self.sector, &supported, elastic_rate, law)?;
        terms.friction_dashpots = friction_dashpots(&base_rate, self.base.friction.slope);
        if self.terms.stress.is_some() {
            let mut stress = stress_stiffness(&self.sector, &self.materials, &base_rate);
            if let Some((_, rate)) = material {
                let stiffened = stress_stiffness(&self.sector, rate, &self.base);
                stress = [0, 1].map(|i| stress[i].plus(&stiffened[i]));
            }
            terms.stress = Some(stress);
            terms.turning = turning(&self.sector, &self.options, &base_rate);
        }
        if let Some(springs) = base_rate.springs {
            terms.normal_stiffness = Some(springs);
        }
        Ok(())
    }

    /// A material of one region, with the damping that the region has of its own, and nothing elsewhere: what one
    /// section of the case is the cause of.
    pub(super) fn of_region(&self, own: usize, elastic: ElasticMaterial) -> Vec<RegionMaterial> {
        let nothing = ElasticMaterial { density: 0.0, ..elastic.without_stiffness() };
        let regions = self.materials.iter().enumerate();
        let regions = regions.map(|(region, material)| RegionMaterial {
            elastic: if region == own { elastic } else { nothing },
            damping: material.damping,
        });
        regions.collect()
    }

    /// Derivative with respect to the coefficients that the shaft has of its own.
    fn shaft_damping_rate(&self, mut terms: Terms, share: RayleighDamping) -> Option<TangentRate> {
        let unchanged = RayleighDamping::default();
        let mut materials = self.materials.clone();
        *materials.get_mut(1)?.damping.as_mut()? = share;
        terms.own_damping =
            sector::extra_damping(&self.sector, &materials, self.options.mass, unchanged);
        Some(TangentRate { terms, rayleigh: unchanged, drag: 0.0 })
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
