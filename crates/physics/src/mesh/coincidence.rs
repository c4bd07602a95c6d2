//! Nodes in one place that are not one node, elements given twice, and free edges: parts that were not merged.

use super::Mesh;
use super::error::BodyError;
use super::grid::Grid;
use frictionsim_formats::FileMesh;
use nalgebra::Vector3;
use std::collections::HashMap;

/// Distance up to which nodes coincide, over the shortest edge of the mesh.
const COINCIDENT: f64 = 1e-4;
/// Places that a message names.
const NAMED: usize = 3;

/// Pairs `(lower, higher)` of nodes that lie within `distance` of each other, in rising order: the nearest lower node of
/// each that has one. Linear in the number of nodes where few lie in one place.
pub fn coincident_nodes(points: &[[f64; 3]], distance: f64) -> Vec<(u32, u32)> {
    let places = || points.iter().map(|&point| Vector3::from(point));
    let grid = Grid::of(4.0 * distance, places().map(|place| (place, 0.0)));
    let mut is_paired = vec![false; points.len()];
    let mut pairs = Vec::new();
    for (node, place) in places().enumerate() {
        // A place is known by its first node: later ones are paired with that.
        let others = grid.near(&place, distance).into_iter();
        let others = others.filter(|&other| other < node && !is_paired[other]);
        let apart = others.map(|other| ((Vector3::from(points[other]) - place).norm(), other));
        let nearest = apart.filter(|own| own.0 <= distance).min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, first)) = nearest {
            is_paired[node] = true;
            pairs.push((first as u32, node as u32));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Refuses elements with the same corners as others: their stiffness and mass would count twice.
pub(super) fn refuse_doubled_elements(file: &FileMesh) -> Result<(), BodyError> {
    let mut first_of: HashMap<Vec<u32>, usize> = HashMap::with_capacity(file.elements.len());
    let mut doubled = Vec::new();
    for (e, element) in file.elements.iter().enumerate() {
        let mut corners = element.nodes[..element.kind.corner_count()].to_vec();
        corners.sort_unstable();
        let first = *first_of.entry(corners).or_insert(e);
        doubled.extend((first != e).then_some((first, e)));
    }
    if doubled.is_empty() {
        return Ok(());
    }
    let named = doubled.iter().take(NAMED).map(|&(first, e)| {
        let [first, e] = [first, e].map(|e| &file.elements[e]);
        let [x, y, _] = file.points[first.nodes[0] as usize];
        format!("{} and {} at ({x:.6}, {y:.6})", first.label, e.label)
    });
    Err(BodyError::Body(format!(
        "{} given twice (elements {}{}): remove the copies (Coherence Mesh; in Gmsh), and put each surface in one physical group",
        match doubled.len() {
            1 => "1 element is".to_owned(),
            count => format!("{count} elements are"),
        },
        named.collect::<Vec<_>>().join("; "),
        if doubled.len() > NAMED { "; ..." } else { "" },
    )))
}

/// Parts of a body that lie on each other without being joined.
#[derive(Clone, Debug, PartialEq)]
pub struct UnmergedNodes {
    /// Nodes that lie where another one lies.
    pub count: usize,
    /// The first of them: the numbers of both, and the place, m.
    pub first: Vec<([usize; 2], [f64; 3])>,
    /// Edges of one element alone that no physical curve holds; of a plane body.
    pub unnamed_edges: Option<usize>,
}

impl std::fmt::Display for UnmergedNodes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let nodes = match self.count {
            1 => "1 node lies".to_owned(),
            count => format!("{count} nodes lie"),
        };
        let named = self.first.iter().map(|([first, second], [x, y, z])| {
            let z = match self.unnamed_edges {
                Some(_) => String::new(),
                None => format!(", {z:.6}"),
            };
            format!("{first} and {second} at ({x:.6}, {y:.6}{z}) m")
        });
        let named: Vec<String> = named.collect();
        let more = if self.count > self.first.len() { "; ..." } else { "" };
        write!(
            f,
            "{nodes} where another one lies, without being joined to it ({}{more})",
            named.join("; ")
        )?;
        match self.unnamed_edges {
            None => Ok(()),
            Some(1) => write!(f, "; 1 free edge is in no physical curve"),
            Some(count) => write!(f, "; {count} free edges are in no physical curve"),
        }
    }
}

impl Mesh {
    /// For each node the boundaries that it lies on.
    fn boundaries_of_nodes(&self) -> Vec<Vec<usize>> {
        let mut boundaries_of = vec![Vec::new(); self.node_count()];
        for (b, boundary) in self.boundaries.iter().enumerate() {
            for &node in &boundary.nodes {
                boundaries_of[node as usize].push(b);
            }
        }
        boundaries_of
    }

    /// Edges of one element alone that belong to no named boundary, of a plane body.
    pub fn unnamed_edge_count(&self) -> Option<usize> {
        if self.dimension != 2 {
            return None;
        }
        let of = self.boundaries_of_nodes();
        let is_named = |(p, q, _): &(u32, u32, Option<u32>)| {
            let there = &of[*q as usize];
            of[*p as usize].iter().any(|b| there.contains(b))
        };
        Some(self.outline_edges().iter().filter(|edge| !is_named(edge)).count())
    }

    /// Nodes that coincide without being joined, but for those of two named boundaries that lie on each other: surfaces
    /// that slide on each other or are tied.
    pub fn unmerged_nodes(&self) -> Option<UnmergedNodes> {
        let of = self.boundaries_of_nodes();
        let is_meant = |p: u32, q: u32| {
            let [p, q] = [p, q].map(|node| &of[node as usize]);
            p.iter().any(|b| !q.contains(b)) && q.iter().any(|b| !p.contains(b))
        };
        let mut pairs = coincident_nodes(&self.nodes, COINCIDENT * self.quality().smallest_edge_m);
        pairs.retain(|&(p, q)| !is_meant(p, q));
        let first = pairs.iter().take(NAMED).map(|&(p, q)| {
            ([p, q].map(|node| self.node_label(node as usize)), self.nodes[p as usize])
        });
        (!pairs.is_empty()).then(|| UnmergedNodes {
            count: pairs.len(),
            first: first.collect(),
            unnamed_edges: self.unnamed_edge_count(),
        })
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
