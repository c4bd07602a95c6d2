//! What the mesh makes of frequencies and of critical friction.
//!
//! A finite-element eigenvalue `lambda_h` differs from that of the same model on a fine mesh. To leading order it does
//! so by what the errors of its right and left vector have in common (goal-oriented, Heuveline and Rannacher 2001),
//!
//! ```text
//! lambda_h - lambda = - sum_regions (1 + i eta + lambda beta) a(e_w, e_x),   w^T (2 lambda M + C) x = 1
//! mu_h - mu = - Re(lambda_h - lambda) / Re(d lambda / d mu)                  at critical friction
//! ```
//!
//! with `a(e_w, e_x)` of [`DiscretizationError`]. Outlines that the mesh cuts off, and geometry of its own, are no part
//! of it.

use super::parts::Parts;
use crate::*;
use frictionsim_physics::{fem::DiscretizationError, prestress::PartLaw};

/// Damping factor from which on a frequency says little of a mode.
const MOST_DAMPED: f64 = 0.2;

/// Whether it is made: not with a mass that is lumped, whose own error it would leave out, nor with a modulus that
/// follows a table.
fn is_made(case: &Case, mass: MassKind) -> bool {
    mass == MassKind::Consistent && case.body.tables().next().is_none()
}

/// The one of the friction values `shown` with their shapes at which it is made, and so left vectors are needed: the
/// case's own, or the largest. Over the others the error of a mode moves by a fortieth to a quarter of itself (medians
/// of three bodies; 0.8 the most), less than the estimate may be wrong by.
pub fn lefts_needed(case: &Case, mass: MassKind, shown: &[f64]) -> Option<f64> {
    let own = case.contact.sliding.friction_coefficient;
    let of_point = || {
        if shown.contains(&own) { Some(own) } else { shown.iter().copied().max_by(f64::total_cmp) }
    };
    is_made(case, mass).then(of_point).flatten()
}

/// Gives its error to each mode that has both vectors, and to each critical friction of the sweep.
pub(super) fn estimate(parts: &Parts<'_>, sweep: &mut FrictionSweep) {
    if !is_made(parts.case, parts.whole.options.mass) {
        return;
    }
    let estimate = DiscretizationError::new(&parts.whole.mesh, parts.case.materials());
    let error = |lambda: c64, forms: &[c64]| -> c64 {
        let regions = parts.terms.regions().iter().zip(forms);
        let beta = |own: &PartLaw| own.damping.stiffness_coefficient;
        -regions.map(|(own, form)| (own.ratio(lambda) + lambda * beta(own)) * form).sum::<c64>()
    };

    // Of modes and of onsets, all at once.
    let is_wanted = |mode: &ComplexMode| {
        mode.damping_factor() < MOST_DAMPED && mode.left.is_some() && mode.shape.is_some()
    };
    let modes = sweep.points.iter().flat_map(|point| &point.modes);
    let pairs = modes.filter(|mode| is_wanted(mode));
    let pairs = pairs.filter_map(|mode| Some([mode.left.as_deref()?, mode.shape.as_deref()?]));
    let crossings = sweep.intervals.iter().filter_map(|own| own.crossing.as_ref());
    let pairs = pairs.chain(crossings.map(|own| [&*own.left, &*own.right]));
    let pairs: Vec<[&[c64]; 2]> = pairs.collect();
    let mut forms = estimate.forms(&pairs).into_iter();

    let modes = sweep.points.iter_mut().flat_map(|point| &mut point.modes);
    let modes = modes.filter(|mode| is_wanted(mode));
    for (mode, forms) in modes.zip(forms.by_ref()) {
        let change = error(mode.eigenvalue, &forms).im / TAU;
        mode.mesh_error = change.is_finite().then_some(change);
    }
    for interval in &mut sweep.intervals {
        let found = interval.crossing.as_ref().and_then(|own| Some((own, forms.next()?)));
        let change = found.map(|(own, forms)| -error(own.eigenvalue, &forms).re / own.rate.re);
        interval.mesh_error = change.filter(|change| change.is_finite());
    }
}
