//! Steady sliding of a body of revolution in three dimensions, from one sector.

use super::SectorSliding;
use crate::contact::{
    NormalLaw, Point, PressedState, Row, SlidingContact, SteadyFriction, row_along, scaled,
};
use crate::mesh::{FaceElement, SolidSector, face_quadrature};

/// The state of steady sliding of a body of revolution, the same in every sector.
///
/// ```text
/// u_n = delta and N >= 0 where a ring of nodes is pressed, N = 0 and u_n >= delta where it is open,  T = s mu N along e_theta
/// ```
///
/// with `u_n` towards the body. Friction drags along `e_theta` only, which harmonic zero does not couple to the other two
/// components: pressure and pressed rings do not depend on `mu`, and `u(mu) = u_0 + mu u_1`. The contact is rigid here whatever
/// stiffness the eigenvalue analysis gives it, unless that is asked to carry the base state too or stiffens with pressure
/// ([`ContactStiffness::base_law`](crate::contact::ContactStiffness::base_law)): then `p = p(delta - u_n)` of its law all over the
/// face where that is positive, at the nodes of linear elements with lumped mass. Vectors hold `(u_r, u_theta, u_z)` of each sector node.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidSliding {
    /// Displacements, and the nodes of the contact that have a normal force; it is negative at corners of faces with mid-side nodes,
    /// where it is the force of a pressure that is not.
    pub sliding: SectorSliding,
    /// Whether each ring of the contact is pressed.
    pub is_pressed: Vec<bool>,
    /// Pressure at each ring, Pa: its force over its tributary area, or that of the spring.
    pub pressures: Vec<f64>,
    /// `delta - u_n` at each ring, m: below zero it is a gap.
    pub approaches: Vec<f64>,
    /// The springs that carry the base state; `None` is rigid contact.
    pub law: Option<NormalLaw>,
    /// How linear elements of the face take contact along the normal.
    pub rule: FaceRule,
    /// The rotor.
    pub contact: SlidingContact,
}

impl SolidSliding {
    /// Slip speed `V = |Omega| r`, m/s, and friction of steady sliding at a radius.
    pub fn friction(&self, radius: f64) -> (f64, SteadyFriction) {
        (self.contact.rotation_speed.abs() * radius, friction(&self.contact, radius))
    }

    /// Sector node and normal force of each pressed node, N.
    pub fn normal_forces(&self) -> impl Iterator<Item = (usize, f64)> {
        let SectorSliding { points, state } = &self.sliding;
        points.iter().map(|point| point.normal[0].0 / 3).zip(state.normal_forces[0].iter().copied())
    }

    /// Friction torque of the whole body at a friction coefficient, N m.
    pub fn torque(&self, sector: &SolidSector, friction_coefficient: f64) -> f64 {
        let arms = self.normal_forces().map(|(node, force)| {
            let radius = sector.nodes[node].radius;
            self.friction(radius).1.drag * force * radius
        });
        friction_coefficient * arms.sum::<f64>() * sector.sector_count() as f64 // mu sum_i drag_i N_i r_i.
    }

    /// Normal force of the whole contact over its area, Pa.
    pub fn mean_pressure(&self, sector: &SolidSector) -> f64 {
        self.normal_forces().map(|own| own.1).sum::<f64>() / sector.contact_area()
    }

    /// Pressure along the contact by the places of the rings, for the elements of the face: through the two rings at the ends of an
    /// element, and the one at its middle where there is one.
    pub fn pressure_along(&self, sector: &SolidSector, element: &FaceElement, along: f64) -> f64 {
        let own = self.over(sector).along(element, along).max(0.0);
        self.law.map_or(own, |law| law.pressure(own))
    }

    /// What says where the face is pressed, and how much: `delta - u_n` of springs, m, else the pressure, Pa.
    fn over<'a>(&'a self, sector: &'a SolidSector) -> OverRings<'a> {
        match self.law {
            Some(_) => OverRings::approaches(sector, &self.approaches, (&self.contact, self.rule)),
            None => OverRings { sector, values: &self.pressures, held: 0.0, rule: self.rule },
        }
    }

    /// The places of the face as points, and their state.
    pub(super) fn points(&self, sector: &SolidSector) -> (Vec<Point>, PressedState) {
        let face = sector.specification.contact.face();
        let mut state = PressedState::default();
        let (mut points, mut forces, mut springs) = (Vec::new(), Vec::new(), Vec::new());
        let over = self.over(sector);
        for element in sector.contact_elements() {
            // Of quadratic elements in rigid contact it is all.
            let spans = match self.law {
                None if self.rule == FaceRule::Integrated => vec![WHOLE_ELEMENT],
                _ => over.pressed_spans(&element),
            };
            let own = |span| face_points(sector, &element, span, self.rule);
            for FacePoint { area, radius, along, rows } in spans.into_iter().flat_map(own) {
                let (speed, friction) = self.friction(radius);
                // N = A p, k = A p'(g), friction that of the radius.
                let pressure = self.pressure_along(sector, &element, along);
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
                let approach = over.along(&element, along).max(0.0);
                springs.extend(self.law.map(|law| area * law.stiffness(approach)));
            }
        }
        state.normal_forces = vec![forces];
        state.stiffnesses = self.law.map(|_| springs).into_iter().collect();
        (points, state)
    }
}

/// A place of a face at which contact acts.
pub(super) struct FacePoint {
    /// Its share of the face, m2.
    pub area: f64,
    /// Its radius, m.
    pub radius: f64,
    /// Its place along the element, -1 to 1.
    pub along: f64,
    /// Rows of the displacement there along `(e_r, e_theta, e_z)` over the dofs of the strip.
    pub rows: [Row; 3],
}

/// How a linear element takes a term. Quadratic ones integrate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceRule {
    /// Consistent, over the plane face that its nodes span: what the whole mesh has.
    Integrated,
    /// Lumped at the nodes, with the weight there: what a time step has.
    Nodal,
}

/// All of an element along the face.
const WHOLE_ELEMENT: [f64; 2] = [-1.0, 1.0];

/// The places that stand for a part of an element, from -1 to 1 along the face: of a lumped one the nodes at the ends in it.
pub(super) fn face_points(
    sector: &SolidSector,
    face: &FaceElement,
    span: [f64; 2],
    rule: FaceRule,
) -> Vec<FacePoint> {
    let is_quadratic = sector.is_quadratic();
    let nodes =
        face.nodes.iter().map(|(node, half)| (node + half / 2 * sector.node_count()) as u32); // Those of the next sector come after these.
    if !is_quadratic && rule == FaceRule::Nodal {
        let mut areas = vec![0.0; face.nodes.len()];
        for point in face_quadrature(is_quadratic) {
            let (values, area) = face.values_at(sector, point);
            areas.iter_mut().zip(values).for_each(|(sum, value)| *sum += area * value); // A_a = int N_a dA.
        }
        // Corners 0 and 1 lie at the beginning of the element.
        let own = nodes.enumerate().filter(|(a, _)| span[a / 2].abs() == 1.0);
        let point = |(a, node): (usize, u32)| FacePoint {
            area: areas[a],
            radius: face.radius_at(sector, [0.0, WHOLE_ELEMENT[a / 2]]),
            along: WHOLE_ELEMENT[a / 2],
            rows: [0, 1, 2].map(|component| vec![(3 * node as usize + component, 1.0)]),
        };
        return own.map(point).collect();
    }
    let nodes: Vec<u32> = nodes.collect();
    let (middle, half) = (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0]));
    let point = |([x, y], share): ([f64; 2], f64)| {
        let at = [x, middle + half * y];
        let (values, area) = face.values_at(sector, (at, half * share));
        // Where the point lies: on the arc, or on the plane face between straight edges.
        let [share, radius, angle] = match is_quadratic {
            true => [1.0, face.radius_at(sector, at), sector.half_angle() * x],
            false => face.on_chord(sector, at),
        };
        let (sin, cos) = (sector.half_angle() + angle).sin_cos(); // e_r = (cos, sin), e_theta = (-sin, cos) there.
        let shares: Vec<(u32, f64)> = nodes.iter().copied().zip(values).collect();
        let rows = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]
            .map(|direction| row_along(&sector.strip.mesh, &shares, direction, 1.0));
        FacePoint { area: area * share, radius, along: at[1], rows }
    };
    face_quadrature(is_quadratic).map(point).collect()
}

/// What the rings of the contact have.
pub(super) struct OverRings<'a> {
    pub sector: &'a SolidSector,
    pub values: &'a [f64],
    /// What nodes have that are held along the normal, and belong to no ring.
    pub held: f64,
    pub rule: FaceRule,
}

impl<'a> OverRings<'a> {
    /// `delta - u_n`, all of `delta` at nodes that are held. Lumped contact leaves these out.
    pub fn approaches(
        sector: &'a SolidSector,
        values: &'a [f64],
        (contact, rule): (&SlidingContact, FaceRule),
    ) -> Self {
        let held = if rule == FaceRule::Integrated { contact.interference } else { 0.0 };
        Self { sector, values, held, rule }
    }

    /// The values at the beginning, in the middle and at the end of an element of the face.
    fn of_element(&self, element: &FaceElement) -> [f64; 3] {
        let at = |node: usize| {
            let mut rings = self.sector.rings.iter().zip(self.values);
            let own = rings.find(|(ring, _)| ring.nodes.contains(&node));
            own.map_or(self.held, |(_, value)| *value)
        };
        let [from, to] = [0, 2].map(|corner| at(element.nodes[corner].0));
        match self.sector.is_quadratic() {
            true => [from, at(element.nodes[5].0), to],
            false => [from, 0.5 * (from + to), to],
        }
    }

    /// The value at a place from -1 to 1 along an element of the face.
    pub fn along(&self, element: &FaceElement, along: f64) -> f64 {
        let [from, middle, to] = self.of_element(element);
        let linear = 0.5 * ((1.0 - along) * from + (1.0 + along) * to);
        if !self.sector.is_quadratic() {
            return linear;
        }
        // The parabola through both ends and the middle.
        linear + (1.0 - along * along) * (middle - 0.5 * (from + to))
    }

    /// The parts of an element along which values are positive, between the roots of the parabola through them: both ends where its
    /// middle is not. Of a lumped element it is the ends that have such values, in one part.
    pub fn pressed_spans(&self, element: &FaceElement) -> Vec<[f64; 2]> {
        let [from, middle, to] = self.of_element(element);
        if self.rule != FaceRule::Integrated {
            let ends = [(-1.0, from), (1.0, to)];
            return vec![ends.map(|(at, own)| if own > 0.0 { at } else { 0.0 })];
        }
        // Between the ends and what roots of c + b s + a s^2 are within.
        let (a, b, c) = (0.5 * (from + to) - middle, 0.5 * (to - from), middle);
        let q = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b)); // Without cancellation: roots q / a and c / q.
        let mut places = vec![-1.0, q / a, c / q, 1.0];
        places.retain(|place: &f64| place.abs() <= 1.0);
        places.sort_by(f64::total_cmp);
        let is_pressed = |part: &&[f64]| self.along(element, 0.5 * (part[0] + part[1])) > 0.0;
        places.windows(2).filter(is_pressed).map(|part| [part[0], part[1]]).collect()
    }
}

/// A node of the face, of any sector, as a contact point.
pub(crate) fn node_point(sector: &SolidSector, node: usize, contact: &SlidingContact) -> Point {
    let face = sector.specification.contact.face();
    let normal = vec![(3 * node + face.normal_component(), face.inward_sign())];
    Point {
        lift: normal.clone(),
        normal,
        slip: vec![(3 * node + 1, 1.0)],
        across: vec![(3 * node + face.across_component(), 1.0)],
        friction: friction(contact, sector.nodes[node % sector.node_count()].radius),
        ..Point::default()
    }
}

/// Friction of steady sliding at a radius.
pub(super) fn friction(contact: &SlidingContact, radius: f64) -> SteadyFriction {
    contact.steady_friction(contact.sliding_direction(), contact.rotation_speed.abs() * radius)
}
