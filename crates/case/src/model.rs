//! The body of a case: generated, or from a mesh file.

use super::assembly::AssemblyParts;
use super::description::{Description, has_common_constants};
use super::elastic::{Surroundings, place_axes};
use super::imported::{FileParts, Made};
use super::{Contact, assembly, attachments, imported};
use super::{contact::contact, generated::generated};
use crate::*;

/// The body with its modifications, and its contact; no body where a mesh file makes none, which is an error already.
pub(super) fn body(own: &mut Description<'_>) -> (Option<Body>, Contact) {
    let (mut body, contact) = match own.file.clone() {
        None => generated(own),
        Some(file) => of_file(own, &file),
    };
    if let Some(body) = &mut body {
        attachments::attach(own, body);
        let held = body.imported().map_or(Ok(()), |own| own.mesh.check_held());
        if let Err(error) = held {
            own.root.findings.push(own.unusable(error));
        }
    }
    (body, contact)
}

/// Makes a body of what its mesh file holds.
type Make = Box<dyn FnOnce(&FileParts<'_>) -> Made>;

/// The body of a mesh file with what modifications take away or move, and its contact.
fn of_file(own: &mut Description<'_>, file: &str) -> (Option<Body>, Contact) {
    let root = own.root;
    // What describes a generated body has no effect beside `mesh.file`.
    let radii = "inner_radius outer_radius shaft_inner_radius";
    let counts = "circumferential_elements radial_elements axial_elements shaft_radial_elements \
                  radial_grading element";
    for (section, keys) in [(&own.geometry, radii), (&own.mesh, counts)] {
        for key in section.refused(keys) {
            caution!(section, key => "is not used: mesh.file describes the body"; "no effect");
        }
    }
    own.geometry.close();
    let bytes = imported::mesh_bytes(own.raw, file);
    let read = bytes.as_ref().ok().and_then(|bytes| bytes.read().ok());
    // Of a file that cannot be read the case tells.
    let in_space = own.raw.find("contact.direction").is_some_and(|own| own.listed().len() == 3);
    let has_solids = read.map_or(own.is_solid() || in_space, |read| read.dimension == 3);
    // What slides on what, and the axes of sectors and of materials.
    let is_plane = !(root.has("contacts") || root.has("ties") || has_solids);
    let (make, contact, axes): (Make, _, _) = if !is_plane {
        let (parts, contact) = solid_joints(own, has_solids);
        let still = [Ok([[0.0, 0.0, 1.0], [0.0; 3]]), Err("nothing of the case turns")];
        let axes = still.map(|axis| parts.axis().unwrap_or(axis));
        (Box::new(|file| assembly::assemble(file, parts)), contact, axes)
    } else {
        let (contact, place, _) = contact(root, None, own.is_pressed());
        refuse_if!(own.is_solid(); own.mesh, "file",
            "mesh.file holds plane elements, and material.formulation is \"three-dimensional\"";
            "triangles and quadrilaterals in the plane";
            "give a plane formulation, a file with solid elements, or the radii of a body that is generated");
        let axis = match place.counterface {
            CounterfaceSpecification::Cylinder { center: [x, y], .. } => {
                Some([[0.0, 0.0, 1.0], [x, y, 0.0]])
            }
            CounterfaceSpecification::Plane { .. } => None,
        };
        let lacks = ["the counterface is a plane", "the counterface is a plane, which has no axis"];
        let pushed = contact.sliding.interference;
        let make = move |file: &FileParts<'_>| imported::import(file, place, pushed);
        (Box::new(make), contact, lacks.map(|why| axis.ok_or(why)))
    };
    let surroundings = Surroundings { axis: axes[1], is_plane, has_sectors: false };
    let symmetry = imported::symmetry(&own.mesh, axes[0]);
    let materials = materials(own, &surroundings);
    let reject = |message: String| own.mesh.reject("file", message, "not readable", None);
    let body = bytes.map_err(reject).ok().and_then(|bytes| {
        let parts = FileParts { bytes: &bytes, own, symmetry, materials };
        make(&parts).map_err(|error| error.map(|error| root.findings.push(error))).ok()
    });
    own.mesh.close();
    (body, contact)
}

/// `[contacts.*]`, `[ties.*]` and `[motion.*]` of solid bodies, or their `[contact]`.
fn solid_joints(own: &Description<'_>, has_solids: bool) -> (AssemblyParts, Contact) {
    let root = own.root;
    if root.has("contact") && (root.has("contacts") || !has_solids) {
        let _ = root.section("contact", false);
        let names = root.section("contacts", false);
        let name = names.remaining().first().map_or("NAME", |(name, _)| name);
        refuse!(root, "contact",
            "[contact] is for a body with one contact: this case has [contacts.*] or [ties.*]";
            "beside the contacts of an assembly"; "describe it under [contacts.{name}]");
    }
    if has_solids {
        let material = root.section("material", false);
        let is_plane = material.has("formulation") && !own.is_solid();
        let flat = own.geometry.has("thickness").then_some((&own.geometry, "thickness"));
        for (section, key) in flat.into_iter().chain(is_plane.then_some((&material, "formulation")))
        {
            caution!(section, key => "is not used: the mesh is of solid elements"; "no effect");
        }
    }
    let (parts, contact) = assembly::sections(own);
    let cea = root.section("cea", false);
    caution_if!(cea.flag("geometric_stiffness") && parts.base == BaseChoice::Closed; cea,
        "geometric_stiffness",
        "bodies that are closed and free of stress have no geometric stiffness";
        "no effect with base_state = \"closed\""; "leave one of the two out");
    (parts, contact)
}

/// `[materials.*]` with their axes and those of `[material]` laid into the body. A case without `[material]` gets the
/// constants of its first region for what asks for one.
fn materials(own: &mut Description<'_>, body: &Surroundings) -> Vec<(String, RegionMaterial)> {
    let root = own.root;
    place_axes(root, &["material"], &mut own.common.elastic, body);
    let mut all = imported::materials(own);
    for (name, material) in &mut all {
        place_axes(root, &["materials", name], &mut material.elastic, body);
    }
    if let Some((_, first)) = all.first().filter(|_| !has_common_constants(root)) {
        own.common.elastic = first.elastic;
    }
    all
}
