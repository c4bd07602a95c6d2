//! Bodies of equal sectors: a sheet of nodes and elements that is revolved about the z axis.

use super::{ElementKind, Mesh, NodalFrames};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// A node of one sector's sheets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetNode {
    /// Radius, m.
    pub radius: f64,
    /// Height over the bottom face, m; none in the plane.
    pub height: f64,
    /// Angle from the sector's corner sheet in halves of a sector, 0 or 1.
    pub half_step: usize,
    /// Place among the radii and heights, in halves of an element.
    pub place: [usize; 2],
}

impl SheetNode {
    /// Angle of the node in sector `sector` of `count`, rad.
    pub(super) fn angle(&self, sector: usize, count: usize) -> f64 {
        TAU * (sector as f64 + 0.5 * self.half_step as f64) / count as f64
    }
}

/// An element of one sector.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetElement {
    /// Its kind.
    pub kind: ElementKind,
    /// Nodes of the sector with their angle in halves of a sector, 0 to 2.
    pub nodes: Vec<(usize, usize)>,
    /// Its region.
    pub region: usize,
}

/// The elements between the nodes of a sheet, radial index fastest; `divisions` are their numbers along a radius and an axis.
pub(super) fn elements_between(
    nodes: &[SheetNode],
    kind: ElementKind,
    [radial, axial]: [usize; 2],
    region: impl Fn([usize; 2]) -> usize,
) -> Vec<SheetElement> {
    let index = nodes.iter().map(|node| (node.place, node.half_step)).zip(0..);
    let index: HashMap<_, usize> = index.collect();
    // Radially, around and axially, in halves of an element.
    let places = kind.node_places();
    let element = |at: [usize; 2]| {
        let node = |&[a, b, c]: &[f64; 3]| {
            let half = |i: usize, step: f64| (2 * i + 1).wrapping_add_signed(step as isize);
            let around = half(0, b);
            (index[&([half(at[0], a), half(at[1], c)], around % 2)], around)
        };
        SheetElement { kind, nodes: places.iter().map(node).collect(), region: region(at) }
    };
    (0..axial).flat_map(|j| (0..radial).map(move |i| [i, j])).map(element).collect()
}

/// The first `built` of `count` sectors in polar frames, closed to a ring where those are all; nodes sector by sector, of an open one
/// the last sheet behind them. Elements are copies of those of the first sector.
pub(super) fn revolved(
    nodes: &[SheetNode],
    elements: &[SheetElement],
    [built, count]: [usize; 2],
) -> Mesh {
    let built = built.min(count);
    let sheets = if built < count { built + 1 } else { count };
    let all = (0..sheets).flat_map(|sheet| nodes.iter().map(move |node| (sheet, node)));
    let angles: Vec<f64> = all.clone().map(|(sheet, node)| node.angle(sheet, count)).collect();
    let points = all.zip(&angles).map(|((_, node), angle)| {
        [node.radius * angle.cos(), node.radius * angle.sin(), node.height]
    });
    let mut mesh = Mesh {
        dimension: elements[0].kind.dimension(),
        nodes: points.collect(),
        frames: NodalFrames::Plane(angles),
        element_starts: vec![0],
        ..Mesh::default()
    };
    for sector in 0..built {
        for (first, element) in (0..).zip(elements) {
            let place = |&(k, half): &(usize, usize)| {
                ((sector + half / 2) % sheets * nodes.len() + k) as u32
            };
            let own = element.nodes.iter().map(place);
            mesh.push_element(element.kind, own, (element.region, first));
        }
    }
    mesh
}

/// One sector of a body of equal sectors: its elements, whose nodes are images of the sector's.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// The elements in polar frames; nodes of the sector and of the next one, in equal order.
    pub mesh: Mesh,
    /// Angle of each node of the sector in halves of a sector, 0 or 1.
    pub halves: Vec<usize>,
    /// Sectors of the body.
    pub count: usize,
    /// Which dofs of the sector are held, `d k + c` for component `c` (radial, tangential, axial) of node `k`.
    pub is_held: Vec<bool>,
    /// The nodes of the sector in the order of the unknowns, which makes narrow bands.
    order: Vec<usize>,
}

impl Strip {
    /// Of sector 0 of `count` with the nodes of its sheet; `is_held` asks for its dofs.
    pub(super) fn new(
        mesh: Mesh,
        (nodes, order): (&[SheetNode], Vec<usize>),
        count: usize,
        is_held: impl Fn(usize) -> bool,
    ) -> Self {
        let halves = nodes.iter().map(|node| node.half_step).collect();
        let is_held = (0..mesh.dimension * nodes.len()).map(is_held).collect();
        Self { mesh, halves, count, is_held, order }
    }

    /// The same with nothing that holds the sector.
    pub fn unheld(&self) -> Self {
        Self { is_held: vec![false; self.is_held.len()], ..self.clone() }
    }

    /// Nodes of the sector, held ones included.
    pub fn node_count(&self) -> usize {
        self.halves.len()
    }

    /// Dofs of the sector.
    pub fn dof_count(&self) -> usize {
        self.is_held.len()
    }

    /// Dofs of the sector that are held.
    pub fn held_dofs(&self) -> impl Iterator<Item = usize> {
        (0..self.is_held.len()).filter(|&dof| self.is_held[dof])
    }

    /// Dofs of the sector that are not held, in the order of the unknowns.
    pub fn free_dofs(&self) -> impl Iterator<Item = usize> {
        let components = self.mesh.dimension;
        let dofs = self
            .order
            .iter()
            .flat_map(move |node| (0..components).map(move |c| components * node + c));
        dofs.filter(|&dof| !self.is_held[dof])
    }

    /// What stands in rows for a node of the sector in the next one (1) or the one before (-1).
    pub fn node_ahead(&self, node: usize, sectors: isize) -> usize {
        node + self.node_count() * sectors.rem_euclid(3) as usize
    }

    /// Node of the sector that one of the strip, or what [`Self::node_ahead`] says, is an image of, and the angle there in halves
    /// of a sector.
    pub fn place(&self, node: usize) -> (usize, isize) {
        let (own, ahead) = (node % self.node_count(), [0, 2, -2][node / self.node_count()]);
        (own, ahead + self.halves[own] as isize)
    }

    /// Largest distance of two nodes of one element in the order of the unknowns.
    pub fn node_bandwidth(&self) -> usize {
        let mut rank = vec![0; self.order.len()];
        self.order.iter().enumerate().for_each(|(own, &node)| rank[node] = own);
        let spans = (0..self.mesh.element_count()).map(|element| {
            let own = self.mesh.element_nodes(element).iter();
            let own = own.map(|&node| rank[self.place(node as usize).0]);
            own.clone().max().unwrap_or(0) - own.min().unwrap_or(0)
        });
        spans.max().unwrap_or(0)
    }
}
