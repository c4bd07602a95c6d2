//! A deformable shaft in the disc: eigenvalues and transient against theory, a rigid shaft and each other.

mod eigenvalues;
mod statics;
mod transient;

pub use crate::friction_law::block::STEEL;
use crate::prelude::*;

/// Materials of an annulus, region 0, and of its deformable shaft, region 1.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnulusMaterials {
    /// Of the annulus.
    pub annulus: ElasticMaterial,
    /// Of the shaft, where it is deformable.
    pub shaft: Option<RegionMaterial>,
}

impl From<ElasticMaterial> for AnnulusMaterials {
    fn from(annulus: ElasticMaterial) -> Self {
        Self { annulus, shaft: None }
    }
}

impl MaterialField for AnnulusMaterials {
    fn of(&self, region: usize) -> &ElasticMaterial {
        let shaft = self.shaft.as_ref().filter(|_| region == 1);
        shaft.map_or(&self.annulus, |shaft| &shaft.elastic)
    }

    fn own_damping(&self, region: usize) -> Option<RayleighDamping> {
        self.shaft.as_ref().filter(|_| region == 1)?.damping
    }
}

/// The disc with a bore of 6 mm in its shaft.
pub fn with_shaft(element: ElementKind, around: usize, radial: [usize; 2]) -> AnnulusSpecification {
    on_shaft(annulus(element, around, radial[1]), radial[0])
}

pub fn on(shaft: ElasticMaterial) -> AnnulusMaterials {
    AnnulusMaterials { annulus: POLYCARBONATE, shaft: Some(shaft.into()) }
}

pub fn stiffer(factor: f64) -> AnnulusMaterials {
    on(ElasticMaterial { young_modulus: factor * POLYCARBONATE.young_modulus, ..POLYCARBONATE })
}

pub fn rigid_contact(geometric_stiffness: bool) -> TangentOptions {
    TangentOptions { geometric_stiffness, ..TANGENT }
}

/// Disc and shaft at 610 rpm.
pub fn model(
    specification: AnnulusSpecification,
    material: AnnulusMaterials,
    options: TangentOptions,
) -> AnnulusModel<AnnulusMaterials> {
    WaveModel { specification, material, options, contact: contact(610.0) }
}
