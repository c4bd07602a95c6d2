//! Nodes of the mesh as a case names them: by number, or by a place whose nearest node is meant.

use super::{body::solid_node_count, reader::NodePlace};
use crate::*;
use frictionsim_physics::mesh::Strip;

/// Shares of half the body's size beyond which the nearest node to a place is hardly what was meant, and the place not
/// on the body at all.
const FAR: [f64; 2] = [0.05, 0.5];

/// A node that was asked for by its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedNode {
    /// Node, counted from 0.
    pub node: usize,
    /// The place, m.
    pub asked: [f64; 3],
    /// Where the node is, m.
    pub at: [f64; 3],
}

impl PlacedNode {
    /// Distance of the node from the place, m.
    pub fn distance(&self) -> f64 {
        distance(self.at, self.asked)
    }
}

/// A node of the case, counted from 0, with its place where it was asked for by that.
type Found = (usize, Option<PlacedNode>);

impl Body {
    /// The node that `named` means; what is wrong with it is reported at `key`.
    pub(super) fn find_node(
        &self,
        section: &Section<'_>,
        key: &'static str,
        (named, at): &(NodePlace, Location),
    ) -> Option<Found> {
        let (asked, z) = match *named {
            NodePlace::Number(number) => {
                return numbered(self, section, key, number, at).map(|n| (n, None));
            }
            NodePlace::Point(point, z) => (point, z),
            NodePlace::Polar { radius, angle, z } => {
                let [x, y] = axis(self);
                ([x + radius * angle.cos(), y + radius * angle.sin()], z)
            }
        };
        if let (2, Some(z)) = (self.dimension(), z) {
            refuse_at!(section, at, "{}: z = {z} of a plane body", section.name(key);
                "the body is plane"; "leave z out");
            return None;
        }
        let (node, point) = nearest(self, asked, z)?;
        let placed = PlacedNode {
            node,
            // Without z the height is the node's.
            asked: [asked[0], asked[1], z.unwrap_or(point[2])],
            at: point,
        };
        let away = placed.distance();
        let [is_far, is_off] = FAR.map(|share| away > share * self.size());
        if is_far {
            let [asked, found] = [(&placed.asked, None), (&point, Some(6))]
                .map(|(place, digits)| listed(&place[..self.dimension()], digits));
            let (name, node) = (section.name(key), self.node_label(node));
            let said = format!(
                "{name}: the node nearest to {asked} m is node {node} at {found} m, {away:.1e} m away"
            );
            match is_off {
                true => refuse_at!(section, at, "{said}"; "off the body"; "places are in metres"),
                false => caution!(section, key, "{said}"; "places are in metres"),
            }
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
    // Labels rise, as nodes stand in the order of their numbers.
    if let Some(labels) = body.whole_mesh().map(|mesh| &mesh.labels) {
        let found = labels.binary_search(&number).ok();
        if found.is_none() {
            let [first, last] = [labels.first(), labels.last()].map(|own| own.map_or(0, |&n| n));
            refuse_at!(section, at,
                "{what} does not exist: the elements of the mesh file have {} nodes, numbered \
                 {first} to {last}", labels.len(); "no node of the body";
                "give its position instead, {{ x = .., y = .. }} in metres");
        }
        return found;
    }
    let help = match body.revolution() {
        None => "node ids count radially outwards first: 1 + j (radial_elements + 1) + i",
        Some(_) => "node ids number one sector first; give nodes by position instead",
    };
    let nodes = body.node_count();
    if number as u128 > nodes && nodes > 0 {
        refuse_at!(section, at, "{what} does not exist: the mesh has nodes 1 to {nodes}";
            "must be at most {nodes}"; "{help}");
        return None;
    }
    Some(number.saturating_sub(1))
}

/// Coordinates in brackets, with so many decimals.
fn listed(point: &[f64], decimals: Option<usize>) -> String {
    let written = point.iter().map(|x| match decimals {
        Some(count) => format!("{x:.count$}"),
        None => x.to_string(),
    });
    format!("({})", written.collect::<Vec<_>>().join(", "))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// The centre that polar places are about, m.
fn axis(body: &Body) -> [f64; 2] {
    match body.imported().map(|imported| imported.mesh.counterface) {
        Some(Counterface::Cylinder { center, .. }) => center,
        _ => [0.0; 2],
    }
}

/// A node, and where it is; none where the mesh makes none.
type Nearest = Option<(usize, [f64; 3])>;

/// The node nearest to a point.
fn nearest(body: &Body, point: [f64; 2], z: Option<f64>) -> Nearest {
    let [x, y] = point;
    match &body.kind {
        BodyKind::Annulus(annulus) => nearest_in_sectors(annulus, point),
        BodyKind::Revolution(solid) => nearest_corner(solid, point, z),
        BodyKind::Assembly(assembly) => {
            // Without a height the highest of those above one another, as on a body of revolution.
            let same = 1e-9 * body.size();
            let away = |at: [f64; 3]| (distance(at, [x, y, z.unwrap_or(at[2])]) / same).round();
            let nodes = assembly.mesh.nodes.iter().copied().enumerate();
            nodes.min_by(|a, b| away(a.1).total_cmp(&away(b.1)).then(b.1[2].total_cmp(&a.1[2])))
        }
        BodyKind::Imported(imported) => {
            let (node, _) = imported.mesh.nearest_node(point)?;
            Some((node, imported.mesh.nodes[node]))
        }
    }
}

/// Only the first sector is built: on each ring of its nodes the nearest is that of the nearest angle.
fn nearest_in_sectors(annulus: &AnnulusSpecification, point: [f64; 2]) -> Nearest {
    let sector = Strip::of_annulus(annulus).ok()?;
    let (per_sector, sectors) = (sector.node_count(), sector.count);
    let step = TAU / sectors as f64;
    let candidates = sector.mesh.nodes[..per_sector].iter().enumerate();
    let around = candidates.map(|(position, &[x, y, _])| {
        let (radius, start) = (x.hypot(y), y.atan2(x));
        let turns = ((point[1].atan2(point[0]) - start) / step).round() as i64;
        let turned = turns.rem_euclid(sectors as i64) as usize;
        let angle = start + step * turned as f64;
        let at = [radius * angle.cos(), radius * angle.sin(), 0.0];
        let distance = (at[0] - point[0]).hypot(at[1] - point[1]);
        (distance, turned * per_sector + position, at)
    });
    let (_, node, at) = around.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((node, at))
}

/// The corner node that lies nearest to a point, on the top face where no height is given.
fn nearest_corner(solid: &SolidSpecification, [x, y]: [f64; 2], z: Option<f64>) -> Nearest {
    let count = solid.annulus.circumferential_elements;
    let nodes = solid_node_count(solid);
    let per_sector = usize::try_from(nodes / count.max(1) as u128).ok()?;
    let sectors = count as f64;
    let turn = (y.atan2(x) / TAU * sectors).round().rem_euclid(sectors);
    let angle = TAU * turn / sectors;
    let radii = solid.corner_radii().ok()?;
    let away = |radius: f64| (radius - x.hypot(y)).abs();
    let places = radii.iter().copied().enumerate();
    let (i, radius) = places.min_by(|a, b| away(a.1).total_cmp(&away(b.1)))?;
    // Layers are equally thick.
    let layers = solid.axial_elements;
    let layer = z.map_or(layers as f64, |z| {
        let share = z / solid.thickness;
        (share * layers as f64).round().clamp(0.0, layers as f64)
    });
    let height = solid.thickness * layer / layers as f64;
    let node = solid.corner_node([i, layer as usize]);
    let place = [radius * angle.cos(), radius * angle.sin(), height];
    Some(((turn as usize).checked_mul(per_sector)?.checked_add(node)?, place))
}
