//! Values that are possible but that hardly anybody means: warnings, each with its reason.

use super::contact::{Springs, section_of};
use super::diagnosis;
use super::diagnostic::Diagnostic;
use super::key::CaseKey;
use super::keys::KEYS;
use super::shown::first_of;
use super::value::RawValue;
use super::{Body, Case};
use crate::fem::PlaneFormulation;
use crate::prestress::{BaseChoice, SlidingSurfaces};

/// Share of the radius beyond which an interference is no small displacement.
const LARGEST_INTERFERENCE: f64 = 0.05;
/// Friction coefficients of real pairs lie below.
const LARGEST_FRICTION: f64 = 2.0;
/// Share of the modulus beyond which a contact pressure is no small strain.
const LARGEST_PRESSURE: f64 = 0.1;
/// Speeds of bar waves, m/s: soft rubber to ceramics.
const WAVE_SPEEDS: [f64; 2] = [100.0, 10_000.0];
/// Densities of solids, kg/m3: foams to heavy metals.
const DENSITIES: std::ops::RangeInclusive<f64> = 20.0..=25_000.0;
/// Lengths that a case has, m.
const LENGTHS: [f64; 2] = [1e-5, 10.0];
/// Thickness beyond which a plane body is hardly meant, m: 1 m is the default, a value for each metre.
const LARGEST_THICKNESS: f64 = 1.0;
/// Jacobian of an element, smallest over largest, below which it is badly shaped.
const SMALLEST_JACOBIAN: f64 = 0.1;
/// Poisson's ratio beyond which elements lock, but those of plane stress.
const LARGEST_POISSON_RATIO: f64 = 0.49;
/// Share of the speed of bar waves beyond which a seeded velocity is no small strain.
const LARGEST_SEED: f64 = 0.01;
/// Times the modulus over the radius below which a contact stiffness is as good as none.
const SMALLEST_STIFFNESS_RATIO: f64 = 1e-5;
/// Sliding speed of dry contacts, m/s: that of brakes of racing cars and trains lies below.
const LARGEST_SPEED: f64 = 200.0;
/// Times the modulus over the radius beyond which a contact stiffness drowns the body in round-off.
const LARGEST_STIFFNESS_RATIO: f64 = 1e8;

/// Part of the body's size that a surface may stand inside its counterface where nothing is pushed in: round-off of the file.
const ROUND_OFF: f64 = 1e-5;

/// What of a case is hardly meant.
pub(super) fn implausible(case: &Case) -> Vec<Diagnostic> {
    [
        lengths(case),
        unmerged_nodes(case),
        element_shape(case),
        wave_speed(case),
        density(case),
        speed(case),
        seeds(case),
        poisson_ratio(case),
        friction(case),
        interference(case),
        overlap(case),
        contact_stiffness(case),
        unresolved_springs(case),
        steep_friction(case),
        overdamping(case),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn lengths(case: &Case) -> Option<Diagnostic> {
    let [least, most] = LENGTHS;
    let [shortest, longest] = LENGTHS.map(metres);
    let range = format!("outside the plausible range of {shortest} to {longest}");
    let is_outside = |value: f64| value < least || value > most;
    let help = "a case is in SI: are these millimetres or micrometres?";
    if let Body::Imported(_) | Body::Assembly(_) = &case.body {
        let width = 2.0 * case.body.size();
        if is_outside(width) {
            let message = format!("the mesh is {width:.4} m wide, {range} (mesh.scale)");
            let help = match case.raw.find("mesh.scale") {
                Some(_) => "mesh.scale makes metres of coordinates: of millimetres it is 0.001",
                None => "metres are read: of millimetres set mesh.units = \"mm-t-s\"",
            };
            return Some(case.diagnosis("mesh.scale", message, "metres?", help));
        }
    }
    let mut radii = case.body.grid().into_iter().flat_map(|grid| {
        [("geometry.inner_radius", grid.inner_radius), ("geometry.outer_radius", grid.outer_radius)]
    });
    if let Some((key, value)) = radii.find(|(_, value)| is_outside(*value)) {
        let message = format!("{key} = {value} m is {range}");
        return Some(case.diagnosis(key, message, "metres?", help));
    }
    let (key, value) = ("geometry.thickness", case.thickness);
    (value < least || value > LARGEST_THICKNESS).then(|| {
        let message = format!(
            "{key} = {value} m is outside the plausible range of {shortest} to {}",
            metres(LARGEST_THICKNESS)
        );
        case.diagnosis(key, message, "metres?", help)
    })
}

/// A length with the unit that suits its size.
fn metres(length: f64) -> String {
    match length {
        l if l < 1e-3 => format!("{} um", (l * 1e9).round() / 1e3),
        l if l < 1.0 => format!("{} mm", (l * 1e6).round() / 1e3),
        l => format!("{l} m"),
    }
}

/// Nodes of an imported mesh that lie on each other without being one.
fn unmerged_nodes(case: &Case) -> Option<Diagnostic> {
    let found = case.body.imported()?.mesh.unmerged_nodes()?;
    Some(diagnosis!(case, "mesh.file", "{found}: the parts are not connected there";
        "parts that were not merged?";
        "join the parts (BooleanFragments or Coherence in the Gmsh geometry, or Coherence Mesh;), \
         unless this is a crack"))
}

/// The worst element of an imported mesh.
fn element_shape(case: &Case) -> Option<Diagnostic> {
    let mesh = &case.body.imported()?.mesh;
    let quality = mesh.quality();
    if quality.worst_jacobian >= SMALLEST_JACOBIAN {
        return None;
    }
    let nodes = mesh.element_nodes(quality.worst_element);
    let count = nodes.len() as f64;
    let sum = |axis: usize| nodes.iter().map(|&n| mesh.nodes[n as usize][axis]).sum::<f64>();
    let labels = nodes.iter().map(|&node| mesh.node_label(node as usize));
    Some(diagnosis!(case, "mesh.file",
        "the Jacobian of an element varies by a factor {:.3} (smallest over largest): that of \
         nodes {} at ({:.6}, {:.6}) m. Below {SMALLEST_JACOBIAN} an element is badly \
         shaped", quality.worst_jacobian, first_of(labels, 9), sum(0) / count, sum(1) / count;
        "a badly shaped element";
        "mesh the surface again, finer where it curves, or with Mesh.Optimize = 1; stresses near \
         it are not reliable"))
}

/// Seeded velocities whose strain, `v / c`, is not small.
fn seeds(case: &Case) -> Option<Diagnostic> {
    let perturbation = &case.transient.as_ref()?.perturbation;
    let waves = perturbation.waves.iter().map(|wave| wave.velocity.abs());
    let wave = waves.fold(0.0, f64::max);
    let (key, largest) = match wave >= perturbation.noise {
        true => ("transient.perturbation.velocity", wave),
        false => ("transient.perturbation.noise", perturbation.noise),
    };
    let speed = bar_wave_speed(case);
    (largest > LARGEST_SEED * speed).then(|| {
        diagnosis!(case, key,
            "{key}: a seed of {largest:e} m/s is {:.3} of the speed of waves in the material, \
             {speed:.0} m/s: its strains are not small", largest / speed;
            "metres per second?";
            "seeds of a linear stage are about 1e-3 m/s, or with relative = true a small share of \
             the slip speed")
    })
}

/// `sqrt(E / rho)`, m/s.
pub(super) fn bar_wave_speed(case: &Case) -> f64 {
    (case.material.young_modulus / case.material.density).sqrt()
}

/// A key of `[material]`, or of the first region where every region has a section of its own.
pub(super) fn material_key(case: &Case, key: &str) -> String {
    let common = format!("material.{key}");
    let regions = case.raw.find("materials").map(|item| &item.value);
    match (case.raw.find(&common), regions) {
        (None, Some(RawValue::Table(regions))) => {
            let region = regions.keys().next().map(|name| format!("materials.{name}.{key}"));
            region.filter(|own| case.raw.find(own).is_some()).unwrap_or(common)
        }
        _ => common,
    }
}

/// The key that sets the modulus of that material: of an orthotropic one the list, of whose values the mean is judged.
pub(super) fn modulus_key(case: &Case) -> String {
    match case.material.orthotropy {
        Some(_) => material_key(case, "young_moduli"),
        None => material_key(case, "young_modulus"),
    }
}

/// Speed of waves in a bar, `sqrt(E / rho)`.
fn wave_speed(case: &Case) -> Option<Diagnostic> {
    let (modulus, density) = (case.material.young_modulus, case.material.density);
    let speed = bar_wave_speed(case);
    let [least, most] = WAVE_SPEEDS;
    if (least..=most).contains(&speed) {
        return None;
    }
    // The one that no solid has; rigid ones are within a factor of ten.
    let [modulus_key, density_key] = [modulus_key(case), material_key(case, "density")];
    let (key, label) = match DENSITIES.contains(&density) {
        true => (&modulus_key, "pascals?"),
        false => (&density_key, "kg/m3?"),
    };
    Some(case.diagnosis(
        key,
        format!(
            "{modulus_key} = {modulus:e} Pa and {density_key} = {density:e} kg/m3 give \
             waves of {speed:.3e} m/s, outside {least} to {most} m/s"
        ),
        label,
        "a case is in SI: Pa, not MPa or GPa; kg/m3, not g/cm3 or t/mm3",
    ))
}

/// A density that no solid has, where the speed of waves does not give it away.
fn density(case: &Case) -> Option<Diagnostic> {
    let parameters = case.model_numbers();
    let densities = parameters.into_iter().filter(|(key, _)| key.ends_with(".density"));
    let (key, value) = densities.into_iter().find(|(_, value)| !DENSITIES.contains(value))?;
    let is_said = wave_speed(case).is_some() && key == material_key(case, "density");
    (!is_said).then(|| {
        let [least, most] = [DENSITIES.start(), DENSITIES.end()];
        let message = format!("{key} = {value:?} kg/m3 is outside {least} to {most} kg/m3");
        case.diagnosis(&key, message, "kg/m3?", "a case is in SI: kg/m3, not g/cm3 or t/mm3")
    })
}

/// A sliding speed that no dry contact has.
fn speed(case: &Case) -> Option<Diagnostic> {
    let own = case.contact.sliding.rotation_speed.abs();
    let radius = match (case.body.slides_straight(), case.body.grid()) {
        (true, _) => 1.0,
        (false, Some(grid)) => grid.inner_radius,
        (false, None) => case.body.size(),
    };
    let speed = own * radius;
    // A radius in millimetres is the reason, which is said.
    (speed > LARGEST_SPEED && lengths(case).is_none()).then(|| {
        let key = case.speed_key();
        let message =
            format!("{key}: the contact slides at {speed:.4} m/s, faster than {LARGEST_SPEED} m/s");
        case.diagnosis(
            &key,
            message,
            "metres per second?",
            "speeds are in m/s, rotation speeds in 1/min",
        )
    })
}

fn poisson_ratio(case: &Case) -> Option<Diagnostic> {
    let ratio = case.material.poisson_ratio;
    let is_plane_stress = case.material.formulation == PlaneFormulation::PlaneStress;
    if ratio <= LARGEST_POISSON_RATIO || is_plane_stress || case.material.orthotropy.is_some() {
        return None;
    }
    let key = material_key(case, "poisson_ratio");
    Some(case.diagnosis(
        &key,
        format!(
            "{key} = {ratio} is nearly incompressible: the elements lock, and the \
             time step of a transient shrinks by {:.3} against 0.45",
            // c_p grows with sqrt((1 - nu) / ((1 + nu) (1 - 2 nu))).
            (0.55 / (1.45 * 0.1) / ((1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio)))).sqrt()
        ),
        "above 0.49",
        "use a lower ratio or plane stress, and study the convergence",
    ))
}

fn friction(case: &Case) -> Option<Diagnostic> {
    let largest = |values: &[f64]| values.iter().fold(0.0, |a: f64, b| a.max(*b));
    let own = case.contact.sliding.friction_coefficient;
    let cea = case.cea.as_ref();
    let keys = [
        ("contact.friction_coefficient", own),
        ("cea.friction_coefficients", cea.map_or(0.0, |cea| largest(&cea.friction_coefficients))),
        ("cea.shapes_at", cea.map_or(0.0, |cea| largest(&cea.shapes_at))),
    ];
    let (key, value) = keys.into_iter().find(|(_, value)| *value > LARGEST_FRICTION)?;
    Some(diagnosis!(case, key,
        "{key} = {value} is above {LARGEST_FRICTION}, higher than that of any dry pair of \
         materials";
        "above 2"; "a friction coefficient is a ratio, not a percentage"))
}

/// Half the mass of a contact element for each unit of edge (kg/m2), and the time step of the transient of a generated body.
fn edge_inertia(case: &Case) -> Option<[f64; 2]> {
    let grid = case.body.grid()?;
    let step = case.cost().transient?.time_step;
    let depth = (grid.outer_radius - grid.inner_radius) / grid.radial_elements as f64;
    let mass = 0.5 * case.material.density * depth;
    Some([mass, step])
}

/// Springs whose own motion of the contact nodes the time step does not resolve, `k dt^2 > 4 m`: those of contact that stiffens
/// at the pressure of rigid contact.
fn unresolved_springs(case: &Case) -> Option<Diagnostic> {
    let springs = case.springs().into_iter().next()?;
    let [mass, step] = edge_inertia(case)?;
    let most = 4.0 * mass / (step * step);
    let pressed = springs.law.zip(lame_pressure(case));
    let (stiffness, name) = match pressed {
        Some((law, pressure)) => (
            law.stiffness(law.approach(pressure)),
            format!("the stiffness of the contact at {pressure:.1e} Pa"),
        ),
        None => (springs.stiffness, springs.name()),
    };
    (stiffness > most).then(|| {
        diagnosis!(case, &springs.key(),
            "{name} = {stiffness:e} Pa/m is more than the time step of the transient, {step:.2e} \
             s, resolves on this mesh, about {most:.1e} Pa/m. The status of contact nodes would \
             flicker";
            "nearly rigid"; "{}, or a smaller transient.time_step", case.rigid_remedy(&springs))
    })
}

/// Friction that falls faster with speed than the inertia of contact nodes allows, `dt p |mu'(0)| > m`.
fn steep_friction(case: &Case) -> Option<Diagnostic> {
    let contact = &case.contact.sliding;
    let decay = contact.decay?;
    let [mass, step] = edge_inertia(case)?;
    let fall = contact.friction_coefficient * decay.steepest_fall();
    let most = mass / (lame_pressure(case)? * fall);
    (step > most).then(|| {
        diagnosis!(case, "contact.decay_speed",
            "contact.decay_speed = {} m/s lets friction fall faster than the contact nodes can \
             follow within a time step of the transient, {step:.2e} s. Nodes may jump between \
             sticking and slipping", decay.decay_speed;
            "a steep law";
            "use a transient.time_step below about {most:.1e}, or a larger contact.decay_speed")
    })
}

/// Pressure of an annulus clamped at `b` and widened by `delta` at `a`, after Lame:
/// `p = 2 B ((lambda + mu) / b^2 + mu / a^2)` with `B = delta a b^2 / (b^2 - a^2)`. None for a body of no known pressure.
fn lame_pressure(case: &Case) -> Option<f64> {
    let grid = case.body.grid()?;
    let (a, b) = (grid.inner_radius, grid.outer_radius);
    let [lambda, shear] = case.material.lame_constants();
    let widening = case.contact.sliding.interference * a * b * b / (b * b - a * a);
    Some(2.0 * widening * ((lambda + shear) / (b * b) + shear / (a * a)))
}

/// Interference against the radius, else the contact pressure against the modulus.
fn interference(case: &Case) -> Option<Diagnostic> {
    let key = "contact.interference";
    let (name, a) = match case.body.grid() {
        Some(grid) => ("geometry.inner_radius", grid.inner_radius),
        None => ("half the width of the mesh", case.body.size()),
    };
    let delta = case.contact.sliding.interference;
    let help = "is it in metres? 25 micrometres are 25e-6";
    if delta > LARGEST_INTERFERENCE * a {
        let share = format!(
            "{key} = {delta} m is {:.3} of {name} = {a} m: a model of small \
             displacements holds below {LARGEST_INTERFERENCE}",
            delta / a
        );
        return Some(case.diagnosis(key, share, "more than 5 %", help));
    }
    let pressure = lame_pressure(case)?;
    let modulus = case.material.young_modulus;
    (pressure > LARGEST_PRESSURE * modulus).then(|| {
        let message = format!(
            "{key} = {delta} m gives a contact pressure of about {pressure:.3e} Pa, {:.2} of \
             {} = {modulus:e} Pa: strains are not small",
            pressure / modulus,
            modulus_key(case),
        );
        case.diagnosis(key, message, "a large pressure", help)
    })
}

/// A surface that stands deeper inside its rigid counterface than this is pushed in.
fn overlap(case: &Case) -> Option<Diagnostic> {
    let found: Vec<(String, f64, f64)> = match &case.body {
        Body::Imported(body) if body.mesh.opposite.is_none() => {
            let distances = body.mesh.distances_from_counterface(body.mesh.contact_edge());
            let depth = distances.into_values().map(|distance| -distance).reduce(f64::max)?;
            let pushed = case.contact.sliding.interference;
            vec![("contact.interference".to_owned(), depth, pushed)]
        }
        Body::Assembly(body) if body.base == BaseChoice::Solved => {
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
    let times = match pushed > 0.0 {
        true => format!(", {:.1} times {key}", depth / pushed),
        false => String::new(),
    };
    let message = format!(
        "the surface enters its counterface by {depth:.2e} m{times}, before this is pushed in: \
         the overlap is loaded as pressure"
    );
    let help = "correct the radius or the center of the counterface, or mesh the round surface \
                finer; an overlap that is meant belongs into interference";
    Some(case.diagnosis(&key, message, "less than the mesh's own overlap", help))
}

/// Springs so stiff that they drown the body, or so soft that the contact hardly holds it.
fn contact_stiffness(case: &Case) -> Option<Diagnostic> {
    let scale = case.material.young_modulus / case.body.contact_length();
    let unlikely = |springs: Springs| {
        let (stiffness, share) = (springs.stiffness, springs.stiffness / scale);
        let (what, label, help) = if share > LARGEST_STIFFNESS_RATIO {
            let what = "radius: the eigenvalues lose that many digits";
            (what, "nearly rigid", case.rigid_remedy(&springs))
        } else if share < SMALLEST_STIFFNESS_RATIO && springs.law.is_none() {
            let what = "size of the contact: the body hardly feels it";
            (what, "nearly free", "stiffnesses are in Pa/m: N/mm3 are 1e9 Pa/m".to_owned())
        } else {
            return None;
        };
        let name = springs.name();
        Some(diagnosis!(case, &springs.key(),
            "{name} = {stiffness:e} Pa/m is {share:.1e} times the modulus over the {what}";
            "{label}"; "{help}"))
    };
    case.springs().into_iter().find_map(unlikely)
}

/// `zeta = (alpha / omega + beta omega) / 2` at the highest frequency asked for, else where a bar as long as the body has its
/// first mode.
fn overdamping(case: &Case) -> Option<Diagnostic> {
    let limit = match case.cea.as_ref().map(|cea| cea.modes) {
        Some(super::ModeSelection::BelowHz(limit)) => limit,
        _ => (bar_wave_speed(case) / (4.0 * case.body.size())).round(),
    };
    let zeta = case.damping.rayleigh.damping_factor(std::f64::consts::TAU * limit);
    (zeta > 1.0).then(|| {
        diagnosis!(case, "damping.stiffness_coefficient",
            "damping.stiffness_coefficient and damping.mass_coefficient give a damping factor of \
             {zeta:.3} at {limit} Hz: modes there do not vibrate";
            "beyond critical"; "alpha is in 1/s and beta in s")
    })
}

impl Case {
    /// Keys that the case gives and that an analysis of a command does not use, each with the reason.
    pub fn ignored_by(&self, command: &str) -> Vec<Diagnostic> {
        let has = [("cycle", self.cycle.is_some()), ("basin", self.basin.is_some())];
        let analyses = has.into_iter().filter(|(analysis, is_here)| {
            *analysis == command || (*is_here && ["sweep", "convergence"].contains(&command))
        });
        let ignored = analyses.filter(|_| self.has_rotating_waves()).flat_map(|(analysis, _)| {
            let keys = KEYS.iter().filter(|key| !key.of_waves.is_empty());
            keys.filter(|key| self.departs_from_default(key)).map(move |key| (analysis, key))
        });
        let say = |(analysis, key): (&str, &CaseKey)| {
            let message = format!("{} is not used by {analysis}: {}", key.name, key.of_waves);
            Diagnostic::error(message, "not used", self.raw.place(key.name), None)
        };
        let mut said: Vec<Diagnostic> = ignored.map(say).collect();
        said.extend(self.ignored_harmonics(command));
        said
    }

    /// Whether the case gives a key another value than its default.
    fn departs_from_default(&self, key: &CaseKey) -> bool {
        let Some(item) = self.raw.find(key.name) else {
            return false;
        };
        let default = match key.default_value() {
            Some(value) => value.to_string(),
            None => key.default_text().to_owned(),
        };
        item.value.to_string().trim_matches('"') != default.trim_matches('"')
    }
}
