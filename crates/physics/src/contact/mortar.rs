//! Surfaces that are tied, or in rigid contact, node by node: dual mortar points of segments.

use super::dual::dual_weights;
use super::surface::{SegmentPoint, SurfacePair, SurfacePoint};
use super::{Row, row_along};
use crate::mesh::{Boundary, BoundaryFace, Mesh};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Share of the corners' displacement in that of a quadratic edge's middle, which makes the integrals of all basis functions
/// positive (Popp, Wohlmuth, Gee and Wall 2012).
const CORNER_SHARE: f64 = 0.2;

/// What a node of a surface meets on another surface.
#[derive(Clone, Debug, PartialEq)]
pub struct MortarNode {
    /// The node.
    pub node: u32,
    /// The node as a point, with the means over its faces of normal and gap.
    pub at: SurfacePoint,
    /// Nodes of the own surface that move along a direction, and how far, where the jump here alone is one.
    pub lift: Vec<(u32, f64)>,
}

/// Sums over the faces at a node.
#[derive(Clone, Default)]
struct Sums {
    area: f64,
    gap: f64,
    normal: Vector3<f64>,
    counter: BTreeMap<u32, f64>,
    slopes: BTreeMap<u32, Vector3<f64>>,
}

/// The nodes of `surface` that have the other surface of `pair` before them.
///
/// Dual mortar weights (Wohlmuth 2000): with the basis `psi` that is biorthogonal to the face's shape functions over the part
/// of it that is covered,
///
/// ```text
/// ∫ psi_i (u_own - u_counter) dA = w_i (own_i . u - counter_i . u)
/// ```
///
/// A constant pressure passes exactly between flat surfaces, each row has one node of its own, and rigid motions cost nothing.
/// On quadratic faces the basis is dual to functions whose integrals are positive: the middle of an edge takes a fifth of
/// each of its corners' displacements.
pub fn mortar_nodes(mesh: &Mesh, surface: &Boundary, pair: &SurfacePair) -> Vec<MortarNode> {
    let mut sums: BTreeMap<u32, Sums> = BTreeMap::new();
    // Integrals face by face, each with the dual basis of what is covered of it.
    let mut by_face: BTreeMap<usize, Vec<&SegmentPoint>> = BTreeMap::new();
    for point in &pair.points {
        by_face.entry(point.face).or_default().push(point);
    }
    let corners_of = corners_of_middles(by_face.keys().map(|&f| &surface.faces[f]));
    for (f, points) in by_face {
        add_face(&surface.faces[f], &points, &mut sums);
    }
    let mut middles_of: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (&middle, ends) in &corners_of {
        for &end in ends {
            middles_of.entry(end).or_default().push(middle);
        }
    }
    // Nodes with next to no area are none of the contact.
    let largest = sums.values().map(|sum| sum.area).fold(0.0, f64::max);
    sums.iter()
        .filter(|(_, sum)| sum.area > 1e-6 * largest)
        .map(|(&node, sum)| {
            // What the value of a node lifts: on quadratic faces the middles beside a corner follow it by a fifth.
            let lift = match middles_of.get(&node) {
                _ if corners_of.contains_key(&node) => vec![(node, 1.0 - 2.0 * CORNER_SHARE)],
                None => vec![(node, 1.0)],
                Some(middles) => {
                    let shares = middles.iter().map(|&middle| (middle, CORNER_SHARE));
                    std::iter::once((node, 1.0)).chain(shares).collect()
                }
            };
            // The value itself, u_i of corners, (u_i - (u_p + u_q) / 5) 5 / 3 of middles.
            let own = match corners_of.get(&node) {
                None => vec![(node, 1.0)],
                Some(&[p, q]) => {
                    let whole = 1.0 / (1.0 - 2.0 * CORNER_SHARE);
                    let corner = -CORNER_SHARE * whole;
                    vec![(node, whole), (p, corner), (q, corner)]
                }
            };
            let counter = sum.counter.iter().map(|(&other, value)| (other, value / sum.area));
            let slopes = sum.slopes.iter().map(|(&other, slope)| (other, slope / sum.area));
            let at = SurfacePoint {
                position: mesh.nodes[node as usize],
                normal: sum.normal.normalize().into(),
                area: sum.area,
                gap: sum.gap / sum.area,
                own,
                counter: counter.filter(|entry| entry.1 != 0.0).collect(),
                slopes: slopes.collect(),
            };
            MortarNode { node, at, lift }
        })
        .collect()
}

/// Corners at the ends of each edge that has a node at its middle, by this node.
fn corners_of_middles<'a>(
    faces: impl Iterator<Item = &'a BoundaryFace>,
) -> BTreeMap<u32, [u32; 2]> {
    let of_face = |face: &'a BoundaryFace| {
        let middles = face.kind.middles();
        middles.map(|(middle, ends)| (face.nodes[middle], ends.map(|end| face.nodes[end])))
    };
    faces.flat_map(of_face).collect()
}

/// Adds the integrals of one face.
fn add_face(face: &BoundaryFace, points: &[&SegmentPoint], sums: &mut BTreeMap<u32, Sums>) {
    let points = points.iter().map(|point| &point.at);
    let bases = points.clone().map(|point| (point.area, positive_basis(face, point)));
    let bases: Vec<(f64, Vec<f64>)> = bases.collect();
    let Some(weights) = dual_weights(face.nodes.len(), &bases) else { return };
    for (point, weights) in points.zip(weights) {
        for (&node, psi) in face.nodes.iter().zip(weights) {
            let sum = sums.entry(node).or_default();
            sum.area += psi;
            sum.gap += psi * point.gap;
            sum.normal += Vector3::from(point.normal) * psi;
            for &(other, value) in &point.counter {
                *sum.counter.entry(other).or_default() += psi * value;
            }
            for &(other, slope) in &point.slopes {
                *sum.slopes.entry(other).or_default() += slope * psi;
            }
        }
    }
}

/// Shape functions with positive integrals: each corner's with a share of those of its edges' middles.
fn positive_basis(face: &BoundaryFace, point: &SurfacePoint) -> Vec<f64> {
    let mut basis: Vec<f64> = point.own.iter().map(|entry| entry.1).collect();
    for (middle, ends) in face.kind.middles() {
        let value = point.own[middle].1;
        ends.iter().for_each(|&end| basis[end] += CORNER_SHARE * value);
        basis[middle] *= 1.0 - 2.0 * CORNER_SHARE;
    }
    basis
}

impl MortarNode {
    /// `direction . (u_own - u_counter)`, over all dofs; the node's own dofs come first, the largest of them ahead.
    pub fn jump(&self, mesh: &Mesh, direction: [f64; 3]) -> Row {
        let mut row = row_along(mesh, &self.at.own, direction, 1.0);
        let is_own = |dof: usize| dof / mesh.dimension == self.node as usize;
        row.sort_by(|a, b| {
            let key = |entry: &(usize, f64)| (!is_own(entry.0), -entry.1.abs());
            key(a).partial_cmp(&key(b)).expect("coefficients are finite")
        });
        row.extend(row_along(mesh, &self.at.counter, direction, -1.0));
        row
    }
}
