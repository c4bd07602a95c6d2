//! A matrix of a body of equal sectors, kept as that of one sector, and folded into circumferential harmonics.
//!
//! All sectors are alike, so a wave `u = U e^{i n theta}` over the nodes sees one small matrix for each harmonic `n`. In the basis
//! `(u_r, -i u_theta)`, in space `(u_r, -i u_theta, u_z)`, that matrix is real where the body looks the same in a mirror along a radius. It
//! is `i` times real where the mirror reverses it, as it does the stress of sliding friction.

use super::{DofMap, Triplets};
use crate::linalg::banded::BandedMatrix;
use std::f64::consts::PI;

/// What a mirror along a radius does to a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MirrorParity {
    /// Leaves it as it is: harmonics are real in the basis `(u_r, -i u_theta)`.
    Even,
    /// Changes its sign: harmonics are `i` times the real matrix returned.
    Odd,
}

/// Halves of a sector from one node of an element to another, at most, either way.
const REACH: usize = 2;
/// How many differences of them there are.
const STEPS: usize = 2 * REACH + 1;

/// A matrix over the dofs of one sector, `d k + c` for component `c` of sector node `k`, `d` components a node, that couples
/// them to dofs of sectors beside it too.
///
/// Component 1 is tangential: a mirror along a radius turns it over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectorMatrix {
    components: usize,
    /// Where each row begins.
    starts: Vec<usize>,
    /// By column, in each column by the angle ahead.
    entries: Vec<Entry>,
}

/// An entry of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    column: u32,
    /// Halves of a sector from the row's node to the column's, counted from `-REACH`, times 4; plus 2 where the row is
    /// tangential, plus 1 where the column is.
    turn: u32,
    value: f64,
}

impl SectorMatrix {
    /// From entries `(row, column, halves of a sector from the row's node to the column's, value)`, which add up.
    pub fn of_entries(
        components: usize,
        entries: impl IntoIterator<Item = (usize, usize, isize, f64)>,
    ) -> Self {
        // Columns are `STEPS` times those of the matrix, plus the difference of angles.
        let entries = entries.into_iter();
        let mut terms =
            Triplets { entries: Vec::with_capacity(entries.size_hint().1.unwrap_or(0)) };
        for (row, column, ahead, value) in entries.filter(|entry| entry.3 != 0.0) {
            terms.push(row, STEPS * column + (REACH as isize + ahead) as usize, value);
        }
        if terms.entries.is_empty() {
            return Self::default();
        }
        terms.merge();
        let mut starts = vec![0];
        let mut entries = Vec::with_capacity(terms.entries.len());
        for (row, place, value) in terms.entries {
            let (column, ahead) = (place / STEPS, place % STEPS);
            let is_tangential = |dof: usize| usize::from(dof % components == 1);
            let turn = 4 * ahead + 2 * is_tangential(row) + is_tangential(column);
            starts.resize(row + 1, entries.len());
            entries.push(Entry { column: column as u32, turn: turn as u32, value });
        }
        starts.push(entries.len());
        Self { components, starts, entries }
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

    /// Matrix of the wave `U e^{i n theta}` of a sum of terms, one row for each unknown.
    ///
    /// ```text
    /// (A_n U)_I e^{i n theta_I} = sum_J A_IJ U_J e^{i n theta_J},   U = (u_r, i w)
    /// ```
    ///
    /// written for `(u_r, w)` with the tangential rows multiplied by `-i`; real as it stands for even parity, to be multiplied
    /// by `i` for odd parity. Harmonics `n` and `N - n` are mirror images, so `n <= N / 2` is all there is.
    pub fn fold(&self, n: usize, parity: MirrorParity, terms: &[&SectorMatrix]) -> BandedMatrix {
        let mut sum = self.zeros();
        terms.iter().for_each(|term| self.add(&mut sum, n, parity, (1.0, term)));
        sum
    }

    /// Adds [`Self::fold`] of a term times a factor to a matrix.
    pub fn add(
        &self,
        sum: &mut BandedMatrix,
        n: usize,
        parity: MirrorParity,
        (factor, term): (f64, &SectorMatrix),
    ) {
        let turns = self.turns(n, parity).map(|turn| factor * turn);
        for (row, ends) in term.starts.windows(2).enumerate() {
            let Some(i) = self.unknown_of[row] else { continue };
            let band = sum.row_mut(i);
            for entry in &term.entries[ends[0]..ends[1]] {
                if let Some(j) = self.unknown_of[entry.column as usize] {
                    band[j + self.half_bandwidth - i] += turns[entry.turn as usize] * entry.value;
                }
            }
        }
    }

    /// What each [`Entry::turn`] multiplies its entry by.
    fn turns(&self, n: usize, parity: MirrorParity) -> [f64; 4 * STEPS] {
        let mut turns = [0.0; 4 * STEPS];
        for (ahead, own) in turns.chunks_exact_mut(4).enumerate() {
            // Angles modulo a full turn, so that high harmonics lose no digits.
            let halves = n as isize * (ahead as isize - REACH as isize);
            let halves = halves.rem_euclid(2 * self.sectors as isize);
            let (sin, cos) = (PI * halves as f64 / self.sectors as f64).sin_cos();
            own.copy_from_slice(&match parity {
                MirrorParity::Even => [cos, -sin, sin, cos],
                MirrorParity::Odd => [sin, cos, -cos, sin],
            });
        }
        turns
    }
}
