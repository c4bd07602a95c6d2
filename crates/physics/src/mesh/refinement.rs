//! Uniform refinement of a mesh file: every plane element into four, every solid one into eight, pyramids into six of them and four
//! tetrahedra.

use super::error::BodyError;
use super::rim::Rim;
use super::splitting::{Place, STEPS, Splitting, between};
use super::{ElementKind, Mesh};
use frictionsim_formats::{CurveEdge, FileElement, FileMesh};
use std::collections::BTreeSet;

/// The same body with every element split into parts alike; nodes keep their numbers, new ones count on from the largest.
///
/// Where an edge of a plane body, or between two of its regions, follows a smooth curve, the new nodes lie on the circle through its
/// neighbours: arcs stay arcs to round-off. Elsewhere they lie where the element's own shape functions put them: parabolas stay what
/// they are, and what a solid mesh leaves out of a curved surface it goes on to leave out. Named surfaces stay, and a set of nodes
/// takes the new ones between its own.
///
/// # Errors
/// [`BodyError::Body`] for a mesh that would have too many nodes.
pub fn refined_file(file: &FileMesh) -> Result<FileMesh, BodyError> {
    let mut splitting = Splitting::of(&file.points, file.dimension)?;
    let mut fine = FileMesh { elements: Vec::new(), symmetry: None, ..file.clone() };
    let rim = (file.dimension == 2).then(|| Rim::of(file));
    for element in &file.elements {
        let (kind, own) = (element.kind, &element.nodes);
        let curved = |splitting: &Splitting, place: &Place| {
            let rim = rim.as_ref()?;
            match place[..] {
                [(p, half), (q, other)] if half == other => rim.middle(&file.points, p, q),
                [(p, steps), (q, other)] => {
                    let near = if steps > other { p } else { q };
                    let middle = splitting.places[&between(p, STEPS / 2, q)];
                    rim.middle(&file.points, near, middle)
                }
                _ => (kind == ElementKind::Quad4).then(|| center(rim, &file.points, own)),
            }
        };
        for (kind, nodes) in splitting.split(kind, own, curved) {
            let (label, region) = (fine.elements.len() + 1, element.region.clone());
            fine.elements.push(FileElement { label, kind, nodes, region, ..*element });
        }
    }
    // Parts of a face have the nodes of parts of its element.
    for faces in fine.surfaces.values_mut() {
        let split = faces.iter().map(|(kind, nodes)| splitting.split(*kind, nodes, |_, _| None));
        *faces = split.collect::<Vec<_>>().concat();
    }
    for nodes in fine.node_sets.values_mut() {
        let own: BTreeSet<u32> = nodes.iter().copied().collect();
        let is_between = |place: &Place| place.iter().all(|(corner, _)| own.contains(corner));
        let between = splitting.places.iter().filter(|(place, _)| is_between(place));
        let all: BTreeSet<u32> = own.iter().copied().chain(between.map(|own| *own.1)).collect();
        *nodes = all.into_iter().collect();
    }
    // The halves of an edge of a physical curve; none where no element has it.
    let at = |p, steps, q| splitting.places.get(&between(p, steps, q)).copied();
    let halves = |&(p, q, _): &CurveEdge| {
        let halved = at(p, STEPS / 2, q)
            .map(|m| [(p, m, at(p, 3 * STEPS / 4, q)), (m, q, at(q, 3 * STEPS / 4, p))]);
        halved.into_iter().flatten()
    };
    for edges in fine.curves.values_mut() {
        *edges = edges.iter().flat_map(halves).collect();
    }
    fine.labels = splitting.labels(&file.labels);
    fine.is_used.resize(splitting.points.len(), true);
    fine.points = splitting.points;
    Ok(fine)
}

impl Mesh {
    /// The same solid bodies with every element split as [`refined_file`] does; boundaries keep their conditions.
    ///
    /// # Errors
    /// [`BodyError::Body`] for a mesh that would have too many nodes, or parts of curved elements that are inverted.
    pub fn refined_solids(&self) -> Result<Self, BodyError> {
        let conditions = self.boundaries.iter().map(|own| (own.name.clone(), own.condition));
        let conditions: Vec<_> = conditions.collect();
        Self::from_solids(&refined_file(&self.to_file())?, 1.0, &conditions)
    }
}

/// The middle of a linear quadrilateral: halfway between opposite edges, less the corners that both count.
fn center(rim: &Rim, points: &[[f64; 3]], nodes: &[u32]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (&p, &q) in nodes.iter().zip(nodes.iter().cycle().skip(1)) {
        let [a, b] = [p, q].map(|node| points[node as usize]);
        let plain = [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]));
        let middle = rim.middle(points, p.min(q), p.max(q)).unwrap_or(plain);
        (0..3).for_each(|axis| sum[axis] += 0.5 * middle[axis] - 0.25 * a[axis]);
    }
    sum
}
