//! The other body of a contact between two bodies of a mesh file.

use super::reader::Section;
use super::words::CounterfaceWord;
use crate::contact::ContactInterface;
use crate::mesh::{BodySpecification, Mesh};

/// `contact.counter_boundary`, which only two bodies have.
pub(super) fn opposite_curve(section: &Section<'_>, word: CounterfaceWord) -> Option<String> {
    let key = "counter_boundary";
    let given = section.optional_text(key);
    let (message, help) = match (word, &given) {
        (CounterfaceWord::Body, None) => (
            "contact.counterface = \"body\" needs contact.counter_boundary",
            "name the physical curve of the other body",
        ),
        (CounterfaceWord::Cylinder | CounterfaceWord::Plane | CounterfaceWord::Sphere, Some(_)) => {
            (
                "contact.counter_boundary is for two bodies",
                "set contact.counterface = \"body\", or leave it out",
            )
        }
        _ => return given,
    };
    let label = "the curve of the other body".to_owned();
    section.reject(key, message.to_owned(), label, Some(help.to_owned()));
    None
}

/// Two bodies must have their curves before each other, at most as far into each other as the interference.
pub(super) fn check_meeting(
    mesh: &Mesh,
    body: &BodySpecification,
    interference: f64,
) -> Result<(), String> {
    let Some(other) = &body.opposite else {
        return Ok(());
    };
    let interface = ContactInterface::of(mesh);
    let name = &body.contact;
    if interface.is_empty() {
        return Err(format!(
            "no point of \"{name}\" (contact.boundary) has \"{other}\" (contact.counter_boundary) facing it: check the \
             curves, and contact.center, speed and direction"
        ));
    }
    let deepest =
        (0..interface.len()).min_by(|&a, &b| interface.gaps[a].total_cmp(&interface.gaps[b]));
    let Some(i) = deepest else { return Ok(()) };
    let size = interface.tributary_lengths[i];
    let depth = -interface.gaps[i];
    // A thousandth of an element is what faceted curves differ by.
    if depth > interference + 1e-3 * size {
        return Err(format!(
            "the bodies overlap: node {} of \"{name}\" lies {depth:.3e} m inside the other body, \
             more than contact.interference = {interference:e} m. Mesh them just touching, and let \
             contact.interference press them together",
            mesh.node_label(interface.nodes[i] as usize)
        ));
    }
    Ok(())
}
