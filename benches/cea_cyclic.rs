//! Solve times of the cyclic eigenvalue analysis on one thread and on all. Without `--bench` (as `cargo test --benches` calls
//! it) meshes are five times coarser.

use crate::is_measured;
use crate::prelude::*;
use divan::Bencher;
use frictionsim::cea::cyclic::{WaveSweep, sweep};

/// 30 modes of the disc with prestress, `values` friction coefficients from 0 to 1.
fn solve(circumferential: usize, radial: usize, values: usize) -> WaveSweep {
    let coarser = if is_measured() { 1 } else { 5 };
    let specification = annulus(Quad4, circumferential / coarser, radial / coarser);
    let springs = compliant(7.4e12, [0.0; 2]);
    let options = TangentOptions { geometric_stiffness: true, contact: springs, ..TANGENT };
    let last = (values - 1) as f64;
    let frictions: Vec<f64> = (0..values).map(|i| i as f64 / last).collect();
    let request = sweep_request(&frictions, Lowest(30));
    sweep(&specification, &POLYCARBONATE, &options, &contact(610.0), &request)
        .expect("the disc can be solved")
}

/// 21 friction values, meshes from 90 x 18 to 1800 x 350 elements, one thread.
#[divan::bench(args = [(90, 18), (180, 35), (360, 70), (720, 140), (1800, 350)], max_time = 4)]
fn elements(bencher: Bencher<'_, '_>, (circumferential, radial): (usize, usize)) {
    bencher.bench(|| on_threads(1, || solve(circumferential, radial, 21)));
}

/// 1800 x 350 elements on all threads.
#[divan::bench(max_time = 4)]
fn largest_mesh_on_all_threads(bencher: Bencher<'_, '_>) {
    bencher.bench(|| solve(1800, 350, 21));
}

/// 180 x 35 elements, one thread.
#[divan::bench(args = [1, 21, 101, 1001], max_time = 4)]
fn friction_values(bencher: Bencher<'_, '_>, values: usize) {
    bencher.bench(|| on_threads(1, || solve(180, 35, values.max(2))));
}
