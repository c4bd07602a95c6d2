//! Continuation of mode branches over the friction coefficient.

use super::edge::ContactEdge;
use super::links::{MAX_BISECTIONS, clear_links, overlaps};
use super::meetings::grown_between;
use crate::cea::counted::NEARLY_CRITICAL;
use crate::cea::sparse::*;

/// Bisections of an interval in all; a branch that these do not follow is lost.
const MOST_BETWEEN: usize = 250;

/// Name of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BranchLabel {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Rank by frequency within the harmonic at the first point, without friction unless the sweep is continued, 1 = lowest.
    pub branch: usize,
}

/// One branch over all points of a sweep.
#[derive(Clone, Debug)]
pub struct TrackedBranch {
    /// Its name.
    pub label: BranchLabel,
    /// Its index among the modes of each point; `None` before it entered the range.
    pub modes: Vec<Option<usize>>,
    /// What it was on its way between the points, where it began to grow or ceased to, or may have done both.
    pub passed: Vec<ModeAt>,
    /// Where a branch of wanted modes ends.
    pub end: Option<BranchEnd>,
}

/// Where a branch ends, and why.
#[derive(Clone, Debug)]
pub struct BranchEnd {
    /// Index of the last point where it was seen.
    pub after: usize,
    /// Whether damping of friction takes it beyond the critical one; else it could not be told from others at the next point.
    pub is_damped: bool,
    /// Where it was last seen, at that point or between it and the next.
    pub seen: ModeAt,
    /// Friction coefficient from which on it is none of the modes.
    pub lost_at: f64,
    /// Friction coefficient at which the mode ceases to oscillate as steady sliding loses its static stability.
    pub diverges_at: Option<f64>,
}

impl BranchEnd {
    /// Whether the mode could not be told from others.
    pub fn is_lost(&self) -> bool {
        !self.is_damped && self.diverges_at.is_none()
    }
}

/// Whether a mode may cease to oscillate within a step of friction, as friction across slow sliding, a dashpot of `mu p / V`, damps it.
fn may_vanish(mode: &ReducedMode, step: f64) -> bool {
    let decay = -(mode.eigenvalue.re + mode.derivative.re * step); // -Re(lambda + lambda' step).
    decay > NEARLY_CRITICAL * mode.eigenvalue.norm()
}

/// Whether a mode lies above what is wanted at the next friction coefficient, by more than it may be wrong there: of the lowest ones
/// others may have come from below.
fn leaves_range(mode: &ReducedMode, step: f64, range_end: f64) -> bool {
    let (frequency, change) = (mode.eigenvalue.im, mode.derivative.im * step);
    frequency.min(frequency + change) > range_end * CHANGE_PLACES + change.abs()
}

/// Names the first `count` modes of the first point and rotates degenerate ones so that they are the limits of the modes with more
/// friction.
pub fn label_first(
    point: &mut SolvedPoint,
    model: &ReducedModel,
    edge: &ContactEdge,
    count: usize,
) -> Result<Vec<BranchLabel>, LinalgError> {
    let checks = point.checks.iter().take(count);
    let harmonics: Vec<usize> = checks.map(|own| edge.harmonic(&own.edge, own.peak)).collect();
    let others = |i: usize| harmonics[..i].iter().copied();
    let labels = (0..harmonics.len()).map(|i| label(edge, harmonics[i], others(i))).collect();
    split_degenerate(point, model, count)?;
    Ok(labels)
}

/// The next name of a harmonic, of which branches with the harmonics of `others` may have some.
fn label(edge: &ContactEdge, harmonic: usize, others: impl Iterator<Item = usize>) -> BranchLabel {
    let below = others.filter(|&other| other == harmonic).count();
    let branch = if edge.is_paired(harmonic) { below / 2 } else { below }; // Both waves of a pair have one name.
    BranchLabel { harmonic, branch: branch + 1 }
}

/// First-order perturbation theory within each cluster of equal eigenvalues.
///
/// With biorthonormal vectors, `dlambda/dmu` are the eigenvalues of `-W^T T'(lambda) X`, and its
/// eigenvectors are the combinations that continue into more friction.
fn split_degenerate(
    SolvedPoint { friction_coefficient: mu, modes, .. }: &mut SolvedPoint,
    model: &ReducedModel,
    count: usize,
) -> Result<(), LinalgError> {
    let (at, rate) = (model.at(*mu), model.derivative_at(*mu));
    let mut first = 0;
    while first < count.min(modes.len()) {
        let lambda = modes[first].eigenvalue;
        let is_one = |m: &&ReducedMode| (m.eigenvalue - lambda).norm() < MULTIPLE * lambda.norm();
        let size = modes[first..].iter().take_while(is_one).count().max(1);
        if size > 1 {
            let cluster = &mut modes[first..first + size];
            let eigen = (-rate.pencil_forms(cluster, cluster)).eigen();
            let eigen = eigen.map_err(|_| LinalgError::dense_eigen(size))?;
            let (values, parts) = (eigen.S().column_vector(), eigen.U());
            let mut order: Vec<usize> = (0..size).collect();
            crate::order::sort_by_number(&mut order, |&i| values[i].re);
            let rights: Vec<Vec<c64>> = cluster.iter().map(|mode| mode.right.clone()).collect();
            for (mode, j) in cluster.iter_mut().zip(order) {
                let part = |row: usize| (0..size).map(|i| parts[(i, j)] * rights[i][row]).sum(); // x_j = sum_i u_ij x_i.
                mode.right = (0..rights[0].len()).map(part).collect();
            }
            model.complete(cluster, &at, *mu);
        }
        first += size;
    }
    Ok(())
}

/// Continues all branches over `points` (ascending friction coefficients).
///
/// Neighbouring points are matched by the overlap `|w_i^T N x'_j| |w'_j^T N x_i|`, `N = (lambda_i + lambda'_j) M + C`, which is 1 for one
/// mode and 0 for different modes of one problem, and by `lambda' - lambda = (dlambda/dmu + dlambda'/dmu) dmu / 2`. Where this is not clear
/// the interval is bisected.
///
/// A wanted mode that no branch reaches has come from above the range, or from motions that did not oscillate: it starts a branch. A mode
/// whose damping nears the critical one may cease to oscillate: its branch ends, as do those that are lost.
///
/// # Errors
/// If a dense decomposition fails.
pub fn track(
    points: &[SolvedPoint],
    model: &ReducedModel,
    edge: &ContactEdge,
    labels: &[BranchLabel],
) -> Result<Vec<TrackedBranch>, LinalgError> {
    let mut branches: Vec<TrackedBranch> = labels
        .iter()
        .enumerate()
        .map(|(i, &label)| TrackedBranch {
            label,
            modes: vec![Some(i)],
            passed: Vec::new(),
            end: None,
        })
        .collect();
    for k in 1..points.len() {
        let (before, after) = (&points[k - 1], &points[k]);
        let step = after.friction_coefficient - before.friction_coefficient;
        let stays = |mode: &ReducedMode| !leaves_range(mode, step, after.range_end);
        let last_to_stay = before.modes[..before.wanted].iter().rposition(stays);
        let needed = last_to_stay.map_or(0, |i| i + 1); // Modes that must be linked beyond doubt.
        let links = match_modes(
            (before.friction_coefficient, &before.modes),
            (after.friction_coefficient, &after.modes),
            needed,
            model,
            (0, &mut 0),
        )?;
        for branch in &mut branches {
            let last = branch.modes[k - 1];
            let next = last.and_then(|i| links[i].as_ref().ok()); // On to the mode that continues it.
            branch.passed.extend(next.iter().flat_map(|(_, passed)| passed.iter().cloned()));
            let next = next.map(|(i, _)| *i);
            if let Some(i) = last
                && let Err((seen, lost_at)) = &links[i]
                && i < needed
                && stays(&before.modes[i])
                && let rest = after.friction_coefficient - seen.mu // Not those that leave the range on the way.
                && !leaves_range(&seen.mode, rest, after.range_end)
            {
                branch.end = Some(BranchEnd {
                    after: k - 1,
                    is_damped: may_vanish(&before.modes[i], step),
                    seen: seen.clone(),
                    lost_at: *lost_at,
                    diverges_at: None,
                });
            }
            branch.modes.push(next); // None where it ends, or has not begun.
        }
        adopt_newcomers(&mut branches, after, edge, k); // What no branch has come to.
    }
    Ok(branches)
}

/// Starts a branch for every wanted mode of point `k` that has none.
fn adopt_newcomers(
    branches: &mut Vec<TrackedBranch>,
    point: &SolvedPoint,
    edge: &ContactEdge,
    k: usize,
) {
    for i in 0..point.wanted {
        if branches.iter().any(|b| b.modes[k] == Some(i)) {
            continue;
        }
        let check = &point.checks[i];
        let harmonic = edge.harmonic(&check.edge, check.peak);
        let label = label(edge, harmonic, branches.iter().map(|b| b.label.harmonic));
        let modes = [vec![None; k], vec![Some(i)]].concat();
        branches.push(TrackedBranch { label, modes, passed: Vec::new(), end: None });
    }
}

/// The mode that continues another one, with what it was between (see [`TrackedBranch::passed`]), or where that was last seen and the next place.
type Link = Result<(usize, Vec<ModeAt>), (ModeAt, f64)>;

/// For each mode of `from` the mode of `to` that continues it. The first `needed` modes must be matched
/// beyond doubt, or the interval is halved.
fn match_modes(
    from: ModesAt<'_>,
    to: ModesAt<'_>,
    needed: usize,
    model: &ReducedModel,
    (depth, solved): (usize, &mut usize),
) -> Result<Vec<Link>, LinalgError> {
    let middle = 0.5 * (from.0 + to.0);
    let overlaps = overlaps(from, to, model);
    let mut links = clear_links(from, to, &overlaps);
    let step = to.0 - from.0;
    let mut needed_links = links.iter().zip(from.1).take(needed);
    let is_clear = needed_links.all(|(link, mode)| link.is_some() || may_vanish(mode, step));
    if !is_clear && depth < MAX_BISECTIONS && *solved < MOST_BETWEEN {
        *solved += 1;
        let modes = model.solve_between(middle, [from.1, to.1])?;
        let first = match_modes(from, (middle, &modes), needed, model, (depth + 1, solved))?;
        let reached = first.iter().take(needed).flatten().map(|(i, _)| i + 1).max().unwrap_or(0); // Up to the last that these have come to.
        let second = match_modes((middle, &modes), to, reached, model, (depth + 1, solved))?;
        let links = first.into_iter().zip(from.1).map(|(link, own)| {
            let (i, mut passed) = link?;
            let (j, beyond) = second[i].clone()?;
            let mode = &modes[i];
            let changes = mode.is_growing() != own.is_growing() || !passed.is_empty(); // A sign that changes and changes back is kept.
            let reach = mode.derivative.re.abs() * (middle - from.0); // Its growth may change its sign within it, either way.
            if changes || mode.eigenvalue.re.abs() < reach {
                passed.push(ModeAt { mu: middle, mode: mode.clone() });
            }
            passed.extend(beyond);
            Ok((j, passed))
        });
        return Ok(links.collect());
    }
    // Only over a step so short is the nearest eigenvalue the same branch; one that is lost is told.
    if !is_clear && depth == MAX_BISECTIONS {
        link_by_extrapolation(from, to, needed, &mut links);
    }
    let mut passed = grown_between((from, to), &links, needed, model)?;
    let links = links.into_iter().enumerate().zip(from.1).map(|((i, link), mode)| match link {
        Some(next) => Ok((next, std::mem::take(&mut passed[i]))),
        None => Err((ModeAt { mu: from.0, mode: mode.clone() }, to.0)),
    });
    Ok(links.collect())
}

/// Last resort, where branches meet in an exceptional point: the nearest free eigenvalue.
fn link_by_extrapolation(
    from: ModesAt<'_>,
    to: ModesAt<'_>,
    needed: usize,
    links: &mut [Option<usize>],
) {
    let step = to.0 - from.0;
    for i in 0..needed.min(links.len()) {
        let a = &from.1[i];
        if links[i].is_some() || may_vanish(a, step) {
            continue;
        }
        let distance = |j: usize| (to.1[j].eigenvalue - a.eigenvalue).norm();
        let free = (0..to.1.len()).filter(|j| !links.contains(&Some(*j)));
        let nearest = free.min_by(|&j, &k| distance(j).total_cmp(&distance(k)));
        // Near an exceptional point eigenvalues move like the square root of the step.
        let reach = (step.abs().sqrt() + BESIDE) * a.eigenvalue.norm();
        links[i] = nearest.filter(|&j| distance(j) < reach);
    }
}
