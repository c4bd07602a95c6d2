//! Assemblies of solid bodies: `[motion.*]`, `[contacts.*]`, `[ties.*]`.

use super::contacts::{NamedContact, contact, short_form, unit};
use super::imported::{FileParts, Made, near_name};
use super::{Contact, description::Description, value::quote};
use crate::*;
use frictionsim_physics::prestress::{Assembly, PrestressError, TiedSurfaces};

/// Solid bodies of a mesh file that are tied together and slide on each other.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyBody {
    /// The mesh of all bodies.
    pub mesh: Arc<Mesh>,
    /// Surfaces that are glued.
    pub ties: Vec<TiedSurfaces>,
    /// Surfaces that slide on each other.
    pub contacts: Vec<SlidingSurfaces>,
    /// Regions that turn.
    pub motions: Vec<Motion>,
    /// What the base state of the contacts is.
    pub base: BaseChoice,
    /// The body of revolution that this is the whole mesh of, if it was generated.
    pub made_of: Option<Box<SolidSpecification>>,
}

impl AssemblyBody {
    /// The bodies of some materials with their surfaces paired: at nodes where the mass is lumped.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] names the tie or contact whose surfaces do not meet.
    pub fn assembled<'a>(
        &'a self,
        materials: &'a dyn MaterialField,
        mass: MassKind,
    ) -> Result<Assembly<'a>, PrestressError> {
        let surfaces = (&self.ties[..], &self.contacts[..]);
        Assembly::new(&self.mesh, materials, surfaces, (&self.motions, self.base), mass)
    }

    /// Regions whose rotation has its inertia.
    pub fn rotors(&self) -> impl Iterator<Item = &str> {
        let turning = self.motions.iter().filter(|motion| motion.inertia.is_some());
        let regions = turning.flat_map(|motion| &motion.regions);
        regions.map(|&region| self.mesh.regions[region].as_str())
    }

    /// Nodes of the bodies that pass through their mesh: they turn, with their inertia in the frame at rest.
    pub fn passing_nodes(&self) -> BTreeSet<u32> {
        let (rest, mesh) = (Some(RotationFrame::Rest), &self.mesh);
        let all =
            self.motions.iter().filter(|own| own.inertia == rest && own.rotation_speed != 0.0);
        let regions: Vec<usize> = all.flat_map(|own| own.regions.iter().copied()).collect();
        let elements = (0..mesh.element_count()).filter(|&e| regions.contains(&mesh.region(e)));
        elements.flat_map(|e| mesh.element_nodes(e)).copied().collect()
    }

    /// Whether motions are those in a frame that turns with the bodies.
    pub fn turns_with_its_frame(&self) -> bool {
        let turning = Some(RotationFrame::Turning);
        self.motions.iter().any(|motion| motion.inertia == turning)
    }

    /// The rigid counterface of the first contact, if it has one.
    pub fn rigid_counterface(&self) -> Option<&RigidCounterface> {
        self.contacts.first()?.counter.rigid()
    }

    /// A point of the axis of what turns first, and its direction; none where nothing turns.
    pub fn axis(&self) -> Option<[[f64; 3]; 2]> {
        self.motions.first().map(|motion| [motion.center, motion.axis]).or_else(|| {
            let rigid = self.rigid_counterface()?;
            matches!(rigid.motion, RigidMotion::Turning(_)).then_some([rigid.center, rigid.axis])
        })
    }
}

/// `[motion.*]`, `[contacts.*]` and `[ties.*]` as the case names regions and surfaces.
pub(super) struct AssemblyParts {
    motions: Vec<(String, Motion)>,
    contacts: Vec<NamedContact>,
    ties: Vec<(String, [String; 2])>,
    pub base: BaseChoice,
}

impl AssemblyParts {
    /// Direction and a point of the axis of what turns, bodies and rigid counterfaces, where all have the same; none
    /// where nothing turns.
    pub(super) fn axis(&self) -> Option<Result<[[f64; 3]; 2], &'static str>> {
        let rigid = self.contacts.iter().filter_map(|contact| contact.surfaces.counter.rigid());
        let turning = rigid.filter(|rigid| matches!(rigid.motion, RigidMotion::Turning(_)));
        let motions = self.motions.iter().map(|(_, motion)| [motion.axis, motion.center]);
        let mut axes = motions.chain(turning.map(|rigid| [rigid.axis, rigid.center]));
        let first = axes.next()?;
        Some(if axes.any(|own| own != first) { Err("what turns has several") } else { Ok(first) })
    }
}

/// Reads the sections of an assembly; its first contact and motion, by name, give the common contact of the case: a
/// sweep varies the friction coefficient of the first contact, and the others keep their ratio to it.
pub(super) fn sections(own: &Description<'_>) -> (AssemblyParts, Contact) {
    let (root, tables) = (own.root, &own.tables);
    let motions = root.each("motion", motion);
    let ties = root.each("ties", |section| ["surface", "counter"].map(|key| section.text(key)));
    let mut contacts = Vec::new();
    for (name, mut own) in root.each("contacts", |section| contact(section, tables)) {
        own.surfaces.name = name;
        contacts.push(own);
    }
    if root.has("contact") && !root.has("contacts") {
        let short = |section: &Section<'_>| short_form(section, own.is_pressed());
        contacts.push(root.section("contact", true).closed(short));
    }
    let first = contacts.first();
    let base = first.map_or_else(BaseChoice::default, |contact| contact.base);
    refuse_if!(contacts.iter().any(|other| other.base != base); root, "contacts",
        "contacts are \"solved\" and \"closed\" in one case: one that is free of stress and one \
         that is not have no common equilibrium"; "one state for all";
        "give every contact the same `state`");
    let rigid = first.and_then(|contact| contact.surfaces.counter.rigid());
    let speed = rigid.map(|rigid| rigid.motion.speed()).filter(|speed| *speed != 0.0);
    let turning = || motions.first().map_or(0.0, |motion| motion.1.rotation_speed);
    let common = Contact {
        sliding: SlidingContact {
            friction_coefficient: first.map_or(0.0, |contact| contact.friction_coefficient),
            decay: first.and_then(|contact| contact.surfaces.friction.decay),
            interference: rigid.map_or(0.0, |rigid| rigid.interference),
            // Where the counterface is at rest, the body slides under it.
            rotation_speed: speed.unwrap_or_else(turning),
        },
        stiffness: first.map(|contact| contact.surfaces.stiffness).unwrap_or_default(),
    };
    (AssemblyParts { motions, contacts, ties, base }, common)
}

pub(super) fn motion(section: &Section<'_>) -> Motion {
    section.needs("axis");
    let (frame, has_inertia) = (section.choice("frame"), section.flag("rotation_terms"));
    refuse_if!(!has_inertia && section.has("frame"); section, "frame" =>
        "has no effect without the inertia of rotation"; "needs rotation_terms = true";
        "give rotation_terms = true, or leave frame out");
    Motion {
        regions: Vec::new(),
        axis: unit(section, "axis"),
        center: section.vector("center"),
        rotation_speed: section.number("rotation_speed_rpm") * TAU / 60.0,
        // In which frame it counts.
        inertia: has_inertia.then_some(frame),
    }
}

/// The solid bodies of a mesh file.
pub(super) fn assemble(file: &FileParts<'_>, parts: AssemblyParts) -> Made {
    let own = file.own;
    let (read, _) = file.shaped("")?;
    let mesh = Mesh::from_solids(&read, own.scale, &own.conditions);
    let mesh = mesh.map_err(|error| own.unusable(error))?;
    let find = |known: &[String], what: &str, name: &str, key: &str| {
        known.iter().position(|other| other == name).ok_or_else(|| {
            let list: Vec<String> = known.iter().map(|name| format!("\"{name}\"")).collect();
            let list = if known.is_empty() { "none".to_owned() } else { list.join(", ") };
            let near = near_name(name, known);
            let message =
                format!("{key}: the mesh file has no {what} \"{name}\"; it has {list}{near}");
            let is_text = own.raw.find(key).is_some_and(|own| own.value.text().is_some());
            let error = own.error(key, message, "names none of its parts");
            (is_text || !name.is_empty()).then_some(error)
        })
    };
    let region = |name: &str, key: &str| find(&mesh.regions, "region (physical volume)", name, key);
    let boundaries: Vec<String> = mesh.boundaries.iter().map(|b| b.name.clone()).collect();
    let surface = |name: &str, key: &str| find(&boundaries, "surface", name, key);
    let of_material = |name: &str| region(name, &format!("materials.{name}"));
    let mut materials = file.materials_of(&mesh.regions, of_material)?;
    for material in &mut materials {
        material.elastic.formulation = PlaneFormulation::ThreeDimensional;
    }
    let mut motions = Vec::new();
    for (name, motion) in parts.motions {
        motions.push(Motion { regions: vec![region(&name, &format!("motion.{name}"))?], ..motion });
    }
    let mut ties = Vec::new();
    for (name, [side, counter]) in parts.ties {
        ties.push(TiedSurfaces {
            surface: surface(&side, &format!("ties.{name}.surface"))?,
            counter: surface(&counter, &format!("ties.{name}.counter"))?,
            name,
        });
    }
    let first = parts.contacts.first();
    let first = first.map(|first| (first.surfaces.name.clone(), first.friction_coefficient));
    let mut contacts = Vec::new();
    for NamedContact {
        sides: [side, counter],
        keys: [side_key, counter_key],
        friction_coefficient,
        mut surfaces,
        ..
    } in parts.contacts
    {
        surfaces.surface = surface(&side.unwrap_or_default(), &side_key)?;
        if let (Some(counter), None) = (counter, surfaces.counter.rigid()) {
            surfaces.counter = Counterpart::Surface(surface(&counter, &counter_key)?);
        }
        // That of the first one is varied.
        if let Some((first, reference)) = &first {
            let name = quote(&surfaces.name);
            if *reference > 0.0 {
                surfaces.friction.ratio = friction_coefficient / reference;
            } else if friction_coefficient > 0.0 {
                let key = format!("contacts.{}.friction_coefficient", quote(first));
                let why = format!(
                    "{key} = 0 beside {friction_coefficient} of contacts.{name}: friction is varied \
                     with that of the first contact by name, and others keep their ratio"
                );
                return Err(Some(own.error(&key, why, "no ratio to it")));
            }
        }
        contacts.push(surfaces);
    }
    let (mesh, base, made_of) = (Arc::new(mesh), parts.base, None);
    let kind = BodyKind::Assembly(AssemblyBody { mesh, ties, contacts, motions, base, made_of });
    Ok(Body { materials, kind })
}

impl Case {
    /// The body on its whole mesh with what ties its parts and what slides: of solid bodies at nodes where the mass is
    /// lumped.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] names the tie or contact whose surfaces do not meet.
    pub fn assembled<'a>(
        &'a self,
        mesh: &'a Mesh,
        mass: MassKind,
    ) -> Result<Assembly<'a>, PrestressError> {
        let Contact { sliding, stiffness } = &self.contact;
        match self.body.assembly() {
            Some(body) => body.assembled(self.materials(), mass),
            None => Assembly::of_edge(mesh, self.materials(), sliding, *stiffness),
        }
    }

    /// A key of the first contact, by its full name.
    pub fn contact_key(&self, key: &str) -> String {
        let first = self.contact_sections().into_iter().next();
        format!("{}.{key}", first.map_or_else(|| "contact".to_owned(), |own| own.0))
    }

    /// The key that says how fast the first contact slides; the section of all motions where nothing moves.
    pub fn speed_key(&self) -> String {
        if let Some(body) = self.body.assembly()
            && body.rigid_counterface().is_none()
        {
            let turning = body.motions.first().and_then(|motion| motion.regions.first());
            let key = |&region: &usize| {
                format!("motion.{}.rotation_speed_rpm", quote(&body.mesh.regions[region]))
            };
            return turning.map_or_else(|| "motion".to_owned(), key);
        }
        let straight = self.contact_key("speed");
        match self.number(&straight) {
            Some(_) => straight,
            None => self.contact_key("rotation_speed_rpm"),
        }
    }
}
