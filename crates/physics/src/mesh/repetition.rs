//! A body of equal sectors from one of them.

use super::coincidence::coincident_nodes;
use super::error::{BodyError, BodyPart};
use super::faces::{FaceKey, face_key};
use super::grid::Grid;
use super::plane_body::{plane_body, used_nodes};
use super::solid_body::solid_elements;
use super::{BoundaryFace, CyclicSymmetry, Mesh};
use frictionsim_formats::{Equation, FileElement, FileMesh};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// Distance up to which a node of one cut face lies where one of the other comes to lie, over the shortest edge of the sector.
const MATCHED: f64 = 1e-3;
/// Most nodes of a mesh: indices of dofs are 32 bits wide.
const MOST_NODES: usize = (u32::MAX / 3) as usize;
/// Nodes that a message names.
const NAMED: usize = 4;

/// The whole body whose sector is in the file: `symmetry.count` copies, each turned by `2 pi / count` against the one before and
/// joined to it where its first cut face meets the other's second. Coordinates and `symmetry.point` have one unit.
///
/// The cut faces are found: faces that the turn by one sector brings onto another, node by node and in a region of both. Nodes
/// come sector by sector in equal order; those of the first keep their numbers, further ones add a multiple of a power of ten.
///
/// # Errors
/// [`BodyError::Request`] where no faces meet, where they meet but their nodes do not, where a node lies on the axis.
pub fn repeated_file(file: &FileMesh, symmetry: &CyclicSymmetry) -> Result<FileMesh, BodyError> {
    let count = symmetry.count;
    let index_of = used_nodes(file)?;
    let nodes = index_of.len();
    if nodes.saturating_mul(count) > MOST_NODES {
        return Err(BodyPart::Sectors
            .refused(format!("{count} sectors of {nodes} nodes have more than {MOST_NODES}")));
    }
    let sector = match file.dimension {
        3 => solid_elements(file, 1.0, &index_of)?,
        _ => plane_body(file, 1.0)?,
    };
    let cut = Cut::of(&sector, symmetry)?;
    cut.check_faces(&sector, symmetry)?;

    let copies = Copies::of(&sector, &cut, (&index_of, count));
    let node_stride = stride(sector.labels.iter().copied().max());
    let element_stride = stride(file.elements.iter().map(|e| e.label).max());

    // Nodes and elements sector by sector.
    let (mut points, mut labels, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..count {
        let turn = symmetry.turn(j);
        for &node in &copies.own {
            points.push(symmetry.turned(&turn, sector.nodes[node]));
            labels.push(sector.labels[node] + j * node_stride);
        }
        elements.extend(file.elements.iter().map(|element| FileElement {
            label: element.label + j * element_stride,
            nodes: element.nodes.iter().map(|&node| copies.node(node, j)).collect(),
            ..element.clone()
        }));
    }

    // What has a name has the copies of all sectors; nodes of two of them are in a set once.
    let curves =
        copies.named(&file.curves, |&(p, q, middle), node| (node(p), node(q), middle.map(node)));
    let surfaces = copies.named(&file.surfaces, |(kind, nodes), node| {
        (*kind, nodes.iter().map(|&own| node(own)).collect())
    });
    let mut node_sets = copies.named(&file.node_sets, |&own, node| node(own));
    node_sets.values_mut().for_each(|nodes| nodes.sort_unstable());
    node_sets.values_mut().for_each(Vec::dedup);
    Ok(FileMesh {
        is_used: vec![true; points.len()],
        dimension: file.dimension,
        model: file.model.clone(),
        symmetry: Some(*symmetry),
        curves,
        surfaces,
        node_sets,
        points,
        labels,
        elements,
        equations: copies.equations(file, symmetry),
    })
}

/// What labels rise by from sector to sector: the power of ten above the largest.
fn stride(largest: Option<usize>) -> usize {
    10_usize.saturating_pow(largest.unwrap_or(0).max(1).ilog10() + 1)
}

/// Where the nodes of a file stand in the whole body.
struct Copies<'a> {
    cut: &'a Cut,
    index_of: &'a [Option<u32>],
    count: usize,
    /// Nodes of a sector that are no others' of the next one, and the place of each among them.
    own: Vec<usize>,
    place: Vec<usize>,
}

impl<'a> Copies<'a> {
    fn of(sector: &Mesh, cut: &'a Cut, (index_of, count): (&'a [Option<u32>], usize)) -> Self {
        let is_own = |node: &usize| !cut.first_of.contains_key(&(*node as u32));
        let own: Vec<usize> = (0..sector.node_count()).filter(is_own).collect();
        let mut place = vec![0; sector.node_count()];
        own.iter().enumerate().for_each(|(rank, &node)| place[node] = rank);
        Self { cut, index_of, count, own, place }
    }

    /// Number of a node of the file in a sector: those of the second cut face are of the first of the next.
    fn node(&self, node: u32, sector: usize) -> u32 {
        let node = self.index_of[node as usize].expect("every node has an element");
        let (node, sector) = match self.cut.first_of.get(&node) {
            Some(&first) => (first, (sector + 1) % self.count),
            None => (node, sector),
        };
        (sector * self.own.len() + self.place[node as usize]) as u32
    }

    /// The equations of all sectors, whose axes turn with them.
    fn equations(&self, file: &FileMesh, symmetry: &CyclicSymmetry) -> Vec<Equation> {
        let of_sector = |j: usize| {
            let turn = symmetry.turn(j);
            file.equations.iter().map(move |equation| {
                let terms = equation.iter().flat_map(|&(node, axis, factor)| {
                    let node = self.node(node, j);
                    (0..3).map(move |k| (node, k, factor * turn[(k, axis)]))
                });
                terms.filter(|term| term.2 != 0.0).collect()
            })
        };
        (0..self.count).flat_map(of_sector).collect()
    }

    /// What has a name, in all sectors.
    fn named<T, U>(
        &self,
        named: &BTreeMap<String, Vec<T>>,
        of: impl Fn(&T, &dyn Fn(u32) -> u32) -> U,
    ) -> BTreeMap<String, Vec<U>> {
        let in_sector = |own: &T, j: usize| of(own, &|node| self.node(node, j));
        let all = named.iter().map(|(name, own)| {
            let copies = (0..self.count).flat_map(|j| own.iter().map(move |own| (own, j)));
            (name.clone(), copies.map(|(own, j)| in_sector(own, j)).collect())
        });
        all.collect()
    }
}

/// The two cut faces of a sector.
struct Cut {
    /// Node of the first for each of the second.
    first_of: BTreeMap<u32, u32>,
    /// The same the other way round.
    second_of: BTreeMap<u32, u32>,
    /// The faces that bound the sector.
    outer: Vec<BoundaryFace>,
}

impl Cut {
    /// Pairs the nodes of the outline that the turn by one sector brings onto each other.
    fn of(sector: &Mesh, symmetry: &CyclicSymmetry) -> Result<Self, BodyError> {
        let outer = sector.outer_faces();
        let shortest = outer.iter().flat_map(|face| {
            let corners = face.corners();
            let pairs = (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]);
            pairs.map(|[p, q]| away(sector, p, q))
        });
        let distance = MATCHED * shortest.fold(f64::INFINITY, f64::min);

        // Nodes pair where they share a region: bodies that touch have nodes in one place.
        let edge = outer.iter().flat_map(|face| &face.nodes);
        let mut regions_of: BTreeMap<u32, BTreeSet<usize>> =
            edge.map(|&node| (node, BTreeSet::new())).collect();
        for element in 0..sector.element_count() {
            for node in sector.element_nodes(element) {
                if let Some(regions) = regions_of.get_mut(node) {
                    regions.insert(sector.region(element));
                }
            }
        }
        let mut alike: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
        for (&node, regions) in &regions_of {
            regions.iter().for_each(|&region| alike.entry(region).or_default().push(node));
        }
        let turn = symmetry.turn(1);
        let mut first_of = BTreeMap::new();
        for nodes in alike.values() {
            let places = nodes.iter().map(|&node| sector.nodes[node as usize]);
            let turned = places.clone().map(|point| symmetry.turned(&turn, point));
            let all: Vec<[f64; 3]> = places.chain(turned).collect();
            for (own, other) in coincident_nodes(&all, distance) {
                let [own, other] = [own as usize, other as usize];
                if own < nodes.len() && other >= nodes.len() {
                    first_of.insert(nodes[own], nodes[other - nodes.len()]);
                }
            }
        }
        if let Some((node, _)) = first_of.iter().find(|(second, first)| second == first) {
            return Err(BodyPart::Sectors.refused(format!(
                "node {} lies on the axis of the sectors and belongs to all of them: mesh the whole body, or leave a hole there",
                sector.node_label(*node as usize)
            )));
        }
        let second_of = first_of.iter().map(|(&second, &first)| (first, second));
        Ok(Self { second_of: second_of.collect(), first_of, outer })
    }

    /// Refuses a sector that does not meet its copy, or meets it with other faces.
    fn check_faces(&self, sector: &Mesh, symmetry: &CyclicSymmetry) -> Result<(), BodyError> {
        let degrees = 360.0 / symmetry.count as f64;
        let of_key: BTreeMap<FaceKey, &BoundaryFace> =
            self.outer.iter().map(|face| (face.key(), face)).collect();
        let turn = symmetry.turn(1);
        // Faces that the turn brings onto others: cut faces look at each other there.
        let mut is_cut: BTreeSet<FaceKey> = BTreeSet::new();
        let mut is_overlapping = false;
        for face in &self.outer {
            let partners = face.nodes.iter().map(|node| self.second_of.get(node).copied());
            let Some(partners) = partners.collect::<Option<Vec<u32>>>() else { continue };
            let key = face_key(partners.into_iter().take(face.kind.corner_count()));
            if let Some(partner) = of_key.get(&key) {
                let [own, other] = [face, *partner].map(|face| outward(sector, face));
                is_overlapping |= (turn * own).dot(&other) > 0.0;
                is_cut.extend([face.key(), key]);
            }
        }
        let reach = format!(
            "its copy turned by 360 / {} = {degrees:.6} degrees about {}; the file reaches over {:.6} degrees",
            symmetry.count,
            symmetry.axis_text(),
            symmetry.extent_degrees(&sector.nodes)
        );
        if is_overlapping {
            let what = "the sector overlaps";
            return Err(BodyPart::Sectors
                .refused(format!("{what} {reach}: does the number of sectors fit it?")));
        }
        let others = self.faces_in_copy(sector, symmetry, &is_cut);
        match others.first() {
            Some(face) => {
                let labels = face.nodes.iter().take(NAMED);
                let labels = labels.map(|&node| sector.node_label(node as usize).to_string());
                let [faces, meet] =
                    if others.len() == 1 { ["face", "meets"] } else { ["faces", "meet"] };
                Err(BodyPart::Sectors.refused(format!(
                    "{} {faces} of the sector {meet} its copy turned by {degrees:.6} degrees with other nodes (the first has the nodes \
                     {}). Mesh both cut faces alike (Periodic Curve or Periodic Surface in Gmsh)",
                    others.len(),
                    labels.collect::<Vec<_>>().join(", ")
                )))
            }
            None if is_cut.is_empty() => Err(BodyPart::Sectors.refused(format!(
                "no face of the sector meets {reach}: does the number of sectors fit it, and are the nodes of both cut faces alike?"
            ))),
            None => Ok(()),
        }
    }

    /// Faces beside the cut ones that lie in elements of a copy.
    fn faces_in_copy(
        &self,
        sector: &Mesh,
        symmetry: &CyclicSymmetry,
        is_cut: &BTreeSet<FaceKey>,
    ) -> Vec<&BoundaryFace> {
        let is_joined =
            |node: &u32| self.first_of.contains_key(node) || self.second_of.contains_key(node);
        let is_beside = |face: &&BoundaryFace| {
            !is_cut.contains(&face.key()) && face.nodes.iter().any(is_joined)
        };
        // Another body may well lie there. Parts of one that only copies join are one body.
        let mut bodies = sector.bodies();
        for (&own, &other) in &self.first_of {
            let [own, other] = [own, other].map(|node| bodies[node as usize]);
            if own != other {
                bodies.iter_mut().filter(|body| **body == own).for_each(|body| *body = other);
            }
        }
        let body_of = |nodes: &[u32]| bodies[nodes[0] as usize];
        let spheres = spheres(sector);
        let turns = [1, symmetry.count - 1].map(|j| symmetry.turn(j));
        let is_in_copy = |face: &&BoundaryFace| {
            let (beyond, own) = (beyond(sector, face), body_of(&face.nodes));
            turns.iter().map(|turn| symmetry.turned(turn, beyond).into()).any(|point| {
                let near = spheres.near(&point, 0.0).into_iter();
                let mut near = near.filter(|&near| body_of(sector.element_nodes(near)) == own);
                near.any(|near| has(sector, near, point))
            })
        };
        self.outer.iter().filter(is_beside).filter(is_in_copy).collect()
    }
}

fn away(sector: &Mesh, p: u32, q: u32) -> f64 {
    let [p, q] = [p, q].map(|node| Vector3::from(sector.nodes[node as usize]));
    (p - q).norm()
}

/// A point a little outside a face, by a hundredth of its size.
fn beyond(sector: &Mesh, face: &BoundaryFace) -> [f64; 3] {
    let corners = face.corners();
    let size = away(sector, corners[0], corners[1]);
    (sector.middle(corners) + outward(sector, face) * (0.01 * size)).into()
}

/// Unit vector out of the body at a face, away from its element's middle where the face is bent.
fn outward(sector: &Mesh, face: &BoundaryFace) -> Vector3<f64> {
    let areas = sector.quadrature(face).map(|point| Vector3::from(point.area));
    areas.fold(Vector3::zeros(), |sum, area| sum + area).normalize()
}

/// The elements of a sector by the spheres about them, in cells as large as the largest one.
fn spheres(sector: &Mesh) -> Grid {
    let all = (0..sector.element_count()).map(|element| {
        let nodes = sector.element_nodes(element);
        let center = sector.middle(nodes);
        let reach = |&node: &u32| (Vector3::from(sector.nodes[node as usize]) - center).norm();
        (center, nodes.iter().map(reach).fold(0.0, f64::max))
    });
    Grid::of(all.clone().map(|own| own.1).fold(0.0, f64::max), all)
}

/// Whether a point lies in an element, whose faces are taken as plane.
fn has(sector: &Mesh, element: usize, point: Vector3<f64>) -> bool {
    let faces = 0..sector.element_kind(element).faces().len();
    let mut faces = faces.map(|face| sector.element_face(element, face));
    faces.all(|face| (point - sector.middle(face.corners())).dot(&outward(sector, &face)) < 0.0)
}
