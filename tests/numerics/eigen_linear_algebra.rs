//! Sparse factorizations and the Krylov-Schur iteration against dense decompositions (independent checks).

use crate::prelude::*;
use faer::MatRef;
use frictionsim::linalg::dense::product;
use frictionsim::linalg::dense_eigen::real_eigen;

/// Five-point Laplacian on a `side x side` grid, plus `skew` times an unsymmetric convection.
fn grid_operator(side: usize, skew: f64) -> MatrixPolynomial {
    let at = |i: usize, j: usize| i * side + j;
    let mut entries = Vec::new();
    for i in 0..side {
        for j in 0..side {
            entries.push((at(i, j), at(i, j), 4.0));
            if i + 1 < side {
                entries.push((at(i, j), at(i + 1, j), -1.0 + skew));
                entries.push((at(i + 1, j), at(i, j), -1.0 - skew));
            }
            if j + 1 < side {
                entries.push((at(i, j), at(i, j + 1), -1.0 - 0.7 * skew));
                entries.push((at(i, j + 1), at(i, j), -1.0 + 0.7 * skew));
            }
        }
    }
    MatrixPolynomial::from_triplets(side * side, &[entries])
}

#[derive(Debug)]
struct Inverse(usize, SparseLu);

impl BlockOperator for Inverse {
    fn dimension(&self) -> usize {
        self.0
    }
    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let mut y = x.to_owned();
        self.1.solve_in_place(y.as_mut());
        y
    }
}

pub fn settings(wanted: usize) -> KrylovSchurSettings {
    let (tolerance, max_applications) = (1e-12, 2000);
    KrylovSchurSettings { wanted, tie: 1.0, tolerance, max_applications, dense_up_to: 0 }
}

fn largest(p: &MatrixPolynomial, wanted: usize) -> RealPairs {
    let start = random_columns(p.dimension(), 4, 0x5eed);
    let analysis = LuAnalysis::new(p.pattern()).unwrap();
    let factors = SparseLu::factorize(&analysis, p.evaluate(0.0)).unwrap();
    let inverse = Inverse(p.dimension(), factors);
    let pairs = krylov_schur(&inverse, start, &|_| true, &settings(wanted)).unwrap();
    assert!(pairs.residuals.iter().all(|residual| *residual <= 1e-12));
    pairs
}

#[test]
fn one_analysis_solves_real_complex_and_transposed_systems() {
    let p = grid_operator(30, 0.3);
    let n = p.dimension();
    let analysis = LuAnalysis::new(p.pattern()).unwrap();
    let values = p.evaluate(0.0);
    let exact = random_columns(n, 19, 5);
    let lu = SparseLu::factorize(&analysis, values.clone()).unwrap();
    let mut x = p.pattern().multiply(&values, exact.as_ref());
    lu.solve_in_place(x.as_mut());
    // The condition number is about 400.
    assert!((&x - &exact).norm_max() < 1e-12);
    let mut x = p.pattern().multiply_transpose(&values, exact.as_ref());
    lu.solve_transpose_in_place(x.as_mut());
    assert!((&x - &exact).norm_max() < 1e-12);
    let rotated: Vec<c64> = values.iter().map(|v| c64::new(*v, 0.2 * v)).collect();
    let complex = ComplexSparseLu::factorize(&analysis, rotated).unwrap();
    let b = p.pattern().multiply(&values, exact.as_ref());
    let right_side: Vec<c64> = (0..n).map(|i| c64::new(1.0, 0.2) * b[(i, 0)]).collect();
    for (i, x) in complex.solve_refined(&right_side).iter().enumerate() {
        assert!((x - c64::new(exact[(i, 0)], 0.0)).norm() < 1e-13);
    }
}

#[test]
fn singular_matrix_is_an_error_not_a_nan() {
    // A closed chain without supports: constant vectors are in its kernel.
    let n = 40;
    let all = (0..n).flat_map(|i| [(i, i, 2.0), (i, (i + 1) % n, -1.0), ((i + 1) % n, i, -1.0)]);
    let p = MatrixPolynomial::from_triplets(n, &[all.collect()]);
    let analysis = LuAnalysis::new(p.pattern()).unwrap();
    let outcome = SparseLu::factorize(&analysis, p.evaluate(0.0));
    // The message names what exceeds its bound: the solution is exact, but for a nearby right side.
    let told = outcome.unwrap_err().to_string();
    let (_, value) = told.split_once("its condition number is at least ").expect(&told);
    let (value, bound) = value.split_once(", the bound is ").expect(&told);
    assert!(value.parse::<f64>().unwrap() > bound.parse::<f64>().unwrap(), "{told}");
}

#[test]
fn inertia_counts_the_eigenvalues_below_every_shift() {
    // The Laplacian's eigenvalues are known: 4 - 2 cos(i pi/(side+1)) - 2 cos(j pi/(side+1)).
    let side = 12;
    let p = grid_operator(side, 0.0);
    let angle = |i: usize| (i as f64 * PI / (side + 1) as f64).cos();
    let pairs = (1..=side).flat_map(|i| (1..=side).map(move |j| [i, j]));
    let exact: Vec<f64> = pairs.map(|[i, j]| 4.0 - 2.0 * angle(i) - 2.0 * angle(j)).collect();
    let analysis = LuAnalysis::new(p.pattern()).unwrap();
    let ones = (0..side * side).map(|i| (i, i, 1.0)).collect();
    let identity = MatrixPolynomial::on_pattern(p.pattern(), &[ones]);
    for shift in [-0.1, 0.1003, 0.4, 1.03, 2.6, 3.97, 5.51, 7.1, 7.95] {
        let shifted = MatrixPolynomial::combination(1.0, &p, -shift, &identity);
        let factors = SparseLu::symmetric(&analysis, shifted.evaluate(0.0)).unwrap();
        let count = exact.iter().filter(|&&e| e < shift).count();
        assert_eq!(factors.negative_count(), count, "shift {shift}");
    }
}

#[test]
fn symmetric_factors_solve_definite_and_indefinite_systems() {
    let p = grid_operator(25, 0.0);
    let analysis = LuAnalysis::new(p.pattern()).unwrap();
    for shift in [0.0, 1.237] {
        let mut values = p.evaluate(0.0);
        for i in 0..p.dimension() {
            values[p.pattern().position(i, i).unwrap()] -= shift;
        }
        let exact = random_columns(p.dimension(), 3, 8);
        let mut x = p.pattern().multiply(&values, exact.as_ref());
        SparseLu::symmetric(&analysis, values).unwrap().solve_in_place(x.as_mut());
        // Pivots are chosen within a front: allow the growth that the indefinite shift brings.
        assert!((&x - &exact).norm_max() < 1e-9, "shift {shift}");
    }
}

#[test]
fn krylov_schur_finds_the_same_pairs_as_a_dense_decomposition() {
    for skew in [0.0, 0.03, 0.15] {
        let p = grid_operator(17, skew);
        let pairs = largest(&p, 24);
        let all = real_eigen(dense(&p, 0.0).as_ref(), false, 0).unwrap().values;
        let mut exact: Vec<c64> = all.iter().map(|v| v.inv()).collect();
        exact.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        for (theta, own) in pairs.values.iter().zip(&exact) {
            assert!((theta.norm() - own.norm()).abs() < 1e-10 * own.norm());
            below(largest_error(&exact, &[*theta]), 1e-9, format_args!("skew {skew}: {theta}"));
        }
        let images = product(dense(&p, 0.0).as_ref(), pairs.vectors.as_ref());
        for (j, theta) in pairs.values.iter().enumerate().filter(|(_, t)| t.im == 0.0) {
            let left = |i: usize| images[(i, j)] * theta.re - pairs.vectors[(i, j)];
            assert!((0..p.dimension()).all(|i| left(i).abs() < 1e-10));
        }
    }
}
