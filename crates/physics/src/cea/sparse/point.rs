//! All modes at one friction coefficient, each held to its residual in the full matrices.

use super::basis::BasisBuilder;
use super::edge::ContactEdge;
use super::left::{OpenPair, correct_lefts};
use super::linearization::Linearization;
use super::mode::ReducedMode;
use super::packed::{PackedModes, PackedVector, joined, side_by_side};
use super::reduced::{ReducedModel, inside};
use super::structure::StructureMatrices;
use super::{GROUP_WIDTH, RESIDUAL_BOUND, TRACKING_MARGIN};
use crate::cea::vectors::length;
use crate::cea::{ModeLimit, ModeVectors, keeping_ties};
use crate::linalg::{LinalgError, Mat, c64};
use crate::prestress::SlidingTangent;
use std::f64::consts::TAU;

/// Residual relative to the matrices below which there is only round-off.
const ROUND_OFF: f64 = 1e-15;
/// What the full matrices say about one mode.
#[derive(Clone, Debug)]
pub struct ModeCheck {
    /// `|T(lambda) x| / ((|lambda|^2 |M| + |lambda| |C| + |K|) |x|)`.
    pub residual: f64,
    /// `|T(lambda) x| / ((|lambda|^2 + c^2) |M x|)`: stricter, as it does not count the stiffest waves of the mesh.
    pub force_residual: f64,
    /// See [`crate::cea::ComplexMode::uncertainty`].
    pub uncertainty: f64,
    /// See [`crate::cea::ComplexMode::contact_share`].
    pub contact_share: f64,
    /// Displacements of the contact edge.
    pub edge: Vec<c64>,
    /// Largest displacement.
    pub peak: f64,
}

/// The modes at one friction coefficient.
#[derive(Clone, Debug)]
pub struct SolvedPoint {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Modes by rising frequency; a few more than wanted.
    pub modes: Vec<ReducedMode>,
    /// Number of leading modes that are wanted.
    pub wanted: usize,
    /// Checks of leading modes, at least the wanted ones.
    pub checks: Vec<ModeCheck>,
    /// Frequency up to which modes are wanted here, rad/s: that of the highest where a number of them is.
    pub range_end: f64,
    /// Columns of the sample that it was solved in, where there is one of its own.
    pub solved_in: Option<usize>,
    /// Whether left vectors are coarse still.
    has_coarse_lefts: bool,
}

impl SolvedPoint {
    /// Largest residuals of the wanted modes: relative to the matrices, and to the inertia force.
    pub fn worst(&self) -> (f64, f64) {
        let wanted = self.checks.iter().take(self.wanted);
        wanted
            .fold((0.0, 0.0), |(r, f), check| (check.residual.max(r), check.force_residual.max(f)))
    }

    /// The wanted modes that could still be improved: their residual force, relative to the inertia force, is above `goal`, or their
    /// residual above the bound of converged pairs.
    pub fn open_modes(&self, goal: f64) -> impl Iterator<Item = &ReducedMode> {
        let pairs = self.modes.iter().zip(&self.checks).take(self.wanted);
        let open = pairs.filter(move |(_, check)| {
            // A residual of round-off is no excuse where the mode answers to it.
            let error = check.residual / f64::EPSILON * check.uncertainty;
            let is_round_off = check.residual <= ROUND_OFF && error <= RESIDUAL_BOUND;
            let is_fine = check.force_residual <= goal && check.residual <= RESIDUAL_BOUND;
            !is_fine && !is_round_off
        });
        open.map(|(mode, _)| mode)
    }

    /// Takes out the modes that have not converged; their frequencies, rad/s.
    pub fn drop_unconverged(&mut self) -> Vec<f64> {
        let mut dropped = Vec::new();
        for i in (0..self.wanted.min(self.checks.len())).rev() {
            if !(self.checks[i].residual <= RESIDUAL_BOUND) {
                self.checks.remove(i);
                dropped.push(self.modes.remove(i).eigenvalue.im);
                self.wanted -= 1;
            }
        }
        dropped
    }

    /// Left vectors in the whole basis of `model`, with what depends on them: each takes an LU of that size, so points get them once
    /// their modes have converged.
    pub fn refine_lefts(&mut self, model: &ReducedModel) {
        if !std::mem::take(&mut self.has_coarse_lefts) {
            return;
        }
        let lengths = |modes: &[ReducedMode]| -> Vec<f64> {
            modes.iter().map(|mode| length(&mode.left)).collect()
        };
        let coarse = lengths(&self.modes);
        model.refine_lefts(&mut self.modes, self.friction_coefficient);
        let refined = lengths(&self.modes);
        for (check, (old, new)) in self.checks.iter_mut().zip(coarse.iter().zip(&refined)) {
            check.uncertainty *= new / old;
        }
    }

    /// The same modes in the span of `columns`, orthonormal coordinates in the basis until now; left vectors are coarse again.
    pub(super) fn restrict(&mut self, columns: &Mat<f64>) {
        self.has_coarse_lefts = true;
        for mode in &mut self.modes {
            for vector in [&mut mode.right, &mut mode.left] {
                *vector = inside(columns, vector);
            }
        }
    }
}

/// What every point of a sweep needs.
pub struct PointSolver<'a> {
    /// The matrices.
    pub tangent: &'a SlidingTangent,
    /// How their eigenproblem is solved.
    pub linearization: Linearization,
    /// The contact edge.
    pub edge: &'a ContactEdge,
    /// Which modes are wanted.
    pub limit: ModeLimit,
    /// Modes tracked.
    pub count: usize,
}

impl PointSolver<'_> {
    /// The modes of the projected problem at `mu`. Left vectors are coarse ones, until [`SolvedPoint::refine_lefts`]. With `leaves_out`
    /// motions near critical damping that have not converged take no places: combinations of what the basis does not hold.
    pub fn modes(
        &self,
        model: &ReducedModel,
        mu: f64,
        leaves_out: bool,
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        let mut modes = model.solve_with_coarse_lefts(mu, self.count + TRACKING_MARGIN)?;
        if leaves_out {
            let checks = self.check(model, mu, &modes);
            let mut converged = checks.iter().map(|check| check.residual <= RESIDUAL_BOUND);
            modes.retain(|mode| converged.next() == Some(true) || !mode.is_nearly_critical());
        }
        Ok(modes)
    }

    /// The point of these modes at `mu`, with their checks in the full matrices.
    pub fn checked(&self, model: &ReducedModel, mu: f64, modes: Vec<ReducedMode>) -> SolvedPoint {
        let wanted = self.wanted(&modes);
        let range_end = match self.limit {
            ModeLimit::Lowest(_) => modes[..wanted].last().map_or(0.0, |m| m.eigenvalue.im),
            ModeLimit::MaxFrequency(hz) => TAU * hz,
        };
        let checked = self.count.max(wanted).min(modes.len());
        let checks = self.check(model, mu, &modes[..checked]);
        SolvedPoint {
            friction_coefficient: mu,
            modes,
            wanted,
            checks,
            range_end,
            solved_in: model.sample_width(mu),
            has_coarse_lefts: true,
        }
    }

    /// How many of `modes`, by rising frequency, are wanted.
    pub fn wanted(&self, modes: &[ReducedMode]) -> usize {
        let frequencies = modes.iter().map(|mode| mode.eigenvalue.im);
        match self.limit {
            ModeLimit::Lowest(count) => keeping_ties(frequencies, count),
            ModeLimit::MaxFrequency(hz) => frequencies.take_while(|own| *own < TAU * hz).count(),
        }
    }

    /// Residuals and edge displacements of `modes` in the full matrices at `mu`.
    pub fn check(&self, model: &ReducedModel, mu: f64, modes: &[ReducedMode]) -> Vec<ModeCheck> {
        let matrices = StructureMatrices::at(self.tangent, self.linearization, mu);
        let packed = PackedModes::of(modes, model.dimension());
        let norms = matrices.norms();
        let mut checks: Vec<(usize, ModeCheck)> = Vec::with_capacity(modes.len());
        for group in packed.groups(GROUP_WIDTH) {
            let x = model.expand(packed.coordinates.get(.., group.columns.clone()));
            let (residuals, momenta) = matrices.residuals_and_momenta(&group.entries, x.as_ref());
            for &j in &group.modes {
                let lambda = modes[j].eigenvalue;
                let modulus = lambda.norm();
                let [residual, momentum, shape] =
                    [&residuals, &momenta, &x].map(|mapped| packed.vector(j, &group, mapped));
                let force = matrices.residual_factor(lambda) * residual.norm();
                let inertia = self.linearization.inertia(lambda) * momentum.norm();
                let scale = modulus * modulus * norms[2] + modulus * norms[1] + norms[0];
                let check = ModeCheck {
                    residual: force / (scale * shape.norm()),
                    force_residual: force / inertia,
                    uncertainty: f64::EPSILON * scale * length(&modes[j].left) / modulus,
                    contact_share: self.contact_share(shape, momentum),
                    edge: self.edge.restrict(|unknown| shape.at(unknown)),
                    peak: shape.peak(),
                };
                checks.push((j, check));
            }
        }
        checks.sort_by_key(|(j, _)| *j);
        checks.into_iter().map(|(_, check)| check).collect()
    }

    /// Kinetic energy of the contact edge's nodes over the whole. `momentum` is `M(mu) x`, which differs from
    /// that of the body alone, `M(0) x`, in the rows of these nodes.
    fn contact_share(&self, x: PackedVector<'_>, momentum: PackedVector<'_>) -> f64 {
        let mass = &self.tangent.mass;
        let (pattern, values) = (mass.pattern(), &mass.coefficients()[0]);
        let along = |i: usize, p: c64| x.at(i).re * p.re + x.at(i).im * p.im;
        let (mut edge, mut friction) = (0.0, 0.0);
        let contact = &self.tangent.contact;
        let touched = [&contact.tangential, &contact.normal, &contact.opposite];
        for &i in touched.into_iter().flatten() {
            let row = pattern.row(i);
            let own: c64 = row.map(|(position, j)| x.at(j) * values[position]).sum();
            edge += along(i, own);
            friction += along(i, momentum.at(i) - own);
        }
        let whole: f64 = (0..pattern.dimension()).map(|i| along(i, momentum.at(i))).sum();
        edge / (whole - friction)
    }

    /// Right and, `with_lefts`, left vectors of `modes` at `mu` over all nodal dofs, see [`ModeVectors`]; left ones are corrected by
    /// the stiffness and the modes without friction.
    pub fn vectors(
        &self,
        basis: &BasisBuilder<'_>,
        (mu, with_lefts): (f64, bool),
        modes: &[ReducedMode],
    ) -> Vec<ModeVectors> {
        let model = &basis.model;
        let rights = self.expanded(model, modes, |mode| &mode.right);
        let lefts = match with_lefts {
            true => self.expanded(model, modes, |mode| &mode.left),
            false => vec![Vec::new(); modes.len()],
        };
        let own = |((mode, right), left): ((&ReducedMode, _), _)| OpenPair {
            eigenvalue: mode.eigenvalue,
            right,
            left,
        };
        let mut pairs: Vec<OpenPair> = modes.iter().zip(rights).zip(lefts).map(own).collect();
        if with_lefts {
            let leading = basis.leading_count().min(model.dimension());
            let leading = model.expand(Mat::identity(leading, leading).as_ref());
            correct_lefts(self.tangent, (&basis.factors, leading), mu, &mut pairs);
        }
        let pairs = modes.iter().zip(pairs);
        pairs
            .map(|(mode, pair)| {
                let mut right = self.tangent.displacement(&pair.right);
                let scale = normalize(&mut right);
                let mut left = match with_lefts {
                    true => self.tangent.left_displacement(&pair.left, mu),
                    false => Vec::new(),
                };
                left.iter_mut().for_each(|v| *v *= scale);
                ModeVectors { eigenvalue: mode.eigenvalue, rate: mode.derivative, right, left }
            })
            .collect()
    }

    /// Vectors of `modes` over the unknowns, of their coordinates as they are.
    fn expanded(
        &self,
        model: &ReducedModel,
        modes: &[ReducedMode],
        of: impl Fn(&ReducedMode) -> &Vec<c64>,
    ) -> Vec<Vec<c64>> {
        let groups = modes.chunks(GROUP_WIDTH / 2).flat_map(|group| {
            let coordinates: Vec<&Vec<c64>> = group.iter().map(&of).collect();
            let x = model.expand(side_by_side(model.dimension(), &coordinates).as_ref());
            (0..group.len()).map(move |j| joined(&x, j))
        });
        groups.collect()
    }
}

/// Scales a nodal vector so that its largest entry is 1; what it was divided by.
pub fn normalize(shape: &mut [c64]) -> c64 {
    let zero = c64::new(0.0, 0.0);
    let largest =
        shape.iter().fold(zero, |best, &v| if v.norm_sqr() > best.norm_sqr() { v } else { best });
    if largest == zero {
        return c64::new(1.0, 0.0);
    }
    shape.iter_mut().for_each(|v| *v /= largest);
    largest
}
