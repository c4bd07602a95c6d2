//! The disc of Brunetti et al.

use frictionsim::cea::cyclic::{CyclicSweep, ModeLimit, SweepRequest, sweep};
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::{ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusSpecification, ElementKind};
use frictionsim::prestress::{DampingModel, TangentOptions};
use std::f64::consts::PI;

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
    }
}

pub fn polycarbonate() -> ElasticMaterial {
    ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
    }
}

pub fn paper_options() -> TangentOptions {
    TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: true,
        damping: RayleighDamping {
            mass_coefficient: 40.0,
            stiffness_coefficient: 4.5e-7,
        },
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness {
            normal_stiffness: Some(7.4e12),
            normal_damping: 0.0,
            tangential_damping: 0.0,
        },
    }
}

pub fn paper_contact() -> SlidingContact {
    SlidingContact {
        friction_coefficient: 0.3,
        interference: 25e-6,
        rotation_speed: 610.0 * PI / 30.0,
    }
}

pub fn run(
    specification: &AnnulusSpecification,
    options: &TangentOptions,
    frictions: &[f64],
    limit: ModeLimit,
) -> CyclicSweep {
    let request = SweepRequest {
        friction_coefficients: frictions,
        limit,
        shapes_at: &[],
    };
    sweep(
        specification,
        &polycarbonate(),
        options,
        &paper_contact(),
        &request,
    )
    .unwrap()
}
