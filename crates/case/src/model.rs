//! The sections that describe the model: geometry, mesh, material, damping, contact.

use super::boundaries::NamedCondition;
use super::contact::contact;
use super::elastic::{Surroundings, elastic, place_axes};
use super::generated::generated;
use super::imported::{BodyParts, ImportError};
use super::modifications::Modification;
use super::tables::{TableFiles, modulus_table};
use super::words::FilePart;
use super::{
    Body, Contact, MeshBytes, RawCase, Section, UnitsWord, assembly, attachments, boundaries,
    caution, imported, modifications, refuse, solid,
};
use frictionsim_physics::fem::{ElasticMaterial, RayleighDamping, RegionMaterial, TabledMaterial};
use frictionsim_physics::mesh::{BoundaryCondition, CounterfaceSpecification};
use frictionsim_physics::prestress::BaseChoice;

/// `[damping]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// Rayleigh's coefficients.
    pub rayleigh: RayleighDamping,
    /// Whether `beta_R` multiplies the whole tangent, contact and friction terms included, or the
    /// body's stiffness alone.
    pub include_contact: bool,
}

/// Geometry, mesh and contact of a case.
pub(super) struct Model {
    /// None where a mesh file makes no body, which is an error already.
    pub body: Option<Body>,
    pub thickness: f64,
    pub mesh: Option<MeshBytes>,
    pub contact: Contact,
}

/// The generated body, or that of a mesh file, with its modifications.
pub(super) fn model(
    root: &Section<'_>,
    raw: &RawCase,
    material: &mut TabledMaterial,
    tables: &mut TableFiles<'_>,
) -> Model {
    let changes = modifications::sections(root);
    let mut model = unmodified(root, raw, (material, tables), &changes);
    if let Some(body) = &mut model.body {
        attachments::attach(root, &changes, body, model.thickness);
        let held = body.imported().map_or(Ok(()), |own| own.mesh.check_held());
        if let Err(error) = held {
            let mesh = root.section("mesh", true);
            let file = model.mesh.as_ref().map_or("", |mesh| mesh.file.as_str());
            ImportError::of(error, file).report(raw, &mesh);
        }
    }
    model
}

/// The body with what its modifications take away or move.
fn unmodified(
    root: &Section<'_>,
    raw: &RawCase,
    (common, tables): (&mut TabledMaterial, &mut TableFiles<'_>),
    changes: &[Modification],
) -> Model {
    let material = &mut common.own.elastic;
    let conditions = boundaries::all(root);
    let is_pressed =
        conditions.iter().any(|(_, condition)| matches!(condition, BoundaryCondition::Pressure(_)));
    let mesh = root.section("mesh", true);
    let file = mesh.optional_text("file");
    let scale = length_factor(&mesh);
    let geometry = root.section("geometry", file.is_none());
    let thickness = geometry.number("thickness");
    let is_solid = solid::is_solid(material);
    if !is_solid {
        boundaries::no_axial_support(root, &conditions);
    }
    let Some(file) = file else {
        let sections = [geometry, mesh];
        let parts = (conditions.as_slice(), is_pressed);
        let sizes = (thickness, changes);
        let (body, contact) = generated(root, sections, parts, (common, tables), sizes);
        return Model { body, thickness, mesh: None, contact };
    };
    ignore_generated(&geometry, &mesh);
    geometry.close();
    let is_file_solid = imported::mesh_bytes(raw, &file)
        .ok()
        .and_then(|bytes| bytes.read().ok())
        .is_some_and(|read| read.dimension == 3);
    if root.has("contacts") || root.has("ties") || is_file_solid {
        if root.has("contact") && (root.has("contacts") || !is_file_solid) {
            let _ = root.section("contact", false);
            let names = root.section("contacts", false);
            let name = names.remaining().first().map_or("NAME", |(name, _)| name);
            refuse!(root, "contact",
                "[contact] is for a body with one contact: this case has [contacts.*] or [ties.*]";
                "beside the contacts of an assembly"; "describe it under [contacts.{name}]");
        }
        let parts = (conditions.as_slice(), common, tables);
        let file = (&mesh, file.as_str(), scale);
        let model = assembly_model(root, raw, file, parts, (thickness, changes));
        mesh.close();
        return model;
    }
    let (contact, place) = contact(root, None, is_pressed);
    if is_solid {
        refuse!(mesh, "file",
            "mesh.file holds plane elements, and material.formulation is \"three-dimensional\"";
            "triangles and quadrilaterals in the plane";
            "give a plane formulation, a file with solid elements, or the radii of a body that is \
             generated");
    }
    let center = match place.counterface {
        CounterfaceSpecification::Cylinder { center, .. } => Some(center),
        CounterfaceSpecification::Plane { .. } => None,
    };
    let plane = Surroundings::Plane { center };
    let axis = center.map(|[x, y]| [[0.0, 0.0, 1.0], [x, y, 0.0]]);
    let axis = axis.ok_or("the counterface is a plane");
    let parts = BodyParts {
        scale,
        symmetry: imported::symmetry(&mesh, axis),
        place,
        interference: contact.sliding.interference,
        boundaries: conditions,
        materials: materials(root, material, &plane, tables),
        common: has_common_constants(root).then(|| common.clone()),
    };
    let reject = |message: String| mesh.reject("file", message, "not readable", None);
    let bytes = imported::mesh_bytes(raw, &file).map_err(&reject).ok();
    let body = bytes.as_ref().and_then(|bytes| {
        let body = imported::import(bytes, &parts, changes);
        body.map_err(|error| error.report(raw, &mesh)).ok()
    });
    mesh.close();
    Model { body: body.map(Body::Imported), thickness, mesh: bytes, contact }
}

/// The solid bodies of a mesh file.
fn assembly_model(
    root: &Section<'_>,
    raw: &RawCase,
    (mesh, file, scale): (&Section<'_>, &str, f64),
    (conditions, common, tables): (&[NamedCondition], &mut TabledMaterial, &mut TableFiles<'_>),
    (thickness, changes): (f64, &[Modification]),
) -> Model {
    let (mut parts, contact) = assembly::sections(root, tables);
    let cea = root.section("cea", false);
    if cea.flag("geometric_stiffness") && parts.base == BaseChoice::Closed {
        caution!(cea, "geometric_stiffness",
            "bodies that are closed and free of stress have no geometric stiffness";
            "no effect with base_state = \"closed\""; "leave one of the two out");
    }
    let axis = if parts.turns() { parts.axis() } else { Ok([[0.0, 0.0, 1.0], [0.0; 3]]) };
    parts.symmetry = imported::symmetry(mesh, axis);
    let solids = Surroundings::Solids { axis: parts.axis() };
    let own = materials(root, &mut common.own.elastic, &solids, tables);
    let reject = |message: String| mesh.reject("file", message, "not readable", None);
    let bytes = imported::mesh_bytes(raw, file).map_err(&reject).ok();
    let body = bytes.as_ref().and_then(|bytes| {
        let common = has_common_constants(root).then_some(&*common);
        let body = assembly::assemble(bytes, scale, conditions, (common, &own), (parts, changes));
        body.map_err(|error| error.report(raw, mesh)).ok()
    });
    Model { body: body.map(Body::Assembly), thickness, mesh: bytes, contact }
}

/// Factor on the coordinates of a mesh file: that of its units, or `mesh.scale`.
fn length_factor(mesh: &Section<'_>) -> f64 {
    let units: UnitsWord = mesh.choice("units");
    let _: Vec<FilePart> = mesh.choices("take");
    let _ = mesh.texts("drop");
    let scale = mesh.number("scale");
    if !mesh.has("units") {
        return scale;
    }
    if mesh.has("scale") {
        refuse!(mesh, "scale", "mesh.units and mesh.scale both scale the coordinates";
            "beside mesh.units"; "leave one of them out");
    }
    10f64.powi(units.length())
}

/// `[materials.*]` with their axes and those of `[material]` laid into the body. A case without `[material]` gets the
/// constants of its first region for what asks for one.
fn materials(
    root: &Section<'_>,
    common: &mut ElasticMaterial,
    body: &Surroundings,
    tables: &mut TableFiles<'_>,
) -> Vec<(String, TabledMaterial)> {
    place_axes(root, &["material"], common, body);
    let mut own = imported::materials(root, common, tables);
    for (name, material) in &mut own {
        let elastic = &mut material.own.elastic;
        place_axes(root, &["materials", name], elastic, body);
    }
    if let Some((_, first)) = own.first().filter(|_| !has_common_constants(root)) {
        *common = first.own.elastic;
    }
    own
}

/// Reads what describes a generated body, which has no effect beside `mesh.file`, and says so.
fn ignore_generated(geometry: &Section<'_>, mesh: &Section<'_>) {
    let radii = geometry.refused("inner_radius outer_radius shaft_inner_radius");
    let counts = "circumferential_elements radial_elements axial_elements shaft_radial_elements";
    let counts = mesh.refused(counts).into_iter().chain(mesh.refused("radial_grading element"));
    let given = radii.into_iter().map(|key| (geometry, key));
    for (section, key) in given.chain(counts.map(|key| (mesh, key))) {
        caution!(section, key => "is not used: mesh.file describes the body"; "no effect");
    }
}

/// Names of the regions of `[materials.*]`.
fn region_names<'a>(root: &Section<'a>) -> Vec<&'a str> {
    root.section("materials", false).remaining().into_iter().map(|(name, _)| name).collect()
}

/// Whether `[material]` has the constants of regions without a section of their own; a formulation alone gives them
/// none.
fn has_common_constants(root: &Section<'_>) -> bool {
    let given = root.section("material", false).remaining();
    given.iter().any(|(key, _)| *key != "formulation")
}

/// `[material]`. Where every region of a mesh file may have a section of its own, it can be left out: the constants are
/// then those of the first region, once it is read.
pub(super) fn material(root: &Section<'_>, tables: &mut TableFiles<'_>) -> TabledMaterial {
    let has_regions = root.section("mesh", false).has("file") && !region_names(root).is_empty();
    let is_needed = !has_regions || has_common_constants(root);
    let section = root.section("material", is_needed);
    let formulation = section.choice("formulation");
    let (elastic, table) = match is_needed {
        true => {
            let table = modulus_table(&section, tables);
            (elastic(&section, formulation, table.as_deref()), table)
        }
        false => (ElasticMaterial { formulation, ..ElasticMaterial::PLAIN }, None),
    };
    section.close();
    TabledMaterial { own: RegionMaterial { elastic, damping: None }, table }
}

pub(super) fn damping(section: &Section<'_>) -> Damping {
    Damping {
        rayleigh: RayleighDamping {
            mass_coefficient: section.number("mass_coefficient"),
            stiffness_coefficient: section.number("stiffness_coefficient"),
        },
        include_contact: section.flag("include_contact"),
    }
}
