//! The figures of a transient, from its record.

use super::run::RecordedRun;
use crate::charts::palette::status_of_code;
use crate::charts::{
    ContactInstant, ContactVelocity, contact_figure, shear_stress_figure, status_curves,
    velocity_figure,
};
use crate::common::*;

/// Whole-field pictures of one kind, at most.
const FIELD_LIMIT: usize = 8;
/// When the fields are.
const WHEN: &str = "at the snapshot times";

/// Draws every figure that the record has data for.
pub fn draw_run(run: &RecordedRun<'_>) -> Vec<Figure> {
    let mut figures: Vec<Declaration<'_>> = Vec::new();
    for probe in 0..run.solved.record.probes.len() {
        figures.push(Box::new(move || Some(run.overview(probe))));
        figures.push(Box::new(move || Some(run.spectrum(probe))));
    }
    figures.push(Box::new(|| Some(run.growth())));
    figures.push(Box::new(|| Some(run.velocity())));
    figures.push(Box::new(|| run.shear_stress()));
    figures.push(Box::new(|| run.trajectories()));
    figures.push(Box::new(|| run.contact()));
    figures.push(Box::new(|| Some(super::energy::energy(run))));
    declared(figures)
}

impl RecordedRun<'_> {
    fn snapshots(&self) -> impl Iterator<Item = &Snapshot> {
        self.solved.record.snapshots.iter().take(FIELD_LIMIT)
    }

    fn velocity(&self) -> Figure {
        // What is that much slower than the cylinder is round-off of a body at rest.
        let rest = 1e-9 * self.peripheral_speed.abs();
        let fields = self.snapshots().map(|snapshot| {
            let status = statuses(&snapshot.contact.status);
            (heading(snapshot), &snapshot.velocity[..], status)
        });
        velocity_figure(&self.body, (WHEN, rest), fields)
    }

    fn shear_stress(&self) -> Option<Figure> {
        let fields = self.snapshots();
        let fields = fields.map(|snapshot| (heading(snapshot), &snapshot.displacement[..]));
        shear_stress_figure(&self.body, self.material, WHEN, fields)
    }

    /// Whether a probe lies on the contact edge.
    pub(super) fn is_on_contact(&self, probe: usize) -> bool {
        let node = self.solved.record.probes[probe] as u32 - 1;
        match self.body.sector {
            Some(_) => self.interface.nodes.contains(&node),
            None => self.body.mesh.contact_edge().nodes.contains(&node),
        }
    }

    /// Phase plot of an internal node, and path of a contact node coloured by status over the last fifth.
    fn trajectories(&self) -> Option<Figure> {
        let body = &self.body;
        let has_edge = body
            .sector
            .is_none_or(|sector| sector.specification.contact.face() == SolidFace::Inner);
        if body.is_assembly() || !has_edge {
            return None;
        }
        let probes = 0..self.solved.record.probes.len();
        let (edge, inside): (Vec<usize>, Vec<usize>) =
            probes.partition(|&probe| self.is_on_contact(probe));
        let (edge, inside) = (*edge.first()?, *inside.first()?);
        let pair = |probe: usize, x: usize, y: usize| -> Vec<(f64, f64)> {
            self.solved.record.probe_rows[probe].iter().map(|row| (row[x], row[y])).collect()
        };
        let (phase, path) = (pair(inside, 1, 3), pair(edge, 1, 0));
        let start = path.len() - path.len().div_ceil(5);
        let [normal, tangential, _] = self.directions();
        let metres = |[along, symbol]: [&str; 2]| {
            Axis::new(&format!("{along} *u*_{{{symbol}}}"), "m").prefixed()
        };
        let panel = |y: Axis, caption: String, points: &[(f64, f64)]| {
            let before = Line::through(points[..start].iter().copied()).solid("#d0d0d0", 0.3);
            Panel::new(metres(tangential), y)
                .height(172.0)
                .caption(caption)
                .layer(before.name("before"))
        };
        let end = match self.solved.analysis.settling.state {
            EndState::LimitCycle => "limit cycle",
            EndState::TwoFrequency(_) => "two frequencies",
            _ => "last fifth of the run",
        };
        let last = Line::through(phase[start..].iter().copied()).solid(SERIES[1], 0.8).name(end);
        let velocity = Axis::new(&format!("velocity *v*_{{{}}}", tangential[1]), "m/s").prefixed();
        let caption = format!("node {}, tangential", self.probe_label(inside));
        let phase_panel = panel(velocity, caption, &phase).layer(last);
        let caption = format!("contact node {}", self.probe_label(edge));
        let path_panel = panel(metres(normal), caption, &path)
            .layers(status_curves(&path[start..], &self.traced_status(edge, start)));
        let caption = "Phase plot of an internal node (a) and path of a contact node (b), whose \
        last fifth is coloured by contact status.";
        Some(Figure::new("trajectories", caption).columns(2).panel(phase_panel).panel(path_panel))
    }

    /// Status of a contact node from a sample on, from its motion: off the cylinder it is open, with the cylinder's
    /// velocity it sticks. Finer in time than the contact frames; the node touches the cylinder at its smallest radial
    /// displacement.
    fn traced_status(&self, probe: usize, start: usize) -> Vec<ContactStatus> {
        let rows = &self.solved.record.probe_rows[probe][start..];
        if self.body.mesh.opposite.is_some() {
            return self.kept_status(probe, start);
        }
        let (low, high) = extremes(rows.iter().map(|row| row[0]));
        let distance = 1e-6 * low.abs().max(high.abs());
        let slowness = 1e-6 * self.peripheral_speed.abs().max(f64::MIN_POSITIVE);
        let status = rows.iter().map(|row| {
            if row[0] - low > distance {
                ContactStatus::Open
            } else if (row[3] - self.peripheral_speed).abs() <= slowness {
                ContactStatus::Stick
            } else {
                ContactStatus::Slip
            }
        });
        status.collect()
    }

    /// Status of a contact node from a sample on, as the contact frames keep it: what it touches moves as well.
    fn kept_status(&self, probe: usize, start: usize) -> Vec<ContactStatus> {
        let node = self.solved.record.probes[probe] as u32 - 1;
        let place = self.interface.nodes.iter().position(|&other| other == node);
        let (frames, stride) =
            (&self.solved.record.frames, self.solved.record.frame_stride as usize);
        let samples = start..self.solved.record.rows.len();
        let status = samples.map(|sample| {
            let frame = frames.get(sample / stride).or(frames.last());
            match (frame, place) {
                (Some(frame), Some(place)) => status_of_code(frame.status[place]),
                _ => ContactStatus::Open,
            }
        });
        status.collect()
    }

    /// The contact at the last snapshot.
    fn contact(&self) -> Option<Figure> {
        let body = &self.body;
        let snapshot = self.solved.record.snapshots.last().filter(|_| !body.is_assembly())?;
        let frame = &snapshot.contact;
        let wide = |values: &[f32]| -> Vec<f64> {
            body.shown(values).into_iter().map(f64::from).collect()
        };
        let velocity = body.shown(&self.contact_velocity(snapshot));
        let shown = ContactInstant {
            name: "contact".to_owned(),
            subject: ["Contact at the last snapshot".to_owned(), String::new()],
            instant: format!("*t* = {:.3} ms", snapshot.time * 1e3),
            first_angle: self.solved.record.contact_angles.first().copied().unwrap_or(0.0),
            status: &statuses(&body.shown(&frame.status)),
            tractions: [&wide(&frame.pressure), &wide(frame.shear())],
            velocity: match body.mesh.opposite {
                Some(_) => ContactVelocity::Slip(&velocity),
                None => ContactVelocity::Absolute(&velocity, self.peripheral_speed),
            },
        };
        Some(contact_figure(body, &shown))
    }

    /// Tangential velocity of each contact node, m/s: before another body that of what it meets less its own, the slip.
    fn contact_velocity(&self, snapshot: &Snapshot) -> Vec<f64> {
        let components = self.body.dimension();
        let slip = |(i, &node): (usize, &u32)| {
            let velocity = snapshot.velocity[components * node as usize + 1];
            let Some(opposite) = self.interface.opposite.get(i) else { return velocity };
            let met = opposite.moves[1].iter();
            let met: f64 = met.map(|&(dof, share)| share * snapshot.velocity[dof]).sum();
            self.peripheral_speed + met - velocity
        };
        self.interface.nodes.iter().enumerate().map(slip).collect()
    }
}

fn statuses(codes: &[u8]) -> Vec<ContactStatus> {
    codes.iter().map(|&code| status_of_code(code)).collect()
}

fn heading(snapshot: &Snapshot) -> String {
    format!("*t* = {:.2} ms", snapshot.time * 1e3)
}
