//! Picture of the mesh of a plane body, and fields of a body of revolution.

use super::{REGION_COLOURS, write_nodes};
use crate::common::*;
use frictionsim_chart::Field as Window;
use frictionsim_physics::mesh::Boundary;

/// Writes the bricks of a body of revolution.
pub fn write_revolution(folder: &OutputFolder, sector: &SolidSector) -> Result<(), FolderError> {
    let per_sector = sector.node_count();
    let edge_of = |node: usize| match node % per_sector {
        node if sector.rings.iter().any(|ring| ring.nodes.contains(&node)) => 1,
        node => 2 * i64::from((3 * node..3 * node + 3).any(|dof| sector.is_held(dof))),
    };
    let mesh = sector.whole();
    let edge = (0..mesh.node_count()).map(edge_of).collect();
    write_nodes(folder, &mesh, edge, &[])
}

/// Most normals drawn.
const MOST_NORMALS: usize = 48;

/// A point of a curve that is none, where the curve breaks.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

/// Elements by region, boundaries with their names, normals of the contact edge, probes (node numbers from 1).
pub fn figure(mesh: &Mesh, title: &str, probes: &[usize]) -> Figure {
    let place = |node: u32| (mesh.nodes[node as usize][0], mesh.nodes[node as usize][1]);
    let [low, high] = Window::window(&mesh.plane_nodes(), 0.1);
    let size = high[0] - low[0];
    let known = probes.iter().filter(|&&probe| (1..=mesh.node_count()).contains(&probe));
    let known: Vec<(usize, (f64, f64))> =
        known.map(|&probe| (probe, place(probe as u32 - 1))).collect();
    let labels = known.iter().map(|(probe, at)| {
        Label::new(*at, mesh.node_label(probe - 1).to_string()).moved(4.0, -4.0)
    });
    let longest = mesh.quality().largest_edge_m;
    let boundaries = || mesh.boundaries.iter().enumerate();
    // The contact edge lies on its counterface: it is drawn last.
    let (contact, others): (Vec<_>, Vec<_>) = boundaries().partition(|own| own.0 == mesh.contact);
    let edges = others.into_iter().chain(contact).filter_map(|own| edge(mesh, own, longest));
    // Names are for the curves of a file; those of the annulus go without saying.
    let names = boundaries().filter(|_| !mesh.is_cyclic).filter_map(|(_, boundary)| {
        let middle = boundary.nodes.get(boundary.nodes.len() / 2)?;
        let style = TextStyle::new(6.75).bold().with_halo();
        Some(Label::new(place(*middle), literal(&boundary.name)).style(style))
    });
    let axis = |name: &str, i: usize| Axis::new(name, "mm").times(1e3).between(low[i], high[i]);
    let panel = Panel::new(axis("*x*", 0), axis("*y*", 1))
        .equal()
        .plain()
        .height(420.0)
        .layers(elements(mesh))
        .layers(edges)
        .layer(normals(mesh, 0.035 * size))
        .layer(
            Points::new(known.iter().map(|probe| probe.1))
                .marker(Marker::Disc, 2.0, INK)
                .name("probes"),
        )
        .layers(names)
        .layers(labels);
    Figure::new("mesh", super::caption(title)).panel(panel)
}

/// The edges of the elements, region by region.
fn elements(mesh: &Mesh) -> Vec<Line> {
    let counts = (0..mesh.regions.len().max(1)).map(|region| {
        let own = (0..mesh.element_count()).filter(move |&element| mesh.region(element) == region);
        let count = own.clone().count();
        let rings = own.flat_map(|element| {
            let ring = mesh.element_outline(element);
            let nodes = ring.iter().chain(ring.first()).map(|&node| mesh.plane_node(node as usize));
            nodes.map(|[x, y]| (x, y)).chain([GAP]).collect::<Vec<_>>()
        });
        let name = match (mesh.regions.len(), mesh.regions.get(region)) {
            (2.., Some(name)) => format!("{}: {count} elements", literal(name)),
            _ => format!("{count} elements, {} nodes", mesh.node_count()),
        };
        let colour = REGION_COLOURS[region % REGION_COLOURS.len()];
        Line::through(rings).solid(colour, 0.25).name(name)
    });
    counts.collect()
}

/// A boundary that is held, loaded or touched.
fn edge(mesh: &Mesh, (b, boundary): (usize, &Boundary), longest: f64) -> Option<Line> {
    let (colour, name) = match boundary.condition {
        _ if b == mesh.contact => (SERIES[1], "contact edge"),
        _ if Some(b) == mesh.opposite => (SERIES[5], "counterface edge"),
        BoundaryCondition::Clamped => (SERIES[0], "clamped edge"),
        BoundaryCondition::Support(_) => (SERIES[2], "supported edge"),
        BoundaryCondition::Guide | BoundaryCondition::Fixed(_) => (SERIES[3], "guided edge"),
        BoundaryCondition::Pressure(_) => (SERIES[4], "pressed edge"),
        BoundaryCondition::Free => return None,
    };
    // A gap where a curve goes on in another piece.
    let again = boundary.nodes.first().filter(|_| boundary.is_closed);
    let mut points: Vec<(f64, f64)> = Vec::new();
    for &node in boundary.nodes.iter().chain(again) {
        let [x, y] = mesh.plane_node(node as usize);
        let is_far =
            points.last().is_some_and(|last| (x - last.0).hypot(y - last.1) > 2.0 * longest);
        points.extend(is_far.then_some(GAP));
        points.push((x, y));
    }
    Some(Line::through(points).solid(colour, 1.4).name(name))
}

/// Arrows along the outward normals of the contact edge.
fn normals(mesh: &Mesh, length: f64) -> Line {
    let edge = mesh.contact_edge();
    let all: Vec<_> = edge.nodes.iter().zip(&edge.normal_angles).collect();
    let step = all.len().div_ceil(MOST_NORMALS).max(1);
    let arrows = all.into_iter().step_by(step).flat_map(|(&node, angle)| {
        let [x, y] = mesh.plane_node(node as usize);
        let (sin, cos) = angle.sin_cos();
        [(x, y), (x + length * cos, y + length * sin), GAP]
    });
    Line::through(arrows).solid(INK, 0.6).arrows(1).name("outward normal of the contact edge")
}
