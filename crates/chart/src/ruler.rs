//! An axis whose range is known: places, round ticks, labels.

use crate::prelude::*;

/// One labelled tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tick {
    /// Where, in the unit shown.
    pub value: f64,
    /// Its mark-up.
    pub label: String,
}

/// An axis with its title, which states the unit, and its range in that unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Ruler {
    /// Quantity and unit, in mark-up.
    pub title: String,
    /// The same without the prefix that suits the data.
    pub declared: String,
    /// Whether equal steps are equal ratios.
    pub scale: Scale,
    pub(super) factor: f64,
    /// Its lower end in the unit shown.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// Its ticks, where they are given.
    pub fixed_ticks: Option<Vec<Tick>>,
}

impl Ruler {
    /// An axis over a range in the unit of the data, which `factor` brings to the unit shown; ends that make no range
    /// are mended.
    pub(super) fn new(
        title: String,
        scale: Scale,
        factor: f64,
        range: (f64, f64),
        fixed_ticks: Option<Vec<Tick>>,
    ) -> Self {
        let ends = (range.0 * factor, range.1 * factor);
        let (low, high) = (ends.0.min(ends.1), ends.0.max(ends.1));
        let (low, high) = match scale {
            Scale::Linear => non_empty(low, high),
            Scale::Logarithmic => positive(low, high),
        };
        Self { title, declared: String::new(), scale, factor, low, high, fixed_ticks }
    }

    /// Position of a value in the unit of the data, 0 at the lower end and 1 at the upper.
    pub fn fraction(&self, value: f64) -> f64 {
        self.place(value * self.factor)
    }

    /// Whether a value lies between the ends, but for round-off.
    pub fn contains(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }

    /// A value in the unit shown.
    pub fn shown(&self, value: f64) -> f64 {
        value * self.factor
    }

    /// The ends in the unit of the data.
    pub fn ends(&self) -> (f64, f64) {
        (self.low / self.factor, self.high / self.factor)
    }

    /// Position of a value in the unit shown.
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic if value <= 0.0 => f64::NEG_INFINITY,
            Scale::Logarithmic => (value / self.low).ln() / (self.high / self.low).ln(),
        }
    }

    /// Title with the power of ten taken out of the labels: "torque (N m)" becomes "torque (10^6 N m)".
    pub(super) fn full_title(&self) -> String {
        let power = self.exponent();
        let factor = format!("10^{{{}}}", signed(f64::from(power), 0));
        match (power, self.title.rsplit_once('(')) {
            (0, _) => self.title.clone(),
            (_, Some((quantity, unit))) => format!("{quantity}({factor} {unit}"),
            (_, None) => format!("{} ({factor})", self.title),
        }
    }

    /// Power of ten taken out of the tick labels (a multiple of three, zero for ordinary numbers).
    fn exponent(&self) -> i32 {
        let reach = self.low.abs().max(self.high.abs());
        if self.scale == Scale::Logarithmic
            || self.fixed_ticks.is_some()
            || (1e-2..1e5).contains(&reach)
            || reach == 0.0
        {
            return 0;
        }
        (reach.log10() / 3.0).floor() as i32 * 3
    }

    /// Labelled ticks, about `count` of them.
    pub(super) fn ticks(&self, count: usize) -> Vec<Tick> {
        if let Some(ticks) = &self.fixed_ticks {
            return ticks.iter().filter(|tick| self.shows(tick.value)).cloned().collect();
        }
        match self.scale {
            Scale::Linear => self.linear_ticks(count),
            Scale::Logarithmic => self.logarithmic_ticks(count),
        }
    }

    fn shows(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.place(value))
    }

    fn linear_ticks(&self, count: usize) -> Vec<Tick> {
        let span = self.high - self.low;
        let inside = |step: f64| {
            ((self.high / step + 1e-9).floor() - (self.low / step - 1e-9).ceil()) as i64 + 1
        };
        let mut step = round_step(span / count.max(1) as f64);
        if inside(step) < 3 && count > 1 {
            // One or two labels do not make a scale.
            step = round_step(span / (2 * count) as f64);
        }
        let unit = 10f64.powi(self.exponent());
        let decimals = decimals_for(step / unit);
        let first = (self.low / step - 1e-9).ceil() as i64;
        let last = (self.high / step + 1e-9).floor() as i64;
        (first..=last)
            .map(|index| {
                let value = index as f64 * step;
                Tick { value, label: signed(value / unit, decimals) }
            })
            .collect()
    }
}

/// Sizes beyond which steps and powers of ten are no numbers any more.
const SIZES: (f64, f64) = (1e-280, 1e300);

fn non_empty(low: f64, high: f64) -> (f64, f64) {
    if !(low.is_finite() && high.is_finite()) {
        return (0.0, 1.0);
    }
    let [low, high] = [low, high].map(|end| end.clamp(-SIZES.1, SIZES.1));
    let reach = low.abs().max(high.abs());
    if high - low > 1e-12 * reach && high - low > SIZES.0 {
        return (low, high);
    }
    let room = if reach < SIZES.0 { 1.0 } else { 0.5 * reach };
    (low - room, high + room)
}

/// Ends that are not positive are replaced.
fn positive(low: f64, high: f64) -> (f64, f64) {
    let high = if high > 0.0 && high.is_finite() { high.clamp(SIZES.0, SIZES.1) } else { 1.0 };
    let low = if low > 0.0 { low.max(1e-280 * high) } else { 1e-3 * high };
    if low < high * (1.0 - 1e-9) { (low, high) } else { (0.5 * high, 2.0 * high) }
}

/// The next step of 1, 2, 2.5 or 5 times a power of ten.
fn round_step(raw: f64) -> f64 {
    let power = 10f64.powf(raw.log10().floor());
    let digit = [1.0, 2.0, 2.5, 5.0]
        .into_iter()
        .find(|digit| digit * power >= raw * (1.0 - 1e-9))
        .unwrap_or(10.0);
    digit * power
}

fn decimals_for(step: f64) -> usize {
    (0..9)
        .find(|&decimals| {
            let scaled = step * 10f64.powi(decimals as i32);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        })
        .unwrap_or(9)
}

/// Width of the widest of some labels, points.
pub(super) fn widest(labels: &[Tick], size: f64) -> f64 {
    labels.iter().map(|tick| text::width(&tick.label, size, false)).fold(0.0, f64::max)
}

impl Ruler {
    /// Small unlabelled ticks.
    pub(super) fn minor_ticks(&self) -> Vec<f64> {
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
            .filter(|&value| self.shows(value))
            .collect()
    }

    fn logarithmic_ticks(&self, count: usize) -> Vec<Tick> {
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
                ticks.filter(|tick| self.shows(tick.value)).collect()
            });
            let enough = ticks.into_iter().find(|ticks| ticks.len() > 2);
            return enough.unwrap_or_else(|| self.narrow_logarithmic_ticks(count, plain));
        }
        let decades = (last - first + 1) as usize;
        let stride = decades.div_ceil(count.max(1)).max(1);
        (first..=last).step_by(stride).map(|power| tick(1.0, power)).collect()
    }

    /// Within a factor of about two a logarithmic axis is nearly a linear one, and takes its steps.
    fn narrow_logarithmic_ticks(&self, count: usize, plain: bool) -> Vec<Tick> {
        let ticks = self.linear_ticks(count).into_iter();
        ticks
            .map(|tick| {
                let power = (tick.value.log10() + 1e-9).floor() as i32;
                let digit = tick.value / 10f64.powi(power);
                Tick { label: logarithmic_label(digit, power, plain), ..tick }
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

    fn ruler(scale: Scale, low: f64, high: f64) -> Ruler {
        Ruler::new(String::new(), scale, 1.0, (low, high), None)
    }

    fn labels(scale: Scale, low: f64, high: f64, count: usize) -> Vec<String> {
        let ticks = ruler(scale, low, high).ticks(count).into_iter();
        ticks.map(|tick| tick.label).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_inside() {
        let linear = |low, high, count| labels(Scale::Linear, low, high, count);
        assert_eq!(linear(0.0, 0.05, 5), ["0.00", "0.01", "0.02", "0.03", "0.04", "0.05"]);
        assert_eq!(linear(-3.1, 2.2, 4), ["−2", "0", "2"]);
    }

    #[test]
    fn huge_and_tiny_ranges_take_out_a_power_of_ten() {
        assert_eq!(ruler(Scale::Linear, 0.0, 2.5e6).exponent(), 6);
        assert_eq!(
            labels(Scale::Linear, 0.0, 2.5e6, 5),
            ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"]
        );
        assert_eq!(ruler(Scale::Linear, 0.0, 3e-6).exponent(), -6);
    }

    #[test]
    fn degenerate_ranges_still_make_an_axis() {
        for (scale, low, high) in [
            (Scale::Linear, 2.0, 2.0),
            (Scale::Linear, f64::NAN, 1.0),
            (Scale::Logarithmic, 0.0, 0.0),
            (Scale::Logarithmic, 3.0, 3.0),
        ] {
            let ruler = ruler(scale, low, high);
            assert!(ruler.high > ruler.low && !ruler.ticks(4).is_empty(), "{ruler:?}");
        }
    }

    #[test]
    fn logarithmic_ticks_are_decades_thinned_to_fit() {
        let logarithmic = |low, high, count| labels(Scale::Logarithmic, low, high, count);
        assert_eq!(logarithmic(10.0, 6000.0, 6), ["10", "100", "1000"]);
        assert!(logarithmic(1e-16, 1e-4, 5).len() <= 5);
        assert_eq!(logarithmic(1e-16, 1e-4, 13)[0], "10^{−16}");
    }

    #[test]
    fn short_logarithmic_ranges_have_at_least_two_labels() {
        let logarithmic = |low, high| labels(Scale::Logarithmic, low, high, 4);
        assert_eq!(logarithmic(1.5e-3, 4.4e-3), ["0.0015", "0.002", "0.003", "0.004"]);
        assert_eq!(logarithmic(2.6e-8, 1.7e-7), ["3·10^{−8}", "5·10^{−8}", "10^{−7}"]);
        assert_eq!(logarithmic(21.0, 49.0), ["25", "30", "35", "40", "45"]);
        for (low, high) in [(2.1e-3, 4.9e-3), (0.11, 0.13), (6.1e-8, 8.9e-8), (95.0, 102.0)] {
            assert!(logarithmic(low, high).len() > 1, "{low} {high}");
        }
    }
}
