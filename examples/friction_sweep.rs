//! Which wave of the paper's disc turns unstable first, and what it grows like at friction 0.3: the
//! sparse solver on the whole mesh.
//!
//! `cargo run --release --example friction_sweep`

use frictionsim::cea::sparse::sweep;
use frictionsim::cea::{ModeLimit, SweepRequest};
use frictionsim::contact::{ContactInterface, ContactStiffness, SlidingContact};
use frictionsim::fem::{ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind};
use frictionsim::prestress::{Assembly, DampingModel, TangentOptions};
use std::error::Error;

/// Solves and prints.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mesh = AnnulusMesh::generate(&AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 90,
        radial_elements: 18,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    })?
    .mesh;
    let polycarbonate = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
        ..ElasticMaterial::PLAIN
    };
    let contact = SlidingContact {
        decay: None,
        friction_coefficient: 0.3,
        interference: 25e-6,
        rotation_speed: 63.9,
    };
    let options = TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: true,
        damping: RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 },
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness { normal_stiffness: Some(7.4e12), ..ContactStiffness::default() },
    };
    let body = Assembly::of_edge(&mesh, &polycarbonate, &contact, options.contact)?;
    let base = body.state(0.3)?;
    let torque = ContactInterface::of(&mesh).torque(&contact, 0.3, &base.normal_forces(0.3));
    println!("torque {torque:.1} N m for each metre of thickness");
    let tangent = body.tangent(&base, &options)?;
    let request = SweepRequest::new(&[0.0, 0.1, 0.2, 0.3], ModeLimit::Lowest(10));
    let found = sweep(&tangent, &request, &|_| {})?;
    for interval in &found.intervals {
        println!(
            "n = {}, branch {}: unstable from friction {:.4} at {:.1} Hz",
            interval.harmonic, interval.branch, interval.critical_friction, interval.frequency_hz
        );
    }
    for mode in found.points[3].modes.iter().filter(|mode| mode.is_unstable()) {
        println!(
            "at 0.3: {:.1} Hz grows at {:.1} 1/s, residual {:.0e}",
            mode.frequency_hz(),
            mode.growth_rate(),
            mode.residual
        );
    }
    // The wave of one nodal diameter on the second branch comes first, near friction 0.12.
    let first = &found.intervals[0];
    assert_eq!((first.harmonic, first.branch, first.direction), (1, 2, -1));
    Ok(())
}
