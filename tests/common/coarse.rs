//! Shipped bodies on coarse meshes, for what does not ask for their mesh.

use super::prelude::*;

/// The paper's disc as the text of a case: geometry, material, damping and contact at friction coefficient 0.3, and the sections that a test adds.
pub fn coarse_disc(sections: &str) -> String {
    disc_of([36, 6], sections)
}

/// The same on so many elements around and across.
pub fn disc_of([around, across]: [usize; 2], sections: &str) -> String {
    let text = include_str!("../commands/refused/coarse-disc.toml");
    let (disc, _) = text.split_once("[cea]").unwrap();
    let around = format!("circumferential_elements = {around}");
    let disc = disc.replace("circumferential_elements = 36", &around);
    disc.replace("radial_elements = 6", &format!("radial_elements = {across}")) + sections
}

/// Changes of `sliding-block.toml` that give it a mesh of 8 x 12 elements in `folder`; none in the long tier.
pub fn coarse_block(folder: &Path) -> String {
    let path = folder.join("block.msh");
    let mesh = plane_block([0.04, 0.06], [8, 12], ["face", "back", "block"]);
    std::fs::write(&path, mesh).unwrap();
    sized(format!("mesh.file={path:?} ; mesh.scale=1"), "mesh.scale=0.001".to_owned())
}
