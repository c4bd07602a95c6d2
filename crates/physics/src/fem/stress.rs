//! Stress recovery at the nodes.

use super::MaterialField;
use super::element::{ElementGeometry, Voigt, nodal_values, tensor};
use super::orthotropy::PAIRS;
use super::recovery::{Degree, Recovery};
use crate::mesh::{Mesh, SolidSector};
use nalgebra::{Matrix3, Rotation3, Vector3};

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
        let (a, b, c) = (self.radial - self.hoop, self.hoop - self.axial, self.axial - self.radial);
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
        let own = axes.transpose() * tensor(&self.0) * axes;
        Self(PAIRS.map(|at| own[at]))
    }
}

/// Stress at each node of a plane body by superconvergent patch recovery (Zienkiewicz and Zhu 1992).
///
/// At each node the linear polynomial that fits the stress best at the superconvergent points (see
/// [`crate::mesh::ElementKind::superconvergent_points`]) of the elements around it is evaluated at the node. A node on an edge has elements
/// on one side only; its patch takes in their neighbours too, so that the recovered stress is of second order there as well.
///
/// `displacement` has `2 * node_count` values in nodal frames, m.
pub fn nodal_stress(
    mesh: &Mesh,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<NodalStress> {
    let nodes = recovered_stress(mesh, material, displacement).into_iter().enumerate();
    let in_frame = |(node, found)| {
        let frame = Rotation3::from_axis_angle(&Vector3::z_axis(), mesh.reported_angle(node));
        let [radial, hoop, axial, shear, ..] = SolidStress(found).turned(frame.matrix()).0;
        NodalStress { radial, hoop, shear, axial }
    };
    nodes.map(in_frame).collect()
}

/// Stress at each node of a solid body, recovered as [`nodal_stress`] does.
///
/// `displacement` has `3 * node_count` values in nodal frames, m.
pub fn solid_stress(
    mesh: &Mesh,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<SolidStress> {
    recovered_stress(mesh, material, displacement).into_iter().map(SolidStress).collect()
}

/// Stress at each node of a body of revolution in its nodal frames, components `(rr, tt, zz, rt, tz, zr)`, recovered as
/// [`nodal_stress`] does.
///
/// `displacement` has `3 * node_count` values in nodal frames for each sector, m: those of all sectors, or of one that all others
/// repeat, which then is what is found.
pub fn revolved_stress(
    sector: &SolidSector,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> Vec<SolidStress> {
    let per_sector = sector.node_count();
    let given = displacement.len() / (3 * per_sector);
    // The patch of a node reaches two elements far: of a state that repeats the middle one of five sectors is as any other.
    let count = if given == 1 { sector.sector_count().min(5) } else { given };
    let mesh = sector.part(count);
    let all: Vec<f64> = displacement.iter().copied().cycle().take(mesh.dof_count()).collect();
    let found = solid_stress(&mesh, material, &all);
    let shown = match given {
        1 => count / 2 * per_sector..(count / 2 + 1) * per_sector,
        _ => 0..given * per_sector,
    };
    shown.map(|node| found[node].turned(&mesh.frame(node))).collect()
}

/// Recovered stress at each node in global axes, of the first element's material where several meet; none of a node without elements.
fn recovered_stress(mesh: &Mesh, material: &dyn MaterialField, displacement: &[f64]) -> Vec<Voigt> {
    let recovery = Recovery::new(mesh, Degree::Linear, false);
    let samples: Vec<Voigt> = (0..mesh.element_count())
        .flat_map(|e| {
            let geometry = ElementGeometry::new(mesh, e);
            let places = recovery.places(e).iter();
            let points: Vec<_> = places.map(|place| geometry.at((*place, 1.0))).collect();
            let values = nodal_values(mesh, e, displacement);
            geometry.stresses(&points, material.of(mesh.region(e)), &values)
        })
        .collect();
    let stress = |node: usize| {
        let mut sum = [0.0; 6];
        for (sample, weight) in recovery.first(node) {
            (0..6).for_each(|k| sum[k] += weight * samples[*sample][k]);
        }
        sum
    };
    (0..mesh.node_count()).map(stress).collect()
}
