//! Geometric stiffness of bricks.

use super::element::geometry;
use crate::fem::ElasticMaterial;
use crate::fem::fold::SectorMatrix;
use crate::mesh::SolidSector;
use nalgebra::{DMatrix, DVector};

/// Geometric stiffness `∫ (grad N_I . sigma . grad N_J) I dV` of the stress that `displacement`, the same in every sector,
/// causes, N/m, the amplitudes of the incompatible modes that come with it included.
pub fn geometric_stiffness(
    sector: &SolidSector,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> SectorMatrix {
    let recovered = recoveries(sector, material);
    let of = |(e, nodes): (usize, &Vec<(usize, usize)>)| {
        let values = nodes.iter().flat_map(|(node, _)| &displacement[3 * node..3 * node + 3]);
        let values = DVector::from_iterator(3 * nodes.len(), values.copied());
        let recovered = recovered[e % recovered.len()].as_ref();
        let internal = recovered.map(|recovered| recovered * &values);
        geometry(sector, e).geometric_stiffness(material, values.as_slice(), internal.as_ref())
    };
    let elements = sector.elements.iter().enumerate();
    SectorMatrix::sum(3, elements.map(|(e, nodes)| (nodes, of((e, nodes)))))
}

/// What gives the amplitudes of the incompatible modes, of each element along a radius: layers are alike.
fn recoveries(sector: &SolidSector, material: &ElasticMaterial) -> Vec<Option<DMatrix<f64>>> {
    let [radial, _] = sector.divisions();
    (0..radial).map(|e| geometry(sector, e).recovered(material)).collect()
}
