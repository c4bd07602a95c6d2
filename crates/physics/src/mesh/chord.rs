//! Straight edges of quadratic elements that stand for curved ones.

use super::{Boundary, BoundaryFace, Mesh};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Share of a chord's height below its arc within which the node at its middle lies on the chord. A node farther off was put
/// onto a curve by the mesher and stays what it is.
const ON_CHORD: f64 = 0.1;

/// Share of the counterface's turning along an edge from which on the surface of the mesh turns with it. A flat surface, which
/// turns by round-off, has straight edges because it is flat.
const TURNING: f64 = 0.1;

/// An edge whose middle node lies on the straight line between its ends, where the surface is curved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord {
    /// The node at its middle.
    pub middle: u32,
    /// The nodes at its ends.
    pub ends: [u32; 2],
}

impl Chord {
    /// Takes the distance of each middle from the counterface from those of the ends: a chord tells where its ends are, and
    /// nothing of the surface between them.
    pub fn bridge(chords: &[Self], distances: &mut BTreeMap<u32, f64>) {
        for chord in chords {
            let [a, b] = chord.ends.map(|end| distances[&end]);
            distances.insert(chord.middle, 0.5 * (a + b));
        }
    }
}

impl Mesh {
    /// Distances of the nodes of a plane curve from the counterface, m: those of [`super::Counterface::gap`], without what chords add.
    pub fn distances_from_counterface(&self, curve: &Boundary) -> BTreeMap<u32, f64> {
        let distance = |&node: &u32| (node, self.counterface.gap(self.plane_node(node as usize)));
        let mut distances = curve.nodes.iter().map(distance).collect();
        let normal = |[x, y, _]: [f64; 3]| {
            let (sin, cos) = self.counterface.normal_angle([x, y]).sin_cos();
            Vector3::new(cos, sin, 0.0)
        };
        Chord::bridge(&self.chords(&curve.faces, normal), &mut distances);
        distances
    }

    /// The chords among the edges of `faces` that lie against a counterface with a unit normal, of either sign, at each point.
    ///
    /// Between the ends `a` and `b` of an edge the counterface stands `(n_b - n_a) . (b - a) / 8` above the chord, and the normal
    /// of a surface that lies on it turns alike; at its rim, where faces lie on one side alone, by about half of that.
    pub fn chords(
        &self,
        faces: &[BoundaryFace],
        normal: impl Fn([f64; 3]) -> Vector3<f64>,
    ) -> Vec<Chord> {
        let at = |node: u32| Vector3::from(self.nodes[node as usize]);
        // Outward normals of the surface at its corners, and the side on which the counterface lies.
        let mut outward: BTreeMap<u32, Vector3<f64>> = BTreeMap::new();
        let mut facing = 0.0;
        for face in faces {
            let (area, corners) = (self.area_vector(face), face.corners());
            facing += area.dot(&normal(self.middle(corners).into()));
            for &corner in corners {
                *outward.entry(corner).or_insert_with(Vector3::zeros) += area;
            }
        }
        let sense = facing.signum();
        let mut chords = Vec::new();
        for face in faces {
            for (middle, ends) in face.kind.middles() {
                let (middle, ends) = (face.nodes[middle], ends.map(|end| face.nodes[end]));
                let [a, b] = ends.map(at);
                let [n_a, n_b] = ends.map(|end| normal(self.nodes[end as usize]) * sense);
                let turning = (n_b - n_a).dot(&(b - a));
                let [o_a, o_b] = ends.map(|end| outward[&end].normalize());
                let own = (o_b - o_a).dot(&(b - a));
                let off = (at(middle) - (a + b) * 0.5).norm();
                if off < ON_CHORD * turning.abs() / 8.0 && own / turning > TURNING {
                    chords.push(Chord { middle, ends });
                }
            }
        }
        chords
    }

    /// Mean of some nodes, m.
    pub(crate) fn middle(&self, nodes: &[u32]) -> Vector3<f64> {
        let points = nodes.iter().map(|&node| Vector3::from(self.nodes[node as usize]));
        points.sum::<Vector3<f64>>() / nodes.len() as f64
    }

    /// Outward normal of the polygon of a face's corners times its area; of a line times its length.
    pub(crate) fn area_vector(&self, face: &BoundaryFace) -> Vector3<f64> {
        let corners = face.corners().iter();
        let corners: Vec<Vector3<f64>> =
            corners.map(|&node| Vector3::from(self.nodes[node as usize])).collect();
        if let [a, b] = corners[..] {
            return (b - a).cross(&Vector3::z());
        }
        let next = corners.iter().cycle().skip(1);
        let twice: Vector3<f64> =
            corners.iter().zip(next).map(|(a, b)| (a - corners[0]).cross(&(b - corners[0]))).sum();
        0.5 * twice
    }
}
