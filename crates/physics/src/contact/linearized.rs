//! Small motions of contact points around steady sliding.

use super::{ContactStiffness, Point};
use crate::fem::Triplets;
use crate::linalg::FrictionWeights;
use std::collections::BTreeMap;

/// The bodies under one set of pressed points, as polynomials in `mu - a`, `mu` the friction coefficient and `a` where they begin,
/// [`Self::frozen_below`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PressedState {
    /// Displacement of all dofs by power of `mu - a`, m.
    pub displacements: Vec<Vec<f64>>,
    /// Normal force on each contact point by power of `mu - a`, N (N/m in the plane).
    pub normal_forces: Vec<Vec<f64>>,
    /// Stiffness of each contact point at its force by power of `mu - a`, N/m; none where no contact stiffens.
    pub stiffnesses: Vec<Vec<f64>>,
    /// Whether each contact point is pressed; the others are open.
    pub is_pressed: Vec<bool>,
    /// Friction coefficient `a` below which the tangent keeps the state as it is there: the polynomials of contact that stiffens say
    /// nothing beyond their range, and the eigenvalue analysis starts without friction. 0 where they hold from there on.
    pub frozen_below: f64,
}

/// Linearises contact and friction at `points` around `state`, among whose points they begin at `first`, moved to the left-hand side:
///
/// ```text
/// dN = -w (k_n n.u + c_n n.u')                                       (rigid contact: unknown, n.u = 0)
/// dT = drag mu dN - (slope mu N + w c_t) t.u' ,   dD = -(|drag| mu N / V + w c_t) d.u'
/// ```
///
/// along the rows `n`, `t` and `d` of normal, slip and slip across, with `k_n` at the base state's pressure where contact
/// stiffens: friction follows the normal force, falls with the slip speed, and turns with the direction of slip. Forces of the
/// base state turn with the surfaces beside ([`super::turned`]).
///
/// Returns the stiffness, nothing of rigid contact, and the dashpots of the contact, both with the friction that follows them; then
/// dashpots of friction whose force the base state has, which come with its first power. Shape: sums over all dofs of both bodies, N/m and
/// N s/m, by power of `mu`; of a state that is frozen in the terms of
/// [`MatrixPolynomial::frozen_below`](crate::linalg::MatrixPolynomial::frozen_below).
pub fn linearized(
    points: &[Point],
    (state, first): (&PressedState, usize),
    stiffness: &ContactStiffness,
) -> [Vec<Triplets>; 3] {
    let [mut springs, mut dashpots, mut dragging]: [Products<'_>; 3] = Default::default();
    let weights = FrictionWeights::frozen_below(state.frozen_below);
    let pressed = || (0..points.len()).filter(|&i| state.is_pressed[first + i]);
    for point in pressed().map(|i| &points[i]) {
        let weight = point.weight;
        // Springs and dashpots of the contact itself.
        if let (Some(normal), []) = (stiffness.normal_stiffness, &state.stiffnesses[..]) {
            add_normal_law(&mut springs, (0, weights), point, weight * normal);
        }
        if stiffness.normal_damping != 0.0 {
            let value = weight * stiffness.normal_damping;
            add_normal_law(&mut dashpots, (0, weights), point, value);
        }
        if stiffness.tangential_damping != 0.0 {
            let value = weight * stiffness.tangential_damping;
            let both = [&point.slip[..], &point.across].map(|row| (value, row, row));
            power(&mut dashpots, 0).extend(both);
        }
    }
    for (p, own) in state.stiffnesses.iter().enumerate() {
        for i in pressed() {
            add_normal_law(&mut springs, (p, weights), &points[i], own[first + i]);
        }
    }
    // What the forces of the base state do.
    for (p, forces) in state.normal_forces.iter().enumerate() {
        for i in pressed() {
            let (point, force) = (&points[i], forces[first + i]);
            let rates = [point.friction.slope, point.friction.drag.abs() / point.speed];
            for (row, rate) in [&point.slip, &point.across].into_iter().zip(rates) {
                let terms = weights.times_mu(weights.place(p));
                for (term, factor) in terms.filter(|_| rate != 0.0 && !row.is_empty()) {
                    power(&mut dragging, term).push((factor * (rate * force), row, row));
                }
            }
        }
    }
    [springs, dashpots, dragging].map(|own| sums(&own))
}

/// A row of dofs with values.
type Entries = [(usize, f64)];
/// Products `factor row column^T` by power of friction.
pub(super) type Products<'a> = Vec<Vec<(f64, &'a Entries, &'a Entries)>>;

/// Their sums, row by row: thousands of points share few nodes.
pub(super) fn sums(products: &Products<'_>) -> Vec<Triplets> {
    let sum = |products: &Vec<(f64, &Entries, &Entries)>| {
        let mut by_row: BTreeMap<usize, Vec<(f64, &Entries)>> = BTreeMap::new();
        let mut columns = 0;
        for &(factor, row, column) in products.iter().filter(|own| own.0 != 0.0) {
            columns = column.iter().fold(columns, |m, own| m.max(own.0 + 1));
            for &(i, along) in row {
                by_row.entry(i).or_default().push((factor * along, column));
            }
        }
        let rows = by_row.into_iter().map(|(row, own)| {
            let own = own.into_iter();
            (row, own.flat_map(|(f, column)| column.iter().map(move |&(j, a)| (j, f * a))))
        });
        Triplets::of_rows(columns, rows)
    };
    products.iter().map(sum).collect()
}

/// `dN = -coefficient mu^p n.u` and the friction that follows it.
fn add_normal_law<'a>(
    terms: &mut Products<'a>,
    (p, weights): (usize, FrictionWeights),
    point: &'a Point,
    coefficient: f64,
) {
    let place = weights.place(p);
    power(terms, place).push((coefficient, &point.normal, &point.normal));
    for (term, factor) in weights.times_mu(place) {
        let follow = point.friction.drag * factor * coefficient;
        power(terms, term).push((follow, &point.slip, &point.normal));
    }
}

/// The coefficient of a term, made where it is not yet there.
pub(super) fn power<T: Default>(terms: &mut Vec<T>, p: usize) -> &mut T {
    if terms.len() <= p {
        terms.resize_with(p + 1, T::default);
    }
    &mut terms[p]
}
