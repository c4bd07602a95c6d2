//! Tangents of a body with cyclic symmetry, one for each number of nodal diameters.

use super::{ContactDofs, SlidingTangent, TabledStiffness};
use crate::fem::DofMap;
use crate::linalg::{MatrixPolynomial, SparsityPattern, c64};
use crate::mesh::CyclicSymmetry;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Difference of entries of two sectors, over the largest one of the row, up to which they are alike.
const ALIKE: f64 = 1e-8;

/// The small motions of a body whose `N` sectors are alike, as waves of `n = 0 ... N / 2` nodal diameters:
///
/// ```text
/// q_j = a cos(2 pi n j / N) + b sin(2 pi n j / N),   j = 0 ... N - 1,
/// ```
///
/// with `q_j` the unknowns of sector `j` in frames that turn with it. Of a matrix whose rows of sector 0 have the blocks `A_j` in
/// the columns of sector `j` such waves see
///
/// ```text
/// [  C  S ] [a]
/// [ -S  C ] [b],   C = sum_j A_j cos(2 pi n j / N),   S = sum_j A_j sin(2 pi n j / N),
/// ```
///
/// of `n = 0` and `2 n = N` the first block alone. Source: Thomas, "Dynamics of rotationally periodic structures", Int. J. Numer.
/// Meth. Eng. 14 (1979).
pub struct CyclicTangent<'a> {
    whole: &'a SlidingTangent,
    count: usize,
    /// Unknown of the whole body: place `i` of sector `j` at `j * size + i`.
    at: Vec<usize>,
    /// Sector and place of each unknown.
    place_of: Vec<[usize; 2]>,
    /// Entries in the rows of sector 0.
    entries: Vec<Entry>,
}

/// An entry of the matrices in a row of sector 0.
struct Entry {
    /// Places within the sectors.
    row: usize,
    column: usize,
    /// Sector of the column.
    sector: usize,
    /// Position in the pattern of the whole body.
    position: usize,
}

impl<'a> CyclicTangent<'a> {
    /// The waves of `whole`, the tangent of a mesh of `node_count` nodes that has the symmetry.
    ///
    /// # Errors
    /// In words what differs from sector to sector: supports, loads or masses in one place only, an asymmetric state of contact.
    pub fn new(
        whole: &'a SlidingTangent,
        symmetry: &CyclicSymmetry,
        node_count: usize,
    ) -> Result<Self, String> {
        let count = symmetry.count;
        // Unknowns by sector, in the order of their dofs.
        let per_sector = whole.unknowns.unknown_of.len() / node_count * (node_count / count);
        let mut places: Vec<Vec<[usize; 2]>> = vec![Vec::new(); count];
        for (unknown, dof) in whole.unknowns.dofs.iter().enumerate() {
            places[dof / per_sector].push([dof % per_sector, unknown]);
        }
        let dofs = |j: usize| places[j].iter().map(|place| place[0]);
        if let Some(j) = (1..count).find(|&j| !dofs(j).eq(dofs(0))) {
            return Err(format!(
                "sector {} is held, tied or pressed otherwise than the first",
                j + 1
            ));
        }
        let size = places[0].len();
        let at: Vec<usize> = places.iter().flatten().map(|place| place[1]).collect();
        let mut place_of = vec![[0; 2]; at.len()];
        for (k, &unknown) in at.iter().enumerate() {
            place_of[unknown] = [k / size, k % size];
        }
        let pattern = whole.stiffness.pattern();
        let rows = (0..size).flat_map(|row| pattern.row(at[row]).map(move |own| (row, own)));
        let entries = rows.map(|(row, (position, column))| {
            let [sector, column] = place_of[column];
            Entry { row, column, sector, position }
        });
        let entries = entries.collect();
        let own = Self { entries, whole, count, at, place_of };
        own.check_alike()?;
        Ok(own)
    }

    /// Refuses matrices that differ from sector to sector.
    fn check_alike(&self) -> Result<(), String> {
        let (size, total, whole) = (self.size(), self.at.len(), self.whole);
        let pattern = whole.stiffness.pattern();
        let mut named = vec![
            ("mass", &whole.mass),
            ("damping", &whole.damping),
            ("stiffness", &whole.stiffness),
        ];
        named.extend(whole.structural.iter().map(|own| ("structural damping", own)));
        let tabled = whole.tabled.iter().map(|own| &own.stiffness);
        named.extend(tabled.map(|own| ("stiffness of a part with a table", own)));
        for (what, matrix) in named {
            let pairs = matrix.coefficients().iter().map(|values| {
                turned_pair(size, total, |x| {
                    let mut own = vec![0.0; total];
                    self.at.iter().zip(x).for_each(|(&unknown, value)| own[unknown] = *value);
                    let row = |&unknown: &usize| {
                        pattern.row(unknown).map(|(k, column)| values[k] * own[column]).sum()
                    };
                    self.at.iter().map(row).collect()
                })
            });
            // Powers of mu that almost cancel are held to the others.
            let pairs: Vec<[Vec<f64>; 2]> = pairs.collect();
            let mut largest = vec![0.0_f64; size];
            for (k, value) in pairs.iter().flat_map(|pair| pair[0].iter().enumerate()) {
                largest[k % size] = largest[k % size].max(value.abs());
            }
            let differs = |[a, b]: &[Vec<f64>; 2]| {
                (0..total).find(|&k| (a[k] - b[k]).abs() > ALIKE * largest[k % size])
            };
            if let Some(k) = pairs.iter().find_map(differs) {
                let sector = k / size + 1;
                return Err(format!("the {what} of sector {sector} differs from that before it"));
            }
        }
        Ok(())
    }

    /// Unknowns of one sector.
    fn size(&self) -> usize {
        self.at.len() / self.count
    }

    /// Largest number of nodal diameters, `N / 2`.
    pub fn highest(&self) -> usize {
        self.count / 2
    }

    /// Whether waves of `n` nodal diameters have a sine beside their cosine.
    fn is_paired(&self, n: usize) -> bool {
        n != 0 && 2 * n != self.count
    }

    /// `cos` and `sin` of `2 pi n j / N`.
    fn phase(&self, n: usize, j: usize) -> [f64; 2] {
        let (sin, cos) = (TAU * (n * j % self.count) as f64 / self.count as f64).sin_cos();
        [cos, sin]
    }

    /// The tangent that waves of `n` nodal diameters see, over `a` and, where there is one, `b`: its vectors are those of a body
    /// whose dofs are these unknowns.
    pub fn harmonic(&self, n: usize) -> SlidingTangent {
        let (size, whole) = (self.size(), self.whole);
        let is_paired = self.is_paired(n);
        let phases: Vec<[f64; 2]> = (0..self.count).map(|j| self.phase(n, j)).collect();
        // Places of an entry's blocks with their factors.
        let blocks = |entry: &Entry| {
            let (row, column) = (entry.row, entry.column);
            let [cos, sin] = phases[entry.sector];
            let all = [
                (row, column, cos),
                (row, size + column, sin),
                (size + row, column, -sin),
                (size + row, size + column, cos),
            ];
            all.into_iter().take(if is_paired { 4 } else { 1 })
        };
        let positions = self.entries.iter().flat_map(blocks).map(|(row, column, _)| (row, column));
        let dimension = if is_paired { 2 * size } else { size };
        let pattern = Arc::new(SparsityPattern::from_positions(dimension, positions));
        let of_waves = |matrix: &MatrixPolynomial| {
            let coefficients = matrix.coefficients().iter().map(|values| {
                let terms = self.entries.iter().flat_map(|entry| {
                    let value = values[entry.position];
                    blocks(entry).map(move |(row, column, factor)| (row, column, factor * value))
                });
                terms.collect()
            });
            let coefficients: Vec<Vec<(usize, usize, f64)>> = coefficients.collect();
            MatrixPolynomial::on_pattern(&pattern, &coefficients).frozen_below(matrix.origin())
        };
        let touched = |unknowns: &[usize]| -> Vec<usize> {
            let places = unknowns.iter().map(|&unknown| self.place_of[unknown]);
            let own = places.filter(|[sector, _]| *sector == 0).map(|[_, place]| place);
            let second = own.clone().filter(|_| is_paired).map(|place| size + place);
            own.chain(second).collect()
        };
        let tabled = whole.tabled.iter().map(|own| TabledStiffness {
            gain: own.gain.clone(),
            stiffness: of_waves(&own.stiffness),
        });
        SlidingTangent {
            mass: of_waves(&whole.mass),
            damping: of_waves(&whole.damping),
            stiffness: of_waves(&whole.stiffness),
            structural: whole.structural.as_ref().map(of_waves),
            tabled: tabled.collect(),
            proportional: whole.proportional,
            is_gyroscopic: whole.is_gyroscopic,
            unknowns: DofMap::excluding(dimension, []),
            contact: ContactDofs {
                tangential: touched(&whole.contact.tangential),
                normal: touched(&whole.contact.normal),
                opposite: touched(&whole.contact.opposite),
                angles: Vec::new(),
                ..whole.contact
            },
            distances: Vec::new(),
            friction: Vec::new(),
        }
    }

    /// A wave of `n` nodal diameters over all unknowns of the body.
    pub fn expand(&self, n: usize, wave: &[c64]) -> Vec<c64> {
        let size = self.size();
        let mut all = vec![c64::new(0.0, 0.0); self.at.len()];
        for j in 0..self.count {
            let [cos, sin] = self.phase(n, j);
            for i in 0..size {
                let second = wave.get(size + i).map_or(c64::new(0.0, 0.0), |b| b * sin);
                all[self.at[j * size + i]] = wave[i] * cos + second;
            }
        }
        all
    }

    /// `|x|^2` of the whole body over that of the wave: `N`, or `N / 2` where there is a sine.
    pub fn weight(&self, n: usize) -> f64 {
        let half = if self.is_paired(n) { 0.5 } else { 1.0 };
        half * self.count as f64
    }
}

/// What a matrix over `total` places, `size` a sector, makes of a vector, turned by one sector, and
/// what it makes of the vector turned: alike where the matrix is the same in all sectors.
pub(super) fn turned_pair(
    size: usize,
    total: usize,
    multiply: impl Fn(&[f64]) -> Vec<f64>,
) -> [Vec<f64>; 2] {
    // Any vector that has no symmetry of its own.
    let own: Vec<f64> = (0..total).map(|k| (1.0 + k as f64).sqrt().fract() - 0.5).collect();
    let turned = |values: &[f64]| -> Vec<f64> {
        (0..total).map(|k| values[(k + total - size) % total]).collect()
    };
    [turned(&multiply(&own)), multiply(&turned(&own))]
}
