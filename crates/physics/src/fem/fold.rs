//! Matrices of bodies of equal sectors, in the plane and in space: those of the strip of one sector's elements, whose nodes are images
//! of the sector's, folded into circumferential harmonics.
//!
//! All sectors are alike, so a wave `u = U e^{i n theta}` over the nodes sees one small matrix for each harmonic `n`. In the basis
//! `(u_r, -i u_theta)`, in space `(u_r, -i u_theta, u_z)`, that matrix is real where the body looks the same in a mirror along a radius. It
//! is `i` times real where the mirror reverses it, as it does the stress of sliding friction.

use super::{
    DofMap, MaterialField, Triplets, assemble_pressures, assemble_stiffness, assemble_supports,
};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::Strip;
use std::f64::consts::PI;

/// Halves of a sector from one node of an element to another, at most, either way.
const REACH: isize = 2;
/// Room for these differences, `2 REACH + 1`: a power of two divides fast.
const STEPS: usize = 8;
/// Room for the turns of an entry: halves of a sector from the row's node to the column's, counted from `-REACH`, times 4; plus 2
/// where the row is tangential, plus 1 where the column is.
const TURNS: usize = 4 * STEPS;

/// A matrix over the dofs of one sector, `d k + c` for component `c` of sector node `k`, `d` components a node, that couples
/// them to dofs of sectors beside it too. Its columns are 32 times those of the sector plus the turn of the entry.
///
/// Component 1 is tangential: a mirror along a radius turns it over.
pub type SectorMatrix = Triplets;

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
        let entries = matrix.entries.iter().filter(|entry| entry.2 != 0.0);
        let entries = entries.map(|&(row, column, value)| {
            let ((row, here), (column, there)) = (places[row], places[column]);
            (row, STEPS * column + (REACH + there - here) as usize, value)
        });
        let mut sum = Triplets { entries: entries.collect() };
        sum.merge();
        let is_tangential = |dof: usize| usize::from(dof % components == 1);
        for (row, place, _) in &mut sum.entries {
            *place = 4 * *place + 2 * is_tangential(*row) + is_tangential(*place / STEPS);
        }
        sum
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

/// The dofs of a sector that can move, and the shape of the matrices of waves over them.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveDofs {
    /// Unknown of each dof of the sector, `None` for those that are held.
    pub unknown_of: Vec<Option<usize>>,
    /// How many unknowns there are.
    pub count: usize,
    /// Off-diagonals on either side.
    pub half_bandwidth: usize,
    /// Sectors of the body.
    pub sectors: usize,
}

impl WaveDofs {
    /// Some unknowns of a body with so many sectors.
    pub fn new(unknowns: DofMap, half_bandwidth: usize, sectors: usize) -> Self {
        Self { count: unknowns.len(), unknown_of: unknowns.unknown_of, half_bandwidth, sectors }
    }

    /// A matrix without entries.
    pub fn zeros(&self) -> BandedMatrix {
        BandedMatrix::zeros(self.count, self.half_bandwidth)
    }

    /// Matrix of the wave `U e^{i n theta}` of what comes with a `power` of the friction coefficient, one row for each unknown.
    ///
    /// ```text
    /// (A_n U)_I e^{i n theta_I} = sum_J A_IJ U_J e^{i n theta_J},   U = (u_r, i w)
    /// ```
    ///
    /// written for `(u_r, w)` with the tangential rows multiplied by `-i`: `mu^p A_n = (i mu)^p R` of the real `R` returned, as a
    /// mirror changes the sign of odd powers. Harmonics `n` and `N - n` are mirror images, so `n <= N / 2` is all there is.
    pub fn fold(&self, n: usize, power: usize, term: &SectorMatrix) -> BandedMatrix {
        let mut sum = self.zeros();
        self.add(&mut sum, (n, power), (1.0, term));
        sum
    }

    /// Adds [`Self::fold`] of a term times a factor to a matrix.
    pub fn add(
        &self,
        sum: &mut BandedMatrix,
        (n, power): (usize, usize),
        (factor, term): (f64, &SectorMatrix),
    ) {
        let turns = self.turns(n, power).map(|turn| factor * turn);
        for row in term.entries.chunk_by(|a, b| a.0 == b.0) {
            let Some(i) = self.unknown_of[row[0].0] else { continue };
            let band = sum.row_mut(i);
            for &(_, place, value) in row {
                if let Some(j) = self.unknown_of[place / TURNS] {
                    band[j + self.half_bandwidth - i] += turns[place % TURNS] * value;
                }
            }
        }
    }

    /// What each turn multiplies an entry by.
    fn turns(&self, n: usize, power: usize) -> [f64; TURNS] {
        let (mut turns, sign) = ([0.0; TURNS], [1.0, 1.0, -1.0, -1.0][power % 4]);
        for (ahead, own) in (-REACH..).zip(turns.chunks_exact_mut(4)) {
            // Angles modulo a full turn, so that high harmonics lose no digits.
            let halves = (n as isize * ahead).rem_euclid(2 * self.sectors as isize);
            let (sin, cos) = (PI * halves as f64 / self.sectors as f64).sin_cos();
            let all = [[cos, -sin, sin, cos], [sin, cos, -cos, sin]][power % 2];
            own.copy_from_slice(&all.map(|turn| sign * turn));
        }
        turns
    }
}
