//! Eigenvalues of an assembly of solid bodies.

use super::Progress;
use super::states::{States, StatesSweep, used_symmetry};
use crate::case::{AssemblyBody, Case};
use crate::cea::{CeaError, SweepRequest};
use crate::fem::solid_stress;
use crate::mesh::CyclicSymmetry;
use crate::prestress::{
    Assembly, BaseChoice, Joined, PressedRange, PressedState, PrestressError, SlidingTangent,
    TangentOptions,
};
use crate::results::Extent;
use crate::results::cea::{AssemblyPoint, AssemblyReport, BaseState};
use std::sync::Arc;

/// An assembly and its base states.
pub struct AssemblyModel {
    /// The bodies, what ties them and what slides.
    pub body: AssemblyBody,
    /// Base states at the friction coefficients that are solved, and last at the case's own.
    pub range: PressedRange,
    /// How the tangent is taken.
    pub options: TangentOptions,
    /// The bodies with their surfaces paired.
    pub joined: Arc<Joined>,
    /// The symmetry that the eigenvalue analysis uses.
    pub symmetry: Option<CyclicSymmetry>,
}

impl AssemblyModel {
    /// Solves the base states at some friction coefficients and at the case's own.
    ///
    /// # Errors
    /// Surfaces that do not meet; no base state.
    pub fn solve(
        case: &Case,
        body: &AssemblyBody,
        options: TangentOptions,
        frictions: &[f64],
    ) -> Result<Self, CeaError> {
        let own = case.contact.sliding.friction_coefficient;
        let assembly = body.assembled()?;
        let range = assembly.range(&[frictions, start_of(body), &[own]].concat())?;
        Ok(Self {
            symmetry: used_symmetry(case, &body.mesh),
            body: body.clone(),
            range,
            options,
            joined: assembly.joined(),
        })
    }

    /// The bodies with what ties them and what slides.
    pub fn assembly(&self) -> Assembly<'_> {
        let (mesh, materials) = (&self.body.mesh, &self.body.materials);
        Assembly::of(mesh, materials, Arc::clone(&self.joined))
    }

    /// Whether the stress of the base state acts on small motions.
    pub fn is_stressed(&self) -> bool {
        self.options.geometric_stiffness && self.body.base == BaseChoice::Solved
    }

    /// The state at the case's own friction coefficient.
    pub(in crate::study) fn base(&self) -> &PressedState {
        let own = self.range.state_of.last();
        &self.range.states[*own.expect("the case's own friction coefficient comes last")]
    }

    /// Solves the eigenproblems at the friction coefficients that it was made for.
    pub(super) fn sweep(
        &self,
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
    ) -> Result<StatesSweep, CeaError> {
        let assembly = self.assembly();
        let states = States {
            range: &self.range,
            solve: &|frictions| Ok(assembly.range(&[frictions, start_of(&self.body)].concat())?),
            pressed: |state| &state.is_pressed,
            tangent: &|state| Ok(assembly.tangent(state, &self.options)?),
            symmetry: self.symmetry.map(|own| (own, self.body.mesh.node_count())),
        };
        states.sweep(request, progress)
    }

    /// The tangent at the case's own friction coefficient.
    ///
    /// # Errors
    /// Those of [`Assembly::tangent`].
    pub fn own_tangent(&self) -> Result<SlidingTangent, PrestressError> {
        self.assembly().tangent(self.base(), &self.options)
    }

    /// The tangent of one of the states.
    pub(super) fn tangent(&self, state: usize) -> Result<SlidingTangent, CeaError> {
        Ok(self.assembly().tangent(&self.range.states[state], &self.options)?)
    }

    /// The base state point by point at the case's own friction coefficient.
    pub fn report(&self, case: &Case) -> AssemblyReport {
        let friction = case.contact.sliding.friction_coefficient;
        let (assembly, state) = (self.assembly(), self.base());
        let forces = state.normal_forces(friction);
        let all = assembly.contacts().iter().flat_map(|(contact, surface)| {
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
        let contacts = self.body.contacts.iter();
        let displacement = state.displacement(friction);
        AssemblyReport {
            stress: solid_stress(&self.body.mesh, &self.body.materials, &displacement),
            surfaces: contacts.map(|own| (own.name.clone(), own.surface)).collect(),
            points: points.collect(),
            displacement,
        }
    }
}

/// Where the base states begin: contact that stiffens depends on friction, and the analysis starts without.
fn start_of(body: &AssemblyBody) -> &'static [f64] {
    let stiffens = body.contacts.iter().any(|contact| contact.law.is_some());
    if stiffens { &[0.0] } else { &[] }
}

/// What the report says of the base state of an assembly.
pub fn base_state(case: &Case, report: &AssemblyReport) -> BaseState {
    let range = |value: fn(&AssemblyPoint) -> f64| {
        let values = report.points.iter().map(value);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    };
    let closed = report.points.iter().filter(|point| point.is_closed).count();
    let powers = report.points.iter();
    let power: f64 = powers.map(|point| point.shear * point.area * point.speed).sum();
    let speed = case.contact.sliding.rotation_speed;
    let per_speed = if speed == 0.0 { 0.0 } else { power / speed };
    let is_straight = case.body.slides_straight();
    BaseState {
        friction_coefficient: case.contact.sliding.friction_coefficient,
        slipping: closed,
        sticking: 0,
        open: report.points.len() - closed,
        pressure_pa: range(|point| point.pressure),
        shear_pa: range(|point| point.shear),
        torque_n_m: (!is_straight).then_some(per_speed),
        drag_n: is_straight.then_some(per_speed),
        power_w: power,
        extent: Extent::WholeBody,
    }
}

/// What a base state without stress and the inertia of rotation leave out.
pub fn notes(model: &AssemblyModel) -> Vec<String> {
    let body = &model.body;
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
