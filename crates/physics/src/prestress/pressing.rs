//! Pressed equilibrium of a body of equal sectors in steady sliding, from one of them: of an annulus, and of a body of revolution on
//! rigid contact ring by ring, or on springs over the face.

use super::complementarity::pressed_points;
use super::contact_system::ContactSystem;
use super::elimination::Elimination;
use super::face::{FaceRule, OverRings, face_points, node_point};
use super::pressed_state::Pressing;
use super::{PrestressError, Result, SectorSliding, SolidSliding};
use crate::contact::{
    ContactInterface, ContactStiffness, NormalLaw, Point, PressedState, SlidingContact, Turning,
    scaled,
};
use crate::fem::{MassKind, Triplets};
use crate::linalg::dense::{difference, norm};
use crate::mesh::{ContactRing, SolidSector, Strip};

/// Choices of what is pressed that are tried before the search is given up.
const SETS: usize = 200;

/// Change of `delta - u_n` relative to the largest at which springs are settled: Newton's method, whose next change is its square.
const SETTLED: f64 = 1e-10;

impl SectorSliding {
    /// Solves the equilibrium of one sector of an annulus with its [`Strip::stiffness_alike`], on contact that stiffens with
    /// pressure, if there is a `law`.
    ///
    /// # Errors
    /// [`PrestressError::NoEquilibrium`] where a node would open, [`PrestressError::Singular`] for a stiffness that is not positive definite.
    pub fn solve(
        strip: &Strip,
        stiffness: &Triplets,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
    ) -> Result<Self> {
        let edge = ContactInterface::of_sector(strip);
        let points = edge.points(contact);
        let on_edge = (&points[..], Vec::new(), law);
        let state = of_sector((strip, stiffness), on_edge, contact.interference)?;
        let state = state.pressed_all_round((&edge, &points), strip.count)?;
        let nodes = |point: &Point| point.normal.iter().map(|own| own.0 / 2).collect(); // Two dofs a node.
        Ok(Self {
            places: points.iter().map(nodes).collect(),
            is_pressed: state.is_pressed.clone(),
            on_face: None,
            turnings: edge.turnings(),
            state,
            points,
        })
    }
}

/// The state of some points of one sector, pushed in by `delta` on a law or rigid contact. All of them are pressed, but where so many
/// `together` may open.
fn of_sector(
    (strip, stiffness): (&Strip, &Triplets),
    (points, together, law): (&[Point], Vec<usize>, Option<NormalLaw>),
    delta: f64,
) -> Result<PressedState> {
    let size = strip.dof_count();
    // Neighbours move as this sector does.
    let points: Vec<Point> = points.iter().map(|own| own.folded(size)).collect();
    let pressing = Pressing {
        stiffness,
        load: strip.pressure_load(),
        elimination: Elimination::holding(size, strip.held_dofs()),
        contacts: Vec::new(),
        pushed: vec![delta; points.len()],
        laws: vec![law; points.len()],
        points: &points,
        together,
    };
    let mut system = ContactSystem::new(&pressing)?;
    let mut set = vec![true; points.len()];
    if !pressing.together.is_empty() {
        set = pressed_points(&mut system, 0.0, &set)?;
    }
    let mut state = system.unaltered_state(set)?;
    // Friction alone turns the sectors about their axis, and nothing but that: the rest is round-off.
    for (power, own) in state.displacements.iter_mut().enumerate() {
        let is_turn = |dof: usize| dof % strip.mesh.dimension == 1;
        let others = own.iter_mut().enumerate().filter(|own| is_turn(own.0) != (power == 1));
        others.for_each(|(_, value)| *value = 0.0);
    }
    Ok(state)
}

impl ContactSystem<'_> {
    /// The state of pressed points whose forces friction does not alter: `u(mu) = u_0 + mu u_1`.
    pub(super) fn unaltered_state(&mut self, is_pressed: Vec<bool>) -> Result<PressedState> {
        let state = self.state_of(0.0, &is_pressed)?;
        let [pressed, sheared] = [0.0, 1.0].map(|mu| self.whole_displacement(mu, &state)); // u_0 and u_0 + u_1.
        let sheared = difference(&sheared, &pressed);
        Ok(PressedState {
            displacements: vec![pressed, sheared],
            normal_forces: vec![state.normal_forces],
            stiffnesses: state.stiffnesses.into_iter().collect(),
            is_pressed,
            ..PressedState::default()
        })
    }
}

impl PressedState {
    /// The state of the points on the `edge` of an annulus, or of one of its equal `sectors`, all of which must be pressed.
    ///
    /// # Errors
    /// [`PrestressError::NoEquilibrium`] where a node would open.
    pub(super) fn pressed_all_round(
        self,
        (edge, points): (&ContactInterface, &[Point]),
        sectors: usize,
    ) -> Result<Self> {
        let forces = &self.normal_forces[0];
        let is_open = |i: &usize| !(forces[*i] > 0.0);
        let Some(first) = (0..forces.len()).find(is_open) else { return Ok(self) };
        let count = (0..forces.len()).filter(is_open).count() * sectors;
        Err(PrestressError::NoEquilibrium(format!(
            "contact opens in the base state: {count} of {} contact nodes are not pressed, first node {} at {:.3} degrees with {:.6e} Pa. \
             Full sliding needs pressure everywhere: raise contact.interference",
            forces.len() * sectors,
            edge.nodes[first] + 1,
            edge.angles[first].to_degrees(),
            forces[first] / points[first].weight
        )))
    }
}

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
        let (rings, law) = (&sector.rings, stiffness.base_law());
        let is_consistent = law.is_some() && mass == MassKind::Consistent;
        let is_integrated = sector.is_quadratic() || is_consistent;
        let rule = if is_integrated { FaceRule::Integrated } else { FaceRule::Nodal };
        let face = Face { sector, elastic, contact, law, rule };
        let (points, state) = if law.is_some() { face.on_springs() } else { face.on_rings() }?;

        // What nodes and rings have.
        let approaches = face.approaches(&points, &state.displacements[0]);
        let (nodes, on_nodes) = face.on_nodes(&points, &state);
        let force = |ring: &ContactRing| -> f64 {
            let forces = nodes.iter().zip(&on_nodes.normal_forces[0]);
            let own = forces.filter(|own| ring.nodes.contains(&(own.0.normal[0].0 / 3))); // The normal dof tells the node.
            own.map(|own| own.1).sum()
        };
        let ring_forces: Vec<f64> = rings.iter().map(force).collect();
        let pressing = if law.is_some() { &approaches } else { &ring_forces };
        let is_pressed: Vec<bool> = pressing.iter().map(|own| *own > 0.0).collect();
        if !is_pressed.contains(&true) {
            let distances = approaches.iter().map(|approach| 0.0 - approach); // Zero has no sign.
            let apart = [distances.fold(f64::INFINITY, f64::min), contact.interference];
            return Err(PrestressError::gap_everywhere(rings.len() * sector.sector_count(), apart));
        }
        let pressures = rings.iter().zip(pressing).map(|(ring, own)| match law {
            None => own / ring.area, // p = N / A.
            Some(law) => law.pressure(own.max(0.0)),
        });
        let pressures: Vec<f64> = pressures.collect();

        let on_face = if law.is_some() { (points, state) } else { face.under(&pressures) };
        Ok(Self {
            sliding: SectorSliding {
                state: on_nodes,
                turnings: nodes.iter().map(|point| turning(sector, point)).collect(),
                on_face: Some(on_face),
                places: rings.iter().map(|ring| ring.nodes.clone()).collect(),
                is_pressed,
                points: nodes,
            },
            pressures,
            law,
            contact: *contact,
            approaches,
        })
    }
}

/// How a node of the face turns: about the axis on a cylinder, while on a face it is the sliding that does.
fn turning(sector: &SolidSector, point: &Point) -> Turning {
    let curvature = 1.0 / sector.nodes[point.normal[0].0 / 3].radius;
    match sector.specification.contact.face().normal_component() {
        0 => Turning::along(curvature, Default::default()), // Along a cylinder normal and slip turn with the place.
        _ => Turning { veer: scaled(&point.slip, -curvature), ..Turning::default() },
    }
}

/// The face of a body, pressed by the rotor.
struct Face<'a> {
    sector: &'a SolidSector,
    /// Stiffness of the body.
    elastic: &'a Triplets,
    contact: &'a SlidingContact,
    law: Option<NormalLaw>,
    rule: FaceRule,
}

impl Face<'_> {
    /// Sense of the inward normal, and the component along it.
    fn normal(&self) -> (f64, usize) {
        let face = self.sector.specification.contact.face();
        (face.inward_sign(), face.normal_component())
    }

    /// [`of_sector`] of some points of the face.
    fn state(&self, points: &[Point], together: Vec<usize>) -> Result<PressedState> {
        let body = (&self.sector.strip, self.elastic);
        of_sector(body, (points, together, self.law), self.contact.interference)
    }

    /// The points of the whole face under some pressures of the rings, and their state.
    fn under(&self, pressures: &[f64]) -> (Vec<Point>, PressedState) {
        let sector = self.sector;
        let over = OverRings { sector, values: pressures, held: 0.0 };
        let (mut points, mut forces) = (Vec::new(), Vec::new());
        for element in sector.contact_elements() {
            for (along, point) in
                face_points(sector, (&element, [-1.0, 1.0]), self.contact, self.rule)
            {
                forces.push(point.weight * over.along(&element, along).max(0.0)); // N = A p.
                points.push(point);
            }
        }
        let is_pressed = forces.iter().map(|force| *force > 0.0).collect();
        (points, PressedState { is_pressed, normal_forces: vec![forces], ..Default::default() })
    }

    /// `delta - u_n` at each ring, the mean over its nodes, m: what the points see of it, less than all on a cylinder.
    fn approaches(&self, points: &[Point], displacement: &[f64]) -> Vec<f64> {
        let (sign, component) = self.normal();
        // The mean of sum_a N_a n_a . n, one at nodes, which have no area of their own, and on a plane.
        let along = |own: &Point| self.on_normals(own).map(|own| own.1).sum::<f64>();
        let all = points.iter().map(|own| [own.weight * along(own), own.weight]);
        let [sum, area] = all.fold([0.0; 2], |[a, b], own| [a + own[0], b + own[1]]);
        let seen = if area > 0.0 { sum / area } else { sign }; // Points at nodes, and a plane, see all of it.
        let approach = |ring: &ContactRing| {
            let normals = ring.nodes.iter().map(|node| displacement[3 * node + component]);
            self.contact.interference - seen * normals.sum::<f64>() / ring.nodes.len() as f64
        };
        self.sector.rings.iter().map(approach).collect()
    }

    /// Nodes of the sector with what the normal of a point has along theirs.
    fn on_normals(&self, point: &Point) -> impl Iterator<Item = (usize, f64)> {
        let (component, count) = (self.normal().1, self.sector.node_count());
        let along = point.normal.iter().filter(move |own| own.0 % 3 == component);
        along.map(move |(dof, along)| (dof / 3 % count, *along))
    }

    /// The nodes that points of a state push, those that something else holds along the normal, too, and their state.
    fn on_nodes(&self, points: &[Point], state: &PressedState) -> (Vec<Point>, PressedState) {
        let mut on_nodes = vec![0.0; self.sector.node_count()];
        for (point, force) in points.iter().zip(&state.normal_forces[0]) {
            self.on_normals(point).for_each(|(node, along)| on_nodes[node] += along * force);
        }
        let signed = on_nodes.into_iter().map(|force| self.normal().0 * force).enumerate();
        let pushed = signed.filter(|own| own.1 != 0.0); // A node that something else holds may pull.
        let own = pushed.map(|(node, force)| (node_point(self.sector, node, self.contact), force));
        let (nodes, forces): (Vec<Point>, Vec<f64>) = own.unzip();
        let state = PressedState {
            displacements: state.displacements.clone(),
            is_pressed: vec![true; forces.len()],
            normal_forces: vec![forces],
            ..PressedState::default()
        };
        (nodes, state)
    }

    /// Signorini's conditions ring by ring, `N >= 0` of its nodes together and `u_n = delta` of each where it is pressed.
    fn on_rings(&self) -> Result<(Vec<Point>, PressedState)> {
        let nodes = self.sector.rings.iter().flat_map(|ring| &ring.nodes);
        let point = |&node: &usize| node_point(self.sector, node, self.contact);
        let points: Vec<Point> = nodes.map(point).collect();
        let together = self.sector.rings.iter().map(|ring| ring.nodes.len()).collect();
        let state = self.state(&points, together)?;
        Ok((points, state))
    }

    /// Springs that push and do not pull, at points of the part of the face that is pressed: Newton's method on the approach of the
    /// rings, as nothing pushes where that part ends. The tangent of the eigenvalue analysis is the derivative of this state.
    fn on_springs(&self) -> Result<(Vec<Point>, PressedState)> {
        let (sector, contact) = (self.sector, self.contact);
        let held = if self.rule == FaceRule::Integrated { contact.interference } else { 0.0 };
        let mut values = vec![1.0; sector.rings.len()]; // All pressed.
        for _ in 0..SETS {
            let over = OverRings { sector, values: &values, held };
            let mut points = Vec::new();
            for element in sector.contact_elements() {
                for span in over.pressed_spans(&element, self.rule) {
                    let own = face_points(sector, (&element, span), contact, self.rule);
                    points.extend(own.into_iter().map(|own| own.1));
                }
            }
            let state = self.state(&points, Vec::new())?;
            let found = self.approaches(&points, &state.displacements[0]);
            if norm(&difference(&found, &values)) <= SETTLED * norm(&found) {
                return Ok((points, state));
            }
            values = found;
        }
        Err(PrestressError::NoState { friction_coefficient: 0.0 })
    }
}
