//! Meshes and modes as universal files.

use crate::prelude::*;
use frictionsim_signal::reader::{write_mesh, write_mode};

/// Writes units, nodes and elements of a mesh.
///
/// # Errors
/// Those of the writer; an element that universal files do not have (a pyramid).
pub fn write_universal_mesh(out: &mut dyn io::Write, mesh: &Mesh) -> io::Result<()> {
    let listed = (0..mesh.element_count()).map(|element| {
        let kind = mesh.element_kind(element);
        let (descriptor, nodes) = kind.universal(mesh.element_nodes(element)).ok_or_else(|| {
            let name = kind.name();
            io::Error::other(format!("universal files have no element like {name}"))
        })?;
        let labels = nodes.iter().map(|&node| mesh.node_label(node as usize));
        Ok((descriptor, labels.collect()))
    });
    let elements = listed.collect::<io::Result<Vec<_>>>()?;
    let nodes = (0..mesh.node_count()).map(|node| (mesh.node_label(node), mesh.nodes[node]));
    write_mesh(out, &mut { nodes }, &mut elements.into_iter())
}

/// Writes a mode by the real and imaginary displacements of the nodes, each along x, y and z.
pub fn write_universal_mode(
    out: &mut dyn io::Write,
    mesh: &Mesh,
    named: (&str, usize),
    eigenvalue: c64,
    [real, imaginary]: [&[f64]; 2],
) -> io::Result<()> {
    let pairs = real.chunks_exact(3).zip(imaginary.chunks_exact(3));
    let shape = pairs.map(|(re, im)| [0, 1, 2].map(|k| c64::new(re[k], im[k])));
    let labels = (0..mesh.node_count()).map(|node| mesh.node_label(node));
    write_mode(out, named, eigenvalue, labels.zip(shape))
}
