//! Modes that grow only where two branches meet, between the friction coefficients of a sweep.

use crate::cea::branch::Cubic;
use crate::cea::sparse::links::followed;
use crate::cea::sparse::*;

/// Two branches, each with its index at the lower end of a step and its modes at both ends.
type Pair<'a> = [(usize, [&'a ReducedMode; 2]); 2];

/// Whether an eigenvalue grows by more than makes it another one.
fn grows(eigenvalue: c64) -> bool {
    eigenvalue.re > SAME_EIGENVALUE * eigenvalue.norm()
}

/// Where the branches of a pair may grow as they meet within a step, and the mean of their eigenvalues there.
///
/// They are `m +- sqrt(g^2 + c_ij c_ji d^2)` at a distance `d` of friction from an end, to first order, with the mean `m` and half the
/// difference `g` of what they are without coupling, and `c_ij = -w_i^T T' x_j`, of which `rates` holds `T'` at both ends.
fn meeting(pair: &Pair<'_>, mu: [f64; 2], rates: &[ProjectedMatrices; 2]) -> Option<(f64, c64)> {
    // The difference of the two, turned: its real part vanishes where the frequencies are equal.
    let gaps = [0, 1].map(|end| {
        let [a, b] = pair.map(|own| own.1[end]);
        let turned = |difference: c64| c64::new(difference.im, -difference.re);
        BranchPoint {
            friction_coefficient: mu[end],
            eigenvalue: turned(a.eigenvalue - b.eigenvalue),
            rate: turned(a.derivative - b.derivative),
            residual: f64::NAN,
        }
    });
    // They pass one another, or would if they went on as they do at an end.
    let places = if gaps[0].eigenvalue.re * gaps[1].eigenvalue.re < 0.0 {
        let cubic = Cubic::between(&gaps[0], &gaps[1]);
        [mu[0] + cubic.root() * cubic.width; 2]
    } else {
        gaps.map(|own| own.friction_coefficient - own.eigenvalue.re / own.rate.re)
    };
    [0, 1].into_iter().find_map(|end| {
        let (place, step) = (places[end], places[end] - mu[end]);
        if !(place > mu[0] && place < mu[1]) {
            return None;
        }
        let own = pair.map(|own| own.1[end].clone());
        let forms = rates[end].pencil_forms(&own, &own);
        let coupling = forms[(0, 1)] * forms[(1, 0)] * (step * step); // c_ij c_ji d^2.
        let [a, b] = own.map(|mode| mode.eigenvalue + mode.derivative * step);
        let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
        // Coupling twice as strong as it seems is looked at, too.
        grows(mean + (half * half + 4.0 * coupling).sqrt()).then_some((place, mean))
    })
}

/// The first of some friction coefficients where the branch of `end` is alone again, as it is there, and does not grow.
fn alone(
    model: &ReducedModel,
    (start, end): (f64, &ReducedMode),
    mut places: impl Iterator<Item = f64>,
) -> Option<ModeAt> {
    places.find_map(|mu| {
        let mode = followed(model, (start, end), mu)?;
        (!mode.is_growing()).then_some(ModeAt { mu, mode })
    })
}

/// For each branch what it becomes where it meets another one and grows, and before and after that.
pub fn grown_between(
    (from, to): (ModesAt<'_>, ModesAt<'_>),
    links: &[Option<usize>],
    needed: usize,
    model: &ReducedModel,
) -> Result<Vec<Vec<ModeAt>>, LinalgError> {
    let (mu, mut grown) = ([from.0, to.0], vec![Vec::new(); links.len()]);
    let rates = mu.map(|mu| model.derivative_at(mu));
    let linked = links.iter().enumerate();
    let linked = linked.filter_map(|(i, link)| Some((i, [&from.1[i], &to.1[(*link)?]])));
    let calm: Vec<_> = linked.filter(|(_, own)| !own.iter().all(|m| m.is_growing())).collect(); // Branches that do not grow all the way.
    for (k, first) in calm.iter().enumerate().filter(|(_, own)| own.0 < needed) {
        for second in &calm[k + 1..] {
            let pair = [*first, *second];
            let Some((place, mean)) = meeting(&pair, mu, &rates) else { continue };
            // Of the two modes that are combinations of both there, nearest to the mean, one may grow.
            let modes = model.solve_between(place, [from.1, to.1])?;
            let [overlaps, _] = model.overlaps_at(place, &pair.map(|own| own.1[0].clone()), &modes);
            let parts = |j: usize| [0, 1].map(|i| overlaps[(i, j)].norm_sqr());
            let mut mixed: Vec<usize> =
                (0..modes.len()).filter(|&j| parts(j).iter().sum::<f64>() > ALIKE).collect();
            crate::order::sort_by_number(&mut mixed, |&j| (modes[j].eigenvalue - mean).norm());
            mixed.truncate(2);
            crate::order::sort_by_number(&mut mixed, |&j| -modes[j].eigenvalue.re);
            let [growing, decaying] = mixed[..] else { continue };
            // It is said to the branch that grows at an end, or that it has more of.
            let parts = parts(growing);
            let is_held = |i: &usize| pair[*i].0 < needed && parts[*i] > 0.5 * ALIKE;
            let held = [0, 1].into_iter().filter(is_held).max_by(|&a, &b| {
                let grows = |i: usize| pair[i].1.iter().any(|mode| mode.is_growing());
                grows(a).cmp(&grows(b)).then(parts[a].total_cmp(&parts[b]))
            });
            let Some(i) = held.filter(|_| grows(modes[growing].eigenvalue)) else { continue };
            // The two are apart where they are farther from one another than here.
            let rates = [0, 1].map(|end| pair.map(|own| own.1[end].derivative));
            let [a, b] = rates.map(|[a, b]| (a - b).norm());
            let [p, q] = [growing, decaying].map(|j| modes[j].eigenvalue);
            let reach = (p - q).norm() / a.min(b); // Over so much friction they part as far again.
            let (own, ends) = pair[i];
            let beside = |sign: f64, end: usize| {
                let places = (1..=MOST_ATTEMPTS).map(|k| place + sign * reach * (1 << k) as f64);
                let inside = places.take_while(|place| *place > mu[0] && *place < mu[1]);
                alone(model, (mu[end], ends[end]), inside)
            };
            grown[own].extend(beside(-1.0, 0));
            grown[own].push(ModeAt { mu: place, mode: modes[growing].clone() });
            grown[own].extend(beside(1.0, 1));
        }
    }
    Ok(grown)
}
