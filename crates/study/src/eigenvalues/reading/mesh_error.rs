//! What the mesh makes of frequencies and of critical friction.
//!
//! A finite-element eigenvalue `lambda_h` differs from that of the same model on a fine mesh. To
//! leading order it does so by what the errors of its right and left vector have in common
//! (goal-oriented, Heuveline and Rannacher 2001),
//!
//! ```text
//! lambda_h - lambda = - sum_regions (1 + i eta + lambda beta) a(e_w, e_x),   w^T (2 lambda M + C) x = 1
//! mu_h - mu = - Re(lambda_h - lambda) / Re(d lambda / d mu)                  at critical friction
//! ```
//!
//! with `a(e_w, e_x)` of [`DiscretizationError`]. Outlines that the mesh cuts off, and geometry of its own, are no part
//! of it.

use super::parts::Parts;
use frictionsim_case::Case;
use frictionsim_physics::cea::{FrictionPoint, FrictionSweep, ModeVectors};
use frictionsim_physics::fem::{DiscretizationError, MassKind};
use frictionsim_physics::linalg::c64;
use frictionsim_results::cea::MeshError;
use std::f64::consts::TAU;

/// Damping factor from which on a frequency says little of a mode.
const MOST_DAMPED: f64 = 0.2;
/// Modes for which the estimate is made at every friction value; of more, at the ends and at the case's own friction.
const MOST_MODES: f64 = 256.0;

/// Whether it is made: not with a mass that is lumped, whose own error it would leave out, nor with a modulus that
/// follows a table.
fn is_made(case: &Case, mass: MassKind) -> bool {
    mass == MassKind::Consistent && case.body.tables().next().is_none()
}

/// Those of the friction values `shown` with their shapes at which it is made, and so left vectors are needed, of about
/// so many `modes` each.
pub fn lefts_needed(case: &Case, mass: MassKind, shown: &[f64], modes: f64) -> Vec<f64> {
    let [least, most] = frictionsim_physics::order::range(shown.iter().copied());
    let own = case.contact.sliding.friction_coefficient;
    let is_wanted =
        |mu: &f64| modes * shown.len() as f64 <= MOST_MODES || [least, most, own].contains(mu);
    let wanted = shown.iter().copied().filter(|mu| is_made(case, mass) && is_wanted(mu));
    wanted.collect()
}

/// The errors of the modes that have both vectors, and of each critical friction of the sweep.
pub(super) fn mesh_errors(
    parts: &Parts<'_>,
    points: &[&FrictionPoint],
    sweep: &FrictionSweep,
) -> (Vec<MeshError>, Vec<Option<f64>>) {
    if !is_made(parts.case, parts.options.mass) {
        return (Vec::new(), Vec::new());
    }
    let estimate = DiscretizationError::new(parts.mesh, parts.case.materials());
    let error = |lambda: c64, forms: &[c64]| -> c64 {
        let regions = parts.regions.iter().zip(forms);
        -regions
            .map(|(region, form)| (region.ratio(lambda) + lambda * region.beta) * form)
            .sum::<c64>()
    };

    // Of modes and of onsets, all at once.
    let numbered = points.iter().flat_map(|point| {
        let modes = point.modes.iter().enumerate();
        let modes = modes.filter(|(_, mode)| mode.damping_factor() < MOST_DAMPED);
        modes.filter_map(|(i, mode)| {
            let pair = [mode.left.as_deref()?, mode.shape.as_deref()?];
            Some(((point.friction_coefficient, i + 1, mode), pair))
        })
    });
    let (modes, mut pairs): (Vec<_>, Vec<_>) = numbered.unzip();
    let crossings: Vec<&ModeVectors> = sweep.crossings.iter().flatten().collect();
    pairs.extend(crossings.iter().map(|own| [&*own.left, &*own.right]));
    let forms = estimate.forms(&pairs);
    let (forms, at_onsets) = forms.split_at(modes.len());

    let rows = modes.iter().zip(forms);
    let rows = rows.map(|(&(friction_coefficient, mode, own), forms)| MeshError {
        friction_coefficient,
        mode,
        of_hz: own.frequency_hz(),
        frequency_hz: error(own.eigenvalue, forms).im / TAU,
    });
    let of_modes = rows.filter(|row| row.frequency_hz.is_finite()).collect();

    let mut of_crossings = crossings.iter().zip(at_onsets).map(|(own, forms)| {
        let change = -error(own.eigenvalue, forms).re / own.rate.re;
        change.is_finite().then_some(change)
    });
    let onsets = sweep.crossings.iter();
    let onsets = onsets.map(|own| own.as_ref().and_then(|_| of_crossings.next().flatten()));
    (of_modes, onsets.collect())
}
