//! The sparse eigenvalue sweep in phases, on one thread: 180 x 35 Quad4, 30 modes, 21 friction values from
//! 0 to 1, consistent mass, no prestress; and one friction value on 200,000 unknowns. Without `--bench` (as `cargo test --benches`
//! calls it) meshes are four times coarser.

use crate::is_measured;
use crate::prelude::*;
use divan::Bencher;
use frictionsim::cea::sparse::{SparseSweep, sweep};
use frictionsim::linalg::{LuAnalysis, SparseLu};

/// Four times coarser where nothing is measured.
fn tangent(circumferential: usize, radial: usize) -> SlidingTangent {
    let coarser = if is_measured() { 1 } else { 4 };
    let specification = annulus(Quad4, circumferential / coarser, radial / coarser);
    let mesh = AnnulusMesh::generate(&specification).expect("a valid annulus").mesh;
    linearized(&mesh, &POLYCARBONATE, &contact(610.0), &TANGENT)
}

fn request(friction_coefficients: &[f64]) -> SweepRequest<'_> {
    sweep_request(friction_coefficients, Lowest(30))
}

fn values() -> Vec<f64> {
    (0..21).map(|i| f64::from(i) / 20.0).collect()
}

fn prepared(tangent: &SlidingTangent) -> SparseSweep<'_> {
    SparseSweep::prepare(tangent, (&request(&values()), None), &Unwatched).expect("solved")
}

/// With the basis that all friction values have in common.
fn covered(tangent: &SlidingTangent) -> SparseSweep<'_> {
    let mut sweep = prepared(tangent);
    sweep.cover().expect("covered");
    sweep
}

#[divan::bench(sample_count = 5)]
fn phase_1_mesh_base_state_and_assembly() -> SlidingTangent {
    tangent(180, 35)
}

#[divan::bench(sample_count = 5)]
fn phase_2_symmetric_factorization(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    let analysis = LuAnalysis::new(tangent.stiffness.pattern()).expect("small enough");
    bencher.bench_local(|| {
        SparseLu::symmetric(&analysis, tangent.stiffness.evaluate(0.0)).expect("definite")
    });
}

#[divan::bench(sample_count = 5)]
fn phase_2_factors_with_friction_one_value(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    let analysis = LuAnalysis::new(tangent.stiffness.pattern()).expect("small enough");
    bencher.bench_local(|| {
        SparseLu::factorize(&analysis, tangent.stiffness.evaluate(0.5)).expect("regular")
    });
}

#[divan::bench(sample_count = 5)]
fn phase_3_frictionless_modes(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher.bench_local(|| prepared(&tangent));
}

#[divan::bench(sample_count = 5)]
fn phase_4_common_basis(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    let bencher = bencher.with_inputs(|| prepared(&tangent));
    bencher.bench_local_values(|mut sweep| sweep.cover().map(|()| sweep));
}

#[divan::bench(sample_count = 5)]
fn phase_5_points_with_residuals(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    let bencher = bencher.with_inputs(|| covered(&tangent));
    bencher.bench_local_values(|mut sweep| on_threads(1, || sweep.solve().map(|()| sweep)));
}

#[divan::bench(sample_count = 5)]
fn phase_6_tracking_and_onsets(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher
        .with_inputs(|| {
            let mut sweep = covered(&tangent);
            sweep.solve().expect("solved");
            sweep
        })
        .bench_local_values(|mut sweep| {
            on_threads(1, || {
                let branches = sweep.track().expect("tracked");
                sweep.finish(&request(&values()), &branches)
            })
        });
}

#[divan::bench(sample_count = 5)]
fn whole_sweep_of_21_friction_values(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher.bench_local(|| {
        on_threads(1, || sweep(&tangent, &request(&values()), &|_| {}).expect("solved"))
    });
}

#[divan::bench(sample_count = 1)]
fn one_friction_value_on_200_000_unknowns(bencher: Bencher<'_, '_>) {
    let tangent = tangent(720, 139);
    bencher.bench_local(|| {
        on_threads(1, || sweep(&tangent, &request(&[0.3]), &|_| {}).expect("solved"))
    });
}
