//! Matrices of one sector of a body of equal sectors, in the plane and in space: those of the strip of its elements, as of any
//! mesh, whose nodes are images of the sector's.
//!
//! Dofs are `d k + c`, component `c` (radial, tangential, axial) of sector node `k`; for their order see [`SectorMesh`].
//!
//! [`SectorMesh`]: crate::mesh::SectorMesh

use super::fold::{SectorMatrix, WaveDofs};
use super::{MaterialField, Triplets, assemble_pressures, assemble_stiffness, assemble_supports};
use crate::mesh::Strip;

impl Strip {
    /// The dofs that nothing holds.
    pub fn wave_dofs(&self) -> WaveDofs {
        let components = self.mesh.dimension;
        let half_bandwidth = components * (self.node_bandwidth() + 1) - 1;
        WaveDofs::new(self.dof_count(), |dof| self.is_held[dof], half_bandwidth, self.count)
    }

    /// What a matrix of the strip is over the dofs of the sector, whose images its nodes are.
    pub fn folded(&self, matrix: &Triplets) -> SectorMatrix {
        self.placed(matrix, |dof| self.image(dof))
    }

    /// Dof of the sector that one of the strip is an image of, and how many halves of a sector ahead.
    fn image(&self, dof: usize) -> (usize, isize) {
        let components = self.mesh.dimension;
        let (node, half) = self.places[dof / components];
        (components * node + dof % components, half as isize)
    }

    /// The matrix of products of rows, see [`dof_ahead`](super::fold::dof_ahead).
    pub fn at_places(&self, products: &Triplets) -> SectorMatrix {
        let dofs = self.dof_count();
        self.placed(products, |place| (place % dofs, (place / dofs) as isize))
    }

    /// A matrix over places, each of which is a dof of the sector with an angle in halves of a sector.
    fn placed(&self, matrix: &Triplets, place: impl Fn(usize) -> (usize, isize)) -> SectorMatrix {
        let entries = matrix.entries.iter().map(|&(row, column, value)| {
            let ((row, here), (column, there)) = (place(row), place(column));
            (row, column, there - here, value)
        });
        SectorMatrix::of_entries(self.mesh.dimension, entries)
    }

    /// Stiffness over all dofs, springs included, that motions which are the same in every sector see.
    pub fn stiffness_alike(&self, material: &dyn MaterialField) -> Triplets {
        let [springs, _] = assemble_supports(&self.mesh);
        let both = [assemble_stiffness(&self.mesh, material), springs];
        let [body, springs] = both.map(|own| self.folded(&own));
        SectorMatrix::alike_in_all(&[&body, &springs])
    }

    /// Forces of the pressures on the boundaries, the same in every sector, N.
    pub fn pressure_load(&self) -> Vec<f64> {
        let mut load = vec![0.0; self.dof_count()];
        let forces = assemble_pressures(&self.mesh).unwrap_or_default();
        forces.iter().enumerate().for_each(|(dof, force)| load[self.image(dof).0] += force);
        load
    }

    /// A displacement of the sector, the same in all, over the dofs of the strip.
    pub fn spread(&self, displacement: &[f64]) -> Vec<f64> {
        (0..self.mesh.dof_count()).map(|dof| displacement[self.image(dof).0]).collect()
    }
}
