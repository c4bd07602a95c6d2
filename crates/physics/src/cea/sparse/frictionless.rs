//! The undamped modes without friction, and the proof that none is missing.

use super::basis::scale_to_unit_length;
use super::linearization::Centre;
use crate::cea::sparse::*;
use crate::linalg::dense::{columns_of, dot, from_columns, pick_columns};
use crate::linalg::{SymmetricPairs, SymmetricPencil, symmetric_pairs};

/// Vectors iterated together: rigid motions of one body come six at a time.
const BLOCK: usize = 2 * SEARCH_WIDTH;
/// Lowest eigenvalue, relative to the highest, above which factors of `K` itself serve all modes.
const STIFFLY_HELD: f64 = 1e-5;

/// The lowest modes of `K x = kappa M x` at `mu = 0`, of bodies that are held, held in part or free.
pub struct FrictionlessModes {
    /// Vectors of unit length, one column each: rigid motions, then modes by rising frequency.
    pub vectors: Mat<f64>,
    /// How many of them are rigid motions.
    pub rigid: usize,
    /// Angular frequencies `sqrt(kappa)` of the modes, rad/s; 0 where only gyroscopic forces hold a motion, `kappa < 0`.
    pub frequencies: Vec<f64>,
    /// Where the eigenproblems with friction are centred.
    pub centre: Centre,
    /// Factors of `K(0) - sigma M(0)`, `sigma` amid the modes where it can be.
    pub factors: SparseLu,
}

impl FrictionlessModes {
    /// Computes the modes within `limit` and a few more, up to a gap in the spectrum, so that no multiple eigenvalue is split.
    ///
    /// With `c > 0` the matrix `K + c^2 M` is positive definite however a body is held: one iteration on it finds rigid motions,
    /// the modes of soft mounts and those of the parts, each to its own accuracy. A sum of rounding errors tells rigid motions.
    ///
    /// # Errors
    /// [`CeaError::NoModes`]; more modes asked for than there are; if the inertia of `K - sigma M` in that gap counts another number.
    pub fn compute(tangent: &SlidingTangent, limit: ModeLimit) -> Result<Self, CeaError> {
        Self::found_by(tangent, &Inertia::new(tangent)?, limit)
    }

    /// [`Self::compute`], or what is known of the same or nearly the same body, with factors of its own: from an earlier run or given.
    pub(super) fn compute_watched(
        tangent: &SlidingTangent,
        (limit, rest): (ModeLimit, Option<&Self>),
        watch: &dyn SweepWatch,
    ) -> Result<Self, CeaError> {
        let inertia = Inertia::new(tangent)?;
        let unknowns = tangent.stiffness.dimension();
        let recalled = || {
            let (columns, frequencies, centre) =
                watch.recalled::<(Vec<_>, Vec<f64>, Centre)>("frictionless")?;
            Some((from_columns(&columns, unknowns)?, frequencies, centre))
        };
        let given = rest.filter(|own| own.rigid == 0 && own.vectors.nrows() == unknowns); // Rigid motions are to be exact.
        let given = given.map(|own| (own.vectors.clone(), own.frequencies.clone(), own.centre));
        if let Some((vectors, frequencies, centre)) = given.or_else(recalled) {
            let factors = inertia.factors(&frequencies, centre.shift.powi(2))?;
            let rigid = vectors.ncols() - frequencies.len();
            let below = frequency_amid(&frequencies)
                .map_or(0, |amid| rigid + frequencies.partition_point(|own| *own < amid));
            // Of the same body as many lie below the factors' shift.
            if factors.negative_count() == below {
                return Ok(Self { vectors, rigid, frequencies, centre, factors });
            }
        }
        let found = Self::found_by(tangent, &inertia, limit)?;
        let vectors = columns_of(&found.vectors);
        watch.keep_value("frictionless", &(vectors, &found.frequencies, found.centre));
        Ok(found)
    }

    fn found_by(
        tangent: &SlidingTangent,
        inertia: &Inertia<'_>,
        limit: ModeLimit,
    ) -> Result<Self, CeaError> {
        let unknowns = tangent.stiffness.dimension();
        // Motions below the limit, rigid ones among them; those that a turning frame alone holds count twice. The shift `c^2` is small
        // beside the highest eigenvalue, so that the lowest are told apart, and not so small that the highest lose digits beside them.
        let (below, mut shift) = match limit {
            // The first guess serves modes far below the largest eigenvalue of the mesh.
            ModeLimit::Lowest(count) => (count, BESIDE * NEAR * inertia.largest_ratio),
            ModeLimit::MaxFrequency(hz) => {
                (inertia.count_below(TAU * hz)?, BESIDE * (TAU * hz).powi(2))
            }
        };
        // One mode above tells that none below a frequency is missing under friction, and whether the next one grows.
        let beyond = if tangent.is_lossy() { LOSSY_GUARD } else { 1 };
        let (mut extra, mut recounts) = (0, 0);
        loop {
            let request = (below.max(1) + beyond + GUARD_MODES + extra).min(unknowns);
            let found = inertia.lowest(request, &mut shift)?;
            let rigid = found.rigid;
            let displaced = found.unheld + overdamped(tangent, &found); // These do not oscillate.
            let wanted = match limit {
                ModeLimit::Lowest(asked) if asked > unknowns - rigid => {
                    return Err(CeaError::too_many_modes(asked, unknowns - rigid));
                }
                ModeLimit::Lowest(count) => (count + displaced).min(unknowns - rigid),
                // Friction, damping and gyroscopic forces may bring some below it: where all that are held are there more are asked for.
                ModeLimit::MaxFrequency(_) => {
                    below.saturating_sub(rigid).max(1).min(unknowns - rigid)
                }
            };
            // Rigid motions took places of modes, and between slow ones there is no counting.
            let elastic = request - rigid;
            let slow = found.kappas[rigid..].partition_point(|own| *own < inertia.least_shift());
            if elastic < (wanted.max(slow).max(1) + beyond + 1).min(unknowns - rigid) {
                extra += rigid + displaced + slow + 1;
                continue;
            }
            let frequencies: Vec<f64> =
                found.kappas[rigid..].iter().map(|kappa| kappa.max(0.0).sqrt()).collect();
            let mut kept = elastic; // The cut, in a gap, and the proof that none is missing below it.
            if request < unknowns {
                kept = widest_gap(&frequencies, (wanted + beyond).max(slow).min(elastic - 1));
                let middle = 0.5 * (frequencies[kept - 1] + frequencies[kept]);
                let counted = inertia.count_below(middle)?;
                if counted != kept + rigid {
                    if recounts == MOST_ATTEMPTS {
                        return Err(CeaError::Failed(format!(
                            "without friction the solver found {} modes below {:.1} Hz, the inertia of the stiffness counts {counted}",
                            kept + rigid,
                            middle / TAU
                        )));
                    }
                    recounts += 1;
                    extra += counted.abs_diff(kept + rigid) + BLOCK;
                    continue;
                }
            }
            return Ok(found.modes(inertia, frequencies, kept)?);
        }
    }
}

/// How many of the lowest motions, of a body on soft springs, damping at rest keeps from oscillating, `(x^T C x)^2 >= 4 x^T K x x^T M x`:
/// others take their places. No more than a block of them, as stiff damping keeps all motions above some frequency from it, too.
fn overdamped(tangent: &SlidingTangent, found: &Lowest) -> usize {
    if tangent.proportional.is_some() {
        return 0;
    }
    let form = |matrix: &MatrixPolynomial, x: MatRef<'_, f64>| {
        let image = matrix.pattern().multiply(&matrix.evaluate(0.0), x);
        dot(column(x, 0), column(image.as_ref(), 0))
    };
    let leading = (found.rigid + found.unheld..found.kappas.len()).take(BLOCK);
    let is_overdamped = |j: &usize| {
        let x = found.vectors.get(.., *j..*j + 1);
        let [damping, inertia] = [&tangent.damping, &tangent.mass].map(|own| form(own, x));
        damping >= 2.0 * found.kappas[*j].max(0.0).sqrt() * inertia // x^T K x = kappa x^T M x.
    };
    leading.take_while(is_overdamped).count()
}

/// The lowest motions of a pencil.
struct Lowest {
    /// Vectors of unit length, by rising `kappa`.
    vectors: Mat<f64>,
    /// Rayleigh quotients; 0 of rigid motions.
    kappas: Vec<f64>,
    /// Leading ones that are rigid.
    rigid: usize,
    /// Motions with `kappa < 0`, which a turning frame drives apart.
    unheld: usize,
    /// `kappa` below which no motion can be told from a rigid one.
    rounding: f64,
}

impl Lowest {
    /// Where eigenproblems of the `count` leading motions are centred: at zero where the body is held stiffly, and elsewhere so that
    /// `c^2` is not below the `least` that leaves regular factors.
    fn centre(&self, count: usize, least: f64) -> Centre {
        let highest = self.kappas[count - 1].max(0.0);
        let is_stiff = self.rigid == 0 && self.kappas[0] > (STIFFLY_HELD * highest).max(least);
        // Beside c^2 the slowest keep a few digits; the highest may lose as many.
        let is_slow = |own: &f64| (0.0..HALF_THE_DIGITS * BESIDE * highest).contains(own);
        let has_slow = self.kappas[self.rigid..].iter().any(is_slow);
        let share = if has_slow { BESIDE * BESIDE } else { BESIDE };
        let shift = if is_stiff { 0.0 } else { (share * highest).max(least).sqrt() };
        let rigid = if self.rigid == 0 { 0.0 } else { self.rounding.sqrt() };
        Centre { shift, rigid }
    }

    /// The rigid motions and, of these angular frequencies, the first `kept` modes, with factors amid them.
    fn modes(
        self,
        inertia: &Inertia<'_>,
        mut frequencies: Vec<f64>,
        kept: usize,
    ) -> Result<FrictionlessModes, LinalgError> {
        frequencies.truncate(kept);
        let (rigid, centre) = (self.rigid, self.centre(self.rigid + kept, inertia.least_shift()));
        let factors = inertia.factors(&frequencies, centre.shift.powi(2))?;
        let vectors = self.vectors.get(.., ..rigid + kept).to_owned();
        Ok(FrictionlessModes { vectors, rigid, frequencies, centre, factors })
    }
}

/// `K + c^2 M` and `M`.
struct ShiftedPencil<'a> {
    mass: &'a MatrixPolynomial,
    values: Vec<f64>,
    factors: SparseLu,
}

impl BlockOperator for ShiftedPencil<'_> {
    fn dimension(&self) -> usize {
        self.mass.dimension()
    }

    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let mut images = self.mass_times(x);
        self.factors.solve_in_place(images.as_mut()); // (K + c^2 M)^-1 M x.
        images
    }
}

impl SymmetricPencil for ShiftedPencil<'_> {
    fn mass_times(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        // Symmetric: the transpose needs no nonzeros sorted by rows.
        self.mass.pattern().multiply_transpose(&self.values, x)
    }
}

/// Number of leading frequencies before the widest relative gap at or after `wanted`.
fn widest_gap(frequencies: &[f64], wanted: usize) -> usize {
    let gap = |i: usize| match frequencies[i] {
        0.0 => 1.0,
        own => own / frequencies[i - 1],
    };
    (wanted.max(1)..frequencies.len())
        .max_by(|&i, &j| gap(i).total_cmp(&gap(j)).then(j.cmp(&i))) // Of equal gaps the first.
        .unwrap_or(frequencies.len())
}

/// Angular frequency whose square is about half of the highest, as far from all `frequencies` as that allows: nothing where they are
/// so dense there that `K - sigma M` would be nearly singular: factors at a pair of equal ones magnify round-off by all digits.
fn frequency_amid(frequencies: &[f64]) -> Option<f64> {
    let highest = frequencies.last()?;
    let [least, most] = [0.4_f64, 0.65].map(|part| part.sqrt() * highest); // omega^2 from 0.4 to 0.65 of the highest.
    let gaps = frequencies.windows(2).map(|pair| {
        let place = (0.5 * (pair[0] + pair[1])).clamp(least, most);
        // Negative where the whole gap lies elsewhere.
        ((place - pair[0]).min(pair[1] - place), place)
    });
    let amid = gaps.filter(|(distance, _)| *distance > NEAR * highest);
    amid.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
}

/// Counts the eigenvalues of the symmetric pencil at `mu = 0` below a shift.
struct Inertia<'a> {
    stiffness: &'a MatrixPolynomial,
    mass: &'a MatrixPolynomial,
    analysis: LuAnalysis,
    /// About the largest eigenvalue of the pencil: the largest ratio of the diagonals.
    largest_ratio: f64,
}

impl<'a> Inertia<'a> {
    fn new(tangent: &'a SlidingTangent) -> Result<Self, LinalgError> {
        let SlidingTangent { stiffness, mass, .. } = tangent;
        let (pattern, k, m) = (stiffness.pattern(), stiffness.evaluate(0.0), mass.evaluate(0.0));
        let diagonal = (0..pattern.dimension()).filter_map(|i| pattern.position(i, i));
        let ratios = diagonal.map(|at| k[at] / m[at]).filter(|ratio| ratio.is_finite());
        let (analysis, largest_ratio) = (LuAnalysis::new(pattern)?, ratios.fold(0.0, f64::max));
        Ok(Self { stiffness, mass, analysis, largest_ratio })
    }

    /// The `count` lowest motions, by an iteration on `K + shift M`. A shift that does not make it positive definite, or that leaves a
    /// pair short of its accuracy, is replaced by another.
    fn lowest(&self, count: usize, shift: &mut f64) -> Result<Lowest, LinalgError> {
        let mut converged = 0;
        for attempt in 0..MOST_ATTEMPTS {
            let factors = loop {
                match self.factors_at(-*shift) {
                    Ok(factors) if factors.negative_count() == 0 => break factors,
                    Err(error) if !(*shift < self.largest_ratio) => return Err(error),
                    _ => *shift *= 10.0, // Farther below all eigenvalues.
                }
            };
            let pencil =
                ShiftedPencil { mass: self.mass, values: self.mass.evaluate(0.0), factors };
            let pairs = symmetric_pairs(&pencil, count, BLOCK, CONVERGED)?;
            if pairs.converged == count {
                return Ok(self.told_apart(&pencil, pairs));
            }
            converged = pairs.converged;
            // The highest pair is known well enough to place the shift by it.
            let placed = BESIDE * (pairs.values.last().map_or(0.0, |theta| theta.recip()) - *shift); // kappa = 1 / theta - c^2.
            *shift = match attempt {
                0 if placed > 0.0 => placed,
                _ => 10.0 * *shift,
            };
        }
        Err(LinalgError::not_converged([converged, count, MOST_ATTEMPTS * count], CONVERGED))
    }

    /// Rayleigh quotients of the vectors, and which are those of rigid motions: the energy `x^T K x` is a sum of rounding errors of
    /// `|x|^T |K| |x|`.
    fn told_apart(&self, pencil: &ShiftedPencil<'_>, pairs: SymmetricPairs) -> Lowest {
        let mut vectors = pairs.vectors;
        let values = self.stiffness.evaluate(0.0);
        let pattern = self.stiffness.pattern();
        let images = pattern.multiply(&values, vectors.as_ref());
        let momenta = pencil.mass_times(vectors.as_ref());
        let magnitudes: Vec<f64> = values.iter().map(|v| v.abs()).collect();
        let absolute = Mat::from_fn(vectors.nrows(), vectors.ncols(), |i, j| vectors[(i, j)].abs());
        let terms = pattern.multiply(&magnitudes, absolute.as_ref());
        let mut found: Vec<(f64, f64, usize)> = (0..vectors.ncols())
            .map(|j| {
                let x = column(vectors.as_ref(), j);
                let inertia = dot(x, column(momenta.as_ref(), j));
                let kappa = dot(x, column(images.as_ref(), j)) / inertia;
                let size = dot(column(absolute.as_ref(), j), column(terms.as_ref(), j)) / inertia;
                (kappa, ROUNDING_ERRORS * f64::EPSILON * size, j)
            })
            .collect();
        let is_rigid = |own: &(f64, f64, usize)| own.0.abs() <= own.1;
        // Rigid ones first, as if at zero.
        found.sort_by(|a, b| is_rigid(b).cmp(&is_rigid(a)).then(a.0.total_cmp(&b.0)));
        let rigid = found.iter().filter(|own| is_rigid(own)).count();
        let rounding = found[..rigid].iter().map(|own| own.1).fold(0.0, f64::max);
        let order: Vec<usize> = found.iter().map(|own| own.2).collect();
        vectors = pick_columns(&vectors, &order);
        scale_to_unit_length(&mut vectors);
        let kappas: Vec<f64> = found.iter().map(|own| own.0).collect();
        let unheld = kappas[rigid..].iter().filter(|kappa| **kappa < 0.0).count();
        Lowest { vectors, kappas, rigid, unheld, rounding }
    }

    /// Factors of `K - sigma M` with a shift amid the modes, else those of `K + shift M`.
    fn factors(&self, frequencies: &[f64], shift: f64) -> Result<SparseLu, LinalgError> {
        // There may be no such gap, or no such factors.
        let amid = frequency_amid(frequencies).and_then(|amid| self.factors_at(amid.powi(2)).ok());
        amid.map_or_else(|| self.factors_at(-shift), Ok)
    }

    /// Factors of `K - shift M`.
    fn factors_at(&self, shift: f64) -> Result<SparseLu, LinalgError> {
        let (stiffness, mass) = (self.stiffness.evaluate(0.0), self.mass.evaluate(0.0));
        let values = stiffness.iter().zip(&mass).map(|(k, m)| k - shift * m);
        SparseLu::symmetric(&self.analysis, values.collect())
    }

    /// Shift below which `K + shift M`, or `K - shift M` between slow motions, is singular to working precision.
    fn least_shift(&self) -> f64 {
        ROUND_OFF * self.largest_ratio
    }

    /// Number of motions below an angular frequency, by Sylvester's law of inertia: below a higher one where there are no factors.
    fn count_below(&self, omega: f64) -> Result<usize, LinalgError> {
        let count = |share: f64| {
            let factors = self.factors_at(omega * omega + share * self.least_shift())?;
            Ok(factors.negative_count())
        };
        [1.0, 10.0, 100.0].into_iter().fold(count(0.0), |own, share| own.or_else(|_| count(share)))
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
