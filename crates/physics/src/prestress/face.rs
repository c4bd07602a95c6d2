//! Steady sliding of a body of revolution in three dimensions, from one sector.

use super::SectorSliding;
use crate::contact::{NormalLaw, Point, Row, SlidingContact, SteadyFriction, row_along, scaled};
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
/// ([`ContactStiffness::base_law`](crate::contact::ContactStiffness::base_law)): then `p = p(delta - u_n)` of its law at each point of
/// the face where that is positive, at the nodes of linear elements with lumped mass. Vectors hold `(u_r, u_theta, u_z)` of each sector
/// node.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidSliding {
    /// Displacements, and the nodes of the contact that have a normal force; it is negative at corners of faces with mid-side nodes,
    /// where it is the force of a pressure that is not.
    pub sliding: SectorSliding,
    /// Pressure at each ring, Pa: its force over its tributary area, or that of the spring.
    pub pressures: Vec<f64>,
    /// `delta - u_n` at each ring, m: below zero it is a gap.
    pub approaches: Vec<f64>,
    /// The springs that carry the base state; `None` is rigid contact.
    pub law: Option<NormalLaw>,
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
        let SectorSliding { points, state, .. } = &self.sliding;
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
        let area: f64 = sector.contact_areas().iter().sum();
        self.normal_forces().map(|own| own.1).sum::<f64>() / area
    }

    /// Pressure along an element of the face, -1 to 1, Pa. Nodes that are held along the normal have none.
    pub fn pressure_along(&self, sector: &SolidSector, element: &FaceElement, along: f64) -> f64 {
        OverRings { sector, values: &self.pressures, held: 0.0 }.along(element, along).max(0.0)
    }
}

/// How a linear element takes a term. Quadratic ones integrate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceRule {
    /// Consistent, over the plane face that its nodes span: what the whole mesh has.
    Integrated,
    /// Lumped at the nodes, with the weight there: what a time step has.
    Nodal,
}

/// The points that stand for a part of an element of the face, from -1 to 1 along it, with their places: of a lumped one the nodes at the
/// ends in it that are free along the normal. Rows reach into the next sector, whose nodes come after those of this one.
pub(super) fn face_points(
    sector: &SolidSector,
    (face, span): (&FaceElement, [f64; 2]),
    contact: &SlidingContact,
    rule: FaceRule,
) -> Vec<(f64, Point)> {
    let side = sector.specification.contact.face();
    // A point that stands for an area of the face, m2, with the rows of its displacement along (e_r, e_theta, e_z).
    let point = |area: f64, radius: f64, rows: [Row; 3]| Point {
        weight: area,
        normal: scaled(&rows[side.normal_component()], side.inward_sign()),
        across: rows[side.across_component()].clone(),
        slip: rows[1].clone(),
        speed: contact.rotation_speed.abs() * radius,
        friction: friction(contact, radius),
        ..Point::default()
    };
    let nodes = face.nodes.iter().map(|(node, half)| node + half / 2 * sector.node_count());
    let (nodes, is_quadratic) = (nodes.collect::<Vec<_>>(), sector.is_quadratic());
    if !is_quadratic && rule == FaceRule::Nodal {
        let mut areas = vec![0.0; face.nodes.len()];
        for point in face_quadrature(is_quadratic) {
            let (values, area) = face.values_at(sector, point);
            areas.iter_mut().zip(values).for_each(|(sum, value)| *sum += area * value); // A_a = int N_a dA.
        }
        let is_free = |node: usize| sector.rings.iter().any(|ring| ring.nodes.contains(&node));
        // Corners 0 and 1 lie at the beginning of the element.
        let ends = (0..nodes.len()).map(|a| (a, [-1.0, 1.0][a / 2]));
        let free = ends.filter(|&(a, along)| span.contains(&along) && is_free(face.nodes[a].0));
        let own = free.map(|(a, along)| {
            (along, Point { weight: areas[a], ..node_point(sector, nodes[a], contact) })
        });
        return own.collect();
    }
    let (middle, half) = (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0]));
    let own = face_quadrature(is_quadratic).map(|([x, y], share)| {
        let (at, share) = ([x, middle + half * y], half * share);
        let (values, area) = face.values_at(sector, (at, share));
        // Where the point lies: on the arc, or on the plane face between straight edges.
        let [share, radius, angle] = match is_quadratic {
            true => [1.0, face.radius_at(sector, at), sector.half_angle() * at[0]],
            false => face.on_chord(sector, at),
        };
        let (sin, cos) = (sector.half_angle() + angle).sin_cos(); // e_r = (cos, sin), e_theta = (-sin, cos) there.
        let shares: Vec<(u32, f64)> = nodes.iter().map(|&node| node as u32).zip(values).collect();
        let rows = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]
            .map(|direction| row_along(&sector.strip.mesh, &shares, direction, 1.0));
        (at[1], point(area * share, radius, rows))
    });
    own.collect()
}

/// What the rings of the contact have, and what nodes have that are held along the normal, and belong to no ring.
pub(super) struct OverRings<'a> {
    pub sector: &'a SolidSector,
    pub values: &'a [f64],
    pub held: f64,
}

impl OverRings<'_> {
    /// The values at the beginning, in the middle and at the end of an element of the face.
    fn of_element(&self, element: &FaceElement) -> [f64; 3] {
        let at = |node: usize| {
            let mut rings = self.sector.rings.iter().zip(self.values);
            let own = rings.find(|(ring, _)| ring.nodes.contains(&node));
            own.map_or(self.held, |(_, value)| *value)
        };
        let [from, to] = [0, 2].map(|corner| at(element.nodes[corner].0));
        let is_quadratic = self.sector.is_quadratic();
        [from, if is_quadratic { at(element.nodes[5].0) } else { 0.5 * (from + to) }, to]
    }

    /// The value at a place from -1 to 1 along an element of the face: the parabola through both ends and the middle.
    pub fn along(&self, element: &FaceElement, along: f64) -> f64 {
        let [from, middle, to] = self.of_element(element);
        let linear = 0.5 * ((1.0 - along) * from + (1.0 + along) * to);
        linear + (1.0 - along * along) * (middle - 0.5 * (from + to))
    }

    /// The parts of an element along which values are positive, between the roots of the parabola through them: both ends where its
    /// middle is not. Of a lumped element it is the ends that have such values, in one part.
    pub fn pressed_spans(&self, element: &FaceElement, rule: FaceRule) -> Vec<[f64; 2]> {
        let [from, middle, to] = self.of_element(element);
        if rule == FaceRule::Nodal {
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
    let radius = sector.nodes[node % sector.node_count()].radius;
    Point {
        lift: normal.clone(),
        normal,
        slip: vec![(3 * node + 1, 1.0)],
        across: vec![(3 * node + face.across_component(), 1.0)],
        speed: contact.rotation_speed.abs() * radius,
        friction: friction(contact, radius),
        ..Point::default()
    }
}

/// Friction of steady sliding at a radius.
fn friction(contact: &SlidingContact, radius: f64) -> SteadyFriction {
    contact.steady_friction(contact.sliding_direction(), contact.rotation_speed.abs() * radius)
}
