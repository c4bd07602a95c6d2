//! Derivatives of the eigenvalues of a body of revolution by the parameters of the model.

use super::SolidSweep;
use crate::cea::cyclic::sensitivity::{PARAMETERS, Sensitivity, Wave};
use crate::cea::cyclic::vectors::{ZERO, normalize};
use crate::cea::{CeaError, ModeBranch};
use crate::linalg::banded::{BandedLu, BandedMatrix, CompactRows, multiply_band};
use crate::linalg::c64;
use crate::prestress::{MovingHarmonic, SolidHarmonic, SolidRate};
use rayon::prelude::*;

/// Rayleigh quotient iterations of one branch at most, each with two solves of either side.
const ITERATIONS: usize = 8;

/// Change of an eigenvalue relative to it at which its vectors have settled to the square of that.
const SETTLED: f64 = 1e-8;

/// Distance relative to an eigenvalue from that of its branch above which it is another's: small spaces leave out far less.
const LOST: f64 = 1e-3;

/// [`crate::cea::cyclic::sensitivities`] of a body of revolution: of every branch that oscillates at that friction coefficient, but
/// for those that Rayleigh quotient iteration does not find again.
///
/// Eigenvalues and vectors are those of the whole harmonic, not of the small space that the branches were followed in. In rigid contact the
/// left vector's part along a pressed normal is `s mu` times that along its tangent, so that a change of the drag adds the normal
/// force's virtual work:
///
/// ```text
/// d lambda = - (y^H dT x + sum conj(y_t) i mu ds (T x)_n) / y^H (2 lambda M + C) x,   T = lambda^2 M + lambda C + K
/// ```
///
/// # Errors
/// [`CeaError::Prestress`] as for the base state itself.
pub fn solid_sensitivities(
    result: &SolidSweep,
    friction_coefficient: f64,
) -> Result<Vec<Sensitivity>, CeaError> {
    let tangent = &result.tangent;
    let rates: Result<Vec<Option<SolidRate>>, _> =
        PARAMETERS.into_par_iter().map(|parameter| tangent.rate(parameter)).collect();
    let rates = rates?;
    let found: Vec<Vec<(usize, Sensitivity)>> = result
        .coverage
        .followed
        .par_iter()
        .map(|&n| of_harmonic(result, &rates, n, friction_coefficient))
        .collect();
    let mut found: Vec<(usize, Sensitivity)> = found.into_iter().flatten().collect();
    found.sort_by_key(|(place, _)| *place);
    Ok(found.into_iter().map(|(_, own)| own).collect())
}

/// An eigenpair of a whole harmonic.
struct FullPair {
    /// Place of its branch in the sweep.
    place: usize,
    wave: Wave,
    root: c64,
    /// Right and left vector over all unknowns.
    x: Vec<c64>,
    y: Vec<c64>,
    /// `y^H (2 lambda M + C) x`.
    slope: c64,
    /// `conj(y_t) i (T x)_n` of each node in rigid contact.
    works: Vec<c64>,
}

/// Sensitivities of the branches of harmonic `n` with their places in the sweep.
fn of_harmonic(
    result: &SolidSweep,
    rates: &[Option<SolidRate>],
    n: usize,
    friction: f64,
) -> Vec<(usize, Sensitivity)> {
    let tangent = &result.tangent;
    let harmonic = tangent.harmonic(n);
    let full = Full::new(&harmonic, friction);
    let direction = tangent.base().sliding_direction;
    let own = result.branches.par_iter().enumerate();
    let own = own.filter(|(_, branch)| branch.harmonic == n);
    let pairs: Vec<FullPair> = own
        .filter_map(|(place, branch)| full.pair(place, branch, Wave::of(branch, direction)))
        .collect();
    let by_friction = friction_terms(&harmonic);
    let mut responses: Vec<Vec<Option<c64>>> = vec![Vec::new(); pairs.len()];
    for rate in rates {
        let terms = rate.as_ref().map(|rate| {
            let rate = tangent.harmonic_rate(rate, n);
            let drags: Vec<f64> = rate.rigid.iter().map(|(.., drag)| friction * drag).collect();
            (terms(&rate, friction), drags)
        });
        for (responses, pair) in responses.iter_mut().zip(&pairs) {
            let own = terms.as_ref();
            responses.push(own.map(|(terms, drags)| pair.response(terms, drags)));
        }
    }
    let factors: Vec<f64> = harmonic.rigid.iter().map(|(.., factor)| *factor).collect();
    let of_pair = |(pair, responses): (&FullPair, &Vec<Option<c64>>)| {
        let by_friction = pair.response(&by_friction, &factors);
        let branch = &result.branches[pair.place];
        (pair.place, Sensitivity::new(branch, friction, pair.eigenvalue(), by_friction, responses))
    };
    pairs.iter().zip(&responses).map(of_pair).collect()
}

/// A term of `dT`: a real matrix times a constant and a power of `lambda`.
type Term = (c64, i32, CompactRows);

/// `dT` of the derivatives of a harmonic's matrices.
fn terms(rate: &SolidHarmonic, friction: f64) -> Vec<Term> {
    let (one, turn) = (c64::new(1.0, 0.0), c64::new(0.0, friction));
    let [k0, k1] = &rate.stiffness;
    let [c0, c1] = &rate.damping;
    let all = [
        (one, 2, &rate.mass),
        (one, 1, c0),
        (turn, 1, c1),
        (friction * one, 1, &rate.across),
        (one, 0, k0),
        (turn, 0, k1),
    ];
    all.into_iter().filter_map(term).collect()
}

/// `dT / d mu` of a harmonic.
fn friction_terms(harmonic: &SolidHarmonic) -> Vec<Term> {
    let (one, turn) = (c64::new(1.0, 0.0), c64::new(0.0, 1.0));
    let all = [
        (turn, 1, &harmonic.damping[1]),
        (one, 1, &harmonic.across),
        (turn, 0, &harmonic.stiffness[1]),
    ];
    all.into_iter().filter_map(term).collect()
}

/// Only a few of the derivatives are there.
fn term((factor, power, matrix): (c64, i32, &BandedMatrix)) -> Option<Term> {
    let is_there = matrix.values().iter().any(|value| *value != 0.0);
    is_there.then(|| (factor, power, CompactRows::new(matrix)))
}

impl FullPair {
    /// `lambda` of the branch's own wave.
    fn eigenvalue(&self) -> c64 {
        self.wave.own(self.root)
    }

    /// `d lambda / d parameter`.
    fn response(&self, terms: &[Term], drags: &[f64]) -> c64 {
        let forms = terms.iter().map(|(factor, power, matrix)| {
            factor * self.root.powi(*power) * matrix.form(&self.y, &self.x)
        });
        let works = self.works.iter().zip(drags).map(|(work, drag)| work * *drag);
        let response = -(forms.sum::<c64>() + works.sum::<c64>()) / self.slope;
        self.wave.own(response)
    }
}

/// One harmonic at one friction coefficient.
struct Full<'a> {
    harmonic: &'a SolidHarmonic,
    friction: f64,
    at: MovingHarmonic,
    moving: Vec<usize>,
}

impl<'a> Full<'a> {
    fn new(harmonic: &'a SolidHarmonic, friction: f64) -> Self {
        Self { at: harmonic.at(friction), moving: harmonic.moving(), harmonic, friction }
    }

    /// The eigenpair of a branch, from its eigenvalue in the small space; `None` where it has stopped to oscillate or is not found.
    fn pair(&self, place: usize, branch: &ModeBranch, wave: Wave) -> Option<FullPair> {
        let start = wave.own(branch.interpolate(self.friction)?);
        let (mut x, mut y) = (self.any_vector(0.3), self.any_vector(1.1));
        let mut root = start;
        for _ in 0..ITERATIONS {
            let lu = self.factorized(root);
            for _ in 0..2 {
                x = self.apply_slope(root, &x, false);
                lu.solve(&mut x);
                normalize(&mut x);
                y = self.apply_slope(root, &y, true);
                lu.solve_adjoint(&mut y);
                normalize(&mut y);
            }
            let last = root;
            root = self.rayleigh_quotient(last, &x, &y);
            if (root - last).norm() <= SETTLED * root.norm() {
                break;
            }
        }
        // Not so of what is not a number.
        let is_it = (root - start).norm() <= LOST * start.norm();
        let slope = self.apply_slope(root, &x, false);
        let slope = y.iter().zip(&slope).map(|(y, s)| y.conj() * s).sum();
        is_it.then(|| self.whole((place, wave, root), [x, y], slope))
    }

    /// A vector with a part of every mode.
    fn any_vector(&self, phase: f64) -> Vec<c64> {
        let entry = |i: usize| {
            let at = i as f64;
            c64::new(1.0 + (1.7 * at).sin(), (phase + 0.9 * at).cos())
        };
        (0..self.moving.len()).map(entry).collect()
    }
}

impl Full<'_> {
    /// `T(root)`, factorized.
    fn factorized(&self, root: c64) -> BandedLu {
        let MovingHarmonic { mass, damping, stiffness, half_bandwidth } = &self.at;
        let entries = mass.iter().zip(damping).zip(stiffness);
        let band: Vec<c64> = entries.map(|((m, c), k)| k + root * (c + root * m)).collect();
        let mut lu = BandedLu::new(self.moving.len(), *half_bandwidth);
        lu.factorize(&band);
        lu
    }

    /// `(2 root M + C) x` or its adjoint.
    fn apply_slope(&self, root: c64, x: &[c64], adjoint: bool) -> Vec<c64> {
        let h = self.at.half_bandwidth;
        let factor = root + root;
        let factor = if adjoint { factor.conj() } else { factor };
        let mass = multiply_band(&self.at.mass, h, x, adjoint);
        let damping = multiply_band(&self.at.damping, h, x, adjoint);
        mass.iter().zip(damping).map(|(m, c)| factor * m + c).collect()
    }

    /// The root of `y^H T(.) x = 0` nearest to `near`.
    fn rayleigh_quotient(&self, near: c64, x: &[c64], y: &[c64]) -> c64 {
        let form = |band: &[c64]| -> c64 {
            let image = multiply_band(band, self.at.half_bandwidth, x, false);
            y.iter().zip(image).map(|(y, v)| y.conj() * v).sum()
        };
        let [m, c, k] = [&self.at.mass, &self.at.damping, &self.at.stiffness].map(|b| form(b));
        let root = (c * c - m * k * 4.0).sqrt();
        let roots = [(root - c) / (m * 2.0), (-root - c) / (m * 2.0)];
        match (roots[0] - near).norm() <= (roots[1] - near).norm() {
            true => roots[0],
            false => roots[1],
        }
    }

    /// The pair over all unknowns.
    fn whole(
        &self,
        (place, wave, root): (usize, Wave, c64),
        moving: [Vec<c64>; 2],
        slope: c64,
    ) -> FullPair {
        let harmonic = self.harmonic;
        let [x, mut y] = moving.map(|part| {
            let mut whole = vec![ZERO; harmonic.mass.dimension()];
            for (&unknown, value) in self.moving.iter().zip(part) {
                whole[unknown] = value;
            }
            whole
        });
        let turn = c64::new(0.0, self.friction);
        let forces = self.normal_forces(root, &x);
        let mut works = Vec::with_capacity(forces.len());
        for (&(normal, tangential, factor), force) in harmonic.rigid.iter().zip(forces) {
            let along = tangential.map_or(ZERO, |t| y[t]);
            y[normal] = (turn * factor).conj() * along;
            works.push(along.conj() * c64::new(0.0, 1.0) * force);
        }
        FullPair { place, wave, root, x, y, slope, works }
    }

    /// `(T x)_n` of each node in rigid contact.
    fn normal_forces(&self, root: c64, x: &[c64]) -> Vec<c64> {
        let harmonic = self.harmonic;
        let (one, turn) = (c64::new(1.0, 0.0), c64::new(0.0, self.friction));
        let [k0, k1] = &harmonic.stiffness;
        let [c0, c1] = &harmonic.damping;
        let terms = [
            (one, k0),
            (turn, k1),
            (root, c0),
            (root * turn, c1),
            (root * self.friction, &harmonic.across),
            (root * root, &harmonic.mass),
        ];
        let rows = harmonic.rigid.iter().map(|(normal, ..)| *normal);
        let force = |row: usize| -> c64 {
            let products = terms.iter().map(|(factor, matrix)| {
                let columns = matrix.columns(row);
                let sum: c64 = columns.map(|j| x[j] * matrix.get(row, j)).sum();
                factor * sum
            });
            products.sum()
        };
        rows.map(force).collect()
    }
}
