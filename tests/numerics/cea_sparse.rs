//! The sparse eigenvalue sweep against closed forms, dense decompositions and another iteration
//! (independent checks, unless a test says otherwise).

mod counts;

use crate::prelude::*;
use frictionsim::cea::sparse::*;
use frictionsim::linalg::SparseLu;

type Entries = Vec<(usize, usize, f64)>;

/// A problem without a contact edge from the entries of `M`, `C` and `K` by power of `mu`.
fn problem(
    size: usize,
    [mass, damping, stiffness]: [Vec<Entries>; 3],
    proportional: Option<RayleighDamping>,
) -> SlidingTangent {
    let all = [&stiffness, &mass, &damping].map(|own| own.concat()).concat();
    let pattern = MatrixPolynomial::from_triplets(size, &[all]);
    let on = |terms: &[Entries]| MatrixPolynomial::on_pattern(pattern.pattern(), terms);
    let (mass, stiffness) = (on(&mass), on(&stiffness));
    let damping = match proportional {
        Some(RayleighDamping { mass_coefficient: alpha, stiffness_coefficient: beta }) => {
            MatrixPolynomial::combination(alpha, &mass, beta, &stiffness)
        }
        None => on(&damping),
    };
    bare([mass, damping, stiffness], proportional, DofMap::excluding(size, []))
}

/// Matrices without a contact.
pub fn bare(
    [mass, damping, stiffness]: [MatrixPolynomial; 3],
    proportional: Option<RayleighDamping>,
    unknowns: DofMap,
) -> SlidingTangent {
    SlidingTangent {
        mass,
        damping,
        stiffness,
        losses: Vec::new(),
        proportional,
        unknowns,
        contact: ContactDofs { sliding_direction: 1.0, ..ContactDofs::default() },
        is_gyroscopic: false,
        distances: Vec::new(),
        friction: Vec::new(),
    }
}

/// The paper's disc on so many elements around and across.
fn disc(around: usize, across: usize, damping_model: DampingModel) -> SlidingTangent {
    let mut model = paper(Quad4, around, across);
    model.options.damping_model = damping_model;
    model.whole()
}

/// Consistency: what grows just above the modes asked for is told as a longer list has it, and nothing where nothing grows.
#[test]
fn an_unstable_mode_just_above_the_list_is_told() {
    let tangent = disc(48, 10, WholeTangent);
    let values = [0.0, 0.15, 0.3];
    let all = swept(&tangent, &values, Lowest(12));
    let last = &all.points[2].modes;
    assert!(!last[..2].iter().any(ComplexMode::is_unstable));
    let few = swept(&tangent, &values, Lowest(2));
    let (friction, beyond) = few.beyond().unwrap();
    let apart = |mode: &&ComplexMode| (mode.frequency_hz() / beyond.frequency_hz() - 1.0).abs();
    let listed = nearest_by(last, apart);
    assert_eq!(friction, 0.3);
    let growth = listed.growth_rate() / beyond.growth_rate();
    assert!(apart(&listed) < 1e-6 && (growth - 1.0).abs() < 1e-6, "{listed:?}");
    assert!(swept(&tangent, &[0.0], Lowest(2)).beyond().is_none());
    // The next one is always known.
    let mut below = (1..last.len()).filter(|&count| last[count].is_unstable());
    assert!(below.all(|count| swept(&tangent, &values, Lowest(count)).beyond().is_some()));
}

/// Whatever lists the modes: of a whole mesh, of waves, of a part that stands free.
#[test]
fn a_mode_on_a_limit_in_frequency_is_listed_and_one_that_a_limit_in_number_parts_from_its_pair() {
    let selected = |limit: ModeLimit| limit.selected([1.0, TAU, TAU, 7.0].into_iter());
    assert_eq!([MaxFrequency(1.0), Lowest(2), Lowest(1)].map(selected), [3, 3, 1]);
}

/// `mu_c = (c^2 + ((A - B)/2)^2) / (c d)`: where the two eigenvalues of `K` meet.
#[test]
fn two_degrees_of_freedom_flutter_at_the_closed_form_friction() {
    for (a, b, c, d) in [(4.0, 3.0, 0.5, 2.0), (9.0, 4.0, 1.0, 10.0), (2.0, 2.0, 0.3, 1.0)] {
        let critical = (c * c + 0.25_f64 * (a - b) * (a - b)) / (c * d);
        let stiffness = vec![vec![(0, 0, a), (0, 1, c), (1, 0, c), (1, 1, b)], vec![(0, 1, -d)]];
        let mass = vec![vec![(0, 0, 1.0), (1, 1, 1.0)]];
        let undamped = Some(RayleighDamping::default());
        let tangent = problem(2, [mass, Vec::new(), stiffness], undamped);
        let values: Vec<f64> = (0..12).map(|i| f64::from(i) * critical / 7.3).collect();
        let result = swept(&tangent, &values, Lowest(2));
        assert_eq!(result.intervals.len(), 1, "{:?}", result.intervals);
        let found = &result.intervals[0];
        // At the double root the growth rate rises like the square root of the distance: 1e-6 in mu.
        near(found.critical_friction, critical, 1e-6);
        near(found.frequency_hz, (0.5_f64 * (a + b)).sqrt() / TAU, 1e-3);
        assert!(!found.unstable_from_start && found.restabilized.is_none());
    }
}

/// `kappa_0 = 1 + mu` passes `kappa_1 = 1.1` and then `kappa_2 = 1.2`, coupled to each by `+-s mu`: a pair that would meet at `d` is
/// unstable from `d / (1 + 2 s)` to `d / (1 - 2 s)`, and nothing grows at either of the friction values asked for.
#[test]
fn modes_that_grow_only_as_they_meet_between_two_values_are_found() {
    let coupling = 0.01;
    let size = 6;
    let mut rate = vec![(0, 0, 1.0)];
    rate.extend([1, 2].into_iter().flat_map(|i| [(0, i, coupling), (i, 0, -coupling)]));
    let at_rest = [1.0, 1.1, 1.2, 4.0, 9.0, 16.0];
    let diagonal = |values: &dyn Fn(usize) -> f64| (0..size).map(|i| (i, i, values(i))).collect();
    let stiffness = vec![diagonal(&|i| at_rest[i]), rate];
    let mass: Vec<Entries> = vec![diagonal(&|_| 1.0)];
    for alpha in [0.0, 1e-5] {
        let damping = RayleighDamping { mass_coefficient: alpha, stiffness_coefficient: 0.0 };
        let parts = [mass.clone(), Vec::new(), stiffness.clone()];
        let tangent = problem(size, parts, Some(damping));
        let mut found = swept(&tangent, &[0.0, 0.3], ModeLimit::Lowest(3)).intervals.clone();
        found.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
        assert_eq!(found.len(), 2, "{found:?}");
        for (own, meeting) in found.iter().zip([0.1, 0.2]) {
            let ends = [own.critical_friction, own.restabilized.unwrap().0];
            for (end, sign) in ends.into_iter().zip([1.0, -1.0]) {
                let exact = meeting / (1.0 + sign * 2.0 * coupling);
                // The third mode of the three moves them by 2e-4.
                assert!((end - exact).abs() < 5e-4 * exact, "{found:?}");
            }
        }
    }
}

/// Every eigenvalue of a small unsymmetric problem with general damping, against the dense companion matrix at each friction coefficient.
#[test]
fn sweep_of_a_general_quadratic_problem_equals_a_dense_decomposition() {
    let size = 14;
    let [r, s, t] = [1, 2, 3].map(|seed| random_columns(size, size, seed));
    let entries = |value: &dyn Fn(usize, usize) -> f64| -> Entries {
        let places = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
        places.map(|(i, j)| (i, j, value(i, j))).collect()
    };
    let diagonal = |i: usize, j: usize, v: f64| if i == j { v } else { 0.0 };
    let stiffness = vec![
        entries(&|i, j| diagonal(i, j, 4.0 + 3.0 * i as f64) + 0.5 * (r[(i, j)] + r[(j, i)])),
        entries(&|i, j| if i % 3 == 0 { s[(i, j)] } else { 0.0 }),
        entries(&|i, j| if i % 3 == 0 { 0.1 * t[(i, j)] } else { 0.0 }),
    ];
    let mass = vec![
        entries(&|i, j| diagonal(i, j, 1.0) + 0.05 * (t[(i, j)] + t[(j, i)])),
        entries(&|i, j| if i % 3 == 0 { 0.05 * r[(i, j)] } else { 0.0 }),
    ];
    let damping = vec![
        entries(&|i, j| diagonal(i, j, 0.02 * (i + 1) as f64) + 0.01 * (s[(i, j)] + s[(j, i)])),
        entries(&|i, j| if i % 3 == 0 { 0.1 * r[(i, j)] } else { 0.0 }),
    ];
    let tangent = problem(size, [mass, damping, stiffness], None);
    let values = [0.0, 0.2, 0.45, 0.8];
    let result = swept(&tangent, &values, Lowest(8));
    for point in &result.points {
        let dense = dense_eigenvalues(&tangent, point.friction_coefficient);
        near_each(&eigenvalues_of(&point.modes), &dense[..8], 1e-9);
    }
}

/// Modes by rising frequency from the `wanted` largest eigenvalues of the operator with the factors of `K(mu)`.
fn exact_modes(tangent: &SlidingTangent, of: Linearization, mu: f64, wanted: usize) -> Vec<c64> {
    let matrices = StructureMatrices::at(tangent, of, mu);
    let analysis = LuAnalysis::new(tangent.stiffness.pattern()).unwrap();
    let factors = SparseLu::factorize(&analysis, tangent.stiffness.evaluate(mu)).unwrap();
    let operator = ShiftInverted::new(&matrices, &factors);
    let settings = crate::eigen_linear_algebra::settings(wanted);
    let settings = KrylovSchurSettings { tolerance: 1e-11, max_applications: 5000, ..settings };
    let start = random_columns(operator.dimension(), 3, 0x5eed);
    let pairs = krylov_schur(&operator, start, &|_| true, &settings).unwrap();
    assert!(pairs.residuals.iter().all(|residual| *residual <= 1e-11));
    let mut exact: Vec<c64> = pairs.values.iter().filter_map(|&s| of.eigenvalue(s)).collect();
    exact.sort_by(|a, b| a.im.total_cmp(&b.im));
    exact
}

/// The sweep's common basis, and modes interpolated between sampled friction values where damping is not proportional, against a
/// Krylov-Schur iteration on vectors of full length with the factors of `K(mu)` itself.
#[test]
fn sweep_agrees_with_krylov_schur_at_every_friction() {
    let many = (0..9).map(|i| f64::from(i) * 0.075).collect();
    let kinds = [(WholeTangent, vec![0.6], 24, 30, 1e-12), (BodyOnly, many, 8, 24, 1e-9)];
    for (damping_model, values, count, wanted, residual) in kinds {
        let tangent = disc(48, 10, damping_model);
        let linearization = Linearization::of(&tangent, 1e5, Centre::default());
        let points = swept(&tangent, &values, Lowest(count)).points.into_iter();
        for point in points.filter(|point| point.friction_coefficient > 0.0) {
            let mu = point.friction_coefficient;
            let exact = exact_modes(&tangent, linearization, mu, wanted);
            near_each(&eigenvalues_of(&point.modes), &exact[..point.modes.len()], 1e-9);
            assert!(point.modes.len() >= count);
            assert!(point.modes.iter().all(|mode| mode.residual < residual), "{mu}");
        }
    }
}

#[test]
fn sweep_is_bitwise_equal_on_one_and_two_threads() {
    let tangent = disc(48, 10, WholeTangent);
    let values: Vec<f64> = (0..9).map(|i| f64::from(i) * 0.1).collect();
    let request =
        SweepRequest { shapes_at: &[values[3]], ..sweep_request(&values, MaxFrequency(15_000.0)) };
    let solve = || sweep(&tangent, &request, &|_| {}).unwrap();
    let (one, two) = (on_threads(1, solve), on_threads(2, solve));
    assert!(one == two);
    assert!(one.points[3].modes.iter().all(|m| m.shape.is_some()));
    assert!(one.points[2].modes.iter().all(|m| m.shape.is_none()));
}

/// Consistency check: where branches are only followed, growth has the sign and critical friction the digits of a sweep that
/// solves all, and eigenvalues are wrong by a part of their growth.
#[test]
fn branches_that_are_only_followed_have_the_same_onsets() {
    for damping_model in [WholeTangent, BodyOnly] {
        let tangent = disc(48, 10, damping_model);
        let values = [0.26, 0.27, 0.28, 0.29, 0.3, 0.31, 0.32, 0.33, 0.34];
        let strict = SweepRequest { is_continued: true, ..sweep_request(&values, Lowest(12)) };
        let followed = SweepRequest { followed_at: &values, ..strict };
        let [strict, followed] =
            [strict, followed].map(|own| sweep(&tangent, &own, &|_| {}).unwrap());
        let criticals = |found: &FrictionSweep| -> Vec<f64> {
            found.intervals.iter().map(|own| own.critical_friction).collect()
        };
        assert!(!strict.intervals.is_empty());
        near_each(&criticals(&strict), &criticals(&followed), 1e-9);
        let mut largest: f64 = 0.0;
        for (own, other) in strict.points.iter().zip(&followed.points) {
            let grow = |point: &FrictionPoint| -> Vec<bool> {
                point.modes.iter().map(ComplexMode::is_unstable).collect()
            };
            assert_eq!(grow(own), grow(other), "{}", own.friction_coefficient);
            // Errors are a part of the growth: 0.02 of it at most.
            for (exact, found) in own.modes.iter().zip(&other.modes) {
                let error = (found.eigenvalue - exact.eigenvalue).norm();
                assert!(error < 0.3 * exact.eigenvalue.re.abs(), "{error} {exact:?}");
                largest = largest.max(error / exact.eigenvalue.norm());
            }
        }
        assert!(largest > 1e-9, "nothing was left open: {largest}");
    }
}

/// Consistency check: a sweep that finds the first steps of an earlier run goes on to the same bits, with proportional
/// and with any damping, and does the other steps alone.
#[test]
fn sweep_goes_on_from_any_step_to_the_same_bits() {
    for damping_model in [WholeTangent, BodyOnly] {
        let tangent = disc(24, 6, damping_model);
        let request = sweep_request(&[0.1, 0.2, 0.3], Lowest(6));
        let first = Kept::default();
        let whole = sweep(&tangent, &request, &first).unwrap();
        let steps = first.count();
        assert!(steps > 4, "{steps}");
        for done in [1, 2, steps - 2, steps] {
            let rest = first.after(done);
            assert!(sweep(&tangent, &request, &rest).unwrap() == whole);
            assert_eq!(rest.count(), steps - done);
        }
    }
}
