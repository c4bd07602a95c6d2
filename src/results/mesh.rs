//! What a mesh looks like: statistics, VTU, outline picture.

use super::drawing::{DrawingError, DrawingOptions, draw_all, write_figures};
use super::folder::{FolderError, OutputFolder};
use super::manifest::Manifest;
use super::quantity::quantity;
use super::summary::{Entry, Summary};
use super::vtu::{EncodedMesh, Field, write_vtu};
use crate::chart::{
    Axis, Field as Window, Figure, INK, Label, Line, Marker, Panel, Points, SERIES,
};
use crate::mesh::{AnnulusMesh, ElementKind, Mesh2d};
use serde::{Deserialize, Serialize};

/// `summary.json` of `frictionsim mesh`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshSummary {
    /// `mesh`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// Size and quality.
    pub mesh: MeshStatistics,
    /// What it was made from.
    pub manifest: Manifest,
}

impl Summary for MeshSummary {
    fn headline(&self) -> Vec<Entry> {
        vec![
            Entry::new("mesh.nodes", self.mesh.nodes),
            Entry::new("mesh.elements", self.mesh.elements),
            Entry::new("mesh.dofs", self.mesh.dofs),
            Entry::new("mesh.contact_nodes", self.mesh.contact_nodes),
        ]
    }
}

/// The summary as text.
pub fn print(summary: &MeshSummary) -> String {
    let mesh = &summary.mesh;
    let text = |key: &str, value: f64| quantity(key).text(value);
    let counts = summary.headline();
    let counts = counts.iter().map(|entry| {
        let quantity = quantity(&entry.path);
        format!("{} {}", quantity.cell(&entry.value), quantity.caption)
    });
    format!(
        "{}\nedges {} to {}, aspect ratio up to {}\narea {}, {} off the annulus\n\
         node ids: 1 + j {} + i, i outwards along a ray, j around from +x\n",
        counts.collect::<Vec<_>>().join(", "),
        quantity("smallest_edge_m").number(mesh.smallest_edge_m),
        text("largest_edge_m", mesh.largest_edge_m),
        text("largest_aspect_ratio", mesh.largest_aspect_ratio),
        text("area_m2", mesh.area_m2),
        text("area_error", mesh.area_error),
        mesh.nodes_per_sector,
    )
}

/// Size and quality of an annulus mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshStatistics {
    /// Nodes.
    pub nodes: usize,
    /// Elements.
    pub elements: usize,
    /// Unknowns, two for each node.
    pub dofs: usize,
    /// Nodes on the contact edge.
    pub contact_nodes: usize,
    /// Nodes of one ray of corner nodes: node `1 + j (nodes_per_sector) + i`.
    pub nodes_per_sector: usize,
    /// Smallest edge length of any element, m.
    pub smallest_edge_m: f64,
    /// Largest edge length, m.
    pub largest_edge_m: f64,
    /// Largest ratio of the edges of one element.
    pub largest_aspect_ratio: f64,
    /// Area of the mesh, m2.
    pub area_m2: f64,
    /// Its relative difference to the annulus.
    pub area_error: f64,
}

impl MeshStatistics {
    /// Measures a mesh between its corner nodes; the area follows the curved edges of Quad8.
    pub fn new(annulus: &AnnulusMesh) -> Self {
        let mesh = &annulus.mesh;
        let (mut smallest, mut largest, mut aspect) = (f64::INFINITY, 0.0f64, 1.0f64);
        let mut area = 0.0;
        for element in 0..mesh.element_count() {
            let outline = outline(mesh, element);
            area += polygon_area(&outline, mesh.element_kind);
            let corners = corners(mesh, element);
            let lengths: [f64; 4] = std::array::from_fn(|i| {
                let (p, q) = (corners[i], corners[(i + 1) % 4]);
                (p[0] - q[0]).hypot(p[1] - q[1])
            });
            let low = lengths.iter().copied().fold(f64::INFINITY, f64::min);
            let high = lengths.iter().copied().fold(0.0, f64::max);
            smallest = smallest.min(low);
            largest = largest.max(high);
            aspect = aspect.max(high / low);
        }
        let spec = &annulus.specification;
        let exact = std::f64::consts::PI * (spec.outer_radius.powi(2) - spec.inner_radius.powi(2));
        Self {
            nodes: mesh.node_count(),
            elements: mesh.element_count(),
            dofs: 2 * mesh.node_count(),
            contact_nodes: mesh.inner_edge.nodes.len(),
            nodes_per_sector: annulus.sector_node_count(),
            smallest_edge_m: smallest,
            largest_edge_m: largest,
            largest_aspect_ratio: aspect,
            area_m2: area,
            area_error: (area / exact - 1.0).abs(),
        }
    }
}

fn corners(mesh: &Mesh2d, element: usize) -> [[f64; 2]; 4] {
    let nodes = mesh.element_nodes(element);
    std::array::from_fn(|i| mesh.nodes[nodes[i] as usize])
}

/// Nodes around an element, mid-side nodes between their corners.
fn outline(mesh: &Mesh2d, element: usize) -> Vec<[f64; 2]> {
    let nodes = mesh.element_nodes(element);
    let at = |i: usize| mesh.nodes[nodes[i] as usize];
    match mesh.element_kind {
        ElementKind::Quad4 => (0..4).map(at).collect(),
        ElementKind::Quad8 => (0..4).flat_map(|i| [at(i), at(i + 4)]).collect(),
    }
}

/// Area inside straight edges, or inside parabolic ones through every second point.
fn polygon_area(points: &[[f64; 2]], kind: ElementKind) -> f64 {
    let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let count = points.len();
    match kind {
        ElementKind::Quad4 => {
            let sum: f64 = (0..count)
                .map(|i| cross(points[i], points[(i + 1) % count]))
                .sum();
            0.5 * sum
        }
        // Green's theorem on a parabola through p, m, q: (4 p x m + 4 m x q - p x q) / 6.
        ElementKind::Quad8 => (0..count)
            .step_by(2)
            .map(|i| {
                let (p, m, q) = (points[i], points[i + 1], points[(i + 2) % count]);
                (4.0 * cross(p, m) + 4.0 * cross(m, q) - cross(p, q)) / 6.0
            })
            .sum(),
    }
}

/// Writes `mesh.vtu` with node ids (from 1) and the contact edge marked.
///
/// # Errors
/// Those of the folder.
pub fn write_mesh(folder: &OutputFolder, mesh: &Mesh2d) -> Result<(), FolderError> {
    let ids = (1..=mesh.node_count() as i64).collect();
    let mut edge = vec![0; mesh.node_count()];
    for node in &mesh.inner_edge.nodes {
        edge[*node as usize] = 1;
    }
    for node in &mesh.outer_edge.nodes {
        edge[*node as usize] = 2;
    }
    let fields = [
        Field::integers("node_id", ids),
        // 1 contact, 2 clamped, 0 elsewhere.
        Field::integers("edge", edge),
    ];
    folder.write("mesh.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &[])
    })?;
    Ok(())
}

/// Draws `figures/mesh`: elements with their axes, contact edge, clamped edge and probes (node numbers from 1).
///
/// # Errors
/// Those of the folder.
pub fn write_mesh_picture(
    folder: &OutputFolder,
    annulus: &AnnulusMesh,
    (title, probes): (&str, &[usize]),
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let figures = draw_all(
        vec![Box::new(|| Ok(mesh_figure(&annulus.mesh, title, probes)))],
        options,
    )?;
    write_figures(folder, &figures, options)
}

fn mesh_figure(mesh: &Mesh2d, title: &str, probes: &[usize]) -> Figure {
    let place = |node: u32| (mesh.nodes[node as usize][0], mesh.nodes[node as usize][1]);
    let gap = (f64::NAN, f64::NAN);
    let rings = (0..mesh.element_count()).flat_map(|element| {
        let ring = outline(mesh, element);
        let again = ring.first().copied();
        let points = ring.into_iter().chain(again).map(|[x, y]| (x, y));
        points.chain([gap]).collect::<Vec<_>>()
    });
    let edge = |nodes: &[u32], colour: &'static str, name: &str| {
        let around = nodes.iter().chain(nodes.first()).map(|&node| place(node));
        Line::through(around).solid(colour, 1.4).name(name)
    };
    let known = probes
        .iter()
        .filter(|&&probe| (1..=mesh.node_count()).contains(&probe));
    let known: Vec<(usize, (f64, f64))> = known
        .map(|&probe| (probe, place(probe as u32 - 1)))
        .collect();
    let labels = known
        .iter()
        .map(|(probe, at)| Label::new(*at, probe.to_string()).moved(4.0, -4.0));
    let [low, high] = Window::window(&mesh.nodes, 0.06);
    let axis = |name: &str, i: usize| Axis::new(name, "mm").times(1e3).between(low[i], high[i]);
    let panel = Panel::new(axis("*x*", 0), axis("*y*", 1))
        .equal()
        .plain()
        .height(420.0)
        .layer(Line::through(rings).solid("#6f6f6f", 0.25).name(format!(
            "{} elements, {} nodes",
            mesh.element_count(),
            mesh.node_count()
        )))
        .layer(edge(&mesh.inner_edge.nodes, SERIES[1], "contact edge"))
        .layer(edge(&mesh.outer_edge.nodes, SERIES[0], "clamped edge"))
        .layer(
            Points::new(known.iter().map(|probe| probe.1))
                .marker(Marker::Disc, 2.0, INK)
                .name("probes"),
        )
        .layers(labels);
    Figure::new("mesh", if title.is_empty() { "Mesh" } else { title }).panel(panel)
}
