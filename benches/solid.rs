//! Three dimensions: cost of an explicit step and of the eigenvalues of a disc of 180 x 35 x 4 bricks of 8 nodes, one thread.
//!
//! `cargo bench --bench solid`. Prints, for each instruction set, microseconds a step (the fastest of many batches, so that
//! other load on the machine counts little), nanoseconds a brick, how many times the floor of the stencil that is, and the share
//! of the processor's fused multiply-add peak, which it measures first; then the time of 30 modes at 21 friction values.
//! Without `--bench` (as `cargo test --benches` calls it) everything is done once, on a small mesh.

#[path = "../tests/common/fma_peak.rs"]
mod fma_peak;
#[allow(dead_code)]
#[path = "../tests/numerics/solids/model.rs"]
mod model;

use fma_peak::fma_peak;
use frictionsim::cea::cyclic::{SolidModel, solid_sweep};
use frictionsim::cea::{ModeLimit, SweepRequest};
use frictionsim::fem::operator::SimdLevel;
use frictionsim::mesh::{ElementKind, SolidSector};
use frictionsim::transient::{
    CentralDifference, InitialState, Observer, OperatorChoice, Perturbation, Sample,
    SolidTransientModel, TimeStep, TransientSettings,
};
use std::ops::ControlFlow;
use std::time::Instant;

/// Node-steps of a batch.
const BATCH: usize = 800_000;

/// The floor of the stencil: 27 blocks of 3 x 3 a node, a multiplication and an addition for each entry.
const FLOOR: f64 = 2.0 * 243.0;
/// Additions and multiplications of one node's step: nine couplings of 34 for `K v` (mirror images share products), 6 for
/// `K u`, 39 for motion and damping power.
const OPERATIONS: f64 = 9.0 * 34.0 + 6.0 + 39.0;

struct Ignore;

impl Observer for Ignore {
    fn observe(&mut self, _: &Sample<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

fn main() {
    let is_measured = std::env::args().any(|argument| argument == "--bench");
    let (divisions, batches) = match is_measured {
        true => ([180, 35, 4], 100),
        false => ([36, 7, 2], 1),
    };
    let peak = fma_peak();
    println!(
        "fused multiply-add peak of one thread: {:.1} Gflop/s",
        peak / 1e9
    );
    let [around, radial, axial] = divisions;
    println!("{around} x {radial} x {axial} bricks");
    println!("simd     us/step  ns/brick-step  of the floor  of FMA peak");
    for level in [SimdLevel::Scalar, SimdLevel::Avx2, SimdLevel::Avx512] {
        if level.available().is_ok() {
            step(divisions, level, (batches, peak));
        }
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let samples = if is_measured { 5 } else { 1 };
    let best = pool
        .expect("a thread")
        .install(|| (0..samples).map(|_| eigenvalues(divisions)))
        .fold(f64::INFINITY, f64::min);
    println!("30 modes at 21 friction values: {:.0} ms", 1e3 * best);
}

/// Prints a row.
fn step(divisions: [usize; 3], level: SimdLevel, (batches, peak): (usize, f64)) {
    let model = model::disc(ElementKind::Quad4, divisions);
    let sector = SolidSector::generate(&model.specification).expect("a valid mesh");
    let body = SolidTransientModel {
        sector: &sector,
        material: &model.material,
        damping: model.options.damping,
        contact: model.contact,
        stiffness: model.options.contact,
    };
    let operator = body.operator(OperatorChoice::Auto, level);
    let operator = operator.expect("an operator");
    let settings = TransientSettings {
        duration: 4e-5,
        time_step: TimeStep::Auto,
        sample_interval: 2e-6,
        expansion_time: 0.0,
        initial: InitialState::SteadySliding,
        perturbation: Perturbation::of(&[1, 2], 1.0),
    };
    let mut run = CentralDifference::start(body, operator.as_ref(), &settings).expect("a start");
    // Stick, slip and open nodes all occur before the clock starts.
    run.run(&mut Ignore).expect("a run");
    let nodes = (sector.node_count() * sector.sector_count()) as f64;
    let steps = (BATCH / nodes as usize).max(10);
    let mut best = f64::INFINITY;
    for _ in 0..batches {
        let clock = Instant::now();
        (0..steps).for_each(|_| run.advance());
        best = best.min(clock.elapsed().as_secs_f64() / steps as f64);
    }
    let bricks: usize = divisions.iter().product();
    println!(
        "{:7} {:8.1} {:14.2} {:13.2} {:12.1} %",
        operator.simd(),
        1e6 * best,
        1e9 * best / bricks as f64,
        best * peak / (FLOOR * nodes),
        100.0 * OPERATIONS * nodes / best / peak,
    );
}

/// Time of 30 modes with prestress at 21 friction coefficients from 0 to 1, s.
fn eigenvalues(divisions: [usize; 3]) -> f64 {
    let mut model: SolidModel = model::disc(ElementKind::Quad4, divisions);
    model.options.geometric_stiffness = true;
    let frictions: Vec<f64> = (0..21).map(|i| f64::from(i) / 20.0).collect();
    let request = SweepRequest {
        friction_coefficients: &frictions,
        limit: ModeLimit::Lowest(30),
        shapes_at: &[],
    };
    let clock = Instant::now();
    let found = solid_sweep(&model, &request).expect("the disc can be solved");
    assert!(
        found
            .sweep
            .points
            .iter()
            .all(|point| point.modes.len() >= 30)
    );
    clock.elapsed().as_secs_f64()
}
