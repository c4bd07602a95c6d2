//! Numbers for people, and the units that the endings of keys say.

use serde::{Deserialize, Serialize};

/// How a number is written for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Format {
    /// As few digits as say it.
    Plain,
    /// A whole number.
    Count,
    /// So many digits behind the point.
    Fixed(usize),
    /// The same with a sign.
    Signed(usize),
    /// So many significant digits, with an exponent only where there is no room.
    Significant(usize),
    /// One digit, so many behind the point, and an exponent.
    Scientific(usize),
    /// A fraction of one in per cent, so many digits behind the point.
    Percent(usize),
}

/// Endings of keys and the units that they say.
pub(super) const ENDINGS: &[(&str, &str)] = &[
    ("_rad_per_s", "rad/s"),
    ("_m_per_s2", "m/s2"),
    ("_m_per_s", "m/s"),
    ("_n_s_per_m", "N s/m"),
    ("_n_per_m", "N/m"),
    ("_w_per_m", "W/m"),
    ("_per_s", "1/s"),
    ("_hz", "Hz"),
    ("_rpm", "rpm"),
    ("_percent", "%"),
    ("_bytes", "bytes"),
    ("_kg", "kg"),
    ("torque_n_m", "N m"), // `u_n_m` is a displacement along the normal.
    ("_mpa", "MPa"),
    ("_pa", "Pa"),
    ("_m2", "m2"),
    ("_m3", "m3"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_db", "dB"),
    ("_s", "s"),
    ("_m", "m"),
    ("_n", "N"),
    ("_w", "W"),
    ("_j", "J"),
];

/// The unit that a key or the last part of a path says, and the key without it; none of a pure number.
pub fn unit_of(path: &str) -> (&str, &'static str) {
    let key = path.rsplit('.').next().unwrap_or(path).trim_end_matches("[]");
    let ending = ENDINGS.iter().find(|(ending, _)| key.ends_with(ending));
    ending.map_or((key, ""), |(ending, unit)| (&key[..key.len() - ending.len()], unit))
}

impl Format {
    /// The number alone; `-` where there is none.
    pub fn number(self, value: f64) -> String {
        if !value.is_finite() {
            return "-".to_owned();
        }
        // Adding zero turns -0.0 into 0.0.
        let value = value + 0.0;
        let text = match self {
            Self::Plain => format!("{value}"),
            Self::Count => format!("{value:.0}"),
            Self::Fixed(digits) => format!("{value:.digits$}"),
            Self::Signed(digits) => return format!("{value:+.digits$}"),
            Self::Percent(digits) => format!("{:.digits$}", 100.0 * value),
            Self::Scientific(digits) => format!("{value:.digits$e}"),
            Self::Significant(digits) => significant(value, digits),
        };
        // Small negative numbers must not round to -0.00.
        match text.strip_prefix('-') {
            Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
            _ => text,
        }
    }

    /// The number with its unit.
    pub fn text(self, value: f64, unit: &str) -> String {
        let number = self.number(value);
        if unit.is_empty() || !value.is_finite() { number } else { format!("{number} {unit}") }
    }
}

/// A number with so many decimals, without the sign of a zero; `-` where there is none.
pub fn fixed(value: f64, decimals: usize) -> String {
    Format::Fixed(decimals).number(value)
}

/// So many significant digits, without trailing zeros; an exponent below 1e-4 and from 1e10 on.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let rounded = format!("{:.*e}", digits.saturating_sub(1), value);
    let Some((mantissa, exponent)) = rounded.split_once('e') else { return rounded };
    let power: i32 = exponent.parse().unwrap_or(0);
    if (-4..10).contains(&power) {
        let decimals = (digits as i32 - 1 - power).max(0) as usize;
        return trimmed(&format!("{value:.decimals$}")).to_owned();
    }
    format!("{}e{exponent}", trimmed(mantissa))
}

/// The number of so many significant digits: 0.0125, not 0.012499999999999999.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// Without zeros at the end of the decimals.
fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_along_the_normal_is_no_torque() {
        let units = ["torque_n_m", "u_n_m", "amplitude_n_m"].map(|key| unit_of(key).1);
        assert_eq!(units, ["N m", "m", "m"]);
    }

    #[test]
    fn no_number_is_shown_as_nan_infinite_or_negative_zero() {
        use Format::{Count, Fixed, Percent, Plain, Scientific, Significant};
        for format in [Plain, Count, Fixed(2), Percent(1), Scientific(3), Significant(4)] {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert_eq!(format.text(value, "Hz"), "-");
            }
            for value in [-0.0, -1e-300] {
                let text = format.number(value);
                let is_zero = text.parse::<f64>().is_ok_and(|number| number == 0.0);
                assert!(!(is_zero && text.starts_with('-')), "{format:?}: {text}");
            }
        }
    }

    #[test]
    fn a_small_negative_number_loses_its_sign_with_its_digits() {
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(fixed(-0.06, 1), "-0.1");
        assert_eq!(fixed(f64::NAN, 1), "-");
    }

    #[test]
    fn significant_digits_need_no_exponent_where_there_is_room() {
        for (value, text) in [
            (9433.1234, "9433.1"),
            (0.3, "0.3"),
            (1.5e-5, "1.5e-5"),
            (-12345678.0, "-12345678"),
            (7.4e12, "7.4e12"),
        ] {
            assert_eq!(significant(value, 5), text);
        }
    }
}
