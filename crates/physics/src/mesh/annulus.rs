//! The structured annulus mesh, and one sector of it.

use super::Mesh;
use super::revolution::Strip;
use super::sectors::{AnnulusSheet, build};
use super::specification::{AnnulusSpecification, MeshError, validate};

/// A structured annulus mesh with its sectors.
///
/// Nodes are numbered radially fastest: corner node `(i, j)` of a Quad4 mesh, `i = 0..=N_r`, `j = 0..N_theta`, has index `j (N_r + 1) + i`.
/// A Quad8 sector holds `2 N_r + 1` nodes on its corner ray (corner and mid-side nodes alternate), then the `N_r + 1` mid-side nodes on its
/// middle ray. Of a shaft all nodes of a sector come before those of the annulus, numbered alike; the two bodies share no node, nodes of
/// the contact lie in pairs.
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

impl Strip {
    /// Sector 0 of an annulus, without the others: its nodes are those of [`AnnulusMesh`] to the last bit.
    ///
    /// Unknowns are in the order of nodes outwards, at one radius the corner-ray node, then the middle-ray node where there is
    /// one; those of a shaft come before the annulus.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn of_annulus(specification: &AnnulusSpecification) -> Result<Self, MeshError> {
        validate(specification)?;
        let sheet = AnnulusSheet::of(specification);
        let mesh = build(specification, &sheet, 1);
        let outwards = |&node: &usize| {
            let own = &sheet.nodes[node];
            (node >= sheet.first, own.place[0], own.half_step)
        };
        let mut order: Vec<usize> = (0..sheet.nodes.len()).collect();
        order.sort_by_key(outwards);
        let held: Vec<usize> = mesh.held_dofs().collect();
        let count = specification.circumferential_elements;
        Ok(Self::new(mesh, (&sheet.nodes, order), count, |dof| held.contains(&dof)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::ElasticSupport;
    use crate::mesh::sectors::graded_radii;
    use crate::mesh::{BoundaryCondition, ElementKind, ShaftSpecification};
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

    #[test]
    fn sector_is_the_beginning_of_the_full_mesh_bit_for_bit() {
        for element in [ElementKind::Quad4, ElementKind::Quad8] {
            let specification = AnnulusSpecification {
                inner_radius: 0.0205,
                outer_radius: 0.0905,
                circumferential_elements: 24,
                radial_elements: 5,
                radial_grading: 1.1,
                element,
                outer: BoundaryCondition::Clamped,
                shaft: None,
            };
            let full = AnnulusMesh::generate(&specification).unwrap().mesh;
            let sector = Strip::of_annulus(&specification).unwrap();
            let strip = &sector.mesh;
            assert_eq!(strip.nodes, full.nodes[..strip.node_count()]);
            let entries = strip.elements.len();
            assert_eq!(entries, 5 * element.node_count());
            assert_eq!(strip.elements, full.elements[..entries]);
            let radius = |node: usize| full.nodes[node][0].hypot(full.nodes[node][1]);
            let free: Vec<usize> = sector.free_dofs().map(|dof| dof / 2).collect();
            for pair in free.windows(2) {
                assert!(radius(pair[0]) < radius(pair[1]) + 1e-12);
            }
        }
    }

    #[test]
    fn a_clamped_bore_does_not_widen_the_bands() {
        let width = |bore| {
            let specification = AnnulusSpecification {
                inner_radius: 0.0205,
                outer_radius: 0.0905,
                circumferential_elements: 24,
                radial_elements: 5,
                radial_grading: 1.0,
                element: ElementKind::Quad8,
                outer: BoundaryCondition::Clamped,
                shaft: Some(ShaftSpecification { inner_radius: 0.006, radial_elements: 4, bore }),
            };
            Strip::of_annulus(&specification).unwrap().node_bandwidth()
        };
        let held = ElasticSupport { tangential_stiffness: 1e11, ..ElasticSupport::default() };
        assert_eq!(width(BoundaryCondition::Clamped), width(BoundaryCondition::Support(held)));
    }
}
