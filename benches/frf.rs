//! Cost of frequency responses of the disc of 180 x 35 elements at 1000 frequencies, one thread.
//!
//! `cargo bench frf`. Matrices and meshes are made outside the measured time. Without `--bench` (as `cargo test
//! --benches` calls it) it takes 60 x 11 elements at 50 frequencies.

use crate::is_measured;
use divan::Bencher;
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::{ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping};
use frictionsim::frf::{
    CyclicSystem, Direction, FrfSystem, Port, Terminal, cyclic_response, direct_response,
    reduced_response,
};
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind, Strip};
use frictionsim::prestress::{Assembly, DampingModel, TangentOptions, WaveTangent};

fn specification() -> AnnulusSpecification {
    let (circumferential_elements, radial_elements) =
        if is_measured() { (180, 35) } else { (60, 11) };
    AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements,
        radial_elements,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    }
}

const MATERIAL: ElasticMaterial = ElasticMaterial {
    young_modulus: 2.5e9,
    poisson_ratio: 0.3805,
    density: 1228.0,
    formulation: PlaneFormulation::PlaneStrain,
    ..ElasticMaterial::PLAIN
};
const DAMPING: RayleighDamping =
    RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 };
const CONTACT: SlidingContact = SlidingContact {
    decay: None,
    friction_coefficient: 0.3,
    interference: 25e-6,
    rotation_speed: 63.9,
};
const FORCE: Terminal = Terminal { node: 5, direction: Direction::Radial };
/// In the middle of the ring.
fn response() -> Terminal {
    let node = if is_measured() { 36 * 40 + 20 } else { 12 * 10 + 5 };
    Terminal { node, direction: Direction::Tangential }
}

fn options() -> TangentOptions {
    TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: true,
        damping: DAMPING,
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness { normal_stiffness: Some(7.4e12), ..ContactStiffness::default() },
    }
}

fn cyclic_system(boundary: &str) -> CyclicSystem {
    let sector = Strip::of_annulus(&specification()).expect("a valid mesh");
    if boundary == "sliding" {
        let tangent = WaveTangent::of_annulus(&sector, &MATERIAL, &options(), &CONTACT)
            .expect("contact stays closed");
        return CyclicSystem::sliding(&tangent, CONTACT.friction_coefficient);
    }
    let mass = MassKind::Consistent;
    CyclicSystem::body(&sector, &MATERIAL, mass, DAMPING, boundary == "clamped")
}

fn whole_system(boundary: &str) -> FrfSystem {
    let annulus = AnnulusMesh::generate(&specification()).expect("a valid mesh");
    if boundary == "sliding" {
        let options = options();
        let body = Assembly::of_edge(&annulus.mesh, &MATERIAL, &CONTACT, options.contact);
        let tangent = body.and_then(|body| body.tangent(&body.state(0.3)?, &options));
        let tangent = tangent.expect("contact stays closed");
        return FrfSystem::sliding(&tangent, CONTACT.friction_coefficient);
    }
    let mass = MassKind::Consistent;
    FrfSystem::body(&annulus.mesh, &MATERIAL, mass, DAMPING, boundary == "clamped")
}

fn ports(system: &FrfSystem) -> [Port; 2] {
    let mesh = AnnulusMesh::generate(&specification()).expect("a valid mesh").mesh;
    [FORCE, response()].map(|own| system.port(&mesh, None, own, "node").expect("a free node"))
}

fn frequencies() -> Vec<f64> {
    let count = if is_measured() { 1000 } else { 50 };
    (1..=count).map(|line| 10.0 * f64::from(line)).collect()
}

fn on_one_thread<T: Send>(work: impl Fn() -> T + Sync + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread can be started").install(work)
}

/// Every circumferential harmonic.
#[divan::bench(args = ["free", "clamped", "sliding"], max_time = 4)]
fn cyclic(bencher: Bencher<'_, '_>, boundary: &str) {
    let (system, f) = (cyclic_system(boundary), frequencies());
    bencher.bench(|| on_one_thread(|| cyclic_response(&system, FORCE, response(), &f).unwrap()));
}

/// Sparse solution of the whole mesh.
#[divan::bench(args = ["free", "clamped", "sliding"], sample_count = 1)]
fn direct(bencher: Bencher<'_, '_>, boundary: &str) {
    let (system, f) = (whole_system(boundary), frequencies());
    let [force, response] = ports(&system);
    bencher.bench(|| {
        on_one_thread(|| direct_response(&system, &force, &response, &f, &|_| {}).unwrap())
    });
}

/// Rational Krylov reduction.
#[divan::bench(args = ["free", "clamped", "sliding"], max_time = 4)]
fn reduced(bencher: Bencher<'_, '_>, boundary: &str) {
    let (system, f) = (whole_system(boundary), frequencies());
    let [force, response] = ports(&system);
    bencher.bench(|| on_one_thread(|| reduced_response(&system, &force, &response, &f).unwrap()));
}
