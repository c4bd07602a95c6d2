//! From all dofs to the unknowns of small motions in sliding contact.

use super::SteadySliding;
use crate::contact::ContactInterface;
use crate::fem::{DofMap, Triplets};
use crate::mesh::Mesh;
use std::collections::{BTreeMap, BTreeSet};

/// Entries `(row, column, value)` over the unknowns, by power of `mu`.
pub(super) type ProjectedPolynomial = Vec<Vec<(usize, usize, f64)>>;

/// From all dofs to the unknowns of small motions in sliding contact.
///
/// Columns are the unknowns: every dof that is not held and, for rigid contact, not a pressed contact node's
/// normal displacement (its distance from a deformable counterface). Rows are the same, and for rigid contact each normal
/// row is added to the rows of its slip with the factor `-s mu`.
pub(super) struct Projection<'a> {
    pub unknowns: DofMap,
    base: &'a SteadySliding,
    is_penalty: bool,
    /// For each full dof that is a rigid contact node's normal: unknowns and coefficients of its slip.
    friction_rows: BTreeMap<usize, Vec<(usize, f64)>>,
}

impl<'a> Projection<'a> {
    pub fn new(mesh: &Mesh, base: &'a SteadySliding, is_penalty: bool) -> Self {
        let interface = &base.interface;
        let total = 2 * mesh.node_count();
        let is_rigid = |i: &usize| !is_penalty && base.is_pressed[*i];
        let rigid: Vec<usize> = (0..interface.len()).filter(is_rigid).collect();
        let normals = rigid.iter().map(|&i| interface.normal_dof(i));
        let unknowns = DofMap::excluding(total, mesh.held_dofs().chain(normals));
        let friction_rows = rigid.into_iter().map(|i| {
            let slip = interface.slip(i);
            let free = slip.filter_map(|(dof, along)| Some((unknowns.unknown_of[dof]?, along)));
            (interface.normal_dof(i), free.collect())
        });
        let friction_rows = friction_rows.collect();
        Self {
            unknowns,
            base,
            is_penalty,
            friction_rows,
        }
    }

    pub fn apply(&self, full: &[Triplets]) -> ProjectedPolynomial {
        let mut projected = vec![Vec::new(); full.len() + usize::from(!self.is_penalty)];
        for (power, terms) in full.iter().enumerate() {
            for &(row, column, value) in &terms.entries {
                let Some(unknown) = self.unknowns.unknown_of[column] else {
                    continue;
                };
                if let Some(row) = self.unknowns.unknown_of[row] {
                    projected[power].push((row, unknown, value));
                } else if let Some(rows) = self.friction_rows.get(&row) {
                    let value = -self.base.friction.drag * value;
                    let rows = rows.iter();
                    projected[power + 1]
                        .extend(rows.map(|&(row, along)| (row, unknown, along * value)));
                }
            }
        }
        projected
    }

    pub fn tangential_unknowns(&self) -> Vec<usize> {
        self.unknowns_of(ContactInterface::tangential_dof)
    }

    pub fn normal_unknowns(&self) -> Vec<usize> {
        self.unknowns_of(ContactInterface::normal_dof)
    }

    pub fn opposite_unknowns(&self) -> Vec<usize> {
        let mut seen = BTreeSet::new();
        let shares = self.base.interface.opposite.iter().flatten();
        let shares = shares.filter(|share| share.normal != 0.0 || share.tangential != 0.0);
        let unknowns = shares.filter_map(|share| self.unknowns.unknown_of[share.dof]);
        unknowns.filter(|&unknown| seen.insert(unknown)).collect()
    }

    fn unknowns_of(&self, dof: fn(&ContactInterface, usize) -> usize) -> Vec<usize> {
        let nodes = 0..self.base.interface.len();
        let dofs = nodes.map(|i| dof(&self.base.interface, i));
        dofs.filter_map(|dof| self.unknowns.unknown_of[dof])
            .collect()
    }
}
