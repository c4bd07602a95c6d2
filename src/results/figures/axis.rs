//! Axes: ranges, round ticks, labels.

mod logarithmic;

use super::text;

/// Linear or logarithmic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal ratios; the range must be positive.
    Logarithmic,
}

/// One labelled tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where.
    pub value: f64,
    /// Its mark-up.
    pub label: String,
}

/// An axis with its title, which states the unit, and its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Title in mark-up, with the unit.
    pub title: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Ticks set by hand instead of round numbers.
    pub fixed_ticks: Option<Vec<Tick>>,
}

impl Axis {
    /// A linear axis over exactly this range.
    pub fn linear(title: &str, low: f64, high: f64) -> Self {
        let (low, high) = non_empty(low, high);
        Self {
            title: title.into(),
            scale: Scale::Linear,
            low,
            high,
            fixed_ticks: None,
        }
    }

    /// A logarithmic axis over exactly this range; ends that are not positive are replaced.
    pub fn logarithmic(title: &str, low: f64, high: f64) -> Self {
        let high = if high > 0.0 && high.is_finite() {
            high
        } else {
            1.0
        };
        let low = if low > 0.0 && low < high {
            low
        } else {
            high * 1e-3
        };
        Self {
            title: title.into(),
            scale: Scale::Logarithmic,
            low,
            high,
            fixed_ticks: None,
        }
    }

    /// A linear axis over the finite values with 4 % of room at both ends.
    pub fn around(title: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = extremes(values);
        let room = 0.04 * (high - low);
        Self::linear(title, low - room, high + room)
    }

    /// A linear axis symmetric about zero that holds all finite values.
    pub fn symmetric(title: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = extremes(values);
        let reach = 1.05 * low.abs().max(high.abs());
        Self::linear(title, -reach, reach)
    }

    /// The same axis with the given ticks.
    pub fn with_ticks(mut self, ticks: Vec<Tick>) -> Self {
        self.fixed_ticks = Some(ticks);
        self
    }

    /// Position of a value, 0 at the lower end and 1 at the upper.
    pub fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic if value <= 0.0 => f64::NEG_INFINITY,
            Scale::Logarithmic => (value / self.low).ln() / (self.high / self.low).ln(),
        }
    }

    /// Power of ten taken out of the tick labels (a multiple of three, zero for ordinary numbers).
    pub fn exponent(&self) -> i32 {
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
    pub fn ticks(&self, count: usize) -> Vec<Tick> {
        if let Some(ticks) = &self.fixed_ticks {
            return ticks
                .iter()
                .filter(|tick| self.contains(tick.value))
                .cloned()
                .collect();
        }
        match self.scale {
            Scale::Linear => self.linear_ticks(count),
            Scale::Logarithmic => self.logarithmic_ticks(count),
        }
    }

    fn contains(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
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
                Tick {
                    value,
                    label: signed(value / unit, decimals),
                }
            })
            .collect()
    }
}

/// Smallest and largest finite value; `(0, 1)` if there is none.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        if value.is_finite() {
            low = low.min(value);
            high = high.max(value);
        }
    }
    if low > high { (0.0, 1.0) } else { (low, high) }
}

fn non_empty(low: f64, high: f64) -> (f64, f64) {
    if !(low.is_finite() && high.is_finite()) {
        return (0.0, 1.0);
    }
    let reach = low.abs().max(high.abs());
    if high - low > 1e-12 * reach && high > low {
        return (low, high);
    }
    let room = if reach == 0.0 { 1.0 } else { 0.5 * reach };
    (low - room, high + room)
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

/// A number with `decimals` decimals and a true minus sign.
pub fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{:.*}", decimals, value.abs());
    let is_zero = text.chars().all(|c| c == '0' || c == '.');
    if value < 0.0 && !is_zero {
        format!("−{text}")
    } else {
        text
    }
}

/// A number with `digits` significant digits, in plain or scientific notation (mark-up).
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 {
            "0".into()
        } else {
            "–".into()
        };
    }
    let power = value.abs().log10().floor() as i32;
    if (-3..5).contains(&power) {
        return signed(value, (digits as i32 - 1 - power).max(0) as usize);
    }
    let mantissa = signed(value / 10f64.powi(power), digits.saturating_sub(1));
    format!("{mantissa}·10^{{{}}}", signed(f64::from(power), 0))
}

/// Factor and prefixed unit that bring values up to `reach` near 1 to 1000: `(1e-3, "kW")`.
pub fn prefixed(reach: f64, unit: &str) -> (f64, String) {
    const PREFIXES: [(f64, &str); 9] = [
        (1e9, "G"),
        (1e6, "M"),
        (1e3, "k"),
        (1.0, ""),
        (1e-3, "m"),
        (1e-6, "µ"),
        (1e-9, "n"),
        (1e-12, "p"),
        (1e-15, "f"),
    ];
    let reach = reach.abs();
    if reach == 0.0 || !reach.is_finite() {
        return (1.0, unit.into());
    }
    PREFIXES
        .into_iter()
        .find(|(size, _)| reach >= *size)
        .map_or((1.0, unit.into()), |(size, prefix)| {
            (1.0 / size, format!("{prefix}{unit}"))
        })
}

/// Width of the widest of some labels, points.
pub fn widest(labels: &[Tick], size: f64) -> f64 {
    labels
        .iter()
        .map(|tick| text::width(&tick.label, size, false))
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, count: usize) -> Vec<String> {
        axis.ticks(count).into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_inside() {
        assert_eq!(
            labels(&Axis::linear("", 0.0, 0.05), 5),
            ["0.00", "0.01", "0.02", "0.03", "0.04", "0.05"]
        );
        assert_eq!(labels(&Axis::linear("", -3.1, 2.2), 4), ["−2", "0", "2"]);
    }

    #[test]
    fn huge_and_tiny_ranges_take_out_a_power_of_ten() {
        let axis = Axis::linear("", 0.0, 2.5e6);
        assert_eq!(axis.exponent(), 6);
        assert_eq!(labels(&axis, 5), ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"]);
        assert_eq!(Axis::linear("", 0.0, 3e-6).exponent(), -6);
    }

    #[test]
    fn degenerate_ranges_still_make_an_axis() {
        for axis in [
            Axis::linear("", 2.0, 2.0),
            Axis::linear("", f64::NAN, 1.0),
            Axis::around("", [0.0, 0.0]),
            Axis::logarithmic("", 0.0, 0.0),
        ] {
            assert!(axis.high > axis.low);
            assert!(!axis.ticks(4).is_empty(), "{axis:?}");
        }
    }

    #[test]
    fn prefixes_follow_the_size() {
        assert_eq!(prefixed(1370.0, "W"), (1e-3, "kW".into()));
        assert_eq!(prefixed(3e-5, "m").1, "µm");
        assert_eq!(prefixed(0.0, "J"), (1.0, "J".into()));
    }
}
