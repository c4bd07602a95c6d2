//! Ticks of logarithmic axes.

use super::{Axis, Scale, Tick, decimals_for, signed};

impl Axis {
    /// Small unlabelled ticks.
    pub fn minor_ticks(&self) -> Vec<f64> {
        let decades = (self.high / self.low).log10();
        if self.scale == Scale::Linear || self.fixed_ticks.is_some() {
            return Vec::new();
        }
        // Over many decades the decades themselves are the small ticks.
        let digits = if decades > 4.5 { 1..=1 } else { 1..=9 };
        (self.low.log10().floor() as i32..=self.high.log10().ceil() as i32)
            .flat_map(|power| {
                let decade = 10f64.powi(power);
                digits.clone().map(move |digit| f64::from(digit) * decade)
            })
            .filter(|&value| self.contains(value))
            .collect()
    }

    pub(super) fn logarithmic_ticks(&self, count: usize) -> Vec<Tick> {
        let first = (self.low.log10() - 1e-9).ceil() as i32;
        let last = (self.high.log10() + 1e-9).floor() as i32;
        let plain = first >= -2 && last <= 4;
        let tick = |digit: f64, power: i32| Tick {
            value: digit * 10f64.powi(power),
            label: logarithmic_label(digit, power, plain),
        };
        if last - first < 1 {
            // Less than two decades in view: the digits themselves are needed, more of them the fewer fit.
            let digits: [&[f64]; 3] = [
                &[1.0, 2.0, 5.0],
                &[1.0, 2.0, 3.0, 5.0],
                &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
            ];
            let ticks = digits.map(|digits| -> Vec<Tick> {
                let all = (first - 1..=last + 1)
                    .flat_map(|power| digits.iter().map(move |&digit| (digit, power)));
                let ticks = all.map(|(digit, power)| tick(digit, power));
                ticks.filter(|tick| self.contains(tick.value)).collect()
            });
            let enough = ticks.into_iter().find(|ticks| ticks.len() > 2);
            return enough.unwrap_or_else(|| self.narrow_logarithmic_ticks(count, plain));
        }
        let decades = (last - first + 1) as usize;
        let stride = decades.div_ceil(count.max(1)).max(1);
        (first..=last)
            .step_by(stride)
            .map(|power| tick(1.0, power))
            .collect()
    }

    /// Within a factor of about two a logarithmic axis is nearly a linear one, and takes its steps.
    fn narrow_logarithmic_ticks(&self, count: usize, plain: bool) -> Vec<Tick> {
        let ticks = self.linear_ticks(count).into_iter();
        ticks
            .map(|tick| {
                let power = (tick.value.log10() + 1e-9).floor() as i32;
                let digit = tick.value / 10f64.powi(power);
                Tick {
                    label: logarithmic_label(digit, power, plain),
                    ..tick
                }
            })
            .collect()
    }
}

/// `digit * 10^power` as a plain number or with its power, in as many digits as it has.
fn logarithmic_label(digit: f64, power: i32, plain: bool) -> String {
    let decimals = decimals_for(digit);
    if plain {
        let decimals = (decimals as i32 - power).max(0) as usize;
        return signed(digit * 10f64.powi(power), decimals);
    }
    let power = signed(f64::from(power), 0);
    match digit == 1.0 {
        true => format!("10^{{{power}}}"),
        false => format!("{}·10^{{{power}}}", signed(digit, decimals)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, count: usize) -> Vec<String> {
        axis.ticks(count).into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn logarithmic_ticks_are_decades_thinned_to_fit() {
        assert_eq!(
            labels(&Axis::logarithmic("", 10.0, 6000.0), 6),
            ["10", "100", "1000"]
        );
        let many = Axis::logarithmic("", 1e-16, 1e-4);
        assert!(many.ticks(5).len() <= 5);
        assert_eq!(labels(&many, 13)[0], "10^{−16}");
    }

    #[test]
    fn short_logarithmic_ranges_have_at_least_two_labels() {
        let short = Axis::logarithmic("", 1.5e-3, 4.4e-3);
        assert_eq!(labels(&short, 4), ["0.0015", "0.002", "0.003", "0.004"]);
        let tiny = Axis::logarithmic("", 2.6e-8, 1.7e-7);
        assert_eq!(labels(&tiny, 4), ["3·10^{−8}", "5·10^{−8}", "10^{−7}"]);
        assert_eq!(
            labels(&Axis::logarithmic("", 21.0, 49.0), 4),
            ["25", "30", "35", "40", "45"]
        );
        for (low, high) in [
            (2.1e-3, 4.9e-3),
            (0.11, 0.13),
            (6.1e-8, 8.9e-8),
            (95.0, 102.0),
        ] {
            let found = labels(&Axis::logarithmic("", low, high), 4);
            assert!(found.len() > 1, "{low} {high}: {found:?}");
        }
    }
}
