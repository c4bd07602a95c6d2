//! One sector of the annulus mesh.

use super::sectors::{Ray, build, rays};
use super::specification::{AnnulusSpecification, MeshError, validate};
use super::{BoundaryCondition, Mesh};

/// One sector of an annulus mesh, without the others.
///
/// Its nodes are numbered outwards ("sector nodes"): on a Quad8 mesh the nodes at one radius are the
/// corner-ray node, then the middle-ray node where there is one. The last ones are clamped where the
/// outer edge is. A shaft comes before the annulus, but for a clamped bore, which comes after everything.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorMesh {
    /// The elements of sector 0; nodes of sectors 0 and 1 numbered as in the full mesh.
    pub strip: Mesh,
    /// What the full mesh would be generated from.
    pub specification: AnnulusSpecification,
    /// Sector node of each strip node: nodes one sector apart share it.
    pub sector_node_of: Vec<usize>,
    /// Angle of each strip node in halves of a sector, 0 to 3.
    pub half_steps: Vec<usize>,
    /// Position of each sector node among the nodes of a sector of the full mesh.
    pub numbering: Vec<usize>,
    /// First sector node of the annulus; it and those that follow it lie on the contact edge.
    pub contact_start: usize,
    /// Sector nodes on the contact edge. One for Quad4, two for Quad8.
    pub contact_count: usize,
    /// Sector nodes that are clamped; they come last.
    pub clamped_count: usize,
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
        let strip = build(specification, 1);
        let contact_count = strip.contact_edge().nodes.len();
        let rays = rays(specification);
        let mut numbering: Vec<usize> = rays.iter().flat_map(outward_numbering).collect();
        let is_clamped = |condition| condition == BoundaryCondition::Clamped;
        let is_bore_clamped = specification.shaft.is_some_and(|s| is_clamped(s.bore));
        if is_bore_clamped {
            numbering.rotate_left(contact_count);
        }
        let clamped_edges =
            usize::from(is_bore_clamped) + usize::from(is_clamped(specification.outer));
        let per_sector = numbering.len();
        let mut position = vec![0; per_sector];
        for (sector_node, &node) in numbering.iter().enumerate() {
            position[node] = sector_node;
        }
        let is_middle = |node: usize| {
            let on_middle = |ray: &Ray| (ray.middle()..ray.nodes().end).contains(&node);
            usize::from(rays.iter().any(on_middle))
        };
        let first = rays.last().map_or(0, |annulus| annulus.start);
        Ok(Self {
            sector_node_of: (0..2 * per_sector).map(|node| position[node % per_sector]).collect(),
            half_steps: (0..2 * per_sector)
                .map(|node| 2 * (node / per_sector) + is_middle(node % per_sector))
                .collect(),
            contact_start: position[first],
            contact_count,
            clamped_count: clamped_edges * contact_count,
            strip,
            specification: *specification,
            numbering,
        })
    }

    /// Sector nodes of the annulus on its contact edge.
    pub fn contact_nodes(&self) -> std::ops::Range<usize> {
        self.contact_start..self.contact_start + self.contact_count
    }

    /// The shaft's node at the place of a contact node; `None` on a rigid cylinder.
    pub fn opposite(&self, contact_node: usize) -> Option<usize> {
        self.specification.shaft.map(|_| contact_node - self.contact_count)
    }

    /// Nodes of one sector, clamped ones included.
    pub fn node_count(&self) -> usize {
        self.numbering.len()
    }

    /// Nodes of one sector that are not clamped.
    pub fn free_node_count(&self) -> usize {
        self.node_count() - self.clamped_count
    }

    /// Number of sectors of the annulus, `N_theta`.
    pub fn sector_count(&self) -> usize {
        self.specification.circumferential_elements
    }

    /// Tributary length of each contact node of the sector, m.
    pub fn tributary_lengths(&self) -> &[f64] {
        &self.strip.contact_edge().tributary_lengths
    }

    /// Angle of a sector node from its sector's corner ray, in halves of a sector: 0 or 1.
    pub fn half_step(&self, sector_node: usize) -> usize {
        self.half_steps[self.numbering[sector_node]]
    }
}

/// Nodes of one body of a sector in order of rising radius.
fn outward_numbering(ray: &Ray) -> Vec<usize> {
    let middle = ray.middle();
    if middle == ray.nodes().end {
        return ray.nodes().collect();
    }
    (ray.start..middle)
        .enumerate()
        .flat_map(|(i, corner)| {
            std::iter::once(corner).chain((i % 2 == 0).then_some(middle + i / 2))
        })
        .collect()
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
            let nodes = sector.strip.node_count();
            assert_eq!(sector.strip.nodes, full.nodes[..nodes]);
            let entries = sector.strip.elements.len();
            assert_eq!(entries, 5 * element.node_count());
            assert_eq!(sector.strip.elements, full.elements[..entries]);
            let radius = |node: usize| full.nodes[node][0].hypot(full.nodes[node][1]);
            for pair in sector.numbering.windows(2) {
                assert!(radius(pair[0]) < radius(pair[1]) + 1e-12);
            }
        }
    }
}
