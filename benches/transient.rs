//! Cost of an explicit step on the paper's mesh, contact, energies and status included.
//!
//! `cargo bench --bench transient`. Prints, for each operator and instruction set, microseconds a step
//! (the fastest of many batches, so that other load on the machine counts little), nanoseconds an element-step,
//! and the share of the processor's fused multiply-add peak, which it measures first.

#[path = "../tests/common/disc.rs"]
mod disc;

use disc::{DAMPING, POLYCARBONATE, annulus, contact};
use frictionsim::fem::operator::SimdLevel;
use frictionsim::mesh::{AnnulusMesh, ElementKind};
use frictionsim::transient::{
    CentralDifference, InitialState, Observer, OperatorChoice, Perturbation, Sample, TimeStep,
    TransientModel, TransientSettings, build_operator,
};
use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

const STEPS: u32 = 500;
const BATCHES: usize = 60;

/// Additions and multiplications of one node's step with the stencil: 48 for `K v`, 4 for `K u`, 26 for
/// motion and damping power.
const OPERATIONS_STENCIL: f64 = 78.0;
/// The same with nine 2 x 2 blocks a node: 72 for `K v`.
const OPERATIONS_BLOCKS: f64 = 102.0;

struct Ignore;

impl Observer for Ignore {
    fn observe(&mut self, _: &Sample<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

fn main() {
    let peak = fma_peak();
    println!(
        "fused multiply-add peak of one thread: {:.1} Gflop/s",
        peak / 1e9
    );
    for (elements, radial) in [(180, 35), (270, 52)] {
        let annulus = mesh(elements, radial);
        println!(
            "\n{elements} x {radial} elements, {} dofs",
            2 * annulus.mesh.node_count()
        );
        println!("operator  simd     us/step  ns/element-step  of FMA peak");
        for choice in [OperatorChoice::Cyclic, OperatorChoice::Sparse] {
            for level in [SimdLevel::Scalar, SimdLevel::Avx2, SimdLevel::Avx512] {
                if level.available().is_ok() {
                    report(&annulus, choice, level, peak);
                }
            }
        }
    }
}

fn mesh(circumferential: usize, radial: usize) -> AnnulusMesh {
    let specification = annulus(ElementKind::Quad4, circumferential, radial);
    AnnulusMesh::generate(&specification).expect("a valid mesh")
}

fn report(annulus: &AnnulusMesh, choice: OperatorChoice, level: SimdLevel, peak: f64) {
    let model = TransientModel::of_annulus(annulus, &POLYCARBONATE, DAMPING, contact(610.0));
    let operator = build_operator(&model, choice, level).expect("an operator");
    let sample_interval = 2e-6;
    let mut settings = TransientSettings {
        duration: 1.0,
        time_step: TimeStep::Auto,
        sample_interval,
        expansion_time: 5e-4,
        initial: InitialState::SteadySliding,
        perturbation: Perturbation::of(&[1, 2], 1.0),
    };
    settings.duration = 0.002;
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).expect("a start");
    // Stick, slip and open nodes all occur before the clock starts.
    run.run(&mut Ignore).expect("a run");
    let mut best = f64::INFINITY;
    for _ in 0..BATCHES {
        let clock = Instant::now();
        (0..STEPS).for_each(|_| run.advance());
        best = best.min(clock.elapsed().as_secs_f64() / f64::from(STEPS));
    }
    let operations = match operator.name() {
        "cyclic" => OPERATIONS_STENCIL,
        _ => OPERATIONS_BLOCKS,
    };
    let nodes = annulus.mesh.node_count() as f64;
    println!(
        "{:8}  {:7} {:8.2} {:12.3} {:15.1} %",
        operator.name(),
        operator.simd(),
        1e6 * best,
        1e9 * best / annulus.mesh.element_count() as f64,
        100.0 * operations * nodes / best / peak,
    );
}

/// Fused multiply-adds a second of one thread, times two: the widest vectors of this processor, enough
/// independent sums to fill its pipelines.
fn fma_peak() -> f64 {
    const ROUNDS: usize = 100_000;
    const SUMS: usize = 96;
    #[inline(always)]
    fn body(x: f64, fused: bool) -> [f64; SUMS] {
        let mut sums = [0.5_f64; SUMS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = if fused {
                    sum.mul_add(x, 1.0)
                } else {
                    *sum * x + 1.0
                };
            }
        }
        sums
    }
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
    unsafe fn wide(x: f64) -> [f64; SUMS] {
        body(x, true)
    }
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn narrow(x: f64) -> [f64; SUMS] {
        body(x, true)
    }
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let clock = Instant::now();
        let x = black_box(0.999);
        let sums = match SimdLevel::detect() {
            // SAFETY: the processor has these instructions.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx512 => unsafe { wide(x) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 => unsafe { narrow(x) },
            _ => body(x, false),
        };
        black_box(sums);
        best = best.min(clock.elapsed().as_secs_f64());
    }
    2.0 * (ROUNDS * SUMS) as f64 / best
}
