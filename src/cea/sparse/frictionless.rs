//! The undamped modes without friction, and the proof that none is missing.

use super::factors::StiffnessFactors;
use super::inertia::{counted, gyroscopic_count};
use super::linearization::Linearization;
use super::rigid::RigidMotions;
use super::structure::{ShiftInverted, StructureMatrices};
use super::{GUARD_MODES, LOSSY_GUARD};
use crate::cea::{CeaError, ModeLimit, SweepWatch};
use crate::fem::RayleighDamping;
use crate::linalg::Mat;
use crate::linalg::dense::{columns_of, from_columns};
use crate::linalg::{
    KrylovSchurSettings, LdlAnalysis, LinalgError, MatrixPolynomial, SparseLdl, Wanted,
    krylov_schur,
};
use crate::prestress::SlidingTangent;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Bound on the residual of the iteration.
const TOLERANCE: f64 = 1e-11;
/// Width of its random start block: a compromise of cheap blocked solves and few vectors.
const BLOCK: usize = 8;
/// Shift of the factors of bodies that nothing holds, relative to the highest eigenvalue wanted ...
const FREE_SHIFT: f64 = 0.1;
/// ... or to the largest of the mesh.
const STIFFEST: f64 = 1e-6;
/// The same where that does not converge: a coarse mesh, whose modes are not that far below its stiffest.
const STIFFER: f64 = 1e-3;
/// The first of such shifts where a frame turns, relative to the largest of the mesh.
const LEAST_SHIFT: f64 = 1e-9;
/// Eigenvalue, relative to the highest found, below which a motion of such bodies is rigid: a thousandth of its frequency.
const RIGID: f64 = 1e-6;
/// Rigid motions of one body in space.
const RIGID_OF_ONE_BODY: usize = 6;
/// Where the shift of the factors kept may lie between zero and the highest eigenvalue `kappa`.
const AMID: std::ops::Range<f64> = 0.4..0.65;
/// Distance of that shift from the frequencies about it, relative to the highest. At a pair of equal frequencies the factors would
/// magnify round-off by all digits.
const LEAST_DISTANCE: f64 = 1e-4;

/// The lowest modes of `K x = kappa M x` at `mu = 0`.
pub struct FrictionlessModes {
    /// Vectors, one column each, by rising frequency.
    pub vectors: Mat<f64>,
    /// Angular frequencies `sqrt(kappa)`, rad/s; 0 where only gyroscopic forces hold a motion, `kappa < 0`.
    pub frequencies: Vec<f64>,
    /// Factors of `K(0) - sigma M(0)`, `sigma` amid the modes where it can be.
    pub factors: StiffnessFactors,
    /// Rigid motions of bodies that nothing holds, which are none of the modes.
    pub rigid: Option<RigidMotions>,
}

impl FrictionlessModes {
    /// Computes the modes within `limit` and a few more, up to a gap in the spectrum, so that no
    /// multiple eigenvalue is split.
    ///
    /// # Errors
    /// [`CeaError::CountMismatch`] if the inertia of `K - sigma M` in that gap counts another number.
    pub fn compute(tangent: &SlidingTangent, limit: ModeLimit) -> Result<Self, CeaError> {
        Self::found_by(tangent, &Inertia::new(tangent)?, limit)
    }

    /// [`Self::compute`], or what an earlier run of the same sweep found.
    ///
    /// # Errors
    /// As [`Self::compute`].
    pub(super) fn compute_watched(
        tangent: &SlidingTangent,
        limit: ModeLimit,
        watch: &dyn SweepWatch,
    ) -> Result<Self, CeaError> {
        const NAME: &str = "frictionless";
        if tangent.is_free {
            return Self::compute(tangent, limit);
        }
        let inertia = Inertia::new(tangent)?;
        let unknowns = tangent.stiffness.dimension();
        if let Some((vectors, frequencies)) = recalled(watch.recall(NAME), unknowns) {
            let factors = inertia.factors(&frequencies, None)?;
            return Ok(Self { vectors, frequencies, factors, rigid: None });
        }
        let found = Self::found_by(tangent, &inertia, limit)?;
        let mut columns = columns_of(&found.vectors);
        columns.push(found.frequencies.clone());
        watch.keep(NAME, &columns);
        Ok(found)
    }

    fn found_by(
        tangent: &SlidingTangent,
        inertia: &Inertia<'_>,
        limit: ModeLimit,
    ) -> Result<Self, CeaError> {
        if tangent.is_free {
            let found = free_modes(tangent, inertia, limit, STIFFEST);
            // A shift far below the modes leaves them no digits; one far above tells them apart slowly.
            return match found {
                Err(CeaError::Linalg(_)) => free_modes(tangent, inertia, limit, STIFFER),
                found => found,
            };
        }
        let turning = match tangent.is_gyroscopic {
            true => Some(inertia.factorize_positive()?),
            false => None,
        };
        let unheld = turning.as_ref().map_or(0, |(.., unheld)| *unheld);
        let wanted = match limit {
            ModeLimit::Lowest(count) if unheld > 0 => {
                count.max((count + unheld).min(tangent.stiffness.dimension()))
            }
            ModeLimit::Lowest(count) => count,
            ModeLimit::MaxFrequency(limit_hz) if tangent.is_gyroscopic => {
                let omega = TAU * limit_hz;
                let turning = gyroscopic_count(tangent, omega)? + unheld;
                turning.max(inertia.count_below(omega)?)
            }
            ModeLimit::MaxFrequency(limit_hz) => inertia.count_below(TAU * limit_hz)?,
        };
        // An empty range still needs the lowest mode, for the message.
        let unknowns = tangent.stiffness.dimension();
        if wanted > unknowns {
            return Err(CeaError::TooManyModes { asked: wanted, total: unknowns });
        }
        let is_empty = wanted == 0;
        let wanted = (wanted.max(1) + beyond_wanted(tangent)).min(unknowns);
        let request = (wanted + GUARD_MODES).min(unknowns);
        let undamped = Linearization::Reduced(RayleighDamping::default());
        let (factors, shift) = match turning {
            Some((factors, shift, _)) => (factors, shift),
            None => (inertia.factorize_stiffness()?, 0.0),
        };
        let operator = ShiftInverted {
            matrices: &StructureMatrices::at(tangent, undamped, 0.0),
            factors: &factors,
        };
        let pairs = krylov_schur(&operator, None, &settings(request))?;
        let kappas = pairs.values.iter().map(|s| s.re.recip() - shift);
        let frequencies: Vec<f64> = kappas.map(|kappa| kappa.max(0.0).sqrt()).collect();
        if let ModeLimit::MaxFrequency(limit_hz) = limit
            && is_empty
        {
            return Err(CeaError::NoModes { limit_hz, lowest_hz: frequencies[0] / TAU });
        }
        let kept = if request == unknowns {
            request
        } else {
            let kept = widest_gap(&frequencies, wanted);
            let middle = 0.5 * (frequencies[kept - 1] + frequencies[kept]);
            let counted = inertia.count_below(middle)?;
            if counted != kept {
                return Err(CeaError::CountMismatch {
                    found: kept,
                    counted,
                    frequency_hz: middle / TAU,
                });
            }
            kept
        };
        let factors = inertia.factors(&frequencies[..kept], Some(factors))?;
        Ok(Self {
            vectors: pairs.vectors.get(.., ..kept).to_owned(),
            frequencies: frequencies[..kept].to_vec(),
            factors,
            rigid: None,
        })
    }
}

/// The modes of bodies that nothing holds: those of `(K + sigma M) x = (kappa + sigma) M x` whose `kappa` is none of the round-off
/// that rigid motions have.
fn free_modes(
    tangent: &SlidingTangent,
    inertia: &Inertia<'_>,
    limit: ModeLimit,
    part: f64,
) -> Result<FrictionlessModes, CeaError> {
    let unknowns = tangent.stiffness.dimension();
    let shift = match limit {
        ModeLimit::MaxFrequency(limit_hz) => FREE_SHIFT * (TAU * limit_hz).powi(2),
        ModeLimit::Lowest(_) => inertia.largest_ratio() * part,
    };
    let ldl = SparseLdl::factorize(&inertia.analysis, &inertia.shifted(-shift))?;
    let factors = StiffnessFactors::Symmetric(Arc::new(ldl));
    let undamped = Linearization::Reduced(RayleighDamping::default());
    let operator = ShiftInverted {
        matrices: &StructureMatrices::at(tangent, undamped, 0.0),
        factors: &factors,
    };
    let below = match limit {
        ModeLimit::Lowest(count) => count,
        ModeLimit::MaxFrequency(limit_hz) => inertia.count_below(TAU * limit_hz)?,
    };
    let mut rigid_guess = RIGID_OF_ONE_BODY;
    loop {
        let beyond = beyond_wanted(tangent);
        let request = (below + rigid_guess + beyond + GUARD_MODES).min(unknowns);
        let pairs = krylov_schur(&operator, None, &settings(request))?;
        let kappas: Vec<f64> = pairs.values.iter().map(|s| s.re.recip() - shift).collect();
        let highest = kappas.iter().fold(0.0_f64, |a, b| a.max(*b));
        let rigid = kappas.iter().filter(|kappa| **kappa <= RIGID * highest).count();
        let elastic = kappas.len() - rigid;
        let wanted = match limit {
            ModeLimit::Lowest(count) => count,
            ModeLimit::MaxFrequency(_) => below.saturating_sub(rigid),
        };
        if wanted > unknowns - rigid {
            let (asked, total) = (wanted, unknowns - rigid);
            return Err(CeaError::TooManyModes { asked, total });
        }
        if elastic < (wanted + 1).min(unknowns - rigid) {
            rigid_guess = 2 * rigid;
            continue;
        }
        let frequencies: Vec<f64> = kappas[rigid..].iter().map(|kappa| kappa.sqrt()).collect();
        let kept_at_least = (wanted + beyond).min(elastic.saturating_sub(1));
        if let (0, ModeLimit::MaxFrequency(limit_hz)) = (wanted, limit) {
            let lowest_hz = frequencies[0] / TAU;
            return Err(CeaError::NoModes { limit_hz, lowest_hz });
        }
        let kept = match request == unknowns {
            true => elastic,
            false => {
                let kept = widest_gap(&frequencies, kept_at_least);
                let middle = 0.5 * (frequencies[kept - 1] + frequencies[kept]);
                let counted = inertia.count_below(middle)?;
                if counted != kept + rigid {
                    return Err(CeaError::CountMismatch {
                        found: kept + rigid,
                        counted,
                        frequency_hz: middle / TAU,
                    });
                }
                kept
            }
        };
        let motions = pairs.vectors.get(.., ..rigid).to_owned();
        return Ok(FrictionlessModes {
            vectors: pairs.vectors.get(.., rigid..rigid + kept).to_owned(),
            factors: inertia.factors(&frequencies[..kept], Some(factors))?,
            frequencies: frequencies[..kept].to_vec(),
            rigid: Some(RigidMotions::of(&tangent.mass, motions)),
        });
    }
}

/// For the `count` lowest modes.
fn settings(count: usize) -> KrylovSchurSettings {
    KrylovSchurSettings {
        wanted: Wanted::Largest(count),
        tolerance: TOLERANCE,
        block: BLOCK,
        max_applications: 200 * (count + 20),
    }
}

/// Vectors and frequencies that were kept, if they are some.
fn recalled(kept: Option<Vec<Vec<f64>>>, unknowns: usize) -> Option<(Mat<f64>, Vec<f64>)> {
    let mut columns = kept?;
    let frequencies = columns.pop()?;
    let is_whole = frequencies.len() == columns.len() && !columns.is_empty();
    let vectors = from_columns(&columns, unknowns)?;
    is_whole.then_some((vectors, frequencies))
}

/// Modes held beyond those wanted. Losses other than viscous move modes past each other, and no iteration finds them in their order:
/// of two close ones at the end corrections from the viscous modes may reach the wrong one.
fn beyond_wanted(tangent: &SlidingTangent) -> usize {
    match tangent.is_lossy() {
        true => LOSSY_GUARD,
        false => 0,
    }
}

/// Number of leading frequencies before the widest relative gap at or after `wanted`.
fn widest_gap(frequencies: &[f64], wanted: usize) -> usize {
    let gap = |i: usize| match frequencies[i] {
        0.0 => 1.0,
        own => own / frequencies[i - 1],
    };
    (wanted.max(1)..frequencies.len())
        .max_by(|&i, &j| gap(i).total_cmp(&gap(j)).then(j.cmp(&i)))
        .unwrap_or(frequencies.len())
}

/// Angular frequency whose square is about half of the highest, as far from all `frequencies` as that allows: nothing where they are
/// so dense there that `K - sigma M` would be nearly singular.
fn frequency_amid(frequencies: &[f64]) -> Option<f64> {
    let highest = frequencies.last()?;
    let [least, most] = [AMID.start, AMID.end].map(|part| part.sqrt() * highest);
    let gaps = frequencies.windows(2).map(|pair| {
        let place = (0.5 * (pair[0] + pair[1])).clamp(least, most);
        // Negative where the whole gap lies elsewhere.
        ((place - pair[0]).min(pair[1] - place), place)
    });
    let amid = gaps.filter(|(distance, _)| *distance > LEAST_DISTANCE * highest);
    let widest = amid.max_by(|a, b| a.0.total_cmp(&b.0));
    widest.map(|(_, place)| place)
}

/// Counts the eigenvalues of the symmetric pencil at `mu = 0` below a shift.
struct Inertia<'a> {
    stiffness: &'a MatrixPolynomial,
    mass: &'a MatrixPolynomial,
    analysis: LdlAnalysis,
}

impl<'a> Inertia<'a> {
    fn new(tangent: &'a SlidingTangent) -> Result<Self, LinalgError> {
        Ok(Self {
            stiffness: &tangent.stiffness,
            mass: &tangent.mass,
            analysis: LdlAnalysis::new(tangent.stiffness.pattern())?,
        })
    }

    fn factorize_stiffness(&self) -> Result<StiffnessFactors, LinalgError> {
        let ldl = SparseLdl::factorize(&self.analysis, &self.stiffness.evaluate(0.0))?;
        Ok(StiffnessFactors::Symmetric(Arc::new(ldl)))
    }

    /// Factors of `K + sigma M`, `sigma`, and how many motions `K` does not hold: `sigma = 0` but where there are some, as in a
    /// frame that turns faster than a shaft can bend.
    fn factorize_positive(&self) -> Result<(StiffnessFactors, f64, usize), LinalgError> {
        let of = |ldl| StiffnessFactors::Symmetric(Arc::new(ldl));
        let ldl = SparseLdl::factorize(&self.analysis, &self.stiffness.evaluate(0.0))?;
        let unheld = ldl.negative_count();
        if unheld == 0 {
            return Ok((of(ldl), 0.0, 0));
        }
        let mut shift = LEAST_SHIFT * self.largest_ratio();
        loop {
            let ldl = SparseLdl::factorize(&self.analysis, &self.shifted(-shift))?;
            if ldl.negative_count() == 0 {
                return Ok((of(ldl), shift, unheld));
            }
            shift *= 4.0;
        }
    }

    /// Factors of `K - sigma M` with a shift amid the modes, else those of `K`, where they are known already.
    fn factors(
        &self,
        frequencies: &[f64],
        unshifted: Option<StiffnessFactors>,
    ) -> Result<StiffnessFactors, LinalgError> {
        match (self.factorize_amid(frequencies), unshifted) {
            (Some(amid), _) => Ok(amid),
            (None, Some(unshifted)) => Ok(unshifted),
            (None, None) => self.factorize_stiffness(),
        }
    }

    /// Factors of `K - sigma M` with a shift amid the modes; nothing where there is no such gap, or no such factors.
    fn factorize_amid(&self, frequencies: &[f64]) -> Option<StiffnessFactors> {
        let shift = frequency_amid(frequencies)?.powi(2);
        let ldl = SparseLdl::factorize(&self.analysis, &self.shifted(shift)).ok()?;
        Some(StiffnessFactors::Symmetric(Arc::new(ldl)))
    }

    /// Values of `K - shift M`.
    fn shifted(&self, shift: f64) -> Vec<f64> {
        let (stiffness, mass) = (self.stiffness.evaluate(0.0), self.mass.evaluate(0.0));
        let pairs = stiffness.iter().zip(&mass);
        pairs.map(|(k, m)| k - shift * m).collect()
    }

    /// About the largest eigenvalue of the pencil: the largest ratio of the diagonals.
    fn largest_ratio(&self) -> f64 {
        let (stiffness, mass) = (self.stiffness.evaluate(0.0), self.mass.evaluate(0.0));
        let pattern = self.stiffness.pattern();
        let diagonal = (0..pattern.dimension()).filter_map(|i| pattern.position(i, i));
        let ratios = diagonal.map(|at| stiffness[at] / mass[at]);
        ratios.filter(|ratio| ratio.is_finite()).fold(0.0, f64::max)
    }

    /// Number of modes below an angular frequency, by Sylvester's law of inertia.
    fn count_below(&self, frequency: f64) -> Result<usize, LinalgError> {
        counted(frequency, |frequency| {
            SparseLdl::factorize(&self.analysis, &self.shifted(frequency * frequency))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shift_lies_off_all_frequencies_even_where_a_pair_alone_is_in_its_range() {
        let place = frequency_amid(&[6003.0, 7828.0, 7828.0, 10_230.0, 10_230.0, 11_060.0]);
        // The end of the range, nearest to the middle of the gap above the pair.
        let wanted = 0.65_f64.sqrt() * 11_060.0;
        assert!((place.unwrap() / wanted - 1.0).abs() < 1e-12, "{place:?}");
        let middle = 0.5 * (5.0 + 6.0);
        assert_eq!(frequency_amid(&[3.0, 5.0, 6.0, 8.0]), Some(middle));
        // Equal frequencies all over the range, and none at all.
        assert_eq!(frequency_amid(&[1.0, 1.0]), None);
        assert_eq!(frequency_amid(&[]), None);
        let dense: Vec<f64> = (0..60_000).map(|i| 0.5 + 1e-5 * f64::from(i / 2)).collect();
        assert_eq!(frequency_amid(&dense), None);
    }
}
