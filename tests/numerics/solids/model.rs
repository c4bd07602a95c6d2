//! The polycarbonate disc in three dimensions.

use frictionsim::cea::cyclic::SolidModel;
use frictionsim::cea::{ComplexMode, ModeLimit, SweepRequest, cyclic::solid_sweep};
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::{ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{
    AnnulusSpecification, BoundaryCondition, ElementKind, SolidContact, SolidSpecification,
};
use frictionsim::prestress::{DampingModel, TangentOptions};
use std::f64::consts::TAU;

/// Clamped outside, pressed inside by 25 um, 610 rpm, friction 0.3, without geometric stiffness.
pub fn disc(element: ElementKind, [around, radial, axial]: [usize; 3]) -> SolidModel {
    SolidModel {
        specification: SolidSpecification {
            annulus: AnnulusSpecification {
                inner_radius: 0.0205,
                outer_radius: 0.0905,
                circumferential_elements: around,
                radial_elements: radial,
                radial_grading: 1.0,
                element,
                outer: BoundaryCondition::Clamped,
                shaft: None,
            },
            thickness: 0.009,
            axial_elements: axial,
            contact: SolidContact::Inner,
            conditions: [
                BoundaryCondition::Free,
                BoundaryCondition::Clamped,
                BoundaryCondition::Free,
                BoundaryCondition::Free,
            ],
        },
        material: ElasticMaterial {
            young_modulus: 2.5e9,
            poisson_ratio: 0.3805,
            density: 1228.0,
            formulation: PlaneFormulation::ThreeDimensional,
            ..ElasticMaterial::PLAIN
        },
        options: TangentOptions {
            mass: MassKind::Consistent,
            geometric_stiffness: false,
            damping: RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 },
            damping_model: DampingModel::WholeTangent,
            contact: ContactStiffness::default(),
        },
        contact: SlidingContact {
            decay: None,
            friction_coefficient: 0.3,
            interference: 25e-6,
            rotation_speed: 610.0 * TAU / 60.0,
        },
    }
}

/// Modes below a frequency at one friction coefficient.
pub fn modes(model: &SolidModel, friction: f64, limit_hz: f64) -> Vec<ComplexMode> {
    let request = SweepRequest {
        friction_coefficients: &[friction],
        limit: ModeLimit::MaxFrequency(limit_hz),
        shapes_at: &[],
        lefts_at: &[],
        count_modes: false,
    };
    let found = solid_sweep(model, &request).unwrap();
    found.sweep.points.into_iter().next().unwrap().modes
}
