//! The whole mesh of a body of revolution.

use super::SolidSector;
use crate::mesh::{CyclicSymmetry, FileMesh, Mesh, SolidContact, SolidFace};

impl SolidSector {
    /// All sectors, see [`Self::part`].
    pub fn whole(&self) -> Mesh {
        self.part(self.sector_count())
    }

    /// The whole body as a mesh file would have it, made of equal sectors: surfaces `inner`, `outer`, `top` and `bottom`, and that
    /// under a ring on the top ([`Self::contact_surface`]).
    pub fn file(&self) -> FileMesh {
        let mut file = self.whole().to_file();
        if self.specification.contact != SolidContact::Inner {
            let touches = |&node: &u32| {
                let own = &self.nodes[node as usize % self.node_count()];
                self.specification.touches(own.radius)
            };
            let mut ring = file.surfaces[SolidFace::Top.name()].clone();
            ring.retain(|(_, nodes)| nodes.iter().all(touches));
            file.surfaces.insert(self.contact_surface().to_owned(), ring);
        }
        file.symmetry = Some(CyclicSymmetry {
            count: self.sector_count(),
            point: [0.0; 3],
            direction: [0.0, 0.0, 1.0],
        });
        file
    }

    /// Name of the surface of the contact.
    pub fn contact_surface(&self) -> &'static str {
        match self.specification.contact {
            SolidContact::Inner => SolidFace::Inner.name(),
            SolidContact::Ring { .. } => "ring",
        }
    }
}
