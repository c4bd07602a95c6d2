//! A body that is solved on its whole mesh, and its base states.

use super::contact::places;
use crate::*;
use frictionsim_physics::contact::{ContactStiffness, Point, Turning};
use frictionsim_physics::mesh::CyclicSymmetry;
use frictionsim_physics::prestress::{Joined, PressedRange, PressedState};
use frictionsim_results::cea::ContactPlace;

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
    /// Its bodies with what slides.
    pub joined: Arc<Joined>,
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
        let mesh = case.body.mesh()?;
        let assembly = case.assembled(&mesh, options.mass)?;
        let own = [case.contact.sliding.friction_coefficient];
        let start = start_of(assembly.contacts());
        let range = assembly.range(&[frictions, start, &own].concat(), &Default::default())?;
        // The eigenvalue analysis uses no symmetry where the whole mesh is asked for.
        let is_whole = |cea: &Cea| cea.method == CeaMethod::Sparse;
        let symmetry = mesh.symmetry.filter(|_| !case.cea.as_ref().is_some_and(is_whole));
        let joined = assembly.joined;
        Ok(Self { symmetry, mesh, range, options, joined })
    }

    /// Base states at some friction coefficients, which come first, of which some are known.
    pub(super) fn states_at(
        &self,
        case: &Case,
        (known, frictions): (&PressedRange, &[f64]),
    ) -> Result<PressedRange, CeaError> {
        let (assembly, own) = (self.assembly(case), [case.contact.sliding.friction_coefficient]);
        let further = match self.mesh.dimension {
            2 => &own[..],
            _ => start_of(assembly.contacts()),
        };
        Ok(assembly.range(&[frictions, further].concat(), known)?)
    }

    /// The model of a case with the base states of this one: for a case that differs in nothing that these depend on.
    pub(super) fn with_its_states(&self, case: &Case, options: TangentOptions) -> Option<Self> {
        // A centrifugal load depends on the density.
        if case.body.assembly().is_some_and(|body| body.rotors().next().is_some()) {
            return None;
        }
        // Its boundaries have supports.
        let mesh = case.body.mesh().ok()?;
        let joined = case.assembled(&mesh, options.mass).ok()?.joined;
        Some(Self { mesh, range: self.range.clone(), symmetry: self.symmetry, options, joined })
    }

    /// The state at the case's own friction coefficient.
    pub fn state(&self) -> &PressedState {
        let place = self.range.state_of.last();
        &self.range.states[*place.expect("the case's own friction coefficient comes last")]
    }

    /// The bodies with what ties them and what slides.
    pub fn assembly<'a>(&'a self, case: &'a Case) -> Assembly<'a> {
        Assembly::of(&self.mesh, case.materials(), Arc::clone(&self.joined))
    }

    /// The tangent of one of the states.
    pub fn tangent(&self, case: &Case, state: &PressedState) -> Result<SlidingTangent, CeaError> {
        Ok(self.assembly(case).tangent(state, &self.options)?)
    }

    /// The tangent at the case's own friction coefficient.
    pub fn own_tangent(&self, case: &Case) -> Result<SlidingTangent, CeaError> {
        self.tangent(case, self.state())
    }

    /// The contact points in the order of the base states, as they turn in that at the case's own friction coefficient.
    pub(crate) fn contact_points(&self, case: &Case) -> Vec<BasePoint<'_>> {
        let assembly = self.assembly(case);
        let is_stressed =
            self.options.geometric_stiffness && assembly.stressing(self.state()).is_some();
        let turnings = if is_stressed { assembly.turnings().concat() } else { Vec::new() };
        // Each contact has its own stiffness.
        let contacts = self.joined.contacts.iter();
        let stiffness = contacts.flat_map(|(contact, surface)| {
            std::iter::repeat_n(contact.stiffness, surface.points.len())
        });
        let points = places(case, &self.mesh, &self.joined.contacts).into_iter();
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

/// Where the base states of solid bodies begin: contact that stiffens depends on friction; analyses start without.
fn start_of(contacts: &[(SlidingSurfaces, ContactSurface)]) -> &'static [f64] {
    let mut solid = contacts.iter().filter(|(contact, _)| !contact.is_edge());
    let stiffens = solid.any(|(contact, _)| contact.stiffness.law.is_some());
    if stiffens { &[0.0] } else { &[] }
}

/// What a base state without stress and the inertia of rotation leave out.
pub(super) fn notes(body: &AssemblyBody) -> Vec<String> {
    let closed = (body.base == BaseChoice::Closed).then(|| {
        "the base state is closed and free of stress: no pressure, no geometric stiffness, no dashpot of friction \
        across the sliding"
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
