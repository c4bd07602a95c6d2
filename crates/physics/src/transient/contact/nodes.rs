//! What points of contact mean for the nodes that the record shows.

use super::{LagrangeContact, TouchingSurfaces};

impl LagrangeContact {
    /// Mean over the points of node `i` of `value`, by their shares of the node.
    fn mean_at_node(&self, i: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for &(p, share) in &self.nodes[i] {
            sum += share * value(p);
            total += share;
        }
        if total == 0.0 { 0.0 } else { sum / total }
    }

    fn surfaces_of(&self, p: usize) -> Option<&TouchingSurfaces> {
        self.surfaces.iter().find(|surfaces| surfaces.points.contains(&p))
    }

    /// Distance of node `i` from what it meets under a `share` of the interference, m, in a displacement field.
    pub fn gap(&self, i: usize, displacement: &[f64], share: f64) -> f64 {
        self.mean_at_node(i, |p| {
            let surfaces = self.surfaces_of(p);
            let pushed = surfaces
                .map_or(0.0, |own| own.pushed(p - own.points.start, &self.points[p], share));
            self.along(p, 0, |dof| displacement[dof.place]) - pushed
        })
    }

    /// Displacement of node `i` along the sliding, m: in the plane its own, between solid bodies that of the one over the other.
    pub fn slip(&self, i: usize, displacement: &[f64]) -> f64 {
        match self.tangents {
            1 => displacement[self.places(i)[1]],
            _ => self.relative(i, displacement)[1],
        }
    }

    /// Values of a field (displacement or velocity) at node `i` along the normal and along the sliding; between bodies those of
    /// the one relative to the other.
    pub fn relative(&self, i: usize, field: &[f64]) -> [f64; 2] {
        [0, 1].map(|row| self.mean_at_node(i, |p| self.along(p, row, |dof| field[dof.place])))
    }

    /// Speed of the counterface at node `i`, m/s: what a node that sticks has for [`Self::relative`] velocity along the sliding.
    pub fn counterface_speed(&self, i: usize) -> f64 {
        self.mean_at_node(i, |p| self.points[p].speed)
    }

    /// Friction coefficient at node `i`; none where it falls with the slip speed.
    pub fn friction_coefficient(&self, i: usize) -> Option<f64> {
        let &(point, _) = self.nodes[i].first()?;
        let law = self.surfaces_of(point)?.law;
        law.decay.is_none().then_some(law.friction_coefficient)
    }

    /// Places in a field of node `i`'s own dofs along the normal and along the sliding, of a plane body.
    pub fn places(&self, i: usize) -> [usize; 2] {
        [0, 1].map(|c| self.dofs[self.entries[self.row(i, c).start].0 as usize].place)
    }
}
