//! The sparse sweep of a case on one thread, timed, with its matrices and eigenvalues written for `against_slepc.py`.
//!
//! Arguments: folder, case file, overrides `KEY=VALUE`. The folder gets one subfolder for each base state of the sweep
//! (contact nodes open or close between them): `pointers.i64`, `rows.i64` (compressed columns, little-endian),
//! `stiffness-P.f64`, `damping-P.f64`, `mass-P.f64` (values that multiply the power `P` of the friction coefficient),
//! `request.txt` (what is wanted), `eigenvalues.txt` (friction coefficient, real and imaginary part, rad/s).

use frictionsim::case::Case;
use frictionsim::cea::sparse::sweep;
use frictionsim::cea::{FrictionSweep, ModeLimit, SweepRequest};
use frictionsim::linalg::MatrixPolynomial;
use frictionsim::prestress::SlidingTangent;
use frictionsim::study::eigenvalues::{WholeMesh, mode_limit};
use frictionsim::study::tangent_options;
use std::fmt::Write;
use std::path::Path;

fn main() {
    // `cargo bench` and `cargo test` pass options of their own.
    let given: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let [folder, file, overrides @ ..] = given.as_slice() else {
        return println!("run benches/against_slepc.py");
    };
    let bytes = std::fs::read(file).expect("a case file");
    let case = Case::parse(file, &bytes, overrides).expect("a valid case");
    let cea = case.require_cea().expect("a section [cea]").clone();
    let frictions = cea.solved_friction_coefficients();
    let options = tangent_options(&case, cea.mass);
    let model = WholeMesh::solve(&case, options, &frictions).expect("steady sliding");
    let (mut seconds, mut residual, mut count, mut unknowns) = (0.0, 0.0_f64, 0, 0);
    for (k, state) in model.range.states.iter().enumerate() {
        let own = frictions.iter().zip(&model.range.state_of);
        let values: Vec<f64> = own.filter(|(_, s)| **s == k).map(|(mu, _)| *mu).collect();
        if values.is_empty() {
            continue;
        }
        let tangent = model.tangent(&case, state);
        let request = SweepRequest {
            friction_coefficients: &values,
            limit: mode_limit(&cea),
            shapes_at: &[],
            count_modes: false,
        };
        let folder = Path::new(folder).join(format!("state-{k}"));
        write_matrices(&folder, &tangent);
        write_request(&folder, &tangent, &request);
        if std::env::var_os("MATRICES_ONLY").is_some() {
            continue;
        }
        let (found, elapsed) = timed_sweep(&tangent, &request);
        write_eigenvalues(&folder, &found);
        let modes = found.points.iter().flat_map(|point| &point.modes);
        residual = modes.map(|mode| mode.residual).fold(residual, f64::max);
        (seconds, count) = (seconds + elapsed, count + values.len());
        unknowns = unknowns.max(tangent.unknowns.len());
    }
    println!(
        "unknowns {unknowns} values {count} seconds {seconds:.3} residual {residual:.2e} peak_mb {:.0}",
        peak_megabytes(),
    );
}

/// The sweep on one thread, and its processor time.
fn timed_sweep(tangent: &SlidingTangent, request: &SweepRequest<'_>) -> (FrictionSweep, f64) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread").install(|| {
        let start = processor_seconds();
        let found = sweep(tangent, request, &|_| {}).expect("solved");
        (found, processor_seconds() - start)
    })
}

fn write_eigenvalues(folder: &Path, found: &FrictionSweep) {
    let mut table = String::new();
    for point in &found.points {
        for mode in &point.modes {
            let (mu, lambda) = (point.friction_coefficient, mode.eigenvalue);
            writeln!(table, "{mu:?} {:?} {:?}", lambda.re, lambda.im).expect("written");
        }
    }
    std::fs::write(folder.join("eigenvalues.txt"), table).expect("written");
}

/// One line for each: what is wanted, and what of the tangent is no matrix.
fn write_request(folder: &Path, tangent: &SlidingTangent, request: &SweepRequest<'_>) {
    let mut text = String::new();
    let mut line = |name: &str, values: &dyn std::fmt::Debug| {
        let values = format!("{values:?}").replace(['[', ']', ','], "");
        writeln!(text, "{name} {values}").expect("written");
    };
    line("values", &request.friction_coefficients);
    match request.limit {
        ModeLimit::Lowest(count) => line("lowest", &count),
        ModeLimit::MaxFrequency(hz) => line("below_hz", &hz),
    }
    if let Some(damping) = tangent.proportional {
        let own = [damping.mass_coefficient, damping.stiffness_coefficient];
        line("proportional", &own);
    }
    line("tangential", &tangent.contact_tangential);
    line("normal", &tangent.contact_normal);
    line("opposite", &tangent.contact_opposite);
    line("angles", &tangent.contact_angles);
    std::fs::write(folder.join("request.txt"), text).expect("written");
}

/// Compressed columns as little-endian arrays: the pattern once, values of each power of friction.
fn write_matrices(folder: &Path, tangent: &SlidingTangent) {
    std::fs::create_dir_all(folder).expect("a folder");
    let write = |name: &str, bytes: Vec<u8>| {
        std::fs::write(folder.join(name), bytes).expect("written");
    };
    let pattern = tangent.stiffness.pattern();
    let integers = |values: &[usize]| -> Vec<u8> {
        values.iter().flat_map(|&v| (v as i64).to_le_bytes()).collect()
    };
    write("pointers.i64", integers(pattern.column_pointers()));
    write("rows.i64", integers(pattern.row_indices()));
    let polynomials: [(&str, &MatrixPolynomial); 3] =
        [("stiffness", &tangent.stiffness), ("damping", &tangent.damping), ("mass", &tangent.mass)];
    for (name, polynomial) in polynomials {
        for (power, values) in polynomial.coefficients().iter().enumerate() {
            let bytes = values.iter().flat_map(|v| v.to_le_bytes()).collect();
            write(&format!("{name}-{power}.f64"), bytes);
        }
    }
}

/// Processor time of this thread so far, where the system says: other load on the machine counts little.
fn processor_seconds() -> f64 {
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = times.split_whitespace().next().and_then(|t| t.parse::<f64>().ok());
    nanoseconds.map_or(f64::NAN, |t| 1e-9 * t)
}

/// Largest resident memory of this process so far, where the system says.
fn peak_megabytes() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1024.0
}
