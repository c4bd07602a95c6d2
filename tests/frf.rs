//! Frequency responses of the finite-element model.

use faer::c64;
use frictionsim::fem::*;
use frictionsim::frf::*;
use frictionsim::mesh::*;
use std::time::Instant;

#[test]
fn timing() {
    faer::set_global_parallelism(faer::Par::Seq);
    let spec = AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 180,
        radial_elements: 35,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
    };
    let annulus = AnnulusMesh::generate(&spec).unwrap();
    let material = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
    };
    let damping = RayleighDamping {
        mass_coefficient: 40.0,
        stiffness_coefficient: 4.5e-7,
    };
    let system = FrfSystem::body(
        &annulus.mesh,
        &material,
        MassKind::Consistent,
        damping,
        false,
    );
    let a = system
        .unknown(
            Terminal {
                node: 35,
                is_tangential: false,
            },
            "force_node",
        )
        .unwrap();
    let t = Instant::now();
    let f: Vec<f64> = (1..=1000).map(|i| 10.0 * f64::from(i)).collect();
    let r = reduced_response(&system, a, a, &f, &ReductionSettings::default());
    println!(
        "reduced {:?} {:?}",
        t.elapsed(),
        r.as_ref()
            .map(|r| (r.largest_error, r.vectors, r.checked_hz.clone()))
    );
    let r = r.unwrap();
    for _ in 0..2 {
        let t = Instant::now();
        let d = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap()
            .install(|| direct_response(&system, a, a, &f[600..620]))
            .unwrap();
        println!("direct 20 {:?}", t.elapsed());
        let worst = d
            .receptance
            .iter()
            .zip(&r.receptance[600..620])
            .map(|(x, y): (&c64, &c64)| (x - y).norm() / x.norm())
            .fold(0.0, f64::max);
        println!("{worst:e}");
    }
}
