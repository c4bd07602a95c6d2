//! The whole mesh of a body of revolution.

use super::SolidSector;
use crate::mesh::{BoundaryFace, CyclicSymmetry, FileMesh, SolidContact, SolidFace};
use std::collections::BTreeMap;

impl SolidSector {
    /// The whole body as a mesh file would have it, made of equal sectors: surfaces `inner`, `outer`, `top` and `bottom`, and that
    /// under a ring on the top ([`Self::contact_surface`]).
    pub fn file(&self) -> FileMesh {
        let mesh = self.part(self.sector_count());
        let mut surfaces: BTreeMap<String, Vec<_>> = BTreeMap::new();
        let faces = mesh.outer_faces();
        for face in &faces {
            for name in self.surfaces_of(face) {
                surfaces.entry(name.to_owned()).or_default().push((face.kind, face.nodes.clone()));
            }
        }
        FileMesh {
            surfaces,
            symmetry: Some(CyclicSymmetry {
                count: self.sector_count(),
                point: [0.0; 3],
                direction: [0.0, 0.0, 1.0],
            }),
            ..mesh.to_file()
        }
    }

    /// Name of the surface of the contact.
    pub fn contact_surface(&self) -> &'static str {
        match self.specification.contact {
            SolidContact::Inner => SolidFace::Inner.name(),
            SolidContact::Ring { .. } => "ring",
        }
    }

    /// The surfaces that a face on the outside belongs to.
    fn surfaces_of(&self, face: &BoundaryFace) -> impl Iterator<Item = &'static str> {
        let nodes: Vec<usize> =
            face.nodes.iter().map(|&node| node as usize % self.node_count()).collect();
        let lies_on = |own: SolidFace| nodes.iter().all(|&node| self.is_on(node, own));
        let under_ring = self.specification.contact != SolidContact::Inner
            && lies_on(SolidFace::Top)
            && nodes.iter().all(|&node| self.specification.touches(self.nodes[node].radius));
        let own = SolidFace::ALL.into_iter().filter(|own| lies_on(*own));
        let names: Vec<&'static str> = own.map(SolidFace::name).collect();
        names.into_iter().chain(under_ring.then(|| self.contact_surface()))
    }
}
