//! Which modes at two friction coefficients are one branch.

use crate::cea::sparse::*;

/// Bisections of an interval, one within the other, before modes are matched by their extrapolated eigenvalue.
pub const MAX_BISECTIONS: usize = 10;

/// The mode at `to`, on either side, that continues one, in steps over which it is the same beyond doubt; nothing where it is lost.
pub fn followed(
    model: &ReducedModel,
    (from, mode): (f64, &ReducedMode),
    to: f64,
) -> Option<ReducedMode> {
    let (mut at, mut own, mut step) = (from, mode.clone(), to - from);
    // Where two modes nearly meet they must be told apart on the way past.
    let shortest = step.abs() * 0.25_f64.powi(MAX_BISECTIONS as i32);
    while at != to {
        let mu = if (to - at).abs() <= step.abs() { to } else { at + step };
        let guess = own.eigenvalue + own.derivative * (mu - at);
        let next = model.mode_near(mu, &ReducedMode { eigenvalue: guess, ..own.clone() });
        let continues = |next: &ReducedMode| {
            let mut ends = [(at, std::slice::from_ref(&own)), (mu, std::slice::from_ref(next))];
            crate::order::sort_by_number(&mut ends, |a| a.0);
            let [low, high] = ends;
            clear_links(low, high, &overlaps(low, high, model))[0].is_some()
        };
        match next.filter(continues) {
            Some(next) => (at, own, step) = (mu, next, 2.0 * step),
            None if step.abs() <= shortest => return None,
            None => step *= 0.5,
        }
    }
    Some(own)
}

/// `|w_i^T N x'_j| |w'_j^T N x_i|`, see [`crate::cea::sparse::track`].
pub fn overlaps(from: ModesAt<'_>, to: ModesAt<'_>, model: &ReducedModel) -> Mat<f64> {
    let [forward, backward] = model.overlaps_at(0.5 * (from.0 + to.0), from.1, to.1);
    Mat::from_fn(from.1.len(), to.1.len(), |i, j| (forward[(i, j)] * backward[(j, i)]).norm())
}

/// Links whose overlap is large and whose eigenvalues agree with their derivatives.
pub fn clear_links(from: ModesAt<'_>, to: ModesAt<'_>, overlaps: &Mat<f64>) -> Vec<Option<usize>> {
    let step = to.0 - from.0;
    let mut links = vec![None; from.1.len()];
    let mut taken = vec![false; to.1.len()];
    for (i, link) in links.iter_mut().enumerate() {
        let a = &from.1[i];
        let distance = |j: usize| (overlaps[(i, j)] - 1.0).abs(); // The overlap of one mode is 1.
        let best = (0..to.1.len()).min_by(|&j, &k| distance(j).total_cmp(&distance(k)));
        let Some(j) = best.filter(|&j| distance(j) < ALIKE && !taken[j]) else { continue };
        let b = &to.1[j];
        let predicted = a.eigenvalue + (a.derivative + b.derivative) * (0.5 * step); // Trapezoid of the derivatives.
        let reach = 0.5 * (a.derivative.norm() + b.derivative.norm()) * step;
        let error = (b.eigenvalue - predicted).norm();
        let accuracy = if distance(j) < SAME { BESIDE } else { SAME_EIGENVALUE }; // Where vectors leave no doubt, values may differ more.
        if error <= 0.5 * reach + accuracy * a.eigenvalue.norm() {
            *link = Some(j);
            taken[j] = true;
        }
    }
    // A multiple eigenvalue that friction does not move: each vector continues all, and their derivatives are worth nothing where it is
    // defective. One branch is as good as the other.
    for (i, link) in links.iter_mut().enumerate().filter(|(_, link)| link.is_none()) {
        let own = from.1[i].eigenvalue;
        let is_equal =
            |b: &ReducedMode| (b.eigenvalue - own).norm() <= SAME_EIGENVALUE * own.norm();
        let is_multiple = from.1.iter().filter(|b| is_equal(b)).nth(1).is_some();
        let free = (0..to.1.len()).find(|&j| !taken[j] && is_equal(&to.1[j]));
        if let Some(j) = free.filter(|_| is_multiple) {
            *link = Some(j);
            taken[j] = true;
        }
    }
    links
}
