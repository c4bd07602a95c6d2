//! Bodies that the case's own numbers make: `[geometry]` and the element counts of `[mesh]`, with a deformable shaft in
//! the annulus (`[materials.shaft]`, `[boundaries.bore]`).

use super::elastic::{Surroundings, place_axes};
use super::{
    Contact, assembly, attachments::reshaped_annulus, body::node_count, boundaries,
    contact::contact, description::Description, imported, modifications::Misfit, solid,
    whole_revolution::whole_revolution,
};
use crate::*;
use frictionsim_physics::mesh::ShaftSpecification;

/// The generated body with what its modifications take away or move, and its contact. Closes both sections.
pub(super) fn generated(own: &mut Description<'_>) -> (Option<Body>, Contact) {
    let (root, is_solid) = (own.root, own.is_solid());
    refuse_if!(own.mesh.optional_count("sectors").is_some(); own.mesh, "sectors",
        "mesh.sectors is for a mesh file (mesh.file) that has one sector of the body";
        "a generated body is made of sectors anyway"; "leave it out");
    let axial = solid::axial_elements(own);
    let axis = Ok([[0.0, 0.0, 1.0], [0.0; 3]]);
    let sectors = Surroundings { axis, is_plane: !is_solid, has_sectors: true };
    place_axes(root, &["material"], &mut own.common.elastic, &sectors);
    let (mut annulus, mut shaft) = annulus(own);
    if let Some(shaft) = &mut shaft {
        place_axes(root, &["materials", "shaft"], &mut shaft.elastic, &sectors);
    }
    own.geometry.close();
    own.mesh.close();
    let (mut contact, _, face) = contact(root, Some((&annulus, is_solid)), own.is_pressed());
    let motion = motion(root, is_solid);
    let turning = motion.as_ref().map_or(0.0, |own| own.spin_vector().z);
    let body = match axial {
        None => {
            let materials = std::iter::once(own.common.clone()).chain(shaft).collect();
            // Modifications break its symmetry; what is wrong with the counts is said elsewhere.
            let kind = if own.modifications.is_empty() || node_count(&annulus) > 1 << 24 {
                Some(BodyKind::Annulus(annulus))
            } else {
                let whole = reshaped_annulus(&annulus, &own.modifications);
                fitting(root, whole, "the disc").map(BodyKind::Imported)
            };
            kind.map(|kind| Body { materials, kind })
        }
        Some(axial_elements) => {
            let conditions = solid::conditions(own, face);
            annulus.outer = conditions[1];
            let mut specification = SolidSpecification {
                annulus,
                thickness: own.thickness,
                axial_elements,
                contact: face,
                conditions,
                parts: Vec::new(),
            };
            let mut materials = vec![own.common.clone()];
            for (part, mut material) in solid::parts(own, &specification) {
                place_axes(root, &["materials", &part.name], &mut material.elastic, &sectors);
                specification.parts.push(part);
                materials.push(material);
            }
            let kind = BodyKind::Revolution(Box::new(specification));
            revolution_body(own, Body { materials, kind }, &contact, motion)
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

/// A body of revolution, as a whole mesh where it turns, where modifications or a face that is held along x or y alone
/// break its symmetry, where its losses have a chain of dashpots in time, and where that is asked for.
fn revolution_body(
    own: &Description<'_>,
    body: Body,
    contact: &Contact,
    motion: Option<Motion>,
) -> Option<Body> {
    let root = own.root;
    let is_asked_for = root.section("cea", false).is_text("method", "sparse")
        || root.section("transient", false).is_text("operator", "sparse");
    let is_lossy = body.has_structural_damping() || contact.stiffness.loss_factor > 0.0;
    let is_chained = is_lossy && root.has("transient");
    let is_one_sided =
        |own: &BoundaryCondition| matches!(own, BoundaryCondition::Fixed([x, y, _]) if x != y);
    let is_uneven = body.revolution()?.conditions.iter().any(is_one_sided);
    let is_whole = is_uneven || is_asked_for || is_chained;
    if own.modifications.is_empty() && motion.is_none() && !is_whole {
        return Some(body);
    }
    let whole =
        whole_revolution(body.revolution()?, &body.materials, contact, motion, &own.modifications);
    fitting(root, whole, "the whole mesh")
}

/// A whole mesh; what of the case does not fit it is an error at its section.
fn fitting<T>(root: &Section<'_>, whole: Result<T, Misfit>, what: &str) -> Option<T> {
    let reject = |(key, why): Misfit| {
        let section = key.split('.').next().unwrap_or_default();
        refuse!(root, section, "{key}: {why}"; "does not fit {what}");
    };
    whole.map_err(reject).ok()
}

/// The specification of the annulus, and the material of its shaft where it has one.
fn annulus(own: &Description<'_>) -> (AnnulusSpecification, Option<RegionMaterial>) {
    let Description { root, geometry, mesh, conditions, .. } = own;
    let inner_radius = geometry.number("inner_radius");
    let outer_radius = geometry.number("outer_radius");
    refuse_if!(outer_radius <= inner_radius; geometry, "outer_radius",
        "geometry.outer_radius = {outer_radius} must be above geometry.inner_radius = \
         {inner_radius}"; "must be above {inner_radius}";
        "both are radii in metres; are they swapped?");
    let is_solid = own.is_solid();
    let shaft = if is_solid { None } else { shaft(own, inner_radius) };
    for (section, key) in [(geometry, "shaft_inner_radius"), (mesh, "shaft_radial_elements")] {
        refuse_if!(is_solid && !section.refused(key).is_empty(); section, key,
            "a deformable shaft turns in a plane annulus only"; "the body is three-dimensional";
            "leave the shaft out, or use a plane formulation");
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
    // Node indices are 32 bits wide, with room for two unknowns at each node.
    let (nodes, limit) = (node_count(&annulus), u128::from(u32::MAX / 2));
    refuse_if!(nodes > limit; mesh, "circumferential_elements",
        "the mesh would have {nodes} nodes, above the limit of {limit}"; "too many elements";
        "lower mesh.circumferential_elements or mesh.radial_elements");
    // Sizes that differ by more than this leave elements without width in double precision.
    let ratio = annulus.radial_grading.ln() * (annulus.radial_elements as f64 - 1.0);
    refuse_if!(ratio.abs() > 1e6f64.ln(); mesh, "radial_grading",
        "mesh.radial_grading = {} makes the largest element {:.1e} times the smallest",
        annulus.radial_grading, ratio.abs().exp();
        "at most a factor 1e6 over all elements"; "bring mesh.radial_grading nearer to 1");
    (annulus, shaft.map(|(_, material)| material))
}

/// The shaft, if the case has one, and its material.
fn shaft(own: &Description<'_>, reach: f64) -> Option<(ShaftSpecification, RegionMaterial)> {
    let Description { geometry, mesh, .. } = own;
    let bore = geometry.optional_number("shaft_inner_radius");
    let elements = mesh.optional_count("shaft_radial_elements");
    let found = materials(own, bore.is_some());
    let Some(bore) = bore else {
        refuse_if!(elements.is_some(); mesh, "shaft_radial_elements",
            "mesh.shaft_radial_elements is for a deformable shaft, and the case has none";
            "the cylinder is rigid";
            "give geometry.shaft_inner_radius and [materials.shaft], or leave it out");
        return None;
    };
    refuse_if!(bore >= reach; geometry, "shaft_inner_radius",
        "geometry.shaft_inner_radius = {bore} must be below geometry.inner_radius = \
         {reach}: the shaft reaches from its bore to the contact";
        "must be below {reach}");
    refuse_if!(found.is_none(); geometry, "shaft_inner_radius",
        "the shaft of geometry.shaft_inner_radius has no material"; "needs [materials.shaft]";
        "add [materials.shaft] with young_modulus, poisson_ratio and density, or leave \
         shaft_inner_radius out for a rigid cylinder");
    let given = own.conditions.iter().find(|(name, _)| name == "bore");
    let condition = given.map_or(BoundaryCondition::Clamped, |own| own.1);
    refuse_if!(!condition.holds_turning(); own.root.section("boundaries", false), "bore",
        "nothing holds the shaft against the friction that turns it";
        "must hold the bore tangentially";
        "use condition = \"clamped\", or \"support\" with tangential_stiffness above 0");
    let shaft = ShaftSpecification {
        inner_radius: bore,
        radial_elements: elements.unwrap_or_else(|| mesh.count("shaft_radial_elements")),
        bore: condition,
    };
    found.map(|material| (shaft, material))
}

/// `[materials.shaft]`; the annulus has no other surfaces.
fn materials(own: &Description<'_>, has_shaft: bool) -> Option<RegionMaterial> {
    let all = own.root.section("materials", false);
    for (name, _) in all.remaining() {
        match name {
            "shaft" if has_shaft => {}
            "shaft" => refuse!(all, name,
                "[materials.shaft] is for a deformable shaft, and the case has none";
                "the annulus has one material";
                "give geometry.shaft_inner_radius and mesh.shaft_radial_elements, or leave the section out"),
            _ => refuse!(all, name,
                "[materials.{name}] is for a physical surface of a mesh file (mesh.file)";
                "the annulus has one material";
                "describe the disc in [material] and a shaft in [materials.shaft]"),
        }
    }
    let mut shafts = imported::materials(own).into_iter().filter(|(name, _)| name == "shaft");
    shafts.next().map(|(_, material)| material)
}
