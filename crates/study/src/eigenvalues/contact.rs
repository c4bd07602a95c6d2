//! Steady sliding of a body, and the contact in it place by place.

use frictionsim_case::Case;
use frictionsim_physics::contact::Point;
use frictionsim_physics::mesh::{ContactRing, Mesh, SolidSector};
use frictionsim_physics::prestress::{Joined, PressedState, SolidSliding, SteadySliding};
use frictionsim_results::cea::{ContactPlace, ContactState};
use std::sync::Arc;

/// Name of the only contact of a body that slides on a rigid counterface.
pub(super) const CONTACT: &str = "contact";

/// What slides, in the base state at the case's own friction coefficient.
#[derive(Clone)]
pub enum SteadyState {
    /// The contact edge of a plane body.
    Plane(Box<SteadySliding>),
    /// A body of revolution in three dimensions.
    Solid(Box<SolidState>),
    /// Solid bodies, with their surfaces paired.
    Assembly(Arc<Joined>),
}

/// One sector of a body of revolution, and its base state.
#[derive(Clone)]
pub struct SolidState {
    /// The sector.
    pub sector: SolidSector,
    /// Its base state.
    pub base: SolidSliding,
}

impl SteadyState {
    /// The contact points with their places, in the order of the base states; a body of revolution has rings instead.
    pub(super) fn points<'s>(&'s self, case: &Case, mesh: &Mesh) -> Vec<(ContactPlace, &'s Point)> {
        match self {
            Self::Plane(base) => {
                let edge = &base.interface;
                let nodes = edge.nodes.iter().zip(&edge.angles).zip(&base.points);
                let place = |((&node, &angle), point): ((&u32, &f64), &'s Point)| {
                    let place = ContactPlace {
                        contact: CONTACT.to_owned(),
                        position: mesh.nodes[node as usize],
                        angle: Some(angle),
                        area: point.weight * case.thickness,
                        shares: vec![(node, 1.0)],
                        ..ContactPlace::default()
                    };
                    (place, point)
                };
                nodes.map(place).collect()
            }
            Self::Assembly(joined) => {
                let all = joined.contacts.iter().flat_map(|(contact, surface)| {
                    let points = surface.points.iter().zip(&surface.sites);
                    points.map(move |(point, site)| {
                        let place = ContactPlace {
                            contact: contact.name.clone(),
                            position: site.position,
                            direction: Some(site.direction),
                            area: point.weight,
                            shares: site.shares.clone(),
                            ..ContactPlace::default()
                        };
                        (place, point)
                    })
                });
                all.collect()
            }
            Self::Solid(_) => Vec::new(),
        }
    }

    /// The contact points in a base state: pressure `p_i = N_i / w_i`, zero of a state that is free of stress, and
    /// friction traction `mu drag_i p_i`.
    pub(super) fn contact(
        &self,
        case: &Case,
        mesh: &Mesh,
        state: &PressedState,
    ) -> Vec<ContactState> {
        let friction = case.contact.sliding.friction_coefficient;
        let forces = state.normal_forces(friction);
        let points = self.points(case, mesh).into_iter().enumerate();
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
}

impl SolidState {
    /// The rings of contact nodes, each at angle 0 with the area of all its nodes.
    pub(super) fn contact(&self, friction_coefficient: f64) -> Vec<ContactState> {
        let Self { sector, base } = self;
        let sectors = sector.sector_count();
        let state = |(i, ring): (usize, &ContactRing)| {
            let nodes = (0..sectors).flat_map(|j| {
                let own = ring.nodes.iter();
                own.map(move |node| ((j * sector.node_count() + node) as u32, 1.0))
            });
            let place = ContactPlace {
                contact: CONTACT.to_owned(),
                position: [ring.radius, 0.0, ring.height],
                area: ring.area * sectors as f64,
                shares: nodes.collect(),
                ..ContactPlace::default()
            };
            let ((speed, friction), pressure) = (base.friction(ring.radius), base.pressures[i]);
            let shear = friction_coefficient * friction.drag * pressure;
            ContactState { place, speed, pressure, shear, is_pressed: base.is_pressed[i] }
        };
        sector.rings.iter().enumerate().map(state).collect()
    }
}
