//! Harmonics of a body of revolution in three dimensions, in the state that is excited.

use super::harmonic::{Damping, Harmonic, held_harmonic};
use crate::fem::sector::MirrorParity;
use crate::fem::solid::{self, SolidMatrix, half_bandwidth};
use crate::fem::{DofMap, ElasticMaterial, MassKind, RayleighDamping};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::{BoundaryCondition, SolidSector};
use crate::prestress::{SolidTangent, sector_unknowns, supports};

/// What the matrices of a harmonic are made of.
#[derive(Clone, Debug)]
pub(super) enum SolidState {
    Body(Box<SolidBody>),
    Sliding { tangent: Box<SolidTangent>, friction_coefficient: f64 },
}

#[derive(Clone, Debug)]
pub(super) struct SolidBody {
    sector: SolidSector,
    mass: SolidMatrix,
    stiffness: SolidMatrix,
    supports: [SolidMatrix; 2],
    damping: RayleighDamping,
    unknown_of: Vec<Option<usize>>,
}

impl SolidState {
    /// A body without contact and prestress.
    pub(super) fn body(
        sector: &SolidSector,
        material: &ElasticMaterial,
        mass: MassKind,
        damping: RayleighDamping,
        is_clamped: bool,
    ) -> Self {
        let mut sector = sector.clone();
        if !is_clamped {
            sector.specification.conditions = [BoundaryCondition::Free; 4];
        }
        Self::Body(Box::new(SolidBody {
            mass: solid::mass(&sector, material, mass),
            stiffness: solid::stiffness(&sector, material),
            supports: supports(&sector),
            damping,
            unknown_of: sector_unknowns(&sector),
            sector,
        }))
    }

    pub(super) fn sector(&self) -> &SolidSector {
        match self {
            Self::Body(body) => &body.sector,
            Self::Sliding { tangent, .. } => tangent.sector(),
        }
    }

    /// Unknown of each dof of the sector that can move.
    pub(super) fn unknown_of(&self) -> Vec<Option<usize>> {
        let tangent = match self {
            Self::Body(body) => return body.unknown_of.clone(),
            Self::Sliding { tangent, .. } => tangent,
        };
        let (unknowns, rigid) = (tangent.unknown_of(), tangent.rigid());
        let is_still = |dof: &usize| {
            unknowns[*dof].is_none_or(|u| rigid.iter().any(|(normal, ..)| *normal == u))
        };
        let still = (0..unknowns.len()).filter(is_still);
        DofMap::excluding(unknowns.len(), still).unknown_of
    }

    /// Off-diagonals of every harmonic on either side.
    pub(super) fn half_bandwidth(&self) -> usize {
        half_bandwidth(self.sector())
    }

    pub(super) fn harmonic(&self, n: usize, is_standing: bool) -> Harmonic {
        match self {
            Self::Sliding { tangent, friction_coefficient } => {
                sliding_harmonic(tangent, *friction_coefficient, (n, is_standing))
            }
            Self::Body(body) => body.harmonic(n, is_standing),
        }
    }
}

impl SolidBody {
    fn harmonic(&self, n: usize, is_standing: bool) -> Harmonic {
        let count = self.unknown_of.iter().flatten().count();
        let band = |matrix: &SolidMatrix| {
            let mut sum = BandedMatrix::zeros(count, half_bandwidth(&self.sector));
            let at = (self.sector.sector_count(), n);
            matrix.add_harmonic(&mut sum, &self.unknown_of, at, (MirrorParity::Even, 1.0));
            sum
        };
        let is_supported = self.supports.iter().any(|matrix| !matrix.is_empty());
        let supports = is_supported.then(|| self.supports.each_ref().map(&band));
        let matrices = [band(&self.mass), band(&self.stiffness)];
        held_harmonic(matrices, supports, self.damping, is_standing)
    }
}

/// Small motions around steady sliding.
fn sliding_harmonic(
    tangent: &SolidTangent,
    friction_coefficient: f64,
    (n, is_standing): (usize, bool),
) -> Harmonic {
    let matrices = tangent.harmonic(n).at(friction_coefficient);
    Harmonic {
        half_bandwidth: matrices.half_bandwidth,
        mass: matrices.mass,
        stiffness: matrices.stiffness,
        damping: Damping::Band(matrices.damping),
        is_standing,
    }
}
