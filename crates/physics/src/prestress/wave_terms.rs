//! The terms of one sector that the tangent of its waves is made of.

use super::TangentOptions;
use super::terms::{Kind, Part, PartLaw, Term, Terms};
use crate::contact::{ContactStiffness, Point, PressedState, Turning, linearized, turned};
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::sector::{self, SectorSupport, Sectored, at_places};
use crate::fem::{MaterialField, Triplets};

/// Matrices of a sector; of odd parity is what comes with each unit of friction.
pub(super) type WaveTerms = Terms<SectorMatrix>;

impl Term<SectorMatrix> {
    /// What a mirror does to it.
    pub(super) fn parity(&self) -> MirrorParity {
        if self.power == 0 { MirrorParity::Even } else { MirrorParity::Odd }
    }
}

impl WaveTerms {
    /// Regions without stress, and supports of a sector.
    pub(super) fn of_sector<S: Sectored>(
        sector: &S,
        material: &dyn MaterialField,
        options: &TangentOptions,
        supports: Vec<SectorSupport>,
    ) -> Self {
        let mut own = Self::new(options);
        for region in 0..sector.strip().regions.len().max(1) {
            let mass = sector::mass(sector, material, options.mass, Some(region));
            let elastic = sector::stiffness(sector, material, Some(region));
            own.add_region(PartLaw::of(material, region, options.damping), [mass, elastic]);
        }
        for SectorSupport { name, terms, loss_factor } in supports {
            own.add_support(name, terms, loss_factor);
        }
        own.add_contact(options.contact.loss_factor);
        own
    }

    /// Stiffness of regions and supports over all dofs that motions which are the same in every sector see.
    pub(super) fn alike(&self) -> Triplets {
        let own = self.all.iter().filter(|own| own.kind == Kind::Stiffness);
        let bodies = own.filter(|own| matches!(own.part, Part::Body(_))).map(|own| &own.matrix);
        SectorMatrix::alike_in_all(&bodies.collect::<Vec<_>>())
    }

    /// Takes up the stress of the displacements without friction and for each unit of it.
    pub(super) fn take_stress<S: Sectored>(
        &mut self,
        sector: &S,
        material: &dyn MaterialField,
        states: [&[f64]; 2],
    ) {
        for region in 0..self.regions().len() {
            let stress = states.map(|u| sector::geometric_stiffness(sector, material, region, u));
            self.add(Part::Body(region), Kind::Prestress, stress);
        }
    }

    /// Adds what the forces of points do that turn with small motions, [`turned`].
    pub(super) fn add_turning<S: Sectored>(
        &mut self,
        sector: &S,
        (points, turnings, state): (&[Point], &[Turning], &PressedState),
    ) {
        let own = turned(points, turnings, (state, 0));
        let own = own.iter().map(|own| at_places(sector, own));
        self.add(Part::Contact(0), Kind::Prestress, own);
    }

    /// Adds contact at points around a state that does not depend on friction. The dashpots of friction, which come with the first
    /// power of it, are of even parity and stand by themselves.
    pub(super) fn add_points<S: Sectored>(
        &mut self,
        sector: &S,
        (points, state): (&[Point], &PressedState),
        stiffness: &ContactStiffness,
    ) {
        let unloaded = PressedState { normal_forces: Vec::new(), ..state.clone() };
        let law = linearized(points, (&unloaded, 0), stiffness);
        let forces = PressedState { stiffnesses: Vec::new(), ..state.clone() };
        let friction = linearized(points, (&forces, 0), &ContactStiffness::default()).dashpots;
        let mut add = |kind, own: &[Triplets]| {
            self.add(Part::Contact(0), kind, own.iter().map(|own| at_places(sector, own)));
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
