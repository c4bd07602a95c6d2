//! Cost of frequency responses of the disc of 180 x 35 elements at 1000 frequencies, one thread.
//!
//! `cargo bench frf`. Matrices and meshes are made outside the measured time. Without `--bench` (as `cargo test
//! --benches` calls it) it takes 60 x 11 elements at 50 frequencies.

use crate::is_measured;
use crate::prelude::*;
use divan::Bencher;

const RADIAL: Terminal = Terminal { node: 5, direction: Direction::Radial };

fn specification() -> AnnulusSpecification {
    if is_measured() { annulus(Quad4, 180, 35) } else { annulus(Quad4, 60, 11) }
}

/// In the middle of the ring.
fn response() -> Terminal {
    at_node(if is_measured() { 36 * 40 + 20 } else { 12 * 10 + 5 }, true)
}

fn options() -> TangentOptions {
    TangentOptions { geometric_stiffness: true, contact: compliant(7.4e12, [0.0; 2]), ..TANGENT }
}

fn cyclic_system(boundary: &str) -> CyclicSystem {
    let sector = Strip::of_annulus(&specification()).expect("a valid mesh");
    if boundary == "sliding" {
        let tangent = WaveTangent::of_annulus(&sector, &POLYCARBONATE, &options(), &contact(610.0));
        return CyclicSystem::sliding(&tangent.expect("contact stays closed"), 0.3);
    }
    let is_held = boundary == "clamped";
    let free = WaveTangent::of_free(&sector, &POLYCARBONATE, Consistent, DAMPING, is_held);
    CyclicSystem::sliding(&free, 0.0)
}

fn whole_system(boundary: &str) -> FrfSystem {
    let annulus = AnnulusMesh::generate(&specification()).expect("a valid mesh");
    if boundary == "sliding" {
        let tangent = linearized(&annulus.mesh, &POLYCARBONATE, &contact(610.0), &options());
        return FrfSystem::sliding(&tangent, 0.3);
    }
    FrfSystem::body(&annulus.mesh, &POLYCARBONATE, Consistent, DAMPING, boundary == "clamped")
}

fn ports(system: &FrfSystem) -> [Port; 2] {
    let mesh = AnnulusMesh::generate(&specification()).expect("a valid mesh").mesh;
    [RADIAL, response()].map(|own| system.port(&mesh, None, own, "node").expect("a free node"))
}

fn frequencies() -> Vec<f64> {
    let count = if is_measured() { 1000 } else { 50 };
    (1..=count).map(|line| 10.0 * f64::from(line)).collect()
}

/// Every circumferential harmonic.
#[divan::bench(args = ["free", "clamped", "sliding"], max_time = 4)]
fn cyclic(bencher: Bencher<'_, '_>, boundary: &str) {
    let (system, f) = (cyclic_system(boundary), frequencies());
    bencher.bench(|| on_threads(1, || cyclic_response(&system, RADIAL, response(), &f).unwrap()));
}

/// Sparse solution of the whole mesh.
#[divan::bench(args = ["free", "clamped", "sliding"], sample_count = 1)]
fn direct(bencher: Bencher<'_, '_>, boundary: &str) {
    let (system, f) = (whole_system(boundary), frequencies());
    let [force, response] = ports(&system);
    bencher.bench(|| {
        on_threads(1, || direct_response(&system, &force, &response, &f, &|_| {}).unwrap())
    });
}

/// Rational Krylov reduction.
#[divan::bench(args = ["free", "clamped", "sliding"], max_time = 4)]
fn reduced(bencher: Bencher<'_, '_>, boundary: &str) {
    let (system, f) = (whole_system(boundary), frequencies());
    let [force, response] = ports(&system);
    bencher.bench(|| on_threads(1, || reduced_response(&system, &force, &response, &f).unwrap()));
}
