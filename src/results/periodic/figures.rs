//! The figures of limit cycles of a body without symmetry, from their record.

use super::branch_figure::branch_figure;
use super::record::{MotionRecord, PeriodicRecord};
use crate::chart::{
    Axis, ChartError, ColourMap, Figure, INK, Line, MUTED, Marker, Panel, Rule, SERIES, Stroke,
};
use crate::contact::ContactStatus;
use crate::fem::MaterialField;
use crate::mesh::{Mesh, SolidFace, SolidSector};
use crate::results::charts::palette::status_ground;
use crate::results::charts::{
    ContactVelocity, Disc, FieldFrame, contact_figure, field_figure, open_contact_figure,
    place_axis, shear_stress_figure, speeds_on_top, status_curves, status_map,
};
use crate::results::drawing::{Declaration, DrawingOptions, draw_all};
use crate::results::report::NamedFigure;
use std::f64::consts::TAU;

/// Whole-field pictures of one kind, at most.
pub(super) const FIELD_LIMIT: usize = 8;
/// Periods of a history.
const PERIODS: usize = 2;

/// Limit cycles and what their figures show besides.
pub struct PeriodicFigures<'a> {
    /// The record.
    pub record: &'a PeriodicRecord,
    /// The mesh; of a body of revolution in three dimensions the section across the axis.
    pub mesh: &'a Mesh,
    /// One sector of a body of revolution in three dimensions.
    pub solid: Option<&'a SolidSector>,
    /// The contacts of an assembly, each with the boundary that has its points.
    pub surfaces: Vec<(String, usize)>,
    /// The materials, for the stress fields.
    pub materials: &'a dyn MaterialField,
}

/// Amplitude along the normal, over that along the contact, below which it is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Draws the cycles: contact over the period and at one instant, history, closed curves and harmonics of each, then the
/// fields of all.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_cycles(
    data: &PeriodicFigures<'_>,
    options: &DrawingOptions,
) -> Result<Vec<NamedFigure>, ChartError> {
    let mut figures: Vec<Declaration<'_>> = Vec::new();
    for motion in &data.record.cycles {
        figures.push(Box::new(move || data.status(motion)));
        figures.push(Box::new(move || Ok(data.at_one_instant(motion))));
        figures.push(Box::new(move || Ok(data.history(motion))));
        figures.push(Box::new(move || Ok(data.orbit(motion))));
        figures.push(Box::new(move || Ok(harmonics(motion))));
        figures.push(Box::new(move || branch_figure(motion)));
    }
    figures.push(Box::new(|| data.velocity()));
    figures.push(Box::new(|| data.shear_stress()));
    draw_all(figures, options)
}

impl PeriodicFigures<'_> {
    /// Which contact nodes the figures over the angle show: of several rings of nodes the middle one.
    fn is_shown(&self, node: usize) -> bool {
        let rings = self.solid.map_or(1, |sector| sector.rings.len());
        node % rings == rings / 2
    }

    fn shown<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let places = (0..values.len()).filter(|&i| self.is_shown(i % self.record.nodes.len()));
        places.map(|i| values[i]).collect()
    }

    /// Whether it is of solid bodies of a mesh.
    pub(super) fn is_assembly(&self) -> bool {
        self.solid.is_none() && self.mesh.dimension == 3
    }

    /// Where the shown contact nodes are.
    fn places(&self) -> Axis {
        match self.is_assembly() {
            true => {
                Axis::new("contact nodes in their order", "%").times(100.0 / TAU).between(0.0, TAU)
            }
            false => place_axis(self.mesh.has_round_contact()),
        }
    }

    /// The status of all contact nodes over one period.
    fn status(&self, motion: &MotionRecord) -> Result<Figure, ChartError> {
        let ends = (motion.times[0], motion.times[motion.times.len() - 1]);
        let codes = self.shown(&motion.status);
        let map = status_map(&motion.times, codes.len() / motion.times.len(), &codes, ends);
        let (map, _) = map.ok_or_else(|| ChartError::empty("statuses over a period"))?;
        let caption = format!(
            "Contact status of every contact node over one period of the limit cycle of {}.",
            motion.hertz()
        );
        let panel =
            Panel::new(Axis::time(), self.places()).plain().height(120.0).layer(map).legend();
        Ok(Figure::new(format!("status-{}", motion.tag()), caption).panel(panel))
    }

    /// The contact at time zero.
    fn at_one_instant(&self, motion: &MotionRecord) -> Figure {
        if self.is_assembly() {
            return self.on_surfaces(motion);
        }
        let [pressure, shear, velocity] = motion.edge.each_ref().map(|own| self.shown(own));
        let velocity = match self.mesh.opposite {
            Some(_) => ContactVelocity::Absolute(&velocity, f64::NAN),
            None => ContactVelocity::Absolute(&velocity, self.shown_speed(motion)),
        };
        let statuses = self.shown(&motion.first_statuses());
        let name = format!("contact-{}", motion.tag());
        if !self.mesh.has_round_contact() {
            let caption = format!(
                "Limit cycle of {} at one instant along the contact edge: tractions (a), velocity (b), on a ground coloured by \
                 status.",
                motion.hertz()
            );
            let names = (name, caption, heading(motion));
            return open_contact_figure(names, &statuses, [&pressure, &shear], velocity);
        }
        let caption = format!(
            "Limit cycle of {} at one instant: status around the circle (a), tractions (b), velocity (c).",
            motion.hertz()
        );
        let first = self.record.angles.first().copied();
        let counterface = match self.solid {
            Some(sector) if sector.specification.contact.face() != SolidFace::Inner => "ring",
            _ => "cylinder *Ωa*",
        };
        contact_figure(
            ((name, caption, heading(motion)), counterface),
            (first.unwrap_or(0.0), &statuses),
            [&pressure, &shear],
            velocity,
        )
    }

    /// Speed of the counterface at the shown contact nodes, m/s: it grows with the radius.
    fn shown_speed(&self, motion: &MotionRecord) -> f64 {
        let Some(sector) = self.solid else {
            return motion.counterface_speed;
        };
        let radius = |ring: usize| sector.rings[ring].radius;
        let rings = sector.rings.len();
        motion.counterface_speed * radius(rings / 2) / radius(motion.node % rings)
    }

    /// What the node that moves most goes through in two periods, on a ground coloured by its status.
    fn history(&self, motion: &MotionRecord) -> Figure {
        let repeated = Repeated::new(motion);
        let metres = |name: &str| Axis::new(name, "m").prefixed();
        let displacement = |name: &str, values: &[f64], caption: &str| {
            let line = Line::through(repeated.curve(values)).solid(INK, 1.1);
            repeated.panel(metres(name), 62.0, caption).layer(line)
        };
        let line = |values: &[f64], colour, name: &str| {
            Line::through(repeated.curve(values)).solid(colour, 1.1).name(name)
        };
        let [u_n, u_t] = &motion.displacement;
        let [v_n, v_t] = &motion.velocity;

        // What a node that sticks moves with, and the limits of friction, where they are numbers.
        let counterface = (self.mesh.opposite.is_none())
            .then(|| Rule::horizontal(motion.counterface_speed).stretching().name("counterface"));
        let limit = |sign: f64| {
            let friction = sign * motion.friction_coefficient.unwrap_or(f64::NAN);
            let limit: Vec<f64> = motion.pressure.iter().map(|p| friction * p).collect();
            Line::through(repeated.curve(&limit)).stroke(Stroke::dashed(MUTED, 0.9))
        };
        let law = [limit(1.0).name("Coulomb limit ±*μp*"), limit(-1.0)];
        let law = law.into_iter();
        let law = law.filter(|_| motion.friction_coefficient.is_some());
        let caption = format!(
            "Contact node {} through two periods of the limit cycle of {}.",
            self.node_label(motion),
            motion.hertz()
        );
        let traction = Axis::new("traction", "Pa").prefixed();
        Figure::new(format!("history-{}", motion.tag()), caption)
            .shared_x()
            .panel(displacement("*u*_{t}", u_t, "displacement along the contact"))
            .panel(displacement("*u*_{n}", u_n, "normal displacement"))
            .panel(
                repeated
                    .panel(Axis::new("*v*", "m/s"), 78.0, "velocity")
                    .layers(counterface)
                    .layer(line(v_n, SERIES[2], "normal *v*_{n}"))
                    .layer(line(v_t, SERIES[0], "tangential *v*_{t}")),
            )
            .panel(
                repeated
                    .panel(traction, 90.0, "tractions")
                    .layers(law)
                    .layer(line(&motion.pressure, INK, "pressure *p*"))
                    .layer(line(&motion.shear, SERIES[1], "friction traction *τ*")),
            )
    }

    /// The closed curves of the node that moves most: velocity over displacement, along the contact and normal, and its path.
    fn orbit(&self, motion: &MotionRecord) -> Figure {
        let ([u_n, u_t], [v_n, v_t]) = (&motion.displacement, &motion.velocity);
        let statuses = motion.node_statuses();
        let status: Vec<ContactStatus> = statuses.iter().chain(statuses.first()).copied().collect();
        let loop_of = |caption: &str, x: (&str, &[f64]), y: (&str, &str, &[f64])| {
            let points = || x.1.iter().copied().zip(y.2.iter().copied());
            let closed: Vec<(f64, f64)> = points().chain(points().next()).collect();
            let axis = |name: &str, unit: &str| Axis::new(name, unit).prefixed();
            Panel::new(axis(x.0, "m"), axis(y.0, y.1))
                .height(128.0)
                .caption(caption)
                .layers(status_curves(&closed, &status))
                .layer(Line::through(closed).solid(INK, 0.0).arrows(3))
        };
        let caption = format!(
            "Phase plots, along the contact (a) and normal to it (b), and path (c) of contact node {} in the limit cycle of {}.",
            self.node_label(motion),
            motion.hertz()
        );
        let along = ("displacement *u*_{t}", &u_t[..]);
        let normal = ("displacement *u*_{n}", &u_n[..]);
        Figure::new(format!("orbit-{}", motion.tag()), caption)
            .columns(3)
            .panel(loop_of("along the contact", along, ("velocity *v*_{t}", "m/s", v_t)))
            .panel(loop_of("normal", normal, ("velocity *v*_{n}", "m/s", v_n)))
            .panel(loop_of("path", along, (normal.0, "m", normal.1)))
    }

    fn node_label(&self, motion: &MotionRecord) -> usize {
        let node = self.record.nodes.get(motion.node).copied().unwrap_or(0) as usize;
        match self.solid {
            Some(_) => node + 1,
            None => self.mesh.node_label(node),
        }
    }

    fn velocity(&self) -> Result<Figure, ChartError> {
        if self.is_assembly() {
            return self.velocity_of_bodies();
        }
        let frames = self.record.cycles.iter().take(FIELD_LIMIT);
        let frames = frames.map(|motion| -> FieldFrame {
            let velocity = &motion.velocity_field;
            match self.solid {
                // A ring of statuses shows one edge.
                Some(sector) => {
                    let speeds = speeds_on_top(sector, velocity);
                    (heading(motion), speeds, Vec::new())
                }
                None => {
                    let speeds = velocity.chunks_exact(2).map(|v| v[0].hypot(v[1])).collect();
                    (heading(motion), speeds, motion.first_statuses())
                }
            }
        });
        let caption =
            ("velocity", "Velocity modulus and contact status of the limit cycles at one instant.");
        let axis = Axis::new("velocity |*v*|", "m/s");
        let disc = Disc::new(self.mesh);
        field_figure(caption, &disc, &axis, ColourMap::Viridis, frames.collect())
    }

    fn shear_stress(&self) -> Result<Figure, ChartError> {
        if self.solid.is_some() || self.is_assembly() {
            return Err(ChartError::empty("shear stress of a plane body"));
        }
        let cycles = self.record.cycles.iter().take(FIELD_LIMIT);
        let fields = cycles.map(|motion| (heading(motion), &motion.displacement_field[..]));
        let caption = "Shear stress of the limit cycles at one instant.";
        shear_stress_figure(caption, &Disc::new(self.mesh), self.materials, fields)
    }
}

/// A few periods of the node that moves most.
struct Repeated {
    interval: f64,
    samples: usize,
    status: Vec<ContactStatus>,
}

impl Repeated {
    fn new(motion: &MotionRecord) -> Self {
        let count = motion.times.len();
        let samples = PERIODS * count + 1;
        let own = motion.node_statuses().into_iter().cycle().take(samples);
        Self {
            interval: 1.0 / (motion.frequency_hz * count as f64),
            samples,
            status: own.collect(),
        }
    }

    /// Values of one period again and again, over the time.
    fn curve(&self, values: &[f64]) -> Vec<(f64, f64)> {
        let values = values.iter().copied().cycle().take(self.samples);
        let timed = values.enumerate();
        timed.map(|(i, v)| (i as f64 * self.interval, v)).collect()
    }

    /// A panel over the time on a ground coloured by status; a sample stands for half an interval on either side.
    fn panel(&self, y: Axis, height: f64, caption: &str) -> Panel {
        let end = (self.samples - 1) as f64 * self.interval;
        let ground = status_ground(&self.status, |i| (i as f64 - 0.5) * self.interval);
        Panel::new(Axis::time().between(0.0, end), y)
            .plain()
            .height(height)
            .caption(caption)
            .layer(ground)
    }
}

/// Amplitudes of the harmonics in time.
fn harmonics(motion: &MotionRecord) -> Figure {
    let caption = format!(
        "Harmonics of the motion of the contact nodes in the limit cycle of {}: root mean square over the nodes.",
        motion.hertz()
    );
    let line = |values: &[f64], colour, name: &str| {
        let frequencies = (1..=values.len()).map(|k| k as f64 * motion.frequency_hz);
        Line::through(frequencies.zip(values.iter().copied()))
            .solid(colour, 0.8)
            .marked(Marker::Circle, 1.6)
            .name(name)
    };
    let [normal, along] = &motion.harmonics;
    let amplitude = Axis::new("amplitude", "m").logarithmic();
    let panel = Panel::new(Axis::kilohertz(), amplitude).height(110.0).layer(line(
        along,
        SERIES[0],
        "along the contact",
    ));
    // Rigid contact that stays closed leaves round-off along the normal.
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let panel = match largest(normal) > ROUND_OFF * largest(along) {
        true => panel.layer(line(normal, SERIES[2], "normal")),
        false => panel,
    };
    Figure::new(format!("harmonics-{}", motion.tag()), caption).panel(panel)
}

pub(super) fn heading(motion: &MotionRecord) -> String {
    format!("mode {}, {:.2} kHz", motion.mode, motion.frequency_hz * 1e-3)
}
