//! Frequency response of a case between two of its nodes.
//!
//! ```no_run
//! use frictionsim::case::Case;
//! use frictionsim::study::response::FrequencyStudy;
//!
//! let bytes = std::fs::read("cases/hammer-test.toml")?;
//! let case = Case::parse("hammer", &bytes, &[])?;
//! let response = FrequencyStudy::new(&case)?.solve(&|_| {})?;
//! println!("{}: {:?} m/N", response.summary.description, response.receptance().first());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::eigenvalues::{WholeMesh, wave_tangent};
use super::tangent_options;
use crate::*;
use frictionsim_case::{Frf, FrfMethod};
use frictionsim_physics::frf::{
    Axis, CyclicSystem, FrfBoundary, FrfError, FrfSystem, Port, Terminal, cyclic_response,
    direct_response, reduced_response,
};
use frictionsim_physics::{linalg::GaussianNoise, mesh::BoundaryCondition};
use frictionsim_results::{ResponseSummary, plural};

/// Hears how many frequencies are solved, a few at a time, from any thread; cyclic method and reduction are silent.
pub type Progress<'a> = dyn Fn(usize) + Sync + 'a;

/// The system that a case excites, ready to be solved.
#[derive(Clone, Debug)]
pub struct FrequencyStudy<'a> {
    case: &'a Case,
    frf: &'a Frf,
    system: System,
}

#[derive(Clone, Debug)]
enum System {
    /// Harmonic by harmonic.
    Cyclic(Box<CyclicSystem>),
    /// The whole mesh, with the ports of force and response: every line is solved (`direct`), or the mesh is projected
    /// on a small space where that reaches its tolerance (`auto`) or fails (`reduced`).
    Whole { system: Box<FrfSystem>, ports: Box<[Port; 2]>, method: FrfMethod },
}

/// A computed response and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// What there is to say of it.
    pub summary: ResponseSummary,
    /// As solved: of a plane body for each metre of thickness.
    solved: Vec<c64>,
    /// What to divide that by: the thickness of a plane body, 1 in three dimensions.
    thickness: f64,
}

impl<'a> FrequencyStudy<'a> {
    /// Builds the system of `[frf]`, with its base state where the contact slides.
    ///
    /// # Errors
    /// A case without `[frf]`, a node that does not exist or is held, a method that the body does not allow, each with
    /// its key; a mesh that cannot be built; no state of sliding.
    pub fn new(case: &'a Case) -> Result<Self, StudyError> {
        let frf = case.require_frf()?;
        let is_lossy = case.has_structural_damping();
        refuse_beyond_tables(case, frf)?;
        let system = match frf.method {
            FrfMethod::Reduced if is_lossy => {
                let refusal = case.loss_error(
                    "frf.method = \"reduced\" projects on real spaces of viscous damping, which \
                    structural damping is not",
                    "not in a reduced model",
                    "use frf.method = \"direct\"",
                );
                return Err(refusal.into());
            }
            FrfMethod::Auto if case.responds_by_harmonics(frf) => cyclic(case, frf)?,
            FrfMethod::Cyclic if case.body.has_sectors() && !case.responds_by_harmonics(frf) => {
                // Without contact a disc and its shaft are two bodies.
                return Err(StudyError::Case(refusal!(case, "frf.method",
                    "frf.method = \"cyclic\" takes one body, and without contact disc and shaft are two";
                    "disc and shaft do not touch here";
                    "use \"auto\", \"direct\" or \"reduced\"")));
            }
            FrfMethod::Cyclic => cyclic(case, frf)?,
            FrfMethod::Auto if is_lossy => whole(case, frf, FrfMethod::Direct)?,
            method => whole(case, frf, method)?,
        };
        Ok(Self { case, frf, system })
    }

    /// Solves at all frequencies.
    ///
    /// # Errors
    /// [`StudyError::Response`] at an undamped resonance, or where a reduction misses its tolerance.
    pub fn solve(&self, done: &Progress<'_>) -> Result<Response, StudyError> {
        let (frf, lines) = (self.frf, &self.frf.frequencies_hz);
        let mut found = ResponseSummary {
            lines: lines.len(),
            quantity: frf.quantity.name().to_owned(),
            noise: frf.noise,
            ..ResponseSummary::default()
        };
        let (method, solved) = match &self.system {
            System::Cyclic(system) => {
                let solved = cyclic_response(system, frf.force, frf.response, lines)?;
                found.dofs = system.dimension();
                found.backward_error = Some(solved.backward_error);
                ("cyclic", solved.receptance)
            }
            System::Whole { system, ports, method } => {
                let [force, response] = &**ports;
                let reduced = (*method != FrfMethod::Direct)
                    .then(|| reduced_response(system, force, response, lines));
                found.dofs = system.dimension();
                let reduced = match reduced {
                    // A reduction that misses its tolerance is no answer; each line for itself is.
                    Some(Err(FrfError::NotReduced { .. })) if *method == FrfMethod::Auto => None,
                    other => other.transpose()?,
                };
                match reduced {
                    Some(solved) => {
                        found.largest_error = Some(solved.largest_error);
                        found.basis_vectors = Some(solved.vectors);
                        ("reduced", solved.receptance)
                    }
                    None => ("direct", direct_response(system, force, response, lines, done)?),
                }
            }
        };
        found.method = method.to_owned();
        found.description = described(self.case, frf, &found);
        if solved.iter().all(|own| *own == c64::ZERO) {
            found.description += "; it is zero, as nothing joins the two nodes";
        }
        let mut all = Response { summary: found, solved, thickness: self.case.depth() };
        let sizes = all.observed(frf).into_iter().map(|own| own.norm());
        let peak = sizes.zip(lines).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((size, at)) = peak.filter(|own| own.0 > 0.0) {
            all.summary.peak = BTreeMap::from([(all.summary.quantity.clone(), size)]);
            all.summary.peak_frequency_hz = Some(*at);
        }
        Ok(all)
    }
}

/// What was computed, in a sentence.
fn described(case: &Case, frf: &Frf, found: &ResponseSummary) -> String {
    let place =
        |t: Terminal| format!("node {} {}", case.body.node_label(t.node), t.direction.name());
    let error = match (found.largest_error, found.basis_vectors, found.backward_error) {
        (Some(error), Some(vectors), _) => {
            format!(" ({vectors} vectors, largest relative error at the check lines {error:.1e})")
        }
        (_, _, Some(error)) => format!(" (largest backward error {error:.1e})"),
        _ => String::new(),
    };
    let ResponseSummary { quantity, lines, dofs, method, .. } = found;
    let [from, to] = [frf.force, frf.response].map(place);
    let lines = plural(*lines, ["line", "lines"]);
    format!("{quantity} from {from} to {to}: {lines}, {dofs} unknowns, {method}{error}")
}

impl Response {
    /// Displacement for each unit of force at each frequency, of the body's true thickness, m/N.
    pub fn receptance(&self) -> Vec<c64> {
        self.solved.iter().map(|h| h / self.thickness).collect()
    }

    /// The quantity that `[frf]` asks for, `h (i omega)^d`, with its noise.
    pub fn observed(&self, frf: &Frf) -> Vec<c64> {
        let mut noise = GaussianNoise::new(frf.noise_seed as u64);
        let observed = frf.frequencies_hz.iter().zip(&self.solved).map(|(f, h)| {
            let rate = c64::new(0.0, TAU * f).powi(frf.quantity.derivatives());
            let value = h * rate / self.thickness;
            value + noise.draw() * (frf.noise * value.norm())
        });
        observed.collect()
    }
}

/// Refuses lines that a table of moduli does not hold.
fn refuse_beyond_tables(case: &Case, frf: &Frf) -> Result<(), CaseErrors> {
    for table in case.body.tables() {
        let mut lines = frf.frequencies_hz.iter();
        if let Some(line) = lines.find(|line| !table.covers(**line)) {
            let ([low, high], key, file) = (table.range_hz(), &table.key, &table.file);
            return Err(refusal!(case, key,
                "{key} = \"{file}\" holds {low} to {high} Hz, and frf asks for {line} Hz: a \
                 modulus beyond a table is not guessed";
                "does not cover the lines"; "extend the table, or ask for lines within it"));
        }
    }
    Ok(())
}

/// The harmonics of an annulus, or of a body of revolution in three dimensions.
fn cyclic(case: &Case, frf: &Frf) -> Result<System, StudyError> {
    let system = match (&case.body.kind, frf.boundary) {
        (BodyKind::Imported(_) | BodyKind::Assembly(_), _) => {
            return Err(StudyError::Case(refusal!(case, "frf.method",
                "frf.method = \"cyclic\" needs the symmetry of the built-in annulus";
                "an imported mesh has no sectors"; "use \"auto\", \"direct\" or \"reduced\"")));
        }
        (_, FrfBoundary::Sliding) => {
            refuse_rest(case)?;
            let waves = wave_tangent(case, &tangent_options(case, frf.mass))?;
            let waves = waves.expect("a body of equal sectors");
            CyclicSystem::sliding(&waves, case.contact.sliding.friction_coefficient)
        }
        (BodyKind::Annulus(own), _) => apart(case, frf, &Strip::of_annulus(own)?),
        (BodyKind::Revolution(own), _) => apart(case, frf, &SolidSector::generate(own)?.strip),
    };
    for (terminal, key) in [(frf.force, "force_node"), (frf.response, "response_node")] {
        system.check(terminal, key).map_err(|error| at_node(case, &error))?;
    }
    Ok(System::Cyclic(Box::new(system)))
}

/// The harmonics of a body of equal sectors that touches nothing.
fn apart(case: &Case, frf: &Frf, strip: &Strip) -> CyclicSystem {
    let (materials, is_held) = (case.materials(), frf.boundary == FrfBoundary::Clamped);
    let waves = WaveTangent::of_free(strip, materials, frf.mass, case.damping.rayleigh, is_held);
    CyclicSystem::sliding(&waves, 0.0)
}

/// Matrices of the whole mesh as it is held, and the ports of force and response.
fn whole(case: &Case, frf: &Frf, method: FrfMethod) -> Result<System, StudyError> {
    if case.body.revolution().is_some() {
        let name = if method == FrfMethod::Direct { "direct" } else { "reduced" };
        return Err(StudyError::Case(refusal!(case, "frf.method",
            "frf.method = \"{name}\" is for bodies that are solved on their whole mesh";
            "a body of revolution is solved harmonic by harmonic";
            "use \"auto\" or \"cyclic\", or take the whole mesh: cea.method = \"sparse\"")));
    }
    let (system, mesh) = held(case, frf)?;
    let axis = case.body.assembly().and_then(AssemblyBody::axis);
    let axis = axis.map(|[center, direction]| Axis { center, direction });
    let port = |terminal, key| {
        system.port(&mesh, axis, terminal, key).map_err(|error| at_node(case, &error))
    };
    let ports = [port(frf.force, "force_node")?, port(frf.response, "response_node")?];
    Ok(System::Whole { system: Box::new(system), ports: Box::new(ports), method })
}

/// A body as it is held, with its mesh: sliding, or its parts as they are tied, without their contacts.
fn held(case: &Case, frf: &Frf) -> Result<(FrfSystem, Arc<Mesh>), StudyError> {
    let options = tangent_options(case, frf.mass);
    if frf.boundary == FrfBoundary::Sliding {
        refuse_rest(case)?;
        let whole = WholeMesh::solve(case, options, &[])?;
        let friction = case.contact.sliding.friction_coefficient;
        return Ok((FrfSystem::sliding(&whole.own_tangent(case)?, friction), whole.mesh));
    }
    let Some(body) = case.body.assembly() else {
        let (mesh, is_clamped) = (case.body.mesh()?, frf.boundary == FrfBoundary::Clamped);
        let (materials, rayleigh) = (case.materials(), case.damping.rayleigh);
        return Ok((FrfSystem::body(&mesh, materials, frf.mass, rayleigh, is_clamped), mesh));
    };
    // Without contact there is no base state to find but that of its loads, and nothing may hold the bodies.
    let is_loaded = body.contacts.is_empty() && frf.boundary == FrfBoundary::Clamped;
    let base = if is_loaded { body.base } else { BaseChoice::Closed };
    let mut apart = AssemblyBody { contacts: Vec::new(), base, ..body.clone() };
    if frf.boundary == FrfBoundary::Free {
        let mesh = Arc::make_mut(&mut apart.mesh);
        for boundary in &mut mesh.boundaries {
            boundary.condition = BoundaryCondition::Free;
        }
    }
    let assembly = apart.assembled(case.materials(), frf.mass)?;
    let tangent = assembly.tangent(&assembly.state(0.0)?, &options)?;
    Ok((FrfSystem::sliding(&tangent, 0.0), Arc::clone(&body.mesh)))
}

/// A counterface at rest sticks: there is no steady sliding to respond around.
fn refuse_rest(case: &Case) -> Result<(), CaseErrors> {
    let touches = case.body.assembly().is_none_or(|body| !body.contacts.is_empty());
    if case.contact.sliding.rotation_speed != 0.0 || !touches {
        return Ok(());
    }
    Err(refusal!(case, "frf.boundary",
        "frf.boundary = \"sliding\" at rest: the contact sticks, and there is no steady sliding to respond around";
        "the speed is 0"; "give a speed, however small, or use \"clamped\" or \"free\""))
}

/// What is wrong with a node, at its key.
fn at_node(case: &Case, error: &FrfError) -> CaseErrors {
    let key = format!("frf.{}", error.node_key().unwrap_or("force_node"));
    let label = "cannot be excited or observed here".to_owned();
    case.error_at(&key, error.to_string(), label, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: without contact a force on the disc does not move the shaft. The bound is held at every line, and
    /// the largest response is told with its frequency.
    #[test]
    fn a_reduction_knows_a_zero_and_holds_its_bound_at_every_line() {
        let cases = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/commands/refused/shaft.toml");
        let bytes = std::fs::read(cases).unwrap();
        let solve = |node: usize, method: &str| {
            let frf = format!(
                "frf={{ force_node = 1, response_node = {node}, force_direction = \"radial\", \
                 response_direction = \"radial\", boundary = \"free\", method = \"{method}\", \
                 frequencies_hz = {{ from = 500, to = 20000, count = 40 }} }}"
            );
            let case = Case::parse("shaft", &bytes, &[frf]).unwrap();
            FrequencyStudy::new(&case).unwrap().solve(&|_| {}).unwrap()
        };
        let zero = solve(202, "reduced");
        assert!(zero.solved.iter().all(|own| *own == c64::ZERO));
        assert!(zero.summary.description.contains("it is zero") && zero.summary.peak.is_empty());
        let [reduced, direct] = ["reduced", "direct"].map(|method| solve(200, method));
        for (own, exact) in reduced.solved.iter().zip(&direct.solved) {
            assert!((own - exact).norm() <= 1e-6 * exact.norm(), "{own} {exact}");
        }
        let rate = |f: f64| (TAU * f).powi(2);
        let lines = (1..=40).map(|k| 500.0 * f64::from(k));
        let sizes = lines.zip(&direct.solved).map(|(f, own)| (rate(f) * own.norm(), f));
        let (size, at) = sizes.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        let own = &direct.summary;
        assert_eq!(own.peak_frequency_hz, Some(at));
        assert!((own.peak["accelerance"] * direct.thickness / size - 1.0).abs() < 1e-12, "{own:?}");
    }
}
