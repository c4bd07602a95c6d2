//! Pictures of the mesh of solid bodies.

use super::{REGION_COLOURS, Roles, role_of};
use crate::common::*;

/// Colour of the boundaries of each kind, in the order of the legend; the last one of faces that nothing is said of.
const CONDITION_COLOURS: [(&str, &str); 9] = [
    (SERIES[1], "contact"),
    (SERIES[5], "counterface"),
    (SERIES[4], "pressure"),
    (SERIES[0], "clamped"),
    (SERIES[3], "fixed"),
    ("#8c5bb0", "guide"),
    (SERIES[2], "support"),
    ("#b8a038", "tie"),
    ("#d0d0d0", "free"),
];

/// Regions and boundaries, each seen from the front and turned over.
pub fn figure(mesh: &Mesh, title: &str, roles: &Roles) -> Figure {
    let regions = mesh.regions.iter().enumerate().map(|(r, name)| {
        let colour = REGION_COLOURS[r % REGION_COLOURS.len()];
        (colour, literal(name))
    });
    let regions: Vec<(&'static str, String)> = regions.collect();
    let region = |face: &BoundaryFace| mesh.region(face.element as usize);
    let conditions = conditions_of_faces(mesh, roles);
    let condition = |face: &BoundaryFace| {
        conditions.get(&sorted(face)).copied().unwrap_or(CONDITION_COLOURS.len() - 1)
    };
    let legend = CONDITION_COLOURS.iter().enumerate().map(|(k, entry)| {
        let is_there = k + 1 == CONDITION_COLOURS.len() || conditions.values().any(|&c| c == k);
        let name = if is_there { entry.1 } else { "" };
        (entry.0, name.to_owned())
    });
    let legend: Vec<(&'static str, String)> = legend.collect();
    let views = [SolidView::new(mesh), SolidView::turned_over(mesh)];
    let words = ["from the front", "turned over"];
    let by_region = views.iter().zip(words).map(|(view, from)| {
        let surface = view.parts(region, regions.clone());
        panel(surface, format!("regions, {from}"))
    });
    let by_condition = views.iter().zip(words).map(|(view, from)| {
        let surface = view.parts(condition, legend.clone());
        panel(surface, format!("boundaries, {from}"))
    });
    let body = MovingBody::of_surface(mesh, true);
    let colours =
        [("regions", body.parts(region, &regions)), ("boundaries", body.parts(condition, &legend))];
    let states =
        colours.map(|(name, kind)| MotionState { name: name.to_owned(), frequency_hz: 0.0, kind });
    Figure::new("mesh", super::caption(title))
        .columns(2)
        .panels(by_region.chain(by_condition))
        .motion(Motion { states: states.to_vec(), ..body.at_rest.clone() })
}

fn panel(surface: Surface, caption: String) -> Panel {
    Panel::plane(surface.window(0.05)).height(210.0).caption(caption).layer(surface)
}

/// The kind of each face of a boundary that holds, loads or touches, by its nodes. A face of several boundaries is of
/// the first kind.
fn conditions_of_faces(mesh: &Mesh, roles: &Roles) -> BTreeMap<Vec<u32>, usize> {
    let mut kinds: BTreeMap<Vec<u32>, usize> = BTreeMap::new();
    for (b, boundary) in mesh.boundaries.iter().enumerate() {
        let name = role_of(mesh, b, roles);
        let Some(kind) = CONDITION_COLOURS.iter().position(|entry| entry.1 == name) else {
            continue;
        };
        for face in &boundary.faces {
            let known = kinds.entry(sorted(face)).or_insert(kind);
            *known = kind.min(*known);
        }
    }
    kinds
}

/// The nodes of a face in rising order, which name it.
fn sorted(face: &BoundaryFace) -> Vec<u32> {
    let mut nodes = face.nodes.clone();
    nodes.sort_unstable();
    nodes
}
