//! What ties surfaces of solid bodies, and what slides on them.

use crate::contact::{ContactStiffness, Counterpart, PairFriction, Topography};
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

/// A boundary of a mesh, by its index, that slides on another one or on a rigid counterface.
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

    /// Whether the case describes it as `[contact]`.
    pub fn is_short_form(&self) -> bool {
        self.name == Self::SHORT_FORM && self.counter.rigid().is_some()
    }
}
