//! Growth of the common basis until it holds the modes of every friction coefficient.

mod samples;

use super::structure::ShiftInverted;
use crate::cea::sparse::*;
use crate::linalg::dense::{column_norms, columns_of, dot, from_columns, join_rows};
use crate::linalg::{KrylovSchurSettings, krylov_schur};

/// Unknowns up to which dense decompositions cost no more than that iteration and what follows it.
const DENSE_UP_TO: usize = 150;

/// Basis of the modes at a few friction coefficients, each from an iteration of its own ([`BasisBuilder::search`]).
///
/// The modes at `mu` of the projected problem leave residuals `r`; `(K(0) - sigma M(0))^-1 r` are the directions that the basis lacks.
/// This matrix is symmetric and factorized once: as a preconditioner for all `mu` it costs a fifth of the LU factors of `K(mu)`.
/// A `sigma` amid the modes needs two thirds of the directions that `sigma = 0` needs.
///
/// Source: E. R. Davidson, J. Comput. Phys. 17 (1975), here in blocks over a family of problems.
pub struct BasisBuilder<'a> {
    tangent: &'a SlidingTangent,
    linearization: Linearization,
    /// Factors of `K(0) - sigma M(0)`.
    pub(super) factors: SparseLu,
    /// The projected problem so far.
    pub model: ReducedModel,
    /// Modes to be held at every friction coefficient.
    pub count: usize,
    /// Rigid motions, which the basis holds before the modes.
    pub rigid: usize,
    /// Whether the basis spans all motions, those of a small body: nothing is left to search for.
    pub(super) is_whole: bool,
    /// Friction coefficients whose modes the basis holds as such.
    sampled: Vec<f64>,
    watch: &'a dyn SweepWatch,
    /// Steps that the watch was offered: the state of the basis is known by their number.
    pub(super) steps: usize,
}

impl<'a> BasisBuilder<'a> {
    /// Starts from frictionless motions, one column each, `rigid` ones before the modes, and the factors of `K(0)` or, better,
    /// `K(0) - sigma M(0)`.
    pub fn new(
        tangent: &'a SlidingTangent,
        linearization: Linearization,
        (modes, rigid): (&Mat<f64>, usize),
        factors: SparseLu,
        watch: &'a dyn SweepWatch,
    ) -> Self {
        let mut model = ReducedModel::empty(tangent, linearization);
        // Rigid motions on their own: samples hold the first columns, and a block is put in the order of its remainders.
        let (first, others) = modes.split_at_col(rigid);
        model.extend(first.to_owned(), HALF_THE_DIGITS);
        model.extend(others.to_owned(), HALF_THE_DIGITS);
        let unknowns = tangent.stiffness.dimension();
        let is_whole = unknowns <= DENSE_UP_TO && !tangent.is_tabled();
        if is_whole {
            model.extend(Mat::identity(unknowns, unknowns), ROUND_OFF);
        }
        Self {
            tangent,
            linearization,
            factors,
            model,
            count: modes.ncols() - rigid,
            rigid,
            is_whole,
            sampled: Vec::new(),
            watch,
            steps: 0,
        }
    }

    /// The columns of the next steps, one at each of `values`, side by side: those that an earlier run of the same sweep found, else those
    /// that `find` does, which is told their place. None needs what another one finds.
    fn steps<E: Send>(
        &mut self,
        values: &[f64],
        find: impl Fn(&Self, usize) -> Result<Mat<f64>, E> + Sync,
    ) -> Result<Vec<Mat<f64>>, E> {
        let (own, unknowns) = (&*self, self.tangent.stiffness.dimension());
        let found: Vec<Result<_, E>> =
            crate::parallel::map(values.iter().enumerate(), |(i, &mu)| {
                let name = format!("basis-{:04}-at-{mu:?}", own.steps + i);
                let kept = own.watch.recalled::<Vec<_>>(&name);
                if let Some(columns) = kept.and_then(|columns| from_columns(&columns, unknowns)) {
                    return Ok(columns);
                }
                let columns = find(own, i)?;
                own.watch.keep_value(&name, &columns_of(&columns));
                Ok(columns)
            });
        self.steps += values.len(); // Steps are known by number, whatever order they end in.
        self.watch.reached(SweepProgress {
            stage: SweepStage::Blocks,
            solved: self.steps,
            total: 0,
        });
        found.into_iter().collect()
    }

    /// Adds the lowest modes at `mu` from an iteration of its own, independent of the basis so far, with the factors of `K(mu)`;
    /// `extra` modes beyond the usual count.
    ///
    /// # Errors
    /// If `K(mu)` is singular or a dense decomposition fails.
    pub fn search(&mut self, mu: f64, extra: usize) -> Result<(), CeaError> {
        let count = self.leading_count() + extra;
        let found = self.steps(&[mu], |own, _| own.dominant_vectors(mu, count, None))?;
        self.take(mu, &found[0]);
        Ok(())
    }

    /// Takes the vectors of modes at `mu` into the basis.
    fn take(&mut self, mu: f64, vectors: &Mat<f64>) {
        self.model.extend(vectors.clone(), ROUND_OFF);
        if !self.is_whole {
            self.model.hold_sample(mu, vectors);
        }
    }

    /// The vectors of the `count` lowest motions at `mu` from a Krylov-Schur iteration with the factors of `K(mu)`, which begins with a
    /// few combinations of the `leading` vectors of the basis, or with any: of the quadratic problem real and imaginary part of each mode,
    /// of the reduced one each.
    fn dominant_vectors(
        &self,
        mu: f64,
        count: usize,
        leading: Option<usize>,
    ) -> Result<Mat<f64>, CeaError> {
        let matrices = StructureMatrices::at(self.tangent, self.linearization, mu);
        let stiffness = self.linearization.centred_stiffness(self.tangent, mu);
        let factors = SparseLu::factorize(self.factors.analysis(), stiffness)?;
        let operator = ShiftInverted::new(&matrices, &factors);

        // The start.
        let unknowns = matrices.dimension();
        let start = [1, 2].map(|seed| match leading {
            Some(leading) => {
                self.model.expand(random_columns(leading, SEARCH_WIDTH, seed).as_ref())
            }
            None => random_columns(unknowns, SEARCH_WIDTH.min(unknowns), 2 + seed),
        });
        let (start, wanted, tolerance) = match self.linearization {
            Linearization::Reduced(..) => (start[0].clone(), count, CONVERGED),
            Linearization::Companion { .. } => {
                let [x, y] = start.each_ref().map(Mat::as_ref);
                // The ladder improves what that leaves.
                (join_rows(x, y), 2 * count, HALF_THE_DIGITS)
            }
        };
        let is_companion = matches!(self.linearization, Linearization::Companion { .. });
        let settings = KrylovSchurSettings {
            wanted,
            tie: if is_companion { CHANGE_PLACES } else { 1.0 },
            tolerance,
            max_applications: 10 * (wanted + 20),
            dense_up_to: DENSE_UP_TO * operator.dimension() / unknowns,
        };
        let is_wanted = |s: c64| !is_companion || self.linearization.eigenvalue(s.conj()).is_some();
        let mut vectors = krylov_schur(&operator, start, &is_wanted, &settings)?.vectors;
        match self.linearization {
            // Once more, which damps round-off along the stiffest waves of the mesh.
            Linearization::Reduced(..) => {
                vectors = operator.apply(vectors.as_ref());
                scale_to_unit_length(&mut vectors);
            }
            Linearization::Companion { .. } => {
                vectors = vectors.get(..unknowns, ..).to_owned();
                turn_to_real(&mut vectors);
            }
        }
        Ok(vectors)
    }
}

/// Scales columns to unit length, but for those of zeros.
pub(super) fn scale_to_unit_length(columns: &mut Mat<f64>) {
    let lengths = column_norms(columns.as_ref());
    for (j, length) in lengths.into_iter().enumerate().filter(|(_, l)| *l > 0.0) {
        column_mut(columns, j).iter_mut().for_each(|v| *v /= length);
    }
}

/// Scales complex vectors, real and imaginary parts in neighbouring columns, to unit length and turns their phase so
/// that the imaginary part is as short as can be: what friction and damping do to a mode then stands alone.
pub(super) fn turn_to_real(vectors: &mut Mat<f64>) {
    for j in (0..vectors.ncols()).step_by(2) {
        let (p, q) = (column(vectors.as_ref(), j), column(vectors.as_ref(), j + 1));
        let (pp, pq, qq) = (dot(p, p), dot(p, q), dot(q, q));
        let angle = 0.5 * (2.0 * pq).atan2(pp - qq); // tan 2 phi = 2 p.q / (p.p - q.q).
        let length = (pp + qq).sqrt().max(f64::MIN_POSITIVE);
        let (cosine, sine) = (angle.cos() / length, angle.sin() / length);
        let turned: Vec<[f64; 2]> =
            p.iter().zip(q).map(|(p, q)| [cosine * p + sine * q, cosine * q - sine * p]).collect(); // (p + i q) e^{-i phi}.
        for half in 0..2 {
            let target = column_mut(vectors, j + half).iter_mut();
            target.zip(&turned).for_each(|(v, t)| *v = t[half]);
        }
    }
}
