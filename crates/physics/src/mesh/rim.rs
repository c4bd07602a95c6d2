//! Edges of a body and between its regions as smooth curves: where a new node between two old ones belongs.

use frictionsim_formats::FileMesh;
use std::collections::BTreeMap;

/// Relative difference of the curvatures at the two ends of an edge up to which it follows a smooth curve.
const SMOOTH: f64 = 0.1;

/// Turn of a smooth curve along an edge, rad, at most: coarser polygons are taken for what they are.
const LARGEST_TURN: f64 = 0.7;

/// Regions on both sides of an edge; the second is `None` on the edge of the body.
type Sides<'a> = (&'a str, Option<&'a str>);

/// The steps from node to node along all edges of a body and between its regions.
pub(super) struct Rim {
    /// Nodes one step away from each node, with the number of the kind of edge that leads there.
    steps: BTreeMap<u32, Vec<(u32, usize)>>,
}

impl Rim {
    /// The rim of the body of a file.
    pub fn of(file: &FileMesh) -> Self {
        type Edge<'a> = (Option<u32>, Vec<&'a str>);
        let mut edges: BTreeMap<(u32, u32), Edge<'_>> = BTreeMap::new();
        for element in &file.elements {
            for edge in 0..element.kind.corner_count() {
                let (p, q, m) = element.kind.edge(edge);
                let [p, q] = [p, q].map(|local| element.nodes[local]);
                let entry = edges.entry((p.min(q), p.max(q))).or_default();
                entry.0 = m.map(|local| element.nodes[local]);
                entry.1.push(&element.region);
            }
        }
        let mut kinds: BTreeMap<Sides<'_>, usize> = BTreeMap::new();
        let mut steps: BTreeMap<u32, Vec<(u32, usize)>> = BTreeMap::new();
        for ((p, q), (middle, regions)) in edges {
            let sides = match regions[..] {
                [one] => (one, None),
                [one, other] if one != other => (one.min(other), Some(one.max(other))),
                _ => continue,
            };
            let next = kinds.len();
            let kind = *kinds.entry(sides).or_insert(next);
            let along: Vec<u32> = [p].into_iter().chain(middle).chain([q]).collect();
            for pair in along.windows(2) {
                steps.entry(pair[0]).or_default().push((pair[1], kind));
                steps.entry(pair[1]).or_default().push((pair[0], kind));
            }
        }
        Self { steps }
    }

    /// The middle of the arc between two neighbouring nodes of a smooth curve; none where they are not.
    pub fn middle(&self, points: &[[f64; 3]], p: u32, q: u32) -> Option<[f64; 3]> {
        let [a, b] = [p, q].map(|node| points[node as usize]);
        let curvature = self.curvature(points, p, q)?;
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let turn = 0.5 * curvature * dx.hypot(dy);
        // Height of the arc over its chord, for each unit of the chord: kappa L / 4 / (1 + cos).
        let height = 0.5 * turn / (1.0 + (1.0 - turn * turn).sqrt());
        Some([
            0.5 * (a[0] + b[0]) + height * dy,
            0.5 * (a[1] + b[1]) - height * dx,
            0.5 * (a[2] + b[2]),
        ])
    }

    /// Curvature of the curve along a step, positive where it turns left on the way from `p` to `q`.
    fn curvature(&self, points: &[[f64; 3]], p: u32, q: u32) -> Option<f64> {
        if let Some(found) = self.two_sided(points, p, q) {
            return Some(found);
        }
        // At the end of an arc one neighbour alone lies on it: a step that is on the arc itself.
        let kind = self.kind(p, q)?;
        let from_before = self.beyond(q, p, kind).and_then(|before| {
            alike(turn_of(points, before, p, q), self.two_sided(points, before, p)?)
        });
        let from_after = || {
            let after = self.beyond(p, q, kind)?;
            alike(turn_of(points, p, q, after), self.two_sided(points, q, after)?)
        };
        from_before.or_else(from_after)
    }

    /// Curvature of a step both of whose neighbours lie on the same arc.
    fn two_sided(&self, points: &[[f64; 3]], p: u32, q: u32) -> Option<f64> {
        let kind = self.kind(p, q)?;
        let (before, after) = (self.beyond(q, p, kind)?, self.beyond(p, q, kind)?);
        let found = alike(turn_of(points, before, p, q), turn_of(points, p, q, after))?;
        let [a, b] = [p, q].map(|node| points[node as usize]);
        let is_fine = found.abs() * (b[0] - a[0]).hypot(b[1] - a[1]) < LARGEST_TURN;
        is_fine.then_some(found)
    }

    fn kind(&self, p: u32, q: u32) -> Option<usize> {
        let mut steps = self.steps.get(&p)?.iter();
        steps.find(|step| step.0 == q).map(|step| step.1)
    }

    /// The one node that follows `to` on the way from `from`, along edges of the same kind.
    fn beyond(&self, from: u32, to: u32, kind: usize) -> Option<u32> {
        let steps = self.steps.get(&to)?.iter();
        let mut others = steps.filter(|step| step.0 != from && step.1 == kind);
        let first = others.next()?.0;
        others.next().is_none().then_some(first)
    }
}

/// Mean of two curvatures of one curve.
fn alike(a: f64, b: f64) -> Option<f64> {
    let is_alike = (a - b).abs() <= SMOOTH * a.abs().max(b.abs());
    is_alike.then_some(0.5 * (a + b))
}

/// Curvature of the circle through three nodes, positive to the left.
fn turn_of(points: &[[f64; 3]], a: u32, b: u32, c: u32) -> f64 {
    let [a, b, c] = [a, b, c].map(|node| points[node as usize]);
    let along = |p: [f64; 3], q: [f64; 3]| [q[0] - p[0], q[1] - p[1]];
    let (u, v, w) = (along(a, b), along(b, c), along(a, c));
    let lengths = u[0].hypot(u[1]) * v[0].hypot(v[1]) * w[0].hypot(w[1]);
    2.0 * (u[0] * v[1] - u[1] * v[0]) / lengths.max(f64::MIN_POSITIVE)
}
