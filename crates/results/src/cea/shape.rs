//! Mode shapes as pictures of the deformed body: in the plane, of revolution, or of solid bodies.

use super::{CeaReport, arrow};
use crate::common::*;
use frictionsim_chart::Field;
use frictionsim_physics::mesh::SheetNode;

/// One mode to draw.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModeShape<'a> {
    /// Number in the list of modes, 1-based, in order of frequency.
    pub number: usize,
    /// Friction coefficient.
    pub friction: f64,
    /// Whether modes have a circumferential harmonic.
    pub has_harmonics: bool,
    /// The mode.
    pub mode: &'a ComplexMode,
}

impl<'a> ModeShape<'a> {
    /// All modes of a report that carry shapes, by rising friction.
    pub fn all(report: &CeaReport<'a>) -> impl Iterator<Item = Self> {
        let has_harmonics = report.has_harmonics;
        let shapes = report.modes().filter(|(.., mode)| mode.shape.is_some());
        shapes.map(move |(friction, number, mode)| Self { number, friction, has_harmonics, mode })
    }

    /// Harmonic, direction and stability in mark-up.
    pub fn harmonic(&self) -> String {
        let arrow = arrow(self.mode.direction);
        let unstable = if self.mode.is_unstable() { " unstable" } else { "" };
        if !self.has_harmonics {
            let diameters = self.mode.nodal_diameters;
            let diameters = diameters.map_or(String::new(), |n| format!("*n* = {n}"));
            return format!("{diameters}{unstable}").trim().to_owned();
        }
        format!("*n* = {}{arrow}{unstable}", self.mode.harmonic)
    }
}

/// A body whose shapes are drawn.
pub(super) enum Body<'a> {
    /// In the plane.
    Plane(Disc<'a>),
    /// With a thickness.
    Solid(Picture<'a>),
    /// From a mesh file of solid elements.
    Assembly(SolidView<'a>),
}

impl<'a> Body<'a> {
    /// The body of a report, with about so many rays on a plane one.
    pub fn new(report: &CeaReport<'a>, rays: usize) -> Self {
        let mesh = report.body.mesh;
        match report.body.sector {
            Some(sector) => Self::Solid(Picture::new(sector)),
            None if report.body.is_assembly() => Self::Assembly(SolidView::new(mesh)),
            None => Self::Plane(Disc::with_lattice(mesh, rays)),
        }
    }

    /// The deformed body under some lines of heading.
    pub fn panel(&self, shape: &ModeShape<'_>, lines: &[String; 3]) -> Panel {
        let values = shape.mode.shape.as_deref().unwrap_or(&[]);
        let panel = match self {
            Self::Plane(disc) => plane_panel(disc, values, shape.mode.harmonic),
            Self::Assembly(view) => assembly_panel(view, values),
            Self::Solid(picture) => {
                picture.panel(values, Axis::new("", "").between(0.0, 1.0)).height(170.0)
            }
        };
        let colour = if shape.mode.is_unstable() { UNSTABLE } else { INK };
        lines.iter().fold(panel, |panel, line| panel.heading_in(colour, line))
    }
}

/// The deformed body, coloured by the displacement amplitude of the real part.
///
/// A travelling wave is shown at the instant that puts its crest at angle zero; every shape is scaled to its own
/// maximum, which an eigenvector leaves open.
fn plane_panel(disc: &Disc<'_>, values: &[c64], harmonic: usize) -> Panel {
    let mesh = disc.mesh;
    let turn = crest_phase(mesh, values, harmonic);
    let real: Vec<f64> = values.iter().map(|u| (u * turn).re).collect();
    let amplitude: Vec<f64> = real.chunks_exact(2).map(|u| u[0].hypot(u[1])).collect();
    let largest = amplitude.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let [low, high] = Field::window(&mesh.plane_nodes(), 0.0);
    let magnification = DEFLECTION * 0.5 * (high[0] - low[0]) / largest;
    let axis = Axis::new("", "").between(0.0, largest);
    let stroke = Stroke::solid(MUTED, 0.45).dashes(&[1.5, 1.2]);
    // What is free at its rim leaves the place that it has at rest.
    let room = if mesh.is_cyclic { 0.02 } else { 0.04 + 2.0 * DEFLECTION };
    disc.panel(room)
        .height(150.0)
        .layer(disc.deformed(amplitude, &real, magnification, axis))
        .layer(Line::through(disc.contact_edge()).stroke(stroke))
}

/// The deformed bodies, coloured by the displacement amplitude, at the instant of the largest displacement.
fn assembly_panel(view: &SolidView<'_>, values: &[c64]) -> Panel {
    let turn = turned_back(square_of(values).sqrt());
    let real: Vec<f64> = values.iter().map(|u| (u * turn).re).collect();
    let amplitude: Vec<f64> =
        real.chunks_exact(3).map(|u| u.iter().map(|x| x * x).sum::<f64>().sqrt()).collect();
    let largest = amplitude.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let magnification = 0.5 * DEFLECTION * view.size() / largest;
    let axis = Axis::new("", "").between(0.0, largest);
    let surface = view.surface(&amplitude, (&real, magnification), axis, ColourMap::Viridis);
    Panel::plane(surface.window(0.04)).height(130.0).layer(surface)
}

/// The modes as motions to choose from: the unstable ones first, as many as a page carries.
pub(super) fn moving(report: &CeaReport<'_>, shapes: &[ModeShape<'_>]) -> Motion {
    let mesh = &report.body.whole();
    let body = MovingBody::new(mesh);
    let (unstable, stable): (Vec<&ModeShape<'_>>, Vec<_>) =
        shapes.iter().partition(|s| s.mode.is_unstable());
    let states = unstable.into_iter().chain(stable).take(body.most_states()).map(|shape| {
        let values = shape.mode.shape.as_deref().unwrap_or(&[]);
        let part = |of: fn(&c64) -> f64| {
            body.cartesian(|node| {
                let first = mesh.dimension * node;
                let own = values.get(first..first + mesh.dimension).unwrap_or(&[]);
                let component = |k: usize| own.get(k).map_or(0.0, of);
                [0, 1, 2].map(component)
            })
        };
        let frequency_hz = shape.mode.frequency_hz();
        let name =
            format!("{}: {} Hz, {}", shape.number, signed(frequency_hz, 0), shape.harmonic());
        MotionState {
            name: plain(name.trim_end_matches(", ")),
            frequency_hz,
            kind: MotionKind::Harmonic { real: part(|z| z.re), imaginary: part(|z| z.im) },
        }
    });
    Motion { states: states.collect(), ..body.at_rest.clone() }
}

/// Unit factor that turns a shape to the instant drawn.
///
/// A standing wave (`|sum u^2|` near `sum |u|^2`) is turned to its largest real part; a travelling one so that the wave
/// that carries most of it has its tangential crest at angle zero. Both depend on the shape alone, not on the arbitrary
/// phase a solver gave it.
fn crest_phase(mesh: &Mesh, shape: &[c64], harmonic: usize) -> c64 {
    let square = square_of(shape);
    let total: f64 = shape.iter().map(|u| u.norm_sqr()).sum();
    if square.norm() > 0.5 * total {
        return turned_back(square.sqrt());
    }
    let wave = |sign: f64| {
        shape.chunks_exact(2).zip(mesh.frame_angles()).fold(c64::ZERO, |sum, (u, &angle)| {
            let phase = sign * harmonic as f64 * angle;
            sum + u[1] * c64::new(phase.cos(), phase.sin())
        })
    };
    let (forward, backward) = (wave(-1.0), wave(1.0));
    turned_back(if forward.norm() >= backward.norm() { forward } else { backward })
}

/// `sum u^2` of a shape.
fn square_of(shape: &[c64]) -> c64 {
    shape.iter().fold(c64::ZERO, |sum, u| sum + u * u)
}

/// Unit factor that makes a number real and positive.
fn turned_back(z: c64) -> c64 {
    if z.norm() > 0.0 { z.conj() / z.norm() } else { c64::ONE }
}

/// Largest displacement drawn, as a fraction of the outer radius or of the half width of a mesh.
pub(super) const DEFLECTION: f64 = 0.07;

/// Amplitude of the displacement of a node.
pub(super) fn size(u: &[c64]) -> f64 {
    u.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt()
}

/// The top face from above, and under it the section through the axis.
pub(super) struct Picture<'a> {
    sector: &'a SolidSector,
    shown: Arc<frictionsim_chart::Mesh>,
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
        let shown = frictionsim_chart::Mesh { rings, are_quadratic, outlines, lines: Vec::new() };
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
