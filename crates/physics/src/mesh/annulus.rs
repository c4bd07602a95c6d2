//! The structured annulus mesh.

use super::Mesh;
use super::sectors::{AnnulusSheet, build};
use super::specification::{AnnulusSpecification, MeshError, validate};

/// A structured annulus mesh with its sectors.
///
/// Nodes are numbered radially fastest: corner node `(i, j)` of a Quad4 mesh, `i = 0..=N_r`,
/// `j = 0..N_theta`, has index `j (N_r + 1) + i`. A Quad8 sector holds `2 N_r + 1` nodes on its
/// corner ray (corner and mid-side nodes alternate), then the `N_r + 1` mid-side nodes on its
/// middle ray. Of a shaft all nodes of a sector come before those of the annulus, numbered alike; the two bodies share
/// no node, nodes of the contact lie in pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnulusMesh {
    /// The generated mesh.
    pub mesh: Mesh,
    /// What it was generated from.
    pub specification: AnnulusSpecification,
}

impl AnnulusMesh {
    /// Generates the mesh.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn generate(specification: &AnnulusSpecification) -> Result<Self, MeshError> {
        let spec = *specification;
        validate(&spec)?;
        let mesh = build(&spec, &AnnulusSheet::of(&spec), spec.circumferential_elements);
        Ok(Self { mesh, specification: spec })
    }

    /// Nodes of one sector (one element wide in the circumferential direction).
    pub fn sector_node_count(&self) -> usize {
        self.specification.nodes_per_sector() as usize
    }

    /// Number of sectors, `N_theta`.
    pub fn sector_count(&self) -> usize {
        self.specification.circumferential_elements
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::sectors::graded_radii;
    use crate::mesh::{BoundaryCondition, ElementKind};
    use std::f64::consts::TAU;

    fn paper(element: ElementKind) -> AnnulusSpecification {
        AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 180,
            radial_elements: 35,
            radial_grading: 1.0,
            element,
            outer: BoundaryCondition::Clamped,
            shaft: None,
        }
    }

    #[test]
    fn node_1621_lies_at_ninety_degrees_and_1641_on_its_ray() {
        let mesh = AnnulusMesh::generate(&paper(ElementKind::Quad4)).unwrap();
        let [x, y, _] = mesh.mesh.nodes[1620];
        assert!(x.abs() < 1e-15 && (y - 0.0205).abs() < 1e-15);
        let [x, y, _] = mesh.mesh.nodes[1640];
        assert!(x.abs() < 1e-15 && (y - 0.0605).abs() < 1e-15);
        assert_eq!(mesh.mesh.element_count(), 6300);
    }

    #[test]
    fn tributary_lengths_sum_to_the_circumference_with_the_mesh() {
        for (element, tolerance) in [(ElementKind::Quad4, 1e-3), (ElementKind::Quad8, 1e-8)] {
            let mesh = AnnulusMesh::generate(&paper(element)).unwrap().mesh;
            let sum: f64 = mesh.contact_edge().tributary_lengths.iter().sum();
            let exact = TAU * 0.0205;
            assert!((sum / exact - 1.0).abs() < tolerance, "{sum} {exact}");
        }
    }

    #[test]
    fn graded_elements_grow_by_the_given_ratio() {
        let spec = AnnulusSpecification { radial_grading: 1.1, ..paper(ElementKind::Quad4) };
        let radii = graded_radii(&spec);
        for triple in radii.windows(3) {
            let ratio = (triple[2] - triple[1]) / (triple[1] - triple[0]);
            assert!((ratio - 1.1).abs() < 1e-10);
        }
    }

    #[test]
    fn impossible_specifications_name_their_key() {
        let message =
            |spec: &AnnulusSpecification| AnnulusMesh::generate(spec).unwrap_err().to_string();
        let mut spec = paper(ElementKind::Quad4);
        spec.outer_radius = 0.01;
        assert!(message(&spec).contains("outer_radius"));
        let mut spec = paper(ElementKind::Quad4);
        spec.radial_elements = 0;
        assert!(message(&spec).contains("radial_elements"));
    }
}
