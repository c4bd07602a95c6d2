//! Uniform refinement of a mesh file: every element into four.

use super::error::BodyError;
use super::rim::Rim;
use frictionsim_formats::{CurveEdge, FileElement, FileMesh};
use std::collections::BTreeMap;

/// Most nodes of a mesh: indices are 32 bits wide, with room for two unknowns at each.
const MOST_NODES: usize = (u32::MAX / 2) as usize;

/// New nodes of one element edge, from its lower corner to its upper one.
#[derive(Clone, Copy)]
struct SplitEdge {
    /// The corner between the halves: the old mid-side node of a quadratic edge.
    middle: u32,
    /// Mid-side nodes of the halves of a quadratic edge.
    halves: Option<[u32; 2]>,
}

/// The same body with every element split into four alike; nodes keep their numbers, new ones count on from the
/// largest.
///
/// Where an edge of the body, or between two of its regions, follows a smooth curve, the new nodes lie on the
/// circle through its neighbours: arcs stay arcs to round-off. Elsewhere they lie on the old edge, a parabola where
/// it is quadratic.
///
/// # Errors
/// [`BodyError::Body`] for a mesh that would have too many nodes, or of solid elements.
pub fn refined_file(file: &FileMesh) -> Result<FileMesh, BodyError> {
    if file.dimension == 3 {
        return Err(BodyError::Body(
            "a file of solid elements is refined as the mesh that is made of it".to_owned(),
        ));
    }
    if file.points.len().saturating_mul(4) > MOST_NODES {
        return Err(BodyError::Body(format!(
            "a refinement of {} nodes has more than {MOST_NODES}: refine less",
            file.points.len()
        )));
    }
    let mut refinement = Refinement::new(file);
    for element in &file.elements {
        refinement.split(element);
    }
    let curves = file.curves.iter().map(|(name, edges)| {
        let halves = edges.iter().flat_map(|edge| refinement.split_curve(edge));
        (name.clone(), halves.collect())
    });
    let curves = curves.collect();
    Ok(FileMesh { curves, ..refinement.fine })
}

struct Refinement<'a> {
    coarse: &'a FileMesh,
    fine: FileMesh,
    rim: Rim,
    edges: BTreeMap<(u32, u32), SplitEdge>,
    next_label: usize,
}

impl<'a> Refinement<'a> {
    fn new(coarse: &'a FileMesh) -> Self {
        Self {
            rim: Rim::of(coarse),
            edges: BTreeMap::new(),
            next_label: 1 + coarse.labels.iter().copied().max().unwrap_or(0),
            fine: FileMesh {
                elements: Vec::with_capacity(4 * coarse.elements.len()),
                curves: BTreeMap::new(),
                ..coarse.clone()
            },
            coarse,
        }
    }

    fn node(&mut self, point: [f64; 3]) -> u32 {
        self.fine.labels.push(self.next_label);
        self.fine.points.push(point);
        self.fine.is_used.push(true);
        self.next_label += 1;
        (self.fine.points.len() - 1) as u32
    }

    /// Sum of points with weights.
    fn combined(&self, nodes: &[u32], weights: impl IntoIterator<Item = f64>) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (&node, weight) in nodes.iter().zip(weights) {
            let point = self.fine.points[node as usize];
            (0..3).for_each(|axis| sum[axis] += weight * point[axis]);
        }
        sum
    }

    /// New node halfway between two neighbours on an edge, at `plain` where the edge follows no curve.
    fn between(&mut self, p: u32, q: u32, plain: [f64; 3]) -> u32 {
        let curved = self.rim.middle(&self.coarse.points, p, q);
        self.node(curved.unwrap_or(plain))
    }

    /// The halves of an edge, seen from `p`.
    fn edge(&mut self, p: u32, q: u32, middle: Option<u32>) -> SplitEdge {
        let key = (p.min(q), p.max(q));
        let split = match self.edges.get(&key) {
            Some(known) => *known,
            None => {
                let (a, b) = key;
                let split = match middle {
                    None => {
                        let plain = self.combined(&[a, b], [0.5, 0.5]);
                        SplitEdge { middle: self.between(a, b, plain), halves: None }
                    }
                    Some(m) => {
                        // The parabola at a quarter of the edge.
                        let quarter = |near, far| ([near, far, m], [0.375, -0.125, 0.75]);
                        let halves = [quarter(a, b), quarter(b, a)].map(|(nodes, weights)| {
                            let plain = self.combined(&nodes, weights);
                            self.between(nodes[0], m, plain)
                        });
                        SplitEdge { middle: m, halves: Some(halves) }
                    }
                };
                self.edges.insert(key, split);
                split
            }
        };
        match split.halves {
            Some([first, second]) if p > q => SplitEdge { halves: Some([second, first]), ..split },
            _ => split,
        }
    }

    /// The four parts of an element.
    fn split(&mut self, element: &FileElement) {
        let (kind, nodes) = (element.kind, &element.nodes);
        let corners = kind.corner_count();
        let edges: Vec<SplitEdge> = (0..corners)
            .map(|edge| {
                let (p, q, m) = kind.edge(edge);
                self.edge(nodes[p], nodes[q], m.map(|m| nodes[m]))
            })
            .collect();
        let middles: Vec<u32> = edges.iter().map(|edge| edge.middle).collect();
        // Outline of each part: corners, then mid-side nodes.
        let mut parts: Vec<(Vec<u32>, Vec<u32>)> = Vec::with_capacity(4);
        let at = |refinement: &mut Self, xi: f64, eta: f64| {
            let shapes = kind.shape_functions([xi, eta, 0.0]).into_iter();
            let point = refinement.combined(nodes, shapes.map(|shape| shape.0));
            refinement.node(point)
        };
        let halves = |i: usize| {
            let before = edges[(i + corners - 1) % corners].halves;
            let after = edges[i].halves;
            after.zip(before).map(|(after, before)| (after[0], before[1]))
        };
        if corners == 3 {
            // The mid-side nodes of the inner triangle; inner edge i cuts off corner i.
            let inner: Vec<u32> = match kind.is_quadratic() {
                true => [(0.25, 0.25), (0.5, 0.25), (0.25, 0.5)]
                    .map(|(xi, eta)| at(self, xi, eta))
                    .into(),
                false => Vec::new(),
            };
            for i in 0..3 {
                let around = vec![nodes[i], middles[i], middles[(i + 2) % 3]];
                let mids =
                    halves(i).map_or(Vec::new(), |(after, before)| vec![after, inner[i], before]);
                parts.push((around, mids));
            }
            let mids = inner.get(1..).map_or(Vec::new(), |rest| vec![rest[0], rest[1], inner[0]]);
            parts.push((middles, mids));
        } else {
            let center = match kind.is_quadratic() {
                true => at(self, 0.0, 0.0),
                // Halfway between opposite edges, less the corners that both count.
                false => {
                    let around: Vec<u32> = middles.iter().chain(nodes).copied().collect();
                    let weights = [[0.5; 4], [-0.25; 4]].concat();
                    let point = self.combined(&around, weights);
                    self.node(point)
                }
            };
            // Mid-side nodes from the middle of each edge to the center.
            let inner: Vec<u32> = match kind.is_quadratic() {
                true => [(0.0, -0.5), (0.5, 0.0), (0.0, 0.5), (-0.5, 0.0)]
                    .map(|(xi, eta)| at(self, xi, eta))
                    .into(),
                false => Vec::new(),
            };
            for i in 0..4 {
                let before = (i + 3) % 4;
                let around = vec![nodes[i], middles[i], center, middles[before]];
                let mids = halves(i)
                    .map_or(Vec::new(), |(first, last)| vec![first, inner[i], inner[before], last]);
                parts.push((around, mids));
            }
        }
        for (around, mids) in parts {
            self.fine.elements.push(FileElement {
                label: self.fine.elements.len() + 1,
                nodes: [around, mids].concat(),
                region: element.region.clone(),
                ..*element
            });
        }
    }

    /// The halves of an edge of a physical curve; none where no element has it.
    fn split_curve(&self, &(p, q, _): &CurveEdge) -> Vec<CurveEdge> {
        let Some(split) = self.edges.get(&(p.min(q), p.max(q))) else {
            return Vec::new();
        };
        let (m, mut halves) = (split.middle, split.halves);
        if p > q {
            halves = halves.map(|[first, second]| [second, first]);
        }
        let half = |i: usize| halves.map(|halves| halves[i]);
        vec![(p, m, half(0)), (m, q, half(1))]
    }
}
