//! Terms on the faces of a body of revolution in three dimensions: contact, supports, pressure.

use super::fold::SectorMatrix;
use crate::mesh::{BoundaryCondition, FaceElement, SolidFace, SolidSector, face_quadrature};
use nalgebra::DMatrix;

/// A term `∫ w d_row (d_column . u) dA` on a face: a force along one direction for each unit of motion along another.
pub struct FaceTerm<'a> {
    /// Component `(r, theta, z)` along which the force acts.
    pub row: usize,
    /// Component of the motion.
    pub column: usize,
    /// `w`, per unit of area, from the radius (m) and the place along the element, -1 to 1.
    pub weight: &'a dyn Fn(&FaceElement, f64, f64) -> f64,
    /// The part of an element that it acts on, from -1 to 1; of a lumped one the ends in it.
    pub span: &'a dyn Fn(&FaceElement) -> [f64; 2],
    /// How a linear element takes it.
    pub rule: FaceRule,
}

/// How a linear element takes a term. Quadratic ones integrate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceRule {
    /// Consistent, over the plane face that its nodes span: what the whole mesh has.
    Integrated,
    /// Lumped at the nodes, with the weight there: what a time step has.
    Nodal,
}

/// All of an element.
pub fn whole_element(_: &FaceElement) -> [f64; 2] {
    [-1.0, 1.0]
}

/// Components in a node's frame of a unit vector along `component` at an angle `ahead` of the point.
fn turned(component: usize, ahead: f64) -> [f64; 3] {
    let (sin, cos) = ahead.sin_cos();
    match component {
        0 => [cos, -sin, 0.0],
        1 => [sin, cos, 0.0],
        _ => [0.0, 0.0, 1.0],
    }
}

/// Angle of each node ahead of a point at an angle from the middle of a face element, rad.
fn angles_ahead(sector: &SolidSector, face: &FaceElement, angle: f64) -> Vec<f64> {
    let ahead = |(_, half): &(usize, usize)| sector.half_angle() * (*half as f64 - 1.0) - angle;
    face.nodes.iter().map(ahead).collect()
}

/// The matrix of a term over some elements of a face: linear ones by the term's rule.
pub fn face_matrix(
    sector: &SolidSector,
    faces: &[FaceElement],
    term: &FaceTerm<'_>,
) -> SectorMatrix {
    let matrix_of = |face: &FaceElement| {
        let size = 3 * face.nodes.len();
        let mut matrix = DMatrix::zeros(size, size);
        let span = (term.span)(face);
        let is_integrated = sector.is_quadratic() || term.rule == FaceRule::Integrated;
        let (middle, half) = match is_integrated {
            true => (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0])),
            false => (0.0, 1.0),
        };
        for ([x, y], share) in face_quadrature(sector.is_quadratic()) {
            let point = ([x, middle + half * y], half * share);
            let (values, area) = face.values_at(sector, point);
            if !is_integrated {
                for (a, value) in values.iter().enumerate() {
                    // Corners 0 and 1 lie at the beginning of the element.
                    let end = [-1.0, 1.0][a / 2];
                    if span[a / 2].abs() == 1.0 {
                        let radius = face.radius_at(sector, [0.0, end]);
                        let weight = area * (term.weight)(face, radius, end);
                        matrix[(3 * a + term.row, 3 * a + term.column)] += weight * value;
                    }
                }
                continue;
            }
            let on_arc = [1.0, face.radius_at(sector, point.0), sector.half_angle() * point.0[0]];
            let [share, radius, angle] =
                if sector.is_quadratic() { on_arc } else { face.on_chord(sector, point.0) };
            let weight = area * share * (term.weight)(face, radius, point.0[1]);
            let ahead = angles_ahead(sector, face, angle);
            let [rows, columns] = [term.row, term.column].map(|c| along(&values, &ahead, c));
            for (j, column) in columns.iter().enumerate() {
                for (i, row) in rows.iter().enumerate() {
                    matrix[(i, j)] += weight * row * column;
                }
            }
        }
        matrix
    };
    let entries = faces.iter().flat_map(|face| {
        let (matrix, place) = (matrix_of(face), |k: usize| (face.nodes[k / 3], k % 3));
        (0..matrix.len()).map(move |k| {
            let [((node, here), c), ((other, there), d)] =
                [k % matrix.nrows(), k / matrix.nrows()].map(place);
            (3 * node + c, 3 * other + d, there as isize - here as isize, matrix[k])
        })
    });
    SectorMatrix::of_entries(3, entries)
}

/// Components in the nodes' frames of a unit vector along `component` at a point, times `values` of the nodes.
fn along(values: &[f64], ahead: &[f64], component: usize) -> Vec<f64> {
    let nodes = values.iter().zip(ahead);
    nodes.flat_map(|(value, angle)| turned(component, *angle).map(|c| c * value)).collect()
}

/// Forces of the pressures on the faces, the same in every sector, N.
pub fn pressure_load(sector: &SolidSector) -> Vec<f64> {
    let mut load = vec![0.0; 3 * sector.node_count()];
    for (face, condition) in SolidFace::ALL.into_iter().zip(&sector.specification.conditions) {
        let BoundaryCondition::Pressure(pressure) = condition else { continue };
        let (component, factor) = (face.normal_component(), pressure * face.inward_sign());
        for element in sector.face_elements(face) {
            for point in face_quadrature(sector.is_quadratic()) {
                let (values, area) = element.values_at(sector, point);
                let ahead = angles_ahead(sector, &element, sector.half_angle() * point.0[0]);
                for (((node, _), value), angle) in element.nodes.iter().zip(values).zip(ahead) {
                    let angle = if sector.is_quadratic() { angle } else { 0.0 };
                    for (c, part) in turned(component, angle).into_iter().enumerate() {
                        load[3 * node + c] += factor * area * value * part;
                    }
                }
            }
        }
    }
    load
}
