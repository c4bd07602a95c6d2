//! `[cea]`: the complex eigenvalue analysis.

use super::CeaMethod;
use crate::*;
use frictionsim_physics::cea::ModeLimit;

/// `[cea]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Cea {
    /// Friction coefficients of the sweep, rising.
    pub friction_coefficients: Vec<f64>,
    /// Which modes.
    pub modes: ModeLimit,
    /// Which solver.
    pub method: CeaMethod,
    /// Which mass matrix.
    pub mass: MassKind,
    /// Whether the prestress enters the tangent.
    pub geometric_stiffness: bool,
    /// Friction coefficients whose mode shapes are written, rising; they need not be among
    /// `friction_coefficients`.
    pub shapes_at: Vec<f64>,
    /// The case's own friction coefficient, where it is solved beside the others.
    pub own_friction: Option<f64>,
    /// Whether derivatives are computed; where the case does not say, of bodies that are solved harmonic by harmonic.
    pub sensitivities: Option<bool>,
    /// Whether the modes of a whole mesh are counted under friction.
    pub count_modes: bool,
}

impl Cea {
    /// The same at the friction coefficients of the tables alone.
    pub fn of_tables(&self) -> Self {
        Self { shapes_at: Vec::new(), own_friction: None, ..self.clone() }
    }

    /// Friction coefficients to solve at: those of the tables, those of the shapes and the case's own, rising.
    pub fn solved_friction_coefficients(&self) -> Vec<f64> {
        let mut all = [self.friction_coefficients.as_slice(), self.shapes_at.as_slice()].concat();
        all.extend(self.own_friction);
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}

/// Whether the prestress acts on small motions where nothing is said: studies of solid parts of a file are linear about
/// the undeformed bodies.
fn is_stressed_by_default(body: Option<&Body>, is_file: bool) -> bool {
    !(is_file && body.is_some_and(|body| body.assembly().is_some()))
}

impl Case {
    /// Whether the prestress enters the tangent stiffness.
    pub fn has_geometric_stiffness(&self) -> bool {
        let is_file = self.raw.find("mesh.file").is_some();
        let by_default = || is_stressed_by_default(Some(&self.body), is_file);
        self.cea.as_ref().map_or_else(by_default, |cea| cea.geometric_stiffness)
    }
}

pub(super) fn cea(
    section: &Section<'_>,
    root: &Section<'_>,
    body: Option<&Body>,
    friction_coefficient: f64,
) -> Cea {
    let friction_coefficients =
        section.rising("friction_coefficients").unwrap_or_else(|| vec![friction_coefficient]);
    refuse_if!(section.list_length("friction_coefficients") == Some(0); section,
        "friction_coefficients", "cea.friction_coefficients is empty"; "at least one value");
    let unknowns =
        body.map_or(0, |body| body.node_count().saturating_mul(body.dimension() as u128));
    let own = section.has("geometric_stiffness").then(|| section.flag("geometric_stiffness"));
    let has_file = root.section("mesh", false).has("file");
    Cea {
        modes: mode_selection(section, unknowns),
        method: section.choice("method"),
        mass: section.choice("mass"),
        geometric_stiffness: own.unwrap_or(is_stressed_by_default(body, has_file)),
        shapes_at: section.rising("shapes_at").unwrap_or_else(|| vec![friction_coefficient]),
        own_friction: Some(friction_coefficient),
        friction_coefficients,
        sensitivities: section.has("sensitivities").then(|| section.flag("sensitivities")),
        count_modes: section.flag("count_modes"),
    }
}

/// Which modes are wanted of so many unknowns.
pub(super) fn mode_selection(section: &Section<'_>, unknowns: u128) -> ModeLimit {
    let limit = section.optional_number("max_frequency_hz");
    let modes = section.optional_count("modes");
    if let Some(modes) = modes.filter(|modes| *modes as u128 > unknowns && unknowns > 0) {
        refuse!(section, "modes",
            "cea.modes = {modes} is more than the {unknowns} unknowns of the mesh";
            "at most {unknowns}"; "ask for fewer, or refine the mesh");
    }
    // From there on atoms vibrate, no continuum.
    refuse_if!(limit.is_some_and(|hz| hz > 1e12); section, "max_frequency_hz" =>
        "is above all vibrations of a solid"; "at most 1e12 Hz");
    match (limit, modes) {
        (Some(limit), None) => ModeLimit::MaxFrequency(limit),
        (None, Some(modes)) => ModeLimit::Lowest(modes),
        (Some(limit), Some(modes)) => {
            // An override replaces what the file says in the other way.
            let keys = ["modes", "max_frequency_hz"];
            let [is_count, is_limit] = keys.map(|key| section.place(key).source > 0);
            refuse_if!(is_count == is_limit; section, "modes",
                "cea.modes and cea.max_frequency_hz exclude each other"; "give one of the two";
                "keep one of the two");
            let is_counted = is_count && !is_limit;
            if is_counted { ModeLimit::Lowest(modes) } else { ModeLimit::MaxFrequency(limit) }
        }
        (None, None) => {
            refuse!(section, "max_frequency_hz", "cea.max_frequency_hz (or cea.modes) is missing";
                "does not say which modes to find";
                "add `max_frequency_hz = 17500.0` (all modes below it) or `modes = 28` (the lowest ones)");
            ModeLimit::MaxFrequency(f64::NAN)
        }
    }
}
