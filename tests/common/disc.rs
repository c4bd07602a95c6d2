//! The paper's disc: geometry, material, damping and contact. Poisson's ratio and density are a fit to its Table 1.

use frictionsim::contact::SlidingContact;
use frictionsim::fem::{ElasticMaterial, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusSpecification, BoundaryCondition, ElementKind};
use std::f64::consts::PI;

pub const POLYCARBONATE: ElasticMaterial = ElasticMaterial {
    young_modulus: 2.5e9,
    poisson_ratio: 0.3805,
    density: 1228.0,
    formulation: PlaneFormulation::PlaneStrain,
    ..ElasticMaterial::PLAIN
};

pub const DAMPING: RayleighDamping =
    RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 };

/// An even mesh of the disc.
pub fn annulus(
    element: ElementKind,
    circumferential: usize,
    radial: usize,
) -> AnnulusSpecification {
    AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: circumferential,
        radial_elements: radial,
        radial_grading: 1.0,
        element,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    }
}

/// The cylinder at friction coefficient 0.3.
pub fn contact(rotation_speed_rpm: f64) -> SlidingContact {
    SlidingContact {
        decay: None,
        friction_coefficient: 0.3,
        interference: 25e-6,
        rotation_speed: rotation_speed_rpm * PI / 30.0,
    }
}
