//! A body that is solved on its whole mesh, and its base states.

use super::contact::SteadyState;
use frictionsim_case::{AssemblyBody, Body, Case, Cea, CeaMethod};
use frictionsim_physics::cea::CeaError;
use frictionsim_physics::contact::{ContactStiffness, ContactSurface, Point, Turning};
use frictionsim_physics::fem::assemble_stiffness;
use frictionsim_physics::mesh::{CyclicSymmetry, Mesh};
use frictionsim_physics::prestress::{
    Assembly, BaseChoice, PressedRange, PressedState, SlidingSurfaces, SlidingTangent,
    SteadySliding, TangentOptions,
};
use frictionsim_results::cea::ContactPlace;
use std::borrow::Cow;
use std::sync::Arc;

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
    pub sliding: SteadyState,
}

/// A contact point of a whole mesh.
pub(crate) struct BasePoint<'a> {
    pub place: ContactPlace,
    pub point: &'a Point,
    /// How it turns; nothing where no stress acts on small motions.
    pub turning: Option<Turning>,
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
                (range, SteadyState::Assembly(assembly.joined))
            }
            _ => {
                let stiffness = assemble_stiffness(&mesh, case.materials());
                let (law, all) = (options.contact.law, [frictions, &own].concat());
                let range = SteadySliding::range(&mesh, &stiffness, contact, law, &all)?;
                let own = range.states[place_of_own(&range)].clone();
                let base = SteadySliding::of(&mesh, contact, own);
                (range, SteadyState::Plane(Box::new(base)))
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
            SteadyState::Assembly(_) => {
                // A centrifugal load depends on the density.
                let body = case.body.assembly().filter(|body| body.rotors().next().is_none())?;
                SteadyState::Assembly(body.assembled().ok()?.joined)
            }
            edge => edge.clone(),
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
            (SteadyState::Assembly(joined), Body::Assembly(body)) => {
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
        let SteadyState::Plane(base) = &self.sliding else {
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

    /// The contact points in the order of the base states, as they turn in that at the case's own friction coefficient.
    pub(crate) fn contact_points(&self, case: &Case) -> Vec<BasePoint<'_>> {
        let is_stressed =
            self.options.geometric_stiffness && self.stressing(case, self.state()).is_some();
        let assembly = self.assembly(case);
        let turnings = match &self.sliding {
            _ if !is_stressed => Vec::new(),
            SteadyState::Plane(base) => base.interface.turnings(),
            _ => assembly.iter().flat_map(Assembly::turnings).flatten().collect(),
        };
        // Each contact of solid bodies has its own stiffness, a plane edge that of the case.
        let contacts = assembly.iter().flat_map(Assembly::contacts);
        let stiffness = contacts.flat_map(|(contact, surface)| {
            std::iter::repeat_n(contact.stiffness, surface.points.len())
        });
        let stiffness = stiffness.chain(std::iter::repeat(self.options.contact));
        let points = self.sliding.points(case, &self.mesh).into_iter();
        let points = points.zip(stiffness).enumerate();
        let point = |(i, ((place, point), stiffness))| BasePoint {
            place,
            point,
            turning: turnings.get(i).cloned(),
            stiffness,
        };
        points.map(point).collect()
    }
}

/// Which state is that at the case's own friction coefficient.
fn place_of_own(range: &PressedRange) -> usize {
    *range.state_of.last().expect("the case's own friction coefficient comes last")
}

/// Where the base states begin: contact that stiffens depends on friction, and the analysis starts without.
fn start_of(contacts: &[(SlidingSurfaces, ContactSurface)]) -> &'static [f64] {
    let stiffens = contacts.iter().any(|(contact, _)| contact.stiffness.law.is_some());
    if stiffens { &[0.0] } else { &[] }
}

/// The symmetry of a mesh that the eigenvalue analysis of a case uses: none where the whole mesh is asked for.
fn used_symmetry(case: &Case, mesh: &Mesh) -> Option<CyclicSymmetry> {
    let is_whole = |cea: &Cea| cea.method == CeaMethod::Sparse;
    mesh.symmetry.filter(|_| !case.cea.as_ref().is_some_and(is_whole))
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
