//! Tangents of a body with cyclic symmetry, one for each number of nodal diameters.

use crate::cea::sparse::*;
use crate::fem::DofMap;
use crate::mesh::CyclicSymmetry;
use crate::prestress::{ContactDofs, without_symmetry};

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
    /// Sectors of the body.
    count: usize,
    /// Unknowns of each: those of sector `j` are the ones from `j * size` on.
    size: usize,
}

impl<'a> CyclicTangent<'a> {
    /// The waves of `whole`, the tangent of a mesh of `node_count` nodes that has the symmetry, up to the friction coefficient `highest`.
    ///
    /// # Errors
    /// In words what differs from sector to sector: supports, loads or masses in one place only, an asymmetric state of contact.
    pub fn new(
        whole: &'a SlidingTangent,
        symmetry: &CyclicSymmetry,
        (node_count, highest): (usize, f64),
    ) -> Result<Self, String> {
        let (count, unknowns) = (symmetry.count, &whole.unknowns);
        // Nodes, and with them unknowns, follow each other sector by sector.
        let per_sector = unknowns.unknown_of.len() / node_count * (node_count / count);
        let start = |j: usize| unknowns.dofs.partition_point(|&dof| dof < j * per_sector);
        let places = |j: usize| {
            let dofs = &unknowns.dofs[start(j)..start(j + 1)];
            dofs.iter().map(|dof| dof % per_sector)
        };
        if let Some(j) = (1..count).find(|&j| !places(j).eq(places(0))) {
            return Err(format!(
                "sector {} is held, tied or pressed otherwise than the first",
                j + 1
            ));
        }
        let own = Self { whole, count, size: start(1) };
        own.check_alike(highest)?;
        Ok(own)
    }

    /// Refuses matrices that differ from sector to sector somewhere up to a friction coefficient.
    fn check_alike(&self, highest: f64) -> Result<(), String> {
        let (size, total, whole) = (self.size, self.size * self.count, self.whole);
        let pattern = whole.stiffness.pattern();
        let viscous =
            [("mass", &whole.mass), ("damping", &whole.damping), ("stiffness", &whole.stiffness)];
        let losses = whole.losses.iter().map(|(gain, own)| match gain.0 {
            None => ("structural damping", own),
            Some(_) => ("stiffness of a part with a table", own),
        });
        for (what, matrix) in viscous.into_iter().chain(losses) {
            let pairs = matrix.coefficients().iter().enumerate().map(|(power, values)| {
                let reach = (highest - matrix.origin()).max(0.0).powi(power as i32); // Of a power of (mu - a).
                turned_pair(size, total, |x| {
                    let row = |row| pattern.row(row).map(|(k, column)| values[k] * x[column]).sum();
                    (0..total).map(row).map(|own: f64| reach * own).collect()
                })
            });
            // Powers of mu that almost cancel are held to the others.
            let pairs: Vec<[Vec<f64>; 2]> = pairs.collect();
            let mut largest = vec![0.0_f64; size];
            for (k, value) in pairs.iter().flat_map(|pair| pair[0].iter().enumerate()) {
                largest[k % size] = largest[k % size].max(value.abs()); // Each row by what it has in any power and sector.
            }
            let differs = |[a, b]: &[Vec<f64>; 2]| {
                (0..total).find(|&k| (a[k] - b[k]).abs() > HALF_THE_DIGITS * largest[k % size])
            };
            if let Some(k) = pairs.iter().find_map(differs) {
                let sector = k / size + 1;
                return Err(format!("the {what} of sector {sector} differs from that before it"));
            }
        }
        Ok(())
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
        let (size, whole) = (self.size, self.whole);
        let blocks = if self.is_paired(n) { 2 } else { 1 };
        let phases: Vec<[f64; 2]> = (0..self.count).map(|j| self.phase(n, j)).collect();
        // Where the entries in the rows of sector 0 come to stand, with their positions and factors.
        let entries_of = |row: usize| whole.stiffness.pattern().row(row).map(move |own| (row, own));
        let entries = (0..size).flat_map(entries_of).flat_map(|(row, (position, column))| {
            let ([cos, sin], column) = (phases[column / size], column % size); // Phase of the sector, and place in it.
            let all = [
                (row, column, cos),
                (row, size + column, sin),
                (size + row, column, -sin),
                (size + row, size + column, cos),
            ];
            all.into_iter().take(blocks * blocks).map(move |own| (position, own)) // One block, or [C S; -S C].
        });
        let entries: Vec<(usize, (usize, usize, f64))> = entries.collect();
        let positions = entries.iter().map(|&(_, (row, column, _))| (row, column));
        let pattern = Arc::new(SparsityPattern::from_positions(blocks * size, positions));
        let of_waves = |matrix: &MatrixPolynomial| {
            let coefficients = matrix.coefficients().iter().map(|values| {
                let entries = entries.iter();
                entries.map(|&(at, (row, column, factor))| (row, column, factor * values[at]))
            });
            let coefficients: Vec<Vec<_>> = coefficients.map(Iterator::collect).collect();
            MatrixPolynomial::on_pattern(&pattern, &coefficients).frozen_below(matrix.origin()) // Sums over the sectors: C and S.
        };
        let touched = |unknowns: &[usize]| -> Vec<usize> {
            let own = unknowns.iter().copied().filter(|unknown| *unknown < size);
            (0..blocks).flat_map(|block| own.clone().map(move |k| block * size + k)).collect() // In a and in b.
        };
        let MotionMatrices { stiffness, damping, mass, losses } =
            MotionMatrices::of(whole, of_waves);
        SlidingTangent {
            mass,
            damping,
            stiffness,
            losses,
            proportional: whole.proportional,
            is_gyroscopic: whole.is_gyroscopic,
            unknowns: DofMap::excluding(blocks * size, []), // Unknowns stand for dofs here.
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
        let (first, second) = wave.split_at(self.size);
        let of_sector = |j: usize| {
            let [cos, sin] = self.phase(n, j);
            let sine = move |i: usize| second.get(i).map_or(c64::ZERO, |b| b * sin);
            first.iter().enumerate().map(move |(i, a)| a * cos + sine(i))
        };
        (0..self.count).flat_map(of_sector).collect()
    }

    /// `|x|^2` of the whole body over that of the wave: `N`, or `N / 2` where there is a sine.
    pub fn weight(&self, n: usize) -> f64 {
        let half = if self.is_paired(n) { 0.5 } else { 1.0 };
        half * self.count as f64
    }
}

/// What a matrix over `total` places, `size` a sector, makes of a vector, turned by one sector, and
/// what it makes of the vector turned: alike where the matrix is the same in all sectors.
fn turned_pair(size: usize, total: usize, multiply: impl Fn(&[f64]) -> Vec<f64>) -> [Vec<f64>; 2] {
    let own: Vec<f64> = (0..total).map(without_symmetry).collect();
    let turned = |values: &[f64]| -> Vec<f64> {
        (0..total).map(|k| values[(k + total - size) % total]).collect()
    };
    [turned(&multiply(&own)), multiply(&turned(&own))]
}
