//! Case files: TOML to validated SI values.
//!
//! [`RawCase`] is exactly what the TOML says, overrides included; [`Case`] is the same thing
//! validated. Every section is a struct in the terms of the lower floors, and every rule between
//! keys is checked. All errors are reported at once as [`CaseErrors`].

#[macro_use]
mod diagnostic;

mod assembly;
mod attachments;
mod body;
mod boundaries;
mod cea;
mod checks;
mod contact;
mod contacts;
mod convergence;
mod cost;
mod cycle;
mod description;
mod elastic;
mod file_sections;
mod fit;
mod frf;
mod generated;
mod imported;
mod improve;
mod inclusion;
mod keys;
mod model;
mod modifications;
mod node;
mod normal_force;
mod overrides;
mod parameters;
mod prelude;
mod raw;
mod reader;
pub mod reference;
mod relaxed;
mod requirements;
mod shown;
mod solid;
mod starting;
mod suggestion;
mod superelements;
mod sweep;
mod tables;
mod taken;
mod transient;
mod uncertainty;
mod value;
mod whole_revolution;
mod words;

pub use assembly::AssemblyBody;
pub use body::{Body, BodyKind};
pub use cea::Cea;
pub use contact::Contact;
pub use convergence::Convergence;
pub use cost::{CeaCost, Cost, CycleCost, FrfCost, RunCost, StudyCost, TransientCost};
pub use cycle::{Continuation, Cycle};
pub use description::Damping;
pub use diagnostic::{CaseErrors, Diagnostic, Location, Source};
pub use file_sections::FileSection;
pub use fit::{Fit, FitParameter};
pub use frf::Frf;
pub use frictionsim_physics::cea::ModeLimit;
pub use frictionsim_physics::transient::{InitialState, OperatorChoice, Perturbation, TimeStep};
pub use imported::ImportedBody;
pub use improve::Improve;
pub use keys::{Bound, CaseKey, KEYS, Kind, find as find_key};
pub use node::PlacedNode;
pub use overrides::unset;
pub use parameters::VariedKey;
use prelude::*;
pub use raw::{MeshBytes, RawCase, TableBytes, hash_of};
pub use reader::range_values;
pub use shown::{shown, shown_json};
pub use starting::case_from;
pub use suggestion::nearest;
pub use superelements::{FreeSystem, Superelement};
pub use sweep::{Sweep, SweptKey};
pub use taken::Taken;
pub use transient::{Output, Transient};
pub use uncertainty::{UncertainParameter, Uncertainty};
pub use value::{RawItem, RawTable, RawValue};
pub use words::{
    Analysis, CeaMethod, Choice, Combination, FrfMethod, ModificationKind, OnsetChoice, Spacing,
    StabilityChoice, UnitsWord,
};

use frictionsim_physics::fem::{ElasticMaterial, MaterialField, RegionMaterial};
use reader::{Findings, Section};

/// A validated case, in SI units (the rotation speed in rad/s).
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// What it was read from.
    pub raw: RawCase,
    /// A line for tables and figures.
    pub title: String,
    /// Thickness of the disc, m: scales reported forces, torque, power and energy.
    pub thickness: f64,
    /// The body with its mesh and its materials.
    pub body: Body,
    /// The common material, `[material]`: of every region that has none of its own.
    pub material: ElasticMaterial,
    /// The common damping.
    pub damping: Damping,
    /// The cylinder and its contact.
    pub contact: Contact,
    /// Complex eigenvalue analysis, if the case has one.
    pub cea: Option<Cea>,
    /// Explicit transient, if the case has one.
    pub transient: Option<Transient>,
    /// What a transient writes.
    pub output: Output,
    /// Parameter study, if the case has one.
    pub sweep: Option<Sweep>,
    /// Two waves that compete, if the case names them.
    pub basin: Option<frictionsim_physics::cycle::BasinRequest>,
    /// Limit-cycle search, if the case has one.
    pub cycle: Option<Cycle>,
    /// Frequency response, if the case has one.
    pub frf: Option<Frf>,
    /// Convergence study, if the case has one.
    pub convergence: Option<Convergence>,
    /// Parameters to fit, if the case names them.
    pub fit: Option<Fit>,
    /// Parameters that are uncertain, if the case names them.
    pub uncertainty: Option<Uncertainty>,
    /// What is tried against unstable modes.
    pub improve: Improve,
    /// What its materials are in time, where that is another thing: with loss factors and tables over frequency.
    pub relaxed: Option<Vec<RegionMaterial>>,
    /// What it takes from its mesh file beside the mesh.
    pub taken: Taken,
    /// Things that are no errors but that the user should hear of.
    pub warnings: Vec<Diagnostic>,
}

impl Case {
    /// Parses and validates the bytes of a case file under overrides: every error is found.
    pub fn parse(name: &str, bytes: &[u8], overrides: &[String]) -> Result<Self, CaseErrors> {
        Self::from_raw(RawCase::parse(name, bytes, overrides)?)
    }

    /// Validates a parsed case.
    pub fn from_raw(raw: RawCase) -> Result<Self, CaseErrors> {
        let case = Self::read(raw)?;
        sweep::check_values(&case)?;
        Ok(case)
    }

    /// Validates everything but the values that studies give to keys, as those of a case of a study.
    pub fn read(mut raw: RawCase) -> Result<Self, CaseErrors> {
        superelements::refuse_body(&raw)?;
        let (effective, taken) = taken::effective(&mut raw);
        let findings = Findings::of(&effective);
        let root = Section::root(&findings, &effective, raw.end());
        let title = title(&raw, root.optional_text("title").unwrap_or_default());
        let mut described = description::Description::read(&root, &raw);
        let (body, contact) = model::body(&mut described);
        let (material, thickness) = (described.common.elastic, described.thickness);
        let tables = described.tables.read.into_inner();
        let damping = root.section("damping", false).closed(description::damping);
        let own_friction = contact.sliding.friction_coefficient;
        let cea = root.read_section("cea", |own| cea::cea(own, &root, body.as_ref(), own_friction));
        let mut transient = root.read_section("transient", |own| {
            transient::transient(own, body.as_ref(), &contact.sliding)
        });
        let output = root.section("output", false);
        let output = output.closed(|own| transient::output(own, body.as_ref(), transient.as_mut()));
        if transient.is_some() && body.as_ref().is_some_and(|body| !body.suits_transient()) {
            let mesh = root.section("mesh", false);
            caution!(mesh, "element",
                "mesh.element = \"quad8\" is for the complex eigenvalue analysis only: the \
                 transient of this case cannot run"; "no transient");
        }
        let cycle = root.read_section("cycle", |own| cycle::cycle(own, body.as_ref()));
        let basin = root.read_section("basin", |own| cycle::basin(own, body.as_ref()));
        let frf = root.read_section("frf", |own| frf::read(own, body.as_ref()));
        let convergence = root.read_section("convergence", |own| {
            convergence::read(own, &root, body.as_ref(), &contact)
        });
        let fit = root.read_section("fit", fit::fit);
        let uncertainty = root.read_section("uncertainty", uncertainty::uncertainty);
        let improve = root.section("improve", false).closed(improve::improve);
        let sweep = sweep::read(&root);
        // Sections of other cases, which a word may mean, and of a mesh that cannot be read.
        let is_unread = root.has("mesh") && !root.section("mesh", false).is_given();
        let of_mesh = ["contacts", "ties", "motion"].into_iter().filter(|_| is_unread);
        of_mesh.chain(["superelements"]).for_each(|own| _ = root.section(own, false));
        root.close();
        let (mut errors, mut warnings) = findings.into_parts();
        taken.name_places(&mut errors);
        if taken.is_unread {
            // What cannot be read comes first: others follow from it, and it may hold the materials.
            errors.retain(|error| !error.message.starts_with("missing key `material"));
            errors.sort_by_key(|error| error.at != raw.place("mesh.file"));
        }
        let at_file = raw.place("mesh.file");
        if let Some(lack) = taken.lack(&at_file) {
            errors.insert(0, lack);
        }
        warnings.extend(taken.warning(&at_file));
        raw.tables = tables;
        let Some(body) = body.filter(|_| errors.is_empty()) else { return Err(raw.errors(errors)) };
        let mut case = Self {
            title,
            thickness,
            body,
            material,
            damping,
            contact,
            cea,
            transient,
            output,
            sweep,
            cycle,
            basin,
            frf,
            convergence,
            fit,
            uncertainty,
            improve,
            taken,
            warnings,
            relaxed: None,
            raw,
        };
        case.relaxed = relaxed::relaxed(&case);
        let errors = checks::infeasible(&case);
        if errors.is_empty() {
            normal_force::press(&mut case)?;
        }
        let implausible = checks::implausible(&case);
        if !errors.is_empty() {
            // A slip of units comes first: what cannot run is mostly its consequence.
            return Err(case.raw.errors([implausible, errors].concat()));
        }
        case.warnings.extend(implausible);
        Ok(case)
    }

    /// The warnings of the case and those of a command, as errors.
    pub fn deny_warnings(&self, further: &[Diagnostic]) -> Result<(), CaseErrors> {
        let all = [self.warnings.as_slice(), further].concat();
        if all.is_empty() { Ok(()) } else { Err(self.raw.errors(all)) }
    }

    /// Whether the response is solved harmonic by harmonic where nothing else is asked for: of equal sectors, but not
    /// of disc and shaft apart, which are two bodies.
    pub fn responds_by_harmonics(&self, frf: &Frf) -> bool {
        let has_shaft = self.body.grid().is_some_and(|grid| grid.shaft.is_some());
        let is_apart = frf.boundary != frictionsim_physics::frf::FrfBoundary::Sliding;
        self.body.has_sectors() && !(has_shaft && is_apart)
    }

    /// The material of each region of the mesh.
    pub fn materials(&self) -> &dyn MaterialField {
        &self.body.materials
    }

    /// What forces, powers and energies of the mesh are multiplied by, m: the thickness of a plane body.
    /// Those of a body in three dimensions are of the whole, and this is 1.
    pub fn depth(&self) -> f64 {
        if self.body.dimension() == 2 { self.thickness } else { 1.0 }
    }

    /// Whether a material, a support or a contact has structural damping.
    pub fn has_structural_damping(&self) -> bool {
        self.body.has_structural_damping() || self.has_lossy_contacts()
    }

    fn has_lossy_contacts(&self) -> bool {
        self.contact_sections().iter().any(|(_, own)| own.loss_factor != 0.0)
    }

    /// An error at a dotted key: at its value where the case gives one, else at its section.
    pub fn error_at(
        &self,
        key: &str,
        message: impl Into<String>,
        label: impl Into<String>,
        help: Option<String>,
    ) -> CaseErrors {
        let help = help.or_else(|| suggestion::usage(key));
        self.raw.errors(vec![Diagnostic::error(message, label, self.raw.place(key), help)])
    }
}

/// The title, with the overrides beside it: a title may name what an override changes.
fn title(raw: &RawCase, title: String) -> String {
    const MOST: usize = 3;
    if title.is_empty() || raw.overrides.is_empty() {
        return title;
    }
    let (all, more) = (&raw.overrides, raw.overrides.len().saturating_sub(MOST));
    let shown = all.iter().take(MOST).map(|text| overrides::shown(text));
    let more = Some(format!("{more} more")).filter(|_| more > 0);
    format!("{title}  [with {}]", shown.chain(more).collect::<Vec<_>>().join(", "))
}
