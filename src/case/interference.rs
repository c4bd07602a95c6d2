//! How far a counterface is pushed in, as a section gives it.

use super::reader::Section;
use super::refuse;

/// Interference that the search begins with, m; any other leads to the same root.
const START: f64 = 1e-6;

/// The interference of a contact as a section gives it; a stand-in where a force presses, until the body is known.
pub(super) fn interference(section: &Section<'_>) -> f64 {
    let force = section.optional_number("normal_force");
    if force.is_none() {
        return section.number("interference");
    }
    let _ = section.optional_number("interference");
    if section.has("interference") {
        let key = section.name("interference");
        refuse!(section, "normal_force" => "beside {key}"; "one of the two presses";
            "leave {key} out, or the force");
    }
    START
}
