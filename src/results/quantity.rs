//! Every reported quantity: key, caption, unit and format, declared once.
//!
//! The key is the name in JSON, CSV and the columns of a study. Printed lines, rows of reports and titles of axes
//! take caption, unit and digits from here. A key that is not in the table is shown as it reads, with the unit that its
//! ending says (`_hz`, `_s`, `_pa`, ...).

use crate::output::{Format, unit_of};
use serde_json::Value;

pub use crate::output::{fixed, significant};

/// One quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity<'a> {
    /// Name in JSON and CSV.
    pub key: &'a str,
    /// What a person calls it.
    pub caption: &'a str,
    /// Unit of the value as it is stored; empty for a pure number.
    pub unit: &'a str,
    /// Digits.
    pub format: Format,
}

const fn quantity_of(
    key: &'static str,
    caption: &'static str,
    unit: &'static str,
    format: Format,
) -> Quantity<'static> {
    Quantity { key, caption, unit, format }
}

use Format::{Count, Fixed, Percent, Scientific, Significant};

/// Every quantity by its key; one that belongs to an object is `object.key`.
const QUANTITIES: &[Quantity<'static>] = &[
    // The model and its solution.
    quantity_of("nodes", "nodes", "", Count),
    quantity_of("elements", "elements", "", Count),
    quantity_of("dofs", "unknowns", "", Count),
    quantity_of("contact_nodes", "contact nodes", "", Count),
    quantity_of("smallest_edge_m", "shortest edge", "m", Scientific(4)),
    quantity_of("largest_edge_m", "longest edge", "m", Scientific(4)),
    quantity_of("largest_aspect_ratio", "largest aspect ratio", "", Fixed(2)),
    quantity_of("area_m2", "area", "m2", Scientific(6)),
    quantity_of("area_error", "area off the annulus by", "", Scientific(1)),
    quantity_of("wall_s", "wall time", "s", Fixed(3)),
    quantity_of("core_s", "processor time", "s", Fixed(1)),
    quantity_of("residual", "residual", "", Scientific(1)),
    quantity_of("largest_residual", "largest residual", "", Scientific(1)),
    quantity_of("largest_error", "largest error", "", Scientific(1)),
    quantity_of("backward_error", "largest backward error", "", Scientific(1)),
    quantity_of("max_balance_residual", "energy balance residual", "", Scientific(1)),
    quantity_of("balance_residual", "energy balance residual", "", Scientific(1)),
    quantity_of("lines", "lines", "", Count),
    quantity_of("basis_vectors", "basis vectors", "", Count),
    quantity_of("noise", "noise", "", Significant(3)),
    // Modes.
    quantity_of("harmonic", "n", "", Count),
    quantity_of("branch", "branch", "", Count),
    quantity_of("friction_coefficient", "friction coefficient", "", Significant(6)),
    quantity_of("critical_friction", "critical friction", "", Fixed(6)),
    quantity_of("restabilized_friction", "stable again from", "", Fixed(6)),
    quantity_of("frequency_hz", "frequency", "Hz", Fixed(2)),
    quantity_of("real_hz", "real part", "Hz", Fixed(3)),
    quantity_of("growth_rate_per_s", "growth rate", "1/s", Fixed(2)),
    quantity_of("damping_factor", "damping factor", "", Scientific(3)),
    quantity_of("mass_coefficient", "alpha_R", "1/s", Significant(4)),
    quantity_of("stiffness_coefficient", "beta_R", "s", Significant(4)),
    quantity_of("torque_n_m", "torque", "N m", Fixed(4)),
    quantity_of("drag_n", "drag", "N", Fixed(4)),
    // Transients and limit cycles.
    quantity_of("steps", "steps", "", Count),
    quantity_of("time_step_s", "time step", "s", Scientific(4)),
    quantity_of("main_frequency_hz", "main frequency", "Hz", Fixed(2)),
    quantity_of("main_harmonic", "nodal diameters", "", Count),
    quantity_of("second_frequency_hz", "second frequency", "Hz", Fixed(2)),
    quantity_of("envelope_ratio", "largest over smallest envelope", "", Fixed(2)),
    quantity_of("rate_per_s", "growth rate", "1/s", Fixed(1)),
    quantity_of("first_nonlinearity_s", "first node that sticks or opens", "s", Fixed(6)),
    quantity_of("settled_from_s", "settled from", "s", Fixed(6)),
    quantity_of("status.stick", "stick", "", Fixed(3)),
    quantity_of("status.slip", "slip", "", Fixed(3)),
    quantity_of("status.open", "open", "", Fixed(3)),
    quantity_of("power_w.external", "external power", "W", Fixed(2)),
    quantity_of("power_w.stick", "stick power", "W", Fixed(2)),
    quantity_of("power_w.slide", "slide power", "W", Fixed(2)),
    quantity_of("power_w.contact_dissipated", "dissipated in the contact", "W", Fixed(2)),
    quantity_of("power_w.material_damping", "dissipated in the body", "W", Fixed(2)),
    quantity_of("power_w.normal_contact", "normal contact power", "W", Fixed(2)),
    quantity_of("power_w.contact_damping", "dissipated in dashpots of the contact", "W", Fixed(2)),
    quantity_of("ambiguous_friction", "contact nodes free to stick or slip", "", Percent(2)),
    quantity_of(
        "unconverged_steps",
        "steps without converged forces between the bodies",
        "",
        Count,
    ),
    quantity_of("element_steps_per_s", "element-steps", "1/s", Significant(3)),
    quantity_of("contact_open_fraction", "contact open", "", Percent(1)),
    // Basins.
    quantity_of("winner", "n that always wins", "", Count),
    quantity_of("boundary.low", "ratio below", "", Fixed(3)),
    quantity_of("boundary.high", "ratio above", "", Fixed(3)),
    // Studies.
    quantity_of("points_per_core_hour", "points per core-hour", "", Fixed(0)),
    quantity_of("phases", "phases", "", Count),
    quantity_of("order", "observed order", "", Fixed(2)),
];

/// The quantity of a key or a dotted path such as `cycles.0.status.stick`: that of the longest end of the path that the
/// table has, else what the key itself says.
pub fn quantity(path: &str) -> Quantity<'_> {
    let starts = std::iter::once(0).chain(path.match_indices('.').map(|(at, _)| at + 1));
    let mut ends = starts.map(|start| &path[start..]);
    let known = ends.find_map(|end| QUANTITIES.iter().find(|known| known.key == end));
    if let Some(known) = known {
        return *known;
    }
    let (caption, unit) = unit_of(path);
    let key = path.rsplit('.').next().unwrap_or(path);
    Quantity { key, caption, unit, format: Significant(5) }
}

impl Quantity<'_> {
    /// Caption in words, with the unit in brackets: the head of a column.
    pub fn label(&self) -> String {
        let caption = self.caption.replace('_', " ");
        match (self.unit, self.format) {
            (_, Percent(_)) => format!("{caption} (%)"),
            ("", _) => caption,
            (unit, _) => format!("{caption} ({unit})"),
        }
    }

    /// The number alone; `-` where there is none.
    pub fn number(&self, value: f64) -> String {
        self.format.number(value)
    }

    /// The number with its unit.
    pub fn text(&self, value: f64) -> String {
        let number = self.number(value);
        let unit = match self.format {
            Percent(_) => "%",
            _ => self.unit,
        };
        if unit.is_empty() || !value.is_finite() { number } else { format!("{number} {unit}") }
    }

    /// A value of a summary as people read it: numbers in the quantity's format, text as it is, nothing for null.
    pub fn cell(&self, value: &Value) -> String {
        match value {
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            other => match other.as_f64() {
                Some(number) => self.number(number),
                None => other.to_string(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_declared_once_and_its_unit_is_the_one_that_its_ending_says() {
        for (at, known) in QUANTITIES.iter().enumerate() {
            let twice = QUANTITIES[at + 1..].iter().any(|q| q.key == known.key);
            assert!(!twice, "{}", known.key);
            let unit = unit_of(known.key).1;
            assert!(unit.is_empty() || unit == known.unit, "{}", known.key);
        }
    }

    #[test]
    fn a_path_has_the_quantity_of_its_longest_known_end() {
        assert_eq!(quantity("cycles.0.status.stick").caption, "stick");
        assert_eq!(quantity("transient.power_w.stick").label(), "stick power (W)");
        assert_eq!(quantity("peak_acceleration_m_per_s2").label(), "peak acceleration (m/s2)");
    }

    #[test]
    fn no_number_is_shown_as_nan_infinite_or_negative_zero() {
        for known in QUANTITIES {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert_eq!(known.text(value), "-");
            }
            for value in [-0.0, -1e-300] {
                let text = known.number(value);
                let is_zero = text.parse::<f64>().is_ok_and(|number| number == 0.0);
                assert!(!(is_zero && text.starts_with('-')), "{}: {text}", known.key);
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
