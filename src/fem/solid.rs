//! Matrices of one sector of a body of revolution in three dimensions, and their circumferential harmonics.
//!
//! As in [`super::sector`], with three components at each node, `(u_r, u_theta, u_z)`: a mirror along a radius
//! turns `u_theta` over and leaves the other two.

mod element;
mod face;
mod stress;

pub use element::{mass, stiffness};
pub use face::{FaceTerm, face_load, face_matrix, nodal_matrix, whole_element};
pub use stress::geometric_stiffness;

use super::sector::MirrorParity;
use crate::linalg::banded::BandedMatrix;
use crate::mesh::SolidSector;
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// One matrix of a body of revolution, kept as the element matrices of one sector.
///
/// Dofs are `3 k + c` for component `c` of sector node `k`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolidMatrix {
    /// Distinct matrices in nodal frames.
    pub(super) matrices: Vec<DMatrix<f64>>,
    /// Which matrix acts on which nodes, each with its angle in halves of a sector.
    pub(super) places: Vec<(usize, Vec<(usize, usize)>)>,
}

impl SolidMatrix {
    /// Adds `factor` times the matrix of the wave `U e^{i n theta}` to `sum`, whose unknowns `unknown_of` gives for each dof.
    ///
    /// Written for `(u_r, w, u_z)` with `u_theta = i w` and the tangential rows multiplied by `-i`; real as it stands for
    /// even parity, to be multiplied by `i` for odd parity (see [`super::sector::SectorMatrix::harmonic`]).
    pub fn add_harmonic(
        &self,
        sum: &mut BandedMatrix,
        unknown_of: &[Option<usize>],
        (sectors, n): (usize, usize),
        (parity, factor): (MirrorParity, f64),
    ) {
        // Angles modulo a full turn, so that high harmonics lose no digits.
        let turned = |difference: isize| {
            let turns = (n as isize * difference).rem_euclid(2 * sectors as isize);
            (PI * turns as f64 / sectors as f64).sin_cos()
        };
        let table: Vec<(f64, f64)> = (-2..=2).map(turned).collect();
        for (matrix, nodes) in &self.places {
            let matrix = &self.matrices[*matrix];
            for (b, &(column_node, column_half)) in nodes.iter().enumerate() {
                for (a, &(row_node, row_half)) in nodes.iter().enumerate() {
                    let (sin, cos) = table[2 + column_half - row_half];
                    let (same, radial_row, tangential_row) = match parity {
                        MirrorParity::Even => (cos, -sin, sin),
                        MirrorParity::Odd => (sin, cos, -cos),
                    };
                    for column in 0..3 {
                        let Some(j) = unknown_of[3 * column_node + column] else {
                            continue;
                        };
                        for row in 0..3 {
                            let value = matrix[(3 * a + row, 3 * b + column)];
                            let Some(i) = unknown_of[3 * row_node + row] else {
                                continue;
                            };
                            let phase = match (row == 1, column == 1) {
                                (false, true) => radial_row,
                                (true, false) => tangential_row,
                                _ => same,
                            };
                            if value != 0.0 && phase != 0.0 {
                                sum.add(i, j, factor * phase * value);
                            }
                        }
                    }
                }
            }
        }
    }

    /// Appends the terms of another matrix.
    pub fn extend(&mut self, other: Self) {
        let offset = self.matrices.len();
        self.matrices.extend(other.matrices);
        let places = other.places.into_iter();
        self.places.extend(places.map(|(matrix, nodes)| (matrix + offset, nodes)));
    }

    /// Multiplies every entry.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.matrices.iter_mut().for_each(|matrix| *matrix *= factor);
        self
    }

    /// `(row, column, value)` over the dofs of a sector of a matrix that couples no two nodes; a node's parts come from both sides.
    pub fn nodal_blocks(&self, nodes: usize) -> Vec<(usize, usize, f64)> {
        let mut blocks = vec![[[0.0; 3]; 3]; nodes];
        for (matrix, own) in &self.places {
            for (a, (node, _)) in own.iter().enumerate() {
                for (c, row) in blocks[*node].iter_mut().enumerate() {
                    for (d, value) in row.iter_mut().enumerate() {
                        *value += self.matrices[*matrix][(3 * a + c, 3 * a + d)];
                    }
                }
            }
        }
        let of_block = |(node, block): (usize, &[[f64; 3]; 3])| -> Vec<(usize, usize, f64)> {
            let pairs = (0..9).map(|k| (k / 3, k % 3));
            pairs.map(|(c, d)| (3 * node + c, 3 * node + d, block[c][d])).collect()
        };
        let entries = blocks.iter().enumerate().flat_map(of_block);
        entries.filter(|entry| entry.2 != 0.0).collect()
    }

    /// Whether it has no entry.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }
}

/// Half bandwidth of the harmonics of one sector, all dofs counted.
pub fn half_bandwidth(sector: &SolidSector) -> usize {
    3 * sector.node_bandwidth() + 2
}
