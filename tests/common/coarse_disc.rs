//! The paper's disc on a coarse mesh as the text of a case, for commands that are run from end to end.

/// Geometry, material, damping and contact at friction coefficient 0.3, and the sections that a test adds.
pub fn coarse_disc(sections: &str) -> String {
    disc_of([36, 6], sections)
}

/// The same on so many elements around and across.
pub fn disc_of([around, across]: [usize; 2], sections: &str) -> String {
    let text = include_str!("../commands/refused/coarse-disc.toml");
    let (disc, _) = text.split_once("[cea]").unwrap();
    let around = format!("circumferential_elements = {around}");
    let across = format!("radial_elements = {across}");
    let disc = disc.replace("circumferential_elements = 36", &around);
    disc.replace("radial_elements = 6", &across) + sections
}
