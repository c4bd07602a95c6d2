//! Nodes of the mesh as a case names them: by number, or by a place whose nearest node is meant.

use super::body::{Body, solid_node_count};
use super::diagnostic::Location;
use super::reader::{NodePlace, Section};
use crate::mesh::{AnnulusSpecification, Counterface, SectorMesh, SolidSpecification};
use std::f64::consts::TAU;

/// Share of the body's size beyond which the nearest node to a place is hardly what was meant.
const FAR: f64 = 0.05;

/// A node that was asked for by its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedNode {
    /// Node, counted from 0.
    pub node: usize,
    /// The place, m.
    pub asked: [f64; 2],
    /// Where the node is, m.
    pub at: [f64; 2],
}

impl PlacedNode {
    /// Distance of the node from the place, m.
    pub fn distance(&self) -> f64 {
        (self.at[0] - self.asked[0]).hypot(self.at[1] - self.asked[1])
    }
}

/// The nodes of the case's mesh.
#[derive(Clone, Copy)]
pub(super) struct Nodes<'a> {
    /// None where a mesh file makes no body: nothing is known of its nodes.
    pub body: Option<&'a Body>,
}

/// A node of the case, counted from 0, with its place where it was asked for by that.
type Found = (usize, Option<PlacedNode>);

impl Nodes<'_> {
    /// Number of a node as the user knows it.
    pub fn label(&self, node: usize) -> usize {
        self.body.map_or(node + 1, |body| body.node_label(node))
    }

    /// The node that `named` means; what is wrong with it is reported at `key`.
    pub fn find(
        &self,
        section: &Section<'_>,
        key: &'static str,
        (named, at): &(NodePlace, Location),
    ) -> Option<Found> {
        let body = self.body?;
        let asked = match *named {
            NodePlace::Number(number) => {
                return numbered(body, section, key, number, at).map(|n| (n, None));
            }
            NodePlace::Point(point) => point,
            NodePlace::Polar { radius, angle } => {
                let [x, y] = axis(body);
                [x + radius * angle.cos(), y + radius * angle.sin()]
            }
        };
        let (node, point) = nearest(body, asked)?;
        let placed = PlacedNode {
            node,
            asked,
            at: point,
        };
        if placed.distance() > FAR * body.size() {
            section.warn(
                key,
                format!(
                    "{}: the node nearest to ({}, {}) m is node {} at ({:.6}, {:.6}) m, {:.1e} m away",
                    section.name(key),
                    asked[0],
                    asked[1],
                    body.node_label(node),
                    point[0],
                    point[1],
                    placed.distance()
                ),
                "places are in metres",
            );
        }
        Some((node, Some(placed)))
    }
}

/// The node of a number, counted from 0; one that does not exist is an error.
fn numbered(
    body: &Body,
    section: &Section<'_>,
    key: &'static str,
    number: usize,
    at: &Location,
) -> Option<usize> {
    let what = match key {
        "probes" => format!("probe {number}"),
        _ => format!("{} = {number}", section.name(key)),
    };
    let help = match body {
        Body::Imported(imported) => {
            return labelled(&imported.mesh.labels, section, &what, number, at);
        }
        Body::Assembly(assembly) => {
            return labelled(&assembly.mesh.labels, section, &what, number, at);
        }
        Body::Annulus(_) => {
            "node ids count radially outwards first: 1 + j (radial_elements + 1) + i"
        }
        Body::Revolution(_) => "node ids number one sector first; give nodes by position instead",
    };
    let nodes = body.node_count();
    if number as u128 > nodes && nodes > 0 {
        section.reject_there(
            at,
            format!("{what} does not exist: the mesh has nodes 1 to {nodes}"),
            format!("must be at most {nodes}"),
            help,
        );
        return None;
    }
    Some(number.saturating_sub(1))
}

/// The node of a number of the mesh file; labels rise, as nodes stand in the order of their numbers.
fn labelled(
    labels: &[usize],
    section: &Section<'_>,
    what: &str,
    number: usize,
    at: &Location,
) -> Option<usize> {
    let found = labels.binary_search(&number).ok();
    if found.is_none() {
        let ends = [labels.first(), labels.last()].map(|label| label.map_or(0, |&n| n));
        section.reject_there(
            at,
            format!(
                "{what} does not exist: the elements of the mesh file have {} nodes, numbered {} to {}",
                labels.len(),
                ends[0],
                ends[1]
            ),
            "no node of the body".to_owned(),
            "give its position instead, { x = .., y = .. } in metres",
        );
    }
    found
}

/// The centre that polar places are about, m.
fn axis(body: &Body) -> [f64; 2] {
    match body.imported().map(|imported| imported.mesh.counterface) {
        Some(Counterface::Cylinder { center, .. }) => center,
        _ => [0.0; 2],
    }
}

/// The node nearest to a point, and where it is; none where the mesh makes none.
fn nearest(body: &Body, point: [f64; 2]) -> Option<(usize, [f64; 2])> {
    match body {
        Body::Annulus(annulus) => nearest_in_sectors(&annulus.specification, point),
        Body::Revolution(revolution) => nearest_on_top(&revolution.specification, point),
        Body::Assembly(_) => None,
        Body::Imported(imported) => {
            let (node, _) = imported.mesh.nearest_node(point)?;
            Some((node, imported.mesh.plane_node(node)))
        }
    }
}

/// Only the first sector is built: on each ring of its nodes the nearest is that of the nearest angle.
fn nearest_in_sectors(
    annulus: &AnnulusSpecification,
    point: [f64; 2],
) -> Option<(usize, [f64; 2])> {
    let sector = SectorMesh::generate(annulus).ok()?;
    let (per_sector, sectors) = (sector.node_count(), sector.sector_count());
    let step = TAU / sectors as f64;
    let candidates = sector.strip.nodes[..per_sector].iter().enumerate();
    let around = candidates.map(|(position, &[x, y, _])| {
        let (radius, start) = (x.hypot(y), y.atan2(x));
        let turns = ((point[1].atan2(point[0]) - start) / step).round() as i64;
        let turned = turns.rem_euclid(sectors as i64) as usize;
        let angle = start + step * turned as f64;
        let at = [radius * angle.cos(), radius * angle.sin()];
        let distance = (at[0] - point[0]).hypot(at[1] - point[1]);
        (distance, turned * per_sector + position, at)
    });
    let (_, node, at) = around.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((node, at))
}

/// The node of the top face that lies nearest to a point, and where it is.
fn nearest_on_top(solid: &SolidSpecification, [x, y]: [f64; 2]) -> Option<(usize, [f64; 2])> {
    let count = solid.annulus.circumferential_elements;
    let nodes = solid_node_count(solid);
    let per_sector = usize::try_from(nodes / count.max(1) as u128).ok()?;
    let sectors = count as f64;
    let turn = (y.atan2(x) / TAU * sectors).round().rem_euclid(sectors);
    let angle = TAU * turn / sectors;
    let radii = solid.corner_radii().ok()?;
    let distance = |radius: f64| (radius - x.hypot(y)).abs();
    let places = radii.iter().copied().enumerate();
    let (i, radius) = places.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
    let node = solid.corner_node([i, solid.axial_elements]);
    let place = [radius * angle.cos(), radius * angle.sin()];
    Some((
        (turn as usize).checked_mul(per_sector)?.checked_add(node)?,
        place,
    ))
}
