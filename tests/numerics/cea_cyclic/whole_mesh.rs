//! Cross-method checks: the sparse solver and the matrices of the whole mesh.

use crate::cea_cyclic::model::{paper_options, run};
use crate::prelude::*;
use frictionsim::cea::cyclic::sweep;

/// Cross-method check: the sparse solver on the whole mesh, which knows nothing of the symmetry, under constant friction, and under
/// friction that falls with speed at both senses of rotation.
#[test]
fn spectrum_branches_and_onsets_equal_those_of_the_sparse_solver() {
    let frictions = [0.0, 0.3, 0.6];
    let (quad4, quad8) = ((ElementKind::Quad4, 36), (ElementKind::Quad8, 18));
    let springs = Some(7.4e12);
    for ((element, sectors), mass, normal_stiffness, contact) in [
        (quad4, MassKind::Consistent, springs, contact(610.0)),
        (quad4, MassKind::Lumped, None, contact(610.0)),
        (quad8, MassKind::Consistent, None, contact(610.0)),
        (quad8, MassKind::Lumped, springs, contact(610.0)),
        (quad4, MassKind::Consistent, None, falling(610.0)),
        (quad8, MassKind::Consistent, springs, falling(-300.0)),
    ] {
        let mut options = paper_options();
        options.mass = mass;
        options.contact.normal_stiffness = normal_stiffness;
        let specification = annulus(element, sectors, 6);
        let request = sweep_request(&frictions, ModeLimit::Lowest(18));
        let cyclic = sweep(&specification, &POLYCARBONATE, &options, &contact, &request);
        let cyclic = cyclic.unwrap().sweep;
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let tangent = linearized(&mesh, &POLYCARBONATE, &contact, &options);
        let sparse = sparse::sweep(&tangent, &request, &|_| {}).unwrap();
        let what = format!("{element:?} {mass:?} {normal_stiffness:?} {contact:?}");
        assert_same(&cyclic, &sparse, [1e-9, 1e-8], &what);
        for (ours, theirs) in cyclic.points.iter().zip(&sparse.points) {
            for mode in &ours.modes {
                let same = theirs.modes.iter().filter(|m| {
                    (m.harmonic, m.branch, m.direction)
                        == (mode.harmonic, mode.branch, mode.direction)
                });
                let shares = same.map(|m| (m.contact_share - mode.contact_share).abs());
                let share = shares.fold(f64::MAX, f64::min);
                // A quadratic form of a vector that is known to 1e-8.
                assert!(share < 1e-7, "{what}: {mode:?} {share:e}");
            }
        }
    }
}

/// Consistency check: without friction every mode but those of `n = 0` is double, and no count cuts a pair.
#[test]
fn a_cut_through_a_pair_keeps_both_members_in_both_solvers() {
    let specification = annulus(ElementKind::Quad4, 24, 5);
    let options = paper_options();
    let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
    let tangent = linearized(&mesh, &POLYCARBONATE, &contact(610.0), &options);
    for asked in 2..6 {
        let cyclic = run(&specification, &options, &[0.0, 0.4], ModeLimit::Lowest(asked)).sweep;
        let request = sweep_request(&[0.0, 0.4], ModeLimit::Lowest(asked));
        let sparse = sparse::sweep(&tangent, &request, &|_| {}).unwrap();
        for found in [cyclic, sparse] {
            let [rest, sliding] = [0, 1].map(|i| &found.points[i].modes);
            let singles = rest.iter().filter(|mode| mode.harmonic == 0).count();
            assert!((rest.len() - singles).is_multiple_of(2), "{asked}");
            assert!(rest.len() == asked || rest.len() == asked + 1, "{asked}");
            // With friction the members differ in frequency.
            assert_eq!(sliding.len(), asked);
        }
    }
}

/// Consistency check: the uncertainty says what a penalty of any size does to the digits that both solvers share.
#[test]
fn solvers_differ_by_no_more_than_the_uncertainty_that_they_state() {
    let specification = annulus(ElementKind::Quad4, 24, 5);
    for penalty in [7.4e12, 7.4e18, 7.4e24] {
        let mut options = paper_options();
        options.contact.normal_stiffness = Some(penalty);
        let cyclic = run(&specification, &options, &[0.4], ModeLimit::Lowest(8)).sweep;
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let tangent = linearized(&mesh, &POLYCARBONATE, &contact(610.0), &options);
        let request = sweep_request(&[0.4], ModeLimit::Lowest(8));
        let Ok(sparse) = sparse::sweep(&tangent, &request, &|_| {}) else {
            assert!(penalty > 1e20, "{penalty:e}");
            continue;
        };
        for (ours, theirs) in cyclic.points[0].modes.iter().zip(&sparse.points[0].modes) {
            let apart = (ours.eigenvalue - theirs.eigenvalue).norm() / ours.eigenvalue.norm();
            // Entries of a matrix carry a few rounding errors each; the sparse iteration leaves up to 1e-9.
            let bound = (10.0 * ours.uncertainty).max(1e-9);
            assert!(apart < bound, "{penalty:e} {apart:e} {ours:?}");
            assert_eq!(ours.uncertainty > 1e-9, penalty > 1e14, "{penalty:e} {ours:?}");
        }
    }
}

/// Consistency check on the whole mesh: shapes expanded from one sector satisfy the full problem.
#[test]
fn expanded_shapes_are_eigenvectors_of_the_full_mesh() {
    for (element, normal_stiffness) in
        [(ElementKind::Quad4, Some(7.4e12)), (ElementKind::Quad8, None)]
    {
        let mut options = paper_options();
        options.contact.normal_stiffness = normal_stiffness;
        let specification = annulus(element, 24, 6);
        let request =
            SweepRequest { shapes_at: &[0.6], ..sweep_request(&[0.6, 0.0], ModeLimit::Lowest(20)) };
        let (material, contact) = (POLYCARBONATE, contact(610.0));
        let found = sweep(&specification, &material, &options, &contact, &request).unwrap();
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let tangent = linearized(&mesh, &material, &contact, &options);
        let multiply = |p: &MatrixPolynomial, x: &[c64]| {
            let (values, pattern) = (p.evaluate(0.6), p.pattern());
            let mut y = vec![c64::new(0.0, 0.0); x.len()];
            for (column, x) in x.iter().enumerate() {
                for place in
                    pattern.column_pointers()[column]..pattern.column_pointers()[column + 1]
                {
                    y[pattern.row_indices()[place]] += values[place] * x;
                }
            }
            y
        };
        assert!(found.sweep.points[1].modes.iter().all(|mode| mode.shape.is_none()));
        for mode in &found.sweep.points[0].modes {
            let shape = mode.shape.as_ref().unwrap();
            let largest =
                shape.chunks(2).map(|u| u[0].norm().hypot(u[1].norm())).fold(0.0, f64::max);
            assert!((largest - 1.0).abs() < 1e-12);
            let x = tangent.unknowns.restrict(shape);
            let [m, c, k] = [&tangent.mass, &tangent.damping, &tangent.stiffness]
                .map(|matrix| multiply(matrix, &x));
            let lambda = mode.eigenvalue;
            let scale = k.iter().map(|v| v.norm()).fold(0.0, f64::max);
            for i in 0..x.len() {
                let residual = lambda * lambda * m[i] + lambda * c[i] + k[i];
                // Forces at single nodes cancel entries about 1e3 times as large.
                assert!(residual.norm() < 1e-9 * scale, "{mode:?} {residual}");
            }
        }
    }
}
