//! Pressed equilibrium of a body of revolution in steady sliding: rigid contact ring by ring, or springs over the face.

use super::elimination::Elimination;
use super::full_sliding::FullSliding;
use super::{PressedState, PrestressError, SolidSliding};
use crate::contact::{NormalLaw, Point, SlidingContact, SteadyFriction};
use crate::fem::Triplets;
use crate::fem::fold::SectorMatrix;
use crate::fem::solid::{FaceTerm, face_matrix, pressure_load};
use crate::mesh::{ContactRing, FaceElement, SolidSector};

/// Choices of what is pressed that are tried before the search is given up.
const SETS: usize = 200;

/// Approach at which every ring begins pressed where nothing is pushed in, m: any positive one.
const LEAST_APPROACH: f64 = 1e-9;

/// Change of `delta - u_n` relative to the largest at which springs are settled: Newton's method, whose next change is its square.
const SETTLED: f64 = 1e-10;

/// The values of the rings at the beginning, in the middle (of a quadratic element) and at the end of an element of the face.
fn of_element(sector: &SolidSector, values: &[f64], element: &FaceElement) -> [f64; 3] {
    let at = |node: usize| {
        let mut rings = sector.rings.iter().zip(values);
        let own = rings.find(|(ring, _)| ring.nodes.contains(&node));
        own.map_or(0.0, |(_, value)| *value)
    };
    let [from, to] = [0, 2].map(|corner| at(element.nodes[corner].0));
    match sector.is_quadratic() {
        true => [from, at(element.nodes[5].0), to],
        false => [from, 0.5 * (from + to), to],
    }
}

/// What the rings have, along an element of the face from -1 to 1.
pub(super) fn along_element(
    sector: &SolidSector,
    values: &[f64],
    element: &FaceElement,
    along: f64,
) -> f64 {
    let [from, middle, to] = of_element(sector, values, element);
    let linear = 0.5 * ((1.0 - along) * from + (1.0 + along) * to);
    if !sector.is_quadratic() {
        return linear;
    }
    linear + (1.0 - along * along) * (middle - 0.5 * (from + to))
}

/// The part of an element along which the values of the rings are positive: between the roots of the parabola through them; of a
/// linear element the ends that have positive values.
pub(super) fn pressed_span(
    sector: &SolidSector,
    values: &[f64],
    element: &FaceElement,
) -> [f64; 2] {
    let [from, middle, to] = of_element(sector, values, element);
    let ends = [(-1.0, from), (1.0, to)].map(|(end, value)| if value > 0.0 { end } else { 0.0 });
    if !sector.is_quadratic() || (from > 0.0 && to > 0.0) {
        return ends;
    }
    // c + b s + a s^2
    let (a, b, c) = (0.5 * (from + to) - middle, 0.5 * (to - from), middle);
    let discriminant = b * b - 4.0 * a * c;
    if discriminant <= 0.0 {
        return [0.0; 2];
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let roots = [q / a, c / q];
    let within = |root: &&f64| root.abs() <= 1.0;
    match (from > 0.0, to > 0.0) {
        (true, _) => [-1.0, *roots.iter().find(within).unwrap_or(&-1.0)],
        (_, true) => [*roots.iter().find(within).unwrap_or(&1.0), 1.0],
        // Pressed in the middle alone.
        _ if roots.iter().filter(within).count() == 2 => {
            [roots[0].min(roots[1]), roots[0].max(roots[1])]
        }
        _ => [0.0; 2],
    }
}

/// Friction of steady sliding at a radius.
pub(super) fn friction(contact: &SlidingContact, radius: f64) -> SteadyFriction {
    contact.steady_friction(contact.sliding_direction(), contact.rotation_speed.abs() * radius)
}

/// `delta - u_n` at each ring, the mean over its nodes, m.
fn approaches(sector: &SolidSector, interference: f64, displacement: &[f64]) -> Vec<f64> {
    let face = sector.specification.contact.face();
    let mean = |nodes: &[usize]| {
        let normals = nodes.iter().map(|node| displacement[3 * node + face.normal_component()]);
        face.inward_sign() * normals.sum::<f64>() / nodes.len() as f64
    };
    let rings = sector.rings.iter();
    rings.map(|ring| interference - mean(&ring.nodes)).collect()
}

/// Signorini's conditions ring by ring: the set of pressed ones.
pub(super) fn press_rigidly(
    sector: &SolidSector,
    stiffness: &Triplets,
    contact: &SlidingContact,
) -> Result<SolidSliding, PrestressError> {
    let (load, rings) = (pressure_load(sector), &sector.rings);
    let mut is_pressed = vec![true; rings.len()];
    for _ in 0..SETS {
        let pressed = rings.iter().zip(&is_pressed).filter(|(_, pressed)| **pressed);
        let nodes = pressed.flat_map(|(ring, _)| ring.nodes.iter().copied());
        let nodes: Vec<usize> = nodes.collect();
        let points: Vec<Point> = nodes.iter().map(|&n| point(sector, n, contact)).collect();
        let full = FullSliding::new(stiffness, held(sector), &points)?;
        let PressedState { displacements, normal_forces, .. } =
            full.state(&load, contact.interference, None)?;

        // The conditions of all rings.
        let mut forces = normal_forces[0].iter();
        let force = |(ring, is_pressed): (&ContactRing, &bool)| match is_pressed {
            true => forces.by_ref().take(ring.nodes.len()).sum(),
            false => 0.0,
        };
        let ring_forces: Vec<f64> = rings.iter().zip(&is_pressed).map(force).collect();
        let scale = ring_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        let approaches = approaches(sector, contact.interference, &displacements[0]);
        let next: Vec<bool> = (0..rings.len())
            .map(|k| match is_pressed[k] {
                true => ring_forces[k] > 1e-12 * scale,
                false => approaches[k] > 1e-12 * contact.interference.abs(),
            })
            .collect();
        if next != is_pressed {
            is_pressed = next;
            continue;
        }
        let [pressed_displacement, sheared_displacement] =
            displacements.try_into().expect("two powers of friction");
        return Ok(SolidSliding {
            law: None,
            sliding_direction: contact.sliding_direction(),
            contact: *contact,
            normal_forces: nodes.into_iter().zip(normal_forces[0].iter().copied()).collect(),
            pressures: rings.iter().zip(&ring_forces).map(|(ring, f)| f / ring.area).collect(),
            pressed_displacement,
            sheared_displacement,
            is_pressed,
            approaches,
        });
    }
    Err(PrestressError::NoState { friction_coefficient: contact.friction_coefficient })
}

/// A node of the face as a contact point.
fn point(sector: &SolidSector, node: usize, contact: &SlidingContact) -> Point {
    let face = sector.specification.contact.face();
    Point {
        normal: vec![(3 * node + face.normal_component(), face.inward_sign())],
        slip: vec![(3 * node + 1, 1.0)],
        friction: friction(contact, sector.nodes[node].radius),
        ..Point::default()
    }
}

/// What holds the body without its contact.
fn held(sector: &SolidSector) -> Elimination {
    let dofs = 3 * sector.node_count();
    Elimination::holding(dofs, (0..dofs).filter(|&dof| sector.is_held(dof)))
}

/// Springs that push and do not pull, `K u + int k (u_n - delta + g) n dA = f + int s g n dA` over the points of the face where
/// they are pressed, `s g = p(g)`: Newton's method on the approach `g` of the rings, so that the tangent of the eigenvalue analysis
/// is the derivative of this state.
pub(super) fn press_on_springs(
    sector: &SolidSector,
    stiffness: &Triplets,
    (contact, law): (&SlidingContact, NormalLaw),
) -> Result<SolidSliding, PrestressError> {
    let face = sector.specification.contact.face();
    let (inward, component) = (face.inward_sign(), face.normal_component());
    let load = pressure_load(sector);
    let rings = sector.rings.len();
    let pushed = field(sector, &vec![contact.interference; rings]);
    let start = contact.interference.max(LEAST_APPROACH);
    let mut values = vec![start.min(law.soft_approach()); rings];
    for _ in 0..SETS {
        // The tangent at the approaches found last, and what it pushes with.
        let springs = Springs { sector, law, approaches: &values };
        let (tangent, own) = (springs.tangent(), springs.push());
        let mut pressed = stiffness.clone();
        pressed.entries.extend_from_slice(&tangent.entries);
        let body = FullSliding::new(&pressed, held(sector), &[])?;
        let known = distance(sector, &pushed, &field(sector, &values));
        let known = tangent.multiply(own.len(), &known);
        let loads = load.iter().zip(&own).zip(&known);
        let loads: Vec<f64> = loads.map(|((a, b), c)| a + b + c).collect();
        let displacement = body.solve(&loads);

        // The approaches of the forces there.
        let found = approaches(sector, contact.interference, &displacement);
        let pairs = values.iter().zip(&found);
        let next: Vec<f64> = pairs.map(|(a, b)| law.newton_approach(*a, *b)).collect();
        let changes = next.iter().zip(&values).map(|(a, b)| (a - b).abs());
        let change = changes.fold(0.0, f64::max);
        let scale = next.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if change > SETTLED * scale {
            values = next;
            continue;
        }
        let left = distance(sector, &pushed, &displacement);
        let left = distance(sector, &left, &field(sector, &values));
        let forces = own.iter().zip(tangent.multiply(own.len(), &left));
        let forces: Vec<f64> = forces.map(|(own, more)| own + more).collect();
        let nodes = sector.rings.iter().flat_map(|ring| &ring.nodes);
        let nodes = nodes.map(|&node| (node, inward * forces[3 * node + component]));
        let normal_forces: Vec<_> = nodes.filter(|(_, force)| *force != 0.0).collect();

        // Friction shears the body alone, whatever presses it.
        let mut basis = held(sector);
        let across = (0..own.len()).filter(|dof| dof % 3 != 1);
        across.for_each(|dof| basis.drop_unknown(dof));
        let mut drag = vec![0.0; own.len()];
        for (node, force) in &normal_forces {
            drag[3 * node + 1] = friction(contact, sector.nodes[*node].radius).drag * force;
        }
        return Ok(SolidSliding {
            law: Some(law),
            sliding_direction: contact.sliding_direction(),
            contact: *contact,
            sheared_displacement: FullSliding::new(stiffness, basis, &[])?.solve(&drag),
            normal_forces,
            is_pressed: found.iter().map(|approach| *approach > 0.0).collect(),
            pressures: found.iter().map(|g| law.pressure(g.max(0.0))).collect(),
            approaches: found,
            pressed_displacement: displacement,
        });
    }
    Err(PrestressError::NoState { friction_coefficient: contact.friction_coefficient })
}

/// The springs of the face where the rings' approaches are positive.
struct Springs<'a> {
    sector: &'a SolidSector,
    law: NormalLaw,
    approaches: &'a [f64],
}

impl Springs<'_> {
    /// `int k(g) n n^T dA`, N/m.
    fn tangent(&self) -> Triplets {
        self.matrix(&|approach| self.law.stiffness(approach))
    }

    /// `int s g n dA`, N, with the secant `s(g)`, whose force at the approaches is that of the pressure.
    fn push(&self) -> Vec<f64> {
        let secant = self.matrix(&|approach| self.law.secant(approach));
        let pushed = field(self.sector, self.approaches);
        secant.multiply(pushed.len(), &pushed)
    }

    /// A normal term with a weight that follows the approach.
    fn matrix(&self, weight: &dyn Fn(f64) -> f64) -> Triplets {
        let Self { sector, approaches, .. } = *self;
        let component = sector.specification.contact.face().normal_component();
        let weight = |element: &FaceElement, _: f64, along: f64| {
            weight(along_element(sector, approaches, element, along).max(0.0))
        };
        let span = |element: &FaceElement| pressed_span(sector, approaches, element);
        let (row, column) = (component, component);
        let term = FaceTerm { row, column, weight: &weight, span: &span, is_nodal: true };
        SectorMatrix::alike_in_all(&[&face_matrix(sector, &sector.contact_elements(), &term)])
    }
}

/// A normal displacement of the face, towards the body, that is the same all over each ring.
fn field(sector: &SolidSector, values: &[f64]) -> Vec<f64> {
    let face = sector.specification.contact.face();
    let mut field = vec![0.0; 3 * sector.node_count()];
    for (ring, value) in sector.rings.iter().zip(values) {
        for node in &ring.nodes {
            field[3 * node + face.normal_component()] = face.inward_sign() * value;
        }
    }
    field
}

/// What is left to `pushed` along the normal.
fn distance(sector: &SolidSector, pushed: &[f64], displacement: &[f64]) -> Vec<f64> {
    let component = sector.specification.contact.face().normal_component();
    let pairs = pushed.iter().zip(displacement).enumerate();
    pairs
        .map(|(dof, (pushed, u))| (pushed - u) * f64::from(u8::from(dof % 3 == component)))
        .collect()
}
