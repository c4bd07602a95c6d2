//! Values at nodes from superconvergent points, by patches of elements.

use super::element::ElementGeometry;
use crate::linalg::dense::add;
use crate::mesh::{ElementKind, Mesh};
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
///
/// Bricks with 8 nodes have one superconvergent point, and those of a single layer all lie on a plane: they say nothing of the change
/// across it. Their incompatible modes make strains linear in the element, so that they are sampled on either side of the middle, too.
pub struct Recovery {
    /// First sample of each element, and their number at last: samples are those of [`Self::places`], element by element.
    pub first_sample: Vec<usize>,
    /// Places of the samples in the parent element.
    places: Vec<[f64; 3]>,
    /// What every element of a region takes at its nodes: of each the regions that meet there, with samples and their weights.
    nodes: Vec<Vec<(usize, Weights)>>,
}

/// Samples with their weights in a recovered value.
pub type Weights = Vec<(usize, f64)>;

impl Recovery {
    /// The weights of every node; in each of the regions that meet there, or in that of its first element alone.
    pub fn new(mesh: &Mesh, degree: Degree, in_each_region: bool) -> Self {
        let patches = patches(mesh, in_each_region);
        // Bricks of patches in one layer have samples off their middle.
        let middles = Samples::of(mesh, &vec![None; mesh.element_count()]);
        let is_brick = |e: u32| mesh.element_kind(e as usize) == ElementKind::Hex8;
        let is_layer = |patch: &[u32]| {
            patch.iter().any(|&e| is_brick(e)) && is_flat(&middles.positions_in(patch))
        };
        let mut across = vec![None; mesh.element_count()];
        for (_, patch) in patches.iter().flatten().filter(|(_, patch)| is_layer(patch)) {
            let normal = normal_of(&middles.positions_in(patch));
            for &e in patch.iter().filter(|e| is_brick(**e)) {
                across[e as usize] = Some(axis_along(mesh, e as usize, normal));
            }
        }
        let samples = Samples::of(mesh, &across);
        let recovered = |node: usize, region: usize, patch: &[u32]| {
            let is_layer = is_layer(patch);
            // Patches beside a layer keep to the middles of its bricks.
            let of_element = |&e: &u32| {
                let all = samples.first[e as usize]..samples.first[e as usize + 1];
                match across[e as usize].is_some() && !is_layer {
                    true => all.start..all.start + 1,
                    false => all,
                }
            };
            let own: Vec<usize> = patch.iter().flat_map(of_element).collect();
            let places: Vec<[f64; 3]> = own.iter().map(|&s| samples.positions[s]).collect();
            let thinnest = if is_layer { ROUND_OFF } else { FLAT };
            let weights = weights_at(mesh.nodes[node], &places, degree, thinnest);
            (region, own.into_iter().zip(weights).collect())
        };
        let nodes = crate::parallel::map(patches.iter().enumerate(), |(node, patches)| {
            patches.iter().map(|(region, patch)| recovered(node, *region, patch)).collect()
        });
        Self { nodes, first_sample: samples.first, places: samples.places }
    }

    /// Where the samples of an element are, in its parent element.
    pub fn places(&self, element: usize) -> &[[f64; 3]] {
        &self.places[self.first_sample[element]..self.first_sample[element + 1]]
    }

    /// The weights of the region of the first element around a node; none for a node without elements.
    pub fn first(&self, node: usize) -> &[(usize, f64)] {
        self.nodes[node].first().map_or(&[], |(_, weights)| weights)
    }

    /// The regions that meet at a node, each with its weights.
    pub fn at(&self, node: usize) -> &[(usize, Weights)] {
        &self.nodes[node]
    }
}

/// Samples element by element.
struct Samples {
    first: Vec<usize>,
    places: Vec<[f64; 3]>,
    positions: Vec<[f64; 3]>,
}

impl Samples {
    /// The superconvergent points, and two off the middle along the axis that leads `across` a layer.
    fn of(mesh: &Mesh, across: &[Option<usize>]) -> Self {
        let mut all = Self { first: vec![0], places: Vec::new(), positions: Vec::new() };
        for (e, across) in across.iter().enumerate() {
            let geometry = ElementGeometry::new(mesh, e);
            all.places.extend(mesh.element_kind(e).superconvergent_points());
            for side in [-0.5, 0.5] {
                all.places.extend(across.map(|axis| {
                    let mut place = [0.0; 3];
                    place[axis] = side;
                    place
                }));
            }
            let own = all.places[all.positions.len()..].iter();
            all.positions.extend(own.map(|place| geometry.position(&geometry.at((*place, 1.0)))));
            all.first.push(all.positions.len());
        }
        all
    }

    fn positions_in(&self, patch: &[u32]) -> Vec<[f64; 3]> {
        let elements = patch.iter().map(|&e| e as usize);
        elements.flat_map(|e| &self.positions[self.first[e]..self.first[e + 1]]).copied().collect()
    }
}

/// The patches of each node: a region that meets there, and its elements whose samples tell the value.
fn patches(mesh: &Mesh, in_each_region: bool) -> Vec<Vec<(usize, Vec<u32>)>> {
    let around = elements_around(mesh);
    let mut on_edge = vec![false; mesh.node_count()];
    for node in mesh.outer_faces().into_iter().flat_map(|face| face.nodes) {
        on_edge[node as usize] = true;
    }
    let patch_of = |node: usize, region: usize| -> Vec<u32> {
        let in_region = |e: &u32| mesh.region(*e as usize) == region;
        let own: Vec<u32> = around[node].iter().copied().filter(in_region).collect();
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
    (0..mesh.node_count())
        .map(|node| {
            let mut regions: Vec<usize> = Vec::new();
            for &e in &around[node] {
                let region = mesh.region(e as usize);
                if !regions.contains(&region) && (in_each_region || regions.is_empty()) {
                    regions.push(region);
                }
            }
            regions.into_iter().map(|region| (region, patch_of(node, region))).collect()
        })
        .collect()
}

fn elements_around(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut around = vec![Vec::new(); mesh.node_count()];
    for e in 0..mesh.element_count() {
        mesh.element_nodes(e).iter().for_each(|&node| around[node as usize].push(e as u32));
    }
    around
}

/// Squared thickness over width below which the samples of a patch lie on a plane or a line: across it the field is constant.
const FLAT: f64 = 1e-4;
/// The same where elements are sampled across their thickness: what lies below is round-off.
const ROUND_OFF: f64 = 1e-12;
/// Eigenvalue of the normal equations, relative to the largest, below which a term would magnify what samples are wrong by tenfold.
const UNDETERMINED: f64 = 1e-2;

/// Whether places lie on a plane or a line.
fn is_flat(places: &[[f64; 3]]) -> bool {
    let (_, spread) = spread_of(places);
    let spreads = spread.symmetric_eigenvalues();
    spreads.min() <= FLAT * spreads.max()
}

/// The direction in which places spread least.
fn normal_of(places: &[[f64; 3]]) -> Vector3<f64> {
    let eigen = spread_of(places).1.symmetric_eigen();
    eigen.eigenvectors.column(eigen.eigenvalues.imin()).into_owned()
}

/// The axis of the parent element that leads most nearly along a direction.
fn axis_along(mesh: &Mesh, element: usize, direction: Vector3<f64>) -> usize {
    let geometry = ElementGeometry::new(mesh, element);
    let position = |place: [f64; 3]| Vector3::from(geometry.position(&geometry.at((place, 1.0))));
    let along = [0, 1, 2].map(|axis| {
        let mut place = [0.0; 3];
        place[axis] = 0.5;
        let edge = position(place) - position(place.map(|x| -x));
        edge.normalize().dot(&direction).abs()
    });
    (0..3).max_by(|&a, &b| along[a].total_cmp(&along[b])).unwrap_or(0)
}

/// Mean of some places and their second moments about it.
fn spread_of(places: &[[f64; 3]]) -> (Vector3<f64>, Matrix3<f64>) {
    let count = places.len() as f64;
    let centre = places.iter().map(|p| Vector3::from(*p)).sum::<Vector3<f64>>() / count;
    let offsets = places.iter().map(|p| Vector3::from(*p) - centre);
    (centre, offsets.map(|o| o * o.transpose() / count).sum())
}

/// Weights of the samples in the value at `origin` of the polynomial that fits them best; terms that they do not determine are left
/// out, and directions whose squared spread, over the largest, is below `thinnest`.
fn weights_at(origin: [f64; 3], places: &[[f64; 3]], degree: Degree, thinnest: f64) -> Vec<f64> {
    let count = places.len() as f64;
    // In the principal axes of the samples, scaled by how far they spread.
    let (centre, spread) = spread_of(places);
    let eigen = spread.symmetric_eigen();
    let widest = eigen.eigenvalues.max();
    let axes = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
    let axes: Vec<Vector3<f64>> = axes
        .filter(|(spread, _)| **spread > thinnest * widest)
        .map(|(spread, axis)| axis / spread.sqrt())
        .collect();
    // Samples at one place, as the one of a body of one element, have their mean as value everywhere.
    if axes.is_empty() {
        return vec![1.0 / count; places.len()];
    }
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
        add(&mut weights, slope, (&table * vector).as_slice());
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_at_one_place_have_their_mean_as_value_everywhere() {
        for degree in [Degree::Linear, Degree::Quadratic] {
            assert_eq!(weights_at([1.0, 2.0, 3.0], &[[0.5; 3]], degree, FLAT), [1.0]);
            assert_eq!(weights_at([1.0, 2.0, 3.0], &[[0.5; 3]; 2], degree, FLAT), [0.5; 2]);
        }
    }
}
