//! Where on the contact surfaces friction feeds the unstable modes, point by point.
//!
//! The forces of the bodies are `f = sum_i dN_i (n_i + mu drag_i t_i) - sum_i (lambda C_i + K_i)
//! phi` over the contact points `i`. A rigid one has an unknown `dN_i = lift_i . (f + sum_j (lambda
//! C_j + K_j) phi)`. The growth rate that a point feeds is
//!
//! ```text
//! sigma_i = Im(conj(n_i.phi + mu drag_i t_i.phi) dN_i - phi^H (lambda C_i + K_i) phi) / (2 omega m)
//! ```
//!
//! and their sum what the contact feeds in the budget, without a remainder.

use super::budget::Sums;
use super::parts::Parts;
use super::shapes::Shapes;
use crate::case::Case;
use crate::cea::FrictionPoint;
use crate::contact::{ContactStiffness, Point, PressedPoints, Turning, linearized, turned};
use crate::fem::Triplets;
use crate::linalg::c64;
use crate::mesh::Mesh;
use crate::prestress::SteadySliding;
use crate::results::cea::{Feed, FeedPlace, ModeFeed};
use crate::study::eigenvalues::assembly::AssemblyModel;
use crate::study::eigenvalues::model::Model;
use crate::study::eigenvalues::sliding::{SlidingModel, SteadyState};

/// A contact point in the base state at the case's own friction coefficient.
struct Pressed {
    place: FeedPlace,
    point: Point,
    /// How it turns; nothing where no stress acts on small motions.
    turning: Vec<Turning>,
    is_pressed: bool,
    /// Normal force, none of a state that is free of stress, and stiffness where contact stiffens.
    forces: Vec<Vec<f64>>,
    springs: Vec<Vec<f64>>,
    stiffness: ContactStiffness,
}

/// Stiffness and dashpots of one point over all dofs at a friction coefficient.
type PointTerms = [Vec<(usize, usize, f64)>; 2];

/// The feed of every unstable mode at the case's own friction coefficient; `None` where there is none.
pub(super) fn feed(
    case: &Case,
    model: &SlidingModel,
    parts: &Parts<'_>,
    points: &[&FrictionPoint],
) -> Option<Feed> {
    let friction = case.contact.sliding.friction_coefficient;
    let own = points.iter().find(|p| p.friction_coefficient == friction)?;
    let shapes = Shapes::of(own, case.has_sectors(), |mode| mode.is_unstable());
    if shapes.modes.is_empty() {
        return None;
    }
    let pressed = match (&model.model, &model.state) {
        (Model::Assembly(assembly), _) => of_assembly(assembly, friction),
        (_, SteadyState::Plane(base)) => of_edge(case, parts, base),
        _ => return None,
    };

    // Forces of the bodies at every dof, those of the contact's own terms beside them.
    let mut sums = Sums::new(shapes.modes.len(), Some(parts.mesh.dof_count()));
    parts.of_regions(model, &shapes, &mut sums);
    parts.of_supports(&shapes, &mut sums);
    parts.of_rotation(&shapes, &mut sums);
    let terms: Vec<PointTerms> = pressed.iter().map(|own| terms(own, friction)).collect();
    let beta = parts.whole_beta();
    let balance = sums.balance.unwrap_or_default();
    let modes = balance.into_iter().enumerate().map(|(i, mut forces)| {
        let (number, mode) = shapes.modes[i];
        let (lambda, phi) = (mode.eigenvalue, shapes.column(i));
        // beta_R multiplies stiffness of prestress and contact too, where the damping has them.
        let of_stiffness = c64::ONE + lambda * beta;
        let factors = [of_stiffness, lambda];
        for own in &terms {
            for (entries, factor) in own.iter().zip(factors) {
                for &(row, column, value) in entries {
                    forces[row] += factor * phi[column] * value;
                }
            }
        }
        let scale = 1.0 / (2.0 * lambda.im * sums.kinetic[i]);
        let rates = pressed.iter().zip(&terms).map(|(own, terms)| {
            let held = held(own, friction, &phi, &forces);
            scale * (held - form(terms, factors, &phi).im)
        });
        ModeFeed { mode: shapes.name(number, mode), rates: rates.collect() }
    });
    Some(Feed {
        modes: modes.collect(),
        places: pressed.iter().map(|own| own.place.clone()).collect(),
    })
}

/// `Im(conj(n.phi + mu drag t.phi) dN)` of a rigid point that is pressed; 0 of others.
fn held(own: &Pressed, friction: f64, phi: &[c64], forces: &[c64]) -> f64 {
    if own.stiffness.normal_stiffness.is_some() || !own.is_pressed {
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

/// `phi^H (f_K K_i + f_C C_i) phi`.
fn form(terms: &PointTerms, factors: [c64; 2], phi: &[c64]) -> c64 {
    let mut sum = c64::ZERO;
    for (entries, factor) in terms.iter().zip(factors) {
        let own = entries.iter();
        let own: c64 = own.map(|&(row, column, value)| phi[row].conj() * phi[column] * value).sum();
        sum += factor * own;
    }
    sum
}

/// What one point adds to the stiffness and to the dashpots.
fn terms(own: &Pressed, friction: f64) -> PointTerms {
    let state = PressedPoints {
        first: 0,
        is_pressed: &[own.is_pressed],
        normal_forces: &own.forces,
        stiffnesses: &own.springs,
        frozen_below: 0.0,
    };
    let point = std::slice::from_ref(&own.point);
    let found = linearized(point, &state, &own.stiffness);
    let at = |powers: &[Triplets]| -> Vec<(usize, usize, f64)> {
        let each = powers.iter().enumerate().flat_map(|(power, terms)| {
            let factor = friction.powi(power as i32);
            let entries = terms.entries.iter();
            entries.map(move |&(row, column, value)| (row, column, factor * value))
        });
        each.collect()
    };
    let mut stiffness = at(&found.stiffness);
    stiffness.extend(at(&turned(point, &own.turning, &state)));
    [stiffness, at(&found.dashpots)]
}

/// The nodes of a plane contact edge.
fn of_edge(case: &Case, parts: &Parts<'_>, base: &SteadySliding) -> Vec<Pressed> {
    let friction = case.contact.sliding.friction_coefficient;
    let (forces, springs) = (base.normal_forces(friction), base.springs(friction));
    let places = edge_places(case, parts.mesh, &parts.contacts[0].0, base);
    let turnings = base.interface.turnings();
    let turns = parts.options.geometric_stiffness;
    let points = base.points.iter().zip(places).enumerate();
    points
        .map(|(i, (point, place))| Pressed {
            place,
            point: point.clone(),
            turning: turnings[i..].iter().take(usize::from(turns)).cloned().collect(),
            is_pressed: base.is_pressed[i],
            forces: value_of(&forces, i),
            springs: value_of(&springs, i),
            stiffness: parts.options.contact,
        })
        .collect()
}

/// The value of a point as a power of friction, where there are any.
fn value_of(values: &[f64], point: usize) -> Vec<Vec<f64>> {
    values.get(point).map(|value| vec![*value]).into_iter().collect()
}

/// The places of the nodes of a plane contact edge, in the order of its points.
pub(super) fn edge_places(
    case: &Case,
    mesh: &Mesh,
    contact: &str,
    base: &SteadySliding,
) -> Vec<FeedPlace> {
    let points = base.points.iter().enumerate();
    points
        .map(|(i, point)| {
            let node = base.interface.normal_dof(i) / mesh.dimension;
            FeedPlace {
                contact: contact.to_owned(),
                position: mesh.nodes[node],
                area: point.weight * case.thickness,
                shares: vec![(node as u32, 1.0)],
            }
        })
        .collect()
}

/// The points of all contacts of solid bodies.
fn of_assembly(model: &AssemblyModel, friction: f64) -> Vec<Pressed> {
    let (assembly, state) = (model.assembly(), model.base());
    let (forces, springs) = (state.normal_forces(friction), state.springs(friction));
    let mut found = Vec::new();
    let none = || vec![Vec::new(); assembly.contacts().len()];
    let turnings = if model.is_stressed() { assembly.turnings() } else { none() };
    for ((contact, surface), turnings) in assembly.contacts().iter().zip(&turnings) {
        for (place, point) in surface.points.iter().enumerate() {
            let i = found.len();
            found.push(Pressed {
                place: FeedPlace {
                    contact: contact.name.clone(),
                    position: surface.sites[place].position,
                    area: point.weight,
                    shares: surface.shares[place].clone(),
                },
                point: point.clone(),
                turning: turnings.get(place).cloned().into_iter().collect(),
                is_pressed: state.is_pressed[i],
                forces: value_of(&forces, i),
                springs: value_of(&springs, i),
                stiffness: contact.stiffness,
            });
        }
    }
    found
}
