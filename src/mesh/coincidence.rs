//! Nodes in one place that are not one node, elements given twice, and free edges: parts that were not merged.

use super::Mesh;
use super::gmsh::{GmshFile, MeshFileError};
use std::collections::{BTreeMap, HashMap};

/// Distance up to which nodes coincide, over the shortest edge of the mesh.
const COINCIDENT: f64 = 1e-4;
/// Places that a message names.
const NAMED: usize = 3;

/// Pairs `(lower, higher)` of nodes that lie within `distance` of each other, in rising order: the nearest lower node of
/// each that has one. Linear in the number of nodes where few lie in one place.
pub fn coincident_nodes<const D: usize>(points: &[[f64; D]], distance: f64) -> Vec<(u32, u32)> {
    let cell = |value: f64| (value / (4.0 * distance)).floor() as i64;
    let mut nodes_of: HashMap<[i64; D], Vec<u32>> = HashMap::new();
    let mut pairs = Vec::new();
    for (node, point) in points.iter().enumerate() {
        // The cells that a ball about the point reaches into: one in almost every case.
        let low = point.map(|value| cell(value - distance));
        let high = point.map(|value| cell(value + distance));
        let mut nearest: Option<(f64, u32)> = None;
        for corner in 0..1usize << D {
            let axis = |i: usize| {
                if corner >> i & 1 == 0 {
                    low[i]
                } else {
                    high[i]
                }
            };
            let is_repeated = (0..D).any(|i| corner >> i & 1 == 1 && low[i] == high[i]);
            if is_repeated {
                continue;
            }
            let key: [i64; D] = std::array::from_fn(axis);
            for &other in nodes_of.get(&key).into_iter().flatten() {
                let squares = (0..D).map(|i| (points[other as usize][i] - point[i]).powi(2));
                let apart = squares.sum::<f64>().sqrt();
                let is_nearer = nearest.is_none_or(|(least, _)| apart < least);
                if apart <= distance && is_nearer {
                    nearest = Some((apart, other));
                }
            }
        }
        // A place is known by its first node: later ones are paired with that.
        match nearest {
            Some((_, first)) => pairs.push((first, node as u32)),
            None => nodes_of
                .entry(point.map(cell))
                .or_default()
                .push(node as u32),
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Refuses elements with the same corners as others: their stiffness and mass would count twice.
pub(super) fn refuse_doubled_elements(file: &GmshFile) -> Result<(), MeshFileError> {
    let mut first_of: HashMap<Vec<u32>, usize> = HashMap::with_capacity(file.elements.len());
    let mut doubled = Vec::new();
    for (e, element) in file.elements.iter().enumerate() {
        let mut corners = element.nodes[..element.kind.corner_count()].to_vec();
        corners.sort_unstable();
        match first_of.get(&corners) {
            Some(&first) => doubled.push((first, e)),
            None => {
                first_of.insert(corners, e);
            }
        }
    }
    if doubled.is_empty() {
        return Ok(());
    }
    let named = doubled.iter().take(NAMED).map(|&(first, e)| {
        let [first, e] = [first, e].map(|e| &file.elements[e]);
        let [x, y, _] = file.points[first.nodes[0] as usize];
        format!("{} and {} at ({x:.6}, {y:.6})", first.label, e.label)
    });
    Err(MeshFileError::Body(format!(
        "{} given twice (elements {}{}): remove the copies (Coherence Mesh; in Gmsh), and put each surface in one physical \
         group",
        match doubled.len() {
            1 => "1 element is".to_owned(),
            count => format!("{count} elements are"),
        },
        named.collect::<Vec<_>>().join("; "),
        if doubled.len() > NAMED { "; ..." } else { "" },
    )))
}

/// Parts of a plane body that lie on each other without being joined.
#[derive(Clone, Debug, PartialEq)]
pub struct UnmergedNodes {
    /// Nodes that lie where another one lies.
    pub count: usize,
    /// The first of them: the numbers of both, and the place, m.
    pub first: Vec<([usize; 2], [f64; 2])>,
    /// Edges of one element alone that no physical curve holds.
    pub unnamed_edges: usize,
}

impl std::fmt::Display for UnmergedNodes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let verb = match self.count {
            1 => "1 node lies",
            _ => "nodes lie",
        };
        if self.count != 1 {
            write!(f, "{} ", self.count)?;
        }
        write!(
            f,
            "{verb} where another one lies, without being joined to it ("
        )?;
        for (i, ([first, second], [x, y])) in self.first.iter().enumerate() {
            let separator = if i > 0 { "; " } else { "" };
            write!(f, "{separator}{first} and {second} at ({x:.6}, {y:.6}) m")?;
        }
        let more = if self.count > self.first.len() {
            "; ..."
        } else {
            ""
        };
        write!(f, "{more}); ")?;
        match self.unnamed_edges {
            1 => write!(f, "1 free edge is in no physical curve"),
            count => write!(f, "{count} free edges are in no physical curve"),
        }
    }
}

impl Mesh {
    /// Edges of one element alone that belong to no named boundary.
    pub fn unnamed_edge_count(&self) -> usize {
        let mut boundaries_of: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (b, boundary) in self.boundaries.iter().enumerate() {
            for &node in &boundary.nodes {
                boundaries_of.entry(node).or_default().push(b);
            }
        }
        let of = |node: u32| boundaries_of.get(&node).map_or(&[][..], Vec::as_slice);
        let edges = self.outline_edges();
        let is_unnamed = |(p, q, _): &&(u32, u32, Option<u32>)| {
            let shared = |b: &&usize| of(*q).contains(b);
            !of(*p).iter().any(|b| shared(&b))
        };
        edges.iter().filter(is_unnamed).count()
    }

    /// Nodes that coincide without being joined; those of two surfaces that slide on each other may.
    pub fn unmerged_nodes(&self) -> Option<UnmergedNodes> {
        let shortest = self.shortest_edge();
        let is_on = |boundary: Option<usize>| {
            let mut on = vec![false; self.node_count()];
            let nodes = boundary.map_or(&[][..], |b| &self.boundaries[b].nodes);
            nodes.iter().for_each(|&node| on[node as usize] = true);
            on
        };
        let (contact, opposite) = (
            is_on((!self.boundaries.is_empty()).then_some(self.contact)),
            is_on(self.opposite),
        );
        let slides = |p: u32, q: u32| {
            let [p, q] = [p, q].map(|node| node as usize);
            (contact[p] && opposite[q]) || (contact[q] && opposite[p])
        };
        let mut pairs = coincident_nodes(&self.nodes, COINCIDENT * shortest);
        pairs.retain(|&(p, q)| !slides(p, q));
        let first = pairs.iter().take(NAMED).map(|&(p, q)| {
            let labels = [p, q].map(|node| self.node_label(node as usize));
            (labels, self.plane_node(p as usize))
        });
        (!pairs.is_empty()).then(|| UnmergedNodes {
            count: pairs.len(),
            first: first.collect(),
            unnamed_edges: self.unnamed_edge_count(),
        })
    }

    /// Shortest edge of an element, m.
    fn shortest_edge(&self) -> f64 {
        let mut shortest = f64::INFINITY;
        for element in 0..self.element_count() {
            let (kind, nodes) = (self.element_kind(element), self.element_nodes(element));
            for edge in 0..kind.corner_count() {
                let (p, q, _) = kind.edge(edge);
                let [p, q] = [p, q].map(|local| self.nodes[nodes[local] as usize]);
                shortest = shortest.min((p[0] - q[0]).hypot(p[1] - q[1]));
            }
        }
        shortest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_coincide_up_to_a_distance_wherever_they_lie() {
        // Places on both sides of cell borders, negative ones, and one that is far away.
        let mut points = Vec::new();
        for i in 0..200 {
            let x = -1.0 + 0.01 * f64::from(i);
            points.push([x, 0.3 * x, 0.0]);
        }
        let shift = [0.6e-6, -0.6e-6, 0.4e-6];
        for i in (0..200).step_by(7) {
            points.push(std::array::from_fn(|axis| points[i][axis] + shift[axis]));
        }
        points.push([1e300, 0.0, 0.0]);
        let pairs = coincident_nodes(&points, 1e-6);
        let expected: Vec<(u32, u32)> = (0..200).step_by(7).zip(200..).collect();
        assert_eq!(pairs, expected);
        assert!(coincident_nodes(&points, 0.5e-6).is_empty());
    }
}
