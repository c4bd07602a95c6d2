//! Nodes, elements, surfaces and node sets of a text file on their way to a mesh file.

use super::file_mesh::{CurveEdge, FileElement, FileMesh, SurfaceFace};
use super::model_data::ModelData;
use super::{ElementKind, Equation, FaceKind};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// Region of elements that the file gives none.
const NO_REGION: &str = "body";

/// What was read so far. Nodes and elements are known by their places here.
#[derive(Debug, Default)]
pub(super) struct Collection {
    pub points: Vec<[f64; 3]>,
    pub labels: Vec<usize>,
    pub elements: Vec<CollectedElement>,
    pub surfaces: BTreeMap<String, Vec<SurfaceFace>>,
    pub node_sets: BTreeMap<String, Vec<u32>>,
    pub equations: Vec<Equation>,
}

/// An element without its region.
#[derive(Debug)]
pub(super) struct CollectedElement {
    pub label: usize,
    pub kind: ElementKind,
    pub nodes: Vec<u32>,
    pub region: Option<Arc<str>>,
}

impl CollectedElement {
    /// Its faces with their nodes.
    pub fn faces(&self) -> impl Iterator<Item = SurfaceFace> + '_ {
        let faces = self.kind.faces().iter();
        faces.map(|(kind, locals)| (*kind, locals.iter().map(|&l| self.nodes[l]).collect()))
    }

    /// The face on which all the given nodes are corners.
    pub fn face_with(&self, corners: &[u32]) -> Option<SurfaceFace> {
        let has = |face: &SurfaceFace, node| face.1[..face.0.corner_count()].contains(node);
        self.faces().find(|face| corners.iter().all(|node| has(face, node)))
    }
}

/// Corners of a face in ascending order.
pub(super) fn corners_of((kind, nodes): &SurfaceFace) -> Vec<u32> {
    let mut corners = nodes[..kind.corner_count()].to_vec();
    corners.sort_unstable();
    corners
}

impl Collection {
    /// 3 where there are solid elements, else 2.
    pub fn dimension(&self) -> usize {
        self.elements.iter().map(|e| e.kind.dimension()).max().unwrap_or(2)
    }

    /// Nodes of elements.
    pub fn used_nodes(&self) -> BTreeSet<u32> {
        self.elements.iter().flat_map(|element| element.nodes.iter().copied()).collect()
    }

    /// Faces that belong to one of the elements `among` alone: all elements where it is empty.
    pub fn free_faces(&self, among: &[usize]) -> Vec<SurfaceFace> {
        let mut faces: HashMap<Vec<u32>, (usize, SurfaceFace)> = HashMap::new();
        let all = self.elements.iter().flat_map(CollectedElement::faces);
        for (order, face) in all.enumerate() {
            let known = faces.entry(corners_of(&face)).and_modify(|known| known.0 = usize::MAX);
            known.or_insert((order, face));
        }
        let own = among.iter().flat_map(|&element| self.elements[element].faces());
        let own: BTreeSet<Vec<u32>> = own.map(|face| corners_of(&face)).collect();
        let mut free: Vec<(usize, SurfaceFace)> = faces
            .into_iter()
            .filter(|(key, (order, _))| {
                *order != usize::MAX && (among.is_empty() || own.contains(key))
            })
            .map(|(_, face)| face)
            .collect();
        free.sort_unstable_by_key(|face| face.0);
        free.into_iter().map(|face| face.1).collect()
    }

    /// The mesh file; nodes of no element are dropped, node sets whose nodes are all nodes of faces become surfaces.
    pub fn finish(mut self, mut model: ModelData) -> FileMesh {
        self.drop_unused_nodes(&mut model);
        let outer = if self.node_sets.is_empty() { Vec::new() } else { self.free_faces(&[]) };
        let mut node_sets = BTreeMap::new();
        for (name, nodes) in std::mem::take(&mut self.node_sets) {
            let set: BTreeSet<u32> = nodes.iter().copied().collect();
            let faces = outer.iter().filter(|face| face.1.iter().all(|node| set.contains(node)));
            let faces: Vec<SurfaceFace> = faces.cloned().collect();
            let covered: BTreeSet<u32> = faces.iter().flat_map(|f| f.1.iter().copied()).collect();
            match covered.len() == set.len() && !set.is_empty() {
                true => drop(self.surfaces.entry(name).or_insert(faces)),
                false => drop(node_sets.insert(name, set.into_iter().collect())),
            }
        }
        let dimension = self.dimension();
        let mut regions: BTreeMap<Arc<str>, i64> = BTreeMap::new();
        let none: Arc<str> = NO_REGION.into();
        let elements = self.elements.into_iter().map(|element| {
            let region = element.region.unwrap_or_else(|| Arc::clone(&none));
            let next = regions.len() as i64 + 1;
            let entity = *regions.entry(Arc::clone(&region)).or_insert(next);
            FileElement {
                label: element.label,
                kind: element.kind,
                region,
                entity,
                nodes: element.nodes,
            }
        });
        let elements = elements.collect();
        let mut file = FileMesh {
            is_used: vec![true; self.points.len()],
            labels: self.labels,
            points: self.points,
            dimension,
            elements,
            node_sets,
            model,
            ..FileMesh::default()
        };
        match dimension {
            3 => (file.surfaces, file.equations) = (self.surfaces, self.equations),
            _ => file.curves = self.surfaces.into_iter().map(curve).collect(),
        }
        file
    }

    /// Drops nodes that belong to no element, and says how many.
    fn drop_unused_nodes(&mut self, model: &mut ModelData) {
        let mut place = vec![None; self.points.len()];
        for element in &self.elements {
            for &node in &element.nodes {
                place[node as usize] = Some(0);
            }
        }
        let mut count = 0;
        for place in place.iter_mut().flatten() {
            *place = count;
            count += 1;
        }
        let unused = self.points.len() - count as usize;
        if unused == 0 {
            return;
        }
        let first = place.iter().position(Option::is_none).unwrap_or(0);
        model.remarks.push(format!(
            "{} no element and {} not used (the first is node {})",
            match unused {
                1 => "1 node belongs to".to_owned(),
                _ => format!("{unused} nodes belong to"),
            },
            if unused == 1 { "is" } else { "are" },
            self.labels[first]
        ));
        let is_used = |node: usize| place[node].is_some();
        let mut node = 0..;
        self.points.retain(|_| node.next().is_some_and(is_used));
        let mut node = 0..;
        self.labels.retain(|_| node.next().is_some_and(is_used));
        let moved = |node: &u32| place[*node as usize];
        for element in &mut self.elements {
            element.nodes = element.nodes.iter().filter_map(moved).collect();
        }
        for (_, nodes) in self.surfaces.values_mut().flatten() {
            *nodes = nodes.iter().filter_map(moved).collect();
        }
        for nodes in self.node_sets.values_mut() {
            *nodes = nodes.iter().filter_map(moved).collect();
        }
        for term in self.equations.iter_mut().flatten() {
            term.0 = moved(&term.0).unwrap_or(term.0);
        }
    }
}

/// Edges of a plane body as a physical curve.
fn curve((name, faces): (String, Vec<SurfaceFace>)) -> (String, Vec<CurveEdge>) {
    let edges = faces.into_iter().filter_map(|(kind, nodes)| match kind {
        FaceKind::Line2 => Some((nodes[0], nodes[1], None)),
        FaceKind::Line3 => Some((nodes[0], nodes[1], Some(nodes[2]))),
        _ => None,
    });
    (name, edges.collect())
}
