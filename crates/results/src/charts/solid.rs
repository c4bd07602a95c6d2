//! Solid bodies of a mesh file as pictures: their outer surface from one point of view.

use crate::prelude::*;
use frictionsim_chart::SurfaceMesh;

/// Cosine of the angle between two faces below which their common edge is drawn.
const SHARP: f64 = 0.75;

/// The surface of solid bodies seen along a direction.
pub struct SolidView<'a> {
    mesh: &'a Mesh,
    faces: Vec<BoundaryFace>,
    /// Nodes of the faces, ascending: those that are shown.
    nodes: Vec<u32>,
    shown: Arc<SurfaceMesh>,
    /// Unit vectors to the right, upwards and towards the viewer.
    axes: [Vector3<f64>; 3],
}

impl<'a> SolidView<'a> {
    /// All bodies from the front, the right and above, `z` upwards.
    pub fn new(mesh: &'a Mesh) -> Self {
        let towards = Vector3::new(0.5, -0.72, 0.62).normalize();
        Self::upright(mesh, mesh.outer_faces(), towards, Vector3::z())
    }

    /// The same turned over: from behind and below, `z` downwards.
    pub fn turned_over(mesh: &'a Mesh) -> Self {
        let towards = Vector3::new(0.5, 0.72, -0.62);
        Self::upright(mesh, mesh.outer_faces(), towards, -Vector3::z())
    }

    /// One boundary from outside, along its mean normal.
    pub fn of_boundary(mesh: &'a Mesh, boundary: usize) -> Self {
        let faces = mesh.boundaries[boundary].faces.clone();
        let normals = mesh.nodal_normals(&faces);
        let sum: Vector3<f64> = normals.values().map(|&normal| Vector3::from(normal)).sum();
        let towards = sum.try_normalize(0.0).unwrap_or(Vector3::z());
        // Upwards is z, but for what is seen along it.
        let up = if towards.z.abs() > 0.9 { Vector3::y() } else { Vector3::z() };
        Self::upright(mesh, faces, towards, up)
    }

    /// Faces seen from a direction, another one upwards.
    fn upright(
        mesh: &'a Mesh,
        faces: Vec<BoundaryFace>,
        towards: Vector3<f64>,
        up: Vector3<f64>,
    ) -> Self {
        let towards = towards.normalize();
        let right = up.cross(&towards).normalize();
        let mut nodes: Vec<u32> = faces.iter().flat_map(|face| face.nodes.clone()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let own = |triangle: [u32; 3]| triangle.map(|node| place_among(&nodes, node));
        let shown = SurfaceMesh {
            triangles: faces.iter().flat_map(triangles).map(own).collect(),
            edges: edges(mesh, &faces, &nodes, false),
        };
        let axes = [right, towards.cross(&right), towards];
        Self { mesh, faces, nodes, shown: Arc::new(shown), axes }
    }

    /// Values at the nodes (NaN: none) on the bodies displaced by `displacement` (nodal frames, three values a node, m)
    /// times `magnification`.
    pub fn surface(
        &self,
        values: &[f64],
        (displacement, magnification): (&[f64], f64),
        axis: Axis,
        map: ColourMap,
    ) -> Surface {
        let place = |&node: &u32| {
            let node = node as usize;
            let mut place = Vector3::from(self.mesh.nodes[node]);
            if let Some(u) = displacement.get(3 * node..3 * node + 3) {
                place += self.mesh.frame(node) * Vector3::from_column_slice(u) * magnification;
            }
            self.seen(place)
        };
        let value = |&node: &u32| values.get(node as usize).copied().unwrap_or(f64::NAN);
        let values = self.nodes.iter().map(value).collect();
        let positions = self.nodes.iter().map(place).collect();
        Surface::new(Arc::clone(&self.shown), positions, values, axis, map)
    }

    /// The bodies with the edges of their elements, each face in the colour of its part; `parts` has colour and name of
    /// each ("": not in the legend).
    pub fn parts(
        &self,
        part_of: impl Fn(&BoundaryFace) -> usize,
        parts: Vec<(&'static str, String)>,
    ) -> Surface {
        let shown = SurfaceMesh {
            triangles: self.shown.triangles.clone(),
            edges: edges(self.mesh, &self.faces, &self.nodes, true),
        };
        let place = |&node: &u32| self.seen(Vector3::from(self.mesh.nodes[node as usize]));
        let positions = self.nodes.iter().map(place).collect();
        let of_face = |face: &BoundaryFace| vec![part_of(face); triangles(face).len()];
        let part_of = self.faces.iter().flat_map(of_face).collect();
        let parts = parts.into_iter().map(|(colour, name)| (colour.into(), name)).collect();
        Surface::of_parts(Arc::new(shown), positions, part_of, parts)
    }

    /// A picture of values at the nodes (NaN: none) on the bodies as they are, with `room` around it.
    pub fn panel(&self, values: &[f64], axis: Axis, map: ColourMap, room: f64) -> Panel {
        let surface = self.surface(values, (&[], 0.0), axis, map);
        Panel::plane(surface.window(room)).height(150.0).layer(surface)
    }

    /// Where a place of the bodies lies in the picture: m to the right, upwards and towards the viewer.
    fn seen(&self, place: Vector3<f64>) -> [f64; 3] {
        self.axes.map(|axis| axis.dot(&place))
    }

    /// Largest extent of the bodies along an axis, m.
    pub fn size(&self) -> f64 {
        let along = |axis: usize| {
            let (low, high) = extremes(self.mesh.nodes.iter().map(|place| place[axis]));
            high - low
        };
        (0..3).map(along).fold(f64::MIN_POSITIVE, f64::max)
    }
}

/// A traction at nodes (Pa; NaN: grey) on each contact surface, seen from outside along its mean normal; `surfaces` has
/// the name and the boundary of each. `arrows` are ends of an arrow on the surface of the same place among them.
pub fn contact_surfaces(
    (name, caption): (&str, &str),
    (mesh, surfaces): (&Mesh, &[(String, usize)]),
    (traction, values, arrows): (&str, &[f64], &[[[f64; 3]; 2]]),
) -> Figure {
    let largest = values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let axis = || Axis::new(traction, "Pa").prefixed().between(0.0, largest);
    let panels = surfaces.iter().enumerate().map(|(k, (name, boundary))| {
        let view = SolidView::of_boundary(mesh, *boundary);
        let at = |end: [f64; 3]| {
            let [x, y, _] = view.seen(end.into());
            (x, y)
        };
        let arrow = |ends: &[[f64; 3]; 2]| Line::through(ends.map(at)).solid("black", 1.2);
        let arrows = arrows.get(k).map(|ends| arrow(ends).arrows(1));
        view.panel(values, axis(), ColourMap::Viridis, 0.05).caption(literal(name)).layers(arrows)
    });
    let figure = Figure::new(name, caption).columns(surfaces.len().clamp(1, 3)).panels(panels);
    figure.colour_foot(axis(), ColourMap::Viridis)
}

/// Speed over the surface of solid bodies in several frames, each a heading and a velocity field (nodal frames, m/s),
/// each picture with colours of its own.
pub fn speeds_of_bodies<'a>(
    mesh: &Mesh,
    caption: &str,
    frames: impl Iterator<Item = (String, &'a [f64])>,
) -> Figure {
    let view = SolidView::new(mesh);
    let panels = frames.map(|(heading, velocity)| {
        let speeds = velocity.chunks_exact(3);
        let speeds: Vec<f64> = speeds.map(|v| v[0].hypot(v[1]).hypot(v[2])).collect();
        let axis = Axis::new("velocity |*v*|", "m/s");
        view.panel(&speeds, axis, ColourMap::Viridis, 0.04).heading(heading).colour_bar(Side::Below)
    });
    let panels: Vec<Panel> = panels.collect();
    Figure::new("velocity", caption).columns(panels.len().clamp(1, 3)).panels(panels)
}

/// The triangles between the nodes of a face.
fn triangles(face: &BoundaryFace) -> Vec<[u32; 3]> {
    let parts: &[[usize; 3]] = match face.nodes.len() {
        3 => &[[0, 1, 2]],
        4 => &[[0, 1, 2], [0, 2, 3]],
        6 => &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
        8 => &[[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]],
        _ => &[],
    };
    parts.iter().map(|part| part.map(|node| face.nodes[node])).collect()
}

/// Place of a node among those shown, which are ascending and hold it.
fn place_among(shown: &[u32], node: u32) -> u32 {
    shown.partition_point(|&own| own < node) as u32
}

/// Edges drawn, in steps between their nodes by their places among those shown.
fn edges(mesh: &Mesh, faces: &[BoundaryFace], shown: &[u32], all: bool) -> Vec<[u32; 2]> {
    let paths = edge_paths(mesh, faces, all);
    let steps = paths.iter().flat_map(|path| path.windows(2));
    steps.map(|step| [step[0], step[1]].map(|node| place_among(shown, node))).collect()
}

/// Nodes along each edge between faces that meet at an angle, between regions, and at the rim of open surfaces; or
/// along all.
pub(super) fn edge_paths(mesh: &Mesh, faces: &[BoundaryFace], all: bool) -> Vec<Vec<u32>> {
    type Side = (Vector3<f64>, usize);
    let mut edges: BTreeMap<[u32; 2], (Vec<u32>, Vec<Side>)> = BTreeMap::new();
    for face in faces {
        let corners = face.kind.corner_count();
        let [a, b, c] = [0, 1, 2].map(|k| Vector3::from(mesh.nodes[face.nodes[k] as usize]));
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default();
        let side = (normal, mesh.region(face.element as usize));
        for edge in 0..corners {
            let (p, q) = (face.nodes[edge], face.nodes[(edge + 1) % corners]);
            let middle = face.nodes.get(corners + edge).copied();
            let path = [Some(p), middle, Some(q)].into_iter().flatten().collect();
            edges.entry([p.min(q), p.max(q)]).or_insert_with(|| (path, Vec::new())).1.push(side);
        }
    }
    let is_sharp = |sides: &[Side]| match sides {
        _ if all => true,
        [one, other] => one.1 != other.1 || one.0.dot(&other.0) < SHARP,
        _ => true,
    };
    edges.into_values().filter(|(_, sides)| is_sharp(sides)).map(|(path, _)| path).collect()
}
