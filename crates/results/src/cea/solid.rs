//! Results of a body of revolution in three dimensions: base state along the contact, bricks, shapes.

use super::base::{STATUS, TRACTIONS, sliding_status};
use crate::vtu::{Field, solid_vectors};
use frictionsim_chart::{
    Axis, Cell, ColourMap, Field as ColourField, Figure, Line, Marker, Mesh, Panel, SERIES, Side,
};
use frictionsim_output::{Table, columns};
use frictionsim_physics::fem::SolidStress;
use frictionsim_physics::linalg::c64;
use frictionsim_physics::mesh::{ContactRing, SheetNode, SolidFace, SolidSector};
use frictionsim_physics::prestress::SolidSliding;
use std::sync::Arc;

/// Largest displacement drawn, as a fraction of the outer radius.
const DEFLECTION: f64 = 0.07;

/// A body of revolution with its steady sliding state.
#[derive(Clone, Debug)]
pub struct SolidReport {
    /// One sector of the body.
    pub sector: SolidSector,
    /// Its base state.
    pub base: SolidSliding,
    /// Friction coefficient of the base state that is shown.
    pub friction_coefficient: f64,
    /// Its stress at the nodes of one sector, in their frames.
    pub stress: Vec<SolidStress>,
}

columns! {
    /// A ring of contact nodes.
    pub(crate) RINGS: ring as [f64; 2];
    radius_m: "radius of the ring of contact nodes, of bodies of revolution" = ring[0];
    height_m: "its height" = ring[1];
}

impl SolidReport {
    /// Friction traction at each ring, Pa.
    pub fn shears(&self) -> Vec<f64> {
        let rings = self.sector.rings.iter().zip(&self.base.pressures);
        rings
            .map(|(ring, pressure)| {
                self.friction_coefficient * self.base.friction(ring.radius).1.drag * pressure
            })
            .collect()
    }

    /// Displacements of all nodes, sector by sector, from those of one.
    fn repeated(&self, sector: &[f64]) -> Vec<f64> {
        sector.repeat(self.sector.sector_count())
    }

    /// One row for each ring of contact nodes.
    pub(super) fn table(&self) -> Table {
        let tractions = self.base.pressures.iter().copied().zip(self.shears());
        Table::new("prestress.csv", "")
            .columns(RINGS, self.sector.rings.iter().map(|ring| [ring.radius, ring.height]))
            .columns(TRACTIONS, tractions)
            .columns(STATUS, self.base.is_pressed.iter().copied())
    }

    /// Displacement and stress of all nodes; status, pressure and friction traction of the contact nodes.
    pub(super) fn fields(&self) -> Vec<Field> {
        let displacement = self.base.displacement(self.friction_coefficient);
        let displacement = self.repeated(&displacement);
        let mut fields = vec![solid_vectors("displacement_m", &self.sector, &displacement)];
        let stress = self.stress.repeat(self.sector.sector_count());
        fields.extend(Field::solid_stresses(&stress, "rtz"));
        fields.extend(self.contact_fields());
        fields
    }

    /// Status, pressure and friction traction at the contact nodes of all sectors.
    fn contact_fields(&self) -> [Field; 3] {
        let sector = &self.sector;
        let (mut edge, mut ring_of) = (Vec::new(), Vec::new());
        for j in 0..sector.sector_count() {
            for (k, ring) in sector.rings.iter().enumerate() {
                let nodes = ring.nodes.iter();
                edge.extend(nodes.map(|node| (j * sector.node_count() + node) as u32));
                ring_of.extend(std::iter::repeat_n(k, ring.nodes.len()));
            }
        }
        let count = sector.sector_count() * sector.node_count();
        let statuses = ring_of.iter().map(|&k| sliding_status(self.base.is_pressed[k]));
        let at_nodes =
            |values: &[f64]| -> Vec<f64> { ring_of.iter().map(|&k| values[k]).collect() };
        let tractions = [&at_nodes(&self.base.pressures)[..], &at_nodes(&self.shears())];
        Field::contact(count, &edge, statuses, tractions)
    }

    /// Pressure and traction along the contact, and the section as the rotor deforms it.
    pub(super) fn prestress(&self) -> Figure {
        let is_cylinder = self.sector.specification.contact.face() == SolidFace::Inner;
        let (name, place): (&str, fn(&ContactRing) -> f64) = match is_cylinder {
            true => ("height *z*", |ring| ring.height),
            false => ("radius *r*", |ring| ring.radius),
        };
        let places: Vec<f64> = self.sector.rings.iter().map(place).collect();
        let along = |quantity: &str, values: Vec<f64>, colour| {
            let axis = Axis::new(quantity, "Pa").prefixed().including(0.0).room(0.15);
            let points = places.iter().copied().zip(values);
            Panel::new(Axis::new(name, "mm").times(1e3), axis)
                .height(100.0)
                .layer(Line::through(points).solid(colour, 1.2).marked(Marker::Disc, 1.4))
        };
        let displacement = self.base.displacement(self.friction_coefficient);
        let shape: Vec<c64> =
            self.repeated(&displacement).into_iter().map(|v| c64::new(v, 0.0)).collect();
        let largest = shape.chunks_exact(3).map(size).fold(0.0, f64::max);
        let axis = Axis::new("displacement |*u*|", "m").prefixed().between(0.0, largest);
        let state = Picture::new(&self.sector).panel(&shape, axis).height(190.0);
        Figure::new(
            "prestress",
            "Steady sliding: the body from above and its section through the axis, deformed and \
             coloured by displacement (a). Contact pressure (b) and friction traction (c) along \
             the contact.",
        )
        .weighted(&[1.0, 1.15])
        .panel(state.beside(2).colour_bar(Side::Right))
        .panel(along("pressure *p*", self.base.pressures.clone(), SERIES[0]))
        .panel(along("traction *τ*", self.shears(), SERIES[1]))
    }
}

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
        let [nr, nz] = sector.divisions();
        let find = |place: [usize; 2]| {
            let is_here = |node: &SheetNode| node.place == place && node.half_step == 0;
            sector.nodes.iter().position(is_here).unwrap_or(0)
        };
        let mut points: Vec<(usize, usize, bool)> = Vec::new();
        let (mut cells, mut outlines) = (Vec::new(), Vec::new());
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
                    cells.push(Cell { ring, is_quadratic: false });
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
        Self { sector, shown: Arc::new(Mesh { cells, outlines, lines: Vec::new() }), points }
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
        let field = ColourField::new(
            self.shown.clone(),
            places.collect(),
            values,
            axis,
            ColourMap::Viridis,
        );
        let room = 0.04 + 2.0 * DEFLECTION;
        Panel::plane(ColourField::window(&at_rest, room)).layer(field)
    }
}
