//! Results of `mesh` for plane bodies and bodies of revolution.

use super::{Measured, MeshSize, REGION_COLOURS, condition_name, write_nodes};
use crate::prelude::*;
use crate::{FolderError, OutputFolder};
use frictionsim_chart::{Field as Window, TextStyle};
use frictionsim_physics::mesh::{
    AnnulusMesh, Boundary, BoundaryCondition, MeshQuality, SolidContact,
};

keys! {
    /// Size and quality of a mesh.
    MeshStatistics {
        #[serde(flatten)]
        size: MeshSize = "counts";
        axial_elements?: usize = "layers of bricks over the thickness of a body in three \
            dimensions. Edges, quality and areas are of its plane section then";
        nodes_per_sector?: usize = "on the annulus, nodes of one ray of corner nodes: node \
            `1 + j (nodes_per_sector) + i`";
        #[serde(flatten)]
        shape: MeshQuality = "sizes and shapes of the elements";
        unnamed_free_edges?: usize = "edges of one element alone that belong to no named boundary, of a mesh file";
        area_m2: f64 = "area of the mesh, m2";
        area_error?: f64 = "its relative difference to the annulus";
        elements_per_wavelength?: f64 = "elements for each shear wavelength at the highest \
            frequency of the case, where it has one: the largest edge counts";
        contact_nodes_per_wave?: f64 = "contact nodes for each such wave, where they are farthest apart on average";
        regions: Vec<RegionStatistics> = "regions with their elements and areas";
        boundaries: Vec<BoundaryStatistics> = "boundaries with their nodes and lengths; faces of a \
            body of revolution with their areas";
    }

    /// One region of a mesh.
    RegionStatistics, REGIONS {
        name: String = "its name", Always "region" Plain;
        elements: usize = "its elements", Always "elements" Count;
        area_m2: f64 = "its area", Always "area" Scientific(6);
    }

    /// One boundary of a mesh.
    BoundaryStatistics, BOUNDARIES {
        name: String = "its name", Always "boundary" Plain;
        nodes: usize = "its nodes", Always "nodes" Count;
        length_m: Option<f64> = "its length, around a face of a body of revolution",
            IfAny "length" Scientific(6);
        area_m2?: f64 = "its area, of a face of a body of revolution", IfAny "area" Scientific(6);
        condition: String = "what holds it, in a word", Always "condition" Plain;
    }
}

impl Measured for MeshStatistics {
    fn section(&self) -> Section {
        let number = |name: &'static str, value: Option<f64>, format: Format| {
            Some((name, format.number(value?)))
        };
        let few = Format::Significant(5);
        let further = [
            number("area off the annulus by", self.area_error, Format::Scientific(1)),
            number("elements per wavelength", self.elements_per_wavelength, few),
            number("contact nodes per wave", self.contact_nodes_per_wave, few),
        ];
        let layers = self.axial_elements.map(|layers| {
            format!(
                "{layers} layers of bricks over the thickness; edges, quality, areas and picture \
                are of the section across the axis"
            )
        });
        let place = match self.axial_elements {
            Some(_) => "k, k in the sheet of a sector",
            None => "i, i outwards along a ray",
        };
        let ids = self.nodes_per_sector;
        let ids = ids.map(|nodes| format!("node ids: 1 + j {nodes} + {place}, j around from +x"));
        let free = match self.unnamed_free_edges {
            None | Some(0) => None,
            Some(1) => Some("1 free edge is in no physical curve".to_owned()),
            Some(count) => Some(format!("{count} free edges are in no physical curve")),
        };
        super::results(&self.size, &self.shape)
            .facts([("area", Format::Scientific(6).text(self.area_m2, "m2"))])
            .facts(further.into_iter().flatten())
            .tables([
                Table::new("", "Regions").columns(REGIONS, &self.regions),
                Table::new("", "Boundaries").columns(BOUNDARIES, &self.boundaries),
            ])
            .text([layers, ids, free].into_iter().flatten())
    }
}

impl MeshStatistics {
    /// Counts of the body of revolution whose plane section was measured.
    pub fn turn(&mut self, sector: &SolidSector) {
        let sectors = sector.sector_count();
        self.size.nodes = sectors * sector.node_count();
        self.size.elements = sectors * sector.elements.len();
        self.size.dofs = 3 * self.size.nodes;
        self.size.contact_nodes = sector.rings.iter().map(|ring| sectors * ring.nodes.len()).sum();
        self.axial_elements = Some(sector.specification.axial_elements);
        self.nodes_per_sector = Some(sector.node_count());
        if sector.specification.contact != SolidContact::Inner {
            self.contact_nodes_per_wave = None;
        }
        let (own, edges) = (&sector.specification, std::mem::take(&mut self.boundaries));
        let faces = SolidFace::ALL.into_iter().zip(own.conditions).map(|(face, condition)| {
            let edge = edges.iter().find(|edge| edge.name == face.name());
            let length_m = edge.and_then(|edge| edge.length_m);
            let nodes = (0..sector.node_count()).filter(|&node| sector.is_on(node, face));
            let is_contact = face == own.contact.face();
            BoundaryStatistics {
                name: face.name().to_owned(),
                nodes: sectors * nodes.count(),
                length_m,
                area_m2: Some(length_m.map_or(self.area_m2, |length| length * own.thickness)),
                condition: if is_contact { "contact" } else { condition_name(condition) }
                    .to_owned(),
            }
        });
        self.boundaries = faces.collect();
    }

    /// Measures a mesh between its corner nodes; areas follow curved edges. `wavelength` is the shortest that the case
    /// is about, m.
    pub fn new(mesh: &Mesh, annulus: Option<&AnnulusMesh>, wavelength: Option<f64>) -> Self {
        let quality = mesh.quality();
        let empty =
            |name: &String| RegionStatistics { name: name.clone(), elements: 0, area_m2: 0.0 };
        let mut regions: Vec<RegionStatistics> = mesh.regions.iter().map(empty).collect();
        for element in 0..mesh.element_count() {
            let region = &mut regions[mesh.region(element)];
            region.elements += 1;
            region.area_m2 += mesh.element_measure(element);
        }
        let area: f64 = regions.iter().map(|region| region.area_m2).sum();
        let exact = |annulus: &AnnulusMesh| {
            let spec = &annulus.specification;
            let bore = spec.shaft.map_or(spec.inner_radius, |shaft| shaft.inner_radius);
            std::f64::consts::PI * (spec.outer_radius.powi(2) - bore.powi(2))
        };
        let contact = mesh.contact_edge();
        let contact_length: f64 = contact.tributary_lengths.iter().sum();
        let spacing = contact_length / contact.nodes.len() as f64;
        let boundaries = mesh.boundaries.iter().enumerate().map(|(b, boundary)| {
            let condition = match b {
                b if b == mesh.contact => "contact",
                b if Some(b) == mesh.opposite => "counterface",
                _ => condition_name(boundary.condition),
            };
            BoundaryStatistics {
                name: boundary.name.clone(),
                nodes: boundary.nodes.len(),
                length_m: Some(boundary.tributary_lengths.iter().sum()),
                area_m2: None,
                condition: condition.to_owned(),
            }
        });
        Self {
            size: MeshSize::new(mesh, contact.nodes.len()),
            axial_elements: None,
            nodes_per_sector: annulus.map(AnnulusMesh::sector_node_count),
            shape: quality,
            unnamed_free_edges: (!mesh.labels.is_empty())
                .then(|| mesh.unnamed_edge_count())
                .flatten(),
            area_m2: area,
            area_error: annulus.map(|annulus| (area / exact(annulus) - 1.0).abs()),
            elements_per_wavelength: wavelength.map(|length| length / quality.largest_edge_m),
            contact_nodes_per_wave: wavelength.map(|length| length / spacing),
            regions,
            boundaries: boundaries.collect(),
        }
    }
}

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

/// Nodes around an element, mid-side nodes between their corners.
fn outline(mesh: &Mesh, element: usize) -> Vec<[f64; 2]> {
    mesh.element_outline(element).into_iter().map(|node| mesh.plane_node(node as usize)).collect()
}

/// The edges of the elements, region by region.
fn elements(mesh: &Mesh) -> Vec<Line> {
    let counts = (0..mesh.regions.len().max(1)).map(|region| {
        let own = (0..mesh.element_count()).filter(move |&element| mesh.region(element) == region);
        let count = own.clone().count();
        let rings = own.flat_map(|element| {
            let ring = outline(mesh, element);
            let again = ring.first().copied();
            ring.into_iter().chain(again).map(|[x, y]| (x, y)).chain([GAP]).collect::<Vec<_>>()
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
