//! Cost of limit cycles on the mesh of 180 x 35 elements.
//!
//! `cargo bench --bench cycle`. Prints, for one and two nodal diameters, the time to find the cycle at 610 rpm from its
//! birth, the time from a cycle to a neighbour at a speed 2 % higher or 20 % lower (fastest of several), that of its
//! stability, and the time of the branch over 61 speeds from 10 to 6000 rpm.

use frictionsim::contact::SlidingContact;
use frictionsim::cycle::{CycleSolver, OperatingPoint, Parameter};
use frictionsim::fem::{ElasticMaterial, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusSpecification, BoundaryCondition, ElementKind};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

fn main() {
    // As the program has it: factorizations are small.
    faer::set_global_parallelism(faer::Par::Seq);
    let specification = AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 180,
        radial_elements: 35,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    };
    let material = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
        ..ElasticMaterial::PLAIN
    };
    let point = OperatingPoint {
        contact: SlidingContact {
            decay: None,
            friction_coefficient: 0.3,
            interference: 25e-6,
            rotation_speed: 610.0 * TAU / 60.0,
        },
        damping: RayleighDamping {
            mass_coefficient: 40.0,
            stiffness_coefficient: 4.5e-7,
        },
    };
    println!("n  from birth  +2 %  -20 %  stability  61 speeds  factorizations");
    for harmonic in [1, 2] {
        let solver = CycleSolver::new(&specification, &material, &point.damping, harmonic, None)
            .expect("a valid mesh");
        let start = Instant::now();
        let cycle = solver.find(&point).expect("a limit cycle");
        let birth = start.elapsed();
        let neighbour = |factor: f64| {
            let speed = factor * point.contact.rotation_speed;
            fastest(|| {
                let found = solver.continue_to(&cycle, Parameter::RotationSpeed, speed);
                found.expect("a neighbour");
            })
        };
        let (near, far) = (neighbour(1.02), neighbour(0.8));
        let stability = fastest(|| {
            solver.stability(&cycle).expect("exponents");
        });
        let speeds: Vec<f64> = (0..61)
            .map(|i| 10.0 * 600f64.powf(f64::from(i) / 60.0) * TAU / 60.0)
            .collect();
        let start = Instant::now();
        let branch = solver.follow(&cycle, Parameter::RotationSpeed, &speeds);
        println!(
            "{harmonic}  {birth:.2?}  {near:.2?}  {far:.2?}  {stability:.2?}  {:.2?}  {}",
            start.elapsed(),
            branch.factorizations
        );
    }
}

fn fastest(mut work: impl FnMut()) -> Duration {
    let times = (0..5).map(|_| {
        let start = Instant::now();
        work();
        start.elapsed()
    });
    times.min().unwrap_or_default()
}
