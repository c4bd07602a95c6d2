//! What is asked of a sweep, and what it finds.

use super::branch::branches_of;
use super::paths::Overdamped;
use crate::cea::cyclic::*;

/// Which harmonics were solved, and why no other can matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Highest harmonic of the mesh, `N_theta / 2`.
    pub largest_harmonic: usize,
    /// Harmonics with modes below the margin, whose branches were followed; at quarters of the friction
    /// range a count by the argument principle found no other mode below the limit.
    pub followed: Vec<usize>,
    /// Harmonics proven to hold no mode below the limit at any friction coefficient of the range.
    pub proven_empty: Vec<usize>,
    /// Harmonics without a mode below the limit by count, at rest and at quarters of the friction range.
    pub counted_empty: Vec<usize>,
    /// Frequency up to which the spectrum is complete, for `|Re(lambda)|` up to a fifth of it, Hz.
    pub limit_hz: f64,
    /// Frequency up to which branches were followed from rest, Hz.
    pub margin_hz: f64,
    /// LU factorizations done.
    pub factorizations: usize,
    /// Whether modes were counted with friction, too; else at rest alone.
    pub is_verified: bool,
}

/// A sweep with everything that the symmetry reveals.
#[derive(Clone, Debug)]
pub struct WaveSweep {
    /// Modes at each friction value and unstable intervals of the branches that have one of them.
    pub sweep: FrictionSweep,
    /// The branches of all modes that occur in the sweep.
    pub branches: Vec<ModeBranch>,
    /// Which harmonics were solved, and why.
    pub coverage: Coverage,
    /// Unknowns of all harmonics.
    pub dofs: usize,
    /// What the reduction of the harmonics of a body in three dimensions leaves out of an eigenvalue, relative to it: the largest
    /// estimate at the largest friction coefficient.
    pub reduction_error: f64,
    /// At each friction value, rising: motions up to the margin of the coverage that do not oscillate, where friction damps the motion
    /// across the sliding strongly; each wave of a pair counts singly. None in the plane.
    pub overdamped: Vec<Overdamped>,
    /// The linearisation, for sensitivities.
    pub tangent: WaveTangent,
}

/// What is asked for.
pub(super) struct Wanted<'a> {
    pub request: &'a SweepRequest<'a>,
    /// Friction coefficients at which the waves of one sector are kept.
    pub waves_at: &'a [f64],
    /// All friction coefficients, rising.
    pub grid: Vec<f64>,
}

impl<'a> Wanted<'a> {
    /// Refuses friction coefficients and limits that are none.
    pub fn new(request: &'a SweepRequest<'a>, waves_at: &'a [f64]) -> Result<Self, CeaError> {
        let grid = request.rising_grid()?;
        request.limit.check()?;
        Ok(Self { request, waves_at, grid })
    }

    /// Friction coefficients at which vectors are kept.
    pub fn kept(&self) -> Vec<f64> {
        [self.request.shapes_at, self.waves_at].concat()
    }
}

/// Followed branches and the modes selected from them.
pub(super) struct Found {
    pub followed: Vec<HarmonicPaths>,
    pub points: Vec<FrictionPoint>,
    /// Frequency up to which the selection must be complete, rad/s.
    pub limit: f64,
    /// Frequency up to which branches were followed from rest, rad/s.
    pub margin: f64,
}

impl Found {
    /// Whether a friction value has fewer modes than the lowest asked for.
    pub fn is_short_of(&self, limit: ModeLimit) -> bool {
        let least = self.points.iter().map(|point| point.modes.len()).min();
        matches!(limit, ModeLimit::Lowest(asked) if least < Some(asked))
    }

    /// The sweep of what was found over friction coefficients `grid`, with the other harmonics that are proven and counted empty.
    pub fn sweep(
        self,
        tangent: WaveTangent,
        grid: &[f64],
        [proven_empty, counted_empty]: [Vec<usize>; 2],
        is_verified: bool,
    ) -> WaveSweep {
        let Self { followed, points, limit, margin } = self;
        let coverage = Coverage {
            largest_harmonic: tangent.largest_harmonic(),
            followed: followed.iter().map(|paths| paths.problem.tangent.harmonic).collect(),
            proven_empty,
            counted_empty,
            limit_hz: limit / TAU,
            margin_hz: margin / TAU,
            factorizations: followed.iter().map(|paths| paths.factorizations).sum(),
            is_verified,
        };
        let (sweep, branches) = together(points, &followed, tangent.sliding_direction);
        let damped = grid.iter().filter(|_| tangent.components == 3); // In the plane nothing moves across the sliding.
        let overdamped = damped.map(|mu| overdamped(&followed, *mu)).collect();
        WaveSweep {
            sweep,
            branches,
            coverage,
            dofs: tangent.dofs.count * tangent.dofs.sectors,
            reduction_error: followed.iter().map(|paths| paths.reduction_error).fold(0.0, f64::max),
            overdamped,
            tangent,
        }
    }
}

/// The overdamped motions of all harmonics at one friction coefficient.
fn overdamped(followed: &[HarmonicPaths], friction: f64) -> Overdamped {
    let all = followed.iter().flat_map(|paths| &paths.overdamped).copied();
    Overdamped::joined(friction, all.filter(|own| own.friction_coefficient == friction))
}

/// A sweep of its points and the paths that they are of, and the branches that have one of the modes.
fn together(
    points: Vec<FrictionPoint>,
    followed: &[HarmonicPaths],
    sliding_direction: f64,
) -> (FrictionSweep, Vec<ModeBranch>) {
    let branches: Vec<Vec<ModeBranch>> =
        crate::parallel::map(followed, |paths| branches_of(paths, sliding_direction));
    // Of a pair both waves, where one is listed: a whole mesh follows both from where they are one.
    let occurs = |branch: &ModeBranch| {
        let is_same =
            |mode: &ComplexMode| (mode.harmonic, mode.branch) == (branch.harmonic, branch.branch);
        points.iter().any(|point| point.modes.iter().any(is_same))
    };
    let branches: Vec<ModeBranch> = branches.into_iter().flatten().filter(occurs).collect();
    let mut intervals: Vec<_> = branches.iter().flat_map(|b| b.intervals.clone()).collect();
    crate::order::sort_by_number(&mut intervals, |a| a.critical_friction);
    (FrictionSweep { points, intervals, ..FrictionSweep::default() }, branches)
}
