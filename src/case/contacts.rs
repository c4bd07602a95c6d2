//! The contacts of solid bodies: `[contacts.NAME]`, and `[contact]` with a rigid counterface.

use super::contact::{friction_decay, no_rigid_losses};
use super::elastic::loss_factor;
use super::normal_law::normal_law;
use super::reader::Section;
use super::refuse;
use super::rigid_counterface::rigid_counterface;
use super::tables::{TableFiles, topography};
use super::words::BaseContact;
use crate::contact::{ContactStiffness, Counterpart, PairFriction, Topography};
use crate::prestress::{BaseChoice, SlidingSurfaces};
use std::sync::Arc;

/// A contact with the names of its surfaces.
pub(super) struct NamedContact {
    pub name: String,
    /// Names of its surface, and of that which it slides on.
    pub sides: [Option<String>; 2],
    /// The keys that have these.
    pub keys: [String; 2],
    pub friction_coefficient: f64,
    pub surfaces: SlidingSurfaces,
}

/// `[contact]` of solid bodies: one contact with a rigid counterface.
pub(super) fn short_form(section: &Section<'_>) -> NamedContact {
    for key in ["ring_inner_radius", "ring_outer_radius"] {
        refuse_generated(section, key, section.optional_number(key).is_some());
    }
    let key = "counter_boundary";
    refuse_generated(section, key, section.optional_text(key).is_some());
    let is_rigid_base = section.choice::<BaseContact>("base_state") == BaseContact::Rigid;
    if section.has("base_state") && is_rigid_base {
        refuse!(section, "base_state",
            "contact.base_state = \"rigid\": the springs of a contact of solid bodies carry their \
             base state";
            "not of a body from a mesh of solid elements"; "leave it out");
    }
    let boundary = section.optional_text("boundary");
    let boundary = boundary.unwrap_or_else(|| "inner".to_owned());
    let counterpart = Counterpart::Rigid(rigid_counterface(section));
    NamedContact {
        name: SlidingSurfaces::SHORT_FORM.to_owned(),
        sides: [Some(boundary), None],
        keys: ["contact.boundary".to_owned(), String::new()],
        friction_coefficient: section.number("friction_coefficient"),
        surfaces: sliding_surfaces(section, counterpart, None),
    }
}

/// Refuses a key of `[contact]` that other bodies have.
fn refuse_generated(section: &Section<'_>, key: &str, is_given: bool) {
    if is_given {
        refuse!(section, key => "has no meaning for a mesh of solid elements"; "of other bodies";
            "leave it out; surfaces that slide on each other are named under [contacts.NAME]");
    }
}

/// One contact, without its name and its place in the mesh.
pub(super) fn contact(
    section: &Section<'_>,
    bases: &mut Vec<BaseChoice>,
    tables: &mut TableFiles<'_>,
) -> NamedContact {
    let base = section.choice("state");
    bases.push(base);
    let topography = topography(section, tables);
    if base == BaseChoice::Closed && topography.is_some() {
        refuse!(section, "gap" => "has no effect on a contact that is closed and free of stress";
            "beside state = \"closed\""; "leave one of the two out");
    }
    let counter = section.optional_text("counter");
    let counterpart = match section.has("counterface") {
        true => Counterpart::Rigid(rigid_counterface(section)),
        false => {
            refuse_idle(section);
            Counterpart::Surface(0)
        }
    };
    match (&counterpart, &counter) {
        (Counterpart::Surface(_), None) => section.missing("counter"),
        (Counterpart::Rigid(_), Some(_)) => refuse!(section, "counter" =>
            "beside a rigid counterface"; "one of the two";
            "leave `counter` out, or `counterface`"),
        _ => {}
    }
    NamedContact {
        name: String::new(),
        sides: [Some(section.text("surface")), counter],
        keys: ["surface", "counter"].map(|key| section.name(key)),
        friction_coefficient: section.number("friction_coefficient"),
        surfaces: sliding_surfaces(section, counterpart, topography),
    }
}

/// Refuses the keys of a rigid counterface where there is none.
fn refuse_idle(section: &Section<'_>) {
    for key in ["axis", "center", "direction"] {
        let _ = section.numbers(key);
    }
    for key in ["radius", "speed", "rotation_speed_rpm", "interference", "normal_force"] {
        let _ = section.optional_number(key);
    }
    let idle = [
        "axis",
        "center",
        "direction",
        "radius",
        "speed",
        "rotation_speed_rpm",
        "interference",
        "normal_force",
    ];
    for key in idle.iter().filter(|key| section.has(key)) {
        refuse!(section, key => "is for a rigid counterface"; "needs counterface";
            "give counterface = \"plane\", \"cylinder\" or \"sphere\" in place of `counter`, or \
             leave it out");
    }
}

/// Friction and stiffness of a contact.
fn sliding_surfaces(
    section: &Section<'_>,
    counter: Counterpart,
    topography: Option<Arc<Topography>>,
) -> SlidingSurfaces {
    let decay = friction_decay(section);
    let stiffness = ContactStiffness {
        normal_stiffness: section.optional_number("normal_stiffness"),
        normal_damping: section.number("normal_damping"),
        tangential_damping: section.number("tangential_damping"),
        is_base_compliant: true,
        loss_factor: loss_factor(section),
        ..ContactStiffness::default()
    };
    let (law, stiffness) = normal_law(section, stiffness);
    if stiffness.normal_stiffness.is_none() {
        no_rigid_losses(section, &stiffness);
    }
    if stiffness.normal_stiffness.is_none() && stiffness.normal_damping > 0.0 {
        refuse!(section, "normal_damping" => "has no effect on a rigid contact";
            "needs normal_stiffness"; "give normal_stiffness, or leave normal_damping out");
    }
    SlidingSurfaces {
        name: String::new(),
        surface: 0,
        counter,
        friction: PairFriction { ratio: 1.0, decay },
        stiffness,
        law,
        topography,
    }
}
