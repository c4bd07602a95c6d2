//! Bodies of one mesh that slide: on each other or on a counterface, solid ones tied together.

use super::contact_system::ContactSystem;
use super::elimination::Elimination;
use super::joint::{BaseChoice, SlidingSurfaces, TiedSurfaces};
use super::pressed_range::PressedRange;
use super::pressed_state::Pressing;
use super::rotation::Rotation;
use super::tangent::{ContactDofs, ContactPart, SlidingTangent};
use super::terms::{Kind, PartLaw, Terms, geometric_stiffness};
use super::{PrestressError, Result, TangentOptions};
use crate::contact::{
    ContactInterface, ContactStiffness, ContactSurface, Motion, PairError, Point, PointKind,
    PressedState, SlidingContact, SurfacePair, Turning, mortar_nodes,
};
use crate::fem::{
    MassKind, MaterialField, RotationTerms, Triplets, assemble_pressures, assemble_supports,
    region_stiffnesses,
};
use crate::mesh::Mesh;
use std::sync::Arc;

/// Bodies of one mesh with what ties them and what slides.
///
/// In steady sliding every pressed contact point slips: with the push `p_i = delta - g_i` and the normal displacement `u_n` over
/// what it meets,
///
/// ```text
/// u_n = p_i,   T_i = s mu(V) N_i   at pressed points of rigid contact,   N_i = T_i = 0 at open ones,   K u = f elsewhere
/// ```
///
/// with the boundary conditions; springs carry `N_i = w_i p(p_i - u_n)`. Under one set of pressed points the state is a smooth
/// function of `mu`, kept as a polynomial. Vectors are over all dofs in nodal frames, of a plane body for each metre of thickness.
///
/// Meshes stay where they are; the sliding is imposed as a relative velocity. Small motions have the geometric stiffness of the
/// base state where [`TangentOptions::geometric_stiffness`] asks for it, and with it the turning of contact forces: of these one
/// without the other would not leave a rigid rotation free. Pressures are dead. A region that turns may have the inertia of its
/// rotation ([`crate::fem::RotationTerms`]) with the geometric stiffness of its centrifugal stress.
#[derive(Debug)]
pub struct Assembly<'a> {
    /// The mesh of all bodies.
    pub mesh: &'a Mesh,
    /// The materials of its regions.
    pub materials: &'a dyn MaterialField,
    /// What is to be kept of it where the bodies are borrowed for a while only.
    pub joined: Arc<Joined>,
}

/// What a mesh, its materials and the pairs of its surfaces give: the costly part of an [`Assembly`], made once.
#[derive(Debug)]
pub struct Joined {
    /// Stiffness of each region, N/m.
    elastic: Vec<Triplets>,
    /// Springs (N/m) and dashpots (N s/m) of the supports.
    pub(crate) supports: [Triplets; 2],
    /// Held dofs and ties.
    pub(crate) basis: Elimination,
    /// The contacts with their points.
    pub contacts: Arc<[(SlidingSurfaces, ContactSurface)]>,
    base: BaseChoice,
    rotation: Option<Rotation>,
}

impl Joined {
    /// Stiffness of bodies and supports over all dofs.
    pub(crate) fn stiffness(&self) -> Triplets {
        let own = self.elastic.iter().chain([&self.supports[0]]);
        Triplets { entries: own.flat_map(|own| &own.entries).copied().collect() }
    }
}

impl<'a> Assembly<'a> {
    /// A plane body, or two, that slides on its contact edge. The contact is rigid in the base state whatever constant stiffness it
    /// has; one that stiffens with pressure carries that state too.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_edge(
        mesh: &'a Mesh,
        materials: &'a dyn MaterialField,
        contact: &SlidingContact,
        stiffness: ContactStiffness,
    ) -> Result<Self> {
        let edge = SlidingSurfaces::of_edge(mesh, contact, stiffness);
        Self::new(mesh, materials, (&[], &[edge]), (&[], BaseChoice::Solved), MassKind::Consistent)
    }

    /// Pairs the surfaces of `ties` and `contacts`, and eliminates the ties. With lumped mass all contact points are nodes of the
    /// finer surface: a time step tells the forces of points that stick apart.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] names the tie or contact whose surfaces do not meet.
    pub fn new(
        mesh: &'a Mesh,
        materials: &'a dyn MaterialField,
        (ties, contacts): (&[TiedSurfaces], &[SlidingSurfaces]),
        (motions, base): (&[Motion], BaseChoice),
        mass: MassKind,
    ) -> Result<Self> {
        let mut basis = Elimination::holding(mesh.dof_count(), mesh.held_dofs());
        for tie in ties {
            tie_surfaces(mesh, tie, &mut basis)?;
        }
        // Equations hold along the global axes, dofs are along those of nodes: a_k = a e_k.
        for equation in &mesh.equations {
            let row = equation.iter().flat_map(|&(node, axis, factor)| {
                let frame = mesh.frame(node as usize);
                let shares =
                    (0..3).map(move |k| (3 * node as usize + k, factor * frame[(axis, k)]));
                shares.filter(|share| share.1 != 0.0)
            });
            // Nothing is left of one whose nodes are all held.
            if let Some(pivot) = basis.take(&row.collect()) {
                basis.drop_unknown(pivot);
            }
        }
        let found: Result<Arc<[_]>> = contacts
            .iter()
            .map(|contact| {
                let sides = (&mesh.boundaries[contact.surface], &contact.counter);
                // Springs may stand at quadrature points; what has a dof of its own stands at a node.
                let kind = match contact.stiffness.normal_stiffness {
                    Some(_) if mass == MassKind::Consistent => PointKind::Segments,
                    _ => PointKind::Nodes,
                };
                let kind = (kind, contact.topography.as_deref());
                let surface = ContactSurface::of(mesh, sides, motions, contact.friction, kind);
                Ok((contact.clone(), surface.map_err(unpaired(contact.section()))?))
            })
            .collect();
        let elastic = region_stiffnesses(mesh, materials);
        let supports = assemble_supports(mesh);
        let contacts = found?;
        let mut joined = Joined { contacts, rotation: None, elastic, supports, basis, base };
        // Surfaces of ties are glued: they are no sides of a body that turns.
        let seams: Vec<usize> = ties.iter().flat_map(|t| [t.surface, t.counter]).collect();
        let held = || joined.basis.congruent(&joined.stiffness()).into_owned();
        let rotation = Rotation::of(mesh, materials, motions, (&joined.basis, &seams), held)?;
        joined.rotation = rotation;
        Ok(Self::of(mesh, materials, Arc::new(joined)))
    }

    /// From what was made of the same mesh and materials before.
    pub fn of(mesh: &'a Mesh, materials: &'a dyn MaterialField, joined: Arc<Joined>) -> Self {
        Self { mesh, materials, joined }
    }

    /// The contacts with their points.
    pub fn contacts(&self) -> &[(SlidingSurfaces, ContactSurface)] {
        &self.joined.contacts
    }

    /// Whether nothing holds the bodies: a part by itself, whose rigid motions have no stiffness.
    pub fn is_free(&self) -> bool {
        let held = self.mesh.held_dofs().count() + self.mesh.equations.len();
        let springs = &self.joined.supports[0].entries;
        held == 0
            && springs.is_empty()
            && self.joined.contacts.is_empty()
            && self.joined.rotation.is_none()
    }

    /// The base state at one friction coefficient.
    ///
    /// # Errors
    /// As [`Self::range`].
    pub fn state(&self, friction_coefficient: f64) -> Result<PressedState> {
        let PressedRange { states, .. } =
            self.range(&[friction_coefficient], &Default::default())?;
        states.into_iter().next().ok_or(PrestressError::NoState { friction_coefficient })
    }

    /// Base states at every one of `friction_coefficients`, over the points of all contacts in turn. What is `known` of the same bodies
    /// is not solved again.
    ///
    /// # Errors
    /// [`PrestressError::GapEverywhere`], [`PrestressError::NoState`], [`PrestressError::Singular`]; of an annulus
    /// [`PrestressError::NoEquilibrium`] where a node would open.
    pub fn range(
        &self,
        friction_coefficients: &[f64],
        known: &PressedRange,
    ) -> Result<PressedRange> {
        // The points of all contacts in turn, each with its contact.
        let contacts = self.contacts();
        let of_points = || {
            let all = contacts.iter();
            all.flat_map(|(own, surface)| surface.points.iter().map(move |point| (own, point)))
        };
        let points: Vec<Point> = of_points().map(|(_, point)| point.clone()).collect();
        if self.joined.base == BaseChoice::Closed {
            return Ok(PressedRange::of_one(
                PressedState {
                    displacements: vec![vec![0.0; self.mesh.dof_count()]],
                    is_pressed: vec![true; points.len()],
                    ..PressedState::default()
                },
                friction_coefficients,
            ));
        }
        // What loads the bodies beside the contacts: pressures on boundaries and rotation.
        let stiffness = self.joined.stiffness();
        let none = || vec![0.0; self.mesh.dof_count()];
        let mut load = assemble_pressures(self.mesh).unwrap_or_else(none);
        if let Some(rotation) = &self.joined.rotation {
            load.iter_mut().zip(&rotation.terms.centrifugal).for_each(|(load, own)| *load += own);
        }
        if contacts.is_empty() {
            return self.without_contact(&stiffness, &load, friction_coefficients);
        }
        // How far each point is pushed in along its normal.
        let pushed = of_points().map(|(own, point)| own.counter.interference() - point.gap); // p_i = delta - g_i.
        let named = contacts.iter().map(|(own, surface)| (own.section(), surface.points.len()));
        let pressing = Pressing {
            laws: of_points().map(|(own, _)| own.base_law()).collect(),
            stiffness: &stiffness,
            load,
            elimination: self.joined.basis.clone(),
            contacts: named.collect(),
            together: Vec::new(),
            pushed: pushed.collect(),
            points: &points,
        };
        if !self.mesh.is_cyclic {
            return pressing.states(self.mesh, (friction_coefficients, known));
        }
        let state = ContactSystem::new(&pressing)?.unaltered_state(vec![true; points.len()])?;
        let state = state.pressed_all_round((&ContactInterface::of(self.mesh), &points), 1)?;
        Ok(PressedRange::of_one(state, friction_coefficients))
    }

    /// Bodies that are tied at most, under their loads.
    fn without_contact(
        &self,
        stiffness: &Triplets,
        load: &[f64],
        friction_coefficients: &[f64],
    ) -> Result<PressedRange> {
        // Without a load there is nothing to hold, in part or at all.
        let displacement = if load.iter().all(|force| *force == 0.0) {
            vec![0.0; self.mesh.dof_count()]
        } else if self.is_free() {
            let problem = "nothing holds the bodies against the pressure on them. Give a boundary that is clamped, fixed or supported, or \
                           leave the pressure out for the free modes of a part";
            return Err(PrestressError::NoEquilibrium(problem.to_owned()));
        } else {
            let basis = &self.joined.basis;
            let held = basis.congruent(stiffness);
            basis.displacement_under(load, &held).or_else(|error| match &self.joined.rotation {
                // A centrifugal load alone is in balance by itself.
                Some(own) if own.terms.centrifugal == load => Ok(own.displacement.clone()),
                _ => Err(error),
            })?
        };
        let displacements = vec![displacement];
        let state = PressedState { displacements, ..PressedState::default() };
        Ok(PressedRange::of_one(state, friction_coefficients))
    }

    /// The matrices of the bodies without stress and contact over all dofs.
    pub fn terms(&self, options: &TangentOptions) -> Terms<Triplets> {
        let elastic = self.joined.elastic.clone();
        let mut terms = Terms::of_elastic((self.mesh, self.materials), elastic, false, options);
        if options.mass == MassKind::Lumped {
            // A lumped mass stays diagonal where dofs follow others.
            let masses = terms.all.iter_mut().filter(|term| term.kind == Kind::Mass);
            masses.for_each(|term| term.matrix = self.joined.basis.gathered(&term.matrix));
        }
        if let Some(rotation) = &self.joined.rotation {
            let RotationTerms { transport, gyroscopic, .. } = rotation.terms.clone();
            let own = [(Kind::Transport, transport), (Kind::Gyroscopic, gyroscopic)];
            terms.add_body(Some("rotation".into()), PartLaw::default(), own);
        }
        terms
    }

    /// Geometric stiffness of the stress of a base state for each region, N/m, by power of friction in the terms of a state
    /// that is frozen; `None` of a state that is free of stress.
    pub fn stress(&self, state: &PressedState) -> Option<Vec<Vec<Triplets>>> {
        let (state, bodies) = (self.stressing(state)?, (self.mesh, self.materials));
        let regions = 0..self.mesh.regions.len().max(1);
        Some(regions.map(|region| geometric_stiffness(bodies, &state, region)).collect())
    }

    /// Mass, damping and stiffness of small motions around `state`.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] where a rigid contact has no free dof to hold.
    pub fn tangent(
        &self,
        state: &PressedState,
        options: &TangentOptions,
    ) -> Result<SlidingTangent> {
        let (joined, mut terms) = (&self.joined, self.terms(options));
        let stressing = self.stressing(state).filter(|_| options.geometric_stiffness);
        // What is free of stress has no contact forces that could turn.
        let turnings = match &stressing {
            Some(_) => self.turnings(),
            None => vec![Vec::new(); joined.contacts.len()],
        };
        if let Some(state) = &stressing {
            terms.add_stress((self.mesh, self.materials), state);
        }
        // Each contact has its stretch of the state's points.
        let mut first = 0;
        let parts = joined.contacts.iter().zip(&turnings).map(|((contact, surface), turnings)| {
            let part = ContactPart {
                points: &surface.points,
                turnings,
                state,
                first,
                stiffness: contact.stiffness,
                has_own_dofs: contact.has_own_dofs(),
            };
            first += surface.points.len();
            part
        });
        let parts: Vec<ContactPart<'_>> = parts.collect();
        let dofs = if self.mesh.dimension == 2 { self.edge_dofs() } else { self.surface_dofs() };
        SlidingTangent::assemble(terms, &parts, joined.basis.clone(), dofs, options)
    }

    /// Dofs that the contact edge of a plane body touches; those of its own nodes come first in rows.
    fn edge_dofs(&self) -> ContactDofs {
        let points = || self.contacts().iter().flat_map(|(_, surface)| &surface.points);
        let others = points().flat_map(|point| [&point.normal, &point.slip]);
        let normal: Vec<usize> = points().map(|point| point.normal[0].0).collect();
        let angle = |dof: &usize| self.mesh.frame_angles()[dof / 2];
        ContactDofs {
            tangential: points().map(|point| point.slip[0].0).collect(),
            opposite: others.flat_map(|row| &row[1..]).map(|share| share.0).collect(),
            sliding_direction: points().next().map_or(1.0, |own| own.friction.drag.signum()),
            angles: normal.iter().filter(|_| self.mesh.is_cyclic).map(angle).collect(),
            normal,
        }
    }

    /// All dofs of the nodes on contact surfaces of solid bodies.
    fn surface_dofs(&self) -> ContactDofs {
        let nodes = self.contacts().iter().flat_map(|(_, surface)| &surface.nodes);
        ContactDofs {
            tangential: nodes
                .flat_map(|&node| (0..3).map(move |axis| 3 * node as usize + axis))
                .collect(),
            sliding_direction: 1.0,
            ..ContactDofs::default()
        }
    }

    /// How the points of each contact turn.
    pub fn turnings(&self) -> Vec<Vec<Turning>> {
        let contacts = self.joined.contacts.iter();
        contacts.map(|(own, surface)| surface.turnings(self.mesh, &own.counter)).collect()
    }

    /// A state with the displacements whose stress acts on small motions beside the terms of the rotation, which have the
    /// centrifugal one; `None` of a state that is free of stress.
    pub fn stressing(&self, state: &PressedState) -> Option<PressedState> {
        let mut own = (self.joined.base == BaseChoice::Solved).then(|| state.clone())?;
        if let Some(rotation) = &self.joined.rotation {
            // u - u_c: the terms of the rotation have the stress of u_c.
            let pairs = own.displacements[0].iter_mut().zip(&rotation.displacement);
            pairs.for_each(|(whole, centrifugal)| *whole -= centrifugal);
        }
        Some(own)
    }
}

/// Takes the jumps of a tie's nodes for unknowns, and drops them.
fn tie_surfaces(mesh: &Mesh, tie: &TiedSurfaces, basis: &mut Elimination) -> Result<()> {
    let [surface, counter] = [tie.surface, tie.counter].map(|b| &mesh.boundaries[b]);
    let pair = SurfacePair::of(mesh, surface, counter);
    let pair = pair.map_err(unpaired(format!("ties.{}", tie.name)))?;
    for node in mortar_nodes(mesh, surface, &pair) {
        for axis in 0..3 {
            let mut direction = [0.0; 3]; // own_i . u - counter_i . u = 0 along each axis.
            direction[axis] = 1.0;
            // A jump without a free dof is held on both sides already.
            if let Some(pivot) = basis.take(&node.jump(mesh, direction)) {
                basis.drop_unknown(pivot);
            }
        }
    }
    Ok(())
}

/// The error of the surfaces of a section.
fn unpaired(name: String) -> impl FnOnce(PairError) -> PrestressError {
    move |error| PrestressError::Asked(format!("{name}: {error}"))
}
