use crate::normal_law::LAWS;
use crate::prelude::*;
use crate::shaft::{STEEL, model as on_shaft, on, rigid_contact, with_shaft};

/// Eigenvalues, directions, branches, onsets and contact shares by harmonics and on the whole mesh.
fn agree<M: MaterialField + Clone>(
    model: &AnnulusModel<M>,
    (frictions, count): (&[f64], usize),
    tolerances: [f64; 2],
    what: &str,
) {
    let limit = Lowest(count);
    let cyclic = model.swept(frictions, limit).sweep;
    let sparse = swept(&model.whole(), frictions, limit);
    assert_same(&cyclic, &sparse, tolerances, what);
    assert!(!cyclic.intervals.is_empty(), "{what}");
    for (ours, theirs) in cyclic.points.iter().zip(&sparse.points) {
        for mode in &ours.modes {
            let name = |own: &ComplexMode| (own.harmonic, own.branch, own.direction);
            let same = theirs.modes.iter().filter(|own| name(own) == name(mode));
            let shares = same.map(|m| (m.contact_share - mode.contact_share).abs());
            let share = shares.fold(f64::MAX, f64::min);
            // A quadratic form of a vector that is known to the root of that.
            assert!(share < 100.0 * tolerances[0], "{what}: {mode:?} {share:e}");
        }
    }
}

/// Cross-method check: the sparse solver on the whole mesh, which knows nothing of the symmetry, under constant friction, and under
/// friction that falls with speed at both senses of rotation.
#[test]
fn spectrum_branches_and_onsets_equal_those_of_the_sparse_solver() {
    let (quad4, quad8) = ((Quad4, 36), (Quad8, 18));
    let springs = Some(7.4e12);
    for ((element, sectors), mass, normal_stiffness, contact) in [
        (quad4, Consistent, springs, contact(610.0)),
        (quad4, Lumped, None, contact(610.0)),
        (quad8, Consistent, None, contact(610.0)),
        (quad8, Lumped, springs, contact(610.0)),
        (quad4, Consistent, None, falling(610.0)),
        (quad8, Consistent, springs, falling(-300.0)),
    ] {
        let mut model = WaveModel { contact, ..paper(element, sectors, 6) };
        model.options.mass = mass;
        model.options.contact.normal_stiffness = normal_stiffness;
        let what = format!("{element:?} {mass:?} {normal_stiffness:?} {contact:?}");
        agree(&model, (&[0.0, 0.3, 0.6], 18), [1e-9, 1e-8], &what);
    }
}

/// The same of contact that stiffens with pressure, whose base state the whole mesh solves by complementarity.
#[test]
fn spectrum_of_contact_that_stiffens_equals_that_of_the_sparse_solver() {
    for (law, element) in LAWS.into_iter().zip([Quad4, Quad8]) {
        let model = paper(element, 24, 5).with(|own| own.options.contact = stiffening(law));
        agree(&model, (&[0.0, 0.4], 12), [1e-8, 1e-8], &format!("{law:?}"));
    }
}

/// The same of two bodies, whose damping and support are their own.
#[test]
fn cyclic_and_sparse_spectra_of_two_bodies_are_the_same() {
    let alike = on_shaft(with_shaft(Quad4, 20, [2, 4]), on(POLYCARBONATE), rigid_contact(true));
    let mut damped = on_shaft(with_shaft(Quad8, 12, [2, 4]), on(STEEL), rigid_contact(true));
    damped.material.shaft.as_mut().unwrap().damping = Some(rayleigh_damping(5.0, 1e-8));
    let mut supported = alike.clone();
    supported.specification.circumferential_elements = 18;
    supported.specification.shaft.as_mut().unwrap().bore = support([1e13, 2e13, 0.0], [10.0, 0.0]);
    supported.options.contact = compliant(7.4e12, [1e3, 2e3]);
    supported.options.damping_model = BodyOnly;
    supported.options.mass = Lumped;
    for (k, model) in [alike, damped, supported].iter().enumerate() {
        agree(model, (&[0.0, 0.3, 0.6], 12), [1e-9, 1e-7], &format!("case {k}"));
    }
}

/// Consistency check: without friction every mode but those of `n = 0` is double, and no count cuts a pair.
#[test]
fn a_cut_through_a_pair_keeps_both_members_in_both_solvers() {
    let model = paper(Quad4, 24, 5);
    for asked in 2..6 {
        let limit = Lowest(asked);
        let cyclic = model.swept(&[0.0, 0.4], limit).sweep;
        let sparse = swept(&model.whole(), &[0.0, 0.4], limit);
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
    for penalty in [7.4e12, 7.4e18, 7.4e24] {
        let mut model = paper(Quad4, 24, 5);
        model.options.contact.normal_stiffness = Some(penalty);
        let request = sweep_request(&[0.4], Lowest(8));
        let cyclic = model.sweep(&request).unwrap().sweep;
        let Ok(sparse) = sparse::sweep(&model.whole(), &request, &|_| {}) else {
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
    for (element, normal_stiffness) in [(Quad4, Some(7.4e12)), (Quad8, None)] {
        let mut model = paper(element, 24, 6);
        model.options.contact.normal_stiffness = normal_stiffness;
        let request = SweepRequest { shapes_at: &[0.6], ..sweep_request(&[0.6, 0.0], Lowest(20)) };
        let found = model.sweep(&request).unwrap();
        let tangent = model.whole();
        let matrices = [&tangent.mass, &tangent.damping, &tangent.stiffness].map(|p| dense(p, 0.6));
        assert!(found.sweep.points[1].modes.iter().all(|mode| mode.shape.is_none()));
        for mode in &found.sweep.points[0].modes {
            let shape = mode.shape.as_ref().unwrap();
            let sizes = shape.chunks(2).map(|u| u[0].norm().hypot(u[1].norm()));
            near(sizes.fold(0.0, f64::max), 1.0, 1e-12);
            let x = tangent.unknowns.restrict(shape);
            let [m, c, k] = matrices.each_ref().map(|matrix| -> Vec<c64> {
                let row = |i: usize| x.iter().enumerate().map(|(j, x)| matrix[(i, j)] * x).sum();
                (0..x.len()).map(row).collect()
            });
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
