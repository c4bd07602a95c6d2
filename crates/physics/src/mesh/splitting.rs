//! Elements split into parts alike, with nodes that neighbours share: what refinement is, in the plane and in space.

use super::ElementKind;
use super::error::BodyError;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Steps into which the share of a corner in a place is counted: parts have corners at halves of an element's edges and
/// mid-side nodes at quarters, so that a brick has shares of 1 / 64.
pub(super) const STEPS: u8 = 64;

/// A place of the mesh: corners with their linear shares in it, which all elements around it agree on.
pub(super) type Place = Vec<(u32, u8)>;

/// The nodes of a finer mesh.
pub(super) struct Splitting {
    /// By their places.
    pub places: BTreeMap<Place, u32>,
    /// Where they lie: those of the coarse mesh, then new ones.
    pub points: Vec<[f64; 3]>,
    /// Corners of the parts of each kind in the parent element.
    parts: BTreeMap<ElementKind, Vec<Vec<[f64; 3]>>>,
}

impl Splitting {
    /// That of a mesh with so many unknowns at each of its nodes.
    ///
    /// # Errors
    /// [`BodyError::Body`] where the finer mesh would have too many nodes.
    pub fn of(points: &[[f64; 3]], dimension: usize) -> Result<Self, BodyError> {
        // Indices are 32 bits wide.
        let most = u32::MAX as usize / dimension;
        if points.len().saturating_mul(1 << dimension) > most {
            return Err(BodyError::Body(format!(
                "a refinement of {} nodes has more than {most}: refine less",
                points.len()
            )));
        }
        let (places, parts) = (BTreeMap::new(), BTreeMap::new());
        Ok(Self { places, points: points.to_vec(), parts })
    }

    /// The parts of an element. New nodes lie where its shape functions put them, but where `curved` knows better.
    pub fn split(
        &mut self,
        kind: ElementKind,
        own: &[u32],
        curved: impl Fn(&Self, &Place) -> Option<[f64; 3]>,
    ) -> Vec<(ElementKind, Vec<u32>)> {
        // Its own nodes are nodes of its parts: corners, and middles of edges as corners between them.
        let corners = kind.corner_count();
        for &corner in &own[..corners] {
            self.places.insert(vec![(corner, STEPS)], corner);
        }
        for (middle, ends) in kind.middles() {
            let [p, q] = ends.map(|end| own[end]);
            self.places.insert(between(p, STEPS / 2, q), own[middle]);
        }
        let parts = self.parts.entry(kind).or_insert_with(|| parts_of(kind)).clone();
        let parts = parts.into_iter().map(|mut at| {
            let child = kind.with_corners(at.len(), kind.is_quadratic());
            let middle = |(_, [p, q]): (usize, [usize; 2])| {
                [0, 1, 2].map(|axis| 0.5 * (at[p][axis] + at[q][axis]))
            };
            let middles: Vec<[f64; 3]> = child.middles().map(middle).collect();
            at.extend(middles);
            let nodes = at.into_iter().map(|at| self.node(kind, own, at, &curved));
            (child, nodes.collect())
        });
        parts.collect()
    }

    /// The node at a place of an element, a new one where no element has had it.
    fn node(
        &mut self,
        kind: ElementKind,
        own: &[u32],
        at: [f64; 3],
        curved: &impl Fn(&Self, &Place) -> Option<[f64; 3]>,
    ) -> u32 {
        let linear = kind.with_corners(kind.corner_count(), false);
        let shares = own.iter().zip(linear.shape_functions(at));
        let steps =
            shares.map(|(&corner, (share, _))| (corner, (f64::from(STEPS) * share).round() as u8));
        let mut place: Place = steps.filter(|(_, steps)| *steps > 0).collect();
        place.sort_unstable();
        if let Some(&node) = self.places.get(&place) {
            return node;
        }
        let point = curved(self, &place).unwrap_or_else(|| {
            let mut point = [0.0; 3];
            for (&node, (share, _)) in own.iter().zip(kind.shape_functions(at)) {
                let position = self.points[node as usize];
                (0..3).for_each(|axis| point[axis] += share * position[axis]);
            }
            point
        });
        let node = self.points.len() as u32;
        self.points.push(point);
        self.places.insert(place, node);
        node
    }

    /// Labels of all nodes: new ones count on from the largest.
    pub fn labels(&self, coarse: &[usize]) -> Vec<usize> {
        let next = 1 + coarse.iter().copied().max().unwrap_or(0);
        coarse.iter().copied().chain(next..).take(self.points.len()).collect()
    }
}

/// The place between two corners in which the first has so many steps.
pub(super) fn between(p: u32, steps: u8, q: u32) -> Place {
    let mut place = vec![(p, steps), (q, STEPS - steps)];
    place.sort_unstable();
    place
}

/// Corners of the parts of a parent element.
///
/// All but tetrahedra, triangles and pyramids are halved along each edge. A triangle has another one amid those at its corners.
/// A tetrahedron has one part at each corner, and the octahedron between them is cut along one diagonal (Bey 1995), which keeps
/// the parts of all further splits to three shapes. A pyramid has one at each corner, one that hangs from the apex of these to
/// the middle of the base, and tetrahedra between.
fn parts_of(kind: ElementKind) -> Vec<Vec<[f64; 3]>> {
    let corners = &kind.node_places()[..kind.corner_count()];
    let between =
        |p: usize, q: usize| [0, 1, 2].map(|axis| 0.5 * (corners[p][axis] + corners[q][axis]));
    let at_corner = |corner: usize| -> Vec<[f64; 3]> {
        (0..corners.len()).map(|other| between(corner, other)).collect()
    };
    let mut parts: Vec<Vec<[f64; 3]>> = (0..corners.len()).map(at_corner).collect();
    let amid = [(0, 1), (1, 2), (2, 0)];
    match kind.with_corners(corners.len(), false) {
        ElementKind::Tri3 => parts.push(amid.map(|(p, q)| between(p, q)).into()),
        ElementKind::Tet4 => {
            let [a, b, c] = [between(0, 1), between(0, 2), between(0, 3)];
            let [d, e, f] = [between(1, 2), between(1, 3), between(2, 3)];
            let inner = [[a, b, c, e], [a, b, d, e], [b, c, e, f], [b, d, e, f]];
            parts.extend(inner.map(upright));
        }
        ElementKind::Wedge6 => {
            // The triangle amid those at the corners, in both layers.
            for layer in [0, 3] {
                let flat = |level: usize| {
                    amid.map(|(p, q)| {
                        let middle = between(p, q);
                        [middle[0], middle[1], 0.5 * (corners[level][2] + corners[layer][2])]
                    })
                };
                parts.push([flat(0), flat(3)].concat());
            }
        }
        ElementKind::Pyramid5 => {
            let foot = [0.0; 3];
            let rising = |corner: usize| between(corner, 4);
            parts.push(vec![rising(0), rising(3), rising(2), rising(1), foot]);
            for (p, q) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
                parts.push(upright([between(p, q), foot, rising(p), rising(q)]));
            }
        }
        _ => {}
    }
    parts
}

/// Corners of a tetrahedron in an order of positive volume.
fn upright(mut corners: [[f64; 3]; 4]) -> Vec<[f64; 3]> {
    let edge = |k: usize| Vector3::from(corners[k]) - Vector3::from(corners[0]);
    if edge(1).cross(&edge(2)).dot(&edge(3)) < 0.0 {
        corners.swap(0, 1);
    }
    corners.into()
}
