//! The matrices of one sector that the tangent of its waves is made of, each with what it stands for.

use super::{LossGain, TabledGain, TangentOptions};
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::sector::{self, SectorSupport, Sectored};
use crate::fem::{MaterialField, RayleighDamping, Triplets};
use crate::linalg::c64;
use std::sync::Arc;

/// What a matrix belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// A region, or after these a support.
    Body(usize),
    Contact,
}

/// What a matrix does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Mass,
    /// Elasticity of a region, springs of a support, the normal law of the contact.
    Stiffness,
    /// Stress of the base state in a region; forces of the contact that turn with their nodes.
    Prestress,
    Dashpots,
    /// `p_0 / V` across the sliding, and `p_0 mu'(V) / mu` along it where friction falls with the speed.
    FrictionDashpots,
}

/// One matrix; of odd parity it is what comes with each unit of friction.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub part: Part,
    pub kind: Kind,
    pub parity: MirrorParity,
    pub matrix: SectorMatrix,
}

/// What the matrices of a part are multiplied by.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PartLaw {
    /// Rayleigh coefficients; none of a support.
    pub damping: RayleighDamping,
    /// Structural damping `eta`.
    pub loss_factor: f64,
    /// Modulus over frequency; the elastic stiffness has that of the lowest.
    pub table: Option<TabledGain>,
}

impl PartLaw {
    /// What its stiffness is multiplied by at an eigenvalue of the wave `+n`.
    pub fn ratio(&self, root: c64) -> c64 {
        let gain = LossGain(self.table.clone());
        match &self.table {
            Some(table) => table.reference() + gain.at(root),
            None => 1.0 + self.loss_factor * gain.at(root),
        }
    }
}

/// What the matrices are made of.
#[derive(Clone, Debug)]
pub(super) struct WaveTerms {
    /// One of each part, kind and parity, none of them empty.
    pub all: Vec<Term>,
    /// Regions, then supports.
    pub bodies: Vec<PartLaw>,
    /// Names of the latter.
    pub supports: Vec<String>,
    /// Its stiffness coefficient is that of all prestress.
    pub contact: PartLaw,
}

impl WaveTerms {
    /// Regions without stress, and supports of a sector.
    pub fn of<S: Sectored>(
        sector: &S,
        material: &dyn MaterialField,
        options: &TangentOptions,
        supports: Vec<SectorSupport>,
    ) -> Self {
        let damping = RayleighDamping { mass_coefficient: 0.0, ..options.damping_of_tangent() };
        let loss_factor = options.contact.loss_factor;
        let mut own = Self {
            all: Vec::new(),
            bodies: Vec::new(),
            supports: Vec::new(),
            contact: PartLaw { damping, loss_factor, table: None },
        };
        for region in 0..sector::region_count(sector) {
            let mass = sector::mass_of(sector, material, options.mass, Some(region));
            let elastic = sector::stiffness_of(sector, material, Some(region));
            own.add(Part::Body(region), Kind::Mass, [mass]);
            own.add(Part::Body(region), Kind::Stiffness, [elastic]);
            let table =
                |table| TabledGain { table: Arc::clone(table), reference_hz: table.range_hz()[0] };
            own.bodies.push(PartLaw {
                damping: material.own_damping(region).unwrap_or(options.damping),
                loss_factor: material.of(region).loss_factor,
                table: material.table(region).map(table),
            });
        }
        for SectorSupport { name, terms: [springs, dashpots], loss_factor } in supports {
            let part = Part::Body(own.bodies.len());
            own.add(part, Kind::Stiffness, [springs]);
            own.add(part, Kind::Dashpots, [dashpots]);
            own.bodies.push(PartLaw { loss_factor, ..PartLaw::default() });
            own.supports.push(name);
        }
        own
    }

    /// Stiffness of regions and supports over all dofs that motions which are the same in every sector see.
    pub fn alike(&self) -> Triplets {
        let own = self.all.iter().filter(|own| own.kind == Kind::Stiffness);
        let bodies = own.filter(|own| own.part != Part::Contact).map(|own| &own.matrix);
        SectorMatrix::alike_in_all(&bodies.collect::<Vec<_>>())
    }

    /// Adds what acts without friction, and what does for each unit of it.
    pub fn add<const N: usize>(&mut self, part: Part, kind: Kind, matrices: [SectorMatrix; N]) {
        let parities = [MirrorParity::Even, MirrorParity::Odd].into_iter().zip(matrices);
        let terms = parities.map(|(parity, matrix)| Term { part, kind, parity, matrix });
        self.all.extend(terms.filter(|term| !term.matrix.is_empty()));
    }

    /// The factors of regions.
    pub fn regions(&self) -> &[PartLaw] {
        &self.bodies[..self.bodies.len() - self.supports.len()]
    }

    /// The factors of a part.
    pub fn law(&self, part: Part) -> &PartLaw {
        match part {
            Part::Body(body) => &self.bodies[body],
            Part::Contact => &self.contact,
        }
    }

    /// The factors of a term in `K`, tables at their reference, in `C` and in the structural damping.
    pub fn factors(&self, term: &Term) -> [f64; 3] {
        let PartLaw { damping, loss_factor, table } = self.law(term.part);
        let reference = table.as_ref().map_or(1.0, TabledGain::reference);
        match term.kind {
            Kind::Mass => [0.0, damping.mass_coefficient, 0.0],
            Kind::Stiffness => [reference, damping.stiffness_coefficient, *loss_factor],
            Kind::Prestress => [1.0, self.contact.damping.stiffness_coefficient, 0.0],
            Kind::Dashpots => [0.0, 1.0, 0.0],
            Kind::FrictionDashpots => [0.0; 3],
        }
    }

    /// Takes up the stress of the displacements without friction and for each unit of it.
    pub fn take_stress<S: Sectored>(
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
    pub fn less(&self, other: &Self) -> Option<Self> {
        if (&self.bodies, &self.contact) != (&other.bodies, &other.contact) {
            return None;
        }
        let mut own = self.clone();
        for term in &other.all {
            let name = |own: &Term| (own.part, own.kind, own.parity);
            match own.all.iter_mut().find(|own| name(own) == name(term)) {
                Some(own) if own.matrix == term.matrix => own.matrix = SectorMatrix::default(),
                Some(own) => own.matrix = own.matrix.plus(&term.matrix.scaled(-1.0)),
                None => own.all.push(Term { matrix: term.matrix.scaled(-1.0), ..*term }),
            }
        }
        own.all.retain(|term| !term.matrix.is_empty());
        Some(own)
    }
}
