//! The base state of an assembly of solid bodies, point by point.

use crate::chart::{Axis, ChartError, Figure};
use crate::contact::{ContactSite, ContactStatus};
use crate::fem::SolidStress;
use crate::mesh::Mesh;
use crate::results::charts::contact_surfaces;
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
    /// Each contact with the boundary that has its points.
    pub surfaces: Vec<(String, usize)>,
    /// Displacement of every node in nodal frames, `3 * node_count` values, m.
    pub displacement: Vec<f64>,
    /// Stress at every node in global axes.
    pub stress: Vec<SolidStress>,
}

impl AssemblyReport {
    /// Writes `prestress.csv` (contact points) and `prestress.vtu` (displacement and stress; pressure, traction and closed share
    /// of the points around each node of a contact surface, zero elsewhere).
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
        let mut fields = vec![
            Field::vectors("displacement_m", mesh, &self.displacement),
            Field::scalars("pressure_pa", around(|point| point.pressure)),
            Field::scalars("shear_pa", around(|point| point.shear)),
            Field::scalars(
                "closed_share",
                around(|point| f64::from(u8::from(point.is_closed))),
            ),
        ];
        fields.extend(Field::solid_stresses(&self.stress, "xyz"));
        folder.write_bulk("prestress.vtu", |out| {
            write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &[])
        })?;
        Ok(())
    }

    /// Whether no contact point presses: the closed state of an analysis without prestress.
    pub(super) fn is_free_of_stress(&self) -> bool {
        self.points.iter().all(|point| point.pressure == 0.0)
    }

    /// Pressure on each contact surface, seen from outside along its mean normal; grey where it is open.
    ///
    /// # Errors
    /// [`ChartError::Empty`] for a base state that is free of stress.
    pub(super) fn prestress(&self, mesh: &Mesh) -> Result<Figure, ChartError> {
        if self.is_free_of_stress() {
            return Err(ChartError::empty(
                "pressure of contacts that are free of stress",
            ));
        }
        let pressures = self.around_nodes(mesh, |point| point.pressure);
        let closed = self.around_nodes(mesh, |point| f64::from(u8::from(point.is_closed)));
        let nodes = pressures.iter().zip(&closed);
        let values: Vec<f64> = nodes
            .map(|(&pressure, &closed)| if closed > 0.0 { pressure } else { f64::NAN })
            .collect();
        let largest = pressures.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let axis = || {
            Axis::new("contact pressure", "Pa")
                .prefixed()
                .between(0.0, largest)
        };
        let caption = "Contact pressure in the base state on each contact surface, seen from outside; grey where it is open.";
        let surfaces = (mesh, &self.surfaces[..]);
        Ok(contact_surfaces(
            ("prestress", caption),
            surfaces,
            &values,
            &axis,
        ))
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
