//! The flat faces by which a body radiates sound.

use crate::transient::SteppedMesh;
use crate::*;
use frictionsim_physics::{cycle::periodic::FlatFace, mesh::SolidFace};

/// Difference of the areas of two surfaces that cover each other wholly.
const SAME: f64 = 0.01;

/// The flat faces of a body in three dimensions that are in air; none of a plane body, whose faces do not move along
/// their normals and whose thin edges send no beam.
pub fn faces_in_air(case: &Case, stepped: &SteppedMesh<'_>) -> Vec<FlatFace> {
    match (&stepped.sector, case.body.assembly()) {
        (Some(sector), _) => [SolidFace::Top, SolidFace::Bottom]
            .into_iter()
            .filter_map(|face| flat_face(sector, face))
            .collect(),
        (None, Some(body)) => {
            let contacts = body.contacts.iter();
            let contacts = contacts.filter_map(|own| Some([own.surface, own.counter.surface()?]));
            let ties = body.ties.iter().map(|own| [own.surface, own.counter]);
            let mut covered = covered(&stepped.mesh, contacts.chain(ties));
            let on_rigid = body.contacts.iter().filter(|own| own.counter.rigid().is_some());
            covered.extend(on_rigid.flat_map(|own| {
                stepped.mesh.boundaries[own.surface].faces.iter().map(|face| sorted(&face.nodes))
            }));
            let mut faces = stepped.mesh.outer_faces();
            faces.retain(|face| !covered.contains(&sorted(&face.nodes)));
            FlatFace::of(&stepped.mesh, &faces)
        }
        (None, None) => Vec::new(),
    }
}

/// The elements of surfaces that lie on others: of each pair the smaller one, or both where they are alike.
fn covered(mesh: &Mesh, pairs: impl Iterator<Item = [usize; 2]>) -> BTreeSet<Vec<u32>> {
    let mut covered = BTreeSet::new();
    for pair in pairs {
        let areas = pair.map(|boundary| mesh.face_area(&mesh.boundaries[boundary].faces));
        for (own, boundary) in pair.into_iter().enumerate() {
            if areas[own] <= (1.0 + SAME) * areas[1 - own] {
                let faces = mesh.boundaries[boundary].faces.iter();
                covered.extend(faces.map(|face| sorted(&face.nodes)));
            }
        }
    }
    covered
}

fn sorted(nodes: &[u32]) -> Vec<u32> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

/// The flat face of a body of revolution, without what the ring covers; none where it is held.
fn flat_face(sector: &SolidSector, face: SolidFace) -> Option<FlatFace> {
    let has_ring = sector.specification.contact.face() == face;
    let ring = || sector.rings.iter().flat_map(|ring| &ring.nodes);
    let is_free = |&k: &usize| {
        sector.is_on(k, face)
            && !sector.is_held(3 * k + 2)
            && !(has_ring && ring().any(|&own| own == k))
    };
    let nodes: Vec<usize> = (0..sector.node_count()).filter(is_free).collect();
    let radii = &sector.radii;
    let sectors = sector.sector_count();
    // Of the annulus between the circles half way to the neighbours.
    let area = |radius: f64| {
        let at = radii.iter().position(|&own| own == radius).unwrap_or(0);
        let half = |other: Option<&f64>| 0.5 * (radius + other.copied().unwrap_or(radius));
        let inner = half(at.checked_sub(1).and_then(|before| radii.get(before)));
        let outer = half(radii.get(at + 1));
        0.5 * (outer * outer - inner * inner) * TAU / sectors as f64
    };
    let mut flat = FlatFace::default();
    for s in 0..sectors {
        for &k in &nodes {
            let node = &sector.nodes[k];
            let (sine, cosine) = sector.angle(k, s).sin_cos();
            flat.places.push([node.radius * cosine, node.radius * sine, node.height]);
            flat.areas.push(area(node.radius));
            let dof = 3 * (s * sector.node_count() + k) + 2;
            flat.normals.push(vec![(dof, 1.0)]);
        }
    }
    (!nodes.is_empty()).then_some(flat)
}
