//! The terms of one sector that the tangent of its waves is made of.

use super::TangentOptions;
use super::tangent::geometric_stiffness;
use super::terms::{Kind, Part, Term, Terms};
use crate::contact::{ContactStiffness, Point, PressedState, Turning, linearized, turned};
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::{MaterialField, Triplets};
use crate::mesh::Strip;

/// Matrices of a sector; of odd parity is what comes with each unit of friction.
pub(super) type WaveTerms = Terms<SectorMatrix>;

impl Term<SectorMatrix> {
    /// What a mirror does to it.
    pub(super) fn parity(&self) -> MirrorParity {
        if self.power == 0 { MirrorParity::Even } else { MirrorParity::Odd }
    }
}

impl WaveTerms {
    /// Regions without stress, and supports of a sector unless all of it is free.
    pub(super) fn of_strip(
        strip: &Strip,
        material: &dyn MaterialField,
        options: &TangentOptions,
        is_free: bool,
    ) -> Self {
        let terms = Terms::of_mesh((&strip.mesh, material), is_free, options);
        let mut own = terms.map(|_, matrix| strip.folded(&matrix));
        own.add_contact(options.contact.loss_factor);
        own
    }

    /// Stiffness of regions and supports over all dofs that motions which are the same in every sector see.
    pub(super) fn alike(&self) -> Triplets {
        let own = self.all.iter().filter(|own| own.kind == Kind::Stiffness);
        let bodies = own.filter(|own| matches!(own.part, Part::Body(_))).map(|own| &own.matrix);
        SectorMatrix::alike_in_all(&bodies.collect::<Vec<_>>())
    }

    /// Takes up the stress of a base state of the sector.
    pub(super) fn take_stress(
        &mut self,
        strip: &Strip,
        material: &dyn MaterialField,
        state: &PressedState,
    ) {
        let displacements = state.displacements.iter().map(|own| strip.spread(own)).collect();
        let state = PressedState { displacements, ..PressedState::default() };
        for region in 0..self.regions().len() {
            let stress = geometric_stiffness((&strip.mesh, material), &state, region);
            let stress = stress.iter().map(|own| strip.folded(own));
            self.add(Part::Body(region), Kind::Prestress, stress);
        }
    }

    /// Adds what the forces of points do that turn with small motions, [`turned`].
    pub(super) fn add_turning(
        &mut self,
        strip: &Strip,
        (points, turnings, state): (&[Point], &[Turning], &PressedState),
    ) {
        let own = turned(points, turnings, (state, 0));
        let own = own.iter().map(|own| strip.at_places(own));
        self.add(Part::Contact(0), Kind::Prestress, own);
    }

    /// Adds contact at points around a state that does not depend on friction. The dashpots of friction, which come with the first
    /// power of it, are of even parity and stand by themselves.
    pub(super) fn add_points(
        &mut self,
        strip: &Strip,
        (points, state): (&[Point], &PressedState),
        stiffness: &ContactStiffness,
    ) {
        let unloaded = PressedState { normal_forces: Vec::new(), ..state.clone() };
        let law = linearized(points, (&unloaded, 0), stiffness);
        let forces = PressedState { stiffnesses: Vec::new(), ..state.clone() };
        let friction = linearized(points, (&forces, 0), &ContactStiffness::default()).dashpots;
        let mut add = |kind, own: &[Triplets]| {
            self.add(Part::Contact(0), kind, own.iter().map(|own| strip.at_places(own)));
        };
        add(Kind::Stiffness, &law.stiffness);
        add(Kind::Dashpots, &law.dashpots);
        add(Kind::FrictionDashpots, friction.get(1..).unwrap_or_default());
    }

    /// [`super::WaveTangent::less`] of every matrix; `None` where factors differ.
    pub(super) fn less(&self, other: &Self) -> Option<Self> {
        if !self.laws().eq(other.laws()) {
            return None;
        }
        let mut own = self.clone();
        for term in &other.all {
            let name = |own: &Term<_>| (own.part, own.kind, own.power);
            match own.all.iter_mut().find(|own| name(own) == name(term)) {
                Some(own) if own.matrix == term.matrix => own.matrix = SectorMatrix::default(),
                Some(own) => own.matrix = own.matrix.plus(&term.matrix.scaled(-1.0)),
                None => own.all.push(term.with(term.matrix.scaled(-1.0))),
            }
        }
        own.all.retain(|term| !term.matrix.is_empty());
        Some(own)
    }
}
