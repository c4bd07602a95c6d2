//! The base state of an assembly of solid bodies, point by point.

use super::base::{STATUS, TRACTIONS};
use crate::charts::contact_surfaces;
use crate::vtu::Field;
use frictionsim_chart::{Axis, Figure};
use frictionsim_output::{Table, columns};
use frictionsim_physics::contact::ContactSite;
use frictionsim_physics::fem::SolidStress;
use frictionsim_physics::mesh::Mesh;
use nalgebra::Vector3;

/// Half the length of the arrow of the sliding over the size of its surface.
const ARROW: f64 = 0.15;

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

columns! {
    /// A contact point of solid bodies.
    pub(crate) POINTS: point as AssemblyPoint;
    contact: "name of the contact, of solid bodies" = point.contact.clone();
    x_m: "place of the contact point" = point.site.position[0];
    y_m: "place of the contact point" = point.site.position[1];
    z_m: "place of the contact point" = point.site.position[2];
    area_m2: "area that belongs to it" = point.area;
}

impl AssemblyReport {
    /// The contact points.
    pub(super) fn table(&self) -> Table {
        let points = || self.points.iter();
        Table::new("prestress.csv", "")
            .columns(POINTS, points())
            .columns(TRACTIONS, points().map(|point| (point.pressure, point.shear)))
            .columns(STATUS, points().map(|point| point.is_closed))
    }

    /// Displacement and stress of all nodes; pressure, traction and closed share of the points around each node of a
    /// contact surface, zero elsewhere.
    pub(super) fn fields(&self, mesh: &Mesh) -> Vec<Field> {
        let around = |value: fn(&AssemblyPoint) -> f64| self.around_nodes(mesh, value);
        let mut fields = vec![
            Field::vectors("displacement_m", mesh, &self.displacement),
            Field::scalars("pressure_pa", around(|point| point.pressure)),
            Field::scalars("shear_pa", around(|point| point.shear)),
            Field::scalars("closed_share", around(|point| f64::from(u8::from(point.is_closed)))),
        ];
        fields.extend(Field::solid_stresses(&self.stress, "xyz"));
        fields
    }

    /// Whether no contact point presses: the closed state of an analysis without prestress.
    pub(super) fn is_free_of_stress(&self) -> bool {
        self.points.iter().all(|point| point.pressure == 0.0)
    }

    /// A traction on each contact surface, seen from outside along its mean normal, with the sliding over it; grey
    /// where it is open.
    pub(super) fn traction(
        &self,
        mesh: &Mesh,
        (name, what): (&str, &'static str),
        value: fn(&AssemblyPoint) -> f64,
    ) -> Option<Figure> {
        if self.is_free_of_stress() {
            return None;
        }
        let tractions = self.around_nodes(mesh, value);
        let closed = self.around_nodes(mesh, |point| f64::from(u8::from(point.is_closed)));
        let nodes = tractions.iter().zip(&closed);
        let values: Vec<f64> = nodes
            .map(|(&traction, &closed)| if closed > 0.0 { traction } else { f64::NAN })
            .collect();
        let largest = tractions.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let axis = || Axis::new(what, "Pa").prefixed().between(0.0, largest);
        let caption = format!(
            "Base state: {what} on each contact surface, seen from outside; grey where it is open. \
            The other surface slides \
             over it along the arrow."
        );
        let arrows = self.surfaces.iter().map(|(contact, _)| self.arrow(contact));
        let arrows: Vec<[[f64; 3]; 2]> = arrows.collect();
        let surfaces = (mesh, &self.surfaces[..]);
        Some(contact_surfaces((name, &caption), surfaces, (&values, &arrows), &axis))
    }

    /// Ends of an arrow in the middle of a contact along the mean sliding of the other surface over it.
    fn arrow(&self, contact: &str) -> [[f64; 3]; 2] {
        let (mut area, mut middle, mut along) = (0.0, Vector3::zeros(), Vector3::zeros());
        for point in self.points.iter().filter(|point| point.contact == contact) {
            area += point.area;
            middle += Vector3::from(point.site.position) * point.area;
            along += Vector3::from(point.site.direction) * point.area;
        }
        let half = along * (ARROW * area.sqrt() / area.max(f64::MIN_POSITIVE));
        let middle = middle / area.max(f64::MIN_POSITIVE);
        [(middle - half).into(), (middle + half).into()]
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
