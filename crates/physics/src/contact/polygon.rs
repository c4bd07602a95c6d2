//! Convex polygons in a plane.

use nalgebra::Vector2;

/// Area of a polygon, positive where it runs counter-clockwise.
pub(super) fn signed_area(polygon: &[Vector2<f64>]) -> f64 {
    let count = polygon.len();
    let cross = (0..count).map(|i| polygon[i].perp(&polygon[(i + 1) % count]));
    0.5 * cross.sum::<f64>()
}

/// The part of a convex polygon within another, both counter-clockwise.
pub(super) fn clipped(subject: Vec<Vector2<f64>>, window: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let mut polygon = subject;
    for i in 0..window.len() {
        let (from, to) = (window[i], window[(i + 1) % window.len()]);
        let side = |point: &Vector2<f64>| (to - from).perp(&(point - from));
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for j in 0..polygon.len() {
            let (p, q) = (polygon[j], polygon[(j + 1) % polygon.len()]);
            let (a, b) = (side(&p), side(&q));
            if a >= 0.0 {
                kept.push(p);
            }
            if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
                kept.push(p + (q - p) * (a / (a - b)));
            }
        }
        polygon = kept;
    }
    polygon
}

/// A polygon without the corners that span less than `smallest` with their neighbours: where edges of two faces coincide, round-off
/// decides how many of them clipping leaves, and with it where the quadrature points of the segment lie.
pub(super) fn without_straight_corners(
    mut polygon: Vec<Vector2<f64>>,
    smallest: f64,
) -> Vec<Vector2<f64>> {
    let is_straight = |polygon: &[Vector2<f64>], i: usize| {
        let count = polygon.len();
        let corner = [(i + count - 1) % count, i, (i + 1) % count].map(|place| polygon[place]);
        signed_area(&corner) <= smallest
    };
    while let Some(i) = (0..polygon.len()).find(|&i| is_straight(&polygon, i)) {
        polygon.remove(i);
    }
    polygon
}
