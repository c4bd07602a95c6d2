//! The section `[contact]`.

use super::elastic::loss_factor;
use super::imported::{self, ContactPlace};
use super::interference::interference;
use super::normal_law::normal_law;
use super::reader::Section;
use super::refuse;
use super::solid;
use super::words::BaseContact;
use crate::contact::{ContactStiffness, FrictionDecay, NormalLaw, SlidingContact};
use crate::mesh::AnnulusSpecification;
use std::f64::consts::TAU;

/// `[contact]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The rotating cylinder and its friction law.
    pub sliding: SlidingContact,
    /// Linearised contact of the eigenvalue analysis.
    pub stiffness: ContactStiffness,
}

impl Contact {
    /// The key that its normal stiffness without pressure belongs to.
    pub(super) fn stiffness_key(&self) -> &'static str {
        match self.stiffness.law {
            Some(NormalLaw::Exponential { .. }) => "contact.reference_pressure",
            Some(NormalLaw::Cubic { .. }) | None => "contact.normal_stiffness",
        }
    }

    /// What it is.
    pub(super) fn stiffness_name(&self) -> &'static str {
        match self.stiffness.law {
            Some(NormalLaw::Exponential { .. }) => "contact.reference_pressure / height",
            Some(NormalLaw::Cubic { .. }) | None => "contact.normal_stiffness",
        }
    }
}

/// `annulus` is that of a generated body, with whether it is three-dimensional; `is_pressed` says whether a boundary has a
/// pressure of its own.
pub(super) fn contact(
    root: &Section<'_>,
    annulus: Option<(&AnnulusSpecification, bool)>,
    is_pressed: bool,
) -> (Contact, ContactPlace) {
    let section = root.section("contact", true);
    let mut place = imported::contact_place(&section);
    let (is_annulus, is_solid) = (annulus.is_some(), annulus.is_some_and(|given| given.1));
    if let Some((annulus, is_solid)) = annulus {
        place.solid = solid::contact(&section, annulus, is_solid);
    } else {
        let _ = ["ring_inner_radius", "ring_outer_radius"].map(|key| section.optional_number(key));
    }
    if is_annulus {
        for key in [
            "boundary",
            "counter_boundary",
            "counterface",
            "center",
            "axis",
            "radius",
            "direction",
            "speed",
        ] {
            // A default written out changes nothing.
            let is_default = section.is_text(key, "inner") || section.is_text(key, "cylinder");
            let is_face = is_solid && key == "boundary";
            if section.has(key) && !is_default && !is_face {
                refuse!(section, key, "contact.{key} is for a body from a mesh file (mesh.file)";
                    "not used by the built-in annulus"; "leave it out");
            }
        }
        place.plane_speed = None;
    }
    let interference = interference(&section);
    if is_pressed && section.has("normal_force") {
        refuse!(section, "normal_force", "contact.normal_force beside a boundary with a pressure";
            "one of the two presses"; "leave the force out, or the pressure");
    }
    // A pressure on a face may press a three-dimensional body; on a plane annulus it is an error of its own.
    if !is_solid && interference == 0.0 && !is_pressed {
        refuse!(section, "interference", "contact.interference = 0.0 must be positive and finite";
            "must be positive and finite"; "without it nothing presses the body");
    }
    let rotation_speed = match place.plane_speed {
        Some(speed) => {
            let _ = section.optional_number("rotation_speed_rpm");
            speed
        }
        None => section.number("rotation_speed_rpm") * TAU / 60.0,
    };
    if is_solid && rotation_speed == 0.0 && section.has("rotation_speed_rpm") {
        refuse!(section, "rotation_speed_rpm",
            "contact.rotation_speed_rpm = 0: at rest friction holds a three-dimensional body \
             across the sliding too, as by an infinite dashpot (mu p / V): there is no steady \
             sliding";
            "must not be zero in three dimensions"; "give a small positive speed instead");
    }
    let stiffness = ContactStiffness {
        normal_stiffness: section.optional_number("normal_stiffness"),
        normal_damping: section.number("normal_damping"),
        tangential_damping: section.number("tangential_damping"),
        is_base_compliant: section.choice::<BaseContact>("base_state") == BaseContact::Compliant,
        loss_factor: loss_factor(&section),
        ..ContactStiffness::default()
    };
    let (law, stiffness) = normal_law(&section, stiffness);
    let contact = Contact {
        sliding: SlidingContact {
            decay: friction_decay(&section),
            friction_coefficient: section.number("friction_coefficient"),
            interference,
            rotation_speed,
        },
        stiffness: ContactStiffness { law, ..stiffness },
    };
    let stiffness = &contact.stiffness;
    let is_rigid = law.is_none()
        && (!section.has("normal_stiffness") || section.is_text("normal_stiffness", "rigid"));
    if is_rigid && stiffness.normal_damping > 0.0 {
        refuse!(section, "normal_damping",
            "contact.normal_damping = {} has no effect on a rigid \
             contact", stiffness.normal_damping;
            "needs contact.normal_stiffness";
            "give contact.normal_stiffness, or leave normal_damping out");
    }
    if is_rigid {
        no_rigid_losses(&section, stiffness);
    }
    if stiffness.is_base_compliant && (is_rigid || !is_solid) {
        let [label, help] = match is_solid {
            true => ["needs contact.normal_stiffness", "give it, or leave base_state out"],
            false => ["is for three-dimensional bodies", "plane bodies have a rigid base state"],
        };
        let message = format!("contact.base_state = \"compliant\" {label}");
        section.reject("base_state", message, label.to_owned(), Some(help.to_owned()));
    }
    section.close();
    (contact, place)
}

/// A contact without springs loses nothing in them.
pub(super) fn no_rigid_losses(section: &Section<'_>, stiffness: &ContactStiffness) {
    if stiffness.loss_factor > 0.0 {
        refuse!(section, "loss_factor" =>
            "has no effect on a rigid contact, which stores no energy"; "needs normal_stiffness";
            "give normal_stiffness, or leave loss_factor out");
    }
}

/// How friction falls with the slip speed; a ratio of one is a constant coefficient.
pub(super) fn friction_decay(section: &Section<'_>) -> Option<FrictionDecay> {
    let static_ratio = section.number("static_friction_ratio");
    let decay_speed = section.optional_number("decay_speed");
    let decay = decay_speed.map(|decay_speed| FrictionDecay { static_ratio, decay_speed });
    if static_ratio > 1.0 && !section.has("decay_speed") {
        refuse!(section, "static_friction_ratio" => "= {static_ratio} needs decay_speed";
            "falls over no speed";
            "give the speed over which friction falls, for example decay_speed = 0.2");
    }
    if decay.is_some() && !section.has("static_friction_ratio") {
        refuse!(section, "decay_speed",
            "contact.decay_speed has no effect without contact.static_friction_ratio";
            "friction does not fall";
            "give static friction over kinetic, for example static_friction_ratio = 1.4, or leave \
             decay_speed out");
    }
    decay.filter(|decay| decay.static_ratio > 1.0)
}
