//! Lists of values, given one by one or as a range.

use super::Spacing;
use frictionsim_output::rounded;

/// `count` values from `from` to `to`, both included exactly.
///
/// Linear: `from + (to - from) i / (count - 1)`; logarithmic: `from (to / from)^(i / (count - 1))`.
/// Values between the ends are rounded to 15 significant digits, so that the 16th of 51 values from
/// 0 to 1 is the number a person writes as 0.3. One value alone is `from`.
///
/// Does not check its arguments: a logarithmic range wants two positive ends.
pub fn range_values(from: f64, to: f64, count: usize, spacing: Spacing) -> Vec<f64> {
    let last = count.saturating_sub(1);
    (0..count)
        .map(|i| match (spacing, i as f64, last as f64) {
            _ if i == 0 => from,
            _ if i == last => to,
            (Spacing::Linear, step, steps) => rounded(from + (to - from) * step / steps, 15),
            (Spacing::Logarithmic, step, steps) => {
                rounded(from * (to / from).powf(step / steps), 15)
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ranges_hold_the_decimal_values_a_person_expects() {
        for count in [51, 101, 1001] {
            let values = range_values(0.0, 1.0, count, Spacing::Linear);
            assert_eq!(values.len(), count);
            assert_eq!((values[0], values[count - 1]), (0.0, 1.0));
            assert_eq!(values[3 * (count - 1) / 10], 0.3);
            for (i, value) in values.iter().enumerate() {
                let decimals = format!("{value}").len();
                assert!(decimals <= 5, "{i} {value}");
            }
        }
    }

    #[test]
    fn logarithmic_ranges_have_equal_ratios_and_exact_ends() {
        let values = range_values(10.0, 6000.0, 24, Spacing::Logarithmic);
        assert_eq!((values[0], values[23]), (10.0, 6000.0));
        let ratio = 600f64.powf(1.0 / 23.0);
        for pair in values.windows(2) {
            // Both values are rounded to 15 digits.
            assert!((pair[1] / pair[0] / ratio - 1.0).abs() < 1e-13);
        }
    }
}
