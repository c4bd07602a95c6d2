//! Results of `mesh`: statistics, VTU, picture.

use super::drawing::{DrawingError, DrawingOptions, draw_all, write_report};
use super::folder::{FolderError, OutputFolder};
use super::manifest::Manifest;
use super::quantity::quantity;
use super::report::{Report, ReportSection, ReportTable};
use super::summary::{Entry, Summary};
use super::vtu::{EncodedMesh, Field, write_vtu};
use crate::chart::{
    Axis, Field as Window, Figure, INK, Label, Line, Marker, Panel, Points, SERIES, TextStyle,
    literal,
};
use crate::mesh::{AnnulusMesh, Boundary, BoundaryCondition, Mesh, SolidContact, SolidSector};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

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
    /// What of the mesh file is not used: keyword, place, count, reason.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not_used: Vec<String>,
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
    let mut out = format!(
        "{}\nedges {} to {}, aspect ratio up to {}, worst Jacobian {:.3}\n",
        counts.collect::<Vec<_>>().join(", "),
        quantity("smallest_edge_m").number(mesh.smallest_edge_m),
        text("largest_edge_m", mesh.largest_edge_m),
        text("largest_aspect_ratio", mesh.largest_aspect_ratio),
        mesh.worst_jacobian,
    );
    if let (Some(elements), Some(nodes)) =
        (mesh.elements_per_wavelength, mesh.contact_nodes_per_wave)
    {
        let _ = writeln!(
            out,
            "at the highest frequency {elements:.1} elements for each shear wavelength, {nodes:.1} contact nodes"
        );
    }
    let area = text("area_m2", mesh.area_m2);
    if let (Some(layers), Some(nodes)) = (mesh.axial_elements, mesh.nodes_per_sector) {
        let _ = writeln!(
            out,
            "{layers} layers of bricks over the thickness; edges, quality and picture are of the section across the axis, area {area}\n\
             node ids: 1 + j {nodes} + k, k in the sheet of a sector, j around from +x"
        );
        return out;
    }
    if let (Some(error), Some(nodes)) = (mesh.area_error, mesh.nodes_per_sector) {
        let _ = writeln!(
            out,
            "area {area}, {} off the annulus\n\
             node ids: 1 + j {nodes} + i, i outwards along a ray, j around from +x",
            text("area_error", error),
        );
        return out;
    }
    let _ = writeln!(out, "area {area}");
    for region in &mesh.regions {
        let _ = writeln!(
            out,
            "region {}: {} elements, {:.6e} m2",
            region.name, region.elements, region.area_m2
        );
    }
    for boundary in &mesh.boundaries {
        let _ = writeln!(
            out,
            "boundary {}: {} nodes, {:.6e} m, {}",
            boundary.name, boundary.nodes, boundary.length_m, boundary.condition
        );
    }
    for line in &summary.not_used {
        let _ = writeln!(out, "not used: {line}");
    }
    match mesh.unnamed_free_edges {
        None | Some(0) => {}
        Some(1) => out.push_str("1 free edge is in no physical curve\n"),
        Some(count) => {
            let _ = writeln!(out, "{count} free edges are in no physical curve");
        }
    }
    out
}

/// Size and quality of a mesh.
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
    /// Layers of bricks over the thickness of a body in three dimensions; edges, quality and areas are then of its plane
    /// section across the axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axial_elements: Option<usize>,
    /// On the annulus, nodes of one ray of corner nodes: node `1 + j (nodes_per_sector) + i`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nodes_per_sector: Option<usize>,
    /// Smallest edge length of any element, m.
    pub smallest_edge_m: f64,
    /// Largest edge length, m.
    pub largest_edge_m: f64,
    /// Largest ratio of the edges of one element.
    pub largest_aspect_ratio: f64,
    /// Smallest Jacobian determinant of an element over its largest.
    pub worst_jacobian: f64,
    /// Edges of one element alone that belong to no named boundary, of a mesh file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unnamed_free_edges: Option<usize>,
    /// Area of the mesh, m2.
    pub area_m2: f64,
    /// Its relative difference to the annulus.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_error: Option<f64>,
    /// Elements for each shear wavelength at the highest frequency of the case, where it has one: the largest edge
    /// counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elements_per_wavelength: Option<f64>,
    /// Contact nodes for each such wave, where they are farthest apart on average.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_nodes_per_wave: Option<f64>,
    /// Regions with their elements and areas.
    pub regions: Vec<RegionStatistics>,
    /// Boundaries with their nodes and lengths.
    pub boundaries: Vec<BoundaryStatistics>,
}

/// One region of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegionStatistics {
    /// Its name.
    pub name: String,
    /// Its elements.
    pub elements: usize,
    /// Its area, m2.
    pub area_m2: f64,
}

/// One boundary of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundaryStatistics {
    /// Its name.
    pub name: String,
    /// Its nodes.
    pub nodes: usize,
    /// Its length, m.
    pub length_m: f64,
    /// What holds it, in a word.
    pub condition: String,
}

impl MeshStatistics {
    /// Counts of the body of revolution whose plane section was measured.
    pub fn turn(&mut self, sector: &SolidSector) {
        let sectors = sector.sector_count();
        self.nodes = sectors * sector.node_count();
        self.elements = sectors * sector.elements.len();
        self.dofs = 3 * self.nodes;
        self.contact_nodes = sector
            .rings
            .iter()
            .map(|ring| sectors * ring.nodes.len())
            .sum();
        self.axial_elements = Some(sector.specification.axial_elements);
        self.nodes_per_sector = Some(sector.node_count());
        if sector.specification.contact != SolidContact::Inner {
            self.contact_nodes_per_wave = None;
        }
    }

    /// Measures a mesh between its corner nodes; areas follow curved edges. `wavelength` is the shortest that the case
    /// is about, m.
    pub fn new(mesh: &Mesh, annulus: Option<&AnnulusMesh>, wavelength: Option<f64>) -> Self {
        let quality = mesh.quality();
        let mut regions: Vec<RegionStatistics> = mesh
            .regions
            .iter()
            .map(|name| RegionStatistics {
                name: name.clone(),
                elements: 0,
                area_m2: 0.0,
            })
            .collect();
        for element in 0..mesh.element_count() {
            let region = &mut regions[mesh.region(element)];
            region.elements += 1;
            region.area_m2 += mesh.element_area(element);
        }
        let area: f64 = regions.iter().map(|region| region.area_m2).sum();
        let exact = |annulus: &AnnulusMesh| {
            let spec = &annulus.specification;
            let bore = spec
                .shaft
                .map_or(spec.inner_radius, |shaft| shaft.inner_radius);
            std::f64::consts::PI * (spec.outer_radius.powi(2) - bore.powi(2))
        };
        let contact = mesh.contact_edge();
        let contact_length: f64 = contact.tributary_lengths.iter().sum();
        let spacing = contact_length / contact.nodes.len() as f64;
        Self {
            nodes: mesh.node_count(),
            elements: mesh.element_count(),
            dofs: 2 * mesh.node_count(),
            contact_nodes: contact.nodes.len(),
            axial_elements: None,
            nodes_per_sector: annulus.map(AnnulusMesh::sector_node_count),
            smallest_edge_m: quality.smallest_edge,
            largest_edge_m: quality.largest_edge,
            largest_aspect_ratio: quality.largest_aspect_ratio,
            worst_jacobian: quality.worst_jacobian,
            unnamed_free_edges: (!mesh.labels.is_empty())
                .then(|| mesh.unnamed_edge_count())
                .flatten(),
            area_m2: area,
            area_error: annulus.map(|annulus| (area / exact(annulus) - 1.0).abs()),
            elements_per_wavelength: wavelength.map(|length| length / quality.largest_edge),
            contact_nodes_per_wave: wavelength.map(|length| length / spacing),
            regions,
            boundaries: mesh
                .boundaries
                .iter()
                .enumerate()
                .map(|(b, boundary)| BoundaryStatistics {
                    name: boundary.name.clone(),
                    nodes: boundary.nodes.len(),
                    length_m: boundary.tributary_lengths.iter().sum(),
                    condition: match b {
                        b if b == mesh.contact => "contact".to_owned(),
                        b if Some(b) == mesh.opposite => COUNTERFACE.to_owned(),
                        _ => condition_name(boundary.condition).to_owned(),
                    },
                })
                .collect(),
        }
    }
}

/// What the boundary of the other body is that the contact slides on.
const COUNTERFACE: &str = "counterface";

fn condition_name(condition: BoundaryCondition) -> &'static str {
    match condition {
        BoundaryCondition::Clamped => "clamped",
        BoundaryCondition::Support(_) => "support",
        BoundaryCondition::Guide => "guide",
        BoundaryCondition::Fixed(_) => "fixed",
        BoundaryCondition::Pressure(_) => "pressure",
        BoundaryCondition::Free => "free",
    }
}

/// Nodes around an element, mid-side nodes between their corners.
fn outline(mesh: &Mesh, element: usize) -> Vec<[f64; 2]> {
    let nodes = mesh.element_outline(element).into_iter();
    nodes.map(|node| mesh.plane_node(node as usize)).collect()
}

/// Writes `mesh.vtu` with node ids (from 1), the contact edge marked, and the region of each element.
///
/// # Errors
/// Those of the folder.
pub fn write_mesh(folder: &OutputFolder, mesh: &Mesh) -> Result<(), FolderError> {
    let ids = (0..mesh.node_count())
        .map(|node| mesh.node_label(node) as i64)
        .collect();
    let mut edge = vec![0; mesh.node_count()];
    mesh.held_dofs().for_each(|dof| edge[dof / 2] = 2);
    for node in &mesh.contact_edge().nodes {
        edge[*node as usize] = 1;
    }
    let fields = [
        Field::integers("node_id", ids),
        // 1 contact, 2 clamped, 0 elsewhere.
        Field::integers("edge", edge),
    ];
    // Counted from 1 in the order in which the summary lists them.
    let regions = (0..mesh.element_count()).map(|element| mesh.region(element) as i64 + 1);
    let regions = [Field::integers("region_id", regions.collect())];
    folder.write("mesh.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &regions)
    })?;
    Ok(())
}

/// Writes the bricks of a body of revolution.
///
/// # Errors
/// Those of the folder.
pub fn write_solid_mesh(folder: &OutputFolder, sector: &SolidSector) -> Result<(), FolderError> {
    let per_sector = sector.node_count();
    let count = per_sector * sector.sector_count();
    let edge_of = |node: usize| match node % per_sector {
        node if sector.rings.iter().any(|ring| ring.nodes.contains(&node)) => 1,
        node => 2 * i64::from((3 * node..3 * node + 3).any(|dof| sector.is_held(dof))),
    };
    let edge = (0..count).map(edge_of).collect();
    let fields = [
        Field::integers("node_id", (1..=count as i64).collect()),
        // 1 contact, 2 held, 0 elsewhere.
        Field::integers("edge", edge),
    ];
    folder.write("mesh.vtu", |out| {
        write_vtu(out, &EncodedMesh::solid(sector)?, &[], &fields, &[])
    })?;
    Ok(())
}

/// Draws `figures/mesh` and writes `report.html`: elements by region, boundaries with their names, normals of the contact edge,
/// probes (node numbers from 1); sizes and quality.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw_mesh(
    folder: &OutputFolder,
    mesh: &Mesh,
    (title, probes): (&str, &[usize]),
    statistics: &MeshStatistics,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let figures = draw_all(
        vec![Box::new(|| Ok(mesh_figure(mesh, title, probes)))],
        options,
    )?;
    let report = Report {
        title: title.to_owned(),
        sections: vec![
            ReportSection::results(Vec::new(), numbers(statistics))
                .with_tables([region_table(statistics), boundary_table(statistics)]),
            ReportSection {
                heading: "Mesh".into(),
                figures,
                ..ReportSection::default()
            },
        ],
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &report, options)
}

/// Sizes and quality, name and value.
fn numbers(mesh: &MeshStatistics) -> Vec<(String, String)> {
    let row = |key: &str, value: Option<f64>| {
        let quantity = quantity(key);
        Some((quantity.caption.to_owned(), quantity.text(value?)))
    };
    let rows = [
        row("nodes", Some(mesh.nodes as f64)),
        row("elements", Some(mesh.elements as f64)),
        row("dofs", Some(mesh.dofs as f64)),
        row("contact_nodes", Some(mesh.contact_nodes as f64)),
        row("smallest_edge_m", Some(mesh.smallest_edge_m)),
        row("largest_edge_m", Some(mesh.largest_edge_m)),
        row("largest_aspect_ratio", Some(mesh.largest_aspect_ratio)),
        row("worst_jacobian", Some(mesh.worst_jacobian)),
        row("area_m2", Some(mesh.area_m2)),
        row("elements_per_wavelength", mesh.elements_per_wavelength),
        row("contact_nodes_per_wave", mesh.contact_nodes_per_wave),
    ];
    rows.into_iter().flatten().collect()
}

fn region_table(mesh: &MeshStatistics) -> ReportTable {
    let row = |region: &RegionStatistics| {
        let area = format!("{:.6e}", region.area_m2);
        vec![region.name.clone(), region.elements.to_string(), area]
    };
    ReportTable {
        caption: "Regions".into(),
        columns: ["region", "elements", "area (m2)"]
            .map(String::from)
            .to_vec(),
        rows: mesh.regions.iter().map(row).collect(),
    }
}

fn boundary_table(mesh: &MeshStatistics) -> ReportTable {
    let row = |boundary: &BoundaryStatistics| {
        vec![
            boundary.name.clone(),
            boundary.nodes.to_string(),
            format!("{:.6e}", boundary.length_m),
            boundary.condition.clone(),
        ]
    };
    ReportTable {
        caption: "Boundaries".into(),
        columns: ["boundary", "nodes", "length (m)", "condition"]
            .map(String::from)
            .to_vec(),
        rows: mesh.boundaries.iter().map(row).collect(),
    }
}

/// Colours of the elements of the regions, which take them in turns.
pub(super) const REGION_COLOURS: [&str; 6] = [
    "#7d7d7d", "#b07d2b", "#4f8f5f", "#7a5c99", "#3f7fa8", "#a85858",
];
/// Most normals drawn.
const MOST_NORMALS: usize = 48;

/// A point of a curve that is none, where the curve breaks.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

fn mesh_figure(mesh: &Mesh, title: &str, probes: &[usize]) -> Figure {
    let place = |node: u32| (mesh.nodes[node as usize][0], mesh.nodes[node as usize][1]);
    let [low, high] = Window::window(&mesh.plane_nodes(), 0.1);
    let size = high[0] - low[0];
    let known = probes
        .iter()
        .filter(|&&probe| (1..=mesh.node_count()).contains(&probe));
    let known: Vec<(usize, (f64, f64))> = known
        .map(|&probe| (probe, place(probe as u32 - 1)))
        .collect();
    let labels = known.iter().map(|(probe, at)| {
        Label::new(*at, mesh.node_label(probe - 1).to_string()).moved(4.0, -4.0)
    });
    let longest = mesh.quality().largest_edge;
    let boundaries = || mesh.boundaries.iter().enumerate();
    let edges = boundaries().filter_map(|(b, boundary)| edge(mesh, (b, boundary), longest));
    // Names are for the curves of a file; those of the annulus go without saying.
    let names = boundaries().filter(|_| !mesh.is_cyclic);
    let names = names.filter_map(|(_, boundary)| {
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
        .layers(edges.collect::<Vec<_>>())
        .layer(normals(mesh, 0.035 * size))
        .layer(
            Points::new(known.iter().map(|probe| probe.1))
                .marker(Marker::Disc, 2.0, INK)
                .name("probes"),
        )
        .layers(names.collect::<Vec<_>>())
        .layers(labels.collect::<Vec<_>>());
    let caption = match title {
        "" => "Mesh".to_owned(),
        title => literal(title),
    };
    Figure::new("mesh", caption).panel(panel)
}

/// The edges of the elements, region by region.
fn elements(mesh: &Mesh) -> Vec<Line> {
    let counts = (0..mesh.regions.len().max(1)).map(|region| {
        let own = (0..mesh.element_count()).filter(move |&element| mesh.region(element) == region);
        let count = own.clone().count();
        let rings = own.flat_map(|element| {
            let ring = outline(mesh, element);
            let again = ring.first().copied();
            let points = ring.into_iter().chain(again).map(|[x, y]| (x, y));
            points.chain([GAP]).collect::<Vec<_>>()
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
        let is_far = points
            .last()
            .is_some_and(|last| (x - last.0).hypot(y - last.1) > 2.0 * longest);
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
    Line::through(arrows)
        .solid(INK, 0.6)
        .arrows(1)
        .name("outward normal of the contact edge")
}
