//! A nodal field over a (deformed) mesh as a small image with sharp outlines.

use super::FigureError;
use super::colour::{ColourMap, INK};
use super::decimation::simplify;
use super::raster::{self, IndexedImage};
use super::svg::{Path, Rect, Stroke, Svg};
use crate::mesh::{Boundary, ElementKind, Mesh2d};
use std::collections::BTreeMap;

/// A square window of the plane: centre and half width, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Centre, m.
    pub centre: [f64; 2],
    /// Half the width, m.
    pub half_width: f64,
}

impl View {
    /// The window that holds all points with `room` (a fraction of its size) around them.
    pub fn around(points: &[[f64; 2]], room: f64) -> Self {
        let [x, y] = [0, 1].map(|axis| super::axis::extremes(points.iter().map(|p| p[axis])));
        let half = 0.5 * (x.1 - x.0).max(y.1 - y.0);
        Self {
            centre: [0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)],
            half_width: half * (1.0 + room),
        }
    }

    /// Point of the plane to point of the drawing.
    pub fn to_drawing(&self, rect: &Rect, point: [f64; 2]) -> (f64, f64) {
        let scale = 0.5 * rect.width.min(rect.height) / self.half_width;
        (
            rect.x + 0.5 * rect.width + scale * (point[0] - self.centre[0]),
            rect.y + 0.5 * rect.height - scale * (point[1] - self.centre[1]),
        )
    }
}

/// Positions of all nodes after a displacement (in nodal frames, two values a node, m) times
/// `magnification`.
pub fn deformed(mesh: &Mesh2d, displacement: &[f64], magnification: f64) -> Vec<[f64; 2]> {
    mesh.nodes
        .iter()
        .zip(&mesh.frame_angles)
        .enumerate()
        .map(|(node, (&[x, y], &angle))| {
            let (sin, cos) = angle.sin_cos();
            let pair = displacement.get(2 * node..2 * node + 2);
            let [first, second] = pair.map_or([0.0; 2], |p| [p[0], p[1]]);
            [
                x + magnification * (cos * first - sin * second),
                y + magnification * (sin * first + cos * second),
            ]
        })
        .collect()
}

/// Colours a nodal field over the mesh with nodes at `positions`, values from `range.0` to `range.1`.
///
/// Values are interpolated linearly on four triangles around the centre of each element (eight for
/// Quad8). `pixels` is the side of the square image.
pub fn rasterize(
    mesh: &Mesh2d,
    positions: &[[f64; 2]],
    values: &[f64],
    range: (f64, f64),
    view: &View,
    (pixels, levels): (usize, usize),
) -> IndexedImage {
    let mut image = IndexedImage {
        width: pixels,
        height: pixels,
        pixels: vec![levels as u8; pixels * pixels],
    };
    let scale = 0.5 * pixels as f64 / view.half_width;
    let steepness = levels as f64 / (range.1 - range.0).max(f64::MIN_POSITIVE);
    let vertex = |node: u32| {
        let [x, y] = positions[node as usize];
        [
            0.5 * pixels as f64 + scale * (x - view.centre[0]),
            0.5 * pixels as f64 - scale * (y - view.centre[1]),
            (values[node as usize] - range.0) * steepness,
        ]
    };
    for element in 0..mesh.element_count() {
        let nodes = mesh.element_nodes(element);
        match mesh.element_kind {
            ElementKind::Quad4 => {
                let ring = [0, 1, 2, 3].map(|i| vertex(nodes[i]));
                let centre = weighted(&ring, &[0.25; 4]);
                fan(&mut image, &ring, centre, levels);
            }
            ElementKind::Quad8 => {
                let ring = [0, 4, 1, 5, 2, 6, 3, 7].map(|i| vertex(nodes[i]));
                // Serendipity shape functions at the centre: -1/4 at corners, 1/2 at mid-sides.
                let weights = [-0.25, 0.5, -0.25, 0.5, -0.25, 0.5, -0.25, 0.5];
                let centre = weighted(&ring, &weights);
                fan(&mut image, &ring, centre, levels);
            }
        }
    }
    image
}

fn weighted(ring: &[[f64; 3]], weights: &[f64]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (vertex, weight) in ring.iter().zip(weights) {
        for axis in 0..3 {
            sum[axis] += weight * vertex[axis];
        }
    }
    sum
}

fn fan(image: &mut IndexedImage, ring: &[[f64; 3]], centre: [f64; 3], levels: usize) {
    for index in 0..ring.len() {
        let next = ring[(index + 1) % ring.len()];
        triangle(image, [centre, ring[index], next], levels);
    }
}

/// Fills a triangle of vertices (x, y in pixels, level), pixel centres inside or on its edge.
fn triangle(image: &mut IndexedImage, [a, b, c]: [[f64; 3]; 3], levels: usize) {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if !area.is_finite() || area.abs() < 1e-12 {
        return;
    }
    let bounds = |axis: usize, limit: usize| {
        let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
        let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
        let first = low.ceil().max(0.0) as usize;
        let last = high.floor().min(limit as f64 - 1.0);
        (first, last)
    };
    let (columns, rows) = (bounds(0, image.width), bounds(1, image.height));
    if columns.1 < 0.0 || rows.1 < 0.0 {
        return;
    }
    for row in rows.0..=rows.1 as usize {
        for column in columns.0..=columns.1 as usize {
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            let v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
            let w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
            // Neighbours share pixels on their common edge, so no seam shows.
            if v >= -1e-9 && w >= -1e-9 && v + w <= 1.0 + 1e-9 {
                let level = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
                let level = level.clamp(0.0, (levels - 1) as f64) as u8;
                image.pixels[row * image.width + column] = level;
            }
        }
    }
}

/// How a field is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldStyle {
    /// Lowest and highest value of the colour map.
    pub range: (f64, f64),
    /// Colour map.
    pub map: ColourMap,
    /// Image pixels for each point of the drawing.
    pub pixels_per_point: f64,
    /// Colours ([`raster::FINE`] or [`raster::COARSE`]).
    pub levels: usize,
    /// Rays of nodes drawn as thin lines to show the deformation, with circles to match; 0 for none.
    pub rays: usize,
}

/// Draws a nodal field over the mesh, with its outlines, into a square of the drawing.
///
/// # Errors
/// [`FigureError::Shape`] if positions or values are not one for each node.
pub fn draw_field(
    svg: &mut Svg,
    rect: &Rect,
    view: &View,
    mesh: &Mesh2d,
    positions: &[[f64; 2]],
    values: &[f64],
    style: &FieldStyle,
) -> Result<(), FigureError> {
    super::expect_length("node positions", positions.len(), mesh.node_count())?;
    super::expect_length("nodal values", values.len(), mesh.node_count())?;
    let pixels = (rect.width * style.pixels_per_point).round().max(1.0) as usize;
    let image = rasterize(
        mesh,
        positions,
        values,
        style.range,
        view,
        (pixels, style.levels),
    );
    let palette = raster::map_palette(style.map, style.levels);
    svg.image(rect, &image.encode(&palette)?, false);
    if style.rays > 0 {
        let stroke = Stroke::solid("#ffffff", 0.3).with_opacity(0.45);
        svg.path(&lattice(mesh, positions, rect, view, style.rays), &stroke);
    }

    for edge in [&mesh.inner_edge, &mesh.outer_edge] {
        let path = outline(edge, positions, rect, view);
        svg.path(&path, &Stroke::solid(INK, 0.6));
    }
    Ok(())
}

/// Every few rays and circles of nodes, found by their equal angle and radius; empty on a mesh that
/// has none.
fn lattice(mesh: &Mesh2d, positions: &[[f64; 2]], rect: &Rect, view: &View, wanted: usize) -> Path {
    let mut rays: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    let mut circles: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for (node, &[x, y]) in mesh.nodes.iter().enumerate() {
        let ray = (mesh.frame_angles[node] * 1e6).round() as i64;
        let circle = (x.hypot(y) / view.half_width * 1e6).round() as i64;
        rays.entry(ray).or_default().push(node);
        circles.entry(circle).or_default().push(node);
    }
    let mut path = Path::new();
    for (lines, count, closed) in [(&rays, wanted, false), (&circles, wanted.div_ceil(3), true)] {
        let lines: Vec<&Vec<usize>> = lines.values().collect();
        // Spread evenly, also where the count does not divide the lines there are.
        let count = count.min(lines.len());
        let chosen = (0..count).map(|index| lines[index * lines.len() / count]);
        for nodes in chosen.filter(|nodes| nodes.len() > 2) {
            let mut points: Vec<(f64, f64)> = nodes
                .iter()
                .map(|&node| view.to_drawing(rect, positions[node]))
                .collect();
            if closed {
                points.push(points[0]);
            }
            path.extend(simplify(&points, 0.12));
        }
    }
    path
}

/// The closed outline of a boundary.
pub fn outline(edge: &Boundary, positions: &[[f64; 2]], rect: &Rect, view: &View) -> Path {
    let points = edge
        .nodes
        .iter()
        .map(|&node| view.to_drawing(rect, positions[node as usize]));
    Path::polyline(points, true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{AnnulusMesh, AnnulusSpecification};

    #[test]
    fn raster_covers_the_annulus_area_and_follows_the_field() {
        for element in [ElementKind::Quad4, ElementKind::Quad8] {
            let mesh = AnnulusMesh::generate(&AnnulusSpecification {
                inner_radius: 0.5,
                outer_radius: 1.0,
                circumferential_elements: 90,
                radial_elements: 6,
                radial_grading: 1.0,
                element,
            })
            .unwrap()
            .mesh;
            let values: Vec<f64> = mesh.nodes.iter().map(|p| p[0]).collect();
            let view = View {
                centre: [0.0; 2],
                half_width: 1.0,
            };
            let image = rasterize(&mesh, &mesh.nodes, &values, (-1.0, 1.0), &view, (400, 48));
            let filled = image.pixels.iter().filter(|&&p| p < 48).count() as f64;
            let exact = std::f64::consts::PI * 0.75 / 4.0 * 160_000.0;
            // A pixel on the rim counts whole or not at all: about one in a hundred.
            assert!((filled / exact - 1.0).abs() < 0.01, "{filled} {exact}");
            let level = |column: usize| f64::from(image.pixels[200 * 400 + column]);
            let expected = |column: usize| (column as f64 + 0.5) / 400.0 * 48.0;
            for column in [20, 60, 320, 380] {
                assert!((level(column) + 0.5 - expected(column)).abs() < 1.0);
            }
        }
    }
}
