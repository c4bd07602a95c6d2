//! Lengths that are hardly meant, and meshes that are hardly what they should be.

use crate::*;

/// Lengths that a case has, m.
const LENGTHS: [f64; 2] = [1e-5, 10.0];
/// Thickness beyond which a plane body is hardly meant, m: 1 m is the default, a value for each metre.
const LARGEST_THICKNESS: f64 = 1.0;
/// Jacobian of an element, smallest over largest, below which it is badly shaped.
const SMALLEST_JACOBIAN: f64 = 0.1;

/// The width of a mesh, a radius or the thickness in other units.
pub(super) fn lengths(case: &Case) -> Option<Diagnostic> {
    let [least, most] = LENGTHS;
    let si = "a case is in SI: are these millimetres or micrometres?";
    let of_file = match case.raw.find("mesh.scale") {
        Some(_) => "mesh.scale makes metres of coordinates: of millimetres it is 0.001",
        None => "metres are read: of millimetres set mesh.units = \"mm-t-s\"",
    };
    let is_read = !case.body.has_sectors();
    let width = is_read.then(|| ("mesh.scale", 2.0 * case.body.size(), most, of_file));
    let radii = case.body.grid().into_iter().flat_map(|grid| {
        let keys = ["geometry.inner_radius", "geometry.outer_radius"];
        keys.into_iter().zip([grid.inner_radius, grid.outer_radius])
    });
    let radii = radii.map(|(key, radius)| (key, radius, most, si));
    let thickness = ("geometry.thickness", case.thickness, LARGEST_THICKNESS, si);
    let mut all = width.into_iter().chain(radii).chain([thickness]);
    let (key, value, most, help) = all.find(|(_, own, most, _)| !(least..=*most).contains(own))?;
    let what = match key {
        "mesh.scale" => format!("the mesh is {value:.4} m wide (mesh.scale),"),
        _ => format!("{key} = {value} m is"),
    };
    Some(diagnosis!(case, key, "{what} outside the plausible range of {} to {}", metres(least),
        metres(most); "metres?"; "{help}"))
}

/// A length with the unit that suits its size.
fn metres(length: f64) -> String {
    match length {
        l if l < 1e-3 => format!("{} um", (l * 1e9).round() / 1e3),
        l if l < 1.0 => format!("{} mm", (l * 1e6).round() / 1e3),
        l => format!("{l} m"),
    }
}

/// Nodes of an imported mesh that lie on each other without being one.
pub(super) fn unmerged_nodes(case: &Case) -> Option<Diagnostic> {
    let found = case.body.imported()?.mesh.unmerged_nodes()?;
    Some(diagnosis!(case, "mesh.file", "{found}: the parts are not connected there";
        "parts that were not merged?";
        "join the parts (BooleanFragments or Coherence in the Gmsh geometry, or Coherence Mesh;); not at a crack"))
}

/// The worst element of a mesh file.
pub(super) fn element_shape(case: &Case) -> Option<Diagnostic> {
    let mesh = case.raw.find("mesh.file").and_then(|_| case.body.mesh().ok())?;
    let quality = mesh.quality();
    if quality.worst_jacobian >= SMALLEST_JACOBIAN {
        return None;
    }
    let nodes = mesh.element_nodes(quality.worst_element);
    let labels = nodes.iter().map(|&node| mesh.node_label(node as usize));
    let middle = (0..mesh.dimension).map(|axis| {
        let sum: f64 = nodes.iter().map(|&n| mesh.nodes[n as usize][axis]).sum();
        format!("{:.6}", sum / nodes.len() as f64)
    });
    Some(diagnosis!(case, "mesh.file",
        "the Jacobian of an element varies by a factor {:.3} (smallest over largest): that of nodes {} at ({}) m. \
         Below {SMALLEST_JACOBIAN} an element is badly shaped, below 0 a corner folds",
        quality.worst_jacobian, first_of(labels, 9), middle.collect::<Vec<_>>().join(", "); "a badly shaped element";
        "mesh again, finer where it curves, or with Mesh.Optimize = 1; stresses near it are not reliable"))
}
