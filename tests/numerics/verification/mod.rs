//! The verification room: closed forms that were not made for this program, each against a case as a user writes one.
//!
//! A test has the name of its source, and its header has formula, data and what is found; the guide's page `src/guide/verification.md`
//! shows them side by side. One command runs them all: `cargo test --profile iterate --test numerics verification::`.

mod brener_2016_layer;
mod bryan_1890;
mod duffour_woodhouse;
mod hulten_1993;
mod johnson_sliding_hertz;
mod nafems_fv52;
mod oberst;
mod sector_pads;

use crate::prelude::*;
use nalgebra::DVector;

fn folder(name: &str, mesh: &[u8]) -> PathBuf {
    let folder = kept(&format!("verification/{name}"));
    fs::write(folder.join("body.msh"), mesh).unwrap();
    folder
}

/// Runs a command of the program on a case under changes in a folder, and reads one table of its results.
fn table(folder: &Path, command: &str, case: &str, changes: &str, file: &str) -> Vec<Row> {
    let run = Run::of_text(command, folder, case).args(&["-qq", "--force"]).out(command);
    let changes = (!changes.is_empty()).then_some(changes);
    run.set(changes.as_slice()).done().rows(file)
}

/// Young's modulus, Poisson's ratio and density of steel.
const YOUNG: f64 = 2.1e11;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 7850.0;

/// Integral of a smooth function by Gauss's rule.
fn integral(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * (to - from);
    let points = gauss_legendre(24).into_iter();
    points.map(|(x, weight)| half * weight * value(from + half * (1.0 + x))).sum()
}

/// The lowest eigenvalue of `K x = kappa M x` and its vector: Ritz's method, the closed form's radial shape.
fn ritz(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> (f64, DVector<f64>) {
    let (squares, shapes) = pencil_modes(stiffness, mass);
    let lowest = squares.imin();
    (squares[lowest], shapes.column(lowest).into_owned())
}

/// Observed order between two meshes, the second finer by `ratio`.
fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).abs().ln() / ratio.ln()
}
