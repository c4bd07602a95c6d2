//! The matrices of one sector that the tangent of its waves is made of.

use super::{LossGain, TabledGain};
use crate::fem::fold::SectorMatrix;
use crate::fem::sector::{self, SectorSupport, Sectored};
use crate::fem::{MassKind, MaterialField, RayleighDamping};
use crate::linalg::c64;
use std::sync::Arc;

/// What the matrices are made of.
#[derive(Clone, Debug, Default)]
pub(super) struct WaveTerms {
    pub regions: Vec<RegionTerms>,
    pub supports: Vec<SectorSupport>,
    /// Contact forces that turn with their nodes, without friction and for each unit of it.
    pub turning: [SectorMatrix; 2],
    /// Damping of regions beyond that of the whole body.
    pub extra_damping: SectorMatrix,
    /// Over the distances across the contact where that joins two bodies.
    pub contact: ContactTerms,
}

/// Matrices of the contact.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactTerms {
    /// Penalty stiffness at rest and its friction; empty for rigid contact.
    pub penalty: [SectorMatrix; 2],
    /// Contact dashpots at rest and their friction.
    pub dashpots: [SectorMatrix; 2],
    /// `p_0 / V` across the sliding, and `p_0 mu'(V) / mu` along it where friction falls with the speed.
    pub friction_dashpots: SectorMatrix,
}

/// Matrices of one region.
#[derive(Clone, Debug)]
pub(super) struct RegionTerms {
    pub mass: SectorMatrix,
    pub elastic: SectorMatrix,
    /// Stress of the pressed state and, for each unit of friction, of the sheared state; empty where it does not act back.
    pub stress: [SectorMatrix; 2],
    /// Rayleigh coefficients of its own, else those of the whole body.
    pub damping: Option<RayleighDamping>,
    /// Structural damping `eta`.
    pub loss_factor: f64,
    /// Modulus over frequency; the elastic stiffness has that of the lowest.
    pub table: Option<TabledGain>,
}

impl RegionTerms {
    /// What its stiffness is multiplied by at an eigenvalue of the wave `+n`.
    pub fn ratio(&self, root: c64) -> c64 {
        let gain = LossGain(self.table.clone());
        match &self.table {
            Some(table) => table.reference() + gain.at(root),
            None => 1.0 + self.loss_factor * gain.at(root),
        }
    }
}

impl WaveTerms {
    /// Regions without stress and supports of a sector.
    pub fn of<S: Sectored>(
        sector: &S,
        material: &dyn MaterialField,
        (kind, damping): (MassKind, RayleighDamping),
    ) -> Self {
        let region = |region: usize| RegionTerms {
            mass: sector::mass_of(sector, material, kind, Some(region)),
            elastic: sector::stiffness_of(sector, material, Some(region)),
            stress: Default::default(),
            damping: material.own_damping(region),
            loss_factor: material.of(region).loss_factor,
            table: material.table(region).map(|table| TabledGain {
                table: Arc::clone(table),
                reference_hz: table.range_hz()[0],
            }),
        };
        Self {
            regions: (0..sector::region_count(sector)).map(region).collect(),
            supports: sector.supports(kind),
            extra_damping: sector::extra_damping(sector, material, kind, damping),
            ..Self::default()
        }
    }

    /// Elastic stiffness of all regions.
    pub fn elastic(&self) -> SectorMatrix {
        let (first, others) = self.regions.split_first().expect("a body has a region");
        others.iter().fold(first.elastic.clone(), |sum, own| sum.plus(&own.elastic))
    }

    /// Takes up the stress of the displacements without friction and for each unit of it.
    pub fn take_stress<S: Sectored>(
        &mut self,
        sector: &S,
        material: &dyn MaterialField,
        states: [&[f64]; 2],
    ) {
        for (region, own) in self.regions.iter_mut().enumerate() {
            own.stress = states.map(|u| sector::geometric_stiffness(sector, material, region, u));
        }
    }

    /// [`super::WaveTangent::less`] of every matrix.
    pub fn less(&self, other: &Self) -> Option<Self> {
        let factors = |own: &Self| {
            let regions = own.regions.iter();
            let regions = regions.map(|own| (own.damping, own.loss_factor, own.table.clone()));
            let supports = own.supports.iter().map(|own| own.loss_factor);
            (regions.collect::<Vec<_>>(), supports.collect::<Vec<_>>())
        };
        let (mut own, mut other) = (self.clone(), other.clone());
        let is_alike = factors(&own) == factors(&other);
        for (own, other) in own.matrices().into_iter().zip(other.matrices()) {
            *own = match *own == *other {
                true => SectorMatrix::default(),
                false => own.plus(&other.scaled(-1.0)),
            };
        }
        is_alike.then_some(own)
    }

    fn matrices(&mut self) -> Vec<&mut SectorMatrix> {
        let regions = self.regions.iter_mut().flat_map(|own| {
            let [pressed, sheared] = &mut own.stress;
            [&mut own.mass, &mut own.elastic, pressed, sheared]
        });
        let supports = self.supports.iter_mut().flat_map(|own| &mut own.terms);
        let ContactTerms { penalty, dashpots, friction_dashpots } = &mut self.contact;
        let contact = penalty.iter_mut().chain(dashpots).chain([friction_dashpots]);
        let others = self.turning.iter_mut().chain([&mut self.extra_damping]);
        regions.chain(supports).chain(contact).chain(others).collect()
    }
}
