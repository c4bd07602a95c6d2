//! Geometric stiffness of bricks.

use super::SolidMatrix;
use super::element::geometry;
use crate::fem::ElasticMaterial;
use crate::mesh::SolidSector;
use nalgebra::{DMatrix, DVector};

/// Geometric stiffness `∫ (grad N_I . sigma . grad N_J) I dV` of the stress that `displacement`, the same in every sector,
/// causes, N/m, the amplitudes of the incompatible modes that come with it included.
pub fn geometric_stiffness(
    sector: &SolidSector,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> SolidMatrix {
    let recovered = recoveries(sector, material);
    let mut matrix = SolidMatrix::default();
    for (e, nodes) in sector.elements.iter().enumerate() {
        let values =
            nodes.iter().flat_map(|(node, _)| [0, 1, 2].map(|c| displacement[3 * node + c]));
        let values = DVector::from_vec(values.collect());
        let recovered = recovered[e % recovered.len()].as_ref();
        let internal = recovered.map(|recovered| recovered * &values);
        let own = geometry(sector, e);
        matrix.matrices.push(own.geometric_stiffness(
            material,
            values.as_slice(),
            internal.as_ref(),
        ));
        matrix.places.push((e, nodes.clone()));
    }
    matrix
}

/// What gives the amplitudes of the incompatible modes, of each element along a radius: layers are alike.
fn recoveries(sector: &SolidSector, material: &ElasticMaterial) -> Vec<Option<DMatrix<f64>>> {
    let [radial, _] = sector.divisions();
    let own = |e: usize| match sector.is_quadratic() {
        true => None,
        false => geometry(sector, e).stiffness(material).recovered,
    };
    (0..radial).map(own).collect()
}
