//! The figures of limit cycles and of their branches, from their record.

mod branches;
mod curve;
mod record;
mod report;

pub use branches::{NamedFamily, draw_branches};
pub use record::{BranchRecord, CycleRecord, FamilyRecord, TwoWaveRecord, WaveRecord};
pub use report::draw;

use super::charts::palette::{status_ground, status_of_code};
use super::charts::{
    ContactVelocity, Disc, FieldFrame, MovingBody, contact_figure, field_figure,
    shear_stress_figure, status_curves,
};
use super::drawing::{Declaration, DrawingOptions, draw_all};
use super::report::NamedFigure;
use crate::chart::{
    Axis, ChartError, ColourMap, Figure, INK, Line, MUTED, Motion, MotionKind, MotionState, Panel,
    Rule, SERIES, Stroke, plain,
};
use crate::contact::{ContactStatus, SlidingContact};
use crate::cycle::Family;
use crate::fem::ElasticMaterial;
use crate::mesh::Mesh;
use std::f64::consts::TAU;

/// Whole-field pictures of one kind, at most.
const FIELD_LIMIT: usize = 8;
/// Periods of a history.
const PERIODS: usize = 2;

/// Limit cycles and what their figures show besides.
#[derive(Clone, Copy, Debug)]
pub struct CycleFigures<'a> {
    /// The record.
    pub record: &'a CycleRecord,
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The material, for the stress fields.
    pub material: &'a ElasticMaterial,
    /// The contact at the case's own operating point.
    pub contact: SlidingContact,
    /// Radius of the contact edge, m.
    pub inner_radius: f64,
}

/// Draws the cycles at the case's own operating point: contact around the circle, history and closed curves of a contact
/// node for each family, then the fields of all.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_cycles(
    data: &CycleFigures<'_>,
    options: &DrawingOptions,
) -> Result<Vec<NamedFigure>, ChartError> {
    let mut figures: Vec<Declaration<'_>> = Vec::new();
    for (family, wave) in data.cycles() {
        figures.push(Box::new(move || Ok(data.contact(family, wave))));
        figures.push(Box::new(move || Ok(data.history(family, wave))));
        figures.push(Box::new(move || Ok(data.orbit(family, wave))));
    }
    figures.push(Box::new(|| data.velocity()));
    figures.push(Box::new(|| data.shear_stress()));
    draw_all(figures, options)
}

impl CycleFigures<'_> {
    fn peripheral_speed(&self) -> f64 {
        self.contact.rotation_speed * self.inner_radius
    }

    /// Families that have a cycle.
    fn cycles(&self) -> impl Iterator<Item = (Family, &WaveRecord)> {
        let families = self.record.families.iter();
        families.filter_map(|family| Some((family.family(), family.cycle.as_ref()?)))
    }

    /// The wave at time zero around the whole circle: a node at angle `theta` is in phase `n theta`.
    fn contact(&self, family: Family, wave: &WaveRecord) -> Figure {
        let n = family.harmonic;
        let count = n * wave.status.len();
        let around =
            |values: &[f64]| -> Vec<f64> { values.iter().copied().cycle().take(count).collect() };
        let status: Vec<ContactStatus> = wave.statuses().into_iter().cycle().take(count).collect();
        let caption = format!(
            "Limit cycle of {n} nodal diameters at one instant: status around the circle (a), tractions (b), velocity (c); the \
             pattern turns against the rotor at 1/{n} of the frequency."
        );
        let names =
            (format!("contact-{}", family.tag()), caption, format!("{}, wave ↻", heading(n, wave)));
        let tractions = [&around(&wave.pressure)[..], &around(&wave.shear)];
        let velocity = around(&wave.velocity[1]);
        let velocity = ContactVelocity::Absolute(&velocity, self.peripheral_speed());
        contact_figure((names, "cylinder *Ωa*"), (0.0, &status), tractions, velocity)
    }

    /// What a contact node goes through in two periods, on a ground coloured by its status.
    fn history(&self, family: Family, wave: &WaveRecord) -> Figure {
        let count = wave.status.len();
        let interval = 1.0 / (wave.frequency_hz * count.max(1) as f64);
        let samples = PERIODS * count + 1;
        let all = |values: &[f64]| -> Vec<(f64, f64)> {
            let values = values.iter().copied().cycle().take(samples).enumerate();
            values.map(|(i, value)| (i as f64 * interval, value)).collect()
        };
        let status: Vec<ContactStatus> =
            wave.statuses().into_iter().cycle().take(samples).collect();
        // A sample stands for half an interval on either side.
        let ground = || status_ground(&status, |i| (i as f64 - 0.5) * interval);
        let end = (samples - 1) as f64 * interval;
        let over_time = |y: Axis, height: f64, caption: &str| {
            Panel::new(Axis::time().between(0.0, end), y)
                .plain()
                .height(height)
                .caption(caption)
                .layer(ground())
        };
        let limit = |sign: f64| {
            let friction = sign * self.contact.friction_coefficient;
            let limit: Vec<f64> = wave.pressure.iter().map(|p| friction * p).collect();
            Line::through(all(&limit))
                .stroke(Stroke::dashed(MUTED, 0.9))
                .name("Coulomb limit ±*μp*")
        };
        let metres = |name: &str| Axis::new(name, "m").prefixed();
        let caption = format!(
            "A contact node through two periods of the limit cycle of {} nodal diameters.",
            family.harmonic
        );
        Figure::new(format!("history-{}", family.tag()), caption)
            .shared_x()
            .panel(
                over_time(metres("*u*_{θ}"), 62.0, "tangential displacement")
                    .layer(Line::through(all(&wave.displacement[1])).solid(INK, 1.1)),
            )
            .panel(
                over_time(metres("*u*_{r}"), 62.0, "radial displacement")
                    .layer(Line::through(all(&wave.displacement[0])).solid(INK, 1.1)),
            )
            .panel(
                over_time(Axis::new("*v*", "m/s"), 78.0, "velocity")
                    .layer(
                        Rule::horizontal(self.peripheral_speed())
                            .stretching()
                            .name("cylinder *Ωa*"),
                    )
                    .layer(
                        Line::through(all(&wave.velocity[0]))
                            .solid(SERIES[2], 1.1)
                            .name("radial *v*_{r}"),
                    )
                    .layer(
                        Line::through(all(&wave.velocity[1]))
                            .solid(SERIES[0], 1.1)
                            .name("tangential *v*_{θ}"),
                    ),
            )
            .panel(
                over_time(Axis::new("traction", "Pa").prefixed(), 90.0, "tractions")
                    .layer(limit(1.0))
                    .layer(limit(-1.0))
                    .layer(Line::through(all(&wave.pressure)).solid(INK, 1.1).name("pressure *p*"))
                    .layer(
                        Line::through(all(&wave.shear))
                            .solid(SERIES[1], 1.1)
                            .name("friction traction *τ*"),
                    ),
            )
    }

    /// The closed curves of a contact node: velocity over displacement, tangential and radial, and its path.
    fn orbit(&self, family: Family, wave: &WaveRecord) -> Figure {
        let ([u_r, u_t], [v_r, v_t]) = (&wave.displacement, &wave.velocity);
        let statuses = wave.statuses();
        let status: Vec<ContactStatus> = statuses.iter().chain(statuses.first()).copied().collect();
        let loop_of = |caption: &str, x: (&str, &[f64]), y: (&str, &str, &[f64])| {
            let points = || x.1.iter().copied().zip(y.2.iter().copied());
            let closed: Vec<(f64, f64)> = points().chain(points().next()).collect();
            Panel::new(Axis::new(x.0, "m").prefixed(), Axis::new(y.0, y.1).prefixed())
                .height(128.0)
                .caption(caption)
                .layers(status_curves(&closed, &status))
                .layer(Line::through(closed).solid(INK, 0.0).arrows(3))
        };
        let caption = format!(
            "Phase plots, tangential (a) and radial (b), and path (c) of a contact node in the limit cycle of {} nodal diameters.",
            family.harmonic
        );
        let cylinder = Rule::horizontal(self.peripheral_speed()).stretching().name("cylinder *Ωa*");
        Figure::new(format!("orbit-{}", family.tag()), caption)
            .columns(3)
            .panel(
                loop_of(
                    "tangential",
                    ("displacement *u*_{θ}", u_t),
                    ("velocity *v*_{θ}", "m/s", v_t),
                )
                .layer(cylinder),
            )
            .panel(loop_of(
                "radial",
                ("displacement *u*_{r}", u_r),
                ("velocity *v*_{r}", "m/s", v_r),
            ))
            .panel(loop_of(
                "path",
                ("displacement *u*_{θ}", u_t),
                ("displacement *u*_{r}", "m", u_r),
            ))
    }

    /// Contact status at time zero of every node of the edge: that of the nearest phase.
    fn around(&self, harmonic: usize, wave: &WaveRecord) -> Vec<u8> {
        let nodes = self.mesh.contact_edge().nodes.len();
        let points = wave.status.len().max(1);
        let nearest = |node: usize| (2 * harmonic * node * points + nodes) / (2 * nodes) % points;
        let codes = (0..nodes).filter_map(|node| wave.status.get(nearest(node)));
        codes.copied().collect()
    }

    /// The waves in motion, without the steady state that they ride on.
    fn motion(&self) -> Motion {
        let body = MovingBody::new(self.mesh);
        let sense = -self.contact.rotation_speed.signum();
        let states = self.cycles().take(FIELD_LIMIT).map(|(family, wave)| MotionState {
            name: plain(&heading(family.harmonic, wave)),
            frequency_hz: wave.frequency_hz,
            kind: MotionKind::Turning {
                displacement: body.wave(&wave.displacement_field),
                turn: sense * TAU / family.harmonic as f64,
                status: self.around(family.harmonic, wave),
            },
        });
        Motion { states: states.collect(), ..body.at_rest() }
    }

    fn velocity(&self) -> Result<Figure, ChartError> {
        let frames = self.cycles().take(FIELD_LIMIT).map(|(family, wave)| -> FieldFrame {
            let n = family.harmonic;
            let codes = self.around(n, wave);
            let status = codes.into_iter().map(status_of_code).collect();
            let speeds = wave.velocity_field.chunks_exact(2).map(|v| v[0].hypot(v[1]));
            (heading(n, wave), speeds.collect(), status)
        });
        let caption =
            ("velocity", "Velocity modulus and contact status of the waves at one instant.");
        let axis = Axis::new("velocity |*v*|", "m/s");
        field_figure(caption, &Disc::new(self.mesh), &axis, ColourMap::Viridis, frames.collect())
            .map(|figure| figure.motion(self.motion()))
    }

    fn shear_stress(&self) -> Result<Figure, ChartError> {
        let waves = self.cycles().take(FIELD_LIMIT);
        let fields = waves.map(|(family, wave)| {
            let heading = heading(family.harmonic, wave);
            (heading, &wave.displacement_field[..])
        });
        let caption = "Shear stress of the waves at one instant.";
        shear_stress_figure(caption, &Disc::new(self.mesh), self.material, fields)
    }
}

fn heading(n: usize, wave: &WaveRecord) -> String {
    format!("*n* = {n}, {:.2} kHz", wave.frequency_hz * 1e-3)
}
