//! Three dimensions: cost of an explicit step and of the eigenvalues of a disc of 180 x 35 x 4 bricks of 8 nodes, one thread.
//!
//! `cargo bench solid`. Prints, for each instruction set, microseconds a step (the fastest of many batches, so that
//! other load on the machine counts little), nanoseconds a brick, how many times the floor of the stencil that is, and the share
//! of the processor's fused multiply-add peak, which it measures first; then the time of 30 modes at 21 friction values; then a
//! step of a body from a mesh file on one thread and on two, with the bandwidth that its bytes take of the memory's.
//! Without `--bench` (as `cargo test --benches` calls it) everything is done once, on a small mesh.

#[allow(dead_code)]
#[path = "../tests/numerics/solids/model.rs"]
mod model;

use crate::fma_peak::fma_peak;
use crate::prelude::*;
use crate::{Ignore, is_measured};
use frictionsim::fem::operator::{
    MotionFields, SparseOperator, StepCoefficients, StiffnessOperator,
};
use rayon::prelude::*;
use std::hint::black_box;

/// Node-steps of a batch.
const BATCH: usize = 800_000;

/// The floor of the stencil: 27 blocks of 3 x 3 a node, a multiplication and an addition for each entry.
const FLOOR: f64 = 2.0 * 243.0;
/// Additions and multiplications of one node's step: nine couplings of 34 for `K v` (mirror images share products), 6 for
/// `K u`, 39 for motion and damping power.
const OPERATIONS: f64 = 9.0 * 34.0 + 6.0 + 39.0;

pub fn run() {
    let (divisions, batches) = if is_measured() { ([180, 35, 4], 100) } else { ([36, 7, 2], 1) };
    let peak = fma_peak();
    println!("fused multiply-add peak of one thread: {:.1} Gflop/s", peak / 1e9);
    let [around, radial, axial] = divisions;
    println!("{around} x {radial} x {axial} bricks");
    println!("simd     us/step  ns/brick-step  of the floor  of FMA peak");
    for level in [SimdLevel::Scalar, SimdLevel::Avx2, SimdLevel::Avx512] {
        if level.available().is_ok() {
            step(divisions, level, (batches, peak));
        }
    }
    let samples = 0..if is_measured() { 5 } else { 1 };
    let best =
        on_threads(1, || samples.map(|_| eigenvalues(divisions)).fold(f64::INFINITY, f64::min));
    println!("30 modes at 21 friction values: {:.0} ms", 1e3 * best);
    let divisions = if is_measured() { 40 } else { 6 };
    println!("threads  ms/step    GB/s  GB/s of reading memory");
    for threads in [1, 2] {
        assembled(divisions, threads);
    }
}

/// Prints a row: the step of a cube of bricks in a mesh file, without contact.
fn assembled(divisions: usize, threads: usize) {
    let cube = brick("cube", [0.0; 3], [0.1; 3], [divisions; 3]);
    let mesh = mesh_of(&file_of(&[cube], |point| point), &[]);
    let stiffness = assemble_stiffness(&mesh, &STEEL);
    let masses = lumped_masses(&mesh, &STEEL).iter().flat_map(|&mass| [mass; 3]).collect();
    let operator = SparseOperator::<3>::new(&stiffness, masses, Vec::new(), SimdLevel::detect());
    let operator = operator.expect("an operator");
    let mut fields = MotionFields::zeros(operator.field_length());
    fields.velocity[0] = 1.0;
    let coefficients =
        StepCoefficients { time_step: 1e-8, mass_coefficient: 0.0, stiffness_coefficient: 0.0 };
    // Where nothing stays in a cache: the blocks with their columns once; displacement, velocity, `M^-1 K u` and its rate read
    // and written, the masses read.
    let blocks = stiffness.entries.iter().map(|&(row, column, _)| [row / 3, column / 3]);
    let blocks = blocks.collect::<BTreeSet<[usize; 2]>>().len();
    let bytes = (8 * 9 + 4) * blocks + 4 * (mesh.node_count() + 1) + 8 * 9 * fields.velocity.len();
    let memory = vec![1.0_f64; bytes / 8];
    let [step, reading] = on_threads(threads, || {
        let fastest = |work: &mut dyn FnMut()| {
            let times = (0..20).map(|_| {
                let clock = Instant::now();
                work();
                clock.elapsed().as_secs_f64()
            });
            times.fold(f64::INFINITY, f64::min)
        };
        let step = fastest(&mut || {
            operator.advance(&mut fields, &coefficients);
        });
        let reading = fastest(&mut || {
            let sums = memory.par_chunks(1 << 16).map(|chunk| {
                let eights = chunk.as_chunks::<8>().0.iter();
                eights.fold([0.0; 8], |sum, x| std::array::from_fn(|k| sum[k] + x[k]))
            });
            black_box(sums.collect::<Vec<_>>());
        });
        [step, reading]
    });
    let rate = 1e-9 * bytes as f64;
    println!("{threads:7} {:8.3} {:7.1} {:7.1}", 1e3 * step, rate / step, rate / reading);
}

/// Prints a row.
fn step(divisions: [usize; 3], level: SimdLevel, (batches, peak): (usize, f64)) {
    let model = model::disc(Quad4, divisions);
    let sector = SolidSector::generate(&model.specification).expect("a valid mesh");
    let whole = sector.whole();
    let body = TransientModel {
        stiffness: model.options.contact,
        ..TransientModel::new(
            SteppedBody::Revolution { sector: &sector, mesh: &whole },
            &model.material,
            model.options.damping,
            model.contact,
        )
    };
    let operator = body.operator(OperatorChoice::Auto, level);
    let operator = operator.expect("an operator");
    let (initial, seeds) = (InitialState::SteadySliding, Perturbation::of(&[1, 2], 1.0));
    let settings = transient_settings([4e-5, 2e-6, 0.0], initial, seeds);
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
        level.min(SimdLevel::detect()),
        1e6 * best,
        1e9 * best / bricks as f64,
        best * peak / (FLOOR * nodes),
        100.0 * OPERATIONS * nodes / best / peak,
    );
}

/// Time of 30 modes with prestress at 21 friction coefficients from 0 to 1, s.
fn eigenvalues(divisions: [usize; 3]) -> f64 {
    let mut model: model::SolidModel = model::disc(Quad4, divisions);
    model.options.geometric_stiffness = true;
    let frictions: Vec<f64> = (0..21).map(|i| f64::from(i) / 20.0).collect();
    let clock = Instant::now();
    let found = model.swept(&frictions, Lowest(30));
    assert!(found.sweep.points.iter().all(|point| point.modes.len() >= 30));
    clock.elapsed().as_secs_f64()
}
