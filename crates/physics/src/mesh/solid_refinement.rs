//! Uniform refinement of solid bodies: every element into eight alike, pyramids into six of them and four tetrahedra.

use super::error::BodyError;
use super::faces::FaceKey;
use super::splitting::{Part, Splitting};
use super::{Boundary, BoundaryFace, Mesh, NodalFrames};
use std::collections::{BTreeMap, BTreeSet};

impl Mesh {
    /// The same solid bodies with every element split into eight alike, a pyramid into ten parts; nodes keep their numbers, new ones follow them.
    ///
    /// New nodes lie where the element's own shape functions put them: quadratic edges stay the parabolas that they are, and
    /// what the mesh leaves out of a curved surface it goes on to leave out. Regions, boundaries and their conditions stay;
    /// a set of nodes that is no surface takes the new nodes between its own.
    ///
    /// # Errors
    /// [`BodyError::Body`] for a mesh that would have too many nodes, or parts of curved elements that are inverted.
    pub fn refined_solids(&self) -> Result<Self, BodyError> {
        let mut splitting = Splitting::of(&self.nodes, 3)?;
        let faces = self.boundaries.iter().flat_map(|b| &b.faces);
        // Faces of named boundaries, and what they are split into.
        let mut children: BTreeMap<FaceKey, Vec<BoundaryFace>> =
            faces.map(|face| (face.key(), Vec::new())).collect();
        let mut fine = Self {
            element_starts: vec![0],
            elements: Vec::new(),
            element_kinds: Vec::new(),
            element_regions: Vec::new(),
            congruent_to: Vec::new(),
            boundaries: Vec::new(),
            ..self.clone()
        };
        for element in 0..self.element_count() {
            let (kind, own) = (self.element_kind(element), self.element_nodes(element));
            let named = (0..kind.faces().len()).map(|face| self.element_face(element, face).key());
            let named: Vec<FaceKey> = named.filter(|key| children.contains_key(key)).collect();
            for part in splitting.split(kind, own, |_, _| None) {
                let number = fine.element_kinds.len() as u32;
                for key in &named {
                    children.entry(*key).or_default().extend(faces_of(&part, number, key));
                }
                let nodes = part.nodes.iter().map(|(node, _)| *node);
                fine.push_element(part.kind, nodes, (self.region(element), number));
            }
        }
        fine.labels = splitting.labels(&self.labels);
        let Splitting { places, points, .. } = splitting;
        fine.nodes = points;
        fine.frames = NodalFrames::global(3, fine.node_count());
        fine.check_elements(|element| element + 1)?;
        let split = |boundary: &Boundary| {
            let faces = boundary.faces.iter();
            let faces = faces.flat_map(|face| children.get(&face.key()).into_iter().flatten());
            let own: BTreeSet<u32> = boundary.nodes.iter().copied().collect();
            let between = places
                .iter()
                .filter(|(place, _)| place.iter().all(|(corner, _)| own.contains(corner)));
            let mut surface = Boundary::of_faces(&boundary.name, faces.cloned().collect());
            if !boundary.is_covered() {
                let all: BTreeSet<u32> =
                    own.iter().copied().chain(between.map(|own| *own.1)).collect();
                surface.nodes = all.into_iter().collect();
            }
            Boundary { condition: boundary.condition, ..surface }
        };
        fine.boundaries = self.boundaries.iter().map(split).collect();
        fine.turn_frames_to_guides();
        Ok(fine)
    }
}

/// The faces of a part, the element `number` of the finer mesh, that lie on the face `key` of what it is a part of.
fn faces_of(part: &Part, number: u32, key: &FaceKey) -> Vec<BoundaryFace> {
    let faces = part.kind.faces().iter().filter(|(face, locals)| {
        let mut corners = locals[..face.corner_count()].iter().map(|&k| &part.nodes[k].1);
        corners.all(|place| place.iter().all(|(corner, _)| key.contains(corner)))
    });
    let face = |&(kind, locals): &(_, &[usize])| BoundaryFace {
        kind,
        element: number,
        nodes: locals.iter().map(|&k| part.nodes[k].0).collect(),
    };
    faces.map(face).collect()
}
