//! The base state of an assembly of solid bodies, point by point.

use crate::contact::{ContactSite, ContactStatus};
use crate::mesh::Mesh;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::table::{Column, write_rows};
use crate::results::vtu::{EncodedMesh, Field, write_vtu};

/// A contact point in the base state.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyPoint {
    /// Name of its contact.
    pub contact: String,
    /// Where it is, and its directions.
    pub site: ContactSite,
    /// Area that belongs to it, m2.
    pub area: f64,
    /// Contact pressure, Pa.
    pub pressure: f64,
    /// Friction traction, Pa.
    pub shear: f64,
    /// Whether it is closed.
    pub is_closed: bool,
    /// Sliding speed, m/s.
    pub speed: f64,
    /// Nodes of the surface that it is among, with their shares in it.
    pub shares: Vec<(u32, f64)>,
}

/// The base state of an assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AssemblyReport {
    /// The points of all contacts.
    pub points: Vec<AssemblyPoint>,
    /// Displacement of every node in nodal frames, `3 * node_count` values, m.
    pub displacement: Vec<f64>,
}

impl AssemblyReport {
    /// Writes `prestress.csv` (contact points) and `prestress.vtu` (displacement; pressure, traction and closed share of the
    /// points around each node of a contact surface, zero elsewhere).
    ///
    /// # Errors
    /// Those of the folder.
    pub fn write_base(&self, folder: &OutputFolder, mesh: &Mesh) -> Result<(), FolderError> {
        folder.write("prestress.csv", |out| {
            let columns: &[Column<'_, &AssemblyPoint>] = &[
                ("contact", &|point| point.contact.as_str().into()),
                ("x_m", &|point| point.site.position[0].into()),
                ("y_m", &|point| point.site.position[1].into()),
                ("z_m", &|point| point.site.position[2].into()),
                ("area_m2", &|point| point.area.into()),
                ("pressure_pa", &|point| point.pressure.into()),
                ("shear_pa", &|point| point.shear.into()),
                ("status", &|point| {
                    let status = [ContactStatus::Open, ContactStatus::Slip];
                    status[usize::from(point.is_closed)].name().into()
                }),
            ];
            write_rows(out, columns, &self.points)
        })?;
        let around = |value: fn(&AssemblyPoint) -> f64| self.around_nodes(mesh, value);
        let fields = [
            Field::vectors("displacement_m", mesh, &self.displacement),
            Field::scalars("pressure_pa", around(|point| point.pressure)),
            Field::scalars("shear_pa", around(|point| point.shear)),
            Field::scalars(
                "closed_share",
                around(|point| f64::from(u8::from(point.is_closed))),
            ),
        ];
        folder.write_bulk("prestress.vtu", |out| {
            write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &[])
        })?;
        Ok(())
    }

    /// Mean over the points around each node, weighted by area and share.
    fn around_nodes(&self, mesh: &Mesh, value: fn(&AssemblyPoint) -> f64) -> Vec<f64> {
        let mut sums = vec![[0.0; 2]; mesh.node_count()];
        for point in &self.points {
            for &(node, share) in &point.shares {
                // Shape functions of corners of quadratic faces may be negative.
                let weight = point.area * share.abs();
                sums[node as usize][0] += weight * value(point);
                sums[node as usize][1] += weight;
            }
        }
        let mean = |[sum, weight]: [f64; 2]| if weight > 0.0 { sum / weight } else { 0.0 };
        sums.into_iter().map(mean).collect()
    }
}
