//! The sparse eigenvalue sweep in phases, on one thread: 180 x 35 Quad4, 30 modes, 21 friction values from
//! 0 to 1, consistent mass, no prestress; and one friction value on 200,000 unknowns. Without `--bench` (as `cargo test --benches`
//! calls it) meshes are four times coarser.

use crate::disc::{DAMPING, POLYCARBONATE, annulus, contact};
use crate::is_measured;
use divan::Bencher;
use frictionsim::cea::sparse::{SparseSweep, sweep};
use frictionsim::cea::{ModeLimit, SweepRequest, Unwatched};
use frictionsim::contact::ContactStiffness;
use frictionsim::fem::MassKind;
use frictionsim::linalg::{LdlAnalysis, LuAnalysis, RealFactors};
use frictionsim::mesh::{AnnulusMesh, ElementKind};
use frictionsim::prestress::{Assembly, DampingModel, SlidingTangent, TangentOptions};

/// Four times coarser where nothing is measured.
fn tangent(circumferential: usize, radial: usize) -> SlidingTangent {
    let coarser = if is_measured() { 1 } else { 4 };
    let specification = annulus(ElementKind::Quad4, circumferential / coarser, radial / coarser);
    let mesh = AnnulusMesh::generate(&specification).expect("a valid annulus").mesh;
    let options = TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: false,
        damping: DAMPING,
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness::default(),
    };
    let body = Assembly::of_edge(&mesh, &POLYCARBONATE, &contact(610.0), options.contact);
    let tangent = body.and_then(|body| body.tangent(&body.state(0.3)?, &options));
    tangent.expect("the disc is in contact")
}

fn request(friction_coefficients: &[f64]) -> SweepRequest<'_> {
    SweepRequest::new(friction_coefficients, ModeLimit::Lowest(30))
}

fn values() -> Vec<f64> {
    (0..21).map(|i| f64::from(i) / 20.0).collect()
}

fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread can be started").install(work)
}

#[divan::bench(sample_count = 5)]
fn phase_1_mesh_base_state_and_assembly() -> SlidingTangent {
    tangent(180, 35)
}

#[divan::bench(sample_count = 5)]
fn phase_2_symmetric_factorization(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    let analysis = LdlAnalysis::new(tangent.stiffness.pattern()).expect("small enough");
    bencher.bench_local(|| {
        RealFactors::symmetric(&analysis, &tangent.stiffness.evaluate(0.0)).expect("definite")
    });
}

#[divan::bench(sample_count = 5)]
fn phase_2_factors_with_friction_one_value(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    let analysis = LuAnalysis::new(tangent.stiffness.pattern()).expect("small enough");
    bencher.bench_local(|| {
        RealFactors::general(&analysis, tangent.stiffness.evaluate(0.5)).expect("regular")
    });
}

#[divan::bench(sample_count = 5)]
fn phase_3_frictionless_modes(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher.bench_local(|| {
        SparseSweep::prepare(&tangent, &request(&values()), &Unwatched).expect("solved")
    });
}

#[divan::bench(sample_count = 5)]
fn phase_4_common_basis(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher
        .with_inputs(|| {
            SparseSweep::prepare(&tangent, &request(&values()), &Unwatched).expect("solved")
        })
        .bench_local_values(|mut sweep| sweep.cover().map(|()| sweep));
}

#[divan::bench(sample_count = 5)]
fn phase_5_points_with_residuals(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher
        .with_inputs(|| {
            let mut sweep =
                SparseSweep::prepare(&tangent, &request(&values()), &Unwatched).expect("solved");
            sweep.cover().expect("covered");
            sweep
        })
        .bench_local_values(|mut sweep| on_one_thread(|| sweep.solve().map(|()| sweep)));
}

#[divan::bench(sample_count = 5)]
fn phase_6_tracking_and_onsets(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher
        .with_inputs(|| {
            let mut sweep =
                SparseSweep::prepare(&tangent, &request(&values()), &Unwatched).expect("solved");
            sweep.cover().expect("covered");
            sweep.solve().expect("solved");
            sweep
        })
        .bench_local_values(|mut sweep| {
            on_one_thread(|| {
                let branches = sweep.track().expect("tracked");
                sweep.finish(&request(&values()), &branches)
            })
        });
}

#[divan::bench(sample_count = 5)]
fn whole_sweep_of_21_friction_values(bencher: Bencher<'_, '_>) {
    let tangent = tangent(180, 35);
    bencher.bench_local(|| {
        on_one_thread(|| sweep(&tangent, &request(&values()), &|_| {}).expect("solved"))
    });
}

#[divan::bench(sample_count = 1)]
fn one_friction_value_on_200_000_unknowns(bencher: Bencher<'_, '_>) {
    let tangent = tangent(720, 139);
    bencher.bench_local(|| {
        on_one_thread(|| sweep(&tangent, &request(&[0.3]), &|_| {}).expect("solved"))
    });
}
