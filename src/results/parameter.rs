//! Names of case keys on the axes of figures.

use crate::chart::{Axis, literal};

/// The mark-up that names a case key in legends and labels: its quantity with the symbol, or the key itself.
pub fn parameter_name(key: &str) -> String {
    named(key).map_or_else(|| literal(key), |(quantity, _)| quantity.to_owned())
}

/// An axis over the values of a case key: quantity, symbol and unit; the key itself where it is not one of those that
/// studies go over.
pub fn parameter_axis(key: &str) -> Axis {
    match named(key) {
        Some((quantity, unit)) => Axis::new(quantity, unit),
        None => Axis::new(&literal(key), ""),
    }
}

/// Quantity, symbol and unit of the keys that studies go over.
fn named(key: &str) -> Option<(&'static str, &'static str)> {
    Some(match key {
        "geometry.inner_radius" => ("inner radius *a*", "m"),
        "geometry.outer_radius" => ("outer radius", "m"),
        "geometry.thickness" => ("thickness", "m"),
        "material.young_modulus" => ("Young's modulus *E*", "Pa"),
        "material.poisson_ratio" => ("Poisson's ratio *ν*", "–"),
        "material.density" => ("density *ρ*", "kg/m³"),
        "damping.mass_coefficient" => ("mass damping *α*_{R}", "1/s"),
        "damping.stiffness_coefficient" => ("stiffness damping *β*_{R}", "s"),
        "contact.friction_coefficient" => ("friction coefficient *μ*", "–"),
        "contact.static_friction_ratio" => ("static over kinetic friction *q*", "–"),
        "contact.decay_speed" => ("decay speed *v*_{c}", "m/s"),
        "contact.interference" => ("interference *δ*", "m"),
        "contact.rotation_speed_rpm" => ("rotation speed *Ω*", "rpm"),
        "contact.speed" => ("speed *V*", "m/s"),
        "contact.normal_stiffness" => ("contact stiffness *k*_{n}", "Pa/m"),
        "contact.normal_damping" => ("normal contact damping", "Pa s/m"),
        "contact.tangential_damping" => ("tangential contact damping", "Pa s/m"),
        _ => return None,
    })
}
