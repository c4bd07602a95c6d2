//! The terms of one sector that the tangent of its waves is made of.

use super::TangentOptions;
use super::terms::{Kind, Part, PartLaw, Term, Terms};
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::sector::{self, SectorSupport, Sectored};
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
            let mass = sector::mass_of(sector, material, options.mass, Some(region));
            let elastic = sector::stiffness_of(sector, material, Some(region));
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
