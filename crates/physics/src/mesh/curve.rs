//! Curves of element edges: their order and the lengths that belong to their nodes.

use super::error::BodyError;
use super::{BoundaryFace, ElementKind, FacePoint, Mesh};
use std::collections::BTreeMap;

/// Edges in order along a curve, the body on their left; where it has several pieces, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    /// The edges.
    pub faces: Vec<BoundaryFace>,
    /// The nodes, mid-side nodes between their ends.
    pub nodes: Vec<u32>,
    /// Whether it is one piece that closes on itself.
    pub is_closed: bool,
    /// Where pieces begin among the edges.
    pieces: Vec<usize>,
    /// A node at which more than two edges meet.
    touching: Option<u32>,
}

impl Curve {
    /// Puts edges in order.
    pub fn chain(edges: &[BoundaryFace]) -> Self {
        let mut from: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        let mut arriving: BTreeMap<u32, usize> = BTreeMap::new();
        for (i, edge) in edges.iter().enumerate() {
            from.entry(edge.nodes[0]).or_default().push(i);
            *arriving.entry(edge.nodes[1]).or_default() += 1;
        }
        let is_double =
            |node: &u32| from[node].len() > 1 || arriving.get(node).is_some_and(|&n| n > 1);
        let touching = from.keys().copied().find(is_double);
        // Open pieces begin where no edge arrives; what is left then are loops.
        let open = (0..edges.len()).filter(|&i| !arriving.contains_key(&edges[i].nodes[0]));
        let starts: Vec<usize> = open.chain(0..edges.len()).collect();
        let mut is_taken = vec![false; edges.len()];
        let mut ordered: Vec<BoundaryFace> = Vec::with_capacity(edges.len());
        let mut pieces = Vec::new();
        for start in starts {
            if is_taken[start] {
                continue;
            }
            pieces.push(ordered.len());
            let mut next = Some(start);
            while let Some(i) = next {
                is_taken[i] = true;
                ordered.push(edges[i].clone());
                let following = from.get(&edges[i].nodes[1]);
                next = following.and_then(|out| out.iter().copied().find(|&k| !is_taken[k]));
            }
        }
        let mut nodes = Vec::new();
        for (i, edge) in ordered.iter().enumerate() {
            let end = edge.nodes[1];
            nodes.push(edge.nodes[0]);
            nodes.extend(&edge.nodes[2..]);
            let goes_on = ordered.get(i + 1).is_some_and(|next| next.nodes[0] == end);
            let starts_piece = pieces.contains(&(i + 1));
            if !goes_on || starts_piece {
                nodes.push(end);
            }
        }
        let is_closed = pieces.len() == 1 && nodes.first() == nodes.last() && nodes.len() > 2;
        let mut seen = std::collections::BTreeSet::new();
        nodes.retain(|&node| seen.insert(node));
        Self { faces: ordered, nodes, is_closed, pieces, touching }
    }

    /// A contact curve must be one piece that does not touch itself.
    pub fn check_single(&self, name: &str, labels: &[usize]) -> Result<(), BodyError> {
        if self.faces.is_empty() {
            return Err(BodyError::Body(format!(
                "the contact curve \"{name}\" has no edges: a contact needs some between its nodes; name another curve"
            )));
        }
        if let Some(node) = self.touching {
            return Err(BodyError::Body(format!(
                "the contact curve \"{name}\" touches itself at node {}: more than two of its edges meet there",
                labels[node as usize]
            )));
        }
        if let [_, second, ..] = self.pieces[..] {
            let (end, start) = (self.faces[second - 1].nodes[1], self.faces[second].nodes[0]);
            return Err(BodyError::Body(format!(
                "the contact curve \"{name}\" is open: it is in {} pieces, one ends at node {} and another begins at node {}. Put every \
                 edge between them into the physical curve, or name a curve for each contact",
                self.pieces.len(),
                labels[end as usize],
                labels[start as usize]
            )));
        }
        Ok(())
    }

    /// Two bodies touch along two curves that share no node.
    pub fn check_apart(
        [contact, opposite]: [&Self; 2],
        [name, other]: [&str; 2],
        labels: &[usize],
    ) -> Result<(), BodyError> {
        if name == other {
            return Err(BodyError::Body(format!(
                "contact.boundary and contact.counter_boundary are both \"{name}\": name the curve of the other body in \
                 contact.counter_boundary"
            )));
        }
        opposite.check_single(other, labels)?;
        match contact.nodes.iter().find(|node| opposite.nodes.contains(node)) {
            None => Ok(()),
            Some(&node) => Err(BodyError::Body(format!(
                "\"{name}\" (contact.boundary) and \"{other}\" (contact.counter_boundary) share node {}. Mesh the bodies apart, each \
                 with a curve of its own (in Gmsh without Coherence or BooleanFragments)",
                labels[node as usize]
            ))),
        }
    }
}

/// `∫ N_i ds` and `∫ N_i n ds` of each node of a curve, `n` the outward normal.
pub(super) struct EdgeWeights {
    /// m.
    pub lengths: Vec<f64>,
    /// m.
    pub normals: Vec<[f64; 2]>,
}

impl EdgeWeights {
    /// Exact on straight edges; three Gauss points on parabolas.
    pub fn of(mesh: &Mesh, curve: &Curve) -> Self {
        let place: BTreeMap<u32, usize> =
            curve.nodes.iter().enumerate().map(|(i, &node)| (node, i)).collect();
        let mut weights = Self {
            lengths: vec![0.0; curve.nodes.len()],
            normals: vec![[0.0; 2]; curve.nodes.len()],
        };
        for face in &curve.faces {
            let points = mesh.face_points(face);
            for (at, weight) in ElementKind::Line3.quadrature() {
                // The body lies on the left of an edge.
                let FacePoint { values, area: [x, y, _], .. } = face.kind.at(&points, (at, 1.0));
                for (node, value) in face.nodes.iter().zip(values) {
                    let i = place[node];
                    weights.lengths[i] += weight * value * x.hypot(y);
                    weights.normals[i][0] += weight * value * x;
                    weights.normals[i][1] += weight * value * y;
                }
            }
        }
        weights
    }

    /// Direction of the normal at each node, rad.
    pub fn normal_angles(&self) -> Vec<f64> {
        self.normals.iter().map(|[x, y]| y.atan2(*x)).collect()
    }
}
