//! Results of `mesh` for solid bodies of a mesh file.

use super::{Measured, MeshSize, REGION_COLOURS, role_of};
use crate::charts::{MovingBody, SolidView};
use crate::prelude::*;
use frictionsim_chart::{MotionState, Surface};
use frictionsim_physics::mesh::{BoundaryFace, MeshQuality};

keys! {
    /// Size and quality of the mesh of solid bodies.
    SolidMeshStatistics {
        #[serde(flatten)]
        size: MeshSize = "counts; unknowns with those that are held";
        elements_by_kind: BTreeMap<String, usize> = "elements of each kind";
        bodies: usize = "parts that no element connects";
        lowest_m: [f64; 3] = "least coordinates, m";
        highest_m: [f64; 3] = "largest coordinates, m";
        #[serde(flatten)]
        shape: MeshQuality = "sizes and shapes of the elements";
        worst_element_at_m: [f64; 3] = "centre of the element that has it, m";
        volume_m3: f64 = "volume, m3";
        mass_kg: f64 = "mass, kg";
        regions: Vec<SolidRegion> = "regions with their elements, volumes and masses";
        boundaries: Vec<SolidBoundary> = "named surfaces and sets of nodes";
    }

    /// One region of solid bodies.
    SolidRegion, REGIONS {
        name: String = "its name", Always "region" Plain;
        elements: usize = "its elements", Always "elements" Count;
        volume_m3: f64 = "its volume", Always "volume" Scientific(6);
        mass_kg: f64 = "its mass", Always "mass" Fixed(6);
    }

    /// One named surface of solid bodies.
    SolidBoundary, BOUNDARIES {
        name: String = "its name", Always "boundary" Plain;
        nodes: usize = "its nodes", Always "nodes" Count;
        faces: usize = "its faces", Always "faces" Count;
        area_m2: f64 = "their area", Always "area" Scientific(6);
        condition: String = "what holds or loads it, or what it slides on, in a word",
            Always "condition" Plain;
    }
}

impl Measured for SolidMeshStatistics {
    fn section(&self) -> Section {
        let kinds = self.elements_by_kind.iter();
        let kinds: Vec<String> = kinds.map(|(kind, count)| format!("{count} {kind}")).collect();
        let point = |[x, y, z]: [f64; 3]| format!("({x:.6}, {y:.6}, {z:.6}) m");
        super::results(&self.size, &self.shape)
            .facts([
                ("elements by kind", kinds.join(", ")),
                ("separate bodies", self.bodies.to_string()),
                ("from", point(self.lowest_m)),
                ("to", point(self.highest_m)),
                ("worst element at", point(self.worst_element_at_m)),
                ("volume", format!("{:.6e} m3", self.volume_m3)),
                ("mass", format!("{:.6} kg", self.mass_kg)),
            ])
            .tables([
                Table::new("", "Regions").columns(REGIONS, &self.regions),
                Table::new("", "Boundaries").columns(BOUNDARIES, &self.boundaries),
            ])
    }
}

impl SolidMeshStatistics {
    /// Measures a mesh; `densities` are those of its regions, `roles` names boundaries that slide or are glued.
    pub fn new(mesh: &Mesh, densities: &[f64], roles: &BTreeMap<usize, &'static str>) -> Self {
        let quality = mesh.quality();
        let volumes = mesh.region_measures();
        let mut by_kind: BTreeMap<String, usize> = BTreeMap::new();
        let mut counts = vec![0; mesh.regions.len()];
        for element in 0..mesh.element_count() {
            let name = mesh.element_kind(element).name();
            *by_kind.entry(name.to_owned()).or_default() += 1;
            counts[mesh.region(element)] += 1;
        }
        let regions = mesh.regions.iter().enumerate().map(|(r, name)| SolidRegion {
            name: name.clone(),
            elements: counts[r],
            volume_m3: volumes[r],
            mass_kg: densities[r] * volumes[r],
        });
        let regions: Vec<SolidRegion> = regions.collect();
        let contacts = roles.iter().filter(|role| *role.1 == "contact");
        let contact_nodes: BTreeSet<u32> =
            contacts.flat_map(|role| mesh.boundaries[*role.0].nodes.iter().copied()).collect();
        let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            mesh.nodes.iter().map(|point| point[axis]).fold(start, pick)
        };
        let worst = mesh.element_nodes(quality.worst_element);
        let centre = [0, 1, 2].map(|axis| {
            let sum: f64 = worst.iter().map(|&node| mesh.nodes[node as usize][axis]).sum();
            sum / worst.len() as f64
        });
        Self {
            size: MeshSize::new(mesh, contact_nodes.len()),
            elements_by_kind: by_kind,
            bodies: 1 + mesh.bodies().into_iter().max().unwrap_or(0),
            lowest_m: [0, 1, 2].map(|axis| bound(axis, f64::min, f64::INFINITY)),
            highest_m: [0, 1, 2].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY)),
            shape: quality,
            worst_element_at_m: centre,
            volume_m3: regions.iter().map(|region| region.volume_m3).sum(),
            mass_kg: regions.iter().map(|region| region.mass_kg).sum(),
            regions,
            boundaries: boundaries_of(mesh, roles),
        }
    }
}

/// The named boundaries of a mesh; `roles` of those that slide or are glued.
fn boundaries_of(mesh: &Mesh, roles: &BTreeMap<usize, &'static str>) -> Vec<SolidBoundary> {
    let boundaries = mesh.boundaries.iter().enumerate().map(|(b, boundary)| SolidBoundary {
        name: boundary.name.clone(),
        nodes: boundary.nodes.len(),
        faces: boundary.faces.len(),
        area_m2: mesh.face_area(&boundary.faces),
        condition: role_of(mesh, b, roles).to_owned(),
    });
    boundaries.collect()
}

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
pub fn figure(mesh: &Mesh, title: &str, roles: &BTreeMap<usize, &'static str>) -> Figure {
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
        .motion(Motion { states: states.to_vec(), ..body.at_rest() })
}

fn panel(surface: Surface, caption: String) -> Panel {
    Panel::plane(surface.window(0.05)).height(210.0).caption(caption).layer(surface)
}

/// The kind of each face of a boundary that holds, loads or touches, by its nodes. A face of several boundaries is of
/// the first kind.
fn conditions_of_faces(
    mesh: &Mesh,
    roles: &BTreeMap<usize, &'static str>,
) -> BTreeMap<Vec<u32>, usize> {
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
