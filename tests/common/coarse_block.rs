//! The shipped block on fewer elements, for what does not ask for its mesh.

use super::mesh_text::plane_block;
use super::tier::sized;
use std::path::Path;

/// Changes of `sliding-block.toml` that give it a mesh of 8 x 12 elements in `folder`; none in the long tier.
pub fn coarse_block(folder: &Path) -> String {
    let path = folder.join("block.msh");
    let mesh = plane_block([0.04, 0.06], [8, 12], ["face", "back", "block"]);
    std::fs::write(&path, mesh).unwrap();
    let coarse = format!("mesh.file=\"{}\" ; mesh.scale=1", path.display());
    sized(coarse, "mesh.scale=0.001".to_owned())
}
