//! Terms of the tangent matrices of an annulus.

use super::{SectorSliding, TangentOptions};
use crate::fem::MaterialField;
use crate::fem::fold::SectorMatrix;
use crate::fem::sector;
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use crate::mesh::SectorMesh;

/// A matrix that depends on the friction coefficient, `P(mu) = sum_p P_p (i mu)^p` with real `P_p`.
pub type FrictionPolynomial = Vec<BandedMatrix>;

/// `P(z)`, `z = i mu`.
pub fn evaluate(polynomial: &FrictionPolynomial, z: c64) -> Vec<c64> {
    let mut values: Vec<c64> = polynomial[0].values().iter().map(|v| c64::new(*v, 0.0)).collect();
    let mut power = z;
    for coefficient in &polynomial[1..] {
        for (value, v) in values.iter_mut().zip(coefficient.values()) {
            *value += power * *v;
        }
        power *= z;
    }
    values
}

/// What the matrices are made of.
#[derive(Clone, Debug)]
pub(super) struct Terms {
    pub(super) elastic: SectorMatrix,
    /// Springs and dashpots of the supported edges.
    pub(super) supports: [SectorMatrix; 2],
    /// Damping that a body has beyond that of the whole.
    pub(super) own_damping: SectorMatrix,
    pub(super) mass: SectorMatrix,
    /// Stress of the pressed state and, for each unit of friction, of the sheared state.
    pub(super) stress: Option<[SectorMatrix; 2]>,
    /// `N / a` of each contact node, zero without geometric stiffness.
    pub(super) turning: Vec<f64>,
    /// `k_n w` of each contact node; `None` for rigid contact.
    pub(super) normal_stiffness: Option<Vec<f64>>,
    /// `N mu'(V) / mu` of each contact node; `None` where friction does not depend on the speed.
    pub(super) friction_dashpots: Option<Vec<f64>>,
}

/// `N` of each contact node times `slope`; `None` without one.
pub(super) fn friction_dashpots(base: &SectorSliding, slope: f64) -> Option<Vec<f64>> {
    let forces = base.normal_forces.iter().map(|force| slope * force);
    (slope != 0.0).then(|| forces.collect())
}

/// Geometric stiffness of the pressed and of the sheared state.
pub(super) fn stress_stiffness(
    sector: &SectorMesh,
    material: &dyn MaterialField,
    base: &SectorSliding,
) -> [SectorMatrix; 2] {
    [&base.pressed_displacement, &base.sheared_displacement]
        .map(|displacement| sector::geometric_stiffness(sector, material, displacement))
}

/// `N / a` of each contact node, zero where the prestress does not act back.
pub(super) fn turning(
    sector: &SectorMesh,
    options: &TangentOptions,
    base: &SectorSliding,
) -> Vec<f64> {
    let radius = sector.specification.inner_radius;
    let factor = if options.geometric_stiffness { 1.0 } else { 0.0 };
    base.normal_forces.iter().map(|force| factor * force / radius).collect()
}

pub(super) fn multiplied(mut polynomial: FrictionPolynomial, factor: f64) -> FrictionPolynomial {
    for coefficient in &mut polynomial {
        coefficient.scale(factor);
    }
    polynomial
}

pub(super) fn sum(mut a: FrictionPolynomial, b: FrictionPolynomial) -> FrictionPolynomial {
    for (power, term) in b.into_iter().enumerate() {
        match a.get_mut(power) {
            Some(total) => total.add_scaled(1.0, &term),
            None => a.push(term),
        }
    }
    a
}
