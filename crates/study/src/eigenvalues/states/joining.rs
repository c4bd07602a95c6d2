//! One sweep from those of its base states.

use crate::*;
use frictionsim_physics::cea::ModeCount;
use std::ops::Range;

/// The sweep of one base state, its points by rising friction.
pub struct Part {
    /// Friction coefficient from which the state holds; the sweep may begin before that, where the last one ends.
    pub begin: f64,
    pub sweep: FrictionSweep,
}

impl Part {
    /// The point of highest friction.
    fn last(&self) -> Option<&FrictionPoint> {
        self.sweep.points.last()
    }

    /// The point of lowest friction.
    fn first(&self) -> Option<&FrictionPoint> {
        self.sweep.points.first()
    }
}

/// Name of a branch: harmonic and number.
type Name = (usize, usize);
/// That of a motion that grows without oscillating.
const STATIC: Name = (0, 0);

fn name(mode: &ComplexMode) -> Name {
    (mode.harmonic, mode.branch)
}

fn name_of(interval: &UnstableInterval) -> Name {
    (interval.harmonic, interval.branch)
}

/// The branches that both of two neighbours know where they meet, and whose stability changes there: friction
/// coefficient and the mode on both sides.
fn jumps_between<'a>(
    before: &'a Part,
    after: &'a Part,
) -> impl Iterator<Item = (f64, [&'a ComplexMode; 2])> {
    let is_same =
        |one: &ComplexMode, other: &ComplexMode| one.branch > 0 && name(one) == name(other);
    before.last().zip(after.first()).into_iter().flat_map(move |(last, first)| {
        first.known().enumerate().filter_map(move |(j, mode)| {
            let (i, same) = last.known().enumerate().find(|(_, other)| is_same(other, mode))?;
            let is_listed = i < last.modes.len() || j < first.modes.len();
            (is_listed && same.is_unstable() != mode.is_unstable())
                .then_some((first.friction_coefficient, [same, mode]))
        })
    })
}

/// Whether the static stability is lost between two neighbours.
fn begins_statically(before: &Part, after: &Part) -> bool {
    let is_open = |own: &UnstableInterval| name_of(own) == STATIC && own.restabilized.is_none();
    let begins = |own: &UnstableInterval| name_of(own) == STATIC && own.unstable_from_start;
    after.sweep.intervals.iter().any(begins) && !before.sweep.intervals.iter().any(is_open)
}

/// Friction coefficients at which the growth of a branch jumps across zero.
pub fn jumps(parts: &[Part]) -> impl Iterator<Item = f64> {
    let meeting = parts.windows(2).filter(|pair| unknown(pair).is_empty());
    meeting.filter_map(|pair| Some(jumps_between(&pair[0], &pair[1]).next()?.0))
}

/// Friction coefficients between two neighbours at which the state is unknown.
fn unknown(pair: &[Part]) -> Range<f64> {
    let end = pair[0].last().map_or(f64::NAN, |p| p.friction_coefficient);
    end..pair[1].begin.max(end)
}

/// Friction coefficients at which the state is unknown and between which a branch changes its stability.
pub struct Undecided {
    pub gap: Range<f64>,
    /// Where its growth may vanish: on the straight line between both ends, or as the state beyond would have it there.
    pub guess: Option<f64>,
}

/// Where the straight line between the growth rates of a branch at both ends of a gap vanishes.
fn crossing_of(branch: Name, [before, after]: [&Part; 2]) -> Option<f64> {
    let beyond = after.sweep.points.iter().find(|own| own.friction_coefficient >= after.begin);
    let ends = [before.last()?, beyond?];
    let growth = ends.map(|own| own.known().find(|mode| name(mode) == branch));
    let [from, to] = [growth[0]?.eigenvalue.re, growth[1]?.eigenvalue.re];
    let [start, end] = ends.map(|own| own.friction_coefficient);
    let place = start + (end - start) * from / (from - to); // Of from + (to - from) (mu - start) / (end - start).
    (from * to < 0.0).then_some(place)
}

/// All of them.
pub fn undecided(parts: &[Part]) -> impl Iterator<Item = Undecided> {
    let gaps = parts.windows(2).map(|pair| (unknown(pair), pair));
    gaps.filter(|(gap, _)| !gap.is_empty()).filter_map(|(gap, pair)| {
        let ends = |interval: &UnstableInterval| {
            let onset = interval.is_located().then_some(interval.critical_friction);
            let end = interval.restabilized.map(|(mu, _)| mu);
            [onset, end]
        };
        let all = pair[1].sweep.intervals.iter().flat_map(ends).flatten();
        let root = all.filter(|mu| gap.contains(mu)).min_by(|a, b| a.total_cmp(b));
        let jump = jumps_between(&pair[0], &pair[1]).next();
        let is_open = root.is_some() || jump.is_some() || begins_statically(&pair[0], &pair[1]);
        let crossing = jump.and_then(|(_, own)| crossing_of(name(own[1]), [&pair[0], &pair[1]]));
        is_open.then_some(Undecided { gap, guess: crossing.or(root) })
    })
}

/// Names the branches of each part like those of the one before by the nearest eigenvalues where they meet.
pub fn label(parts: &mut [Part]) {
    for k in 1..parts.len() {
        let (before, after) = parts.split_at_mut(k);
        relabel(&before[k - 1], &mut after[0]);
    }
}

/// One sweep of the parts, with the friction coefficients asked for: one at which a state gives way to the next is that
/// of the next.
pub fn joined(mut parts: Vec<Part>, frictions: &[f64]) -> FrictionSweep {
    let found = joined_intervals(&mut parts, frictions);
    let parts: Vec<FrictionSweep> = parts.into_iter().map(|part| part.sweep).collect();
    let all = || parts.iter().rev().flat_map(|part| &part.points);
    let at = |mu: &f64| all().find(|point| point.friction_coefficient == *mu).cloned();
    let points = frictions.iter().filter_map(at).collect();
    let ended = parts.iter().flat_map(|part| part.ended.iter().copied()).collect();
    let is_asked = |mu: f64| frictions.contains(&mu);
    let counts = parts.iter().flat_map(|part| part.counts.clone());
    let mut counts: Vec<ModeCount> =
        counts.filter(|count| is_asked(count.friction_coefficient)).collect();
    counts.dedup_by(|b, a| a.friction_coefficient == b.friction_coefficient);
    let unconverged = parts.iter().flat_map(|part| part.unconverged.clone());
    let unconverged = unconverged.filter(|own| is_asked(own.friction_coefficient)).collect();
    let rigid_motions = parts.first().map_or(0, |part| part.rigid_motions);
    let joined = FrictionSweep::joined(points, found, ended);
    FrictionSweep { counts, unconverged, rigid_motions, ..joined }
}

/// Unstable intervals over all parts: those that go on across a change are one, and growth may jump across zero at it.
fn joined_intervals(parts: &mut [Part], frictions: &[f64]) -> Vec<UnstableInterval> {
    let mut found: Vec<UnstableInterval> = Vec::new();
    let is_open =
        |own: &UnstableInterval, name: Name| name_of(own) == name && own.restabilized.is_none();
    for k in 0..parts.len() {
        let (before, rest) = parts.split_at_mut(k);
        let part = &mut rest[0];
        let intervals = std::mem::take(&mut part.sweep.intervals);
        let jumps = before.last().into_iter().flat_map(|before| jumps_between(before, part));
        // Where growth jumps to decay an interval ends.
        for (friction, [last, mode]) in jumps.filter(|(_, own)| !own[1].is_unstable()) {
            let own = found.iter_mut().rev().find(|known| is_open(known, name(mode)));
            if let Some(known) = own {
                known.restabilized = Some((friction, last.frequency_hz()));
            }
        }
        // So does one of static instability where the next state is stable.
        let is_static = |own: &UnstableInterval| own.branch == 0 && own.unstable_from_start;
        if !intervals.iter().any(is_static)
            && let Some(known) = found.iter_mut().find(|own| is_open(own, STATIC))
        {
            known.restabilized = part.first().map(|first| (first.friction_coefficient, 0.0));
        }
        for mut interval in intervals {
            if interval.unstable_from_start {
                // A branch that is unstable on both sides of a change goes on.
                let own = name_of(&interval);
                if let Some(known) = found.iter_mut().find(|known| is_open(known, own)) {
                    known.restabilized = interval.restabilized;
                    continue;
                }
                // One that is calm before the change begins at it; any other came from above the range, or was lost.
                let last = before.last().and_then(Part::last);
                let is_calm = |mode: &ComplexMode| name(mode) == own && !mode.is_unstable();
                let is_known = own == STATIC || last.is_some_and(|last| last.known().any(is_calm));
                let earlier =
                    frictions.iter().copied().filter(|mu| *mu < interval.critical_friction);
                interval.lost_after = earlier.max_by(f64::total_cmp).filter(|_| !is_known);
                interval.unstable_from_start = before.is_empty();
            }
            found.push(interval);
        }
    }
    found
}

/// Gives the branches of `after` the names that their nearest eigenvalues have in `before` where both meet.
fn relabel(before: &Part, after: &mut Part) {
    let (Some(last), Some(first)) = (before.last(), after.first()) else { return };
    // Nearest pairs first, each mode once; those just above the list too, which may enter it.
    let [old, new] = [last, first].map(|point| point.known().collect::<Vec<_>>());
    let places = (0..old.len()).flat_map(|i| (0..new.len()).map(move |j| (i, j)));
    let alike = places.filter(|&(i, j)| old[i].nodal_diameters == new[j].nodal_diameters);
    let distance = |i: usize, j: usize| (old[i].eigenvalue - new[j].eigenvalue).norm();
    let pairs = alike.map(|(i, j)| (distance(i, j), i, j)).collect();
    let paired = order::each_once(pairs).into_iter();
    let paired = paired.filter(|&(i, j)| old[i].branch > 0 && new[j].branch > 0);
    let mut name_at: BTreeMap<Name, Name> =
        paired.map(|(i, j)| (name(new[j]), name(old[i]))).collect();
    // Others have new numbers.
    let known = before.sweep.points.iter().flat_map(FrictionPoint::known).map(|mode| mode.branch);
    let mut next = known.max().map_or(1, |branch| branch + 1);
    let mut rename = |harmonic: &mut usize, branch: &mut usize| {
        (*harmonic, *branch) = *name_at.entry((*harmonic, *branch)).or_insert_with(|| {
            next += 1;
            (*harmonic, next - 1)
        });
    };
    let points = after.sweep.points.iter_mut();
    let modes = points.flat_map(|point| point.modes.iter_mut().chain(&mut point.above));
    modes.filter(|own| own.branch > 0).for_each(|own| rename(&mut own.harmonic, &mut own.branch));
    let intervals = after.sweep.intervals.iter_mut().filter(|own| own.branch > 0);
    intervals.for_each(|own| rename(&mut own.harmonic, &mut own.branch));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(growth: f64) -> ComplexMode {
        ComplexMode {
            eigenvalue: c64::new(growth, 9e3),
            harmonic: 0,
            branch: 5,
            direction: 0,
            nodal_diameters: None,
            residual: 0.0,
            uncertainty: 0.0,
            contact_share: 0.0,
            axial_share: None,
            mesh_error: None,
            shape: None,
            left: None,
            wave: None,
        }
    }

    fn point(friction_coefficient: f64, [modes, above]: [Vec<ComplexMode>; 2]) -> FrictionPoint {
        FrictionPoint { friction_coefficient, modes, above }
    }

    /// Growth of -10 1/s where a state ends at 0.3, and of 30 1/s at 0.5 in the next one, crosses zero about 0.35,
    /// wherever that one would have it between.
    #[test]
    fn states_between_are_sought_where_growth_crosses_zero() {
        let before = vec![point(0.3, [vec![mode(-10.0)], Vec::new()])];
        let after = [(0.3, 5.0), (0.5, 30.0)];
        let after = after.map(|(mu, growth)| point(mu, [vec![mode(growth)], Vec::new()]));
        let parts = [(0.1, before), (0.5, after.into())].map(|(begin, points)| Part {
            begin,
            sweep: FrictionSweep { points, ..FrictionSweep::default() },
        });
        let found: Vec<Undecided> = undecided(&parts).collect();
        assert_eq!((found.len(), &found[0].gap), (1, &(0.3..0.5)));
        assert!((found[0].guess.unwrap() - 0.35).abs() < 1e-12);
    }

    /// A branch that grows above the list before contact opens, and is listed after, has no onset there.
    #[test]
    fn what_grew_above_the_list_has_no_onset_where_contact_opens() {
        for (growth, lost_after) in [(20.0, Some(0.1)), (-20.0, None)] {
            let before = [0.1, 0.3].map(|mu| point(mu, [Vec::new(), vec![mode(growth)]]));
            let after = [0.3, 0.5].map(|mu| point(mu, [vec![mode(30.0)], Vec::new()]));
            let begins = UnstableInterval {
                branch: 5,
                critical_friction: 0.3,
                unstable_from_start: true,
                ..UnstableInterval::default()
            };
            let parts = [(before, Vec::new()), (after, vec![begins])].map(|(points, intervals)| {
                let begin = points[0].friction_coefficient;
                let (points, none) = (points.into(), FrictionSweep::default());
                Part { begin, sweep: FrictionSweep { points, intervals, ..none } }
            });
            let found = joined(parts.into(), &[0.1, 0.5]).intervals;
            assert_eq!((found.len(), found[0].lost_after), (1, lost_after), "{growth}");
            assert!(!found[0].unstable_from_start);
        }
    }
}
