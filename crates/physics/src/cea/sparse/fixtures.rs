//! Small problems for the unit tests.

use crate::fem::{DofMap, RayleighDamping};
use crate::linalg::MatrixPolynomial;
use crate::prestress::{ContactDofs, SlidingTangent};

/// A chain of `count` unit masses and springs whose even masses push the odd ones along by friction.
pub fn string_on_belt(count: usize, coupling: f64, is_proportional: bool) -> SlidingTangent {
    let mut elastic: Vec<(usize, usize, f64)> = (0..count).map(|i| (i, i, 2.01)).collect();
    for i in 0..count - 1 {
        elastic.extend([(i, i + 1, -1.0), (i + 1, i, -1.0)]);
    }
    let friction = (0..count / 2).map(|i| (2 * i + 1, 2 * i, coupling)).collect();
    let stiffness = MatrixPolynomial::from_triplets(count, &[elastic, friction]);
    let masses = (0..count).map(|i| (i, i, 1.0)).collect();
    let mass = MatrixPolynomial::on_pattern(stiffness.pattern(), &[masses]);
    let damping = RayleighDamping { mass_coefficient: 1e-3, stiffness_coefficient: 1e-3 };
    SlidingTangent {
        damping: MatrixPolynomial::combination(
            damping.mass_coefficient,
            &mass,
            damping.stiffness_coefficient,
            &stiffness,
        ),
        mass,
        stiffness,
        losses: Vec::new(),
        proportional: is_proportional.then_some(damping),
        unknowns: DofMap::excluding(count, []),
        contact: ContactDofs { sliding_direction: 1.0, ..ContactDofs::default() },
        is_gyroscopic: false,
        distances: Vec::new(),
        friction: Vec::new(),
    }
}
