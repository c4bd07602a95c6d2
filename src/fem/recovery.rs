//! Values at nodes from superconvergent points, by patches of elements.

use super::element::ElementGeometry;
use crate::mesh::Mesh;
use nalgebra::{DMatrix, Matrix3, Vector3};

/// Degree of the polynomial that is fitted over a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degree {
    /// Linear.
    Linear,
    /// Complete quadratic where the samples determine it.
    Quadratic,
}

/// Superconvergent patch recovery (Zienkiewicz and Zhu 1992): the value at a node is that of the polynomial that fits the samples of
/// the elements around it best. It is a weighted sum of the samples, whatever they are samples of.
///
/// A node on an edge has elements on one side only; its patch takes in their neighbours too, so that the recovered field is of second
/// order there as well. A patch lies in one region, as stress and strain jump from one material to the next.
pub struct Recovery {
    /// First sample of each element, and their number at last: samples are those of
    /// [`crate::mesh::ElementKind::superconvergent_points`], element by element.
    pub first_sample: Vec<usize>,
    /// What every element of a region takes at its nodes.
    nodes: Vec<Vec<RecoveredNode>>,
}

/// The recovered value at a node, of one of the regions that meet there.
struct RecoveredNode {
    region: usize,
    /// Samples with their weights.
    weights: Vec<(usize, f64)>,
}

impl Recovery {
    /// The weights of every node; in each of the regions that meet there, or in that of its first element alone.
    pub fn new(mesh: &Mesh, degree: Degree, in_each_region: bool) -> Self {
        let mut first_sample = vec![0];
        let mut positions: Vec<[f64; 3]> = Vec::new();
        for e in 0..mesh.element_count() {
            let geometry = ElementGeometry::new(mesh, e);
            let places = mesh.element_kind(e).superconvergent_points().into_iter();
            positions.extend(places.map(|place| geometry.position(&geometry.at((place, 1.0)))));
            first_sample.push(positions.len());
        }
        let around = elements_around(mesh);
        let mut on_edge = vec![false; mesh.node_count()];
        for node in mesh.outer_faces().into_iter().flat_map(|face| face.nodes) {
            on_edge[node as usize] = true;
        }
        let patch_of = |node: usize, region: usize| -> Vec<u32> {
            let in_region = |e: &u32| mesh.region(*e as usize) == region;
            let own = around[node].iter().copied();
            let own: Vec<u32> = own.filter(in_region).collect();
            let is_between = own.len() < around[node].len();
            // A mid-side node has two elements at most: their neighbours complete its patch too.
            if !on_edge[node] && !is_between && own.len() >= 3 {
                return own;
            }
            let corners = own.iter().flat_map(|&e| mesh.element_nodes(e as usize));
            let neighbours = corners.flat_map(|&n| around[n as usize].iter().copied());
            let mut patch: Vec<u32> = neighbours.filter(in_region).collect();
            patch.sort_unstable();
            patch.dedup();
            patch
        };
        let recovered = |node: usize, region: usize| {
            let elements = patch_of(node, region).into_iter().map(|e| e as usize);
            let samples: Vec<usize> =
                elements.flat_map(|e| first_sample[e]..first_sample[e + 1]).collect();
            let places: Vec<[f64; 3]> = samples.iter().map(|&s| positions[s]).collect();
            let weights = weights_at(mesh.nodes[node], &places, degree);
            RecoveredNode { region, weights: samples.into_iter().zip(weights).collect() }
        };
        let nodes = (0..mesh.node_count()).map(|node| {
            let mut regions: Vec<usize> = Vec::new();
            for &e in &around[node] {
                let region = mesh.region(e as usize);
                if !regions.contains(&region) && (in_each_region || regions.is_empty()) {
                    regions.push(region);
                }
            }
            regions.into_iter().map(|r| recovered(node, r)).collect()
        });
        let nodes = nodes.collect();
        Self { first_sample, nodes }
    }

    /// Region of the first element around a node and its weights; `None` for a node without elements.
    pub fn first(&self, node: usize) -> Option<(usize, &[(usize, f64)])> {
        let first = self.nodes[node].first()?;
        Some((first.region, &first.weights))
    }

    /// The regions that meet at a node, each with its weights.
    pub fn at(&self, node: usize) -> impl Iterator<Item = (usize, &[(usize, f64)])> {
        let all = self.nodes[node].iter();
        all.map(|own| (own.region, own.weights.as_slice()))
    }
}

fn elements_around(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut around = vec![Vec::new(); mesh.node_count()];
    for e in 0..mesh.element_count() {
        for &node in mesh.element_nodes(e) {
            around[node as usize].push(e as u32);
        }
    }
    around
}

/// Squared thickness over width below which the samples of a patch lie on a plane or a line: across it the field is constant.
const FLAT: f64 = 1e-4;
/// Eigenvalue of the normal equations, relative to the largest, below which the samples do not determine a term.
const UNDETERMINED: f64 = 1e-6;

/// Weights of the samples in the value at `origin` of the polynomial that fits them best; terms that they do not determine are left
/// out.
fn weights_at(origin: [f64; 3], places: &[[f64; 3]], degree: Degree) -> Vec<f64> {
    let count = places.len() as f64;
    // One sample, of a body or region of one element, is the value everywhere.
    if places.len() == 1 {
        return vec![1.0];
    }
    let centre = places.iter().map(|p| Vector3::from(*p)).sum::<Vector3<f64>>() / count;
    // In the principal axes of the samples, scaled by how far they spread.
    let offsets = places.iter().map(|p| Vector3::from(*p) - centre);
    let spread: Matrix3<f64> = offsets.map(|o| o * o.transpose() / count).sum();
    let eigen = spread.symmetric_eigen();
    let widest = eigen.eigenvalues.max();
    let axes = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
    let axes: Vec<Vector3<f64>> = axes
        .filter(|(spread, _)| **spread > FLAT * widest)
        .map(|(spread, axis)| axis / spread.sqrt())
        .collect();
    let terms = |place: &[f64; 3]| -> Vec<f64> {
        let offset = Vector3::from(*place) - centre;
        let mut terms: Vec<f64> = axes.iter().map(|axis| axis.dot(&offset)).collect();
        if degree == Degree::Quadratic {
            for (i, k) in (0..axes.len()).flat_map(|i| (0..=i).map(move |k| (i, k))) {
                terms.push(terms[i] * terms[k]);
            }
        }
        terms
    };
    // About the means of the terms the slopes are independent of the mean of the samples.
    let rows: Vec<Vec<f64>> = places.iter().map(terms).collect();
    let size = rows.first().map_or(0, Vec::len);
    let means: Vec<f64> =
        (0..size).map(|k| rows.iter().map(|row| row[k]).sum::<f64>() / count).collect();
    let table = DMatrix::from_fn(rows.len(), size, |s, k| rows[s][k] - means[k]);
    let at = terms(&origin);
    let reach = DMatrix::from_fn(1, size, |_, k| at[k] - means[k]);
    let normal = (table.transpose() * &table).symmetric_eigen();
    let largest = normal.eigenvalues.iter().fold(0.0_f64, |m, v| m.max(*v));
    let mut weights = vec![1.0 / count; places.len()];
    let pairs = normal.eigenvalues.iter().zip(normal.eigenvectors.column_iter());
    for (eigenvalue, vector) in pairs.filter(|(value, _)| **value > UNDETERMINED * largest) {
        let slope = (&reach * vector)[0] / eigenvalue;
        let along = &table * vector;
        for (weight, along) in weights.iter_mut().zip(along.iter()) {
            *weight += slope * along;
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_one_sample_of_a_body_of_one_brick_is_the_value_everywhere() {
        for degree in [Degree::Linear, Degree::Quadratic] {
            assert_eq!(weights_at([1.0, 2.0, 3.0], &[[0.5; 3]], degree), [1.0]);
        }
    }
}
