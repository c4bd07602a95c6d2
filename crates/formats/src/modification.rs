//! What changes a mesh file before it becomes a body: elements taken away, a curve moved.

use crate::prelude::*;
impl FileMesh {
    /// Mean of an element's corners, in the unit of the file.
    pub fn element_middle(&self, element: &FileElement) -> [f64; 3] {
        let corners = &element.nodes[..element.kind.corner_count()];
        let points = corners.iter().map(|&node| self.points[node as usize]);
        let sum = points.fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k]));
        sum.map(|x| x / corners.len() as f64)
    }

    /// The file without some elements, and without the edges and faces of its curves and surfaces that bounded these alone.
    pub fn without(&self, is_removed: impl Fn(&FileElement) -> bool) -> Self {
        let others = self.elements.iter().filter(|element| !is_removed(element));
        let elements: Vec<FileElement> = others.cloned().collect();
        let mut elements_of: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (e, element) in elements.iter().enumerate() {
            for &node in &element.nodes {
                elements_of.entry(node).or_default().push(e);
            }
        }
        let has_element = |nodes: &[u32]| {
            let around = elements_of.get(&nodes[0]).into_iter().flatten();
            let mut around = around.map(|&e| &elements[e].nodes);
            around.any(|own| nodes.iter().all(|node| own.contains(node)))
        };
        Self {
            curves: kept(&self.curves, |edge| has_element(&[edge.0, edge.1])),
            surfaces: kept(&self.surfaces, |(_, nodes)| has_element(nodes)),
            node_sets: kept(&self.node_sets, |node| elements_of.contains_key(node)),
            elements,
            symmetry: None,
            ..self.clone()
        }
    }

    /// The plane file with one of its curves moved by a vector, in the unit of the file: nodes between it and the other curves
    /// follow in the ratio of their distances from both. `None` where it has no such curve or no other one.
    pub fn with_curve_moved(&self, name: &str, [dx, dy]: [f64; 2]) -> Option<Self> {
        let nodes_of = |edges: &[CurveEdge]| -> BTreeSet<u32> {
            edges.iter().flat_map(|edge| [Some(edge.0), Some(edge.1), edge.2]).flatten().collect()
        };
        let moved = nodes_of(self.curves.get(name)?);
        let others = self.curves.iter().filter(|(other, _)| *other != name);
        let held: BTreeSet<u32> = others.flat_map(|(_, edges)| nodes_of(edges)).collect();
        if held.is_empty() {
            return None;
        }
        let nearest = |point: [f64; 3], nodes: &BTreeSet<u32>| {
            let away = nodes.iter().map(|&node| distance(point, self.points[node as usize]));
            away.fold(f64::INFINITY, f64::min)
        };
        let place = |&point: &[f64; 3]| {
            let [from, to] = [&moved, &held].map(|nodes| nearest(point, nodes));
            let share = to / (from + to);
            [point[0] + share * dx, point[1] + share * dy, point[2]]
        };
        Some(Self {
            points: self.points.iter().map(place).collect(),
            symmetry: None,
            ..self.clone()
        })
    }
}

/// What has a name without some of its items; without its name where none is left.
fn kept<T: Clone>(
    named: &BTreeMap<String, Vec<T>>,
    is_kept: impl Fn(&T) -> bool,
) -> BTreeMap<String, Vec<T>> {
    let named = named.iter().map(|(name, items)| {
        let own: Vec<T> = items.iter().filter(|item| is_kept(item)).cloned().collect();
        (name.clone(), own)
    });
    named.filter(|(_, own)| !own.is_empty()).collect()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}
