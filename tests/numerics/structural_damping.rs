//! Structural damping `K (1 + i eta)`: closed form for one loss factor, dense complex matrices where disc and shaft have their own.

use crate::prelude::*;
use crate::shaft::STEEL;
use frictionsim::cea::sparse::mode_pairs;
use frictionsim::prestress::MotionMatrices;

fn tangent(losses: [f64; 2], damping: RayleighDamping) -> SlidingTangent {
    tangent_with(losses, damping, ContactStiffness::default(), Clamped)
}

fn tangent_with(
    [disc, shaft]: [f64; 2],
    damping: RayleighDamping,
    contact_stiffness: ContactStiffness,
    outer: BoundaryCondition,
) -> SlidingTangent {
    let specification = AnnulusSpecification { outer, ..on_shaft(annulus(Quad4, 16, 3), 1) };
    let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
    let annulus = ElasticMaterial { loss_factor: disc, ..POLYCARBONATE };
    let shaft = ElasticMaterial { loss_factor: shaft, ..STEEL };
    let materials = AnnulusMaterials { annulus, shaft: Some(shaft.into()) };
    let options = TangentOptions { damping, contact: contact_stiffness, ..TANGENT };
    linearized(&mesh, &materials, &contact(610.0), &options)
}

pub fn solved(tangent: &SlidingTangent, frictions: &[f64]) -> FrictionSweep {
    swept(tangent, frictions, Lowest(8))
}

pub fn eigenvalues(sweep: &FrictionSweep, point: usize) -> Vec<c64> {
    eigenvalues_of(&sweep.points[point].modes)
}

pub fn dense(polynomial: &MatrixPolynomial, mu: f64) -> Mat<f64> {
    let size = polynomial.dimension();
    let identity = Mat::<f64>::identity(size, size);
    polynomial.pattern().multiply(&polynomial.evaluate(mu), identity.as_ref())
}

/// Two unknowns of a response that move along the radius, with their ports.
pub fn two_unknowns(system: &FrfSystem, tangent: &SlidingTangent) -> [(usize, Port); 2] {
    let mesh = AnnulusMesh::generate(&on_shaft(annulus(Quad4, 16, 3), 1)).unwrap().mesh;
    let of_node = |node: usize| {
        let terminal = Terminal { node, direction: Direction::Radial };
        let unknown = tangent.unknowns.unknown_of[2 * node]?;
        Some((unknown, system.port(&mesh, None, terminal, "force_node").unwrap()))
    };
    let free: Vec<(usize, Port)> = (0..60).filter_map(of_node).collect();
    [free[2].clone(), free[9].clone()]
}

/// Eigenvalues with `Im > 0` of `lambda^2 M + lambda C + K + i H`, by rising frequency.
pub fn dense_eigenvalues(tangent: &SlidingTangent, mu: f64) -> Vec<c64> {
    let [m, c, k] = [&tangent.mass, &tangent.damping, &tangent.stiffness].map(|p| dense(p, mu));
    let none = || Mat::zeros(m.nrows(), m.nrows());
    let losses = tangent.structural().map_or_else(none, |p| dense(p, mu));
    let mut values = lossy_eigenvalues([&m, &c, &k, &losses]);
    values.retain(|value| value.im > 0.0);
    values.sort_by(|a, b| a.im.total_cmp(&b.im));
    values
}

/// Theory: with one loss factor for all, `lambda = lambda_0 sqrt(1 + i eta)` of the undamped eigenvalues `lambda_0`, with and
/// without friction, coupled modes included.
#[test]
fn one_loss_factor_turns_every_undamped_eigenvalue_by_the_root_of_its_stiffness() {
    let frictions = [0.0, 0.2, 0.5];
    let undamped = solved(&tangent([0.0; 2], RayleighDamping::default()), &frictions);
    for eta in [0.01, 0.3] {
        let found = solved(&tangent([eta; 2], RayleighDamping::default()), &frictions);
        let turn = c64::new(1.0, eta).sqrt();
        for point in 0..frictions.len() {
            let expected =
                eigenvalues(&undamped, point).iter().map(|v| v * turn).collect::<Vec<_>>();
            let error = largest_error(&eigenvalues(&found, point), &expected);
            below(error, 1e-9, format!("eta {eta} mu {}", frictions[point]));
        }
    }
}

/// Independent check: the dense companion matrix, of losses in disc and shaft with viscous damping beside, and of those in the springs
/// of a contact, which friction follows, and of a support; at the critical friction the dense eigenvalue has no growth.
#[test]
fn loss_factors_have_the_spectrum_of_the_dense_matrices() {
    agrees_with_the_dense_matrices(&tangent([0.02, 0.2], rayleigh_damping(20.0, 1e-7)));
    let lossy = ContactStiffness { normal_stiffness: Some(2e12), loss_factor: 0.15, ..RIGID };
    let mounting = springs([1e11, 2e11, 0.0], [0.0; 2]);
    let mounting = Support(ElasticSupport { loss_factor: 0.05, ..mounting });
    let tangent = tangent_with([0.0; 2], RayleighDamping::default(), lossy, mounting);
    agrees_with_the_dense_matrices(&tangent);
}

fn agrees_with_the_dense_matrices(tangent: &SlidingTangent) {
    let frictions = [0.0, 0.3, 0.6, 0.9];
    let found = solved(tangent, &frictions);
    for (point, &mu) in frictions.iter().enumerate() {
        let expected = dense_eigenvalues(tangent, mu);
        let own = eigenvalues(&found, point);
        let error = largest_error(&expected, &own);
        let highest = own.last().unwrap().im;
        let count = expected.iter().filter(|v| v.im <= highest * 1.000_001).count();
        below(error, 1e-9, format!("mu {mu} {count} {}", own.len()));
        assert_eq!(count, own.len(), "{mu}");
    }
    assert!(!found.intervals.is_empty());
    for interval in &found.intervals {
        let onset = dense_eigenvalues(tangent, interval.critical_friction);
        let omega = TAU * interval.frequency_hz;
        let error = largest_error(&onset, &[c64::new(0.0, omega)]);
        below(error, 1e-7, format!("critical {}", interval.critical_friction));
    }
}

/// Independent check: the receptance from the dense matrix `K + i H + i omega C - omega^2 M`.
#[test]
fn the_response_with_loss_factors_is_that_of_the_dense_matrix() {
    let tangent = tangent([0.02, 0.2], RayleighDamping::default());
    let system = FrfSystem::sliding(&tangent, 0.3);
    let [(force, at), (response, seen)] = two_unknowns(&system, &tangent);
    let lines = [500.0, 4000.0, 7000.0];
    let found = direct_response(&system, &at, &seen, &lines, &|_| {}).unwrap();
    let [mass, stiffness, lost] =
        [&tangent.mass, &tangent.stiffness, tangent.structural().unwrap()].map(|p| dense(p, 0.3));
    let n = mass.nrows();
    for (frequency, found) in lines.iter().zip(found) {
        let square = (TAU * frequency).powi(2);
        let matrix = Mat::from_fn(n, n, |i, j| {
            c64::new(stiffness[(i, j)] - square * mass[(i, j)], lost[(i, j)])
        });
        let unit = |i: usize| c64::new(f64::from(u8::from(i == force)), 0.0);
        let mut x = Mat::from_fn(n, 1, |i, _| unit(i));
        ComplexDenseLu::factorize(matrix).solve_in_place(x.as_mut());
        // Round-off of two factorizations times the condition of the matrix.
        near_each(&[found], &[x[(response, 0)]], 1e-8);
    }
}

/// Holds the derivatives of the modes at friction 0.4, by a parameter of which `with` has the tangent where it is so much more and by
/// friction, to differences of whole solutions, within what a bound makes of the sizes of eigenvalue and difference; how many modes.
pub fn follow_differences(
    with: &dyn Fn(f64) -> SlidingTangent,
    step: f64,
    bounds: [fn(f64, f64) -> f64; 2],
) -> usize {
    let mu = 0.4;
    let at = |tangent: &SlidingTangent, mu: f64| eigenvalues(&solved(tangent, &[mu]), 0);
    let (own, beside) = (with(0.0), [with(step), with(-step)]);
    let by_parameter = beside.each_ref().map(|tangent| at(tangent, mu));
    let by_friction = [mu + step, mu - step].map(|mu| at(&own, mu));
    let pairs = mode_pairs(&own, mu, &at(&own, mu));
    // Pairs +n and -n that friction has not parted have no single vector.
    for pair in pairs.iter().flatten() {
        let value = pair.eigenvalue;
        let [above, below] = beside.each_ref().map(|tangent| {
            let there = tangent.at_frequency(value.im / TAU);
            MotionMatrices::of(&there, |matrix| matrix.evaluate(mu))
        });
        let mut changes = above;
        assert_eq!([&changes, &below].map(|own| own.losses.len()), [1; 2]);
        for (change, below) in changes.each_mut().zip(below.each()) {
            let pairs = change.iter_mut().zip(below);
            pairs.for_each(|(above, below)| *above = (*above - below) / (2.0 * step));
        }
        let response = pair.response(own.stiffness.pattern(), &changes);
        let derivatives = [(response, &by_parameter), (pair.derivative, &by_friction)];
        for ((derivative, sides), bound) in derivatives.into_iter().zip(bounds) {
            let [above, below] =
                sides.each_ref().map(|all| *nearest_by(all, |other| (**other - value).norm()));
            let slope = (above - below) / (2.0 * step);
            let error = (slope - derivative).norm();
            assert!(error < bound(value.norm(), slope.norm()), "{value} {slope} {derivative}");
            assert!(derivative.norm() > 0.0, "{value}");
        }
    }
    pairs.iter().flatten().count()
}

/// Theory: a derivative by friction, and by the loss factors themselves, is that of the eigenvalue: differences of whole solutions.
#[test]
fn derivatives_with_loss_factors_are_differences_of_eigenvalues() {
    let with = |more: f64| {
        let loss_factor = 0.1 + more;
        let springs = ContactStiffness { normal_stiffness: Some(2e12), loss_factor, ..RIGID };
        tangent_with([0.02, 0.1], RayleighDamping::default(), springs, Clamped)
    };
    // The second order of the differences, where branches bend.
    assert!(follow_differences(&with, 1e-4, [|value, _| 1e-5 * value; 2]) >= 4);
}
