//! Uniform refinement of solid bodies: every element into eight alike, pyramids into six of them and four tetrahedra.

use super::error::BodyError;
use super::faces::{FaceKey, face_key};
use super::{Boundary, BoundaryFace, ElementKind, Mesh, NodalFrames};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// Most nodes of a mesh: indices are 32 bits wide, with room for three unknowns at each.
const MOST_NODES: usize = (u32::MAX / 3) as usize;
/// Steps into which the share of a corner in a place is counted: parts have corners at halves of an element's edges and
/// mid-side nodes at quarters, so that a brick has shares of 1 / 64.
const STEPS: f64 = 64.0;

/// A place of the mesh: corners with their linear shares in it, which all elements around it agree on.
type Place = Vec<(u32, u8)>;

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
        if self.node_count().saturating_mul(8) > MOST_NODES {
            return Err(BodyError::Body(format!(
                "a refinement of {} nodes has more than {MOST_NODES}: refine less",
                self.node_count()
            )));
        }
        let mut refinement = Refinement::new(self);
        for element in 0..self.element_count() {
            refinement.split(element);
        }
        let Refinement { mut fine, places, children, .. } = refinement;
        fine.congruent_to = (0..fine.element_count() as u32).collect();
        fine.frames = NodalFrames::global(3, fine.node_count());
        fine.check_elements(|element| element + 1)?;
        let split = |boundary: &Boundary| {
            let faces = boundary.faces.iter().flat_map(|face| {
                let corners = &face.nodes[..face.kind.corner_count()];
                children.get(&face_key(corners)).into_iter().flatten()
            });
            let own: BTreeSet<u32> = boundary.nodes.iter().copied().collect();
            let between = places
                .iter()
                .filter(|(place, _)| place.iter().all(|(corner, _)| own.contains(corner)));
            let between: BTreeSet<u32> = match boundary.is_covered() {
                true => BTreeSet::new(),
                false => own.iter().copied().chain(between.map(|own| *own.1)).collect(),
            };
            let surface = fine.surface(&boundary.name, faces.cloned().collect());
            Boundary { condition: boundary.condition, ..surface.with_nodes(&between) }
        };
        fine.boundaries = self.boundaries.iter().map(split).collect();
        fine.turn_frames_to_guides();
        Ok(fine)
    }
}

struct Refinement<'a> {
    coarse: &'a Mesh,
    fine: Mesh,
    /// Nodes of the finer mesh by their places.
    places: BTreeMap<Place, u32>,
    /// Faces of named boundaries, and what they are split into.
    children: BTreeMap<FaceKey, Vec<BoundaryFace>>,
    /// Corners of the parts of each kind in the parent element.
    parts: BTreeMap<ElementKind, Vec<Vec<[f64; 3]>>>,
    next_label: usize,
}

impl<'a> Refinement<'a> {
    fn new(coarse: &'a Mesh) -> Self {
        let faces = coarse.boundaries.iter().flat_map(|b| &b.faces);
        let key = |face: &BoundaryFace| face_key(&face.nodes[..face.kind.corner_count()]);
        let kinds: BTreeSet<ElementKind> = coarse.element_kinds.iter().copied().collect();
        Self {
            places: BTreeMap::new(),
            children: faces.map(|face| (key(face), Vec::new())).collect(),
            parts: kinds.into_iter().map(|kind| (kind, parts_of(kind))).collect(),
            next_label: 1 + coarse.labels.iter().copied().max().unwrap_or(0),
            fine: Mesh {
                element_starts: vec![0],
                elements: Vec::new(),
                element_kinds: Vec::new(),
                element_regions: Vec::new(),
                boundaries: Vec::new(),
                ..coarse.clone()
            },
            coarse,
        }
    }

    /// The parts of an element, and of its faces that belong to a boundary.
    fn split(&mut self, element: usize) {
        let (kind, own) = (self.coarse.element_kind(element), self.coarse.element_nodes(element));
        let corners = kind.corner_count();
        // Its own nodes are nodes of its parts: corners, and middles of edges as corners between them.
        for &corner in &own[..corners] {
            self.places.insert(vec![(corner, STEPS as u8)], corner);
        }
        for (middle, ends) in own[corners..].iter().zip(kind.edges()) {
            let mut place: Place = ends.map(|end| (own[end], STEPS as u8 / 2)).into();
            place.sort_unstable();
            self.places.insert(place, *middle);
        }
        let named: Vec<FaceKey> = kind
            .faces()
            .iter()
            .map(|(face, locals)| {
                let corners = locals[..face.corner_count()].iter().map(|&k| own[k]);
                face_key(&corners.collect::<Vec<u32>>())
            })
            .filter(|key| self.children.contains_key(key))
            .collect();
        let parts = self.parts[&kind].clone();
        for part in parts {
            let child = kind.with_corners(part.len(), kind.is_quadratic());
            let mut at = part.clone();
            if kind.is_quadratic() {
                let middle = |&[p, q]: &[usize; 2]| {
                    [0, 1, 2].map(|axis| 0.5 * (part[p][axis] + part[q][axis]))
                };
                at.extend(child.edges().iter().map(middle));
            }
            let nodes: Vec<(u32, Place)> =
                at.into_iter().map(|at| self.node(kind, own, at)).collect();
            let number = self.fine.element_kinds.len() as u32;
            for key in &named {
                self.split_face(key, child, number, &nodes);
            }
            self.fine.elements.extend(nodes.iter().map(|(node, _)| node));
            self.fine.element_starts.push(self.fine.elements.len() as u32);
            self.fine.element_kinds.push(child);
            let region = self.coarse.element_regions[element];
            self.fine.element_regions.push(region);
        }
    }

    /// The node at a place of an element, a new one where no element has had it.
    fn node(&mut self, kind: ElementKind, own: &[u32], at: [f64; 3]) -> (u32, Place) {
        let linear = kind.with_corners(kind.corner_count(), false);
        let shares = linear.shape_functions(at);
        let mut place: Place = own
            .iter()
            .zip(shares)
            .map(|(&corner, (share, _))| (corner, (STEPS * share).round() as u8))
            .filter(|(_, steps)| *steps > 0)
            .collect();
        place.sort_unstable();
        if let Some(&node) = self.places.get(&place) {
            return (node, place);
        }
        let mut point = [0.0; 3];
        for (&node, (share, _)) in own.iter().zip(kind.shape_functions(at)) {
            let position = self.coarse.nodes[node as usize];
            (0..3).for_each(|axis| point[axis] += share * position[axis]);
        }
        let node = self.fine.nodes.len() as u32;
        self.fine.nodes.push(point);
        self.fine.labels.push(self.next_label);
        self.next_label += 1;
        self.places.insert(place.clone(), node);
        (node, place)
    }

    /// Adds the faces of a part that lie on the face `key` of its element.
    fn split_face(&mut self, key: &FaceKey, kind: ElementKind, part: u32, nodes: &[(u32, Place)]) {
        for &(face, locals) in kind.faces() {
            let mut corners = locals[..face.corner_count()].iter().map(|&k| &nodes[k].1);
            if corners.all(|place| place.iter().all(|(corner, _)| key.contains(corner))) {
                let child = BoundaryFace {
                    kind: face,
                    element: part,
                    nodes: locals.iter().map(|&k| nodes[k].0).collect(),
                };
                self.children.entry(*key).or_default().push(child);
            }
        }
    }
}

/// Corners of the parts of a parent element.
///
/// A brick and a wedge are halved along each edge; a tetrahedron has one part at each corner, and the octahedron between them
/// is cut along one diagonal (Bey 1995), which keeps the parts of all further splits to three shapes. A pyramid has one at
/// each corner, one that hangs from the apex of these to the middle of the base, and tetrahedra between.
fn parts_of(kind: ElementKind) -> Vec<Vec<[f64; 3]>> {
    let corners = &kind.node_places()[..kind.corner_count()];
    let between =
        |p: usize, q: usize| [0, 1, 2].map(|axis| 0.5 * (corners[p][axis] + corners[q][axis]));
    let at_corner = |corner: usize| -> Vec<[f64; 3]> {
        (0..corners.len()).map(|other| between(corner, other)).collect()
    };
    let mut parts: Vec<Vec<[f64; 3]>> = (0..corners.len()).map(at_corner).collect();
    match kind.with_corners(corners.len(), false) {
        ElementKind::Tet4 => {
            let [a, b, c] = [between(0, 1), between(0, 2), between(0, 3)];
            let [d, e, f] = [between(1, 2), between(1, 3), between(2, 3)];
            let inner = [[a, b, c, e], [a, b, d, e], [b, c, e, f], [b, d, e, f]];
            parts.extend(inner.map(upright));
        }
        ElementKind::Wedge6 => {
            // The triangle amid those at the corners, in both layers.
            for layer in [0, 3] {
                let ring = [(0, 1), (1, 2), (2, 0)];
                let flat = |level: usize| {
                    ring.map(|(p, q)| {
                        let middle = between(p, q);
                        let height = 0.5 * (corners[level][2] + corners[layer][2]);
                        [middle[0], middle[1], height]
                    })
                };
                parts.push([flat(0), flat(3)].concat());
            }
        }
        ElementKind::Pyramid5 => {
            let foot = [0.0; 3];
            let rising = |corner: usize| between(corner, 4);
            parts.push(vec![rising(0), rising(3), rising(2), rising(1), foot]);
            for (p, q) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
                parts.push(upright([between(p, q), foot, rising(p), rising(q)]));
            }
        }
        _ => {}
    }
    parts
}

/// Corners of a tetrahedron in an order of positive volume.
fn upright(mut corners: [[f64; 3]; 4]) -> Vec<[f64; 3]> {
    let edge = |k: usize| Vector3::from(corners[k]) - Vector3::from(corners[0]);
    if edge(1).cross(&edge(2)).dot(&edge(3)) < 0.0 {
        corners.swap(0, 1);
    }
    corners.into()
}
