//! Where along a parameter steady sliding loses its stability.

/// Growth rates spent on an onset.
const SPECTRA: usize = 14;
/// Share of the interval that an onset is known to.
const NEAR: f64 = 1e-5;
/// Values of a range, evenly over it, at which growth is looked for.
const LOOKED_AT: usize = 9;

/// Values of a range at which sliding may be unstable, in the order in which they are looked at: both ends, the one
/// nearer to `here` first, then some between, likewise.
pub(super) fn candidates(values: &[f64], here: f64) -> Vec<f64> {
    let last = values.len() - 1;
    let by_distance = |places: &mut dyn Iterator<Item = usize>| {
        let mut own: Vec<f64> = places.map(|place| values[place]).collect();
        frictionsim_physics::order::sort_by_number(&mut own, |a| (a - here).abs());
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
    let (mut low, mut high) = ((stable, growth(stable)?), (growing, growth(growing)?));
    if low.1 > 0.0 || high.1 <= 0.0 {
        return None;
    }
    let width = (growing - stable).abs();
    let (mut kept, mut value) = ([0_u32; 2], stable);
    for _ in 0..SPECTRA {
        // Illinois: the end that stays gives way.
        let [a, b] = [
            low.1 * 0.5_f64.powi(kept[0].saturating_sub(1) as i32),
            high.1 * 0.5_f64.powi(kept[1].saturating_sub(1) as i32),
        ];
        let next = low.0 + (high.0 - low.0) * (a / (a - b)).clamp(0.02, 0.98);
        let rate = growth(next)?;
        let has_moved = (next - value).abs();
        value = next;
        if rate <= 0.0 {
            (low, kept) = ((next, rate), [0, kept[1] + 1]);
        } else {
            (high, kept) = ((next, rate), [kept[0] + 1, 0]);
        }
        if (high.0 - low.0).abs() < NEAR * width || has_moved < 0.1 * NEAR * width {
            break;
        }
    }
    Some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_at_which_growth_vanishes_is_found_from_either_side() {
        let growth = |value: f64| Some(value.powi(3) - 8.0);
        for ends in [[0.5, 7.0], [-3.0, 2.5]] {
            let found = critical(growth, ends).unwrap();
            assert!((found - 2.0).abs() < 1e-4, "{found}");
        }
        assert_eq!(critical(growth, [3.0, 4.0]), None);
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
