//! Bodies of revolution in three dimensions: `material.formulation = "three-dimensional"`.

use super::{description::Description, imported, suggestion};
use crate::*;
use frictionsim_physics::mesh::SolidPart;

/// Elements over the thickness; `None` in the plane, where they are an error.
pub(super) fn axial_elements(own: &Description<'_>) -> Option<usize> {
    let Description { geometry, mesh, .. } = own;
    if !own.is_solid() {
        refuse_each!(mesh, "axial_elements"; key,
            "mesh.axial_elements has no effect on a plane body";
            "needs material.formulation = \"three-dimensional\"";
            "set that formulation and geometry.thickness, or leave mesh.axial_elements out");
        return None;
    }
    refuse_if!(!geometry.has("thickness"); geometry, "thickness",
        "geometry.thickness is missing: a three-dimensional body needs one";
        "no thickness to divide into mesh.axial_elements";
        "give it in metres, for example thickness = 0.009");
    Some(mesh.count("axial_elements"))
}

/// `contact.boundary` of a three-dimensional body and the radii of a ring.
pub(super) fn contact(section: &Section<'_>, annulus: &AnnulusSpecification) -> SolidContact {
    let keys = ["ring_inner_radius", "ring_outer_radius"];
    let radii = keys.map(|key| section.optional_number(key));
    if !section.is_text("boundary", "top") {
        for key in keys {
            refuse_if!(section.has(key); section, key, "contact.{key} is for a ring on the top face";
                "needs contact.boundary = \"top\""; "set it, or leave {key} out");
        }
        if section.has("boundary") && !section.is_text("boundary", "inner") {
            let given = section.text("boundary");
            let near = suggestion::nearest(&given, ["inner", "top"].into_iter());
            let message =
                "contact.boundary of a three-dimensional body is \"inner\" or \"top\"".to_owned();
            let help = near.map(|near| format!("did you mean \"{near}\"?"));
            section.reject("boundary", message, "no such face of contact", help);
        }
        return SolidContact::Inner;
    }
    let (low, high) = (annulus.inner_radius, annulus.outer_radius);
    let [inner, outer] = [radii[0].unwrap_or(low), radii[1].unwrap_or(high)];
    for (key, value) in keys.into_iter().zip([inner, outer]) {
        refuse_if!(!(value >= low && value <= high) && high > low; section, key,
            "contact.{key} = {value} lies outside the face, which reaches from {low} to {high} m";
            "between {low} and {high}";
            "a ring lies between geometry.inner_radius and geometry.outer_radius");
    }
    refuse_if!(inner >= outer; section, "ring_outer_radius",
        "contact.ring_outer_radius = {outer} must be above contact.ring_inner_radius = {inner}";
        "must be above {inner}"; "are they swapped?");
    SolidContact::Ring { inner_radius: inner, outer_radius: outer }
}

/// `[materials.*]`: parts of a body between radii and heights, which no element crosses, with their materials.
pub(super) fn parts(
    own: &Description<'_>,
    body: &SolidSpecification,
) -> Vec<(SolidPart, RegionMaterial)> {
    let radii = body.corner_radii().unwrap_or_default();
    let height = |layer: usize| body.thickness * layer as f64 / body.axial_elements as f64;
    let heights: Vec<f64> = (0..=body.axial_elements).map(height).collect();
    let found = own.root.each("materials", |section| {
        let material = imported::material(own, section);
        refuse_if!(!section.has("radii") && !section.has("heights"); section, "radii",
            "{} needs the radii or the heights between which it lies", section.name("radii");
            "lies nowhere"; "describe the rest of the body in [material]");
        let range = |key: &str, lines: &[f64]| {
            let whole = [lines.first(), lines.last()].map(|end| end.copied().unwrap_or(0.0));
            let given = section.numbers(key);
            let [from, to] = match given.as_deref() {
                None => whole,
                Some(&[from, to]) if from < to => [from, to],
                Some(_) => {
                    refuse!(section, key => "needs two rising numbers"; "must be [from, to]";
                        "for example `{key} = {whole:?}`");
                    whole
                }
            };
            for end in [from, to] {
                let away = |line: &f64| (line - end).abs();
                let nearest = lines.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b)));
                if let Some(near) = nearest.filter(|near| away(near) > 1e-9 * whole[1]) {
                    refuse!(section, key, "{}: no elements meet at {end} m", section.name(key);
                        "crosses elements"; "the nearest border of elements is at {near} m: move \
                         it there, or change the element counts");
                }
            }
            [from, to]
        };
        (material, [range("radii", &radii), range("heights", &heights)])
    });
    let section = own.root.section("materials", false);
    let mut parts: Vec<(SolidPart, RegionMaterial)> = Vec::new();
    for (name, (material, [radii, heights])) in found {
        let meets = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a.max(c) < b.min(d);
        let covers = |own: &SolidPart| meets(own.radii, radii) && meets(own.heights, heights);
        let other = parts.iter().find(|(own, _)| covers(own)).map(|(own, _)| own.name.clone());
        if let Some(other) = other.or((name == "disc").then(|| "the rest".to_owned())) {
            refuse!(section, &name, "materials.{name} and {other} share a place or a name";
                "two materials in one"; "move one of the parts, or give it another name");
        }
        parts.push((SolidPart { name, radii, heights }, material));
    }
    parts
}

/// What holds each face, from `[boundaries.*]`; the outer one is clamped unless something else is said.
pub(super) fn conditions(own: &Description<'_>, contact: SolidContact) -> [BoundaryCondition; 4] {
    let section = own.root.section("boundaries", false);
    let mut conditions = [BoundaryCondition::Free; 4];
    conditions[1] = BoundaryCondition::Clamped;
    for (name, condition) in &own.conditions {
        let Some(face) = SolidFace::ALL.iter().position(|face| face.name() == name) else {
            refuse!(section, name, "a body of revolution has no boundary \"{name}\"";
                "it has \"inner\", \"outer\", \"top\" and \"bottom\""; "use one of these names");
            continue;
        };
        refuse_if!(SolidFace::ALL[face] == contact.face() && *condition != BoundaryCondition::Free;
            section, name,
            "boundaries.{name} is the face of contact: it can have no condition of its own";
            "the contact is here"; "leave the section out");
        conditions[face] = match *condition {
            BoundaryCondition::Fixed([true, true, true]) => BoundaryCondition::Clamped,
            other => other,
        };
        if let BoundaryCondition::Support(support) = &mut conditions[face]
            && SolidFace::ALL[face].normal_component() == 2
        {
            refuse_if!(support.axial_stiffness.is_some_and(|own| own > 0.0); section, name,
                "boundaries.{name}.axial_stiffness: along the axis a flat face has its normal";
                "has no effect on a flat face"; "give it as normal_stiffness");
            support.axial_stiffness = None;
        }
    }
    let holds_around = |own: &BoundaryCondition| {
        own.holds_turning() || matches!(own, BoundaryCondition::Fixed([x, y, _]) if *x || *y)
    };
    refuse_if!(!conditions.iter().any(holds_around); section, "outer",
        "nothing holds the body against the friction that turns it";
        "must hold a face tangentially";
        "use condition = \"clamped\" on a face, or \"support\" with tangential_stiffness above 0");
    // A cylinder in the bore holds nothing along the axis; a ring on the top presses it.
    let holds_along = |(face, condition): (SolidFace, &BoundaryCondition)| match condition {
        BoundaryCondition::Clamped => true,
        BoundaryCondition::Guide => face.normal_component() == 2,
        BoundaryCondition::Fixed([.., z]) => *z,
        BoundaryCondition::Support(support) if face.normal_component() == 2 => {
            support.normal_stiffness > 0.0
        }
        BoundaryCondition::Support(support) => support.axial_stiffness.is_some_and(|own| own > 0.0),
        _ => false,
    };
    let mut faces = SolidFace::ALL.into_iter().zip(&conditions);
    refuse_if!(contact == SolidContact::Inner && !faces.any(holds_along); section, "outer",
        "nothing holds the body along its axis"; "must hold a face axially";
        "give the support axial_stiffness above 0, or hold the top or the bottom face along its normal");
    conditions
}
