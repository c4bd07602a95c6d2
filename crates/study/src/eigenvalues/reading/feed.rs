//! Where on the contact surfaces friction feeds the unstable modes, point by point.
//!
//! The forces of the bodies are `f = sum_i dN_i (n_i + mu drag_i t_i) - sum_i D_i phi` over the contact points `i`,
//! with `D_i = lambda C_i + K_i + i H_i` of dashpots, stiffness and structural damping. A rigid one has an unknown
//! `dN_i = lift_i . (f + sum_j D_j phi)`. The growth rate that a point feeds is
//!
//! ```text
//! sigma_i = Im(conj(n_i.phi + mu drag_i t_i.phi) dN_i - phi^H D_i phi) / (2 omega m)
//! ```
//!
//! and their sum what the contact feeds in the budget, without a remainder.

use super::{budget::Sums, parts::Parts, shapes::Shapes};
use crate::eigenvalues::whole::BasePoint;
use crate::*;
use frictionsim_physics::contact::{PressedState, linearized, turned};
use frictionsim_results::cea::ModeFeed;

/// Stiffness, dashpots and structural damping of one point over all dofs at a friction coefficient.
type PointTerms = [Vec<(usize, usize, f64)>; 3];

/// The feed of every unstable mode at the case's own friction coefficient.
pub(super) fn feed(parts: &Parts<'_>, points: &[&FrictionPoint]) -> Vec<ModeFeed> {
    let (case, whole) = (parts.case, parts.whole);
    let friction = case.contact.sliding.friction_coefficient;
    let own = points.iter().find(|p| p.friction_coefficient == friction);
    let shapes = own.map(|own| Shapes::of(own, case.body.has_sectors(), |mode| mode.is_unstable()));
    let Some(shapes) = shapes.filter(|own| !own.modes.is_empty()) else { return Vec::new() };
    let pressed = whole.contact_points(case);

    // Forces of the bodies at every dof, those of the contact's own terms beside them.
    let mut sums = Sums::new(&shapes, true);
    parts.of_bodies(&shapes, &mut sums);
    // Forces and springs at the friction coefficient are the only power of it.
    let state = whole.state();
    let only = |own: Vec<f64>| if own.is_empty() { Vec::new() } else { vec![own] };
    let at_own = PressedState {
        normal_forces: only(state.normal_forces(friction)),
        stiffnesses: only(state.springs(friction)),
        is_pressed: state.is_pressed.clone(),
        ..PressedState::default()
    };
    let places = pressed.iter().enumerate();
    let terms = places.map(|(first, own)| terms(own, (&at_own, first), friction));
    let terms: Vec<PointTerms> = terms.collect();
    let beta = parts.whole.options.damping_of_tangent().stiffness_coefficient;
    let modes = sums.balance.unwrap_or_default().into_iter().enumerate().map(|(i, mut forces)| {
        let (lambda, phi) = (shapes.modes[i].1.eigenvalue, shapes.column(i));
        // beta_R multiplies stiffness of prestress and contact too, where the damping has them.
        let of_stiffness = c64::ONE + lambda * beta;
        let factors = [of_stiffness, lambda, c64::I];
        for own in &terms {
            for (entries, factor) in own.iter().zip(factors) {
                for &(row, column, value) in entries {
                    forces[row] += factor * phi[column] * value;
                }
            }
        }
        let scale = 1.0 / (2.0 * lambda.im * sums.kinetic[i]);
        let points = pressed.iter().zip(&state.is_pressed).zip(&terms);
        let rates = points.map(|((own, is_pressed), terms)| {
            let held = if *is_pressed { held(own, friction, &phi, &forces) } else { 0.0 };
            scale * (held - form(terms, factors, &phi).im)
        });
        ModeFeed { mode: shapes.name(i), rates: rates.collect() }
    });
    modes.collect()
}

/// `Im(conj(n.phi + mu drag t.phi) dN)` of a point that is pressed and rigid; 0 of one that has springs.
fn held(own: &BasePoint<'_>, friction: f64, phi: &[c64], forces: &[c64]) -> f64 {
    if own.stiffness.normal_stiffness.is_some() {
        return 0.0;
    }
    let along = |row: &[(usize, f64)], values: &[c64]| -> c64 {
        row.iter().map(|&(dof, share)| values[dof] * share).sum()
    };
    let normal = along(&own.point.lift, forces);
    let drag = friction * own.point.friction.drag;
    let moved = along(&own.point.normal, phi) + along(&own.point.slip, phi) * drag;
    (moved.conj() * normal).im
}

/// `phi^H (f_K K_i + f_C C_i + f_H H_i) phi`.
fn form(terms: &PointTerms, factors: [c64; 3], phi: &[c64]) -> c64 {
    let mut sum = c64::ZERO;
    for (entries, factor) in terms.iter().zip(factors) {
        let own = entries.iter();
        let own: c64 = own.map(|&(row, column, value)| phi[row].conj() * phi[column] * value).sum();
        sum += factor * own;
    }
    sum
}

/// What one point adds to the stiffness, to the dashpots and to the structural damping.
fn terms(own: &BasePoint<'_>, state: (&PressedState, usize), friction: f64) -> PointTerms {
    let point = std::slice::from_ref(own.point);
    let [springs, dashpots, dragging] = linearized(point, state, &own.stiffness);
    let at = |powers: &[Triplets]| -> Vec<(usize, usize, f64)> {
        let each = powers.iter().enumerate().flat_map(|(power, terms)| {
            let factor = friction.powi(power as i32);
            terms.entries.iter().map(move |&(row, column, value)| (row, column, factor * value))
        });
        each.collect()
    };
    let mut stiffness = at(&springs);
    let lost = |(row, column, value): &_| (*row, *column, own.stiffness.loss_factor * value);
    let structural = stiffness.iter().map(lost).collect();
    stiffness.extend(at(&turned(point, own.turning.as_slice(), state)));
    [stiffness, [at(&dashpots), at(&dragging)].concat(), structural]
}
