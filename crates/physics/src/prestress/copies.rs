//! The pressed equilibrium of a body whose sectors are alike, from one of them.

use super::Result;
use super::complementarity::range;
use super::contact_system::ContactSystem;
use super::elimination::Elimination;
use super::pressed_range::{Asked, PressedRange};
use super::pressed_state::Pressing;
use crate::contact::Row;
use crate::fem::Triplets;
use crate::mesh::Mesh;

/// Difference of loads, forces and places of points from sector to sector, over the largest ones, up to which they are copies.
const ALIKE: f64 = 1e-7;
/// Gap, over the root of a point's share of the surface, that is none.
const NO_GAP: f64 = 1e-4;

impl Pressing<'_> {
    /// The states at every friction coefficient `asked` for, of a body of equal sectors from one of them: its loads and points are the
    /// same in each, and so is its state, in frames that turn with it.
    ///
    /// # Errors
    /// [`NoState`](super::PrestressError::NoState) at the first friction coefficient without one; otherwise as [`super::Assembly::range`].
    pub(super) fn states(&self, mesh: &Mesh, asked: Asked<'_>) -> Result<PressedRange> {
        let count = mesh.symmetry.as_ref().map_or(1, |symmetry| symmetry.count);
        let Some(first_of) = self.copies(count) else {
            return range(&mut ContactSystem::new(self)?, asked);
        };
        // One sector, whose neighbours move as it does.
        let size = self.load.len() / count;
        let entries = self.stiffness.entries.iter().filter(|(row, ..)| *row < size);
        let entries = entries.map(|&(row, column, value)| (row, column % size, value));
        let stiffness = Triplets { entries: entries.collect() };
        let unknowns = self.elimination.unknowns().unknown_of;
        let held = (0..size).filter(|&dof| unknowns[dof].is_none());

        // One point of those that are copies of each other.
        let firsts: Vec<usize> = (0..first_of.len()).filter(|&i| first_of[i] == i).collect();
        let points: Vec<_> = firsts.iter().map(|&i| self.points[i].folded(size)).collect();
        let own = Pressing {
            stiffness: &stiffness,
            load: self.load[..size].to_vec(),
            elimination: Elimination::holding(size, held),
            points: &points,
            contacts: Vec::new(),
            together: Vec::new(),
            pushed: firsts.iter().map(|&i| self.pushed[i]).collect(),
            laws: firsts.iter().map(|&i| self.laws[i]).collect(),
        };
        let asked = (asked.0, &PressedRange::default());
        let mut range = range(&mut ContactSystem::new(&own)?, asked)?;

        // The state of the whole body: which point of the sector each of the body is a copy of.
        let copy_of = first_of.iter().map(|first| firsts.partition_point(|own| own < first));
        let copy_of: Vec<usize> = copy_of.collect();
        range.states.iter_mut().for_each(|state| *state = state.repeated(count, &copy_of));
        Ok(range)
    }

    /// For each point the first of its copies, of which each of the `count` sectors has one. `None` where a state that is the same
    /// in every sector is none of the body: there is one sector, ties or equations join them, or supports, loads or points differ.
    ///
    /// Motions that are the same in every sector meet copies alike, and equal forces of copies load every sector alike: both are
    /// asked of a motion and of forces without any symmetry within the sector.
    fn copies(&self, count: usize) -> Option<Vec<usize>> {
        let (total, size) = (self.load.len(), self.load.len() / count);
        let is_whole = count > 1 && size * count == total;
        if !is_whole || self.elimination.combinations().next().is_some() {
            return None;
        }
        // What a sector has is what the first one has, to round-off.
        let is_alike = |values: &[f64]| {
            let bound = ALIKE * values.iter().fold(0.0_f64, |m, value| m.max(value.abs()));
            let mut values_at = values.iter().enumerate();
            values_at.all(|(dof, value)| (value - values[dof % size]).abs() <= bound)
        };
        let unknowns = self.elimination.unknowns().unknown_of;
        let motion: Vec<f64> = (0..total).map(|dof| without_symmetry(dof % size)).collect();
        let are_held_alike =
            (0..total).all(|dof| unknowns[dof].is_none() == unknowns[dof % size].is_none());
        let stiffness = self.stiffness.multiply(total, &motion);
        if !are_held_alike || !is_alike(&self.load) || !is_alike(&stiffness) {
            return None;
        }

        // What the points see of the motion; copies follow each other in its order.
        let form = |row: &Row| row.iter().map(|&(dof, a)| a * motion[dof]).sum::<f64>();
        let places = self.points.iter().map(|own| [&own.normal, &own.slip].map(form));
        let seen = places.zip(self.points).zip(&self.pushed);
        let seen = seen.map(|(([out, along], own), pushed)| [out, along, own.weight, *pushed]);
        let seen: Vec<[f64; 4]> = seen.collect();
        // One from each sector: neighbours in the order of what they see, with all else equal.
        let mut order: Vec<usize> = (0..seen.len()).collect();
        crate::order::sort_by_number(&mut order, |&i| seen[i][0]);
        let mut first_of = vec![0; seen.len()];
        let mut forces = [vec![0.0; total], vec![0.0; total]];
        for copies in order.chunks(count) {
            let first = *copies.iter().min()?;
            let [.., weight, pushed] = seen[first];
            // Gaps that vanish are round-off beside the size of a point.
            let size = pushed.abs().max(NO_GAP * weight.sqrt());
            let bounds = [1.0, 1.0, weight, size].map(|size| ALIKE * size);
            for &i in copies {
                let mut pairs = seen[i].iter().zip(&seen[first]).zip(bounds);
                if !pairs.all(|((a, b), bound)| (a - b).abs() <= bound) {
                    return None;
                }
                first_of[i] = first;
                // Forces of a size that only copies share, along both rows of each point.
                let (force, point) = (1.0 + without_symmetry(first), &self.points[i]);
                for (sum, row) in forces.iter_mut().zip([&point.normal, &point.slip]) {
                    row.iter().for_each(|&(dof, a)| sum[dof] += force * a);
                }
            }
        }
        forces.iter().all(|own| is_alike(own)).then_some(first_of)
    }
}

/// Entry `k` of a vector that has no symmetry, between -0.5 and 0.5.
pub(crate) fn without_symmetry(k: usize) -> f64 {
    (1.0 + k as f64).sqrt().fract() - 0.5 // Fractions of roots repeat nowhere.
}
