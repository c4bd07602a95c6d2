//! Steps of points whose rows are single dofs: each stands alone.

use super::law::FreePoint;
use super::{LagrangeContact, Step};
use crate::contact::ContactStatus;
use crate::fem::operator::MotionFields;

impl LagrangeContact {
    /// [`Self::apply`] point by point.
    pub(super) fn apply_to_single_dofs<const TANGENTS: usize>(
        &mut self,
        fields: &mut MotionFields,
        step: &Step,
    ) {
        let (coefficients, rows) = (step.coefficients, TANGENTS + 1);
        let (displacement, velocity) = (&fields.displacement[..], &fields.velocity[..]);
        let (elastic, elastic_rate) = (&mut fields.elastic[..], &fields.elastic_rate[..]);
        self.ambiguous = 0;
        for surfaces in &mut self.surfaces {
            let range = surfaces.points.clone();
            let dofs = self.dofs[rows * range.start..].chunks_exact_mut(rows);
            let points = self.points[range.clone()].iter();
            for ((place, i), (point, dofs)) in range.enumerate().zip(points.zip(dofs)) {
                // The end of the step without contact.
                let mut along = [1.0; 3];
                let mut free =
                    FreePoint { place, separation: 0.0, before: [0.0; 3], free: [0.0; 3] };
                for (c, dof) in dofs.iter_mut().enumerate() {
                    let (v, q) = (velocity[dof.place], elastic[dof.place]);
                    dof.before = [v, q];
                    // In the plane rows are the dofs themselves.
                    if TANGENTS > 1 {
                        along[c] = self.entries[rows * i + c].1;
                    }
                    free.before[c] = along[c] * v;
                    free.free[c] = along[c] * coefficients.moved(v, q, elastic_rate[dof.place]);
                }
                free.separation = along[0] * displacement[dofs[0].place];
                // The forces, into the accelerations.
                let forces = surfaces.resolve::<TANGENTS>(point, &free, step);
                if forces.status != ContactStatus::Open {
                    self.ambiguous += u64::from(forces.is_ambiguous);
                    for (c, dof) in dofs.iter().enumerate() {
                        let force = along[c] * forces.whole[c];
                        elastic[dof.place] = dof.before[1] - force / point.mass[c.min(1)];
                    }
                }
                self.status[i] = forces.status;
                self.normal_force[i] = forces.whole[0];
                self.tangential_force[i] = forces.friction[0];
                if TANGENTS > 1 {
                    self.across_force[i] = forces.friction[1];
                }
            }
        }
    }
}
