//! Materials that hardly any solid has.

use super::Limit;
use crate::ModeLimit;
use crate::*;
use std::ops::RangeInclusive;

/// Speeds of waves in a bar, m/s: soft rubber to ceramics.
const WAVE_SPEEDS: RangeInclusive<f64> = 100.0..=10_000.0;
/// Those beyond which no material is, m/s.
const POSSIBLE_WAVES: RangeInclusive<f64> = 1e-3..=1e6;
/// Densities of solids, kg/m3: foams to heavy metals.
const DENSITIES: RangeInclusive<f64> = 20.0..=25_000.0;
/// Poisson's ratio beyond which elements lock, but those of plane stress.
const LARGEST_POISSON_RATIO: f64 = 0.49;

/// `sqrt(E / rho)`, m/s.
pub(super) fn bar_wave_speed(case: &Case) -> f64 {
    (case.material.young_modulus / case.material.density).sqrt()
}

/// A key of the material of the first region.
pub(crate) fn material_key(case: &Case, key: &str) -> String {
    let first = regions(case).into_iter().next();
    format!("{}.{key}", first.map_or_else(|| "material".to_owned(), |own| own.0))
}

/// The key of the modulus of a material: of an orthotropic one the list, of whose values the mean is judged.
fn modulus_name(own: &ElasticMaterial) -> &'static str {
    if own.orthotropy.is_some() { "young_moduli" } else { "young_modulus" }
}

/// The key that sets the modulus of the material of the first region.
pub(super) fn modulus_key(case: &Case) -> String {
    material_key(case, modulus_name(&case.material))
}

/// The material of each region with the section that gives it.
fn regions(case: &Case) -> Vec<(String, &ElasticMaterial)> {
    // Of an annulus there are the disc and the shaft in it.
    let generated = || vec![String::new(), "shaft".to_owned()];
    let names = case.body.whole_mesh().map_or_else(generated, |mesh| mesh.regions.clone());
    let section = |name: String| {
        let own = format!("materials.{name}");
        let is_given = case.number(&format!("{own}.density")).is_some();
        if is_given { own } else { "material".to_owned() }
    };
    names.into_iter().map(section).zip(case.body.materials.iter().map(|own| &own.elastic)).collect()
}

/// Speed of waves in a bar of the material of each region, `sqrt(E / rho)`: what is least possible first.
pub(super) fn wave_speed(case: &Case) -> Option<Limit> {
    let found = regions(case).into_iter().filter_map(|(section, own)| {
        let (modulus, density) = (own.young_modulus, own.density);
        let speed = Some((modulus / density).sqrt()).filter(|own| !WAVE_SPEEDS.contains(own))?;
        // The one that no solid has; rigid ones are within a factor of ten.
        let [modulus_key, density_key] =
            [modulus_name(own), "density"].map(|key| format!("{section}.{key}"));
        let (key, label) = match DENSITIES.contains(&density) {
            true => (&modulus_key, "pascals?"),
            false => (&density_key, "kg/m3?"),
        };
        let said = diagnosis!(case, key,
            "{modulus_key} = {modulus:e} Pa and {density_key} = {density:e} kg/m3 give waves of \
             {speed:.3e} m/s, outside {} to {} m/s", WAVE_SPEEDS.start(), WAVE_SPEEDS.end();
            "{label}"; "a case is in SI: Pa, not MPa or GPa; kg/m3, not g/cm3 or t/mm3");
        Some(Limit { is_possible: POSSIBLE_WAVES.contains(&speed), said })
    });
    found.min_by_key(|limit| limit.is_possible)
}

/// A density that no solid has, where the speed of waves does not give it away.
pub(super) fn density(case: &Case) -> Option<Diagnostic> {
    let densities = case.model_numbers().into_iter().filter(|(key, _)| key.ends_with(".density"));
    let (key, value) = densities.into_iter().find(|(_, value)| !DENSITIES.contains(value))?;
    let is_said = wave_speed(case).is_some_and(|limit| limit.said.message.contains(&key));
    (!is_said).then(|| {
        let [least, most] = [DENSITIES.start(), DENSITIES.end()];
        diagnosis!(case, &key, "{key} = {value:?} kg/m3 is outside {least} to {most} kg/m3";
            "kg/m3?"; "a case is in SI: kg/m3, not g/cm3 or t/mm3")
    })
}

/// A ratio at which elements lock.
pub(super) fn poisson_ratio(case: &Case) -> Option<Diagnostic> {
    let locks = |own: &ElasticMaterial| {
        let is_plane_stress = own.formulation == PlaneFormulation::PlaneStress;
        own.poisson_ratio > LARGEST_POISSON_RATIO && !is_plane_stress && own.orthotropy.is_none()
    };
    let (section, own) = regions(case).into_iter().find(|own| locks(own.1))?;
    let (key, ratio) = (format!("{section}.poisson_ratio"), own.poisson_ratio);
    // c_p grows with sqrt((1 - nu) / ((1 + nu) (1 - 2 nu))).
    let shrinks = 0.55 / (1.45 * 0.1) / ((1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio)));
    Some(diagnosis!(case, &key,
        "{key} = {ratio} is nearly incompressible: the elements lock, and the time step of a \
         transient shrinks by {:.3} against 0.45", shrinks.sqrt();
        "above 0.49"; "use a lower ratio or plane stress, and study the convergence"))
}

/// `zeta = (alpha / omega + beta omega) / 2` at the highest frequency asked for, else where a bar as long as the body
/// has its first mode.
pub(super) fn overdamping(case: &Case) -> Option<Diagnostic> {
    let limit = match case.cea.as_ref().map(|cea| cea.modes) {
        Some(ModeLimit::MaxFrequency(limit)) => limit,
        _ => (bar_wave_speed(case) / (4.0 * case.body.size())).round().max(1.0),
    };
    let zeta = case.damping.rayleigh.damping_factor(std::f64::consts::TAU * limit);
    (zeta > 1.0).then(|| {
        diagnosis!(case, "damping.stiffness_coefficient",
            "damping.stiffness_coefficient and damping.mass_coefficient give a damping factor of \
             {zeta:.3} at {limit} Hz: modes there do not vibrate";
            "beyond critical"; "alpha is in 1/s and beta in s")
    })
}
