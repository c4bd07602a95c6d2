//! The contacts of solid bodies: `[contacts.NAME]`, and `[contact]` with a rigid counterface.

use super::contact::{contact_stiffness, friction_decay, interference};
use super::tables::{TableFiles, topography};
use super::words::{BaseContact, CounterfaceWord};
use crate::*;
use frictionsim_physics::contact::Topography;

/// A contact with the names of its surfaces.
pub(super) struct NamedContact {
    /// Names of its surface, and of that which it slides on.
    pub sides: [Option<String>; 2],
    /// The keys that have these.
    pub keys: [String; 2],
    pub friction_coefficient: f64,
    pub base: BaseChoice,
    pub surfaces: SlidingSurfaces,
}

/// `[contact]` of solid bodies: one contact with a rigid counterface. `is_pressed`: a boundary has a pressure.
pub(super) fn short_form(section: &Section<'_>, is_pressed: bool) -> NamedContact {
    refuse_each!(section, "ring_inner_radius ring_outer_radius counter_boundary"; key =>
        "has no meaning for a mesh of solid elements"; "of other bodies";
        "leave it out; surfaces that slide on each other are named under [contacts.NAME]");
    let is_rigid_base = section.choice::<BaseContact>("base_state") == BaseContact::Rigid;
    refuse_if!(section.has("base_state") && is_rigid_base; section, "base_state",
        "contact.base_state = \"rigid\": the springs of a contact of solid bodies carry their base \
         state"; "not of a body from a mesh of solid elements"; "leave it out");
    let counterpart = Counterpart::Rigid(rigid_counterface(section, is_pressed));
    NamedContact {
        sides: [Some(section.text("boundary")), None],
        keys: ["contact.boundary".to_owned(), String::new()],
        friction_coefficient: section.number("friction_coefficient"),
        base: BaseChoice::default(),
        surfaces: SlidingSurfaces {
            name: SlidingSurfaces::SHORT_FORM.to_owned(),
            ..sliding_surfaces(section, counterpart, None)
        },
    }
}

/// One contact, without its name and its place in the mesh.
pub(super) fn contact(section: &Section<'_>, tables: &TableFiles<'_>) -> NamedContact {
    let base = section.choice("state");
    let topography = topography(section, tables);
    refuse_if!(base == BaseChoice::Closed && topography.is_some(); section, "gap" =>
        "has no effect on a contact that is closed and free of stress"; "beside state = \"closed\"";
        "leave one of the two out");
    let counter = section.optional_text("counter");
    let counterpart = match section.has("counterface") {
        true => Counterpart::Rigid(rigid_counterface(section, false)),
        false => {
            let idle =
                "axis center direction radius speed rotation_speed_rpm interference normal_force";
            refuse_each!(section, idle; key => "is for a rigid counterface"; "needs counterface";
                "leave it out; a rigid counterface has `counterface` in place of `counter`, with \
                 direction and speed, or with rotation_speed_rpm");
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
        sides: [Some(section.text("surface")), counter],
        keys: ["surface", "counter"].map(|key| section.name(key)),
        friction_coefficient: section.number("friction_coefficient"),
        base,
        surfaces: sliding_surfaces(section, counterpart, topography),
    }
}

/// Friction and stiffness of a contact.
fn sliding_surfaces(
    section: &Section<'_>,
    counter: Counterpart,
    topography: Option<Arc<Topography>>,
) -> SlidingSurfaces {
    let decay = friction_decay(section);
    SlidingSurfaces {
        name: String::new(),
        surface: 0,
        counter,
        friction: PairFriction { ratio: 1.0, decay },
        stiffness: contact_stiffness(section, true),
        topography,
    }
}

/// Reads `counterface` with its place, motion and interference.
pub(super) fn rigid_counterface(section: &Section<'_>, is_pressed: bool) -> RigidCounterface {
    let word: CounterfaceWord = section.choice("counterface");
    let radius = section.optional_number("radius");
    let shape = match word {
        CounterfaceWord::Plane => RigidShape::Plane,
        CounterfaceWord::Cylinder => RigidShape::Cylinder(radius),
        CounterfaceWord::Sphere => RigidShape::Sphere(radius),
        CounterfaceWord::Body => {
            refuse!(section, "counterface" => "= \"body\" is for two plane bodies";
                "the mesh is of solid elements";
                "name the surfaces that slide on each other under [contacts.NAME], as `surface` and `counter`");
            RigidShape::Plane
        }
    };
    caution_if!(shape == RigidShape::Plane && radius.is_some(); section, "radius" =>
        "is not used: the counterface is a plane"; "no effect");
    RigidCounterface {
        shape,
        center: section.vector("center"),
        axis: unit(section, "axis"),
        motion: motion(section),
        interference: interference(section, is_pressed),
    }
}

/// Along a straight line where `speed` or `direction` is given, else about the axis.
fn motion(section: &Section<'_>) -> RigidMotion {
    let speed = section.optional_number("speed");
    if speed.is_none() && !section.has("direction") {
        return RigidMotion::Turning(section.number("rotation_speed_rpm") * TAU / 60.0);
    }
    refuse_each!(section, "rotation_speed_rpm"; key,
        "the counterface turns about its axis or slides along a straight line, not both";
        "beside `speed` or `direction`";
        "leave rotation_speed_rpm out, or `speed` and `direction`");
    let speed = speed.unwrap_or_else(|| section.number("speed"));
    if !section.has("direction") {
        section.no_vector::<3>("direction", "is missing beside `speed`");
    }
    RigidMotion::Sliding(unit(section, "direction").map(|x| x * speed))
}

/// The vector of length one along that of a key.
pub(super) fn unit(section: &Section<'_>, key: &str) -> [f64; 3] {
    let direction = Vector3::from(section.vector(key));
    if direction.norm() == 0.0 {
        refuse!(section, key => "= [0, 0, 0] points nowhere"; "must not be zero");
        return [0.0, 0.0, 1.0];
    }
    direction.normalize().into()
}
