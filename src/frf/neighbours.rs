//! Lines close to each other, solved from one real factorization.

use super::FrfSystem;
use super::direct::Analyses;
use crate::fem::RayleighDamping;
use crate::linalg::{SparseLdl, SparseLu};
use faer::linalg::solvers::Solve;
use faer::{Mat, MatMut, c64};
use std::f64::consts::TAU;

/// Relative residual of the projected systems at which the space is large enough.
const RESIDUAL: f64 = 1e-15;
/// Backward error `|f - A x| / (|A| |x|)` above which a line is not taken from the space.
const BACKWARD_ERROR_BOUND: f64 = 1e-14;
/// `|A| |x| / |f|` above which a matrix has no inverse in double precision.
const GROWTH_BOUND: f64 = 1e15;
/// Most vectors of a space: about what complex factorizations of all lines cost.
const MOST_VECTORS: usize = 72;
/// Vectors between two looks at the residuals.
const STRIDE: usize = 6;

/// Real factors of `K - sigma M`.
enum Factors {
    Symmetric(SparseLdl),
    General(Box<SparseLu>),
}

impl Factors {
    fn new(system: &FrfSystem, analyses: &Analyses, frequency_hz: f64) -> Option<Self> {
        // On an undamped resonance there are no factors; beside it they serve as well.
        [1.0, 1.000_7, 0.999_1].iter().find_map(|moved| {
            let values = system.undamped_stiffness(frequency_hz * moved);
            if system.is_symmetric() {
                let ldl = SparseLdl::factorize(&analyses.ldl, &values).ok()?;
                Some(Self::Symmetric(ldl))
            } else {
                let lu = SparseLu::factorize(&analyses.lu, values).ok()?;
                Some(Self::General(Box::new(lu)))
            }
        })
    }

    fn solve(&self, mut x: Vec<f64>) -> Vec<f64> {
        let count = x.len();
        let column = MatMut::from_column_major_slice_mut(&mut x, count, 1);
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(column),
            Self::General(lu) => lu.solve_in_place(column),
        }
        x
    }
}

/// Solutions of lines `(1 + i omega beta) (K - s M) x = f`, `s = (omega^2 - i omega alpha) / (1 + i omega beta)`.
///
/// With `B = (K - sigma M)^{-1} M` and `g = (K - sigma M)^{-1} f`, both real, every line is
/// `(1 - (s - sigma) B) x = g`: one space `g, B g, B^2 g, ...` serves them all, larger for lines far apart
/// or close to a resonance.
pub(super) struct Neighbours<'a> {
    system: &'a FrfSystem,
    factors: Factors,
    /// Orthonormal vectors, one more than [`Self::images`].
    vectors: Vec<Vec<f64>>,
    /// Column `k`: coefficients of `B v_k` in the vectors.
    images: Vec<Vec<f64>>,
    /// `|g|`.
    length: f64,
}

impl<'a> Neighbours<'a> {
    /// The response at each line; `None` where only a factorization of its own will do.
    pub fn solve(
        system: &'a FrfSystem,
        analyses: &Analyses,
        force: usize,
        response: usize,
        lines: &[f64],
    ) -> Vec<Option<c64>> {
        let nothing = vec![None; lines.len()];
        let Some(rayleigh) = system.proportional() else {
            return nothing;
        };
        let middle = 0.5 * (lines[0] + lines[lines.len() - 1]);
        let Some(factors) = Factors::new(system, analyses, middle) else {
            return nothing;
        };
        let mut unit = vec![0.0; system.dimension()];
        unit[force] = 1.0;
        let start = factors.solve(unit);
        let mut space = Neighbours {
            system,
            factors,
            length: norm(&start),
            vectors: Vec::new(),
            images: Vec::new(),
        };
        space.vectors.push(scaled(start, 1.0 / space.length));
        let sigma = (TAU * middle).powi(2);
        let shifts: Vec<c64> = lines.iter().map(|f| shift(rayleigh, *f)).collect();
        loop {
            let is_closed = (0..STRIDE).any(|_| !space.extend());
            let solved: Vec<_> = shifts.iter().map(|s| space.project(s - sigma)).collect();
            let is_enough = solved.iter().all(|(_, residual)| *residual <= RESIDUAL);
            if is_closed || is_enough || space.images.len() >= MOST_VECTORS {
                return lines
                    .iter()
                    .zip(&solved)
                    .map(|(f, (y, _))| space.accepted(rayleigh, *f, y, force, response))
                    .collect();
            }
        }
    }

    /// One more vector; `false` if the space is complete.
    fn extend(&mut self) -> bool {
        let [mass, _, _] = self.system.matrices();
        let last = &self.vectors[self.vectors.len() - 1];
        let mut image = self.factors.solve(self.system.multiply(mass, last, false));
        let before = norm(&image);
        let mut coefficients = vec![0.0; self.vectors.len()];
        // Twice is enough for orthogonality to round-off.
        for _ in 0..2 {
            for (coefficient, vector) in coefficients.iter_mut().zip(&self.vectors) {
                let product = dot(vector, &image);
                *coefficient += product;
                for (value, v) in image.iter_mut().zip(vector) {
                    *value -= product * v;
                }
            }
        }
        let left = norm(&image);
        let is_new = left > f64::EPSILON * before;
        coefficients.push(if is_new { left } else { 0.0 });
        self.images.push(coefficients);
        if is_new {
            self.vectors.push(scaled(image, 1.0 / left));
        }
        is_new
    }

    /// Coordinates of the Galerkin solution of `(1 - distance B) x = g`, and its relative residual.
    fn project(&self, distance: c64) -> (Vec<c64>, f64) {
        let m = self.images.len();
        let matrix = Mat::<c64>::from_fn(m, m, |i, j| {
            let image = self.images[j].get(i).copied().unwrap_or(0.0);
            let unit = if i == j { 1.0 } else { 0.0 };
            c64::new(unit, 0.0) - distance * image
        });
        let right = Mat::from_fn(m, 1, |i, _| {
            c64::new(if i == 0 { self.length } else { 0.0 }, 0.0)
        });
        let y = matrix.partial_piv_lu().solve(&right);
        let y: Vec<c64> = (0..m).map(|i| y[(i, 0)]).collect();
        let size = y.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
        let next = self.images[m - 1][m];
        let residual = (distance * next * y[m - 1]).norm() / size;
        (y, residual)
    }

    /// The response of coordinates `y`, if they solve the line's own equations to round-off.
    fn accepted(
        &self,
        rayleigh: RayleighDamping,
        frequency_hz: f64,
        y: &[c64],
        force: usize,
        response: usize,
    ) -> Option<c64> {
        let count = self.system.dimension();
        let (mut real, mut imaginary) = (vec![0.0; count], vec![0.0; count]);
        let omega = TAU * frequency_hz;
        let factor = c64::new(1.0, 0.0) / c64::new(1.0, omega * rayleigh.stiffness_coefficient);
        for (coordinate, vector) in y.iter().zip(&self.vectors) {
            let coordinate = coordinate * factor;
            for ((re, im), v) in real.iter_mut().zip(&mut imaginary).zip(vector) {
                *re += coordinate.re * v;
                *im += coordinate.im * v;
            }
        }
        let x: Vec<c64> = real
            .iter()
            .zip(&imaginary)
            .map(|(re, im)| c64::new(*re, *im))
            .collect();
        let (residual, size) = self.system.residual(frequency_hz, &x, force);
        let is_solved = residual <= BACKWARD_ERROR_BOUND * size && size < GROWTH_BOUND;
        is_solved.then(|| x[response])
    }
}

/// `s` at a frequency.
fn shift(rayleigh: RayleighDamping, frequency_hz: f64) -> c64 {
    let omega = TAU * frequency_hz;
    c64::new(omega * omega, -omega * rayleigh.mass_coefficient)
        / c64::new(1.0, omega * rayleigh.stiffness_coefficient)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Eight partial sums, so that additions need not wait for each other.
    let mut sums = [0.0; 8];
    let (a_blocks, b_blocks) = (a.chunks_exact(8), b.chunks_exact(8));
    let tail = a_blocks.remainder().iter().zip(b_blocks.remainder());
    let rest: f64 = tail.map(|(x, y)| x * y).sum();
    for (x, y) in a_blocks.zip(b_blocks) {
        for lane in 0..8 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn scaled(mut a: Vec<f64>, factor: f64) -> Vec<f64> {
    a.iter_mut().for_each(|value| *value *= factor);
    a
}
