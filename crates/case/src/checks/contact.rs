//! Contacts that hardly any pair of bodies has.

use super::{Limit, material::modulus_key, mesh::lengths};
use crate::contact::{Springs, section_of};
use crate::*;

/// Sliding speed of dry contacts, m/s: that of brakes of racing cars and trains lies below.
const LARGEST_SPEED: f64 = 200.0;
/// Friction coefficients of real pairs lie below.
const LARGEST_FRICTION: f64 = 2.0;
/// Friction coefficient beyond which nothing slides.
const STICKING_FRICTION: f64 = 1000.0;
/// Share of the radius beyond which an interference is no small displacement.
const LARGEST_INTERFERENCE: f64 = 0.05;
/// Share of the modulus beyond which a contact pressure is no small strain.
const LARGEST_PRESSURE: f64 = 0.1;
/// Part of the body's size that a surface may stand inside its counterface where nothing is pushed in: round-off of the
/// file.
const ROUND_OFF: f64 = 1e-5;
/// Contact stiffness over the modulus over the radius: it is as good as none below the first, drowns the body in
/// round-off beyond the second, and leaves no digit of it beyond the third.
const STIFFNESS_RATIOS: [f64; 3] = [1e-5, 1e8, 1e14];

/// A sliding speed that no dry contact has.
pub(super) fn speed(case: &Case) -> Option<Diagnostic> {
    let own = case.contact.sliding.rotation_speed.abs();
    let radius = if case.body.slides_straight() { 1.0 } else { sliding_radius(case) };
    let speed = own * radius;
    // A radius in millimetres is the reason, which is said.
    (speed > LARGEST_SPEED && lengths(case).is_none()).then(|| {
        let key = case.speed_key();
        diagnosis!(case, &key,
            "{key}: the contact slides at {speed:.4} m/s, faster than {LARGEST_SPEED} m/s";
            "metres per second?"; "speeds are in m/s, rotation speeds in 1/min")
    })
}

/// How far from the axis of what turns the contact reaches, m.
fn sliding_radius(case: &Case) -> f64 {
    if let Some([_, outer]) = case.body.contact_radii() {
        return outer;
    }
    let turning = case.body.assembly().and_then(|own| Some((own, own.axis()?)));
    let Some((own, [point, direction])) = turning else { return case.body.size() };
    let first = own.contacts.first();
    let nodes = first.map_or(&[][..], |first| &own.mesh.boundaries[first.surface].nodes);
    let away = |&node: &u32| {
        let from = Vector3::from(own.mesh.nodes[node as usize]) - Vector3::from(point);
        from.cross(&Vector3::from(direction)).norm()
    };
    nodes.iter().map(away).fold(0.0, f64::max)
}

/// A friction coefficient of the contact or of a sweep that no pair of materials has.
pub(super) fn friction(case: &Case) -> Option<Limit> {
    let keys = case.contact_sections().into_iter();
    let keys = keys.map(|(section, _)| format!("{section}.friction_coefficient"));
    let own = keys.filter_map(|key| Some((case.number(&key)?, key)));
    let swept = case.cea.iter().flat_map(|cea| {
        let keys = ["cea.friction_coefficients", "cea.shapes_at"];
        let lists = [&cea.friction_coefficients, &cea.shapes_at];
        let pairs = keys.into_iter().zip(lists);
        pairs.flat_map(|(key, values)| values.iter().map(move |value| (*value, key.to_owned())))
    });
    let largest = own.chain(swept).min_by(|a, b| b.0.total_cmp(&a.0));
    let (value, key) = largest.filter(|(value, _)| *value > LARGEST_FRICTION)?;
    let said = diagnosis!(case, &key,
        "{key} = {value:?} is above {LARGEST_FRICTION}, higher than that of any dry pair of \
         materials"; "above 2"; "a friction coefficient is a ratio, not a percentage");
    Some(Limit { is_possible: value <= STICKING_FRICTION, said })
}

/// Pressure of an annulus clamped at `b` and widened by `delta` at `a`, after Lame: `p = 2 B ((lambda + mu) / b^2 + mu
/// / a^2)` with `B = delta a b^2 / (b^2 - a^2)`. None for a body of no known pressure.
pub(super) fn lame_pressure(case: &Case) -> Option<f64> {
    let grid = case.body.grid()?;
    let (a, b) = (grid.inner_radius, grid.outer_radius);
    let [lambda, shear] = case.material.lame_constants();
    let widening = case.contact.sliding.interference * a * b * b / (b * b - a * a);
    Some(2.0 * widening * ((lambda + shear) / (b * b) + shear / (a * a)))
}

/// Interference against the radius, else the contact pressure against the modulus.
pub(super) fn interference(case: &Case) -> Option<Diagnostic> {
    let key = case.contact_key("interference");
    let (name, a) = match case.body.grid() {
        Some(grid) => ("geometry.inner_radius", grid.inner_radius),
        None => ("half the width of the mesh", case.body.size()),
    };
    let delta = case.contact.sliding.interference;
    let (what, label) = if delta > LARGEST_INTERFERENCE * a {
        let share = delta / a;
        let what = format!(
            "is {share:.3} times {name} = {a} m: a model of small displacements holds below {LARGEST_INTERFERENCE}"
        );
        (what, "more than 5 %")
    } else {
        let (pressure, modulus) = (lame_pressure(case)?, case.material.young_modulus);
        let share = Some(pressure / modulus).filter(|share| *share > LARGEST_PRESSURE)?;
        let what = format!(
            "gives a contact pressure of about {pressure:.3e} Pa, {share:.2} of {} = {modulus:e} \
             Pa: strains are not small",
            modulus_key(case),
        );
        (what, "a large pressure")
    };
    let force = case.contact_key("normal_force");
    Some(match case.number(&force) {
        Some(own) => diagnosis!(case, &force,
            "{force} = {own} N pushes the counterface in by {delta:.3e} m, which {what}";
            "{label}"; "is it in newtons, and for each metre where geometry.thickness is left out?"),
        None => diagnosis!(case, &key, "{key} = {delta} m {what}";
            "{label}"; "is it in metres? 25 micrometres are 25e-6"),
    })
}

/// A surface that stands deeper inside its rigid counterface than this is pushed in.
pub(super) fn overlap(case: &Case) -> Option<Diagnostic> {
    let found: Vec<(String, f64, f64)> = match &case.body.kind {
        BodyKind::Imported(body) if body.mesh.opposite.is_none() => {
            let distances = body.mesh.distances_from_counterface(body.mesh.contact_edge());
            let depth = distances.into_values().map(|distance| -distance).reduce(f64::max)?;
            let pushed = case.contact.sliding.interference;
            vec![("contact.interference".to_owned(), depth, pushed)]
        }
        BodyKind::Assembly(body) if body.base == BaseChoice::Solved => {
            let overlap = |own: &SlidingSurfaces| {
                // A measured surface says itself where it stands.
                let rigid = own.counter.rigid().filter(|_| own.topography.is_none())?;
                let depth = rigid.overlap(&body.mesh, &body.mesh.boundaries[own.surface])?;
                Some((format!("{}.interference", section_of(own)), depth, rigid.interference))
            };
            body.contacts.iter().filter_map(overlap).collect()
        }
        _ => return None,
    };
    let least = ROUND_OFF * case.body.size();
    let (key, depth, pushed) =
        found.into_iter().find(|(_, depth, pushed)| *depth > pushed.max(least))?;
    let times = format!(", {:.1} times {key}", depth / pushed);
    let times = if pushed > 0.0 { &times } else { "" };
    Some(diagnosis!(case, &key,
        "the surface enters its counterface by {depth:.2e} m{times}, before this is pushed in: the \
         overlap is loaded as pressure"; "less than the mesh's own overlap";
        "correct the radius or the center of the counterface, or mesh the round surface finer; an \
         overlap that is meant belongs into interference"))
}

/// Springs so stiff that they drown the body, or so soft that the contact hardly holds it.
pub(super) fn stiffness(case: &Case) -> Option<Limit> {
    let scale = case.material.young_modulus / case.body.contact_length();
    let [least, most, last] = STIFFNESS_RATIOS;
    let unlikely = |springs: Springs| {
        let (stiffness, share) = (springs.stiffness, springs.stiffness / scale);
        let (what, label, help) = if share > most {
            let what = "radius: the eigenvalues lose that many digits";
            (what, "nearly rigid", case.rigid_remedy(&springs))
        } else if share < least && springs.law.is_none() {
            let what = "size of the contact: the body hardly feels it";
            (what, "nearly free", "stiffnesses are in Pa/m: N/mm3 are 1e9 Pa/m".to_owned())
        } else {
            return None;
        };
        let Springs { key, name, .. } = &springs;
        let said = diagnosis!(case, key,
            "{name} = {stiffness:e} Pa/m is {share:.1e} times the modulus over the {what}";
            "{label}"; "{help}");
        Some(Limit { is_possible: share <= last, said })
    };
    case.springs().into_iter().filter_map(unlikely).min_by_key(|limit| limit.is_possible)
}
