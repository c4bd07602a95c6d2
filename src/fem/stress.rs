//! Stress recovery at the nodes.

use super::element::{ElementGeometry, stress_of};
use super::{ElasticMaterial, MaterialField};
use crate::mesh::Mesh2d;
use nalgebra::{Matrix2, Matrix3, Vector3};

/// Stress at one node in the axes of [`Mesh2d::reported_angle`], Pa.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodalStress {
    /// Along the first frame axis (radial on the annulus).
    pub radial: f64,
    /// Along the second (circumferential on the annulus).
    pub hoop: f64,
    /// Shear `sigma_12`.
    pub shear: f64,
    /// Out of plane.
    pub axial: f64,
}

impl NodalStress {
    /// Von Mises stress, Pa.
    pub fn von_mises(&self) -> f64 {
        let (a, b, c) = (
            self.radial - self.hoop,
            self.hoop - self.axial,
            self.axial - self.radial,
        );
        (0.5 * (a * a + b * b + c * c) + 3.0 * self.shear * self.shear).sqrt()
    }

    /// Hydrostatic pressure `-tr(sigma) / 3`, Pa.
    pub fn pressure(&self) -> f64 {
        -(self.radial + self.hoop + self.axial) / 3.0
    }
}

/// Stress at each node by superconvergent patch recovery (Zienkiewicz and Zhu 1992).
///
/// At each node the linear polynomial that fits the stress best at the superconvergent points (see
/// [`crate::mesh::ElementKind::superconvergent_points`]) of the elements around it is evaluated at the
/// node. A node on an edge has elements on one side only; its patch takes in their neighbours too, so that
/// the recovered stress is of second order there as well.
///
/// `displacement` has `2 * node_count` values in nodal frames, m.
pub fn nodal_stress(
    mesh: &Mesh2d,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<NodalStress> {
    let samples: Vec<Vec<Sample>> = (0..mesh.element_count())
        .map(|e| superconvergent_samples(mesh, e, material.of(mesh.region(e)), displacement))
        .collect();
    let around = elements_around(mesh);
    let mut on_edge = vec![false; mesh.node_count()];
    for (start, end, middle) in mesh.outline_edges() {
        for node in [start, end].into_iter().chain(middle) {
            on_edge[node as usize] = true;
        }
    }
    (0..mesh.node_count())
        .map(|node| {
            let Some(&first) = around[node].first() else {
                return NodalStress::default();
            };
            // Stress jumps from one material to the next: a node between two shows that of the first.
            let region = mesh.region(first as usize);
            let mut patch = around[node].clone();
            // A mid-side node has two elements at most: their neighbours complete its patch too.
            if on_edge[node] || patch.len() < 3 {
                let corners = patch.iter().flat_map(|&e| mesh.element_nodes(e as usize));
                let neighbours = corners.flat_map(|&n| around[n as usize].iter().copied());
                patch = neighbours.collect();
                patch.sort_unstable();
                patch.dedup();
            }
            patch.retain(|&e| mesh.region(e as usize) == region);
            let points = patch.iter().flat_map(|&e| &samples[e as usize]);
            let stress = fit_at(mesh.nodes[node], points);
            in_frame(stress, mesh.reported_angle(node), material.of(region))
        })
        .collect()
}

/// Stress `(xx, yy, xy)` in global axes at a point, Pa, m.
struct Sample {
    position: [f64; 2],
    stress: Vector3<f64>,
}

fn superconvergent_samples(
    mesh: &Mesh2d,
    e: usize,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> Vec<Sample> {
    let geometry = ElementGeometry::new(mesh, e);
    mesh.element_kind(e)
        .superconvergent_points()
        .into_iter()
        .map(|(xi, eta)| {
            let point = geometry.at(xi, eta, 1.0);
            let gradient = geometry.displacement_gradient(&point, displacement);
            let stress = stress_of(material, &gradient);
            let mut position = [0.0; 2];
            for (&node, shape) in mesh.element_nodes(e).iter().zip(&point.values) {
                for (sum, coordinate) in position.iter_mut().zip(mesh.nodes[node as usize]) {
                    *sum += shape * coordinate;
                }
            }
            Sample {
                position,
                stress: Vector3::new(stress[(0, 0)], stress[(1, 1)], stress[(0, 1)]),
            }
        })
        .collect()
}

fn elements_around(mesh: &Mesh2d) -> Vec<Vec<u32>> {
    let mut around = vec![Vec::new(); mesh.node_count()];
    for e in 0..mesh.element_count() {
        for &node in mesh.element_nodes(e) {
            around[node as usize].push(e as u32);
        }
    }
    around
}

/// Value at `origin` of the linear polynomial that fits the samples best, their mean where they do not
/// determine one (a single row of elements).
fn fit_at<'a>(origin: [f64; 2], samples: impl Iterator<Item = &'a Sample>) -> Vector3<f64> {
    let samples: Vec<&Sample> = samples.collect();
    let offset = |sample: &Sample, axis: usize| sample.position[axis] - origin[axis];
    let size = samples
        .iter()
        .flat_map(|sample| [offset(sample, 0).abs(), offset(sample, 1).abs()])
        .fold(0.0_f64, f64::max);
    let (mut normal, mut right) = (Matrix3::zeros(), Matrix3::zeros());
    for sample in &samples {
        let basis = Vector3::new(1.0, offset(sample, 0) / size, offset(sample, 1) / size);
        normal += basis * basis.transpose();
        right += basis * sample.stress.transpose();
    }
    // Relative to the sample count the determinant is of order 0.01 for any patch of two rows.
    let count = samples.len() as f64;
    let is_determined = normal.determinant() > 1e-9 * count.powi(3);
    match normal.cholesky().filter(|_| is_determined) {
        Some(factor) => factor.solve(&right).row(0).transpose(),
        None => {
            samples
                .iter()
                .map(|sample| sample.stress)
                .sum::<Vector3<f64>>()
                / count
        }
    }
}

fn in_frame(stress: Vector3<f64>, angle: f64, material: &ElasticMaterial) -> NodalStress {
    let (sin, cos) = angle.sin_cos();
    let frame = Matrix2::new(cos, -sin, sin, cos);
    let global = Matrix2::new(stress[0], stress[2], stress[2], stress[1]);
    let local = frame.transpose() * global * frame;
    let (radial, hoop) = (local[(0, 0)], local[(1, 1)]);
    NodalStress {
        radial,
        hoop,
        shear: local[(0, 1)],
        axial: material.out_of_plane_stress(radial, hoop),
    }
}
