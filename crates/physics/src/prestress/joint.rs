//! What ties surfaces of bodies, and what slides on them.

use crate::contact::{
    ContactStiffness, Counterpart, NormalLaw, PairFriction, SlidingContact, Topography,
};
use crate::mesh::Mesh;
use std::sync::Arc;

/// Two boundaries of a mesh by their indices.
#[derive(Clone, Debug, PartialEq)]
pub struct TiedSurfaces {
    /// What the case calls the tie.
    pub name: String,
    /// The surface whose nodes follow: the finer one.
    pub surface: usize,
    /// The surface that they follow.
    pub counter: usize,
}

/// What the base state of a contact is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BaseChoice {
    /// Gap, pressure and opening from the loads.
    #[default]
    Solved,
    /// All facing points touch, free of stress.
    Closed,
}

/// A boundary of a mesh, by its index, that slides on another one or on a counterface.
#[derive(Clone, Debug, PartialEq)]
pub struct SlidingSurfaces {
    /// What the case calls the contact.
    pub name: String,
    /// The surface that has the contact points: the finer, softer one.
    pub surface: usize,
    /// What it meets.
    pub counter: Counterpart,
    /// Friction beside the coefficient of a sweep.
    pub friction: PairFriction,
    /// Penalty or rigid, and dashpots.
    pub stiffness: ContactStiffness,
    /// Gaps beside those of the mesh, of a measured or worn surface.
    pub topography: Option<Arc<Topography>>,
}

impl SlidingSurfaces {
    /// Name of the contact that a case describes as `[contact]`.
    pub const SHORT_FORM: &'static str = "contact";

    /// The contact edge of a plane body.
    pub fn of_edge(mesh: &Mesh, contact: &SlidingContact, stiffness: ContactStiffness) -> Self {
        Self {
            name: Self::SHORT_FORM.to_owned(),
            surface: mesh.contact,
            counter: Counterpart::Edge(*contact),
            friction: PairFriction { ratio: 1.0, decay: contact.decay },
            stiffness,
            topography: None,
        }
    }

    /// Whether it is the contact edge of a plane body.
    pub fn is_edge(&self) -> bool {
        matches!(self.counter, Counterpart::Edge(_))
    }

    /// Whether its points are nodes whose separations are unknowns: rigid contact needs it, and an edge has no other points.
    pub(super) fn has_own_dofs(&self) -> bool {
        self.is_edge() || self.stiffness.normal_stiffness.is_none()
    }

    /// The springs that carry the base state; `None` is rigid contact. That of an edge is rigid whatever constant stiffness small
    /// motions have.
    pub(super) fn base_law(&self) -> Option<NormalLaw> {
        let linear = self.stiffness.normal_stiffness.filter(|_| !self.is_edge());
        self.stiffness.law.or(linear.map(NormalLaw::linear))
    }

    /// Its section in the case.
    pub(super) fn section(&self) -> String {
        match self.is_short_form() {
            true => self.name.clone(),
            false => format!("contacts.{}", self.name),
        }
    }

    /// Whether the case describes it as `[contact]`.
    pub fn is_short_form(&self) -> bool {
        self.name == Self::SHORT_FORM && self.counter.surface().is_none()
    }
}
