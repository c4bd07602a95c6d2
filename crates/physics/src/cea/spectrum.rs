//! Results of a complex eigenvalue analysis, the same for every solver.

use crate::cea::*;

/// One eigenpair of `(lambda^2 M + lambda C + K_t) phi = 0`, equation (1) with the contact in it, with `Im(lambda) >= 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct ComplexMode {
    /// Eigenvalue `lambda`, rad/s.
    pub eigenvalue: c64,
    /// Circumferential harmonic `n` (nodal diameters).
    pub harmonic: usize,
    /// Branch among the modes of that harmonic, 1 = lowest frequency.
    pub branch: usize,
    /// +1 travels with the rotor, -1 against it, 0 stands (`n = 0`, or degenerate at `mu = 0`).
    pub direction: i8,
    /// Nodal diameters of a body that was made of one sector and solved by waves around it: of all that differ by multiples of the
    /// number of sectors, or add up to one, the lowest.
    pub nodal_diameters: Option<usize>,
    /// Relative residual of the quadratic problem, `|(lambda^2 M + lambda C + K) phi| / ((|lambda|^2 |M| + |lambda| |C| + |K|) |phi|)`.
    pub residual: f64,
    /// Relative change of the eigenvalue where the matrices change by one rounding error,
    /// `epsilon (|lambda|^2 |M| + |lambda| |C| + |K|) |w| |x| / (|w^T (2 lambda M + C) x| |lambda|)`: what no solver can better.
    pub uncertainty: f64,
    /// Kinetic energy of the contact edge's nodes over that of the body, `Re(x_c^H (M x)_c) / x^H M x` with
    /// the mass of the body alone: how much the mode moves where friction works.
    ///
    /// The nodes' mass shrinks with the elements: compare modes of one mesh, or divide by the edge's share of the mass.
    pub contact_share: f64,
    /// Kinetic energy of motion along the axis over the whole, 0 to 1; `None` in the plane.
    pub axial_share: Option<f64>,
    /// Estimate of the frequency less that on an ever finer mesh of the same outline, Hz, where it was made.
    pub mesh_error: Option<f64>,
    /// Displacement shape over all nodes in nodal frames, two values a node (three in three dimensions) with
    /// `max |u| = 1`, where it was asked for.
    pub shape: Option<Arc<[c64]>>,
    /// The left vector that belongs to it, see [`ModeVectors::left`], where a whole mesh was solved.
    pub left: Option<Arc<[c64]>>,
    /// The same of one sector of a body solved harmonic by harmonic, where it was asked for.
    pub wave: Option<ModeWave>,
}

/// Right and left vector of a mode over all nodal dofs.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeVectors {
    /// Eigenvalue `lambda`, rad/s.
    pub eigenvalue: c64,
    /// `d lambda / d mu`, rad/s.
    pub rate: c64,
    /// Displacement `x`, the largest entry 1.
    pub right: Vec<c64>,
    /// `w` with `w^T T(lambda) = 0`, scaled to `w^T (2 lambda M + C) x = 1` (no conjugation). Where rigid contact was eliminated, it
    /// moves along the normal by what friction turns of its slip.
    pub left: Vec<c64>,
}

/// A mode as a wave of its harmonic.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeWave {
    /// The unknowns of the wave `+n` that has the eigenvalue [`Self::root`]: those of [`crate::prestress::HarmonicTangent`].
    pub unknowns: Vec<c64>,
    /// Whether the mode is the wave `-n`, the conjugate of these unknowns with the conjugate eigenvalue.
    pub is_backward: bool,
}

impl ModeWave {
    /// The eigenvalue of the wave `+n`, of that of the mode.
    pub fn root(&self, eigenvalue: c64) -> c64 {
        if self.is_backward { eigenvalue.conj() } else { eigenvalue }
    }
}

impl ComplexMode {
    /// Its number of nodal diameters in tables: of a body that `has_harmonics`, or that was made of one sector.
    pub fn diameters(&self, has_harmonics: bool) -> Option<usize> {
        has_harmonics.then_some(self.harmonic).or(self.nodal_diameters)
    }

    /// `Re(lambda) / 2 pi`, Hz.
    pub fn real_hz(&self) -> f64 {
        self.eigenvalue.re / TAU
    }

    /// `Im(lambda) / 2 pi`, Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.eigenvalue.im / TAU
    }

    /// Damping factor `zeta = -Re(lambda) / |lambda|` (equation (4)).
    pub fn damping_factor(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.re.hypot(self.eigenvalue.im)
    }

    /// Growth rate `Re(lambda)`, 1/s.
    pub fn growth_rate(&self) -> f64 {
        self.eigenvalue.re
    }

    /// Whether the mode grows, by more than rounded matrices leave open: [`Self::uncertainty`].
    pub fn is_unstable(&self) -> bool {
        let rounding = ROUNDING_ERRORS * self.uncertainty.max(0.0);
        self.eigenvalue.re > rounding * self.eigenvalue.norm()
    }
}

/// All modes found at one friction value, sorted by frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionPoint {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Modes in order of rising frequency.
    pub modes: Vec<ComplexMode>,
    /// Some of those just above, which are not listed, by rising frequency; one that is on no branch has the number 0. With base states
    /// that give way to each other a branch may leave the list and another one enter it in one place.
    pub above: Vec<ComplexMode>,
}

impl FrictionPoint {
    /// Of modes in order of frequency: those within a limit are listed, the others known beside.
    pub(super) fn within(
        limit: ModeLimit,
        friction_coefficient: f64,
        mut modes: Vec<ComplexMode>,
    ) -> Self {
        let frequencies = modes.iter().map(|mode| mode.eigenvalue.im);
        let above = modes.split_off(limit.selected(frequencies));
        Self { friction_coefficient, modes, above }
    }

    /// All of them.
    pub fn known(&self) -> impl Iterator<Item = &ComplexMode> {
        self.modes.iter().chain(&self.above)
    }

    /// About what it is at a friction coefficient between those of the point `before` and its own.
    fn led_back(&self, before: &Self, friction_coefficient: f64) -> Self {
        let [start, end] = [before, self].map(|point| point.friction_coefficient);
        let share = (friction_coefficient - start) / (end - start); // Linear between the two.
        let mut found = Self { friction_coefficient, ..self.clone() };
        for mode in found.modes.iter_mut().chain(&mut found.above).filter(|own| own.branch > 0) {
            let is_same =
                |own: &&ComplexMode| (own.harmonic, own.branch) == (mode.harmonic, mode.branch);
            if let Some(own) = before.known().find(is_same) {
                mode.eigenvalue = own.eigenvalue + (mode.eigenvalue - own.eigenvalue) * share;
            }
        }
        found
    }
}

impl ModeLimit {
    /// Number of leading modes that it selects of those with the rising angular `frequencies` (rad/s), one on a limit included.
    pub fn selected(self, frequencies: impl Iterator<Item = f64>) -> usize {
        match self {
            Self::Lowest(count) => keeping_ties(frequencies, count),
            Self::MaxFrequency(hz) => frequencies.take_while(|own| *own <= TAU * hz).count(),
        }
    }
}

/// Number of leading modes to keep of those with the rising `frequencies` where `count` are wanted: more where
/// the cut would split a pair of equal frequency, whose members have no order of their own.
pub fn keeping_ties(frequencies: impl Iterator<Item = f64>, count: usize) -> usize {
    let mut last = f64::NAN;
    frequencies
        .enumerate()
        .take_while(|&(index, frequency)| {
            let is_kept = index < count || frequency - last <= RESIDUAL_BOUND * frequency;
            last = frequency;
            is_kept
        })
        .count()
}

/// A range of friction coefficients over which one branch grows, located by root finding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnstableInterval {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// See [`ComplexMode::nodal_diameters`].
    pub nodal_diameters: Option<usize>,
    /// Branch within the harmonic; 0 of a motion that grows without oscillating, where steady sliding loses its static stability.
    pub branch: usize,
    /// Travelling direction (see [`ComplexMode::direction`]).
    pub direction: i8,
    /// Critical friction: where the branch turns unstable. The lower end of the range studied where it is unstable from there on.
    pub critical_friction: f64,
    /// Frequency there, Hz.
    pub frequency_hz: f64,
    /// Where it turns stable again, and its frequency there, Hz; `None` if not within the range.
    pub restabilized: Option<(f64, f64)>,
    /// Whether the branch is already unstable at the lower end of the range.
    pub unstable_from_start: bool,
    /// Where it could not be followed to its onset, the last friction coefficient below at which it was not seen to grow.
    pub lost_after: Option<f64>,
    /// Estimate of the critical friction less that on an ever finer mesh of the same outline, where it was made.
    pub mesh_error: Option<f64>,
    /// The mode at the critical friction, where a whole mesh was solved and shapes were asked for; none of one that is unstable from the
    /// start.
    pub crossing: Option<ModeVectors>,
}

impl UnstableInterval {
    /// Whether [`Self::critical_friction`] is a crossing, no bound of one.
    pub fn is_located(&self) -> bool {
        !self.unstable_from_start && self.lost_after.is_none()
    }

    /// Whether it may be of the branch of a mode: both waves of a pair have one name, and opposite directions.
    pub fn is_of(&self, mode: &ComplexMode) -> bool {
        (self.harmonic, self.branch) == (mode.harmonic, mode.branch)
            && self.direction * mode.direction >= 0 // Opposite directions have a product below 0.
    }

    /// As [`ComplexMode::diameters`].
    pub fn diameters(&self, has_harmonics: bool) -> Option<usize> {
        has_harmonics.then_some(self.harmonic).or(self.nodal_diameters)
    }
}

/// A sweep over the friction coefficient.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrictionSweep {
    /// One entry for each friction value, in the order given.
    pub points: Vec<FrictionPoint>,
    /// Every unstable interval, sorted by critical friction.
    pub intervals: Vec<UnstableInterval>,
    /// Modes of a whole mesh whose branches end, by rising friction.
    pub ended: Vec<EndedMode>,
    /// Modes of a whole mesh that did not converge at a friction value, and are not listed there.
    pub unconverged: Vec<UnconvergedMode>,
    /// Rigid motions of the bodies, which are not listed.
    pub rigid_motions: usize,
    /// Counts of the modes of a whole mesh, where they were asked for.
    pub counts: Vec<ModeCount>,
}

impl FrictionSweep {
    /// A sweep put together of parts: intervals in order of critical friction, ended modes in order of friction.
    pub fn joined(
        points: Vec<FrictionPoint>,
        mut intervals: Vec<UnstableInterval>,
        mut ended: Vec<EndedMode>,
    ) -> Self {
        crate::order::sort_by_number(&mut intervals, |a| a.critical_friction);
        crate::order::sort_by_number(&mut ended, |a| a.friction_coefficient);
        Self { points, intervals, ended, ..Self::default() }
    }

    /// What it is from a friction coefficient on, its points being by rising friction. Where that lies between two of them it has a point of
    /// its own, with the eigenvalues of each branch on the straight line from one to the other.
    pub fn since(&self, lower: f64) -> Self {
        let mut found = self.clone();
        let below = self.points.partition_point(|point| point.friction_coefficient < lower);
        found.points.drain(..below);
        if let (Some(before), Some(next)) = (self.points[..below].last(), found.points.first())
            && next.friction_coefficient > lower
        {
            found.points.insert(0, next.led_back(before, lower));
        }
        let is_beyond = |mu: Option<f64>| mu.is_none_or(|mu| mu > lower); // What ended before is no part of it.
        found.ended.retain(|own| own.friction_coefficient >= lower || is_beyond(own.lost_before));
        found.intervals.retain(|own| is_beyond(own.restabilized.map(|(mu, _)| mu)));
        for own in found.intervals.iter_mut().filter(|own| own.critical_friction < lower) {
            let mut first = found.points.iter().flat_map(FrictionPoint::known);
            let mode = first.find(|mode| mode.branch > 0 && own.is_of(mode));
            own.frequency_hz = mode.map_or(own.frequency_hz, ComplexMode::frequency_hz);
            (own.critical_friction, own.unstable_from_start) = (lower, true);
            (own.lost_after, own.crossing) = (None, None); // The end of a range is no crossing.
        }
        found
    }

    /// The modes at a friction coefficient; none where it was not solved.
    pub fn modes_at(&self, friction_coefficient: f64) -> &[ComplexMode] {
        let mut points = self.points.iter();
        let point = points.find(|point| point.friction_coefficient == friction_coefficient);
        point.map_or(&[][..], |point| &point.modes)
    }

    /// The mode that grows fastest of those known just above the listed ones, at its friction coefficient.
    pub fn beyond(&self) -> Option<(f64, &ComplexMode)> {
        let above = self.points.iter().flat_map(|point| {
            point.above.iter().map(move |mode| (point.friction_coefficient, mode))
        });
        let growing = above.filter(|(_, mode)| mode.is_unstable());
        growing.max_by(|(_, a), (_, b)| a.growth_rate().total_cmp(&b.growth_rate()))
    }

    /// The modes at the first friction coefficient.
    pub fn into_first_modes(self) -> Vec<ComplexMode> {
        self.points.into_iter().next().map_or_else(Vec::new, |point| point.modes)
    }
}

/// A mode that no iteration made converge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnconvergedMode {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Its frequency where the iterations ended, Hz.
    pub frequency_hz: f64,
}

impl UnconvergedMode {
    pub(super) fn of(friction_coefficient: f64, frequency: f64) -> Self {
        Self { friction_coefficient, frequency_hz: frequency / TAU }
    }
}

/// The last mode of a branch that ends within a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndedMode {
    /// Its frequency where it was last seen, Hz.
    pub frequency_hz: f64,
    /// The friction coefficient there.
    pub friction_coefficient: f64,
    /// The next friction coefficient, at which it could not be told from others; `None` where damping of friction takes it beyond the
    /// critical one.
    pub lost_before: Option<f64>,
}
