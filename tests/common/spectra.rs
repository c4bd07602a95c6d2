//! Spectra beside each other.

use super::prelude::*;
use nalgebra::DVector;

pub fn eigenvalues_of(modes: &[ComplexMode]) -> Vec<c64> {
    modes.iter().map(|mode| mode.eigenvalue).collect()
}

/// Critical frictions of onsets.
pub fn criticals<'a>(onsets: impl IntoIterator<Item = &'a UnstableInterval>) -> Vec<f64> {
    onsets.into_iter().map(|own| own.critical_friction).collect()
}

/// The mode that grows fastest.
pub fn fastest<'a>(modes: impl IntoIterator<Item = &'a ComplexMode>) -> &'a ComplexMode {
    modes.into_iter().max_by(|a, b| a.growth_rate().total_cmp(&b.growth_rate())).unwrap()
}

/// What some work gives on so many threads.
pub fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap().install(work)
}

/// Largest relative distance of an expected eigenvalue from the nearest one found.
pub fn largest_error(found: &[c64], expected: &[c64]) -> f64 {
    let error =
        |a: &c64| found.iter().map(|b| (a - b).norm() / a.norm()).fold(f64::INFINITY, f64::min);
    expected.iter().map(error).fold(0.0, f64::max)
}

/// Holds two sweeps to as many modes, each of the harmonic, branch, direction and eigenvalue of one of the other, and to the same
/// onsets: to a tolerance relative to the eigenvalue, and to one of friction.
pub fn assert_same(ours: &FrictionSweep, theirs: &FrictionSweep, bounds: [f64; 2], what: &str) {
    for (ours, theirs) in ours.points.iter().zip(&theirs.points) {
        assert_eq!(ours.modes.len(), theirs.modes.len(), "{what}");
        let name = |mode: &ComplexMode| (mode.harmonic, mode.branch, mode.direction);
        for mode in &ours.modes {
            let same = theirs.modes.iter().filter(|other| name(other) == name(mode));
            let same: Vec<c64> = same.map(|other| other.eigenvalue).collect();
            let error = largest_error(&same, &[mode.eigenvalue]);
            assert!(error < bounds[0], "{what}: {mode:?} {error:e}");
        }
    }
    assert_eq!(ours.intervals.len(), theirs.intervals.len(), "{what}");
    for (ours, theirs) in ours.intervals.iter().zip(&theirs.intervals) {
        assert_eq!((ours.harmonic, ours.direction), (theirs.harmonic, theirs.direction));
        let apart = (ours.critical_friction - theirs.critical_friction).abs();
        assert!(apart < bounds[1], "{what}: {ours:?} {theirs:?}");
    }
}

/// Mean and standard deviation.
pub fn moments(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (square / (n - 1.0)).sqrt())
}

pub fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Rows of numbers, which stand in one text with ` ; ` between.
pub fn rows_of<const N: usize>(text: &str) -> Vec<[f64; N]> {
    let row = |row: &str| row.split(' ').map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
    text.split(" ; ").map(|text| row(text).try_into().unwrap()).collect()
}

/// Largest relative distance of numbers from as many others, one by one.
pub fn largest_difference(a: &[c64], b: &[c64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).norm() / a.norm()).fold(0.0, f64::max)
}

/// A matrix of a file as a dense one.
pub fn market_matrix(path: &Path) -> Mat<f64> {
    dense_of(&MarketMatrix::read(&fs::read_to_string(path).unwrap(), usize::MAX).unwrap())
}

/// Entries as a dense matrix.
pub fn dense_of(matrix: &MarketMatrix) -> Mat<f64> {
    let mut dense = Mat::zeros(matrix.rows, matrix.columns);
    matrix.entries.iter().for_each(|&(row, column, value)| dense[(row, column)] += value);
    dense
}

/// Eigenvalues of `lambda^2 M + lambda C + K` by a dense decomposition.
pub fn quadratic_eigenvalues([mass, damping, stiffness]: [&Mat<f64>; 3]) -> Vec<c64> {
    let found = quadratic_modes(mass.as_ref(), damping.as_ref(), stiffness.as_ref()).unwrap();
    found.iter().map(|mode| mode.eigenvalue).collect()
}

/// Eigenvalues of `K x = kappa M x` by a dense decomposition, in any order, and their vectors as columns.
pub fn pencil_modes(k: &DMatrix<f64>, m: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let factor = m.clone().cholesky().unwrap().l();
    let half = factor.solve_lower_triangular(k).unwrap();
    let whole = factor.solve_lower_triangular(&half.transpose()).unwrap();
    let eigen = ((&whole + whole.transpose()) * 0.5).symmetric_eigen();
    (eigen.eigenvalues, factor.transpose().solve_upper_triangular(&eigen.eigenvectors).unwrap())
}

/// Prints an error, and holds it below a bound.
#[track_caller]
pub fn below(error: f64, bound: f64, what: impl std::fmt::Display) {
    println!("{what}: {error:e}");
    assert!(error < bound, "{what}: {error:e}");
}

/// Of all, the one at the least distance.
pub fn nearest_by<T>(all: impl IntoIterator<Item = T>, distance: impl Fn(&T) -> f64) -> T {
    all.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
}

/// Holds numbers to as many others one by one, to a distance.
#[track_caller]
pub fn within(found: &[f64], expected: &[f64], distance: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < distance, "{a} {b}: {found:?} {expected:?}");
    }
}

/// Holds numbers to as many others one by one, to a share of each.
#[track_caller]
pub fn near_each<T: Into<c64> + Copy>(found: &[T], expected: &[T], share: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let [a, b]: [c64; 2] = [found, expected].map(|own| (*own).into());
        assert!((a - b).norm() <= share * b.norm(), "{a} {b}");
    }
}
