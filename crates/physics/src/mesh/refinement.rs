//! Uniform refinement of a mesh file: every element into four.

use super::ElementKind;
use super::error::BodyError;
use super::rim::Rim;
use super::splitting::{Place, STEPS, Splitting, between};
use frictionsim_formats::{CurveEdge, FileElement, FileMesh};

/// The same body with every element split into four alike; nodes keep their numbers, new ones count on from the largest.
///
/// Where an edge of the body, or between two of its regions, follows a smooth curve, the new nodes lie on the circle through its
/// neighbours: arcs stay arcs to round-off. Elsewhere they lie on the old edge, a parabola where it is quadratic.
///
/// # Errors
/// [`BodyError::Body`] for a mesh that would have too many nodes, or of solid elements.
pub fn refined_file(file: &FileMesh) -> Result<FileMesh, BodyError> {
    if file.dimension == 3 {
        return Err(BodyError::Body(
            "a file of solid elements is refined as the mesh that is made of it".to_owned(),
        ));
    }
    let mut splitting = Splitting::of(&file.points, 2)?;
    let mut fine =
        FileMesh { elements: Vec::with_capacity(4 * file.elements.len()), ..file.clone() };
    let rim = Rim::of(file);
    for element in &file.elements {
        let (kind, own) = (element.kind, &element.nodes);
        let curved = |splitting: &Splitting, place: &Place| match place[..] {
            [(p, half), (q, other)] if half == other => rim.middle(&file.points, p, q),
            [(p, steps), (q, other)] => {
                let near = if steps > other { p } else { q };
                let middle = splitting.places[&between(p, STEPS / 2, q)];
                rim.middle(&file.points, near, middle)
            }
            _ => (kind == ElementKind::Quad4).then(|| center(&rim, &file.points, own)),
        };
        for part in splitting.split(kind, own, curved) {
            fine.elements.push(FileElement {
                label: fine.elements.len() + 1,
                kind: part.kind,
                nodes: part.nodes.iter().map(|(node, _)| *node).collect(),
                region: element.region.clone(),
                ..*element
            });
        }
    }
    // The halves of an edge of a physical curve; none where no element has it.
    let at = |p, steps, q| splitting.places.get(&between(p, steps, q)).copied();
    let halves = |&(p, q, _): &CurveEdge| {
        let halved = at(p, STEPS / 2, q)
            .map(|m| [(p, m, at(p, 3 * STEPS / 4, q)), (m, q, at(q, 3 * STEPS / 4, p))]);
        halved.into_iter().flatten()
    };
    for edges in fine.curves.values_mut() {
        *edges = edges.iter().flat_map(halves).collect();
    }
    fine.labels = splitting.labels(&file.labels);
    fine.is_used.resize(splitting.points.len(), true);
    fine.points = splitting.points;
    Ok(fine)
}

/// The middle of a linear quadrilateral: halfway between opposite edges, less the corners that both count.
fn center(rim: &Rim, points: &[[f64; 3]], nodes: &[u32]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (&p, &q) in nodes.iter().zip(nodes.iter().cycle().skip(1)) {
        let [a, b] = [p, q].map(|node| points[node as usize]);
        let plain = [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]));
        let middle = rim.middle(points, p.min(q), p.max(q)).unwrap_or(plain);
        (0..3).for_each(|axis| sum[axis] += 0.5 * middle[axis] - 0.25 * a[axis]);
    }
    sum
}
