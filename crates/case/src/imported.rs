//! Bodies from mesh files: `mesh.file`, `[materials.*]`, and where the counterface is.

use super::description::{Description, has_common_constants};
use super::modifications::{Misfit, reshaped};
use super::{MeshBytes, elastic, inclusion, suggestion, value::quote, words::CounterfaceWord};
use crate::*;
use frictionsim_physics::contact::ContactInterface;
use frictionsim_physics::mesh::{BodyPart, CyclicSymmetry, refined_file, repeated_file};

/// Names that a message lists.
const MOST_NAMES: usize = 10;

/// A body that a mesh file describes.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedBody {
    /// Its mesh with boundaries and what holds them.
    pub mesh: Arc<Mesh>,
    /// What the mesh was made of, for its refinements.
    source: Arc<(Arc<FileMesh>, BodySpecification)>,
}

/// Reads the keys of `[contact]` that only an imported body has: its curves with the counterface, and the speed of a
/// plane, m/s.
pub(super) fn contact_place(section: &Section<'_>) -> (BodySpecification, Option<f64>) {
    let contact = section.text("boundary");
    let (center, radius) = (section.vector("center"), section.optional_number("radius"));
    let direction = section.vector("direction");
    let speed = section.optional_number("speed");
    let word: CounterfaceWord = section.choice("counterface");
    // Only two bodies have it.
    let (key, opposite) = ("counter_boundary", section.optional_text("counter_boundary"));
    let are_two = word == CounterfaceWord::Body;
    refuse_if!(are_two && opposite.is_none(); section, key,
        "contact.counterface = \"body\" needs contact.counter_boundary";
        "the curve of the other body"; "name the physical curve of the other body");
    refuse_if!(!are_two && opposite.is_some(); section, key,
        "contact.counter_boundary is for two bodies"; "the curve of the other body";
        "set contact.counterface = \"body\", or leave it out");
    let opposite = opposite.filter(|_| are_two);
    refuse_if!(word == CounterfaceWord::Sphere; section, "counterface",
        "contact.counterface = \"sphere\" is for a mesh of solid elements"; "the body is plane";
        "leave it out for a round contact curve; of a straight one give \"plane\" with `speed`");
    let (counterface, plane_speed) = match word {
        CounterfaceWord::Body if speed.is_some() => {
            let along = section.has("direction").then_some(direction);
            (CounterfaceSpecification::Plane { direction: along }, speed)
        }
        CounterfaceWord::Cylinder | CounterfaceWord::Sphere | CounterfaceWord::Body => {
            (CounterfaceSpecification::Cylinder { center, radius }, None)
        }
        CounterfaceWord::Plane => {
            refuse_if!(direction == [0.0; 2]; section, "direction",
                "contact.direction = [0, 0] has no direction"; "must not be zero");
            // Without a direction of its own it lies along the contact curve.
            let direction = Some(direction).filter(|along| *along != [0.0; 2]);
            let plane = CounterfaceSpecification::Plane { direction };
            (plane, Some(speed.unwrap_or_else(|| section.number("speed"))))
        }
    };
    refuse_each!(section, "axis"; key, "contact.axis is for a mesh of solid elements";
        "a plane body turns about z"; "leave it out");
    let is_plane = plane_speed.is_some();
    let idle = if is_plane { "center radius rotation_speed_rpm" } else { "direction speed" };
    for key in section.refused(idle) {
        caution!(section, key => "is not used: the counterface is a {}",
            if is_plane { "plane" } else { "cylinder" }; "no effect");
    }
    let place =
        BodySpecification { scale: 1.0, contact, counterface, opposite, conditions: Vec::new() };
    (place, plane_speed)
}

/// `[materials.*]`: elasticity in place of the common one, damping of its own, and tables over frequency.
pub(super) fn materials(own: &Description<'_>) -> Vec<(String, RegionMaterial)> {
    own.root.each("materials", |section| {
        let material = material(own, section);
        refuse_each!(section, "radii heights"; key =>
            "is of a part of a generated three-dimensional body"; "of other bodies";
            "leave it out");
        material
    })
}

/// The material of a section of `[materials.*]`.
pub(super) fn material(own: &Description<'_>, section: &Section<'_>) -> RegionMaterial {
    let coefficients = ["mass_coefficient", "stiffness_coefficient"];
    let coefficients = coefficients.map(|key| section.optional_number(key));
    let material = elastic::material(section, own.common.elastic.formulation, &own.tables);
    let damping = match coefficients {
        [None, None] => None,
        [mass, stiffness] => Some(RayleighDamping {
            mass_coefficient: mass.unwrap_or(0.0),
            stiffness_coefficient: stiffness.unwrap_or(0.0),
        }),
    };
    RegionMaterial { damping, ..material }
}

/// The body of a mesh file, or the error; none where a name is missing, which has been told.
pub(super) type Made = Result<Body, Option<Diagnostic>>;

/// What makes a body of a mesh file, be it plane or of solid elements.
pub(super) struct FileParts<'a> {
    pub bytes: &'a MeshBytes,
    pub own: &'a Description<'a>,
    /// Of a file that has one sector.
    pub symmetry: Option<CyclicSymmetry>,
    /// The materials of regions that have one of their own.
    pub materials: Vec<(String, RegionMaterial)>,
}

impl FileParts<'_> {
    /// What the file has, or all the sectors of which it has one.
    fn whole(&self) -> Result<Arc<FileMesh>, BodyError> {
        let read = self.bytes.read()?;
        let Some(symmetry) = &self.symmetry else { return Ok(read) };
        let point = symmetry.point.map(|x| x / self.own.scale);
        repeated_file(&read, &CyclicSymmetry { point, ..*symmetry }).map(Arc::new)
    }

    /// The whole body with what modifications take away and move, and how far they move its counterface, m.
    pub(super) fn shaped(&self, contact: &str) -> Result<(Arc<FileMesh>, [f64; 2]), Diagnostic> {
        let own = self.own;
        let whole = self.whole().map_err(|error| own.unusable(error))?;
        reshaped(whole, own.scale, contact, &own.modifications).map_err(|misfit| own.misfit(misfit))
    }

    /// The material of each region; `find` refuses a name that none of them has.
    pub(super) fn materials_of(
        &self,
        regions: &[String],
        find: impl Fn(&str) -> Result<usize, Option<Diagnostic>>,
    ) -> Result<Vec<RegionMaterial>, Option<Diagnostic>> {
        for (name, _) in &self.materials {
            find(name)?;
        }
        let common = Some(&self.own.common).filter(|_| has_common_constants(self.own.root));
        let material = |region: &String| {
            let own = self.materials.iter().find(|(name, _)| name == region);
            let own = own.map(|(_, material)| material).or(common);
            own.cloned().ok_or_else(|| {
                placed!(self.own.raw.place("materials"),
                    "{}: the region \"{region}\" has no material", self.bytes.file;
                    "no section for it";
                    "give it a section [materials.{}], or [material] for all regions without one",
                    quote(region))
            })
        };
        Ok(regions.iter().map(material).collect::<Result<_, _>>()?)
    }
}

/// The mesh file that `mesh.file` names, relative to the case; read once.
pub(super) fn mesh_bytes(raw: &RawCase, file: &str) -> Result<MeshBytes, String> {
    if let Some(known) = raw.mesh.as_ref().filter(|known| known.file == file) {
        return Ok(known.clone());
    }
    Ok(MeshBytes::new(file.to_owned(), inclusion::mesh_file(&raw.beside(file))?))
}

/// The symmetry that `mesh.sectors` says, about an axis of some direction through a point (m).
pub(super) fn symmetry(
    mesh: &Section<'_>,
    axis: Result<[[f64; 3]; 2], &str>,
) -> Option<CyclicSymmetry> {
    let count = mesh.optional_count("sectors").filter(|count| *count > 1)?;
    match axis {
        Ok([direction, point]) => Some(CyclicSymmetry { count, point, direction }),
        Err(why) => {
            refuse!(mesh, "sectors",
                "mesh.sectors needs one axis that the sectors turn about, but {why}";
                "about which axis?"; "mesh the whole body, and leave mesh.sectors out");
            None
        }
    }
}

impl Description<'_> {
    /// An error at a key of the case, with the usage of the key as remedy.
    pub(super) fn error(&self, key: &str, message: String, label: &str) -> Diagnostic {
        Diagnostic::error(message, label, self.raw.place(key), suggestion::usage(key))
    }

    /// What a modification asks for that the body does not have.
    fn misfit(&self, (key, why): Misfit) -> Diagnostic {
        self.error(&key, format!("{key}: {why}"), "does not fit the body")
    }

    /// A mesh of which no body can be made, at the key that asked for what it does not have.
    pub(super) fn unusable(&self, error: BodyError) -> Diagnostic {
        let message = format!("{}: {error}", self.file.as_deref().unwrap_or_default());
        let BodyError::Request { part, .. } = error else {
            // What the key means is no remedy for what the file holds.
            return Diagnostic::error(message, "cannot be used", self.raw.place("mesh.file"), None);
        };
        let (key, label) = match part {
            BodyPart::Contact => ("contact.boundary".to_owned(), "the contact curve"),
            BodyPart::Opposite => {
                ("contact.counter_boundary".to_owned(), "the curve of the other body")
            }
            BodyPart::Boundary(name) => (format!("boundaries.{name}"), "a boundary of the mesh"),
            BodyPart::Direction => ("contact.direction".to_owned(), "must lie along the face"),
            BodyPart::Center => ("contact.center".to_owned(), "not the centre of the curve"),
            BodyPart::Scale => ("mesh.scale".to_owned(), "metres?"),
            BodyPart::Sectors => ("mesh.sectors".to_owned(), "the sector does not fit"),
        };
        self.error(&key, message, label)
    }
}

/// A hint at the known name that is meant by another.
pub(super) fn near_name(name: &str, known: &[String]) -> String {
    let near = suggestion::nearest(name, known.iter().map(String::as_str));
    near.map_or_else(String::new, |near| format!("; did you mean \"{near}\"?"))
}

/// The plane body that a mesh file describes, with its contact curves and counterface at `place`.
pub(super) fn import(parts: &FileParts<'_>, place: BodySpecification, interference: f64) -> Made {
    let own = parts.own;
    let (read, way) = parts.shaped(&place.contact)?;
    let specification = BodySpecification {
        scale: own.scale,
        counterface: moved(&place, way).map_err(|misfit| own.misfit(misfit))?,
        conditions: own.conditions.clone(),
        ..place
    };
    let mesh = Mesh::from_gmsh(&read, &specification).map_err(|error| own.unusable(error))?;
    check_meeting(&mesh, &specification, interference).map_err(|message| {
        own.error("contact.counter_boundary", message, "the bodies do not meet")
    })?;
    let find = |name: &str| {
        mesh.regions.iter().position(|region| region == name).ok_or_else(|| {
            let regions = mesh.regions.iter().map(|region| format!("\"{region}\""));
            let message = format!(
                "{}: no physical surface is called \"{name}\"; the file has {}{}",
                parts.bytes.file,
                first_of(regions, MOST_NAMES),
                near_name(name, &mesh.regions)
            );
            Some(own.error(&format!("materials.{name}"), message, "no such surface"))
        })
    };
    let materials = parts.materials_of(&mesh.regions, find)?;
    let kind = BodyKind::Imported(ImportedBody::new(mesh, read, specification));
    Ok(Body { materials, kind })
}

/// The counterface of a body whose contact curve is moved.
fn moved(place: &BodySpecification, way: [f64; 2]) -> Result<CounterfaceSpecification, Misfit> {
    match (place.counterface, &place.opposite) {
        (own, _) if way == [0.0; 2] => Ok(own),
        (CounterfaceSpecification::Cylinder { center, radius }, None) => {
            let center = [center[0] + way[0], center[1] + way[1]];
            Ok(CounterfaceSpecification::Cylinder { center, radius })
        }
        _ => Err((
            "modifications".to_owned(),
            "an offset moves a hole with the rigid cylinder in it; this contact has another counterface".to_owned(),
        )),
    }
}

impl ImportedBody {
    /// A body of a mesh that was made of a file.
    pub(super) fn new(mesh: Mesh, file: Arc<FileMesh>, specification: BodySpecification) -> Self {
        Self { mesh: Arc::new(mesh), source: Arc::new((file, specification)) }
    }

    /// The same body with every element split into four, `times` over.
    ///
    /// # Errors
    /// A mesh that would be too large, or that folds where it is refined.
    pub fn refined(&self, times: u32) -> Result<Self, BodyError> {
        if times == 0 {
            return Ok(self.clone());
        }
        let (file, specification) = &*self.source;
        let mut fine = refined_file(file)?;
        for _ in 1..times {
            fine = refined_file(&fine)?;
        }
        let mesh = Mesh::from_gmsh(&fine, specification)?;
        Ok(Self::new(mesh, Arc::new(fine), specification.clone()))
    }
}

/// Two bodies must have their curves before each other, at most as far into each other as the interference.
fn check_meeting(mesh: &Mesh, body: &BodySpecification, interference: f64) -> Result<(), String> {
    let Some(other) = &body.opposite else { return Ok(()) };
    let (interface, name) = (ContactInterface::of(mesh), &body.contact);
    let gaps = interface.gaps.iter().enumerate();
    let Some((i, gap)) = gaps.min_by(|a, b| a.1.total_cmp(b.1)) else {
        return Err(format!(
            "no point of \"{name}\" (contact.boundary) has \"{other}\" (contact.counter_boundary) \
             facing it: check the curves, and contact.center, speed and direction"
        ));
    };
    let (depth, size) = (-gap, interface.tributary_lengths[i]);
    // A thousandth of an element is what faceted curves differ by.
    if depth > interference + 1e-3 * size {
        return Err(format!(
            "the bodies overlap: node {} of \"{name}\" lies {depth:.3e} m inside the other body, \
             more than contact.interference = {interference:e} m. Mesh them just touching, and let \
             contact.interference press them together",
            mesh.node_label(interface.nodes[i] as usize)
        ));
    }
    Ok(())
}
