//! The sparse sweep on one thread, timed, with its matrices and eigenvalues written for `against_slepc.py`.
//!
//! Arguments: folder, circumferential and radial elements, modes, friction values from 0 to 1 (one value: 0.3).

#[path = "../tests/common/disc.rs"]
mod disc;

use disc::{DAMPING, POLYCARBONATE, annulus, contact};
use frictionsim::cea::sparse::sweep;
use frictionsim::cea::{ModeLimit, SweepRequest};
use frictionsim::contact::ContactStiffness;
use frictionsim::fem::{MassKind, assemble_stiffness};
use frictionsim::linalg::MatrixPolynomial;
use frictionsim::mesh::{AnnulusMesh, ElementKind};
use frictionsim::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};
use std::path::Path;

fn main() {
    // `cargo bench` and `cargo test` pass options of their own.
    let given: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    let [folder, numbers @ ..] = given.as_slice() else {
        return println!("run benches/against_slepc.py");
    };
    let number = |i: usize, default: usize| {
        numbers
            .get(i)
            .map_or(default, |text| text.parse().expect("a whole number"))
    };
    let tangent = tangent(number(0, 180), number(1, 35));
    let (modes, count) = (number(2, 30), number(3, 21));
    let values: Vec<f64> = match count {
        1 => vec![0.3],
        _ => (0..count).map(|i| i as f64 / (count - 1) as f64).collect(),
    };
    write_matrices(Path::new(folder), &tangent);

    let request = SweepRequest {
        friction_coefficients: &values,
        limit: ModeLimit::Lowest(modes),
        shapes_at: &[],
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let (found, seconds) = pool.install(|| {
        let start = processor_seconds();
        let found = sweep(&tangent, &request, &|_| {}).expect("solved");
        (found, processor_seconds() - start)
    });
    let all = || found.points.iter().flat_map(|point| &point.modes);
    let residual = all().map(|mode| mode.residual).fold(0.0, f64::max);
    let mut table = String::new();
    for point in &found.points {
        for mode in &point.modes {
            let (mu, lambda) = (point.friction_coefficient, mode.eigenvalue);
            table += &format!("{mu:?} {:?} {:?}\n", lambda.re, lambda.im);
        }
    }
    std::fs::write(Path::new(folder).join("eigenvalues.txt"), table).expect("written");
    println!(
        "unknowns {} values {} modes {modes} seconds {seconds:.3} residual {residual:.2e} peak_mb {:.0}",
        tangent.unknowns.len(),
        values.len(),
        peak_megabytes(),
    );
}

fn tangent(circumferential: usize, radial: usize) -> SlidingTangent {
    let specification = annulus(ElementKind::Quad4, circumferential, radial);
    let mesh = AnnulusMesh::generate(&specification)
        .expect("a valid annulus")
        .mesh;
    let elastic = assemble_stiffness(&mesh, &POLYCARBONATE);
    let contact = contact(610.0);
    let base = SteadySliding::solve(&mesh, &elastic, &contact).expect("the disc is in contact");
    let options = TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: false,
        damping: DAMPING,
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness::default(),
    };
    SlidingTangent::linearize(&mesh, &POLYCARBONATE, &elastic, &base, &options)
}

/// Compressed columns as little-endian arrays: the pattern once, values of each power of friction.
fn write_matrices(folder: &Path, tangent: &SlidingTangent) {
    std::fs::create_dir_all(folder).expect("a folder");
    let write = |name: &str, bytes: Vec<u8>| {
        std::fs::write(folder.join(name), bytes).expect("written");
    };
    let pattern = tangent.stiffness.pattern();
    let integers = |values: &[usize]| -> Vec<u8> {
        values
            .iter()
            .flat_map(|&v| (v as i64).to_le_bytes())
            .collect()
    };
    write("pointers.i64", integers(pattern.column_pointers()));
    write("rows.i64", integers(pattern.row_indices()));
    let polynomials: [(&str, &MatrixPolynomial); 2] =
        [("stiffness", &tangent.stiffness), ("mass", &tangent.mass)];
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
    let nanoseconds = times
        .split_whitespace()
        .next()
        .and_then(|t| t.parse::<f64>().ok());
    nanoseconds.map_or(f64::NAN, |t| 1e-9 * t)
}

/// Largest resident memory of this process so far, where the system says.
fn peak_megabytes() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1024.0
}
