//! Every key a case can have, with its meaning and an example: what error messages quote.

/// A key of the case file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaseKey {
    /// Dotted name.
    pub name: &'static str,
    /// A valid value, in TOML.
    pub example: &'static str,
    /// What it is, with its unit.
    pub meaning: &'static str,
}

const fn key(name: &'static str, example: &'static str, meaning: &'static str) -> CaseKey {
    CaseKey {
        name,
        example,
        meaning,
    }
}

impl CaseKey {
    /// Whether the value is a number.
    pub fn is_numeric(&self) -> bool {
        self.example.parse::<f64>().is_ok()
    }
}

/// The sections of a case file.
pub const SECTIONS: &[&str] = &[
    "geometry",
    "mesh",
    "material",
    "damping",
    "contact",
    "cea",
    "cea.map",
    "transient",
    "transient.perturbation",
    "output",
    "sweep",
    "cycle",
    "cycle.continuation",
    "frf",
    "convergence",
];

/// All keys in the order of the documentation.
#[rustfmt::skip]
pub const KEYS: &[CaseKey] = &[
    key("title", "\"Polycarbonate disc\"", "a line that heads tables and figures"),
    key("geometry.inner_radius", "0.0205", "the radius of the contact edge, m"),
    key("geometry.outer_radius", "0.0905", "the radius of the clamped edge, m"),
    key("geometry.thickness", "0.009", "the thickness of the disc, m"),
    key("mesh.circumferential_elements", "180", "the number of elements around the disc"),
    key("mesh.radial_elements", "35", "the number of elements along a radius"),
    key("mesh.radial_grading", "1.0", "the size ratio of successive elements outwards (1 = uniform)"),
    key("mesh.element", "\"quad4\"", "the element shape"),
    key("material.young_modulus", "2.5e9", "Young's modulus, Pa"),
    key("material.poisson_ratio", "0.3805", "Poisson's ratio"),
    key("material.density", "1228.0", "the density, kg/m3"),
    key("material.formulation", "\"plane-strain\"", "the out-of-plane assumption"),
    key("damping.mass_coefficient", "40.0", "Rayleigh's alpha, 1/s"),
    key("damping.stiffness_coefficient", "4.5e-7", "Rayleigh's beta, s"),
    key("damping.include_contact", "true", "whether beta acts on contact and friction terms as well as on the body"),
    key("contact.friction_coefficient", "0.3", "Coulomb's friction coefficient"),
    key("contact.interference", "25e-6", "the radial expansion of the cylinder, m"),
    key("contact.rotation_speed_rpm", "610.0", "the rotation speed of the cylinder, revolutions per minute"),
    key("contact.normal_stiffness", "7.4e12", "the normal contact stiffness of the eigenvalue analysis, Pa/m (left out or \"rigid\" = rigid)"),
    key("contact.normal_damping", "0.0", "a normal dashpot on the contact, Pa s/m"),
    key("contact.tangential_damping", "0.0", "a tangential dashpot on the contact, Pa s/m"),
    key("cea.friction_coefficients", "{ from = 0.0, to = 1.0, count = 51 }", "the friction coefficients of the sweep"),
    key("cea.max_frequency_hz", "17500.0", "the frequency below which all modes are found, Hz"),
    key("cea.modes", "28", "how many of the lowest modes are found"),
    key("cea.method", "\"auto\"", "the eigenvalue solver"),
    key("cea.mass", "\"consistent\"", "the mass matrix"),
    key("cea.geometric_stiffness", "true", "whether the prestress enters the tangent stiffness"),
    key("cea.shapes_at", "[0.3]", "friction coefficients whose mode shapes are written"),
    key("cea.map.key", "\"contact.normal_stiffness\"", "the second parameter of the stability map"),
    key("cea.map.values", "{ from = 1e12, to = 1e14, count = 21, spacing = \"log\" }", "its values"),
    key("transient.duration", "0.05", "the simulated time, s"),
    key("transient.time_step", "\"auto\"", "the time step, s, or \"auto\""),
    key("transient.expansion_time", "5e-4", "the time over which the cylinder expands, s"),
    key("transient.initial", "\"rest\"", "the initial state"),
    key("transient.limit_cycle_onset", "1", "the onset of that harmonic, by rising friction, at which the limit cycle is born"),
    key("transient.limit_cycle_harmonic", "2", "the harmonic of the limit cycle that `initial` names"),
    key("transient.operator", "\"auto\"", "how the stiffness is applied"),
    key("transient.perturbation.harmonics", "[2]", "the circumferential harmonics of the initial velocity"),
    key("transient.perturbation.velocity", "1e-3", "the initial velocity amplitude of each harmonic, m/s"),
    key("output.probes", "[1621, 1641]", "the ids (from 1) of the nodes whose motion is written"),
    key("output.sample_interval", "2e-6", "the time between two samples, s"),
    key("output.snapshots", "[0.005, 0.03]", "the times of the field snapshots, s"),
    key("output.checkpoint_interval", "600", "the wall time between two checkpoints, s"),
    key("sweep.combine", "\"grid\"", "how several swept keys combine"),
    key("sweep.analyses", "[\"transient\"]", "what runs at each point"),
    key("cycle.harmonics", "[1, 2]", "the harmonics whose limit cycle is sought"),
    key("cycle.onsets", "\"lowest\"", "the losses of stability of each harmonic whose limit cycles are sought (left out = all below the friction)"),
    key("cycle.phases", "171", "the number of phases along the wave (left out = as the mesh asks for)"),
    key("cycle.frames", "24", "the times over one period at which the whole field is written"),
    key("cycle.confirmation_periods", "20", "the periods of the transient that puts each cycle to the test (0 = none)"),
    key("cycle.stability", "\"point\"", "the cycles whose stability is worked out"),
    key("cycle.continuation.key", "\"contact.rotation_speed_rpm\"", "the parameter along which a cycle is followed"),
    key("cycle.continuation.from", "10", "its first value"),
    key("cycle.continuation.to", "6000", "its last value"),
    key("cycle.continuation.count", "61", "how many values from first to last are reported"),
    key("cycle.continuation.spacing", "\"log\"", "how they are spaced"),
    key("frf.boundary", "\"free\"", "how the disc is held while it is excited"),
    key("frf.force_node", "36", "the id (from 1) of the node that is struck"),
    key("frf.force_direction", "\"radial\"", "the direction of the force"),
    key("frf.response_node", "36", "the id (from 1) of the node observed (left out = force_node)"),
    key("frf.response_direction", "\"radial\"", "the direction observed"),
    key("frf.frequencies_hz", "{ from = 1.0, to = 10000.0, count = 10000 }", "the frequencies of the response, Hz"),
    key("frf.quantity", "\"accelerance\"", "what is observed for each unit of force"),
    key("frf.method", "\"auto\"", "how the response is computed"),
    key("frf.mass", "\"consistent\"", "the mass matrix"),
    key("frf.noise", "0.01", "Gaussian noise added to real and imaginary part, relative to the magnitude"),
    key("frf.noise_seed", "1", "the seed of that noise"),
    key("convergence.factors", "[1, 1.5, 2.25]", "the refinements of the mesh, applied to both element counts"),
    key("convergence.time_step_factors", "[1, 0.5, 0.25]", "the factors on the transient's time step, on the case's own mesh"),
    key("convergence.analyses", "[\"cea\", \"transient\"]", "what is studied (left out = every analysis the case has)"),
];

/// The entry of a dotted key.
pub fn find(name: &str) -> Option<&'static CaseKey> {
    KEYS.iter().find(|key| key.name == name)
}

/// What to write for a key: meaning and example.
pub fn usage(name: &str) -> Option<String> {
    let key = find(name)?;
    let short = key.name.rsplit('.').next().unwrap_or(key.name);
    Some(format!(
        "`{name}` is {}, for example `{short} = {}`",
        key.meaning, key.example
    ))
}

/// The candidate nearest to `word`, if it is near enough to be a slip of the keyboard.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .map(|candidate| (strsim::damerau_levenshtein(word, candidate), candidate))
        .filter(|(distance, candidate)| 3 * distance <= word.len().max(candidate.len()) + 2)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// A hint for a key that does not exist: a near miss in its section, the same key of another
/// section, or the keys there are.
pub fn suggest(section: &str, word: &str, known: &[&str]) -> Option<String> {
    // A word that begins one key alone is short for it.
    let mut begun = known
        .iter()
        .filter(|key| word.len() > 2 && key.starts_with(word));
    let abbreviated = begun.next().filter(|_| begun.next().is_none());
    if let Some(near) = nearest(word, known.iter().copied()).or(abbreviated.copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    let elsewhere = |near: &str| {
        let (home, short) = near.rsplit_once('.').unwrap_or(("", near));
        format!("did you mean `{short}` of [{home}]?")
    };
    let same = |key: &&CaseKey| key.name.rsplit('.').next() == Some(word);
    if let Some(found) = KEYS.iter().find(same) {
        return Some(elsewhere(found.name));
    }
    let full = format!("{section}.{word}");
    if let Some(near) = nearest(&full, KEYS.iter().map(|key| key.name)) {
        return Some(elsewhere(near));
    }
    let mut listed = known.to_vec();
    listed.sort_unstable();
    Some(if section.is_empty() {
        format!("sections and keys here: {}", listed.join(", "))
    } else {
        format!("keys of [{section}]: {}", listed.join(", "))
    })
}
