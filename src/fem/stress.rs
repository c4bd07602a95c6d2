//! Stress recovery at the nodes.

use super::ElasticMaterial;
use super::element::{ElementGeometry, shape_functions, stress_of};
use crate::mesh::{ElementKind, Mesh2d};

/// Stress at one node in its own frame, Pa.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodalStress {
    /// Along the first frame axis (radial on the annulus).
    pub radial: f64,
    /// Along the second (circumferential on the annulus).
    pub hoop: f64,
    /// Shear `sigma_12`.
    pub shear: f64,
    /// Out of plane.
    pub axial: f64,
}

impl NodalStress {
    /// Von Mises stress, Pa.
    pub fn von_mises(&self) -> f64 {
        let (a, b, c) = (
            self.radial - self.hoop,
            self.hoop - self.axial,
            self.axial - self.radial,
        );
        (0.5 * (a * a + b * b + c * c) + 3.0 * self.shear * self.shear).sqrt()
    }

    /// Hydrostatic pressure `-tr(sigma) / 3`, Pa.
    pub fn pressure(&self) -> f64 {
        -(self.radial + self.hoop + self.axial) / 3.0
    }
}

/// Stress at each node: values at the 2 x 2 Gauss points, where they are most accurate, carried to
/// the element's nodes bilinearly, turned into the node's frame and averaged over elements.
///
/// `displacement` has `2 * node_count` values in nodal frames, m.
pub fn nodal_stress(
    mesh: &Mesh2d,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> Vec<NodalStress> {
    let mut sums = vec![([0.0; 3], 0.0); mesh.node_count()];
    for e in 0..mesh.element_count() {
        add_element_stress(mesh, e, material, displacement, &mut sums);
    }
    sums.into_iter()
        .map(|(sum, count)| {
            let [radial, hoop, shear] = sum.map(|value| value / count);
            NodalStress {
                radial,
                hoop,
                shear,
                axial: material.out_of_plane_stress(radial, hoop),
            }
        })
        .collect()
}

fn add_element_stress(
    mesh: &Mesh2d,
    e: usize,
    material: &ElasticMaterial,
    displacement: &[f64],
    sums: &mut [([f64; 3], f64)],
) {
    const GAUSS: f64 = 0.577_350_269_189_625_8;
    let geometry = ElementGeometry::new(mesh, e);
    let stresses = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
        let point = geometry.at(GAUSS * a, GAUSS * b, 1.0);
        stress_of(
            material,
            &geometry.displacement_gradient(&point, displacement),
        )
    });
    const NODES: [(f64, f64); 8] = [
        (-1.0, -1.0),
        (1.0, -1.0),
        (1.0, 1.0),
        (-1.0, 1.0),
        (0.0, -1.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (-1.0, 0.0),
    ];
    for (local, &node) in mesh.element_nodes(e).iter().enumerate() {
        let (xi, eta) = NODES[local];
        // The Gauss points span a quadrilateral of their own, smaller by the factor GAUSS.
        let weights = shape_functions(ElementKind::Quad4, xi / GAUSS, eta / GAUSS);
        let frame = geometry.frame(local);
        let stress = stresses
            .iter()
            .zip(&weights)
            .fold(nalgebra::Matrix2::zeros(), |sum, (s, w)| sum + s * w.0);
        let local_stress = frame.transpose() * stress * frame;
        let (sum, count) = &mut sums[node as usize];
        sum[0] += local_stress[(0, 0)];
        sum[1] += local_stress[(1, 1)];
        sum[2] += local_stress[(0, 1)];
        *count += 1.0;
    }
}
