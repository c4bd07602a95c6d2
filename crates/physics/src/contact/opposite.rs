//! Coupling of a contact edge to the edge of another body, whose mesh need not match.

use super::Row;
use super::dual::dual_weights;
use crate::mesh::{Boundary, BoundaryFace, Counterface, Mesh};
use std::collections::BTreeMap;

/// How the opposite body moves before a contact node, as rows over all dofs along the node's normal and along its tangent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OppositeMotion {
    /// The displacement.
    pub moves: [Row; 2],
    /// Its derivative by the arc along the tangent, 1/m.
    pub slopes: [Row; 2],
}

/// What a contact node meets.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Meeting {
    /// How the opposite body moves there.
    pub motion: OppositeMotion,
    /// Share of the node's tributary length that has the opposite edge before it.
    pub covered: f64,
    /// Height of the opposite edge above the common surface, along the normal, m.
    pub height: f64,
}

/// What each node of the contact edge meets; `None` on a rigid counterface.
///
/// Dual mortar weights (Wohlmuth 2000): `P_ij = ∫ psi_i M_j ds / ∫ psi_i ds` with the basis `psi` that is biorthogonal to the
/// contact edge's shape functions, edge by edge on the part that is covered, and `M` the opposite edge's shape functions;
/// places of both are their projections onto the common surface. A constant pressure passes exactly between straight
/// edges. On the annulus nodes lie in pairs, `P` is the identity, and slopes are those of the nodal field.
pub(super) fn meetings(mesh: &Mesh) -> Option<Vec<Meeting>> {
    if mesh.is_cyclic {
        return pairs(mesh, (1, &|node, _| node as usize));
    }
    let opposite = &mesh.boundaries[mesh.opposite?];
    let edges = Edge::of(mesh, mesh.contact_edge());
    let others = Edge::of(mesh, opposite);
    let heights = mesh.distances_from_counterface(opposite);
    Some(mortar(mesh, &edges, (&others, &heights)))
}

/// Those of nodes in pairs, the first of so many equal parts of a circle; `ahead` is what stands for a node of the opposite
/// body in the next part (1) or the one before (-1).
pub(super) fn pairs(
    mesh: &Mesh,
    (parts, ahead): (usize, &dyn Fn(u32, isize) -> usize),
) -> Option<Vec<Meeting>> {
    let nodes = &mesh.boundaries[mesh.opposite?].nodes;
    let lengths = &mesh.contact_edge().tributary_lengths;
    let (count, curvature) = (nodes.len(), mesh.counterface.curvature());
    let is_quadratic = lengths.iter().any(|length| *length != lengths[0]);
    let per_arc = (count * parts) as f64 / std::f64::consts::TAU * curvature;
    let pair = |i: usize| {
        let dof = 2 * nodes[i] as usize;
        let mut slopes = [vec![(dof + 1, -curvature)], vec![(dof, curvature)]];
        for &(offset, weight) in arc_stencil(is_quadratic, i) {
            let (other, count) = (i as isize + offset, count as isize);
            let node = nodes[other.rem_euclid(count) as usize];
            let dof = 2 * ahead(node, other.div_euclid(count));
            slopes[0].push((dof, weight * per_arc));
            slopes[1].push((dof + 1, weight * per_arc));
        }
        let moves = [vec![(dof, 1.0)], vec![(dof + 1, 1.0)]];
        Meeting { motion: OppositeMotion { moves, slopes }, covered: 1.0, height: 0.0 }
    };
    Some((0..count).map(pair).collect())
}

/// Derivative along a closed curve at node `i`, of both elements' mean at a corner: how many nodes ahead, and the weight.
fn arc_stencil(is_quadratic: bool, i: usize) -> &'static [(isize, f64)] {
    match (is_quadratic, i % 2) {
        (true, 0) => &[(-2, 0.25), (-1, -1.0), (1, 1.0), (2, -0.25)],
        _ => &[(-1, -0.5), (1, 0.5)],
    }
}

/// An element edge on the common surface.
struct Edge<'a> {
    face: &'a BoundaryFace,
    /// Arc along the tangent of the contact at its first end, and how far the second end lies from there, m.
    start: f64,
    extent: f64,
}

impl<'a> Edge<'a> {
    /// The edges of a boundary.
    fn of(mesh: &Mesh, boundary: &'a Boundary) -> Vec<Self> {
        let surface = &mesh.counterface;
        let edge = |face: &'a BoundaryFace| {
            let ends = [face.nodes[0], face.nodes[1]];
            let [start, end] = ends.map(|node| arc(surface, mesh.plane_node(node as usize)));
            Self { face, start, extent: wrapped(surface, end - start) }
        };
        boundary.faces.iter().map(edge).collect()
    }

    /// Shape functions and their derivatives by the arc at a share `0..1` of the way from the first to the second end.
    fn shapes(&self, share: f64) -> Vec<(u32, f64, f64)> {
        let (s, slope) = (2.0 * share - 1.0, 2.0 / self.extent);
        let nodes = self.face.nodes.iter().zip(self.face.kind.shape_functions([s, 0.0, 0.0]));
        nodes.map(|(&node, (value, rates))| (node, value, rates[0] * slope)).collect()
    }

    /// The part of this edge that has `other` before it, as shares of the way: `None` where they do not meet.
    fn overlap(&self, other: &Self, surface: &Counterface) -> Option<[f64; 2]> {
        let offset = wrapped(surface, other.start - self.start);
        let ends = [offset, offset + other.extent].map(|arc| arc / self.extent);
        let low = ends[0].min(ends[1]).max(0.0);
        let high = ends[0].max(ends[1]).min(1.0);
        (high - low > 1e-9).then_some([low, high])
    }

    /// Where a point of this edge lies on the way of `other`.
    fn share_on(&self, other: &Self, share: f64, surface: &Counterface) -> f64 {
        let offset = wrapped(surface, self.start - other.start);
        ((offset + share * self.extent) / other.extent).clamp(0.0, 1.0)
    }
}

/// Arc of the common surface along the contact nodes' tangent, m.
fn arc(surface: &Counterface, point: [f64; 2]) -> f64 {
    let place = surface.place(point);
    match surface {
        Counterface::Cylinder { .. } => place * surface.lever(),
        Counterface::Plane { .. } => -place,
    }
}

/// The same place less than half a turn away.
fn wrapped(surface: &Counterface, arc: f64) -> f64 {
    match surface {
        Counterface::Cylinder { radius, .. } => {
            let turn = std::f64::consts::TAU * radius;
            arc - turn * (arc / turn).round()
        }
        Counterface::Plane { .. } => arc,
    }
}

/// Points and weights of Gauss's rule with five points on `0..1`: exact for the product of three parabolas.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// Sums over the edges that end in a node.
#[derive(Clone, Default)]
struct Sums {
    /// `∫ psi_i ds` over what is covered, and `∫ N_i ds` over all.
    covered: f64,
    whole: f64,
    /// `∫ psi_i M_j ds` and `∫ psi_i M_j' ds` of the opposite nodes.
    opposite: BTreeMap<u32, [f64; 2]>,
}

fn mortar(
    mesh: &Mesh,
    edges: &[Edge<'_>],
    (others, heights): (&[Edge<'_>], &BTreeMap<u32, f64>),
) -> Vec<Meeting> {
    let surface = &mesh.counterface;
    let mut sums: BTreeMap<u32, Sums> = BTreeMap::new();
    for edge in edges {
        let length = edge.extent.abs();
        // ∫ N_i ds over the whole edge.
        for (weight, share) in GAUSS.map(|(share, weight)| (weight * length, share)) {
            for (node, value, _) in edge.shapes(share) {
                sums.entry(node).or_default().whole += weight * value;
            }
        }
        // Gauss points of what other edges cover, with their weights and the values of the shape functions there.
        let overlaps =
            others.iter().filter_map(|other| Some((other, edge.overlap(other, surface)?)));
        let points = overlaps.flat_map(|(other, [low, high])| {
            let width = high - low;
            GAUSS.map(|(at, weight)| (other, low + width * at, weight * width * length))
        });
        let points: Vec<(&Edge<'_>, f64, f64)> = points.collect();
        // The dual basis over what is covered, psi_i at each of the points.
        let bases = points.iter().map(|&(_, share, weight)| {
            (weight, edge.shapes(share).into_iter().map(|shape| shape.1).collect())
        });
        let bases: Vec<(f64, Vec<f64>)> = bases.collect();
        let Some(weights) = dual_weights(edge.face.nodes.len(), &bases) else { continue };
        for (&(other, share, _), weights) in points.iter().zip(weights) {
            // ∫ psi_i N_j ds of the nodes on the other side, and of the slope along it.
            let met = other.shapes(edge.share_on(other, share, surface));
            for (&node, psi) in edge.face.nodes.iter().zip(weights) {
                let sum = sums.entry(node).or_default();
                sum.covered += psi;
                for &(opposite, value, slope) in &met {
                    let entry = sum.opposite.entry(opposite).or_default();
                    entry[0] += psi * value;
                    entry[1] += psi * slope;
                }
            }
        }
    }
    let nodes = mesh.contact_edge().nodes.iter();
    nodes
        .map(|&node| {
            let sum = sums.get(&node).cloned().unwrap_or_default();
            meeting(mesh, node as usize, &sum, heights)
        })
        .collect()
}

fn meeting(mesh: &Mesh, node: usize, sums: &Sums, heights: &BTreeMap<u32, f64>) -> Meeting {
    let is_met = sums.covered > 1e-6 * sums.whole && sums.whole > 0.0;
    if !is_met {
        return Meeting::default();
    }
    let normal = mesh.counterface.normal_angle(mesh.plane_node(node));
    let mut meeting = Meeting { covered: sums.covered / sums.whole, ..Meeting::default() };
    for (&opposite, integrals) in &sums.opposite {
        let [share, slope] = integrals.map(|value| value / sums.covered);
        meeting.height += share * heights[&opposite];
        let opposite = opposite as usize;
        // Axes of the opposite node's frame along the contact node's.
        let (sin, cos) = (mesh.frame_angles()[opposite] - normal).sin_cos();
        for (axis, turn) in [[cos, sin], [-sin, cos]].into_iter().enumerate() {
            let OppositeMotion { moves, slopes } = &mut meeting.motion;
            for (rows, value) in [(moves, share), (slopes, slope)] {
                for (row, part) in rows.iter_mut().zip(turn.map(|part| value * part)) {
                    row.extend((part != 0.0).then_some((2 * opposite + axis, part)));
                }
            }
        }
    }
    meeting
}
