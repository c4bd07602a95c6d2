//! A body that is solved on its whole mesh, and its base states.

use frictionsim_case::{AssemblyBody, Body, Case, Cea, CeaMethod};
use frictionsim_physics::cea::CeaError;
use frictionsim_physics::contact::{ContactStiffness, ContactSurface, Point, Turning};
use frictionsim_physics::fem::{assemble_stiffness, solid_stress};
use frictionsim_physics::mesh::{CyclicSymmetry, Mesh};
use frictionsim_physics::prestress::{
    Assembly, BaseChoice, Joined, PressedRange, PressedState, SlidingRange, SlidingSurfaces,
    SlidingTangent, SteadySliding, TangentOptions,
};
use frictionsim_results::cea::{AssemblyPoint, AssemblyReport, FeedPlace};
use std::borrow::Cow;
use std::sync::Arc;

/// Name of the only contact of a body that slides on a rigid counterface.
pub(super) const CONTACT: &str = "contact";

/// A whole mesh and its base states.
pub struct WholeMesh {
    /// The mesh.
    pub mesh: Arc<Mesh>,
    /// Base states at the friction coefficients that are solved, and last at the case's own.
    pub range: PressedRange,
    /// How the tangent is taken.
    pub options: TangentOptions,
    /// The symmetry that the eigenvalue analysis uses.
    pub symmetry: Option<CyclicSymmetry>,
    /// What slides on it.
    pub sliding: Sliding,
}

/// What slides on a whole mesh.
pub enum Sliding {
    /// The contact edge of a plane body, here in the base state at the case's own friction coefficient.
    Edge(Box<SteadySliding>),
    /// Solid bodies, with their surfaces paired.
    Bodies(Arc<Joined>),
}

/// A contact point in the base state at the case's own friction coefficient.
pub(crate) struct BasePoint {
    pub place: FeedPlace,
    pub point: Point,
    /// How it turns; nothing where no stress acts on small motions.
    pub turning: Vec<Turning>,
    pub is_pressed: bool,
    /// Normal force, none of a state that is free of stress, and stiffness where contact stiffens.
    pub forces: Vec<Vec<f64>>,
    pub springs: Vec<Vec<f64>>,
    pub stiffness: ContactStiffness,
}

impl WholeMesh {
    /// Solves the base states of a case at some friction coefficients and at its own.
    ///
    /// # Errors
    /// A mesh that cannot be built, surfaces that do not meet; no base state.
    pub fn solve(
        case: &Case,
        options: TangentOptions,
        frictions: &[f64],
    ) -> Result<Self, CeaError> {
        let contact = &case.contact.sliding;
        let own = [contact.friction_coefficient];
        let mesh = case.mesh()?;
        let (range, sliding) = match &case.body {
            Body::Assembly(body) => {
                let assembly = body.assembled()?;
                let start = start_of(assembly.contacts());
                let range = assembly.range(&[frictions, start, &own].concat())?;
                (range, Sliding::Bodies(assembly.joined))
            }
            _ => {
                let stiffness = assemble_stiffness(&mesh, case.materials());
                let (law, all) = (options.contact.law, [frictions, &own].concat());
                let range = SlidingRange::solve(&mesh, &stiffness, contact, law, &all)?;
                let base = Box::new(range.states[place_of_own(&range)].clone());
                (range.map(|own| own.state), Sliding::Edge(base))
            }
        };
        Ok(Self { symmetry: used_symmetry(case, &mesh), mesh, range, options, sliding })
    }

    /// Base states at some friction coefficients between those of this one, which come first.
    pub(super) fn states_at(
        &self,
        case: &Case,
        frictions: &[f64],
    ) -> Result<PressedRange, CeaError> {
        match self.assembly(case) {
            Some(assembly) => {
                Ok(assembly.range(&[frictions, start_of(assembly.contacts())].concat())?)
            }
            None => Ok(Self::solve(case, self.options, frictions)?.range),
        }
    }

    /// The model of a case with the base states of this one: for a case that differs in nothing that these depend on.
    pub(super) fn with_its_states(&self, case: &Case, options: TangentOptions) -> Option<Self> {
        let sliding = match &self.sliding {
            Sliding::Edge(base) => Sliding::Edge(base.clone()),
            Sliding::Bodies(_) => {
                // A centrifugal load depends on the density.
                let body = case.body.assembly().filter(|body| body.rotors().next().is_none())?;
                Sliding::Bodies(body.assembled().ok()?.joined)
            }
        };
        Some(Self {
            // Its boundaries have supports.
            mesh: case.mesh().ok()?,
            range: self.range.clone(),
            symmetry: self.symmetry,
            options,
            sliding,
        })
    }

    /// The state at the case's own friction coefficient.
    pub fn state(&self) -> &PressedState {
        &self.range.states[place_of_own(&self.range)]
    }

    /// The solid bodies with what ties them and what slides; `None` of a plane body.
    pub fn assembly<'a>(&self, case: &'a Case) -> Option<Assembly<'a>> {
        match (&self.sliding, &case.body) {
            (Sliding::Bodies(joined), Body::Assembly(body)) => {
                Some(Assembly::of(&body.mesh, &body.materials, Arc::clone(joined)))
            }
            _ => None,
        }
    }

    /// The tangent of one of the states.
    ///
    /// # Errors
    /// Those of [`Assembly::tangent`].
    pub fn tangent(&self, case: &Case, state: &PressedState) -> Result<SlidingTangent, CeaError> {
        let (mesh, materials, options) = (&self.mesh, case.materials(), &self.options);
        let Sliding::Edge(base) = &self.sliding else {
            let assembly = self.assembly(case);
            let assembly = assembly.expect("paired surfaces are those of solid bodies");
            return Ok(assembly.tangent(state, options)?);
        };
        let mut base = base.clone();
        base.state.clone_from(state);
        let stiffness = assemble_stiffness(mesh, materials);
        Ok(SlidingTangent::linearize(mesh, materials, &stiffness, &base, options))
    }

    /// The tangent at the case's own friction coefficient.
    ///
    /// # Errors
    /// As [`Self::tangent`].
    pub fn own_tangent(&self, case: &Case) -> Result<SlidingTangent, CeaError> {
        self.tangent(case, self.state())
    }

    /// A state as far as its stress acts on small motions beside the terms of the rotation; `None` of one that is free
    /// of stress.
    pub fn stressing<'s>(
        &self,
        case: &Case,
        state: &'s PressedState,
    ) -> Option<Cow<'s, PressedState>> {
        match self.assembly(case) {
            Some(assembly) => assembly.stressing(state).map(Cow::Owned),
            None => Some(Cow::Borrowed(state)),
        }
    }

    /// The contact points in the base state at the case's own friction coefficient.
    pub(crate) fn contact_points(&self, case: &Case) -> Vec<BasePoint> {
        let (state, friction) = (self.state(), case.contact.sliding.friction_coefficient);
        let (forces, springs) = (state.normal_forces(friction), state.springs(friction));
        let mut found = Vec::new();
        let mut add = |place: FeedPlace, point: &Point, turning: Option<&Turning>, stiffness| {
            let i = found.len();
            found.push(BasePoint {
                place,
                point: point.clone(),
                turning: turning.cloned().into_iter().collect(),
                is_pressed: state.is_pressed[i],
                forces: value_of(&forces, i),
                springs: value_of(&springs, i),
                stiffness,
            });
        };
        let is_stressed = self.options.geometric_stiffness && self.stressing(case, state).is_some();
        if let Sliding::Edge(base) = &self.sliding {
            let turnings = if is_stressed { base.interface.turnings() } else { Vec::new() };
            let places = edge_places(case, &self.mesh, base).into_iter().zip(&base.points);
            for (i, (place, point)) in places.enumerate() {
                add(place, point, turnings.get(i), self.options.contact);
            }
        } else if let Some(assembly) = self.assembly(case) {
            let turnings = if is_stressed { assembly.turnings() } else { Vec::new() };
            for (k, (contact, surface)) in assembly.contacts().iter().enumerate() {
                for (i, point) in surface.points.iter().enumerate() {
                    let place = FeedPlace {
                        contact: contact.name.clone(),
                        position: surface.sites[i].position,
                        area: point.weight,
                        shares: surface.shares[i].clone(),
                    };
                    let turning = turnings.get(k).and_then(|own| own.get(i));
                    add(place, point, turning, contact.stiffness);
                }
            }
        }
        found
    }

    /// The base state of solid bodies point by point at the case's own friction coefficient.
    pub(super) fn report(&self, case: &Case, joined: &Joined) -> AssemblyReport {
        let friction = case.contact.sliding.friction_coefficient;
        let state = self.state();
        let forces = state.normal_forces(friction);
        let contacts = joined.contacts.iter();
        let all = contacts.clone().flat_map(|(contact, surface)| {
            let points = surface.points.iter().zip(&surface.sites).zip(&surface.shares);
            points.map(move |((point, site), shares)| (contact, point, site, shares))
        });
        let points = all.enumerate().map(|(i, (contact, point, site, shares))| {
            let pressure = forces.get(i).map_or(0.0, |force| force / point.weight);
            AssemblyPoint {
                contact: contact.name.clone(),
                site: *site,
                area: point.weight,
                pressure,
                shear: friction * point.friction.drag * pressure,
                is_closed: state.is_pressed[i],
                speed: point.speed,
                shares: shares.clone(),
            }
        });
        let displacement = state.displacement(friction);
        AssemblyReport {
            stress: solid_stress(&self.mesh, case.materials(), &displacement),
            surfaces: contacts.map(|(own, _)| (own.name.clone(), own.surface)).collect(),
            points: points.collect(),
            displacement,
        }
    }
}

/// Which state is that at the case's own friction coefficient.
fn place_of_own<S>(range: &PressedRange<S>) -> usize {
    *range.state_of.last().expect("the case's own friction coefficient comes last")
}

/// Where the base states begin: contact that stiffens depends on friction, and the analysis starts without.
fn start_of(contacts: &[(SlidingSurfaces, ContactSurface)]) -> &'static [f64] {
    let stiffens = contacts.iter().any(|(contact, _)| contact.law.is_some());
    if stiffens { &[0.0] } else { &[] }
}

/// The symmetry of a mesh that the eigenvalue analysis of a case uses: none where the whole mesh is asked for.
fn used_symmetry(case: &Case, mesh: &Mesh) -> Option<CyclicSymmetry> {
    let is_whole = |cea: &Cea| cea.method == CeaMethod::Sparse;
    mesh.symmetry.filter(|_| !case.cea.as_ref().is_some_and(is_whole))
}

/// The value of a point as a power of friction, where there are any.
fn value_of(values: &[f64], point: usize) -> Vec<Vec<f64>> {
    values.get(point).map(|value| vec![*value]).into_iter().collect()
}

/// The places of the nodes of a plane contact edge, in the order of its points.
pub(super) fn edge_places(case: &Case, mesh: &Mesh, base: &SteadySliding) -> Vec<FeedPlace> {
    let points = base.interface.nodes.iter().zip(&base.points);
    points
        .map(|(&node, point)| FeedPlace {
            contact: CONTACT.to_owned(),
            position: mesh.nodes[node as usize],
            area: point.weight * case.thickness,
            shares: vec![(node, 1.0)],
        })
        .collect()
}

/// What a base state without stress and the inertia of rotation leave out.
pub(super) fn notes(body: &AssemblyBody) -> Vec<String> {
    let closed = (body.base == BaseChoice::Closed).then(|| {
        "the base state is closed and free of stress: no pressure, no geometric stiffness, no \
        dashpot of friction across the \
         sliding"
            .to_owned()
    });
    let rotors: Vec<&str> = body.rotors().collect();
    let turning = (!rotors.is_empty()).then(|| {
        let terms = match body.turns_with_its_frame() {
            true => "Coriolis and centrifugal terms, in the frame that turns with it",
            false => "Coriolis, transport and centrifugal terms, in the frame at rest",
        };
        format!("{} with {terms}", rotors.join(", "))
    });
    closed.into_iter().chain(turning).collect()
}
