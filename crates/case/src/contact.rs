//! The section `[contact]`: what presses, the springs and how they stiffen with pressure, friction.

use super::words::{BaseContact, NormalLawWord};
use super::{elastic::loss_factor, imported, solid, value::quote};
use crate::*;
use frictionsim_physics::contact::{ContactStiffness, FrictionDecay, NormalLaw};

/// `[contact]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The rotating cylinder and its friction law.
    pub sliding: SlidingContact,
    /// Linearised contact of the eigenvalue analysis.
    pub stiffness: ContactStiffness,
}

/// The section of a contact.
pub(super) fn section_of(contact: &SlidingSurfaces) -> String {
    match contact.is_short_form() {
        true => "contact".to_owned(),
        false => format!("contacts.{}", quote(&contact.name)),
    }
}

/// The normal springs of a contact.
pub(super) struct Springs {
    /// The section of the contact.
    pub section: String,
    /// The key that their stiffness without pressure belongs to.
    pub key: String,
    /// What that stiffness is.
    pub name: String,
    /// It, Pa/m.
    pub stiffness: f64,
    /// How they stiffen.
    pub law: Option<NormalLaw>,
}

impl Case {
    /// The section of each contact, and its stiffness.
    pub(super) fn contact_sections(&self) -> Vec<(String, ContactStiffness)> {
        match self.body.assembly() {
            None => vec![("contact".to_owned(), self.contact.stiffness)],
            Some(body) => {
                body.contacts.iter().map(|own| (section_of(own), own.stiffness)).collect()
            }
        }
    }

    /// The springs of each contact that has them.
    pub(super) fn springs(&self) -> Vec<Springs> {
        let springs = self.contact_sections().into_iter().filter_map(|(section, own)| {
            let (key, over) = match own.law {
                Some(NormalLaw::Exponential { .. }) => ("reference_pressure", " / height"),
                _ => ("normal_stiffness", ""),
            };
            let (key, name) = (format!("{section}.{key}"), format!("{section}.{key}{over}"));
            Some(Springs { section, key, name, stiffness: own.normal_stiffness?, law: own.law })
        });
        springs.collect()
    }

    /// How a contact does without its springs: what needs them goes with them.
    pub(super) fn rigid_remedy(&self, springs: &Springs) -> String {
        let law = "normal_law cubic_stiffness reference_pressure height";
        let keys = law.split(' ').chain(["normal_damping", "loss_factor", "base_state"]);
        let keys = keys.map(|key| format!("{}.{key}", springs.section));
        let given: Vec<String> = keys.filter(|key| self.raw.find(key).is_some()).collect();
        let remedy = "use normal_stiffness = \"rigid\", which is exact";
        match given.is_empty() {
            true => remedy.to_owned(),
            false => format!("{remedy}, and leave {} out", given.join(", ")),
        }
    }
}

/// `annulus` is that of a generated body, with whether it is three-dimensional; `is_pressed` says whether a boundary
/// has a pressure of its own. Beside the contact stand the curves and the counterface of a body from a mesh file, and
/// where a rotor touches a three-dimensional body.
pub(super) fn contact(
    root: &Section<'_>,
    annulus: Option<(&AnnulusSpecification, bool)>,
    is_pressed: bool,
) -> (Contact, BodySpecification, SolidContact) {
    let section = root.section("contact", true);
    let (place, mut plane_speed) = imported::contact_place(&section);
    let (is_annulus, is_solid) = (annulus.is_some(), annulus.is_some_and(|given| given.1));
    let face = match annulus {
        Some((annulus, true)) => solid::contact(&section, annulus),
        _ => {
            refuse_each!(section, "ring_inner_radius ring_outer_radius"; key =>
                "is for a ring on the top face of a three-dimensional body"; "of other bodies";
                "leave it out");
            SolidContact::Inner
        }
    };
    if is_annulus {
        let keys = "boundary counter_boundary counterface center axis radius direction speed";
        let keys = if is_solid { keys.trim_start_matches("boundary") } else { keys };
        refuse_each!(section, keys; key, "contact.{key} is for a body from a mesh file (mesh.file)";
            "not used by the built-in annulus"; "leave it out");
        plane_speed = None;
    }
    let interference = interference(&section, is_pressed);
    // A pressure on a face may press a three-dimensional body; on a plane annulus it is an error of its own.
    refuse_if!(!is_solid && interference == 0.0 && !is_pressed; section, "interference",
        "contact.interference = 0.0 must be positive and finite"; "must be positive and finite";
        "without it nothing presses the body");
    let rotation_speed = match plane_speed {
        Some(speed) => {
            let _ = section.optional_number("rotation_speed_rpm");
            speed
        }
        None => section.number("rotation_speed_rpm") * TAU / 60.0,
    };
    let is_at_rest = rotation_speed == 0.0 && !root.has("motion");
    refuse_if!(is_solid && is_at_rest && section.has("rotation_speed_rpm"); section,
        "rotation_speed_rpm",
        "contact.rotation_speed_rpm = 0: a counterface at rest has no steady sliding. Friction \
         then holds a three-dimensional body across the sliding as an infinite dashpot (mu p / V) \
         does"; "must not be zero in three dimensions"; "give a small positive speed instead");
    let is_compliant = section.choice::<BaseContact>("base_state") == BaseContact::Compliant;
    let stiffness = contact_stiffness(&section, is_compliant);
    let is_rigid = stiffness.normal_stiffness.is_none();
    let contact = Contact {
        sliding: SlidingContact {
            decay: friction_decay(&section),
            friction_coefficient: section.number("friction_coefficient"),
            interference,
            rotation_speed,
        },
        stiffness,
    };
    if stiffness.is_base_compliant && (is_rigid || !is_solid) {
        let [label, help] = match is_solid {
            true => ["needs contact.normal_stiffness", "give it, or leave base_state out"],
            false => ["is for three-dimensional bodies", "plane bodies have a rigid base state"],
        };
        refuse!(section, "base_state", "contact.base_state = \"compliant\" {label}"; "{label}";
            "{help}");
    }
    section.close();
    (contact, place, face)
}

/// The springs and dashpots of a contact, and how they stiffen; one without springs loses nothing in them.
pub(super) fn contact_stiffness(section: &Section<'_>, is_compliant: bool) -> ContactStiffness {
    let given = section.optional_number("normal_stiffness");
    let stiffness = ContactStiffness {
        normal_damping: section.number("normal_damping"),
        tangential_damping: section.number("tangential_damping"),
        is_base_compliant: is_compliant,
        loss_factor: loss_factor(section),
        ..ContactStiffness::default()
    };
    let law = law(section, given);
    let normal_stiffness = law.map(|law| law.stiffness(0.0)).or(given);
    let idle = [
        ("normal_damping", stiffness.normal_damping, ""),
        ("loss_factor", stiffness.loss_factor, ", which stores no energy"),
    ];
    for (key, value, why) in idle {
        refuse_if!(normal_stiffness.is_none() && value > 0.0; section, key =>
            "= {value} has no effect on a rigid contact{why}"; "needs normal_stiffness";
            "give normal_stiffness, or leave {key} out");
    }
    ContactStiffness { normal_stiffness, law, ..stiffness }
}

/// How friction falls with the slip speed; a ratio of one is a constant coefficient.
pub(super) fn friction_decay(section: &Section<'_>) -> Option<FrictionDecay> {
    let static_ratio = section.number("static_friction_ratio");
    let decay_speed = section.optional_number("decay_speed");
    let decay = decay_speed.map(|decay_speed| FrictionDecay { static_ratio, decay_speed });
    refuse_if!(static_ratio > 1.0 && !section.has("decay_speed"); section,
        "static_friction_ratio" => "= {static_ratio} needs decay_speed"; "falls over no speed";
        "give the speed over which friction falls, for example decay_speed = 0.2");
    refuse_if!(decay.is_some() && !section.has("static_friction_ratio"); section, "decay_speed",
        "contact.decay_speed has no effect without contact.static_friction_ratio";
        "friction does not fall";
        "give static friction over kinetic, for example static_friction_ratio = 1.4, or leave decay_speed out");
    decay.filter(|decay| decay.static_ratio > 1.0)
}

/// Interference that the search begins with, m; any other leads to the same root.
const START: f64 = 1e-6;

/// The interference of a contact as a section gives it; none where it is left out and a boundary pressure presses.
/// Where a force presses, a stand-in until the body is known.
pub(super) fn interference(section: &Section<'_>, is_pressed: bool) -> f64 {
    let given = section.optional_number("interference");
    if section.optional_number("normal_force").is_none() {
        let otherwise = || if is_pressed { 0.0 } else { section.number("interference") };
        return given.unwrap_or_else(otherwise);
    }
    if section.has("interference") {
        let key = section.name("interference");
        refuse!(section, "normal_force" => "beside {key}"; "one of the two presses";
            "leave {key} out, or the force");
    }
    refuse_if!(is_pressed; section, "normal_force" => "beside a boundary with a pressure";
        "one of the two presses"; "leave the force out, or the pressure");
    START
}

/// The keys of a contact's law of pressure, and which of them each law has.
const LAW_KEYS: [(&str, &[NormalLawWord]); 4] = [
    ("normal_stiffness", &[NormalLawWord::Linear, NormalLawWord::Cubic]),
    ("cubic_stiffness", &[NormalLawWord::Cubic]),
    ("reference_pressure", &[NormalLawWord::Exponential]),
    ("height", &[NormalLawWord::Exponential]),
];

/// How a contact of some stiffness stiffens with pressure.
fn law(section: &Section<'_>, stiffness: Option<f64>) -> Option<NormalLaw> {
    let word: NormalLawWord = section.choice("normal_law");
    for (key, laws) in LAW_KEYS {
        refuse_if!(!laws.contains(&word) && section.has(key); section, key =>
            "has no effect with normal_law = \"{}\"", word.word(); "not a number of this law";
            "leave it out, or give the law that it belongs to");
        if laws.contains(&word) && word != NormalLawWord::Linear {
            section.needs(key);
        }
        refuse_if!(word == NormalLawWord::Cubic && section.is_text(key, "rigid"); section, key =>
            "= \"rigid\" does not stiffen: normal_law = \"cubic\" is k g + c g^3, with k the \
             normal stiffness"; "needs a number"; "give k in Pa/m, or leave normal_law out");
    }
    // What another law would take is told above, and read.
    let [cubic_stiffness, reference_pressure, height] =
        ["cubic_stiffness", "reference_pressure", "height"].map(|key| section.optional_number(key));
    Some(match word {
        NormalLawWord::Linear => return None,
        NormalLawWord::Cubic => {
            NormalLaw::Cubic { stiffness: stiffness?, cubic_stiffness: cubic_stiffness? }
        }
        NormalLawWord::Exponential => {
            NormalLaw::Exponential { reference_pressure: reference_pressure?, height: height? }
        }
    })
}
