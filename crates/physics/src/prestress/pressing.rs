//! Pressed equilibrium of a body of revolution in steady sliding: rigid contact ring by ring, or springs over the face.

use super::elimination::Elimination;
use super::full_sliding::FullSliding;
use super::solid::{FaceRule, OverRings, face_points, node_point};
use super::{PrestressError, Result};
use super::{SectorSliding, SolidSliding};
use crate::contact::{ContactStiffness, NormalLaw, Point, PressedState, SlidingContact};
use crate::fem::{MassKind, Triplets};
use crate::linalg::dense::{add, difference};
use crate::mesh::{ContactRing, SolidSector};

/// Choices of what is pressed that are tried before the search is given up.
const SETS: usize = 200;

/// Approach at which every ring begins pressed where nothing is pushed in, m: any positive one.
const LEAST_APPROACH: f64 = 1e-9;

/// Change of `delta - u_n` relative to the largest at which springs are settled: Newton's method, whose next change is its square.
const SETTLED: f64 = 1e-10;

impl SolidSliding {
    /// Solves the equilibrium of one sector with its [`Strip::stiffness_alike`](crate::mesh::Strip::stiffness_alike) under its face
    /// pressures, with springs between face and rotor where these carry the base state: integrated over the face, at the nodes of
    /// linear elements with lumped mass, as in a time step.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] where nothing holds the body, [`PrestressError::GapEverywhere`] where no ring is pressed,
    /// [`PrestressError::NoState`] where no set of pressed rings is found.
    pub fn solve(
        sector: &SolidSector,
        elastic: &Triplets,
        contact: &SlidingContact,
        stiffness: &ContactStiffness,
        mass: MassKind,
    ) -> Result<Self> {
        let law = stiffness.base_law();
        let is_integrated = law.is_some() && mass == MassKind::Consistent;
        let rule = match sector.is_quadratic() || is_integrated {
            true => FaceRule::Integrated,
            false => FaceRule::Nodal,
        };
        let state = match law {
            None => press_rigidly(sector, elastic, (contact, rule))?,
            Some(law) => press_on_springs(sector, elastic, (contact, law, rule))?,
        };
        if state.is_pressed.contains(&true) {
            return Ok(state);
        }
        let distances = state.approaches.iter().map(|approach| -approach);
        Err(PrestressError::GapEverywhere {
            total: sector.rings.len() * sector.sector_count(),
            distance: distances.fold(f64::INFINITY, f64::min),
            interference: contact.interference,
        })
    }
}

/// `delta - u_n` at each ring, the mean over its nodes, m.
fn approaches(sector: &SolidSector, interference: f64, displacement: &[f64]) -> Vec<f64> {
    let face = sector.specification.contact.face();
    let mean = |nodes: &[usize]| {
        let normals = nodes.iter().map(|node| displacement[3 * node + face.normal_component()]);
        face.inward_sign() * normals.sum::<f64>() / nodes.len() as f64
    };
    sector.rings.iter().map(|ring| interference - mean(&ring.nodes)).collect()
}

/// Signorini's conditions ring by ring: the set of pressed ones.
fn press_rigidly(
    sector: &SolidSector,
    stiffness: &Triplets,
    (contact, rule): (&SlidingContact, FaceRule),
) -> Result<SolidSliding> {
    let (load, rings) = (sector.strip.pressure_load(), &sector.rings);
    let mut is_pressed = vec![true; rings.len()];
    for _ in 0..SETS {
        let pressed = rings.iter().zip(&is_pressed).filter(|(_, pressed)| **pressed);
        let nodes = pressed.flat_map(|(ring, _)| &ring.nodes);
        let points: Vec<Point> = nodes.map(|&n| node_point(sector, n, contact)).collect();
        // u_n = delta at the nodes of pressed rings, N = 0 at all others.
        let full = FullSliding::new(stiffness, without_contact(sector), &points)?;
        let state = full.state(&load, &vec![contact.interference; points.len()]);

        // The conditions of all rings.
        let mut forces = state.normal_forces[0].iter();
        let force = |(ring, is_pressed): (&ContactRing, &bool)| match is_pressed {
            true => forces.by_ref().take(ring.nodes.len()).sum(),
            false => 0.0,
        };
        let ring_forces: Vec<f64> = rings.iter().zip(&is_pressed).map(force).collect();
        let scale = ring_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        let approaches = approaches(sector, contact.interference, &state.displacements[0]);
        // Pressed rings must push, open ones must not have come nearer than delta.
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
        return Ok(SolidSliding {
            law: None,
            rule,
            contact: *contact,
            pressures: rings.iter().zip(&ring_forces).map(|(ring, f)| f / ring.area).collect(), // p = N / A.
            sliding: SectorSliding { state, points },
            is_pressed,
            approaches,
        });
    }
    Err(PrestressError::NoState { friction_coefficient: contact.friction_coefficient })
}

/// What holds the body without its contact.
fn without_contact(sector: &SolidSector) -> Elimination {
    Elimination::holding(sector.strip.dof_count(), sector.strip.held_dofs())
}

/// Springs that push and do not pull, `K u + int k (u_n - delta + g) n dA = f + int s g n dA` over the points of the face where
/// they are pressed, `s g = p(g)`: Newton's method on the approach `g` of the rings, so that the tangent of the eigenvalue analysis
/// is the derivative of this state.
fn press_on_springs(
    sector: &SolidSector,
    stiffness: &Triplets,
    (contact, law, rule): (&SlidingContact, NormalLaw, FaceRule),
) -> Result<SolidSliding> {
    let load = sector.strip.pressure_load();
    let (dofs, rings) = (load.len(), sector.rings.len());
    let pushed = vec![contact.interference; rings];
    let pushed = field(&OverRings::approaches(sector, &pushed, (contact, rule)));
    let mut values = vec![contact.interference.max(LEAST_APPROACH).min(law.soft_approach()); rings];
    for _ in 0..SETS {
        // The tangent at the approaches found last, and what it pushes with: the secant's forces are those of the pressure.
        let over = OverRings::approaches(sector, &values, (contact, rule));
        let at = field(&over);
        let tangent = springs(&over, &|approach| law.stiffness(approach));
        let own = springs(&over, &|approach| law.secant(approach)).multiply(dofs, &at);
        let mut pressed = stiffness.clone();
        pressed.entries.extend_from_slice(&tangent.entries);
        let body = FullSliding::new(&pressed, without_contact(sector), &[])?;
        // K u + k (u - delta) = f + s g - k g: what is known of the linearized law.
        let known = tangent.multiply(dofs, &difference(&pushed, &at));
        let mut loads = load.clone();
        [&own, &known].into_iter().for_each(|more| add(&mut loads, 1.0, more));
        let displacement = body.solve(&loads);

        // The approaches of the forces there.
        let found = approaches(sector, contact.interference, &displacement);
        let pairs = values.iter().zip(&found);
        let next: Vec<f64> = pairs.map(|(a, b)| law.newton_approach(*a, *b)).collect();
        let change = next.iter().zip(&values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let scale = next.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if change > SETTLED * scale {
            values = next;
            continue;
        }
        // Settled: to round-off, as derivatives take differences of such states.
        let displacement = body.refined(&loads, displacement);
        let found = approaches(sector, contact.interference, &displacement);
        let mut push =
            tangent.multiply(dofs, &difference(&difference(&pushed, &displacement), &at)); // k (delta - u_n - g).
        add(&mut push, 1.0, &own);
        return Ok(SolidSliding {
            law: Some(law),
            rule,
            contact: *contact,
            sliding: under_push(sector, stiffness, contact, displacement, &push)?,
            is_pressed: found.iter().map(|approach| *approach > 0.0).collect(),
            pressures: found.iter().map(|g| law.pressure(g.max(0.0))).collect(),
            approaches: found,
        });
    }
    Err(PrestressError::NoState { friction_coefficient: contact.friction_coefficient })
}

/// The state in which a push over all dofs, of springs, has made a displacement: normal forces of all nodes that it reaches, those that
/// something else holds along the normal, too, and what their friction shears.
fn under_push(
    sector: &SolidSector,
    stiffness: &Triplets,
    contact: &SlidingContact,
    displacement: Vec<f64>,
    push: &[f64],
) -> Result<SectorSliding> {
    let face = sector.specification.contact.face();
    let force = |node: usize| face.inward_sign() * push[3 * node + face.normal_component()];
    let nodes = (0..sector.node_count()).filter(|&node| force(node) != 0.0);
    let points: Vec<Point> = nodes.clone().map(|n| node_point(sector, n, contact)).collect();
    let forces: Vec<f64> = nodes.map(force).collect();
    let mut basis = without_contact(sector); // Friction shears the body about its axis alone, whatever presses it.
    let others = (0..sector.strip.dof_count()).filter(|dof| dof % 3 != 1);
    others.for_each(|dof| basis.drop_unknown(dof));
    let sheared = FullSliding::new(stiffness, basis, &[])?.sheared(&points, &forces);
    let state = PressedState {
        displacements: vec![displacement, sheared],
        is_pressed: vec![true; points.len()],
        normal_forces: vec![forces],
        ..PressedState::default()
    };
    Ok(SectorSliding { state, points })
}

/// `int k n n^T dA` over the part of the face where approaches are positive, of a stiffness that follows them, N/m.
fn springs(over: &OverRings<'_>, stiffness: &dyn Fn(f64) -> f64) -> Triplets {
    let component = over.sector.specification.contact.face().normal_component();
    let mut sum = Triplets::default();
    for element in over.sector.contact_elements() {
        let spans = over.pressed_spans(&element).into_iter();
        for point in spans.flat_map(|span| face_points(over.sector, &element, span, over.rule)) {
            let approach = over.along(&element, point.along).max(0.0); // w k(g) n n^T at each point of what is pressed.
            let row = &point.rows[component];
            sum.push_product(point.area * stiffness(approach), row, row);
        }
    }
    over.sector.strip.alike([&sum])
}

/// A normal displacement of the face, towards the body, that is the same all over each ring.
fn field(over: &OverRings<'_>) -> Vec<f64> {
    let OverRings { sector, values, held, .. } = *over;
    let face = sector.specification.contact.face();
    let mut field = vec![0.0; sector.strip.dof_count()];
    let mut push = |node: usize, value: f64| {
        field[3 * node + face.normal_component()] = face.inward_sign() * value;
    };
    let on_face = (0..sector.node_count()).filter(|&node| sector.is_on(node, face));
    on_face.for_each(|node| push(node, held));
    for (ring, value) in sector.rings.iter().zip(values) {
        ring.nodes.iter().for_each(|&node| push(node, *value));
    }
    field
}
