//! Slow sliding in three dimensions: the dashpot `mu p / V` of friction across the sliding grows without bound.
//!
//! Independent check: all eigenvalues of a coarse harmonic by a dense decomposition, at finite speed and with motion across held.

use super::*;

const FRICTION: f64 = 0.3;
const LIMIT: f64 = 9000.0;
const ONE: c64 = c64::new(1.0, 0.0);
const ZERO: c64 = c64::new(0.0, 0.0);

/// The disc on a rotor of so many turns a minute.
fn turning(element: ElementKind, divisions: [usize; 3], rpm: f64) -> SolidModel {
    let mut model = disc(element, divisions);
    model.contact.rotation_speed = rpm * TAU / 60.0;
    model
}

fn solved<M: MaterialField + Clone>(model: &SolidModel<M>) -> WaveSweep {
    model.swept(&[FRICTION], MaxFrequency(LIMIT))
}

/// Listed eigenvalues of harmonic `n`.
fn listed(found: &WaveSweep, n: usize) -> Vec<c64> {
    let modes = found.sweep.points[0].modes.iter();
    modes.filter(|mode| mode.harmonic == n).map(|mode| mode.eigenvalue).collect()
}

/// Oscillating eigenvalues of a whole harmonic below the limit, both waves with positive imaginary part; of the unknowns that move
/// those in `held` do not.
///
/// Eigenvalues `1 / (lambda - sigma)` of the linearized problem have the unknowns `(x, lambda x / sigma)`.
fn dense(model: &SolidModel, n: usize, is_held: &dyn Fn(usize) -> bool) -> Vec<c64> {
    dense_at(model, n, is_held, TAU)
}

/// The same with the stiffness of an angular frequency.
fn dense_at<M: MaterialField + Clone>(
    model: &SolidModel<M>,
    n: usize,
    is_held: &dyn Fn(usize) -> bool,
    omega: f64,
) -> Vec<c64> {
    let tangent = model.tangent();
    let (harmonic, sigma) = (tangent.harmonic(n), c64::new(TAU * LIMIT, 0.0));
    let at = harmonic.at(FRICTION);
    let kept: Vec<usize> = (0..at.dimension()).filter(|&unknown| !is_held(unknown)).collect();
    let (size, h) = (kept.len(), at.half_bandwidth);
    let full = |band: &[c64]| {
        Mat::from_fn(size, size, |i, j| {
            let (row, column) = (kept[i], kept[j]);
            let is_in = row.abs_diff(column) <= h;
            if is_in { band[row * (2 * h + 1) + column + h - row] } else { ZERO }
        })
    };
    // Losses are the conjugates for the other half of the plane.
    let halves = [1.0, -1.0].map(|sign| {
        let stiffness = full(&at.stiffness_at(c64::new(0.0, sign * omega)));
        let [mass, damping] = [&at.matrices.mass, &at.matrices.damping].map(|own| full(own));
        let values = inverse_spectrum([mass, damping, stiffness], sigma);
        values.into_iter().filter(move |value| value.im * sign > 0.0)
    });
    let is_standing = tangent.is_standing(n);
    let own = halves.into_iter().flatten().filter(|value| value.im > 0.0 || !is_standing);
    let own = own.map(|value| c64::new(value.re, value.im.abs()));
    let own = own.filter(|value| value.im < TAU * LIMIT && value.norm() < 1.19 * TAU * LIMIT);
    // Slower motions are creep of the contact against its dashpots.
    let is_slow = |own: &c64| own.im <= 0.1 * own.norm() || own.norm() <= 1.2e-3 * TAU * LIMIT;
    own.filter(|own| !is_slow(own)).collect()
}

/// Eigenvalues of `M`, `C`, `K` from those of the inverse at a shift.
fn inverse_spectrum([mass, damping, stiffness]: [Mat<c64>; 3], sigma: c64) -> Vec<c64> {
    let size = mass.nrows();
    let shifted = Mat::from_fn(size, size, |i, j| {
        stiffness[(i, j)] + sigma * (damping[(i, j)] + sigma * mass[(i, j)])
    });
    let lu = ComplexDenseLu::factorize(shifted);
    let (mut x, mut y) = (stiffness, mass);
    lu.solve_in_place(x.as_mut());
    lu.solve_in_place(y.as_mut());
    let unit = |i: usize, j: usize| if i == j { ONE } else { ZERO };
    let inverse = Mat::from_fn(2 * size, 2 * size, |i, j| match (i < size, j < size) {
        (true, true) => (x[(i, j)] - unit(i, j)) / sigma,
        (true, false) => -sigma * y[(i, j - size)],
        (false, true) => x[(i - size, j)] / sigma,
        (false, false) => -sigma * y[(i - size, j - size)],
    });
    inverse.eigenvalues().unwrap().iter().map(|value| sigma + value.inv()).collect()
}

/// What the small space leaves out is all that may differ.
fn assert_equal(found: &WaveSweep, n: usize, exact: &[c64], what: &str) {
    let listed = listed(found, n);
    assert!(!exact.is_empty(), "{what}, n = {n}");
    assert_eq!(listed.len(), exact.len(), "{what}, n = {n}");
    let error = largest_error(exact, &listed).max(largest_error(&listed, exact));
    let bound = 10.0 * found.reduction_error + 1e-9;
    below(error, bound, format_args!("{what}, n = {n}"));
    assert!(bound < 1e-3, "{what}: {bound:e}");
}

#[test]
fn slow_sliding_has_the_eigenvalues_of_a_dense_solution_of_the_whole_harmonic() {
    for (element, divisions) in [(Quad4, [24, 6, 2]), (Quad8, [24, 4, 1])] {
        let all = [(0.1, 0.0), (1.0, 0.0), (10.0, 0.0), (100.0, 0.0), (10.0, 0.1), (100.0, 0.05)];
        for (rpm, loss_factor) in all {
            let mut model = turning(element, divisions, rpm);
            model.material.loss_factor = loss_factor;
            let found = solved(&model);
            for n in [0, 1, 3] {
                let exact = dense(&model, n, &|_| false);
                assert_equal(&found, n, &exact, &format!("{element:?} {rpm} rpm {loss_factor}"));
            }
        }
    }
}

/// Exact: with a table a mode is one of the stiffness of its own frequency, and as many lie below the limit as with that of the limit.
#[test]
fn slow_sliding_with_a_table_has_the_eigenvalues_of_dense_solutions_at_their_frequencies() {
    let rows = vec![[0.0, 1e9, 0.05], [4000.0, 2e9, 0.2], [20000.0, 5e9, 0.1]];
    for rpm in [10.0, 1e4] {
        let SolidModel { specification, material, options, contact } =
            turning(Quad4, [24, 6, 2], rpm);
        let table = Some(Arc::new(ModulusTable::new("material.table", "rubber.csv", rows.clone())));
        let elastic = ElasticMaterial { young_modulus: 1e9, ..material };
        let material = vec![RegionMaterial { table, ..elastic.into() }];
        let model = SolidModel { specification, material, options, contact };
        let found = solved(&model);
        for n in [0, 1, 2] {
            let listed = listed(&found, n);
            for value in &listed {
                let exact = dense_at(&model, n, &|_| false, value.im);
                below(largest_error(&exact, &[*value]), 1e-9, format_args!("{rpm} rpm, n = {n}"));
            }
            let below = dense_at(&model, n, &|_| false, TAU * LIMIT).len();
            assert!(below > 0 && listed.len() == below, "{rpm} rpm, n = {n}: {listed:?}");
        }
    }
}

#[test]
fn a_ring_on_a_penalty_contact_has_the_eigenvalues_of_a_dense_solution_when_it_turns_slowly() {
    for rpm in [0.1, 10.0] {
        let mut model = turning(Quad8, [24, 7, 1], rpm);
        model.specification.contact = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.07 };
        model.specification.conditions[3] = Guide;
        model.contact.interference = 5e-6;
        model.options.contact.normal_stiffness = Some(1e12);
        let found = solved(&model);
        for n in [0, 1] {
            let exact = dense(&model, n, &|_| false);
            assert_equal(&found, n, &exact, &format!("ring at {rpm} rpm"));
        }
    }
}

/// At friction 0.8 a motion of four nodal diameters creeps at -118 - 15i 1/s against the dashpots, and no iteration finds its vectors: the
/// whole disc was refused. Independent check: the onsets of the whole mesh, whose base state has contact points of its own.
#[test]
fn creep_without_vectors_of_its_own_leaves_the_other_modes() {
    let set = "contact.rotation_speed_rpm=1.0 ; mesh.element=quad4 ; mesh.radial_elements=3 ; \
               mesh.circumferential_elements=24 ; cea.friction_coefficients=[0.0, 0.4, 0.8] ; \
               cea.shapes_at=[] ; cea.max_frequency_hz=9700.0";
    let [waves, whole] = METHODS.map(|method| {
        let run = Run::of("cea", shipped("disc-three-dimensions.toml")).set(&[set, method]);
        column(&run.out("out").done().rows("stability.csv"), "critical_friction")
    });
    assert_eq!(waves.len(), 5, "{waves:?}");
    near_each(&waves, &whole, 2e-3);
}

#[test]
fn sliding_that_comes_to_rest_has_the_spectrum_with_the_motion_across_it_held() {
    let model = turning(Quad4, [24, 6, 2], 1e-7);
    let across = model.tangent().sideways_unknowns();
    let found = solved(&model);
    for n in [0, 2] {
        let held = dense(&model, n, &|unknown| across.contains(&unknown));
        assert_equal(&found, n, &held, "held");
    }
}

#[test]
fn the_note_names_the_dashpot_of_friction_and_not_the_damping_of_the_material() {
    let set = ["contact.rotation_speed_rpm=10.0 ; cea.friction_coefficients=[0.4] ; \
         mesh.circumferential_elements=24 ; mesh.radial_elements=7 ; mesh.axial_elements=1"];
    let answer = Run::of("cea", shipped("ring-on-layer.toml")).set(&set).done();
    answer.says(&["Friction across the sliding overdamps them: it is a dashpot of mu p / V ; \
         !damping.stiffness_coefficient set it"]);
}
