//! Cost of an explicit step on the paper's mesh, contact, energies and status included.
//!
//! `cargo bench transient`. Prints, for each operator and instruction set, microseconds a step
//! (the fastest of many batches, so that other load on the machine counts little), nanoseconds an element-step,
//! and the share of the processor's fused multiply-add peak, which it measures first; then bodies without like
//! elements, threads, and what a step of two bodies costs over one of a single body. Without `--bench` (as
//! `cargo test --benches` calls it) it takes ten steps of each on meshes four times coarser.

#[allow(dead_code)]
#[path = "../tests/numerics/two_bodies/model.rs"]
mod two_bodies;

use crate::fma_peak::fma_peak;
use crate::prelude::*;
use crate::{Ignore, is_measured};

/// Batches, of which the fastest counts.
const BATCHES: usize = 240;
/// Node-steps of a batch.
const BATCH: usize = 800_000;

/// Additions and multiplications of one node's step with the stencil: 48 for `K v`, 4 for `K u`, 26 for
/// motion and damping power.
const OPERATIONS_STENCIL: f64 = 78.0;
/// The same with nine 2 x 2 blocks a node: 72 for `K v`.
const OPERATIONS_BLOCKS: f64 = 102.0;

pub fn run() {
    if !is_measured() {
        println!("a trial: ten steps, meshes four times coarser than they are called");
    }
    let peak = fma_peak();
    println!("fused multiply-add peak of one thread: {:.1} Gflop/s", peak / 1e9);
    for (elements, radial) in [(180, 35), (270, 52)] {
        let annulus = mesh(elements, radial);
        println!("\n{elements} x {radial} elements, {} dofs", 2 * annulus.mesh.node_count());
        println!("operator  simd     us/step  ns/element-step  of FMA peak");
        let model = TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, contact(610.0));
        for choice in [OperatorChoice::Cyclic, OperatorChoice::Sparse] {
            for level in [SimdLevel::Scalar, SimdLevel::Avx2, SimdLevel::Avx512] {
                if level.available().is_ok() {
                    report(model, choice, level, peak);
                }
            }
        }
    }
    let (annulus, level) = (mesh(180, 35), SimdLevel::detect());
    let irregular = irregular(&annulus);
    println!("\nno element like another, 180 x 35");
    let even = TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, contact(610.0));
    let uneven = of_mesh(&irregular);
    let alike = report(even, OperatorChoice::Sparse, level, peak);
    let unlike = report(uneven, OperatorChoice::Sparse, level, peak);
    println!("ratio to the annulus {:.2}", unlike / alike);
    threads(level, peak);
    bodies(level, peak);
}

/// Disc and shaft, their nodes in pairs and their meshes not matching, over one ring, for each element.
fn bodies(level: SimdLevel, peak: f64) {
    let one = mesh(180, 35);
    let pairs = AnnulusMesh::generate(&on_shaft(annulus(Quad4, 180, 28), 7)).expect("a valid mesh");
    let apart = two_bodies::rings([170, 186], [7, 28], 0.01);
    let of = |annulus| TransientModel::of_annulus(annulus, &POLYCARBONATE, DAMPING, contact(610.0));
    println!("\none body, nodes in pairs (cyclic, sparse), meshes that do not match");
    let each = |model: TransientModel<'_>, choice| {
        report(model, choice, level, peak) / model.mesh().element_count() as f64
    };
    let [cyclic, sparse] = [OperatorChoice::Cyclic, OperatorChoice::Sparse];
    let alone = [cyclic, sparse].map(|choice| each(of(&one), choice));
    let paired = [cyclic, sparse].map(|choice| each(of(&pairs), choice));
    let unmatched = each(of_mesh(&apart), sparse);
    println!(
        "ratios {:.2}, {:.2}, {:.2}",
        paired[0] / alone[0],
        paired[1] / alone[1],
        unmatched / alone[1]
    );
}

/// 100,000 elements, none like another, on one thread and on two.
fn threads(level: SimdLevel, peak: f64) {
    let irregular = irregular(&mesh(720, 139));
    println!("\nno element like another, 720 x 139, one thread and two");
    let model = of_mesh(&irregular);
    let step = || report(model, OperatorChoice::Sparse, level, peak);
    let times = [1, 2].map(|count| on_threads(count, step));
    println!("ratio {:.2}", times[0] / times[1]);
}

fn mesh(circumferential: usize, radial: usize) -> AnnulusMesh {
    let coarser = if is_measured() { 1 } else { 4 };
    let specification = annulus(Quad4, circumferential / coarser, radial / coarser);
    AnnulusMesh::generate(&specification).expect("a valid mesh")
}

/// The annulus with its inner nodes moved by up to a tenth of an element at random.
fn irregular(annulus: &AnnulusMesh) -> Mesh {
    let mut mesh = annulus.mesh.clone();
    let specification = &annulus.specification;
    let width = specification.outer_radius - specification.inner_radius;
    let reach = 0.1 * width / specification.radial_elements as f64;
    let boundaries = mesh.boundaries.iter().flat_map(|b| &b.nodes);
    let edges: BTreeSet<usize> = boundaries.map(|&node| node as usize).collect();
    for (node, point) in mesh.nodes.iter_mut().enumerate() {
        if !edges.contains(&node) {
            // Multiples of the golden and the plastic ratio are spread evenly.
            let spread = [0.618_033_988_749_895, 0.754_877_666_246_693];
            for (x, ratio) in point.iter_mut().zip(spread) {
                *x += reach * (2.0 * (node as f64 * ratio).fract() - 1.0);
            }
        }
    }
    mesh.congruent_to = (0..mesh.element_count() as u32).collect();
    mesh.is_cyclic = false;
    mesh
}

fn of_mesh(mesh: &Mesh) -> TransientModel<'_> {
    TransientModel::new(
        SteppedBody::Plane { mesh, annulus: None },
        &POLYCARBONATE,
        DAMPING,
        contact(610.0),
    )
}

/// Prints a row; returns the time of a step, s.
fn report(model: TransientModel<'_>, choice: OperatorChoice, level: SimdLevel, peak: f64) -> f64 {
    let mesh = model.mesh();
    let operator = model.operator(choice, level).expect("an operator");
    // Stick, slip and open nodes all occur before the clock starts; a trial needs none of them.
    let lead = if is_measured() { 13.0 } else { 0.2 };
    let (initial, seeds) = (InitialState::SteadySliding, Perturbation::of(&[1, 2], 1.0));
    let times = [lead / mesh.node_count() as f64, 2e-6, 0.0];
    let settings = transient_settings(times, initial, seeds);
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).expect("a start");
    run.run(&mut Ignore).expect("a run");
    let nodes = mesh.node_count() as f64;
    let steps = if is_measured() { (BATCH / mesh.node_count()).max(10) } else { 10 };
    let mut best = f64::INFINITY;
    for _ in 0..if is_measured() { BATCHES } else { 1 } {
        let clock = Instant::now();
        (0..steps).for_each(|_| run.advance());
        best = best.min(clock.elapsed().as_secs_f64() / steps as f64);
    }
    let operations = match operator.name() {
        "cyclic" => OPERATIONS_STENCIL,
        _ => OPERATIONS_BLOCKS,
    };
    println!(
        "{:8}  {:7} {:8.2} {:12.3} {:15.1} %",
        operator.name(),
        level.min(SimdLevel::detect()),
        1e6 * best,
        1e9 * best / mesh.element_count() as f64,
        100.0 * operations * nodes / best / peak,
    );
    best
}
