//! Pictures of the limit cycles of solid bodies: their surfaces.

use super::figures::{CycleFigures, FIELD_LIMIT};
use super::record::MotionRecord;
use crate::chart::{Axis, ChartError, Figure};
use crate::contact::ContactStatus;
use crate::results::charts::{contact_surfaces, speeds_of_bodies};

impl CycleFigures<'_> {
    /// Pressure on each contact surface at time zero, seen from outside along its mean normal; grey where it is open.
    pub(super) fn on_surfaces(&self, motion: &MotionRecord) -> Figure {
        let [pressure, ..] = &motion.edge;
        let mut values = vec![f64::NAN; self.report.mesh.node_count()];
        let nodes = self.nodes().iter().zip(pressure);
        for ((&node, &pressure), status) in nodes.zip(motion.first_statuses()) {
            if status != ContactStatus::Open {
                values[node as usize] = pressure;
            }
        }
        let largest = pressure.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let axis = || Axis::new("contact pressure", "Pa").prefixed().between(0.0, largest);
        let caption = format!(
            "Limit cycle of {} at one instant: contact pressure on each contact surface, seen from outside; grey where it is open.",
            motion.whose()
        );
        let name = format!("contact-{}", motion.tag);
        let surfaces = (self.report.mesh, &self.surfaces[..]);
        contact_surfaces((&name, &caption), surfaces, (&values, &[]), &axis)
    }

    /// Speed over the surface of the bodies at time zero, each picture with colours of its own.
    pub(super) fn velocity_of_bodies(&self) -> Result<Figure, ChartError> {
        let cycles = self.cycles.iter().take(FIELD_LIMIT);
        let frames = cycles.map(|motion| (motion.heading(), &motion.velocity_field[..]));
        let caption = "Velocity modulus of the limit cycles at one instant.";
        speeds_of_bodies(self.report.mesh, caption, frames)
    }
}
