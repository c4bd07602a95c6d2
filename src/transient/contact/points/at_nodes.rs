//! What points of contact mean for the nodes that they share.

use super::TouchingPoint;
use crate::contact::CoulombFriction;
use crate::transient::contact::LagrangeContact;

impl LagrangeContact {
    /// Mean over the points of node `i` of `value`, by their shares of the node.
    fn mean_at_node(&self, i: usize, value: impl Fn(&TouchingPoint) -> f64) -> f64 {
        let Some(contact) = &self.points else {
            return 0.0;
        };
        let (mut sum, mut total) = (0.0, 0.0);
        for &(p, share) in &contact.nodes[i].points {
            sum += share * value(&contact.points[p]);
            total += share;
        }
        if total == 0.0 { 0.0 } else { sum / total }
    }

    /// Value of a row (0 separation, 1 slip) at node `i` under a displacement field, m.
    pub(in crate::transient::contact) fn row_at_node(
        &self,
        i: usize,
        row: usize,
        displacement: &[f64],
    ) -> f64 {
        let Some(contact) = &self.points else {
            return 0.0;
        };
        self.mean_at_node(i, |point| {
            let parts = contact.entries[point.rows[row].clone()].iter();
            let own =
                |&(k, along): &(u32, f64)| along * displacement[contact.dofs[k as usize].place];
            parts.map(own).sum()
        })
    }

    /// Sliding speed at node `i`, m/s.
    pub(in crate::transient::contact) fn speed_at_node(&self, i: usize) -> f64 {
        self.mean_at_node(i, |point| point.speed)
    }

    /// Friction law of the contact that node `i` belongs to; none without points.
    pub(in crate::transient::contact) fn law_at_node(&self, i: usize) -> Option<CoulombFriction> {
        let contact = self.points.as_ref()?;
        let &(point, _) = contact.nodes[i].points.first()?;
        Some(contact.points[point].law)
    }

    /// Distance of node `i` from what it meets under a displacement field and a `share` of the interference, m.
    pub(in crate::transient::contact) fn gap_at_node(
        &self,
        i: usize,
        displacement: &[f64],
        share: f64,
    ) -> f64 {
        let whole = |point: &TouchingPoint| {
            let contact = self.points.as_ref();
            contact.map_or(0.0, |contact| contact.interferences[point.contact.0])
        };
        self.mean_at_node(i, |point| point.gap - share * whole(point))
            + self.row_at_node(i, 0, displacement)
    }

    /// Slip of node `i` along the sliding under a displacement field, m.
    pub(in crate::transient::contact) fn slip_at_node(
        &self,
        i: usize,
        displacement: &[f64],
    ) -> f64 {
        self.row_at_node(i, 1, displacement)
    }
}
