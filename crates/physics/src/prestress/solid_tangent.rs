//! The terms of a body of revolution in three dimensions in steady sliding.

use super::solid::node_point;
use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::{Point, PressedState, SlidingContact, Turning, scaled};
use crate::fem::MaterialField;
use crate::fem::sector::Sectored;
use crate::fem::solid::{FacePoint, face_points};
use crate::mesh::SolidSector;

impl WaveTangent {
    /// Finds the steady sliding state of a body of revolution and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, [`PrestressError::AtRest`] where the rotor does not turn.
    pub fn of_revolution(
        sector: &SolidSector,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let mut terms =
            WaveTerms::of_sector(sector, material, options, sector.supports(options.mass));
        let stiffness = &options.contact;
        let base = SolidSliding::of(sector, &terms.alike(), contact, stiffness, options.mass)?;
        if options.geometric_stiffness {
            let displacements = [&base.pressed_displacement[..], &base.sheared_displacement];
            terms.take_stress(sector, material, displacements);
            let (points, turnings, state) = nodes(&base, sector);
            terms.add_turning(sector, (&points, &turnings, &state));
        }
        let (points, state) = points(&base, sector);
        terms.add_points(sector, (&points, &state), &options.contact);
        let (own, parts) = ((sector, sector.wave_dofs()), (terms, rings(sector, &base, options)));
        Ok(Self::new(own, parts, options, contact.sliding_direction()))
    }
}

/// The dofs of the contact, ring by ring. Those of a ring are free to move along the normal, else they would not belong to it.
fn rings(sector: &SolidSector, base: &SolidSliding, options: &TangentOptions) -> WaveContact {
    let face = sector.specification.contact.face();
    let pressed = base.normal_forces.iter().map(|(node, _)| *node);
    let is_rigid = options.contact.normal_stiffness.is_none();
    let rigid = pressed.clone().filter(|_| is_rigid).map(|node| {
        let drag = base.friction(sector.nodes[node].radius).1.drag;
        (3 * node + face.normal_component(), vec![(3 * node + 1, face.inward_sign() * drag)])
    });
    let places = sector.rings.iter();
    let dofs = |nodes: &Vec<usize>| nodes.iter().flat_map(|&node| 3 * node..3 * node + 3).collect();
    WaveContact {
        normal: face.normal_component(),
        places: places.map(|ring| dofs(&ring.nodes)).collect(),
        is_pressed: base.is_pressed.clone(),
        pairs: Vec::new(),
        rigid: rigid.collect(),
        pressed_nodes: pressed.collect(),
    }
}

/// The nodes of the contact as points with their forces, and how they turn: about the axis on a cylinder, while on a face it is the
/// sliding that does.
fn nodes(base: &SolidSliding, sector: &SolidSector) -> (Vec<Point>, Vec<Turning>, PressedState) {
    let is_cylinder = sector.specification.contact.face().normal_component() == 0;
    let turning = |&(node, _): &(usize, f64)| {
        let curvature = 1.0 / sector.nodes[node].radius;
        match is_cylinder {
            true => Turning::along(curvature, Default::default()),
            false => Turning { veer: vec![(3 * node + 1, -curvature)], ..Turning::default() },
        }
    };
    let forces = base.normal_forces.iter();
    let points = forces.clone().map(|(node, _)| node_point(sector, *node, &base.contact)).collect();
    let normal_forces = vec![forces.clone().map(|own| own.1).collect()];
    let state = PressedState { normal_forces, ..PressedState::default() };
    (points, forces.map(turning).collect(), state)
}

/// The places of the face as points, and their state.
fn points(base: &SolidSliding, sector: &SolidSector) -> (Vec<Point>, PressedState) {
    let face = sector.specification.contact.face();
    let mut state = PressedState::default();
    let (mut points, mut forces, mut springs) = (Vec::new(), Vec::new(), Vec::new());
    for element in sector.contact_elements() {
        let span = base.pressed_span(sector, &element);
        for FacePoint { area, radius, along, rows } in
            face_points(sector, &element, span, base.rule)
        {
            let (speed, friction) = base.friction(radius);
            let pressure = base.pressure_along(sector, &element, along);
            points.push(Point {
                weight: area,
                normal: scaled(&rows[face.normal_component()], face.inward_sign()),
                slip: rows[1].clone(),
                across: rows[face.across_component()].clone(),
                speed,
                friction,
                ..Point::default()
            });
            state.is_pressed.push(pressure > 0.0);
            forces.push(area * pressure);
            springs.extend(
                base.law
                    .map(|law| area * law.stiffness(base.approach_along(sector, &element, along))),
            );
        }
    }
    state.normal_forces = vec![forces];
    state.stiffnesses = base.law.map(|_| springs).into_iter().collect();
    (points, state)
}
