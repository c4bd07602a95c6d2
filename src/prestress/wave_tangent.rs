//! The linearisation of a body that is solved harmonic by harmonic.

use super::{
    HarmonicTangent, MovingHarmonic, SectorTangent, SolidHarmonic, SolidTangent, evaluate,
};
use crate::linalg::c64;

/// The tangent of one sector of a body.
#[derive(Clone, Debug)]
pub enum WaveTangent {
    /// Of a plane annulus.
    Plane(Box<SectorTangent>),
    /// Of a body of revolution in three dimensions.
    Solid(Box<SolidTangent>),
}

/// The matrices of one of its harmonics by powers of the friction coefficient.
pub enum WaveHarmonic {
    /// Of a plane annulus.
    Plane(Box<HarmonicTangent>),
    /// Of a body of revolution in three dimensions.
    Solid(Box<SolidHarmonic>),
}

impl WaveTangent {
    /// The matrices of harmonic `n`.
    pub fn harmonic(&self, n: usize) -> WaveHarmonic {
        match self {
            Self::Plane(tangent) => WaveHarmonic::Plane(Box::new(tangent.harmonic(n))),
            Self::Solid(tangent) => WaveHarmonic::Solid(Box::new(tangent.harmonic(n))),
        }
    }

    /// Sense of the friction force, +1 or -1.
    pub fn sliding_direction(&self) -> f64 {
        match self {
            Self::Plane(tangent) => tangent.base().sliding_direction,
            Self::Solid(tangent) => tangent.base().sliding_direction,
        }
    }

    /// Whether each ring of the contact is pressed; nothing of an annulus, which is pressed all around.
    pub fn pressed(&self) -> &[bool] {
        match self {
            Self::Plane(_) => &[],
            Self::Solid(tangent) => &tangent.base().is_pressed,
        }
    }
}

impl WaveHarmonic {
    /// The matrices at a friction coefficient.
    pub fn at(&self, friction_coefficient: f64) -> MovingHarmonic {
        match self {
            Self::Plane(harmonic) => harmonic.at(friction_coefficient),
            Self::Solid(harmonic) => harmonic.at(friction_coefficient),
        }
    }
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
                mass.iter().zip(&stiffness).map(|(m, k)| m * alpha + k * beta).collect()
            }
        };
        if let Some(dashpots) = &self.friction_dashpots {
            let added = evaluate(dashpots, z);
            damping.iter_mut().zip(added).for_each(|(sum, c)| *sum += c * mu);
        }
        let half_bandwidth = self.mass[0].half_bandwidth();
        MovingHarmonic { half_bandwidth, mass, damping, stiffness }
    }
}

impl MovingHarmonic {
    /// A sum of matrices of the same unknowns, each with its weight; `None` where the unknowns differ.
    pub fn combined(terms: &[(f64, Self)]) -> Option<Self> {
        let (weight, first) = terms.first()?;
        let size = (first.half_bandwidth, first.mass.len());
        let is_like = |(_, own): &(f64, Self)| (own.half_bandwidth, own.mass.len()) == size;
        if !terms.iter().all(is_like) {
            return None;
        }
        let sum = |of: fn(&Self) -> &Vec<c64>| {
            let mut sum: Vec<c64> = of(first).iter().map(|v| v * *weight).collect();
            for (weight, term) in &terms[1..] {
                sum.iter_mut().zip(of(term)).for_each(|(sum, v)| *sum += v * *weight);
            }
            sum
        };
        Some(Self {
            half_bandwidth: first.half_bandwidth,
            mass: sum(|own| &own.mass),
            damping: sum(|own| &own.damping),
            stiffness: sum(|own| &own.stiffness),
        })
    }
}
