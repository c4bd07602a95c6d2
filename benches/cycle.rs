//! Cost of limit cycles on the mesh of 180 x 35 elements.
//!
//! `cargo bench --bench cycle`. Prints, for one and two nodal diameters, the time to find the cycle at 610 rpm from its
//! birth, the time from a cycle to its neighbour at a speed 2 % higher (fastest of several), and the time of the branch
//! over 61 speeds from 10 to 6000 rpm.

use frictionsim::contact::SlidingContact;
use frictionsim::cycle::{CycleSolver, OperatingPoint, Parameter};
use frictionsim::fem::{ElasticMaterial, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusSpecification, ElementKind};
use std::f64::consts::TAU;
use std::time::Instant;

fn main() {
    let specification = AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 180,
        radial_elements: 35,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
    };
    let material = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
    };
    let point = OperatingPoint {
        contact: SlidingContact {
            friction_coefficient: 0.3,
            interference: 25e-6,
            rotation_speed: 610.0 * TAU / 60.0,
        },
        damping: RayleighDamping {
            mass_coefficient: 40.0,
            stiffness_coefficient: 4.5e-7,
        },
    };
    println!("n  from birth  neighbour  61 speeds  factorizations");
    for harmonic in [1, 2] {
        let solver = CycleSolver::new(&specification, &material, &point.damping, harmonic, None)
            .expect("a valid mesh");
        let start = Instant::now();
        let cycle = solver.find(&point).expect("a limit cycle");
        let birth = start.elapsed();
        let speed = 1.02 * point.contact.rotation_speed;
        let neighbour = (0..5)
            .map(|_| {
                let start = Instant::now();
                solver
                    .continue_to(&cycle, Parameter::RotationSpeed, speed)
                    .expect("a neighbour");
                start.elapsed()
            })
            .min();
        let speeds: Vec<f64> = (0..61)
            .map(|i| 10.0 * 600f64.powf(f64::from(i) / 60.0) * TAU / 60.0)
            .collect();
        let start = Instant::now();
        let branch = solver.follow(&cycle, Parameter::RotationSpeed, &speeds);
        println!(
            "{harmonic}  {birth:.2?}  {:.2?}  {:.2?}  {}",
            neighbour.unwrap_or_default(),
            start.elapsed(),
            branch.factorizations
        );
    }
}
