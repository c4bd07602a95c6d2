//! Pressed equilibrium of a body of revolution in steady sliding: rigid contact ring by ring, or springs over the face.

use super::complementarity::ROUND_OFF;
use super::contact_system::ContactSystem;
use super::elimination::Elimination;
use super::pressed_state::{PressedBodies, Pressing};
use super::solid::{FaceRule, OverRings, face_points, node_point};
use super::{PrestressError, Result, SectorSliding, SolidSliding};
use crate::contact::{ContactStiffness, NormalLaw, Point, PressedState, SlidingContact};
use crate::fem::{MassKind, Triplets};
use crate::linalg::dense::{difference, norm};
use crate::mesh::{ContactRing, SolidSector};

/// Choices of what is pressed that are tried before the search is given up.
const SETS: usize = 200;

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
        let (rings, law) = (&sector.rings, stiffness.base_law());
        let is_consistent = law.is_some() && mass == MassKind::Consistent;
        let is_integrated = sector.is_quadratic() || is_consistent;
        let rule = if is_integrated { FaceRule::Integrated } else { FaceRule::Nodal };
        let face = Face { sector, elastic, contact, law, rule };
        let (points, state) = if law.is_some() { face.on_springs() } else { face.on_rings() }?;

        // What the rings have.
        let approaches = face.approaches(&points, &state.displacements[0]);
        let forces = face.node_forces(&points, &state.normal_forces[0]);
        let force = |ring: &ContactRing| -> f64 {
            forces.iter().filter(|own| ring.nodes.contains(&own.0)).map(|own| own.1).sum()
        };
        let ring_forces: Vec<f64> = rings.iter().map(force).collect();
        let pressing = if law.is_some() { &approaches } else { &ring_forces };
        let is_pressed: Vec<bool> = pressing.iter().map(|own| *own > 0.0).collect();
        if !is_pressed.contains(&true) {
            let distances = approaches.iter().map(|approach| 0.0 - approach); // Zero has no sign.
            return Err(PrestressError::GapEverywhere {
                total: rings.len() * sector.sector_count(),
                distance: distances.fold(f64::INFINITY, f64::min),
                interference: contact.interference,
            });
        }
        let pressures = rings.iter().zip(pressing).map(|(ring, own)| match law {
            None => own / ring.area, // p = N / A.
            Some(law) => law.pressure(own.max(0.0)),
        });
        let on_nodes = PressedState {
            displacements: state.displacements.clone(),
            is_pressed: vec![true; forces.len()],
            normal_forces: vec![forces.iter().map(|own| own.1).collect()],
            ..PressedState::default()
        };
        Ok(Self {
            pressures: pressures.collect(),
            sliding: SectorSliding {
                state: on_nodes,
                points: forces.iter().map(|own| node_point(sector, own.0, contact)).collect(),
            },
            springs: law.map(|_| SectorSliding { state, points }),
            rule,
            contact: *contact,
            is_pressed,
            approaches,
        })
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

    /// The state of those of some points that `pressed` finds to be.
    fn state(
        &self,
        points: &[Point],
        pressed: impl FnOnce(&mut ContactSystem<'_>) -> Result<Vec<bool>>,
    ) -> Result<PressedState> {
        let (strip, size) = (&self.sector.strip, self.sector.strip.dof_count());
        // Neighbours move as this sector does.
        let points: Vec<Point> = points.iter().map(|own| own.folded(size)).collect();
        let own = points.iter().map(|own| Some(own.weight * self.law?.stiffness(0.0)));
        let pressing = Pressing {
            stiffness: self.elastic,
            load: strip.pressure_load(),
            elimination: Elimination::holding(size, strip.held_dofs()),
            contacts: Vec::new(),
            pushed: vec![self.contact.interference; points.len()],
            stiffnesses: own.collect(),
            laws: vec![self.law; points.len()],
            points: &points,
            known: None,
        };
        let mut system = ContactSystem::new(&pressing)?;
        let set = pressed(&mut system)?;
        let mut state = system.unaltered_state(set)?;
        // Friction alone turns the sectors about their axis, and nothing but that: the rest is round-off.
        for (power, own) in state.displacements.iter_mut().enumerate() {
            let others =
                own.iter_mut().enumerate().filter(|(dof, _)| (dof % 3 == 1) != (power == 1));
            others.for_each(|(_, value)| *value = 0.0);
        }
        Ok(state)
    }

    /// `delta - u_n` at each ring, the mean over its nodes, m: what the points see of it, less than all on a cylinder.
    fn approaches(&self, points: &[Point], displacement: &[f64]) -> Vec<f64> {
        let (sign, component) = self.normal();
        // The mean of sum_a N_a n_a . n, one at nodes, which have no area of their own, and on a plane.
        let along = |own: &Point| self.on_normals(own).map(|own| own.1).sum::<f64>();
        let all = points.iter().map(|own| [own.weight * along(own), own.weight]);
        let [sum, area] = all.fold([0.0; 2], |[a, b], own| [a + own[0], b + own[1]]);
        let seen = if area > 0.0 { sum / area } else { sign };
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

    /// The nodes that points push, those that something else holds along the normal, too, and their forces, N.
    fn node_forces(&self, points: &[Point], forces: &[f64]) -> Vec<(usize, f64)> {
        let mut on_nodes = vec![0.0; self.sector.node_count()];
        for (point, force) in points.iter().zip(forces) {
            self.on_normals(point).for_each(|(node, along)| on_nodes[node] += along * force);
        }
        let signed = on_nodes.into_iter().map(|force| self.normal().0 * force).enumerate();
        signed.filter(|own| own.1 != 0.0).collect()
    }

    /// Signorini's conditions ring by ring, `N >= 0` of its nodes together and `u_n = delta` of each where it is pressed.
    fn on_rings(&self) -> Result<(Vec<Point>, PressedState)> {
        let rings = &self.sector.rings;
        let point = |&node: &usize| node_point(self.sector, node, self.contact);
        let points: Vec<Point> = rings.iter().flat_map(|ring| &ring.nodes).map(point).collect();
        let state = self.state(&points, |system| {
            let delta = self.contact.interference;
            let mut is_pressed = vec![true; rings.len()];
            for _ in 0..SETS {
                let both = rings.iter().zip(&is_pressed);
                let set =
                    both.flat_map(|(ring, own)| vec![*own; ring.nodes.len()]).collect::<Vec<_>>();
                let state = system.state_of(0.0, &set)?;
                let scale = state.normal_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
                // Pressed rings must push, open ones must not have come nearer than delta.
                let mut first = 0;
                let next = rings.iter().zip(&is_pressed).map(|(ring, is_pressed)| {
                    let own = first..first + ring.nodes.len();
                    first = own.end;
                    if *is_pressed {
                        return state.normal_forces[own].iter().sum::<f64>() > ROUND_OFF * scale;
                    }
                    let approach: f64 = own.map(|i| delta - state.separations[i]).sum();
                    approach > ROUND_OFF * delta.abs()
                });
                let next: Vec<bool> = next.collect();
                if next == is_pressed {
                    return Ok(set);
                }
                is_pressed = next;
            }
            Err(PrestressError::NoState { friction_coefficient: 0.0 })
        })?;
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
            let state = self.state(&points, |_| Ok(vec![true; points.len()]))?;
            let found = self.approaches(&points, &state.displacements[0]);
            if norm(&difference(&found, &values)) <= SETTLED * norm(&found) {
                return Ok((points, state));
            }
            values = found;
        }
        Err(PrestressError::NoState { friction_coefficient: 0.0 })
    }
}
