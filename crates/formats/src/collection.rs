//! Elements and sets of nodes of a text file on their way to a mesh file.

use crate::prelude::*;
/// Region of elements that the file gives none.
const NO_REGION: &str = "body";

impl FileElement {
    /// Its faces with their nodes.
    pub(super) fn faces(&self) -> impl Iterator<Item = SurfaceFace> + '_ {
        let faces = self.kind.faces().iter();
        faces.map(|(kind, locals)| (*kind, locals.iter().map(|&l| self.nodes[l]).collect()))
    }

    /// The face on which all the given nodes are corners.
    pub(super) fn face_with(&self, corners: &[u32]) -> Option<SurfaceFace> {
        let has = |face: &SurfaceFace, node| face.1[..face.0.corner_count()].contains(node);
        self.faces().find(|face| corners.iter().all(|node| has(face, node)))
    }
}

/// The edge of a curve that a line of two or three nodes is.
pub(super) fn edge_of(nodes: &[u32]) -> CurveEdge {
    (nodes[0], nodes[1], nodes.get(2).copied())
}

/// Nodes in ascending order.
pub(super) fn sorted(nodes: &[u32]) -> Vec<u32> {
    let mut sorted = nodes.to_vec();
    sorted.sort_unstable();
    sorted
}

fn corners_of((kind, nodes): &SurfaceFace) -> Vec<u32> {
    sorted(&nodes[..kind.corner_count()])
}

/// 3 where there are solid elements, else 2.
pub(super) fn dimension(elements: &[FileElement]) -> usize {
    elements.iter().map(|element| element.kind.dimension()).max().unwrap_or(2)
}

/// Nodes of elements.
pub(super) fn used_nodes(elements: &[FileElement]) -> BTreeSet<u32> {
    elements.iter().flat_map(|element| element.nodes.iter().copied()).collect()
}

/// Faces that belong to one of the elements `among` alone: all elements where it is empty.
pub(super) fn free_faces(elements: &[FileElement], among: &[usize]) -> Vec<SurfaceFace> {
    let mut faces: HashMap<Vec<u32>, (usize, SurfaceFace)> = HashMap::new();
    let all = elements.iter().flat_map(FileElement::faces);
    for (order, face) in all.enumerate() {
        let known = faces.entry(corners_of(&face)).and_modify(|known| known.0 = usize::MAX);
        known.or_insert((order, face));
    }
    let own = among.iter().flat_map(|&element| elements[element].faces());
    let own: BTreeSet<Vec<u32>> = own.map(|face| corners_of(&face)).collect();
    let mut free: Vec<(usize, SurfaceFace)> = faces
        .into_iter()
        .filter(|(key, (order, _))| *order != usize::MAX && (among.is_empty() || own.contains(key)))
        .map(|(_, face)| face)
        .collect();
    free.sort_unstable_by_key(|face| face.0);
    free.into_iter().map(|face| face.1).collect()
}

/// Outer faces by what names them in a file: the corners of a shell, all nodes of a beam.
pub(super) fn outer_faces(elements: &[FileElement]) -> HashMap<Vec<u32>, SurfaceFace> {
    let named = free_faces(elements, &[]).into_iter().map(|face| match face.0.corner_count() {
        2 => (sorted(&face.1), face),
        _ => (corners_of(&face), face),
    });
    named.collect()
}

/// The mesh file whose elements are all there, those without a region in one of their own; nodes of no element are dropped, node
/// sets whose nodes are all nodes of faces become surfaces.
pub(super) fn finished(mut file: FileMesh) -> FileMesh {
    drop_unused_nodes(&mut file);
    let has_sets = !file.node_sets.is_empty();
    let outer = if has_sets { free_faces(&file.elements, &[]) } else { Vec::new() };
    for (name, nodes) in std::mem::take(&mut file.node_sets) {
        let set: BTreeSet<u32> = nodes.iter().copied().collect();
        let faces = outer.iter().filter(|face| face.1.iter().all(|node| set.contains(node)));
        let faces: Vec<SurfaceFace> = faces.cloned().collect();
        let covered: BTreeSet<u32> = faces.iter().flat_map(|f| f.1.iter().copied()).collect();
        match covered.len() == set.len() && !set.is_empty() {
            true => drop(file.surfaces.entry(name).or_insert(faces)),
            false => drop(file.node_sets.insert(name, set.into_iter().collect())),
        }
    }
    file.is_used = vec![true; file.points.len()];
    file.dimension = dimension(&file.elements);
    if file.dimension == 2 {
        let edges = |faces: Vec<SurfaceFace>| faces.iter().map(|face| edge_of(&face.1)).collect();
        let surfaces = std::mem::take(&mut file.surfaces).into_iter();
        file.curves = surfaces.map(|(name, faces)| (name, edges(faces))).collect();
        file.equations.clear();
    }
    let mut regions: BTreeMap<Arc<str>, i64> = BTreeMap::new();
    let none: Arc<str> = NO_REGION.into();
    for element in &mut file.elements {
        if element.region.is_empty() {
            element.region = Arc::clone(&none);
        }
        let next = regions.len() as i64 + 1;
        element.entity = *regions.entry(Arc::clone(&element.region)).or_insert(next);
    }
    file
}

/// Drops nodes that belong to no element, and says how many.
fn drop_unused_nodes(file: &mut FileMesh) {
    let mut place = vec![None; file.points.len()];
    for node in used_nodes(&file.elements) {
        place[node as usize] = Some(0);
    }
    let mut count = 0; // New numbers, in the old order.
    for place in place.iter_mut().flatten() {
        *place = count;
        count += 1;
    }
    let unused = file.points.len() - count as usize; // Most files have none to drop.
    if unused == 0 {
        return;
    }
    let first = place.iter().position(Option::is_none).unwrap_or(0);
    let (nodes, are) = match unused {
        1 => ("1 node belongs".to_owned(), "is"),
        _ => (format!("{unused} nodes belong"), "are"),
    };
    let label = file.labels[first];
    let remark = format!("{nodes} to no element and {are} not used (the first is node {label})");
    file.model.remarks.push(remark);
    let mut used = [&place, &place].map(|place| place.iter().map(Option::is_some));
    file.points.retain(|_| used[0].next() == Some(true)); // Nodes, and all that names them by number.
    file.labels.retain(|_| used[1].next() == Some(true));
    let moved = |node: &u32| place[*node as usize];
    let of_elements = file.elements.iter_mut().map(|element| &mut element.nodes);
    let of_faces = file.surfaces.values_mut().flatten().map(|face| &mut face.1);
    for nodes in of_elements.chain(of_faces).chain(file.node_sets.values_mut()) {
        *nodes = nodes.iter().filter_map(moved).collect();
    }
    for term in file.equations.iter_mut().flatten() {
        term.0 = moved(&term.0).unwrap_or(term.0);
    }
}
