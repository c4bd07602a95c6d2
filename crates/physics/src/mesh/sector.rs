//! One sector of the annulus mesh.

use super::BoundaryCondition;
use super::revolution::Strip;
use super::sectors::{AnnulusSheet, build};
use super::specification::{AnnulusSpecification, MeshError, validate};

/// One sector of an annulus mesh, without the others.
///
/// Its nodes are numbered outwards ("sector nodes"): on a Quad8 mesh the nodes at one radius are the
/// corner-ray node, then the middle-ray node where there is one. The last ones are clamped where the
/// outer edge is. A shaft comes before the annulus, but for a clamped bore, which comes after everything.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorMesh {
    /// Its elements and nodes.
    pub strip: Strip,
    /// What the full mesh would be generated from.
    pub specification: AnnulusSpecification,
    /// Position of each sector node among the nodes of a sector of the full mesh.
    pub numbering: Vec<usize>,
    /// First sector node of the annulus; it and those that follow it lie on the contact edge.
    contact_start: usize,
}

impl SectorMesh {
    /// Generates sector 0 of the annulus that `specification` describes.
    ///
    /// Node coordinates equal those of [`super::AnnulusMesh`] to the last bit.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn generate(specification: &AnnulusSpecification) -> Result<Self, MeshError> {
        validate(specification)?;
        let sheet = AnnulusSheet::of(specification);
        let mesh = build(specification, &sheet, 1);
        let outwards = |&node: &usize| {
            let own = &sheet.nodes[node];
            (node >= sheet.first, own.place[0], own.half_step)
        };
        let mut numbering: Vec<usize> = (0..sheet.nodes.len()).collect();
        numbering.sort_by_key(outwards);
        let is_clamped = |condition| condition == BoundaryCondition::Clamped;
        let per_edge = mesh.contact_edge().nodes.len();
        let edges = [specification.shaft.map(|shaft| shaft.bore), Some(specification.outer)];
        let [bore, outer] = edges.map(|own| if own.is_some_and(is_clamped) { per_edge } else { 0 });
        numbering.rotate_left(bore);
        let free = sheet.nodes.len() - bore - outer;
        let count = specification.circumferential_elements;
        Ok(Self {
            contact_start: sheet.first - bore,
            strip: Strip::new(mesh, (&sheet.nodes, &numbering), count, |dof| dof >= 2 * free),
            specification: *specification,
            numbering,
        })
    }

    /// Sector nodes of the annulus on its contact edge.
    pub fn contact_nodes(&self) -> std::ops::Range<usize> {
        self.contact_start..self.contact_start + self.tributary_lengths().len()
    }

    /// The shaft's node at the place of a contact node; `None` on a rigid cylinder.
    pub fn opposite(&self, contact_node: usize) -> Option<usize> {
        self.specification.shaft.map(|_| contact_node - self.tributary_lengths().len())
    }

    /// Tributary length of each contact node of the sector, m.
    pub fn tributary_lengths(&self) -> &[f64] {
        &self.strip.mesh.contact_edge().tributary_lengths
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{AnnulusMesh, ElementKind};

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
            let sector = SectorMesh::generate(&specification).unwrap();
            let strip = &sector.strip.mesh;
            assert_eq!(strip.nodes, full.nodes[..strip.node_count()]);
            let entries = strip.elements.len();
            assert_eq!(entries, 5 * element.node_count());
            assert_eq!(strip.elements, full.elements[..entries]);
            let radius = |node: usize| full.nodes[node][0].hypot(full.nodes[node][1]);
            for pair in sector.numbering.windows(2) {
                assert!(radius(pair[0]) < radius(pair[1]) + 1e-12);
            }
        }
    }
}
