//! The sections that describe the model: geometry, mesh, material, damping, contact.

use super::assembly;
use super::attachments;
use super::body::{Annulus, Body, Revolution, node_count};
use super::boundaries::{self, NamedCondition};
use super::contact::{Contact, contact};
use super::elastic::{Surroundings, elastic, place_axes};
use super::imported::{self, BodyParts};
use super::modifications::{self, Modification};
use super::raw::{MeshBytes, RawCase};
use super::reader::Section;
use super::shaft;
use super::solid;
use super::tables::{TableFiles, modulus_table};
use super::whole_revolution::whole_revolution;
use super::words::{FilePart, UnitsWord};
use crate::fem::{
    AnnulusMaterials, ElasticMaterial, RayleighDamping, RegionMaterial, TabledMaterial,
};
use crate::mesh::{
    AnnulusSpecification, BoundaryCondition, CounterfaceSpecification, ElementKind,
    SolidSpecification,
};

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
    let is_pressed = conditions
        .iter()
        .any(|(_, condition)| matches!(condition, BoundaryCondition::Pressure(_)));
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
        imported::refuse_sectors(&mesh);
        let axial = solid::axial_elements(&geometry, &mesh, is_solid);
        let sectors = Surroundings::Sectors {
            is_plane: !is_solid,
        };
        place_axes(root, &["material"], material, &sectors);
        let parts = (conditions.as_slice(), is_solid);
        let (mut annulus, mut shaft) = annulus(root, [&geometry, &mesh], parts, (material, tables));
        if let Some(shaft) = &mut shaft {
            let path = ["materials", "shaft"];
            place_axes(root, &path, &mut shaft.own.elastic, &sectors);
        }
        geometry.close();
        mesh.close();
        let (contact, place) = contact(root, Some((&annulus, is_solid)), is_pressed);
        let body = match axial {
            None => Some(Annulus {
                specification: annulus,
                materials: AnnulusMaterials {
                    annulus: *material,
                    shaft: shaft.as_ref().map(|shaft| shaft.own),
                },
                tables: [common.table.clone(), shaft.and_then(|shaft| shaft.table)],
            })
            .and_then(|annulus| plane_annulus(root, annulus, changes)),
            Some(axial_elements) => {
                let conditions = solid::conditions(root, &conditions, place.solid);
                annulus.outer = conditions[1];
                let revolution = Revolution {
                    specification: SolidSpecification {
                        annulus,
                        thickness,
                        axial_elements,
                        contact: place.solid,
                        conditions,
                    },
                    material: *material,
                };
                revolution_body(root, revolution, (common, &contact), changes)
            }
        };
        return Model {
            body,
            thickness,
            mesh: None,
            contact,
        };
    };
    ignore_generated(&geometry, &mesh);
    geometry.close();
    let is_file_solid = imported::mesh_bytes(raw, &file)
        .ok()
        .and_then(|bytes| bytes.read().ok())
        .is_some_and(|read| read.dimension == 3);
    if root.has("contacts") || root.has("ties") || is_file_solid {
        if root.has("contact") && (root.has("contacts") || !is_file_solid) {
            root.reject(
                "contact",
                "[contact] is for a body with one contact: this case has [contacts.*] or [ties.*]",
                "beside the contacts of an assembly",
                "describe it under [contacts.NAME]",
            );
        }
        let parts = (conditions.as_slice(), common, tables);
        let file = (&mesh, file.as_str(), scale);
        let model = assembly_model(root, raw, file, parts, (thickness, changes));
        mesh.close();
        return model;
    }
    let (contact, place) = contact(root, None, is_pressed);
    if is_solid {
        mesh.reject(
            "file",
            "mesh.file describes a plane body; three-dimensional bodies are generated",
            "material.formulation is \"three-dimensional\"",
            "give radii and element counts, or a plane formulation",
        );
    }
    let plane = Surroundings::Plane {
        center: match place.counterface {
            CounterfaceSpecification::Cylinder { center, .. } => Some(center),
            CounterfaceSpecification::Plane { .. } => None,
        },
    };
    let axis = match place.counterface {
        CounterfaceSpecification::Cylinder { center: [x, y], .. } => {
            Ok([[0.0, 0.0, 1.0], [x, y, 0.0]])
        }
        CounterfaceSpecification::Plane { .. } => Err("the counterface is a plane"),
    };
    let parts = BodyParts {
        scale,
        symmetry: imported::symmetry(&mesh, axis),
        place,
        interference: contact.sliding.interference,
        boundaries: conditions,
        materials: materials(root, material, &plane, tables),
        common: common.clone(),
    };
    let reject = |(message, label): (String, String)| mesh.reject("file", message, label, None);
    let bytes = imported::mesh_bytes(raw, &file).map_err(&reject).ok();
    let body = bytes.as_ref().and_then(|bytes| {
        let body = imported::import(bytes, &parts, changes);
        body.map_err(|error| error.report(raw, &mesh)).ok()
    });
    mesh.close();
    Model {
        body: body.map(Body::Imported),
        thickness,
        mesh: bytes,
        contact,
    }
}

/// A body of revolution, as a whole mesh where modifications break its symmetry, where losses or moduli over frequency part the
/// waves +n and -n of its harmonics, and where that is asked for.
fn revolution_body(
    root: &Section<'_>,
    revolution: Revolution,
    parts: (&TabledMaterial, &Contact),
    changes: &[Modification],
) -> Option<Body> {
    let (material, contact) = parts;
    let supports = revolution.specification.conditions.iter();
    let loses = supports.filter_map(|condition| match condition {
        BoundaryCondition::Support(support) => Some(support.loss_factor),
        _ => None,
    });
    let own = [
        material.own.elastic.loss_factor,
        contact.stiffness.loss_factor,
    ];
    let is_lossy = loses.chain(own).any(|eta| eta > 0.0) || material.table.is_some();
    let cea = root.section("cea", false);
    let is_asked_for = cea.is_text("method", "sparse")
        || root
            .section("transient", false)
            .is_text("operator", "sparse");
    if changes.is_empty() && !is_lossy && !is_asked_for {
        return Some(Body::Revolution(revolution));
    }
    if cea.is_given() && cea.flag("geometric_stiffness") {
        warn_of_stress(&cea);
    }
    let found = whole_revolution(&revolution, parts, changes);
    let reject = |(key, why): modifications::Misfit| {
        let section = key.split('.').next().unwrap_or_default().to_owned();
        let message = format!("{key}: {why}");
        root.reject(&section, message, "does not fit the whole mesh", None);
    };
    found.map_err(reject).ok().map(Body::Assembly)
}

/// Says that the stress of the base state is left out of the modes.
fn warn_of_stress(cea: &Section<'_>) {
    cea.warn(
        "geometric_stiffness",
        "solid bodies on their whole mesh have no geometric stiffness: the stress of the base state is left out of their modes"
            .to_owned(),
        "no effect; set it to false",
    );
}

/// A plane annulus, as a whole mesh where modifications break its symmetry.
fn plane_annulus(root: &Section<'_>, annulus: Annulus, changes: &[Modification]) -> Option<Body> {
    // What is wrong with the counts is said elsewhere.
    if changes.is_empty() || node_count(&annulus.specification) > 1 << 24 {
        return Some(Body::Annulus(annulus));
    }
    let reject = |(key, why): modifications::Misfit| {
        let message = format!("{key}: {why}");
        root.reject("modifications", message, "does not fit the disc", None);
    };
    let body = attachments::reshaped_annulus(&annulus, changes);
    body.map_err(reject).ok().map(Body::Imported)
}

/// The solid bodies of a mesh file.
fn assembly_model(
    root: &Section<'_>,
    raw: &RawCase,
    (mesh, file, scale): (&Section<'_>, &str, f64),
    (conditions, common, tables): (&[NamedCondition], &mut TabledMaterial, &mut TableFiles<'_>),
    (thickness, changes): (f64, &[Modification]),
) -> Model {
    let _ = mesh.optional_count("axial_elements");
    let cea = root.section("cea", false);
    if cea.has("geometric_stiffness") && cea.flag("geometric_stiffness") {
        warn_of_stress(&cea);
    }
    let (mut parts, contact) = assembly::sections(root, tables);
    let axis = match parts.turns() {
        true => parts.axis(),
        false => Ok([[0.0, 0.0, 1.0], [0.0; 3]]),
    };
    parts.symmetry = imported::symmetry(mesh, axis);
    let solids = Surroundings::Solids { axis: parts.axis() };
    let own = materials(root, &mut common.own.elastic, &solids, tables);
    let reject = |(message, label): (String, String)| mesh.reject("file", message, label, None);
    let bytes = imported::mesh_bytes(raw, file).map_err(&reject).ok();
    let body = bytes.as_ref().and_then(|bytes| {
        let body = assembly::assemble(bytes, scale, conditions, (common, &own), (parts, changes));
        body.map_err(|error| error.report(raw, mesh)).ok()
    });
    Model {
        body: body.map(Body::Assembly),
        thickness,
        mesh: bytes,
        contact,
    }
}

/// Factor on the coordinates of a mesh file: that of its units, or `mesh.scale`.
fn length_factor(mesh: &Section<'_>) -> f64 {
    let units: UnitsWord = mesh.choice("units");
    let _: Vec<FilePart> = mesh.choices("take");
    let scale = mesh.number("scale");
    if !mesh.has("units") {
        return scale;
    }
    if mesh.has("scale") {
        mesh.reject(
            "scale",
            "mesh.units and mesh.scale both scale the coordinates",
            "beside mesh.units",
            "leave one of them out",
        );
    }
    10f64.powi(units.length())
}

/// `[materials.*]` with their axes and those of `[material]` laid into the body.
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
    own
}

/// Reads what describes a generated body, which has no effect beside `mesh.file`, and says so.
fn ignore_generated(geometry: &Section<'_>, mesh: &Section<'_>) {
    let radii = ["inner_radius", "outer_radius", "shaft_inner_radius"];
    let _ = radii.map(|key| geometry.optional_number(key));
    let counts = [
        "circumferential_elements",
        "radial_elements",
        "axial_elements",
        "shaft_radial_elements",
    ];
    let _ = counts.map(|key| mesh.optional_count(key));
    let (_, _): (_, ElementKind) = (mesh.number("radial_grading"), mesh.choice("element"));
    let shape = ["radial_grading", "element"];
    let given = radii.iter().map(|key| (geometry, key));
    let given = given.chain(counts.iter().chain(&shape).map(|key| (mesh, key)));
    for (section, key) in given.filter(|(section, key)| section.has(key)) {
        section.warn(
            key,
            format!(
                "{} is not used: mesh.file describes the body",
                section.name(key)
            ),
            "no effect",
        );
    }
}

fn annulus(
    root: &Section<'_>,
    [geometry, mesh]: [&Section<'_>; 2],
    (conditions, is_solid): (&[NamedCondition], bool),
    (material, tables): (&ElasticMaterial, &mut TableFiles<'_>),
) -> (AnnulusSpecification, Option<TabledMaterial>) {
    let inner_radius = geometry.number("inner_radius");
    let outer_radius = geometry.number("outer_radius");
    if outer_radius <= inner_radius {
        geometry.reject(
            "outer_radius",
            format!(
                "geometry.outer_radius = {outer_radius} must be above \
                 geometry.inner_radius = {inner_radius}"
            ),
            format!("must be above {inner_radius}"),
            "both are radii in metres; are they swapped?",
        );
    }
    let shaft = shaft::shaft(
        root,
        [geometry, mesh],
        inner_radius,
        conditions,
        material,
        tables,
    );
    if is_solid && shaft.is_some() {
        geometry.reject(
            "shaft_inner_radius",
            "a deformable shaft turns in a plane annulus only",
            "the body is three-dimensional",
            "leave the shaft out, or use a plane formulation",
        );
    }
    let annulus = AnnulusSpecification {
        inner_radius,
        outer_radius,
        circumferential_elements: mesh.count("circumferential_elements"),
        radial_elements: mesh.count("radial_elements"),
        radial_grading: mesh.number("radial_grading"),
        element: mesh.choice("element"),
        outer: match is_solid {
            true => BoundaryCondition::Clamped,
            false => boundaries::outer_edge(root, conditions, shaft.is_some()),
        },
        shaft: shaft.as_ref().map(|(shaft, _)| *shaft),
    };
    check_mesh(mesh, &annulus);
    (annulus, shaft.map(|(_, material)| material))
}

fn check_mesh(mesh: &Section<'_>, annulus: &AnnulusSpecification) {
    // Node indices are 32 bits wide, with room for two unknowns at each node.
    let (nodes, limit) = (node_count(annulus), u128::from(u32::MAX / 2));
    if nodes > limit {
        mesh.reject(
            "circumferential_elements",
            format!("the mesh would have {nodes} nodes, above the limit of {limit}"),
            "too many elements",
            "lower mesh.circumferential_elements or mesh.radial_elements",
        );
    }
    // Sizes that differ by more than this leave elements without width in double precision.
    let ratio = annulus.radial_grading.ln() * (annulus.radial_elements as f64 - 1.0);
    if ratio.abs() > 1e6f64.ln() {
        mesh.reject(
            "radial_grading",
            format!(
                "mesh.radial_grading = {} makes the largest element {:.1e} times the smallest",
                annulus.radial_grading,
                ratio.abs().exp()
            ),
            "at most a factor 1e6 over all elements",
            "bring mesh.radial_grading nearer to 1",
        );
    }
}

pub(super) fn material(root: &Section<'_>, tables: &mut TableFiles<'_>) -> TabledMaterial {
    let section = root.section("material", true);
    let formulation = section.choice("formulation");
    let table = modulus_table(&section, tables);
    let own = RegionMaterial {
        elastic: elastic(&section, formulation, table.as_deref()),
        damping: None,
    };
    section.close();
    TabledMaterial { own, table }
}

pub(super) fn damping(root: &Section<'_>) -> Damping {
    let section = root.section("damping", false);
    let damping = Damping {
        rayleigh: RayleighDamping {
            mass_coefficient: section.number("mass_coefficient"),
            stiffness_coefficient: section.number("stiffness_coefficient"),
        },
        include_contact: section.flag("include_contact"),
    };
    section.close();
    damping
}
