//! Largest natural frequency of an operator.

use super::{AlignedVector, StiffnessOperator};

/// Lanczos steps between two looks at the largest eigenvalue, and at most.
const STRIDE: usize = 20;
const LONGEST: usize = 2000;

/// Relative change over one stride below which the value has settled.
const TOLERANCE: f64 = 1e-10;

/// Largest undamped angular frequency `omega_max` of `M^-1 K` with a free contact edge, rad/s, by the Lanczos
/// method in the inner product of the mass.
///
/// Without reorthogonalization: copies of converged eigenvalues do not move the largest. Estimates rise towards the true value; they stop
/// when they have settled to ten digits. The start vector is fixed, so every run gets the same value.
pub fn largest_frequency(operator: &dyn StiffnessOperator) -> f64 {
    largest_frequency_of(operator, &|_| true)
}

/// The same of one of several bodies that the operator does not connect, the one whose dofs are `is_part`.
pub fn largest_frequency_of(
    operator: &dyn StiffnessOperator,
    is_part: &dyn Fn(usize) -> bool,
) -> f64 {
    let masses = operator.masses();
    let dot = |a: &[f64], b: &[f64]| -> f64 {
        let products = a.iter().zip(b).zip(masses);
        // Padding has no mass, but may hold anything finite.
        products.map(|((x, y), m)| x * y * m).sum()
    };
    let mut current = start_vector(operator, is_part);
    let mut previous = AlignedVector::zeros(operator.field_length());
    let mut next = previous.clone();
    let (mut diagonal, mut coupling) = (Vec::new(), Vec::new());
    let norm = dot(&current, &current).sqrt();
    current.iter_mut().for_each(|x| *x /= norm);
    let mut top = 0.0;
    for step in 0..LONGEST {
        operator.multiply(&mut current, &mut next);
        let alpha = dot(&current, &next);
        let beta = if step > 0 { coupling[step - 1] } else { 0.0 };
        for ((y, x), w) in next.iter_mut().zip(current.iter()).zip(previous.iter()) {
            *y -= alpha * x + beta * w;
        }
        diagonal.push(alpha);
        let beta = dot(&next, &next).sqrt();
        // An invariant subspace: the start vector holds no more than this.
        let is_exhausted = beta <= 1e-12 * alpha.abs();
        if is_exhausted || (step + 1).is_multiple_of(STRIDE) {
            let settled = top;
            top = largest_tridiagonal(&diagonal, &coupling);
            if is_exhausted || top - settled <= TOLERANCE * top {
                break;
            }
        }
        coupling.push(beta);
        next.iter_mut().for_each(|y| *y /= beta);
        std::mem::swap(&mut previous, &mut current);
        std::mem::swap(&mut current, &mut next);
    }
    top.sqrt()
}

/// Values in (-1, 1) from a fixed linear congruence on every dof that moves.
fn start_vector(
    operator: &dyn StiffnessOperator,
    is_part: &dyn Fn(usize) -> bool,
) -> AlignedVector {
    let mut vector = AlignedVector::zeros(operator.field_length());
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    for dof in 0..operator.dof_count() {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let place = operator.position(dof);
        if operator.masses()[place] > 0.0 && is_part(dof) {
            vector[place] = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        }
    }
    vector
}

/// Largest eigenvalue of a symmetric tridiagonal matrix by bisection on the Sturm count.
fn largest_tridiagonal(diagonal: &[f64], coupling: &[f64]) -> f64 {
    let reach = |i: usize| {
        let left = if i > 0 { coupling[i - 1].abs() } else { 0.0 };
        left + coupling.get(i).map_or(0.0, |c| c.abs())
    };
    let mut high = (0..diagonal.len()).map(|i| diagonal[i] + reach(i)).fold(f64::MIN, f64::max);
    let mut low = diagonal.iter().copied().fold(f64::MIN, f64::max);
    while high - low > 1e-15 * high.abs() {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        // The pivots of T - x are all negative exactly when x lies above every eigenvalue.
        let mut pivot = diagonal[0] - middle;
        let mut next = (1..diagonal.len()).map(|i| {
            pivot = diagonal[i] - middle - coupling[i - 1] * coupling[i - 1] / pivot;
            pivot
        });
        let is_above = diagonal[0] < middle && next.all(|pivot| pivot < 0.0);
        *if is_above { &mut high } else { &mut low } = middle;
    }
    high
}
