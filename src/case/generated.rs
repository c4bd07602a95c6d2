//! Bodies that the case's own numbers make: `[geometry]` and the element counts of `[mesh]`.

use super::assembly;
use super::attachments;
use super::body::{Annulus, Body, Revolution, node_count};
use super::boundaries::{self, NamedCondition};
use super::contact::{Contact, contact};
use super::elastic::{Surroundings, place_axes};
use super::imported;
use super::modifications::{self, Modification};
use super::reader::Section;
use super::refuse;
use super::shaft;
use super::solid;
use super::tables::TableFiles;
use super::whole_revolution::whole_revolution;
use crate::contact::Motion;
use crate::fem::{ElasticMaterial, RotationFrame, TabledMaterial};
use crate::mesh::{AnnulusSpecification, BoundaryCondition, SolidSpecification};

/// The generated body with what its modifications take away or move, and its contact. Closes both sections.
pub(super) fn generated(
    root: &Section<'_>,
    [geometry, mesh]: [Section<'_>; 2],
    (conditions, is_pressed): (&[NamedCondition], bool),
    (common, tables): (&mut TabledMaterial, &mut TableFiles<'_>),
    (thickness, changes): (f64, &[Modification]),
) -> (Option<Body>, Contact) {
    let material = &mut common.own.elastic;
    let is_solid = solid::is_solid(material);
    imported::refuse_sectors(&mesh);
    let axial = solid::axial_elements(&geometry, &mesh, is_solid);
    let sectors = Surroundings::Sectors { is_plane: !is_solid };
    place_axes(root, &["material"], material, &sectors);
    let parts = (conditions, is_solid);
    let (mut annulus, mut shaft) =
        annulus(root, [&geometry, &mesh], parts, (material, &mut *tables));
    if let Some(shaft) = &mut shaft {
        let path = ["materials", "shaft"];
        place_axes(root, &path, &mut shaft.own.elastic, &sectors);
    }
    geometry.close();
    mesh.close();
    let (mut contact, place) = contact(root, Some((&annulus, is_solid)), is_pressed);
    let motion = motion(root, is_solid);
    let turning = motion.as_ref().map_or(0.0, |own| own.spin_vector().z);
    let body = match axial {
        None => {
            let materials = std::iter::once(common.clone()).chain(shaft).collect();
            plane_annulus(root, Annulus { specification: annulus, materials }, changes)
        }
        Some(axial_elements) => {
            let conditions = solid::conditions(root, conditions, place.solid);
            annulus.outer = conditions[1];
            let mut specification = SolidSpecification {
                annulus,
                thickness,
                axial_elements,
                contact: place.solid,
                conditions,
                parts: Vec::new(),
            };
            let mut materials = vec![common.clone()];
            for (part, mut material) in
                solid::parts(root, &common.own.elastic, tables, &specification)
            {
                let path = ["materials", &part.name];
                place_axes(root, &path, &mut material.own.elastic, &sectors);
                specification.parts.push(part);
                materials.push(material);
            }
            let specification = Box::new(specification);
            let revolution = Revolution { specification, materials };
            revolution_body(root, revolution, (&contact, motion), changes)
        }
    };
    // Friction knows the relative speed.
    contact.sliding.rotation_speed -= turning;
    (body, contact)
}

/// `[motion.disc]`: how the whole body turns about its own axis. In the plane it is held, and what is inside turns.
fn motion(root: &Section<'_>, is_solid: bool) -> Option<Motion> {
    let motions = root.each("motion", assembly::motion);
    let section = root.section("motion", false);
    for (name, own) in &motions {
        if !is_solid {
            refuse!(root, "motion", "the built-in plane annulus has no [motion.*]: it is held, and \
                 its cylinder or shaft turns"; "a plane annulus is held";
                "a disc that turns needs material.formulation = \"three-dimensional\"");
        } else if name != "disc" || [own.axis, own.center].iter().any(|v| v[..2] != [0.0; 2]) {
            refuse!(section, name => "is no motion of a body of revolution, which turns as a whole";
                "not about its axis"; "give [motion.disc] with axis = [0.0, 0.0, 1.0] alone");
        } else if own.inertia == Some(RotationFrame::Rest) {
            refuse!(section, name => "counts its inertia at rest, but its damping in its own frame";
                "two frames"; "give frame = \"turning\": waves stand n Omega beside those at rest");
        }
    }
    motions.into_iter().next().map(|own| own.1)
}

/// A body of revolution, as a whole mesh where it turns, where modifications break its symmetry, where its losses have
/// a chain of dashpots in time, and where that is asked for.
fn revolution_body(
    root: &Section<'_>,
    revolution: Revolution,
    (contact, motion): (&Contact, Option<Motion>),
    changes: &[Modification],
) -> Option<Body> {
    let cea = root.section("cea", false);
    let is_asked_for = cea.is_text("method", "sparse")
        || root.section("transient", false).is_text("operator", "sparse");
    let body = Body::Revolution(revolution.clone());
    let is_lossy = body.has_structural_damping() || contact.stiffness.loss_factor > 0.0;
    let is_chained = is_lossy && root.has("transient");
    if changes.is_empty() && motion.is_none() && !is_asked_for && !is_chained {
        return Some(body);
    }
    let reject = |(key, why): modifications::Misfit| {
        let section = key.split('.').next().unwrap_or_default();
        root.reject(section, format!("{key}: {why}"), "does not fit the whole mesh", None);
    };
    let whole = whole_revolution(&revolution, contact, (motion, changes)).map_err(reject);
    whole.ok().map(Body::Assembly)
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
    attachments::reshaped_annulus(&annulus, changes).map_err(reject).ok().map(Body::Imported)
}

/// The specification of the annulus, and the material of its shaft where it has one.
fn annulus(
    root: &Section<'_>,
    [geometry, mesh]: [&Section<'_>; 2],
    (conditions, is_solid): (&[NamedCondition], bool),
    (material, tables): (&ElasticMaterial, &mut TableFiles<'_>),
) -> (AnnulusSpecification, Option<TabledMaterial>) {
    let inner_radius = geometry.number("inner_radius");
    let outer_radius = geometry.number("outer_radius");
    if outer_radius <= inner_radius {
        refuse!(geometry, "outer_radius",
            "geometry.outer_radius = {outer_radius} must be above geometry.inner_radius = \
             {inner_radius}";
            "must be above {inner_radius}"; "both are radii in metres; are they swapped?");
    }
    let shaft = match is_solid {
        false => shaft::shaft(root, [geometry, mesh], inner_radius, conditions, material, tables),
        true => None,
    };
    for (section, key) in [(geometry, "shaft_inner_radius"), (mesh, "shaft_radial_elements")] {
        if is_solid && !section.refused(key).is_empty() {
            refuse!(section, key, "a deformable shaft turns in a plane annulus only";
                "the body is three-dimensional"; "leave the shaft out, or use a plane formulation");
        }
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
        refuse!(mesh, "circumferential_elements",
            "the mesh would have {nodes} nodes, above the limit of {limit}"; "too many elements";
            "lower mesh.circumferential_elements or mesh.radial_elements");
    }
    // Sizes that differ by more than this leave elements without width in double precision.
    let ratio = annulus.radial_grading.ln() * (annulus.radial_elements as f64 - 1.0);
    if ratio.abs() > 1e6f64.ln() {
        refuse!(mesh, "radial_grading",
            "mesh.radial_grading = {} makes the largest element {:.1e} times the \
             smallest", annulus.radial_grading, ratio.abs().exp();
            "at most a factor 1e6 over all elements"; "bring mesh.radial_grading nearer to 1");
    }
}
