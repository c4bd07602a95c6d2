//! Where along a parameter steady sliding loses its stability.

use frictionsim_physics::linalg::Bracket;
use frictionsim_results::sorted;

/// Share of the interval that an onset is known to.
const NEAR: f64 = 1e-7;
/// Values of a range, evenly over it, at which growth is looked for.
const LOOKED_AT: usize = 9;

/// Values of a range at which sliding may be unstable, in the order in which they are looked at: both ends, the one
/// nearer to `here` first, then some between, likewise.
pub(super) fn candidates(values: &[f64], here: f64) -> Vec<f64> {
    let last = values.len() - 1;
    let by_distance = |places: &mut dyn Iterator<Item = usize>| {
        let mut own = sorted(places.map(|place| values[place]), |own| (own - here).abs());
        own.dedup();
        own
    };
    let inner = last.saturating_sub(1).min(LOOKED_AT - 2);
    let ends = by_distance(&mut [0, last].into_iter());
    let between = (1..=inner).map(|i| i * last / (inner + 1));
    let between = by_distance(&mut between.filter(|&place| place > 0 && place < last));
    [ends, between].concat()
}

/// The value of a parameter, SI, between one at which steady sliding is stable and one at which it is not: where its
/// largest `growth` rate vanishes, by false position; none where it is not stable at the first.
pub(super) fn critical(
    mut growth: impl FnMut(f64) -> Option<f64>,
    [stable, growing]: [f64; 2],
) -> Option<f64> {
    let [decay, rise] = [growth(stable)?, growth(growing)?];
    if decay > 0.0 || rise <= 0.0 {
        return None;
    }
    let mut bracket = Bracket::new([(stable, decay), (growing, rise)]);
    while bracket.width() > NEAR * (growing - stable).abs() {
        bracket.narrow(|value| growth(value).ok_or(())).ok()?;
    }
    Some(bracket.middle())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_at_which_growth_vanishes_is_found_from_either_side() {
        let growth = |value: f64| Some(value.powi(3) - 8.0);
        for ends in [[0.5, 7.0], [-3.0, 2.5]] {
            let found = critical(growth, ends).unwrap();
            assert!((found - 2.0).abs() < 1e-6, "{found}");
        }
        assert_eq!(critical(growth, [3.0, 4.0]), None);
        // Two modes that meet beside one that decays slowly: flat, a kink, and steep.
        let growth = |mu: f64| Some((7e3 * (mu - 0.16).max(0.0).sqrt() - 600.0).max(-55.0));
        let (found, exact) =
            (critical(growth, [0.02, 0.5]).unwrap(), 0.16 + (6.0_f64 / 70.0).powi(2));
        assert!((found - exact).abs() < 1e-7, "{found} {exact}");
    }

    #[test]
    fn both_ends_are_looked_at_before_what_lies_between() {
        let values: Vec<f64> = (0..=20).map(f64::from).collect();
        let found = candidates(&values, 17.0);
        assert_eq!(found[..3], [20.0, 0.0, 17.0]);
        assert_eq!(found.len(), LOOKED_AT);
        assert_eq!(candidates(&[2.0], 1.0), [2.0]);
    }
}
