//! Places on the faces of a body of revolution in three dimensions, at which contact acts.

use crate::mesh::{FaceElement, SolidSector, face_quadrature};

/// A place of a face.
pub struct FacePoint {
    /// Its share of the face, m2.
    pub area: f64,
    /// Its radius, m.
    pub radius: f64,
    /// Its place along the element, -1 to 1.
    pub along: f64,
    /// Rows of the displacement there along `(e_r, e_theta, e_z)` over the dofs of the strip.
    pub rows: [Vec<(usize, f64)>; 3],
}

/// How a linear element takes a term. Quadratic ones integrate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceRule {
    /// Consistent, over the plane face that its nodes span: what the whole mesh has.
    Integrated,
    /// Lumped at the nodes, with the weight there: what a time step has.
    Nodal,
}

/// All of an element along the face.
pub const WHOLE_ELEMENT: [f64; 2] = [-1.0, 1.0];

/// Components in a node's frame of a unit vector along `component` at an angle `ahead` of the point.
fn turned(component: usize, ahead: f64) -> [f64; 3] {
    let (sin, cos) = ahead.sin_cos();
    match component {
        0 => [cos, -sin, 0.0],
        1 => [sin, cos, 0.0],
        _ => [0.0, 0.0, 1.0],
    }
}

/// The places that stand for a part of an element, from -1 to 1 along the face: of a lumped one the nodes at the ends in it.
pub fn face_points(
    sector: &SolidSector,
    face: &FaceElement,
    span: [f64; 2],
    rule: FaceRule,
) -> Vec<FacePoint> {
    let is_quadratic = sector.is_quadratic();
    let first = |(node, half): (usize, usize)| 3 * (node + half / 2 * sector.node_count());
    if !is_quadratic && rule == FaceRule::Nodal {
        let mut areas = vec![0.0; face.nodes.len()];
        for point in face_quadrature(is_quadratic) {
            let (values, area) = face.values_at(sector, point);
            areas.iter_mut().zip(values).for_each(|(sum, value)| *sum += area * value);
        }
        // Corners 0 and 1 lie at the beginning of the element.
        let own = (0..face.nodes.len()).filter(|a| span[a / 2].abs() == 1.0);
        let point = |a: usize| FacePoint {
            area: areas[a],
            radius: face.radius_at(sector, [0.0, WHOLE_ELEMENT[a / 2]]),
            along: WHOLE_ELEMENT[a / 2],
            rows: [0, 1, 2].map(|component| vec![(first(face.nodes[a]) + component, 1.0)]),
        };
        return own.map(point).collect();
    }
    let (middle, half) = (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0]));
    let point = |([x, y], share): ([f64; 2], f64)| {
        let at = [x, middle + half * y];
        let (values, area) = face.values_at(sector, (at, half * share));
        let [share, radius, angle] = match is_quadratic {
            true => [1.0, face.radius_at(sector, at), sector.half_angle() * x],
            false => face.on_chord(sector, at),
        };
        let row = |component: usize| {
            let parts = face.nodes.iter().zip(&values).flat_map(|(&node, value)| {
                let ahead = sector.half_angle() * (node.1 as f64 - 1.0) - angle;
                let parts = turned(component, ahead).into_iter().enumerate();
                parts.map(move |(c, part)| (first(node) + c, part * value))
            });
            parts.collect()
        };
        FacePoint { area: area * share, radius, along: at[1], rows: [0, 1, 2].map(row) }
    };
    face_quadrature(is_quadratic).map(point).collect()
}
