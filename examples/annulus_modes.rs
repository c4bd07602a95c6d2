//! Undamped modes of a clamped annulus whose inner edge slides on a rigid cylinder, without friction.
//!
//! `cargo run --release --example annulus_modes`

use frictionsim::cea::cyclic::sweep;
use frictionsim::cea::{ModeLimit, SweepRequest};
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::{ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusSpecification, BoundaryCondition, ElementKind};
use frictionsim::prestress::{DampingModel, TangentOptions};
use std::error::Error;

/// Solves and prints.
pub fn main() -> Result<(), Box<dyn Error>> {
    let annulus = AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 120,
        radial_elements: 24,
        radial_grading: 1.0,
        element: ElementKind::Quad8,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    };
    let polycarbonate = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.38,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
        ..ElasticMaterial::PLAIN
    };
    let options = TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: false,
        damping: RayleighDamping::default(),
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness::default(),
    };
    let contact = SlidingContact {
        decay: None,
        friction_coefficient: 0.0,
        interference: 25e-6,
        rotation_speed: 1.0,
    };
    let request = SweepRequest::new(&[0.0], ModeLimit::Lowest(12));
    let found = sweep(&annulus, &polycarbonate, &options, &contact, &request)?;
    println!("{:>3} {:>6} {:>12}", "n", "branch", "Hz");
    for mode in &found.sweep.points[0].modes {
        println!("{:>3} {:>6} {:>12.2}", mode.harmonic, mode.branch, mode.frequency_hz());
    }
    // The first mode is torsion, n = 0; its exact continuum frequency is 5856.38 Hz.
    let first = found.sweep.points[0].modes[0].frequency_hz();
    assert!((first / 5856.38 - 1.0).abs() < 1e-5, "{first}");
    Ok(())
}
