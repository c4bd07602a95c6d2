//! Coupling of a contact edge to the edge of another body, whose mesh need not match.

use super::Row;
use super::dual::dual_basis;
use crate::mesh::{Counterface, FaceKind, Mesh};
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
/// edges. On the annulus nodes lie in pairs, `P` is the identity, and slopes are those of the nodal field, the mean of both
/// elements at a corner.
pub(super) fn meetings(mesh: &Mesh) -> Option<Vec<Meeting>> {
    let opposite = mesh.opposite?;
    if mesh.is_cyclic {
        return Some(pairs(mesh, &mesh.boundaries[opposite].nodes));
    }
    let edges = Edge::of(mesh, mesh.contact);
    let others = Edge::of(mesh, opposite);
    let heights = mesh.distances_from_counterface(&mesh.boundaries[opposite]);
    Some(mortar(mesh, &edges, (&others, &heights)))
}

fn pairs(mesh: &Mesh, nodes: &[u32]) -> Vec<Meeting> {
    let count = nodes.len();
    let (lengths, curvature) =
        (&mesh.contact_edge().tributary_lengths, mesh.counterface.curvature());
    let is_quadratic = lengths[0] != lengths[1];
    let per_arc = count as f64 / std::f64::consts::TAU * curvature;
    let pair = |i: usize| {
        let dof = 2 * nodes[i] as usize;
        let mut slopes = [vec![(dof + 1, -curvature)], vec![(dof, curvature)]];
        let stencil: &[(usize, f64)] = match (is_quadratic, i % 2) {
            (true, 0) => &[(count - 2, 0.25), (count - 1, -1.0), (1, 1.0), (2, -0.25)],
            _ => &[(count - 1, -0.5), (1, 0.5)],
        };
        for &(offset, weight) in stencil {
            let dof = 2 * nodes[(i + offset) % count] as usize;
            slopes[0].push((dof, weight * per_arc));
            slopes[1].push((dof + 1, weight * per_arc));
        }
        let moves = [vec![(dof, 1.0)], vec![(dof + 1, 1.0)]];
        Meeting { motion: OppositeMotion { moves, slopes }, covered: 1.0, height: 0.0 }
    };
    (0..count).map(pair).collect()
}

/// An element edge on the common surface.
struct Edge {
    /// Its ends and its middle, if it has one.
    nodes: Vec<usize>,
    /// Arc along the tangent of the contact at its first end, and how far the second end lies from there, m.
    start: f64,
    extent: f64,
}

impl Edge {
    /// The edges of a boundary.
    fn of(mesh: &Mesh, boundary: usize) -> Vec<Self> {
        let nodes = &mesh.boundaries[boundary].nodes;
        let is_on: std::collections::BTreeSet<u32> = nodes.iter().copied().collect();
        let is_edge = |&(p, q, middle): &(u32, u32, Option<u32>)| {
            is_on.contains(&p) && is_on.contains(&q) && middle.is_none_or(|m| is_on.contains(&m))
        };
        let surface = &mesh.counterface;
        let edge = |(p, q, middle): (u32, u32, Option<u32>)| {
            let arc = |node: u32| arc(surface, mesh.plane_node(node as usize));
            Self {
                start: arc(p),
                extent: wrapped(surface, arc(q) - arc(p)),
                nodes: [p, q].into_iter().chain(middle).map(|n| n as usize).collect(),
            }
        };
        mesh.outline_edges().into_iter().filter(is_edge).map(edge).collect()
    }

    /// Shape functions and their derivatives by the arc at a share `0..1` of the way from the first to the second end.
    fn shapes(&self, share: f64) -> Vec<(usize, f64, f64)> {
        let (s, slope) = (2.0 * share - 1.0, 2.0 / self.extent);
        let kind = if self.nodes.len() == 3 { FaceKind::Line3 } else { FaceKind::Line2 };
        let nodes = self.nodes.iter().zip(kind.shape_functions([s, 0.0]));
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
    opposite: BTreeMap<usize, [f64; 2]>,
}

fn mortar(
    mesh: &Mesh,
    edges: &[Edge],
    (others, heights): (&[Edge], &BTreeMap<u32, f64>),
) -> Vec<Meeting> {
    let surface = &mesh.counterface;
    let mut sums: BTreeMap<usize, Sums> = BTreeMap::new();
    for edge in edges {
        let length = edge.extent.abs();
        for (weight, share) in GAUSS.map(|(share, weight)| (weight * length, share)) {
            for (node, value, _) in edge.shapes(share) {
                sums.entry(node).or_default().whole += weight * value;
            }
        }
        let overlaps: Vec<(&Edge, [f64; 2])> = others
            .iter()
            .filter_map(|other| Some((other, edge.overlap(other, surface)?)))
            .collect();
        let points: Vec<(&Edge, f64, f64)> = overlaps
            .iter()
            .flat_map(|&(other, [low, high])| {
                let width = high - low;
                GAUSS.map(|(at, weight)| (other, low + width * at, weight * width * length))
            })
            .collect();
        let value = |shape: (usize, f64, f64)| shape.1;
        let values =
            points.iter().map(|point| edge.shapes(point.1).into_iter().map(value).collect());
        let values: Vec<Vec<f64>> = values.collect();
        let weights = points.iter().map(|point| point.2);
        let count = edge.nodes.len();
        let Some((diagonal, inverse)) = dual_basis(count, weights.zip(&values)) else {
            continue;
        };
        for &(other, share, weight) in &points {
            let shapes = edge.shapes(share);
            let met = other.shapes(edge.share_on(other, share, surface));
            for (i, &(node, ..)) in shapes.iter().enumerate() {
                let row = (0..count).map(|j| diagonal[i] * inverse[(i, j)]);
                let psi: f64 = row.zip(&shapes).map(|(a, shape)| a * shape.1).sum();
                let sum = sums.entry(node).or_default();
                sum.covered += weight * psi;
                for &(opposite, value, slope) in &met {
                    let entry = sum.opposite.entry(opposite).or_default();
                    entry[0] += weight * psi * value;
                    entry[1] += weight * psi * slope;
                }
            }
        }
    }
    let nodes = mesh.contact_edge().nodes.iter();
    nodes
        .map(|&node| {
            let sum = sums.get(&(node as usize)).cloned().unwrap_or_default();
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
        meeting.height += share * heights[&(opposite as u32)];
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
