//! Names of case keys on the axes of figures.

use crate::prelude::*;

/// Units that take a prefix.
const PREFIXED: [&str; 6] = ["Pa", "Pa/m", "N/m", "m", "s", "Pa s/m"];

/// The mark-up that names a case key in legends and labels: its quantity with the symbol, or the key itself.
pub fn parameter_name(key: &str) -> String {
    named(key).map_or_else(|| literal(key), |(quantity, _)| quantity)
}

/// An axis over the values of a case key: quantity, symbol and unit; the key itself where studies seldom go over it.
pub fn parameter_axis(key: &str) -> Axis {
    let (quantity, unit) = named(key).unwrap_or_else(|| (literal(key), ""));
    let axis = Axis::new(&quantity, unit);
    if PREFIXED.contains(&unit) { axis.prefixed() } else { axis }
}

/// A value of a case key as text in the unit that [`shared_unit`] gives all of them: at most four significant digits.
pub fn in_unit(value: f64, factor: f64) -> String {
    literal(&rounded(value * factor, 4).to_string())
}

/// The factor and the unit, with a prefix where that is usual, in which values of a case key up to `reach` are shown.
pub fn shared_unit(key: &str, reach: f64) -> (f64, String) {
    let unit = named(key).map_or("", |(_, unit)| unit);
    if PREFIXED.contains(&unit) { prefixed(reach * 1.0005, unit) } else { (1.0, unit.to_owned()) }
}

/// Quantity, symbol and unit of the keys that studies go over; those of a named part with its name.
fn named(key: &str) -> Option<(String, &'static str)> {
    let parts: Vec<&str> = key.split('.').collect();
    let (quantity, unit) = match parts.as_slice() {
        ["materials", _, last] => quantity_of(&format!("material.{last}"))
            .or_else(|| quantity_of(&format!("damping.{last}"))),
        ["contacts", _, "normal_force"] => Some(("normal force *N*", "N")),
        ["contacts" | "motion", _, last] => quantity_of(&format!("contact.{last}")),
        ["boundaries", _, last] => quantity_of(&format!("boundary.{last}"))
            .or_else(|| quantity_of(&format!("contact.{last}"))),
        _ => quantity_of(key),
    }?;
    Some(match parts.as_slice() {
        [_, name, _] => (format!("{quantity}, {}", literal(name)), unit),
        _ => (quantity.to_owned(), unit),
    })
}

/// Quantity, symbol and unit of a key of the one material or contact.
fn quantity_of(key: &str) -> Option<(&'static str, &'static str)> {
    Some(match key {
        "geometry.inner_radius" => ("inner radius *a*", "m"),
        "geometry.outer_radius" => ("outer radius", "m"),
        "geometry.thickness" => ("thickness", "m"),
        "material.young_modulus" => ("Young's modulus *E*", "Pa"),
        "material.poisson_ratio" => ("Poisson's ratio *ν*", "–"),
        "material.density" => ("density *ρ*", "kg/m³"),
        "material.loss_factor" | "contact.loss_factor" => ("loss factor *η*", "–"),
        "damping.mass_coefficient" => ("mass damping *α*_{R}", "1/s"),
        "damping.stiffness_coefficient" => ("stiffness damping *β*_{R}", "s"),
        "contact.friction_coefficient" => ("friction coefficient *μ*", "–"),
        "contact.static_friction_ratio" => ("static over kinetic friction *q*", "–"),
        "contact.decay_speed" => ("decay speed *v*_{c}", "m/s"),
        "contact.interference" => ("interference *δ*", "m"),
        "contact.rotation_speed_rpm" => ("rotation speed *Ω*", "rpm"),
        "contact.speed" => ("speed *V*", "m/s"),
        "contact.normal_stiffness" => ("contact stiffness *k*_{n}", "Pa/m"),
        "boundary.normal_stiffness" => ("normal stiffness *k*_{n}", "Pa/m"),
        "boundary.tangential_stiffness" => ("tangential stiffness *k*_{t}", "Pa/m"),
        "boundary.pressure" => ("pressure *p*", "Pa"),
        "contact.cubic_stiffness" => ("cubic contact stiffness *c*", "Pa/m³"),
        "contact.reference_pressure" => ("reference pressure *p*_{r}", "Pa"),
        "contact.height" => ("height of the contact's law *h*", "m"),
        "contact.normal_damping" => ("normal damping", "Pa s/m"),
        "contact.tangential_damping" => ("tangential damping", "Pa s/m"),
        _ => return None,
    })
}
