//! Element matrices of one sector of bricks.

use crate::fem::element::ElementGeometry;
use crate::fem::fold::SectorMatrix;
use crate::fem::{ElasticMaterial, MassKind};
use crate::mesh::SolidSector;
use nalgebra::{DMatrix, DVector, Matrix3};

/// Geometry of one element of sector 0, the frames of its nodes `(e_r, e_theta, e_z)`.
pub(super) fn geometry(sector: &SolidSector, element: usize) -> ElementGeometry {
    let (mut points, mut frames) = (Vec::new(), Vec::new());
    for &(node, half) in &sector.elements[element] {
        let place = &sector.nodes[node];
        let (sin, cos) = (sector.half_angle() * half as f64).sin_cos();
        points.push([place.radius * cos, place.radius * sin, place.height]);
        frames.push(Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0));
    }
    ElementGeometry::of_nodes(sector.element_kind(), points, frames)
}

/// A matrix that is the same in every layer, from the elements of the first.
fn layered(sector: &SolidSector, compute: impl FnMut(usize) -> DMatrix<f64>) -> SectorMatrix {
    let [radial, _] = sector.divisions();
    let own: Vec<DMatrix<f64>> = (0..radial).map(compute).collect();
    let elements = sector.elements.iter().enumerate();
    SectorMatrix::sum(3, elements.map(|(e, nodes)| (nodes, &own[e % radial])))
}

/// Elastic stiffness `∫ B^T D B dV`, N/m: full integration for 20 nodes, incompatible modes for 8, which do not lock in bending.
pub fn stiffness(sector: &SolidSector, material: &ElasticMaterial) -> SectorMatrix {
    layered(sector, |e| geometry(sector, e).stiffness(material).stiffness)
}

/// Mass, kg: consistent `∫ rho N_I N_J dV`, or lumped by row sums (8 nodes) or the scaled diagonal (20 nodes; Hinton, Rock and
/// Zienkiewicz 1976).
pub fn mass(sector: &SolidSector, material: &ElasticMaterial, kind: MassKind) -> SectorMatrix {
    layered(sector, |e| {
        let geometry = geometry(sector, e);
        match kind {
            MassKind::Consistent => geometry.consistent_mass(material),
            MassKind::Lumped => {
                let masses = DVector::from_vec(geometry.lumped_mass(material));
                geometry.rotate_scalar(DMatrix::from_diagonal(&masses))
            }
        }
    })
}
