//! Sound of a periodic motion, estimated by the Rayleigh integral over the flat faces of a body.

use super::map::{PeriodMap, PeriodicState};
use crate::linalg::c64;
use crate::mesh::{BoundaryFace, Mesh};
use crate::output::Described;
use nalgebra::Vector3;
use serde::Serialize;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Density (kg/m3) and speed of sound (m/s) of air at 20 degrees Celsius.
pub const AIR: [f64; 2] = [1.204, 343.2];
/// Reference of sound power levels, W.
pub const REFERENCE_POWER: f64 = 1e-12;

/// Highest frequency of harmonics that are summed, Hz, beyond the first, and most of them.
const AUDIBLE: f64 = 20e3;
const MOST_HARMONICS: usize = 40;
/// Cosine of the angle between faces that lie in one plane, less than one by this at most.
const FLAT: f64 = 1e-8;
/// Cosine of the angle to a neighbouring face above which a face is a facet of a curved surface.
const CURVED: f64 = 0.75;

/// A flat part of the surface of a body, in an infinite rigid baffle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlatFace {
    /// Where its nodes are, m.
    pub places: Vec<[f64; 3]>,
    /// Area that belongs to each, m2.
    pub areas: Vec<f64>,
    /// Velocity of each along the normal as `(dof, coefficient)` over the dofs of the body.
    pub normals: Vec<Vec<(usize, f64)>>,
}

impl FlatFace {
    /// The flat faces among `faces` of the surface of solid bodies: all elements of a plane that meet at edges, and that end at
    /// edges of more than 41 degrees, as the facets of a curved surface do not.
    pub fn of(mesh: &Mesh, faces: &[BoundaryFace]) -> Vec<Self> {
        let normal = |face| mesh.area_vector(face).try_normalize(0.0).unwrap_or_default();
        let normals: Vec<Vector3<f64>> = faces.iter().map(normal).collect();
        let neighbours = neighbours(faces);
        let (mut group_of, mut groups) = (vec![usize::MAX; faces.len()], Vec::new());
        for seed in 0..faces.len() {
            if group_of[seed] != usize::MAX {
                continue;
            }
            // Everything in this plane that the face is joined to.
            let (mut group, mut next, mut is_curved) = (vec![seed], 0, false);
            group_of[seed] = groups.len();
            while let Some(&face) = group.get(next) {
                next += 1;
                for &other in &neighbours[face] {
                    if normals[seed].dot(&normals[other]) > 1.0 - FLAT {
                        if group_of[other] == usize::MAX {
                            group_of[other] = groups.len();
                            group.push(other);
                        }
                    } else {
                        is_curved |= normals[face].dot(&normals[other]) > CURVED; // A facet of something round.
                    }
                }
            }
            groups.push((!is_curved).then_some(group));
        }
        let flat = groups.into_iter().flatten().map(|group| {
            let own = group.iter().map(|&face| &faces[face]);
            Self::joined(mesh, own, normals[group[0]])
        });
        flat.collect()
    }

    /// The face of these elements.
    fn joined<'a>(
        mesh: &Mesh,
        faces: impl Iterator<Item = &'a BoundaryFace>,
        normal: Vector3<f64>,
    ) -> Self {
        let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
        for face in faces {
            // Corners share the area of each element: midside nodes of quadratic ones move between them.
            let corners = face.corners();
            let share = mesh.face_area(std::slice::from_ref(face)) / corners.len() as f64;
            corners.iter().for_each(|&node| *areas.entry(node).or_default() += share);
        }
        let mut flat = Self::default();
        for (node, area) in areas {
            let node = node as usize;
            let along = mesh.frame(node).transpose() * normal; // Dofs stand in the node's own frame.
            flat.places.push(mesh.nodes[node]);
            flat.areas.push(area);
            flat.normals.push((0..3).map(|c| (3 * node + c, along[c])).collect());
        }
        flat
    }

    /// Area, m2.
    pub fn area(&self) -> f64 {
        self.areas.iter().sum()
    }

    /// Mean power, W, that the face radiates into air when its nodes vibrate along the normal with the complex amplitudes
    /// `velocity`, m/s, at `frequency`, rad/s:
    ///
    /// ```text
    /// W = rho omega^2 / (4 pi c) sum_ij S_i S_j Re(v_i conj v_j) sin(k r_ij) / (k r_ij),   k = omega / c
    /// ```
    ///
    /// Source: Lord Rayleigh's integral for the pressure on a vibrating part of an infinite rigid plane, with elements much
    /// smaller than the wave (S. J. Elliott, M. E. Johnson, J. Acoust. Soc. Am. 94 (1993) 2194).
    pub fn power(&self, frequency: f64, velocity: &[c64]) -> f64 {
        let [density, speed] = AIR;
        let wave_number = frequency / speed;
        let sources: Vec<c64> = velocity.iter().zip(&self.areas).map(|(v, s)| v * s).collect();
        let mut sum = 0.0;
        for (i, a) in sources.iter().enumerate() {
            let mut others = c64::ZERO;
            for (b, place) in sources[..i].iter().zip(&self.places) {
                let parts = [0, 1, 2].map(|c| (place[c] - self.places[i][c]).powi(2));
                let phase = wave_number * parts.iter().sum::<f64>().sqrt(); // k r_ij.
                others += b * (phase.sin() / phase);
            }
            // Each pair counts twice.
            sum += a.norm_sqr() + 2.0 * (a.conj() * others).re;
        }
        density * frequency * frequency / (4.0 * PI * speed) * sum
    }
}

/// Sound of a periodic motion, radiated into air: each flat face in an infinite rigid baffle.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct Sound {
    /// Power of all harmonics up to 20 kHz, W.
    pub power_w: f64,
    /// Its level over 1e-12 W, dB.
    pub level_db: f64,
    /// Area of the faces, m2.
    pub area_m2: f64,
    /// Power of harmonics 1, 2, ..., W.
    pub harmonics_w: Vec<f64>,
}

impl Sound {
    /// Sound of the period that begins with `state`: the sum of what each face radiates, harmonic by harmonic up to 20 kHz.
    pub fn of(map: &mut PeriodMap<'_>, state: &PeriodicState, faces: &[FlatFace]) -> Self {
        let steps = map.steps();
        let audible = (AUDIBLE * state.period) as usize; // Harmonics that are heard, no more than the steps resolve.
        let count = audible.clamp(1, MOST_HARMONICS).min((steps - 1) / 2);
        let operator = map.run.operator();
        let rows = faces
            .iter()
            .flat_map(|face| &face.normals)
            .map(|row| row.iter().map(|&(dof, along)| (operator.position(dof), along)).collect());
        let rows: Vec<Vec<(usize, f64)>> = rows.collect();
        map.place(state);
        let amplitudes = map.harmonics(count, |run| {
            let field = &run.fields().velocity;
            let moved = |&(place, along): &(usize, f64)| along * field[place];
            rows.iter().map(|row| row.iter().map(moved).sum()).collect()
        });
        let powers = amplitudes.iter().enumerate().map(|(k, own)| {
            let frequency = TAU * (k + 1) as f64 / state.period; // omega_k = 2 pi k / T.
            let mut first = 0;
            let of_faces = faces.iter().map(|face| {
                let range = first..first + face.areas.len();
                first = range.end;
                face.power(frequency, &own[range]) // Each face by itself.
            });
            of_faces.sum()
        });
        let harmonics_w: Vec<f64> = powers.collect(); // What all faces radiate at each of them.
        let power_w: f64 = harmonics_w.iter().sum();
        Self {
            power_w,
            level_db: 10.0 * (power_w / REFERENCE_POWER).log10(),
            area_m2: faces.iter().map(FlatFace::area).sum(),
            harmonics_w,
        }
    }
}

/// The faces with which each has an edge in common.
fn neighbours(faces: &[BoundaryFace]) -> Vec<Vec<usize>> {
    let mut edges: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (i, face) in faces.iter().enumerate() {
        let corners = face.kind.corner_count();
        for edge in 0..corners {
            let (p, q) = (face.nodes[edge], face.nodes[(edge + 1) % corners]);
            edges.entry([p.min(q), p.max(q)]).or_default().push(i);
        }
    }
    let mut neighbours = vec![Vec::new(); faces.len()];
    for faces in edges.values() {
        for &face in faces {
            neighbours[face].extend(faces.iter().copied().filter(|&other| other != face));
        }
    }
    neighbours
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `J_1` by its series.
    fn bessel(x: f64) -> f64 {
        let mut term = 0.5 * x;
        let mut sum = term;
        for k in 1..60 {
            term *= -(0.5 * x).powi(2) / (k as f64 * (k + 1) as f64);
            sum += term;
        }
        sum
    }

    /// Closed form: a circular piston in a baffle radiates `rho c S v^2 R_1(2 k a) / 2`, `R_1(x) = 1 - 2 J_1(x) / x`. Rings of points
    /// of equal area: their spacing, a fortieth of the radius, leaves less than half a percent.
    #[test]
    fn a_piston_in_a_baffle_radiates_as_its_closed_form_says() {
        let (radius, rings) = (0.1, 40);
        let mut face = FlatFace::default();
        for ring in 0..rings {
            let count = 2 * ring + 1;
            for k in 0..count {
                let r = radius * (ring as f64 + 0.5) / rings as f64;
                let angle = TAU * (k as f64 + 0.5 * (ring % 2) as f64) / f64::from(count);
                face.places.push([r * angle.cos(), r * angle.sin(), 0.0]);
                face.areas.push(PI * radius * radius / f64::from(rings * rings));
                face.normals.push(Vec::new());
            }
        }
        assert!((face.area() / (PI * radius * radius) - 1.0).abs() < 1e-12);
        let [density, speed] = AIR;
        for size in [0.1, 0.5, 1.0, 2.0, 4.0, 8.0] {
            let frequency = size * speed / radius;
            let velocity = c64::from_polar(0.3, 1.2);
            let found = face.power(frequency, &vec![velocity; face.areas.len()]);
            let resistance = 1.0 - bessel(2.0 * size) / size;
            let expected = 0.5 * density * speed * face.area() * 0.09 * resistance;
            assert!((found / expected - 1.0).abs() < 5e-3, "{size}: {found} {expected}");
        }
    }
}
