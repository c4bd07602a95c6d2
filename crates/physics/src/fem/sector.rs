//! Matrices of one sector of a body of equal sectors, in the plane and in space: those of the strip of its elements, as of any
//! mesh, whose nodes are images of the sector's.

use super::fold::{SectorMatrix, WaveDofs};
use super::{
    DofMap, MaterialField, Triplets, assemble_pressures, assemble_stiffness, assemble_supports,
};
use crate::mesh::Strip;

impl Strip {
    /// The dofs that nothing holds.
    pub fn wave_dofs(&self) -> WaveDofs {
        let half_bandwidth = self.mesh.dimension * (self.node_bandwidth() + 1) - 1;
        let free = DofMap::of(self.dof_count(), self.free_dofs().collect());
        WaveDofs::new(free, half_bandwidth, self.count)
    }

    /// What a matrix of the strip, or of products of rows, is over the dofs of the sector.
    pub fn folded(&self, matrix: &Triplets) -> SectorMatrix {
        let components = self.mesh.dimension;
        let place = |dof: usize| {
            let (node, half) = self.place(dof / components);
            (components * node + dof % components, half)
        };
        let places: Vec<(usize, isize)> = (0..3 * self.dof_count()).map(place).collect();
        let entries = matrix.entries.iter().map(|&(row, column, value)| {
            let ((row, here), (column, there)) = (places[row], places[column]);
            (row, column, there - here, value)
        });
        SectorMatrix::of_entries(components, entries)
    }

    /// Over the dofs of the sector what motions that are the same in every sector see of matrices that mirror themselves: the
    /// tangential part does not mix with the others.
    pub fn alike<'a>(&self, matrices: impl IntoIterator<Item = &'a Triplets>) -> Triplets {
        let is_tangential = |dof: usize| dof % self.mesh.dimension == 1;
        let own = |dof: usize| dof % self.dof_count();
        let entries = matrices.into_iter().flat_map(|matrix| &matrix.entries);
        let entries = entries.map(|&(row, column, value)| (own(row), own(column), value));
        let entries = entries.filter(|own| is_tangential(own.0) == is_tangential(own.1));
        let mut sum = Triplets { entries: entries.collect() };
        sum.merge();
        sum.entries.retain(|entry| entry.2 != 0.0);
        sum
    }

    /// [`Self::alike`] of the stiffness, springs included.
    pub fn stiffness_alike(&self, material: &dyn MaterialField) -> Triplets {
        let [springs, _] = assemble_supports(&self.mesh);
        self.alike(&[assemble_stiffness(&self.mesh, material), springs])
    }

    /// Forces of the pressures on the boundaries, the same in every sector, N.
    pub fn pressure_load(&self) -> Vec<f64> {
        let mut load = vec![0.0; self.dof_count()];
        let forces = assemble_pressures(&self.mesh).unwrap_or_default();
        forces.iter().enumerate().for_each(|(dof, force)| load[dof % self.dof_count()] += force);
        load
    }
}
