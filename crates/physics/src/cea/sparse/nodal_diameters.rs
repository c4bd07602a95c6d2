//! Sweep over the friction coefficient of a body with cyclic symmetry, one number of nodal diameters after the other.

use super::point::normalize;
use super::{CyclicTangent, sweep};
use crate::cea::sparse::*;
use crate::cea::{PartWatch, keeping_ties};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Modes of each number of nodal diameters beyond its share of those wanted.
const GUARD: usize = 2;

/// Complex modes of `whole` and where their branches turn unstable, from the waves of each number of nodal diameters: the spectrum of
/// [`sweep`], from problems of twice the unknowns of one sector. Branches are ranked over all numbers of diameters.
///
/// # Errors
/// Those of [`sweep`].
pub fn sweep_by_diameters(
    whole: &SlidingTangent,
    cyclic: &CyclicTangent<'_>,
    request: &SweepRequest<'_>,
    watch: &dyn SweepWatch,
) -> Result<FrictionSweep, CeaError> {
    let all = 0..=cyclic.highest();
    let tangents: Vec<SlidingTangent> = crate::parallel::map(all, |n| cyclic.harmonic(n));
    // How many modes are asked for of each number: twice as many as wanted, spread over all, and some. A limit says it by itself.
    let count = |tangent: &SlidingTangent| match request.limit {
        ModeLimit::Lowest(wanted) => {
            let share = (2 * wanted).div_ceil(tangents.len()) + GUARD;
            Some(share.min(tangent.unknowns.len()))
        }
        ModeLimit::MaxFrequency(_) => None,
    };
    let mut counts: Vec<Option<usize>> = tangents.iter().map(count).collect();
    let mut parts: Vec<Option<FrictionSweep>> = vec![None; tangents.len()];
    loop {
        solve(&tangents, &counts, request, watch, &mut parts)?;
        let mut short = match request.limit {
            ModeLimit::Lowest(count) => short_of(&parts, count, &counts),
            ModeLimit::MaxFrequency(_) => Vec::new(),
        };
        short.retain(|&n| counts[n] < Some(tangents[n].unknowns.len()));
        // More of the numbers of which all are among the lowest.
        if short.is_empty() {
            break;
        }
        for n in short {
            parts[n] = None;
            counts[n] = counts[n].map(|count| (2 * count).min(tangents[n].unknowns.len()));
        }
    }
    let parts = parts.into_iter().enumerate();
    let parts = parts.filter_map(|(n, part)| Some(expanded((whole, cyclic), n, part?)));
    Ok(merged(parts.collect(), request.limit))
}

/// Sweeps the numbers of nodal diameters that have none yet.
fn solve(
    tangents: &[SlidingTangent],
    counts: &[Option<usize>],
    request: &SweepRequest<'_>,
    watch: &dyn SweepWatch,
    parts: &mut [Option<FrictionSweep>],
) -> Result<(), CeaError> {
    let solved = AtomicUsize::new(0);
    let all = tangents.iter().enumerate().zip(&*parts);
    let found: Vec<Result<Option<FrictionSweep>, CeaError>> =
        crate::parallel::map(all, |((n, tangent), known)| {
            if known.is_some() {
                return Ok(None);
            }
            let own = SweepRequest {
                limit: counts[n].map_or(request.limit, ModeLimit::Lowest),
                ..*request
            };
            let quiet = PartWatch {
                whole: watch,
                prefix: match counts[n] {
                    Some(count) => format!("diameters-{n}-of-{count}-"),
                    None => format!("diameters-{n}-"),
                },
                is_heard: false,
            };
            let found = sweep(tangent, &own, &quiet);
            watch.reached(SweepProgress {
                stage: SweepStage::Diameters,
                solved: solved.fetch_add(1, Ordering::Relaxed) + 1,
                total: tangents.len(),
            });
            found.map(Some)
        });
    // No mode below the limit is an answer, unless it is that of all.
    let (mut limit_hz, mut lowest_hz) = (f64::NAN, f64::INFINITY);
    for (part, own) in parts.iter_mut().zip(found) {
        match own {
            Ok(sweep) => *part = part.take().or(sweep),
            Err(CeaError::NoModes { limit_hz: limit, lowest_hz: own }) => {
                (limit_hz, lowest_hz) = (limit, lowest_hz.min(own));
            }
            Err(error) => return Err(error),
        }
    }
    let is_none = parts.iter().all(Option::is_none);
    if is_none { Err(CeaError::NoModes { limit_hz, lowest_hz }) } else { Ok(()) }
}

/// Numbers of nodal diameters of which all listed modes are among the `count` lowest at some friction coefficient: more may be.
fn short_of(parts: &[Option<FrictionSweep>], count: usize, counts: &[Option<usize>]) -> Vec<usize> {
    let frequencies = |n: usize, k: usize| {
        let point = parts[n].as_ref().map(|part| &part.points[k]);
        point.into_iter().flat_map(|point| &point.modes).map(|mode| mode.eigenvalue.im)
    };
    let points = parts.iter().flatten().map(|part| part.points.len()).max();
    let is_short = |&n: &usize| {
        (0..points.unwrap_or(0)).any(|k| {
            let mut all: Vec<f64> = (0..parts.len()).flat_map(|n| frequencies(n, k)).collect();
            all.sort_by(f64::total_cmp);
            let Some(&last) = all.get(keeping_ties(all.iter().copied(), count) - 1) else {
                return false;
            };
            let own: Vec<f64> = frequencies(n, k).collect();
            let is_cut = counts[n].is_some_and(|asked| own.len() >= asked); // As many as were asked for: there may be more.
            is_cut && own.last().is_some_and(|highest| *highest <= last)
        })
    };
    (0..parts.len()).filter(is_short).collect()
}

/// The sweep of waves of `n` nodal diameters with vectors over all dofs of the body.
fn expanded(
    (whole, cyclic): (&SlidingTangent, &CyclicTangent<'_>),
    n: usize,
    mut part: FrictionSweep,
) -> FrictionSweep {
    let vectors = |right: &[c64], left: Option<&[c64]>, mu: f64| {
        let mut right = whole.displacement(&cyclic.expand(n, right));
        let scale = normalize(&mut right) / cyclic.weight(n);
        let left = left.map(|left| {
            let mut left = whole.left_displacement(&cyclic.expand(n, left), mu);
            left.iter_mut().for_each(|v| *v *= scale); // w^T (2 lambda M + C) x stays 1.
            left
        });
        (right, left)
    };
    for point in &mut part.points {
        for mode in &mut point.modes {
            mode.nodal_diameters = Some(n);
            if let Some(shape) = mode.shape.take() {
                let own = vectors(&shape, mode.left.as_deref(), point.friction_coefficient);
                (mode.shape, mode.left) = (Some(own.0.into()), own.1.map(Into::into));
            }
        }
    }
    for interval in &mut part.intervals {
        interval.nodal_diameters = Some(n);
        if let Some(ModeVectors { right, left, .. }) = &mut interval.crossing {
            let own = vectors(right, Some(left), interval.critical_friction);
            *right = own.0;
            *left = own.1.expect("there is a left vector where one was given");
        }
    }
    part
}

/// One sweep of those of all numbers of nodal diameters, its branches ranked by their frequency where they begin.
fn merged(mut parts: Vec<FrictionSweep>, limit: ModeLimit) -> FrictionSweep {
    let rank_of = ranked(&mut parts);

    // All modes at each friction coefficient, as many as are wanted.
    let count = parts.first().map_or(0, |part| part.points.len());
    let points = (0..count).map(|k| {
        let friction_coefficient = parts[0].points[k].friction_coefficient;
        let own = parts.iter().flat_map(|part| part.points[k].modes.iter().cloned());
        let mut modes: Vec<ComplexMode> = own.collect();
        crate::order::sort_by_number(&mut modes, |a| a.eigenvalue.im);
        let mut point = FrictionPoint::within(limit, friction_coefficient, modes);
        point.above.extend(parts.iter().flat_map(|part| part.points[k].above.iter().cloned()));
        point
    });
    let points: Vec<FrictionPoint> = points.collect();
    let counts = merged_counts(&parts, &points);
    let is_listed = |branch: usize| {
        let mut modes = points.iter().flat_map(|point| &point.modes);
        modes.any(|mode| mode.branch == branch)
    };
    let (mut found, mut ended, mut unconverged) = (Vec::new(), Vec::new(), Vec::new());
    let rigid_motions = parts.iter().map(|part| part.rigid_motions).sum();
    for (part, sweep) in parts.into_iter().enumerate() {
        ended.extend(sweep.ended);
        unconverged.extend(sweep.unconverged);
        for mut interval in sweep.intervals {
            // Static instability has no modes.
            if interval.branch > 0 {
                let rank = rank_of.get(&(part, interval.branch));
                let Some(rank) = rank.filter(|rank| is_listed(**rank)) else { continue };
                interval.branch = *rank;
            }
            found.push(interval);
        }
    }
    let joined = FrictionSweep::joined(points, found, ended);
    FrictionSweep { counts, unconverged, rigid_motions, ..joined }
}

/// Ranks the branches of all `parts` by their frequency where they begin: the rank of each part's branch.
fn ranked(parts: &mut [FrictionSweep]) -> BTreeMap<(usize, usize), usize> {
    let mut all: Vec<(f64, f64, usize, usize)> = Vec::new();
    for (part, point) in
        parts.iter().enumerate().flat_map(|(i, p)| p.points.iter().map(move |q| (i, q)))
    {
        let mu = point.friction_coefficient;
        all.extend(point.modes.iter().map(|mode| (mu, mode.eigenvalue.im, part, mode.branch)));
    }
    all.sort_by(|a, b| (a.0.total_cmp(&b.0)).then(a.1.total_cmp(&b.1))); // By friction, then by frequency.
    let mut rank_of: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (.., part, branch) in all {
        let next = rank_of.len() + 1;
        rank_of.entry((part, branch)).or_insert(next); // In the order in which they appear.
    }
    for (part, sweep) in parts.iter_mut().enumerate() {
        for point in &mut sweep.points {
            point.modes.iter_mut().chain(&mut point.above).for_each(|mode| {
                mode.branch = rank_of.get(&(part, mode.branch)).copied().unwrap_or_default();
            });
        }
    }
    rank_of
}

/// One count of those of all numbers of diameters at each friction coefficient that all of them counted at, over the frequencies that
/// they share.
fn merged_counts(parts: &[FrictionSweep], points: &[FrictionPoint]) -> Vec<ModeCount> {
    let counted = points.iter().filter_map(|point| {
        let mu = point.friction_coefficient;
        let own = parts.iter().map(|part| {
            let mut counts = part.counts.iter();
            counts.find(|count| count.friction_coefficient == mu)
        });
        let own: Vec<&ModeCount> = own.collect::<Option<_>>()?;
        let (first, rest) = own.split_first()?;
        let mut whole = (*first).clone();
        for count in rest {
            let (region, own) = (&mut whole.region, count.region);
            let shared = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].min(b[1])]; // What both ranges share.
            region.frequencies_hz = shared(region.frequencies_hz, own.frequencies_hz);
            region.growth_rates = shared(region.growth_rates, own.growth_rates);
            whole.recovered += count.recovered;
            whole.determinants += count.determinants;
            whole.near = whole.near.or(count.near);
            whole.missing = whole.missing.and_then(|known| Ok(known + count.missing.clone()?));
        }
        let [low, top] = &mut whole.region.frequencies_hz; // A list by number ends before what each counted up to.
        let last = point.modes.last().filter(|_| !point.above.is_empty());
        *top = last.map_or(*top, |own| top.min((1.0 + SAME_EIGENVALUE) * own.frequency_hz()));
        let inside = |mode: &&ComplexMode| (*low..*top).contains(&mode.frequency_hz());
        whole.known = point.modes.iter().filter(inside).count();
        Some(whole)
    });
    counted.collect()
}
