//! Steady sliding of a body, and the contact in it place by place.

use crate::*;
use frictionsim_physics::contact::{Point, SteadyFriction};
use frictionsim_physics::mesh::ContactRing;
use frictionsim_physics::prestress::{PressedState, SolidSliding};
use frictionsim_results::cea::{ContactPlace, ContactState};

/// Name of the only contact of a body that slides on a rigid counterface.
pub(super) const CONTACT: &str = "contact";

/// One sector of a body of revolution, and its base state.
#[derive(Clone)]
pub struct SolidState {
    /// The sector.
    pub sector: SolidSector,
    /// Its base state.
    pub base: SolidSliding,
}

/// The points of contacts with their places, in the order of the base states: those of a plane edge have angles,
/// others a direction of sliding.
pub(super) fn places<'s>(
    case: &Case,
    mesh: &Mesh,
    contacts: &'s [(SlidingSurfaces, ContactSurface)],
) -> Vec<(ContactPlace, &'s Point)> {
    let depth = case.depth();
    let all = contacts.iter().flat_map(|(contact, surface)| {
        let is_edge = contact.is_edge();
        let angles = if is_edge { ContactInterface::of(mesh).angles } else { Vec::new() };
        surface.points.iter().zip(&surface.sites).enumerate().map(move |(i, (point, site))| {
            let place = ContactPlace {
                contact: contact.name.clone(),
                position: site.position,
                angle: angles.get(i).copied(),
                direction: (!is_edge).then_some(site.direction),
                area: point.weight * depth,
                shares: site.shares.clone(),
            };
            (place, point)
        })
    });
    all.collect()
}

/// The contact point by point: pressure `p_i = N_i / w_i`, zero of a state free of stress, and friction traction
/// `mu drag_i p_i`.
pub(super) fn contact_of(
    case: &Case,
    mesh: &Mesh,
    (contacts, state): (&[(SlidingSurfaces, ContactSurface)], &PressedState),
) -> Vec<ContactState> {
    let friction = case.contact.sliding.friction_coefficient;
    let forces = state.normal_forces(friction);
    let points = places(case, mesh, contacts).into_iter().enumerate();
    let states = points.map(|(i, (place, point))| {
        let pressure = forces.get(i).map_or(0.0, |force| force / point.weight);
        ContactState {
            place,
            speed: point.speed,
            pressure,
            shear: friction * point.friction.drag * pressure,
            is_pressed: state.is_pressed[i],
        }
    });
    states.collect()
}

impl SolidState {
    /// The rings of contact nodes, each at angle 0 with the area of all its nodes.
    pub(super) fn contact(&self, friction_coefficient: f64) -> Vec<ContactState> {
        let Self { sector, base } = self;
        let sectors = sector.sector_count();
        let state = |(i, ring): (usize, &ContactRing)| {
            let nodes = (0..sectors).flat_map(|j| {
                ring.nodes.iter().map(move |node| ((j * sector.node_count() + node) as u32, 1.0))
            });
            let place = ContactPlace {
                contact: CONTACT.to_owned(),
                position: [ring.radius, 0.0, ring.height],
                area: ring.area * sectors as f64,
                shares: nodes.collect(),
                ..ContactPlace::default()
            };
            let ((speed, friction), pressure) = (base.friction(ring.radius), base.pressures[i]);
            // Along the sliding, as that of points of a mesh.
            let shear = friction_coefficient * friction.drag.abs() * pressure;
            ContactState { place, speed, pressure, shear, is_pressed: base.sliding.is_pressed[i] }
        };
        sector.rings.iter().enumerate().map(state).collect()
    }
}

/// Sliding speed (m/s) and friction at the mean radius of the contact, and the mean pressure there, Pa.
pub(super) fn mean_friction(solid: &SolidState) -> (f64, SteadyFriction, f64) {
    let rings = || solid.sector.rings.iter();
    let area: f64 = rings().map(|ring| ring.area).sum();
    let moment: f64 = rings().map(|ring| ring.area * ring.radius).sum();
    let (speed, friction) = solid.base.friction(moment / area);
    (speed, friction, solid.base.mean_pressure(&solid.sector))
}

/// What an open part of the contact means.
pub(super) fn open_note(solid: &SolidState) -> Option<String> {
    let SolidState { sector, base } = solid;
    let rings = sector.rings.iter().zip(&base.sliding.is_pressed);
    let pressed: Vec<_> = rings.filter(|(_, pressed)| **pressed).map(|(ring, _)| ring).collect();
    let open = sector.rings.len() - pressed.len();
    let is_edge = sector.specification.contact.face().normal_component() == 0;
    let place = |ring: &&ContactRing| if is_edge { ring.height } else { ring.radius };
    let word = if is_edge { "height" } else { "radius" };
    match pressed.as_slice() {
        _ if open == 0 => None,
        [only] if base.law.is_none() => Some(format!(
            "the contact has shrunk to the ring of nodes at {word} {:.6} m, a line. Its pressure is spread over the \
             width of the mesh, {:.2e} m2 in all, and contact.normal_stiffness acts on that alone. With \
             contact.base_state = \"compliant\" the stiffness of the interface gives the contact a width of its own",
            place(only),
            only.area * sector.sector_count() as f64,
        )),
        _ => {
            let [low, high] = order::range(pressed.iter().map(place));
            Some(format!(
                "{open} of {} rings of contact nodes are open; the others lie between {word} {low:.6} and {high:.6} m",
                sector.rings.len(),
            ))
        }
    }
}
