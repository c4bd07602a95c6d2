//! The whole mesh of a body of revolution.

use super::SolidSector;
use crate::mesh::{Boundary, CyclicSymmetry, FileMesh, Mesh, SolidContact, SolidFace};
use std::collections::BTreeMap;

impl SolidSector {
    /// All sectors, see [`Self::part`].
    pub fn whole(&self) -> Mesh {
        self.part(self.sector_count())
    }

    /// The whole body as a mesh file would have it, made of equal sectors: surfaces `inner`, `outer`, `top` and `bottom`, and that
    /// under a ring on the top ([`Self::contact_surface`]).
    pub fn file(&self) -> FileMesh {
        let mut mesh = self.whole();
        let faces = |of: &Boundary| -> Vec<_> {
            of.faces.iter().map(|face| (face.kind, face.nodes.clone())).collect()
        };
        let boundaries = std::mem::take(&mut mesh.boundaries);
        let mut surfaces: BTreeMap<String, Vec<_>> =
            boundaries.iter().map(|own| (own.name.clone(), faces(own))).collect();
        if self.specification.contact != SolidContact::Inner {
            let touches = |&node: &u32| {
                let own = &self.nodes[node as usize % self.node_count()];
                self.specification.touches(own.radius)
            };
            let mut ring = faces(&boundaries[SolidFace::Top as usize]);
            ring.retain(|(_, nodes)| nodes.iter().all(touches));
            surfaces.insert(self.contact_surface().to_owned(), ring);
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
}
