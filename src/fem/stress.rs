//! Stress recovery at the nodes.

use super::element::{ElementGeometry, Voigt, nodal_values};
use super::{ElasticMaterial, MaterialField};
use crate::mesh::{Mesh, SolidSector};
use nalgebra::{Matrix2, Matrix3, Rotation3, SMatrix, Vector3};

/// Stress at one node in the axes of [`Mesh::reported_angle`], Pa.
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

/// Stress `(xx, yy, zz, xy, yz, zx)` at one node of a solid body in global axes, Pa.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolidStress(pub Voigt);

impl SolidStress {
    /// Von Mises stress, Pa.
    pub fn von_mises(&self) -> f64 {
        let [x, y, z, xy, yz, zx] = self.0;
        let normal = (x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2);
        (0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
    }

    /// Hydrostatic pressure `-tr(sigma) / 3`, Pa.
    pub fn pressure(&self) -> f64 {
        -(self.0[0] + self.0[1] + self.0[2]) / 3.0
    }

    /// The components in the axes that are the columns of a rotation, `R^T sigma R`.
    fn turned(&self, axes: &Matrix3<f64>) -> Self {
        let [x, y, z, xy, yz, zx] = self.0;
        let global = Matrix3::new(x, xy, zx, xy, y, yz, zx, yz, z);
        let own = axes.transpose() * global * axes;
        let of = |row: usize, column: usize| own[(row, column)];
        Self([of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(1, 2), of(2, 0)])
    }
}

/// Stress at each node of a plane body by superconvergent patch recovery (Zienkiewicz and Zhu 1992).
///
/// At each node the linear polynomial that fits the stress best at the superconvergent points (see
/// [`crate::mesh::ElementKind::superconvergent_points`]) of the elements around it is evaluated at the
/// node. A node on an edge has elements on one side only; its patch takes in their neighbours too, so that
/// the recovered stress is of second order there as well.
///
/// `displacement` has `2 * node_count` values in nodal frames, m.
pub fn nodal_stress(
    mesh: &Mesh,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<NodalStress> {
    let recovered = recovered_stress(mesh, material, displacement);
    let nodes = recovered.into_iter().enumerate();
    nodes
        .map(|(node, found)| match found {
            Some((stress, region)) => {
                in_frame(stress, mesh.reported_angle(node), material.of(region))
            }
            None => NodalStress::default(),
        })
        .collect()
}

/// Stress at each node of a solid body, recovered as [`nodal_stress`] does.
///
/// `displacement` has `3 * node_count` values in nodal frames, m.
pub fn solid_stress(
    mesh: &Mesh,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<SolidStress> {
    let recovered = recovered_stress(mesh, material, displacement).into_iter();
    recovered
        .map(|found| found.map_or_else(SolidStress::default, |(stress, _)| SolidStress(stress)))
        .collect()
}

/// Stress at each node of a body of revolution in its nodal frames, components `(rr, tt, zz, rt, tz, zr)`, recovered as
/// [`nodal_stress`] does.
///
/// `displacement` has `3 * node_count` values in nodal frames for each sector, m: those of all sectors, or of one that all others
/// repeat, which then is what is found.
pub fn revolved_stress(
    sector: &SolidSector,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> Vec<SolidStress> {
    let per_sector = sector.node_count();
    let given = displacement.len() / (3 * per_sector);
    // The patch of a node reaches two elements far: of a state that repeats the middle one of five sectors is as any other.
    let count = match given {
        1 => sector.sector_count().min(5),
        _ => given,
    };
    let mesh = sector.part(count);
    let frames: Vec<Rotation3<f64>> = (0..mesh.node_count())
        .map(|node| sector.angle(node % per_sector, node / per_sector))
        .map(|angle| Rotation3::from_axis_angle(&Vector3::z_axis(), angle))
        .collect();
    let of_node = |node: usize| &displacement[3 * node % displacement.len()..][..3];
    let cartesian: Vec<f64> = frames
        .iter()
        .enumerate()
        .flat_map(|(node, frame)| {
            let [x, y, z] = (frame * Vector3::from_column_slice(of_node(node))).into();
            [x, y, z]
        })
        .collect();
    let found = solid_stress(&mesh, material, &cartesian);
    let shown = match given {
        1 => count / 2 * per_sector..(count / 2 + 1) * per_sector,
        _ => 0..given * per_sector,
    };
    shown
        .map(|node| found[node].turned(frames[node].matrix()))
        .collect()
}

/// Recovered stress at each node in global axes and the region whose material it is of; `None` for a node without elements.
fn recovered_stress(
    mesh: &Mesh,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<Option<(Voigt, usize)>> {
    let samples: Vec<Vec<Sample>> = (0..mesh.element_count())
        .map(|e| superconvergent_samples(mesh, e, material.of(mesh.region(e)), displacement))
        .collect();
    let around = elements_around(mesh);
    let mut on_edge = vec![false; mesh.node_count()];
    for face in mesh.outer_faces() {
        for node in face.nodes {
            on_edge[node as usize] = true;
        }
    }
    (0..mesh.node_count())
        .map(|node| {
            let &first = around[node].first()?;
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
            let points: Vec<&Sample> = patch.iter().flat_map(|&e| &samples[e as usize]).collect();
            let stress = match mesh.dimension {
                2 => fit_in_plane(mesh.nodes[node], &points),
                _ => fit_in_space(mesh.nodes[node], &points),
            };
            Some((stress, region))
        })
        .collect()
}

/// Stress in global axes at a point, Pa, m.
struct Sample {
    position: [f64; 3],
    stress: Voigt,
}

fn superconvergent_samples(
    mesh: &Mesh,
    e: usize,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> Vec<Sample> {
    let geometry = ElementGeometry::new(mesh, e);
    let places = mesh.element_kind(e).superconvergent_points().into_iter();
    let points: Vec<_> = places.map(|place| geometry.at((place, 1.0))).collect();
    let stresses = geometry.stresses(&points, material, &nodal_values(mesh, e, displacement));
    let pairs = points.iter().zip(stresses);
    pairs
        .map(|(point, stress)| Sample {
            position: geometry.position(point),
            stress,
        })
        .collect()
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

/// Largest distance of the samples from a point along an axis.
fn size_of(origin: [f64; 3], samples: &[&Sample]) -> f64 {
    let offsets = samples.iter().flat_map(|sample| {
        let pairs = sample.position.into_iter().zip(origin);
        pairs.map(|(p, o)| (p - o).abs())
    });
    offsets.fold(0.0_f64, f64::max)
}

/// Value at `origin` of the linear polynomial that fits the samples best, their mean where they do not
/// determine one (a single row of elements).
fn fit_in_plane(origin: [f64; 3], samples: &[&Sample]) -> Voigt {
    let size = size_of(origin, samples);
    let (mut normal, mut right) = (Matrix3::zeros(), SMatrix::<f64, 3, 6>::zeros());
    for sample in samples {
        let offset = |axis: usize| (sample.position[axis] - origin[axis]) / size;
        let basis = Vector3::new(1.0, offset(0), offset(1));
        normal += basis * basis.transpose();
        right += basis * SMatrix::<f64, 1, 6>::from(sample.stress);
    }
    // Relative to the sample count the determinant is of order 0.01 for any patch of two rows.
    let count = samples.len() as f64;
    let is_determined = normal.determinant() > 1e-9 * count.powi(3);
    match normal.cholesky().filter(|_| is_determined) {
        Some(factor) => {
            let values = factor.solve(&right);
            std::array::from_fn(|k| values[(0, k)])
        }
        None => mean(samples),
    }
}

/// As [`fit_in_plane`], with a polynomial in three coordinates. The samples of a patch one element thick lie on a plane: across it the
/// stress is taken as constant.
fn fit_in_space(origin: [f64; 3], samples: &[&Sample]) -> Voigt {
    // About the centre of the samples the slope is independent of the mean.
    let count = samples.len() as f64;
    let sum: Vector3<f64> = samples.iter().map(|s| Vector3::from(s.position)).sum();
    let centre = sum / count;
    let middle = mean(samples);
    let (mut normal, mut right) = (Matrix3::zeros(), SMatrix::<f64, 3, 6>::zeros());
    for sample in samples {
        let offset = Vector3::from(sample.position) - centre;
        normal += offset * offset.transpose();
        right += offset * SMatrix::<f64, 1, 6>::from(sample.stress);
    }
    let eigen = normal.symmetric_eigen();
    let widest = eigen.eigenvalues.max();
    let reach = Vector3::from(origin) - centre;
    let mut value = middle;
    for (spread, axis) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        if *spread > FLAT * widest {
            let slope = axis.transpose() * right / *spread;
            (0..6).for_each(|k| value[k] += axis.dot(&reach) * slope[k]);
        }
    }
    value
}

/// Squared thickness over width below which the samples of a patch lie on a plane.
const FLAT: f64 = 1e-4;

fn mean(samples: &[&Sample]) -> Voigt {
    let mut sum = [0.0; 6];
    for sample in samples {
        (0..6).for_each(|k| sum[k] += sample.stress[k]);
    }
    sum.map(|component| component / samples.len() as f64)
}

fn in_frame(stress: Voigt, angle: f64, material: &ElasticMaterial) -> NodalStress {
    let (sin, cos) = angle.sin_cos();
    let frame = Matrix2::new(cos, -sin, sin, cos);
    let global = Matrix2::new(stress[0], stress[3], stress[3], stress[1]);
    let local = frame.transpose() * global * frame;
    let (radial, hoop) = (local[(0, 0)], local[(1, 1)]);
    NodalStress {
        radial,
        hoop,
        shear: local[(0, 1)],
        axial: material
            .out_of_plane_stress(radial, hoop)
            .unwrap_or(stress[2]),
    }
}
