//! Derivatives of a body of revolution's tangent with respect to the parameters of the model.

use super::pressing_rate::{SolidChange, SolidSlidingRate};
use super::solid_contact::contact_term_rates;
use super::solid_tangent::{SolidTerms, turning_forces};
use super::{Parameter, PrestressError, SolidHarmonic, SolidTangent};
use crate::contact::LawParameter;
use crate::fem::sector::MirrorParity;
use crate::fem::solid::{self, SolidMatrix};
use crate::fem::{ElasticMaterial, RayleighDamping};

/// Derivative of a [`SolidTangent`] with respect to one [`Parameter`].
#[derive(Clone, Debug)]
pub struct SolidRate {
    terms: SolidTerms,
    rayleigh: RayleighDamping,
    /// Of the factors of [`SolidHarmonic::rigid`].
    drags: Vec<f64>,
}

impl SolidTangent {
    /// Derivative with respect to `parameter`, the base state following: pressure, prestress and the ends of what is pressed. `None`
    /// for a normal stiffness or a friction law that the contact does not have, for the two constants of isotropy where the material
    /// is orthotropic, and for what belongs to a shaft.
    ///
    /// Rings in rigid contact are pressed or not, and so are the nodes of 8-node bricks on springs: where a parameter changes the
    /// set, eigenvalues jump.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] as for the base state itself.
    pub fn rate(&self, parameter: Parameter) -> Result<Option<SolidRate>, PrestressError> {
        let mut rate = SolidRate {
            terms: SolidTerms::default(),
            rayleigh: RayleighDamping::default(),
            drags: vec![0.0; self.rigid().len()],
        };
        let material = self.material;
        match parameter {
            Parameter::MassCoefficient => rate.rayleigh.mass_coefficient = 1.0,
            Parameter::StiffnessCoefficient => rate.rayleigh.stiffness_coefficient = 1.0,
            Parameter::Density(0) => {
                let unit = ElasticMaterial { density: 1.0, ..material };
                rate.terms.mass = solid::mass(&self.sector, &unit, self.options.mass);
            }
            // An orthotropic material has neither constant.
            Parameter::YoungModulus(0) | Parameter::PoissonRatio(0)
                if material.orthotropy.is_some() =>
            {
                return Ok(None);
            }
            Parameter::YoungModulus(0) => {
                let unit = ElasticMaterial { young_modulus: 1.0, ..material };
                self.follow(&mut rate, parameter, Some(unit))?;
            }
            Parameter::PoissonRatio(0) => {
                self.follow(&mut rate, parameter, Some(material.poisson_rate()))?;
            }
            Parameter::NormalStiffness | Parameter::NormalLaw(_) if self.has(parameter) => {
                self.follow(&mut rate, parameter, None)?;
            }
            Parameter::StaticFrictionRatio | Parameter::DecaySpeed
                if self.base.contact.decay.is_some() =>
            {
                self.follow(&mut rate, parameter, None)?;
            }
            _ => return Ok(None),
        }
        Ok(Some(rate))
    }

    /// Whether the contact has springs of that parameter.
    fn has(&self, parameter: Parameter) -> bool {
        let own = law_parameter(parameter);
        match (self.options.contact.law, own) {
            (Some(law), Some(own)) => law.rates(own, 0.0).is_some(),
            _ => {
                own == Some(LawParameter::Stiffness)
                    && self.options.contact.normal_stiffness.is_some()
            }
        }
    }

    /// What changes with the base state, and with the elastic constants at `material` for each unit of the parameter.
    fn follow(
        &self,
        rate: &mut SolidRate,
        parameter: Parameter,
        material: Option<ElasticMaterial>,
    ) -> Result<(), PrestressError> {
        let (sector, base, contact) = (&self.sector, &self.base, &self.options.contact);
        let elastic = material.map(|rate| solid::stiffness_rate(sector, &self.material, &rate));
        let stiffer = f64::from(u8::from(parameter == Parameter::NormalStiffness));
        let change = SolidChange {
            elastic: elastic.as_ref(),
            law_parameter: law_parameter(parameter).filter(|_| base.law.is_some()),
            parameter,
        };
        let state = SolidSlidingRate::new(base, sector, &self.terms.elastic, &change)?;
        rate.terms.contact = contact_term_rates(base, &state, sector, (contact, stiffer));
        if self.options.geometric_stiffness {
            rate.terms.stress = self.stress_rate(&state, material.as_ref());
        }
        rate.terms.elastic = elastic.unwrap_or_default();
        let inward = sector.specification.contact.face().inward_sign();
        for (drag, node) in rate.drags.iter_mut().zip(self.rigid_nodes()) {
            *drag = inward * state.friction(base, sector.nodes[node].radius).drag;
        }
        Ok(())
    }

    /// Derivative of the geometric stiffness and of the forces that turn with their nodes.
    fn stress_rate(
        &self,
        state: &SolidSlidingRate,
        material: Option<&ElasticMaterial>,
    ) -> [SolidMatrix; 2] {
        let base = &self.base;
        let stiffness = |displacement, rate| {
            let both = (displacement, rate);
            solid::geometric_stiffness_rate(&self.sector, &self.material, material, both)
        };
        let mut pressed = stiffness(&base.pressed_displacement, &state.pressed_displacement);
        let mut sheared = stiffness(&base.sheared_displacement, &state.sheared_displacement);
        let nodes = base.normal_forces.iter().zip(&state.normal_forces);
        let forces = nodes.map(|(&(node, force), &rate)| {
            let radius = self.sector.nodes[node].radius;
            let drag =
                base.friction(radius).1.drag * rate + state.friction(base, radius).drag * force;
            (node, [rate / radius, drag / radius])
        });
        let [turning, dragging] = turning_forces(&self.sector, forces);
        pressed.extend(turning);
        sheared.extend(dragging);
        [pressed, sheared]
    }

    /// Derivative of the matrices of harmonic `n`, and in [`SolidHarmonic::rigid`] that of the factors.
    pub fn harmonic_rate(&self, rate: &SolidRate, n: usize) -> SolidHarmonic {
        let mut harmonic = self.assembled(&rate.terms, n);
        let RayleighDamping { mass_coefficient, stiffness_coefficient } = rate.rayleigh;
        if mass_coefficient != 0.0 {
            let mass = self.sum(n, MirrorParity::Even, &[&self.terms.mass]);
            harmonic.damping[0].add_scaled(mass_coefficient, &mass);
        }
        if stiffness_coefficient != 0.0 {
            let stiffness = self.stiffness(&self.terms, n);
            let damped = self.damped(&self.terms, &stiffness, n);
            for (sum, matrix) in harmonic.damping.iter_mut().zip(&damped) {
                sum.add_scaled(stiffness_coefficient, matrix);
            }
        }
        let rigid = self.rigid().into_iter().zip(&rate.drags);
        harmonic.rigid = rigid.map(|((n, t, _), drag)| (n, t, *drag)).collect();
        harmonic
    }
}

/// The number of a contact's law that a parameter is.
fn law_parameter(parameter: Parameter) -> Option<LawParameter> {
    match parameter {
        Parameter::NormalStiffness => Some(LawParameter::Stiffness),
        Parameter::NormalLaw(own) => Some(own),
        _ => None,
    }
}
