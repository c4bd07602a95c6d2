//! Candidates as cases of their own: their keys, their runs, what these come to.

use super::base::{Base, STEPS, lowest_onset, spectrum_of};
use super::trial::{Search, Target, Trial};
use crate::*;
use frictionsim_results::improve::State;

/// Relative distance of critical frictions that are one.
const SAME: f64 = 1e-9;
/// Name of the section that makes a candidate.
const NAME: &str = "improve";

/// The law of a spring along a direction, or in every one.
pub(super) fn law(direction: Option<[f64; 3]>) -> Matrix3<f64> {
    let along = direction.map(Vector3::from);
    along.map_or_else(Matrix3::identity, |along| along * along.transpose())
}

/// The case keys that make a trial, `KEY=VALUE`.
pub(super) fn keys_of(search: &Search<'_>, trial: &Trial) -> Vec<String> {
    let (base, sizes) = (search.base, &search.sizes);
    let d = base.mesh.dimension;
    let key = |name: &str, value: String| format!("modifications.{NAME}.{name}={value}");
    let list = |values: &[f64]| {
        let texts = values.iter().map(|value| format!("{:?}", rounded(*value, 7)));
        format!("[{}]", texts.collect::<Vec<String>>().join(", "))
    };
    match &trial.target {
        Target::Hole(way) => vec![key("offset", list(way))],
        Target::Node(node, direction) => {
            let (name, amount) = search.attached(trial.kind);
            let mut keys = vec![
                key("at", base.mesh.node_label(*node).to_string()),
                key(name, format!("{amount:?}")),
            ];
            keys.extend(direction.map(|along| key("direction", list(&along[..d]))));
            keys
        }
        Target::Patch(element, _) => {
            let middle = base.mesh.element_middle(*element);
            let center = middle.map(|x| rounded(x, 7));
            // A hair more, so that elements at just that distance are in it.
            let moved = (Vector3::from(middle) - Vector3::from(center)).norm();
            let radius = rounded((sizes.patch_radius_m + moved) * (1.0 + 1e-6), 7);
            let own = match trial.kind {
                ModificationKind::Removal => key("remove", "true".to_owned()),
                _ => key("stiffness_coefficient", format!("{:?}", sizes.patch_damping_s)),
            };
            vec![key("center", list(&center[..d])), key("radius", format!("{radius:?}")), own]
        }
    }
}

/// The case with some keys.
fn changed(base: &Base<'_>, keys: &[String]) -> Result<Case, String> {
    base.case.with_keys(keys).map_err(|errors| errors.line())
}

/// The tangent of the case with some keys, at its own friction coefficient.
pub(super) fn tangent_of(base: &Base<'_>, keys: &[String]) -> Result<SlidingTangent, String> {
    let case = changed(base, keys)?;
    let whole = WholeMesh::solve(&case, base.options, &[base.friction]);
    whole.and_then(|whole| whole.own_tangent(&case)).map_err(|error| error.to_string())
}

/// Runs the case with some keys.
pub(super) fn run_again(base: &Base<'_>, keys: &[String]) -> Result<State, String> {
    let case = changed(base, keys)?;
    let sweep = spectrum_of(&case, base.options.mass, base.reach, STEPS);
    let (_, sweep) = sweep.map_err(|error| error.to_string())?;
    let modes = sweep.modes_at(base.friction).iter();
    Ok(State {
        critical_friction: lowest_onset(&sweep, base.window),
        ..base.window.outlook(modes.map(|mode| mode.eigenvalue))
    })
}

/// What a run comes to against the case as it is.
pub(super) fn verdict(base: &State, changed: &State) -> String {
    if changed.unstable_beside > base.unstable_beside {
        let frequency = changed.beside_hz.unwrap_or(f64::NAN);
        return format!("struck off: a mode at {frequency:.0} Hz begins to grow");
    }
    if changed.unstable > base.unstable {
        let (now, as_it_is) = (changed.unstable, base.unstable);
        return format!("struck off: {now} modes grow, {as_it_is} as it is");
    }
    if changed.unstable == 0 {
        return "silenced".to_owned();
    }
    let growth = |state: &State| state.growth_rate_per_s.unwrap_or(f64::NEG_INFINITY);
    let onset = |state: &State| state.critical_friction.unwrap_or(f64::INFINITY);
    // An onset where a contact point opens may stay where it is.
    let is_later = onset(changed) >= onset(base) * (1.0 - SAME);
    match (growth(changed) < growth(base), is_later) {
        (true, true) => "confirmed".to_owned(),
        (true, false) => "struck off: modes begin to grow at less friction".to_owned(),
        (false, _) => format!(
            "struck off: the mode at {:.0} Hz grows faster",
            changed.frequency_hz.unwrap_or(f64::NAN)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_that_makes_one_more_mode_grow_is_struck_off() {
        let state = |growth: f64, unstable: usize| State {
            growth_rate_per_s: Some(growth),
            critical_friction: Some(0.03),
            unstable,
            ..State::default()
        };
        let base = state(3000.0, 6);
        assert_eq!(verdict(&base, &state(2900.0, 6)), "confirmed");
        let more = verdict(&base, &state(2900.0, 7));
        assert_eq!(more, "struck off: 7 modes grow, 6 as it is");
    }
}
