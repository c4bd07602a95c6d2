//! Fields over a body as layers.

use crate::cartesian_vectors;
use crate::prelude::*;
use frictionsim_chart::{self, Field};

/// A body as figures show it.
#[derive(Clone)]
pub struct Disc<'a> {
    pub(crate) mesh: &'a Mesh,
    shown: Arc<frictionsim_chart::Mesh>,
}

impl<'a> Disc<'a> {
    /// The elements and edges of a mesh.
    pub fn new(mesh: &'a Mesh) -> Self {
        Self::with_lattice(mesh, 0)
    }

    /// The same with about so many rays of nodes, and circles to match, as thin lines that show a deformation; a body
    /// that is no uniform annulus shows none.
    pub fn with_lattice(mesh: &'a Mesh, rays: usize) -> Self {
        let elements = 0..mesh.element_count();
        let is_quadratic = |element| mesh.element_kind(element).is_quadratic();
        let shown = frictionsim_chart::Mesh {
            rings: elements.clone().map(|element| mesh.element_outline(element)).collect(),
            are_quadratic: elements.map(is_quadratic).collect(),
            outlines: outlines(mesh),
            lines: if rays > 0 && mesh.is_cyclic { lattice(mesh, rays) } else { Vec::new() },
        };
        Self { mesh, shown: Arc::new(shown) }
    }

    /// A panel without axes for fields on the undeformed body, with a little room.
    pub fn panel(&self, room: f64) -> Panel {
        Panel::plane(Field::window(&self.mesh.plane_nodes(), room))
    }

    /// Values at the nodes, on the undeformed body.
    pub fn field(&self, values: Vec<f64>, axis: Axis, map: ColourMap) -> Field {
        Field::new(self.shown.clone(), self.mesh.plane_nodes(), values, axis, map)
    }

    /// Values on the body deformed by a displacement (in nodal frames, two values a node, m) times `magnification`.
    pub fn deformed(
        &self,
        values: Vec<f64>,
        displacement: &[f64],
        magnification: f64,
        axis: Axis,
    ) -> Field {
        let moves = cartesian_vectors(self.mesh, displacement);
        let places = self.mesh.nodes.iter().zip(moves.chunks_exact(3));
        let places = places.map(|(at, u)| [0, 1].map(|k| at[k] + magnification * u[k]));
        Field::new(self.shown.clone(), places.collect(), values, axis, ColourMap::Viridis).coarse()
    }

    /// The contact edge, undeformed.
    pub fn contact_edge(&self) -> Vec<(f64, f64)> {
        let edge = self.mesh.contact_edge();
        let again = edge.nodes.first().filter(|_| edge.is_closed);
        let places =
            edge.nodes.iter().chain(again).map(|&node| self.mesh.plane_node(node as usize));
        places.map(|[x, y]| (x, y)).collect()
    }

    /// Smallest distance of the contact edge from the origin, m, and the angle of its first node.
    pub fn contact_place(&self) -> (f64, f64) {
        let edge = &self.mesh.contact_edge().nodes;
        let radius =
            self.contact_edge().iter().map(|p| p.0.hypot(p.1)).fold(f64::INFINITY, f64::min);
        let first = edge.first().and_then(|&node| self.mesh.frame_angles().get(node as usize));
        (radius, first.copied().unwrap_or(0.0))
    }
}

/// The boundaries of the annulus; on any other body its rim, edge by edge: its curves may be in pieces.
fn outlines(mesh: &Mesh) -> Vec<Vec<u32>> {
    if mesh.is_cyclic {
        return mesh.boundaries.iter().map(|edge| edge.nodes.clone()).collect();
    }
    let edges = mesh.outline_edges().into_iter();
    edges
        .map(|(start, end, middle)| std::iter::once(start).chain(middle).chain([end]).collect())
        .collect()
}

/// Every few rays and circles of nodes, found by their equal angle and radius.
fn lattice(mesh: &Mesh, wanted: usize) -> Vec<Vec<u32>> {
    let size = mesh.nodes.iter().map(|[x, y, _]| x.hypot(*y)).fold(f64::MIN_POSITIVE, f64::max);
    let mut rays: BTreeMap<i64, Vec<u32>> = BTreeMap::new();
    let mut circles: BTreeMap<i64, Vec<u32>> = BTreeMap::new();
    for (node, &[x, y, _]) in mesh.nodes.iter().enumerate() {
        let ray = (mesh.frame_angles()[node] * 1e6).round() as i64;
        let circle = (x.hypot(y) / size * 1e6).round() as i64;
        rays.entry(ray).or_default().push(node as u32);
        circles.entry(circle).or_default().push(node as u32);
    }
    let mut lattice = Vec::new();
    for (lines, count, is_closed) in [(rays, wanted, false), (circles, wanted.div_ceil(3), true)] {
        let lines: Vec<Vec<u32>> = lines.into_values().collect();
        // Spread evenly, also where the count does not divide the lines there are.
        let count = count.min(lines.len());
        let chosen = (0..count).map(|index| &lines[index * lines.len() / count]);
        for nodes in chosen.filter(|nodes| nodes.len() > 2) {
            let again = nodes.first().filter(|_| is_closed);
            lattice.push(nodes.iter().chain(again).copied().collect());
        }
    }
    lattice
}
