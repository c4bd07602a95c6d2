//! A body of revolution in three dimensions as a picture.

use frictionsim_chart::{Axis, ColourMap, Field, Mesh, Panel};
use frictionsim_physics::linalg::c64;
use frictionsim_physics::mesh::{SheetNode, SolidSector};
use std::sync::Arc;

/// Largest displacement drawn, as a fraction of the outer radius or of the half width of a mesh.
pub(super) const DEFLECTION: f64 = 0.07;

/// Amplitude of the displacement of a node.
pub(super) fn size(u: &[c64]) -> f64 {
    u.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt()
}

/// The top face from above, and under it the section through the axis.
pub(super) struct Picture<'a> {
    sector: &'a SolidSector,
    shown: Arc<Mesh>,
    /// Sector node and sector of each point, its place, and whether it belongs to the section.
    points: Vec<(usize, usize, bool)>,
}

impl<'a> Picture<'a> {
    pub fn new(sector: &'a SolidSector) -> Self {
        let sectors = sector.sector_count();
        let [nr, nz] = sector.specification.divisions();
        let find = |place: [usize; 2]| {
            let is_here = |node: &SheetNode| node.place == place && node.half_step == 0;
            sector.nodes.iter().position(is_here).unwrap_or(0)
        };
        let mut points: Vec<(usize, usize, bool)> = Vec::new();
        let (mut rings, mut outlines) = (Vec::new(), Vec::new());
        let mut grid = |rows: &[Vec<(usize, usize, bool)>], is_closed: bool| {
            let first = points.len() as u32;
            let width = rows[0].len() as u32;
            let count = rows.len() as u32;
            points.extend(rows.iter().flatten());
            let at = |row: u32, column: u32| first + (row % count) * width + column;
            for row in 0..if is_closed { count } else { count - 1 } {
                for column in 0..width - 1 {
                    let corners = [(0, 0), (0, 1), (1, 1), (1, 0)];
                    let ring = corners.map(|(up, right)| at(row + up, column + right)).to_vec();
                    rings.push(ring);
                }
            }
            if is_closed {
                for column in [0, width - 1] {
                    outlines.push((0..=count).map(|row| at(row, column)).collect());
                }
            } else {
                let bottom = (0..width).map(|column| at(0, column));
                let up = (1..count).map(|row| at(row, width - 1));
                let top = (0..width - 1).rev().map(|column| at(count - 1, column));
                let down = (0..count - 1).rev().map(|row| at(row, 0));
                outlines.push(bottom.chain(up).chain(top).chain(down).collect());
            }
        };
        let top: Vec<usize> = (0..=nr).map(|i| find([2 * i, 2 * nz])).collect();
        let face: Vec<Vec<_>> =
            (0..sectors).map(|j| top.iter().map(|&node| (node, j, false)).collect()).collect();
        grid(&face, true);
        for side in [0, sectors / 2] {
            let section: Vec<Vec<_>> = (0..=nz)
                .map(|j| (0..=nr).map(|i| (find([2 * i, 2 * j]), side, true)).collect())
                .collect();
            grid(&section, false);
        }
        let are_quadratic = vec![false; rings.len()];
        let shown = Mesh { rings, are_quadratic, outlines, lines: Vec::new() };
        Self { sector, shown: Arc::new(shown), points }
    }

    /// The real part of a shape, scaled to its own largest displacement; amplitudes on `axis`.
    pub fn panel(&self, shape: &[c64], axis: Axis) -> Panel {
        let sector = self.sector;
        let outer = sector.specification.annulus.outer_radius;
        let base = -1.25 * outer - sector.specification.thickness;
        let displacement = |node: usize, j: usize| {
            let first = 3 * (j * sector.node_count() + node);
            [0, 1, 2].map(|c| shape.get(first + c).map_or(0.0, |v| v.re))
        };
        let amplitude = |u: &[f64; 3]| u.iter().map(|v| v * v).sum::<f64>().sqrt();
        let moved: Vec<[f64; 3]> =
            self.points.iter().map(|&(node, j, _)| displacement(node, j)).collect();
        let largest = shape.chunks_exact(3).map(|u| amplitude(&[0, 1, 2].map(|c| u[c].re)));
        let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
        let factor = DEFLECTION * outer / largest;
        let place = |&(node, j, is_section): &(usize, usize, bool), u: [f64; 3]| {
            let (sin, cos) = sector.angle(node, j).sin_cos();
            let SheetNode { radius, height, .. } = sector.nodes[node];
            let radial = radius + factor * u[0];
            match is_section {
                true => [cos.signum() * radial, base + height + factor * u[2]],
                false => [cos * radial - sin * factor * u[1], sin * radial + cos * factor * u[1]],
            }
        };
        let at_rest: Vec<[f64; 2]> =
            self.points.iter().map(|point| place(point, [0.0; 3])).collect();
        let places = self.points.iter().zip(&moved).map(|(point, u)| place(point, *u));
        let values = moved.iter().map(amplitude).collect();
        let field =
            Field::new(self.shown.clone(), places.collect(), values, axis, ColourMap::Viridis);
        let room = 0.04 + 2.0 * DEFLECTION;
        Panel::plane(Field::window(&at_rest, room)).layer(field.coarse())
    }
}
