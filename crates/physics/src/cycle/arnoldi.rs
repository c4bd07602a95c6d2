//! Leading multipliers of small perturbations over one period, by Arnoldi's process on the map of the period.

use super::CycleError;
use crate::linalg::dense::{dot, norm, orthogonalize};
use crate::linalg::dense_eigen::{complex_column, real_eigen};
use crate::linalg::{Mat, c64};

/// What is looked for, and until when.
pub struct MultiplierSearch<'a> {
    /// Smallest and largest dimension of the Krylov space, and periods between two looks at it.
    pub dimensions: [usize; 3],
    /// How many leading multipliers must have converged, and the residual below which they have, relative to them.
    pub converged: (usize, f64),
    /// Multipliers kept, and the residual below which one is worth listing.
    pub listed: (usize, f64),
    /// Whether a value with such a share along the motion may be the shift in phase.
    pub is_shift: &'a dyn Fn(&Ritz) -> bool,
    /// The key of a case by which a transient tells.
    pub remedy: &'a str,
}

/// A Ritz value of the map.
#[derive(Clone, Debug)]
pub struct Ritz {
    /// The multiplier `rho`: a perturbation is `rho` times as large after a period.
    pub value: c64,
    /// What its vector is of the basis, not of unit length.
    pub factors: Vec<c64>,
    /// `|P v - rho v| / |rho v|`.
    pub residual: f64,
    /// Share of its vector along the motion.
    pub along: f64,
}

/// What came of a search.
pub struct LeadingMultipliers {
    /// The leading ones but for the shift, by falling modulus, one of each conjugate pair.
    pub listed: Vec<Ritz>,
    /// That of the shift in phase, where it was found.
    pub shift: Option<c64>,
    basis: Vec<Vec<f64>>,
}

impl MultiplierSearch<'_> {
    /// Enlarges the Krylov space `P V = V H + h v e^T` of the map `apply` from `start` until the leading multipliers have converged;
    /// `motion` is the direction of a shift in phase.
    ///
    /// # Errors
    /// [`CycleError::NotFound`] where none is worth listing.
    pub fn run(
        &self,
        start: &[f64],
        motion: Vec<f64>,
        mut apply: impl FnMut(&[f64]) -> Vec<f64>,
    ) -> Result<LeadingMultipliers, CycleError> {
        // What is damped within a period is of no interest.
        let mut basis = vec![unit(apply(start))];
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let motion = unit(motion);
        let [least, most, stride] = self.dimensions;
        let none = |dimension: usize| {
            CycleError::NotFound(format!(
                "the stability of this limit cycle cannot be told: no multiplier has converged after \
                 {dimension} periods; let a transient tell ({})",
                self.remedy
            ))
        };
        loop {
            // One more vector.
            let mut next = apply(&basis[basis.len() - 1]);
            let mut column = orthogonalize(&mut next, &basis); // H_ik = v_i^T P v_k; what is left is P v_k - V H_k.
            column.push(norm(&next)); // Below the diagonal stands the length of what is left.
            basis.push(unit(next));
            columns.push(column);
            let dimension = columns.len();
            if dimension < least || !dimension.is_multiple_of(stride) {
                continue;
            }

            // The leading ones, once in a while: the shift in phase stands apart.
            let mut listed = ritz(&columns, &basis, &motion).ok_or_else(|| none(dimension))?;
            let candidates = listed.iter().enumerate().filter(|(_, own)| (self.is_shift)(own));
            let place = candidates.max_by(|a, b| a.1.along.total_cmp(&b.1.along)).map(|own| own.0);
            let shift = place.map(|place| listed.remove(place).value);
            let (count, residual) = self.converged;
            let is_done = shift.is_some()
                && listed.len() >= count
                && listed[..count].iter().all(|own| own.residual < residual);
            if is_done || dimension >= most {
                let (kept, residual) = self.listed;
                let open = listed.iter().position(|own| own.residual >= residual);
                listed.truncate(open.unwrap_or(kept).min(kept));
                let found = LeadingMultipliers { listed, shift, basis };
                return if found.listed.is_empty() { Err(none(dimension)) } else { Ok(found) };
            }
        }
    }
}

impl LeadingMultipliers {
    /// The vector of a Ritz value.
    pub fn vector(&self, ritz: &Ritz) -> Vec<c64> {
        let mut sum = vec![c64::ZERO; self.basis[0].len()];
        for (unit, &factor) in self.basis.iter().zip(&ritz.factors) {
            sum.iter_mut().zip(unit).for_each(|(sum, value)| *sum += factor * value);
        }
        sum
    }
}

/// Ritz values by falling modulus, one of each conjugate pair.
fn ritz(columns: &[Vec<f64>], basis: &[Vec<f64>], motion: &[f64]) -> Option<Vec<Ritz>> {
    let size = columns.len();
    let matrix = Mat::from_fn(size, size, |i, j| columns[j].get(i).copied().unwrap_or(0.0)); // Hessenberg: column j ends at row j + 1.
    let eigen = real_eigen(matrix.as_ref(), false, 0).ok()?;
    let overflow = columns[size - 1][size]; // h of P V = V H + h v e^T.
    let shares: Vec<f64> = basis.iter().map(|unit| dot(unit, motion)).collect();
    let ritz = |i: usize| {
        let (value, factors) =
            (eigen.values[i], complex_column(&eigen.values, eigen.right.as_ref(), i));
        let length = factors.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt();
        let along = factors.iter().zip(&shares).map(|(y, share)| y * share).sum::<c64>();
        let residual = overflow * factors[size - 1].norm() / (length * value.norm()); // |P x - rho x| = h |y_k| for x = V y.
        Ritz { value, residual, along: along.norm() / length, factors }
    };
    let mut all: Vec<Ritz> = (0..size).filter(|&i| eigen.values[i].im >= 0.0).map(ritz).collect();
    crate::order::sort_by_number(&mut all, |a| -a.value.norm());
    Some(all)
}

/// The vector of length one.
pub fn unit(vector: Vec<f64>) -> Vec<f64> {
    let length = norm(&vector);
    vector.into_iter().map(|value| value / length).collect()
}
