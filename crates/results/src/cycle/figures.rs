//! The figures of limit cycles, from their motions.

use super::branches::draw_branches;
use super::summary::{CycleSummary, SoughtCycle};
use crate::charts::palette::status_ground;
use crate::charts::{
    ContactInstant, ContactVelocity, contact_figure, contact_surfaces, place_axis,
    shear_stress_figure, status_curves, status_map, velocity_figure,
};
use crate::common::*;

/// Whole-field pictures of one kind, at most.
const FIELD_LIMIT: usize = 8;
/// When the fields are.
const WHEN: &str = "of the limit cycles at one instant";
/// Periods of a history.
const PERIODS: usize = 2;
/// Amplitude along the normal, over that along the contact, below which it is round-off.
const ROUND_OFF: f64 = 1e-9;

/// A quantity of a contact node at one instant.
type Of = fn(&PhasePoint) -> f64;

/// Limit cycles and what their figures show besides.
struct CycleFigures<'a> {
    /// What was found.
    found: &'a CycleSummary,
    /// The body that moves.
    body: &'a ShownBody<'a>,
    /// What is shown of each cycle.
    cycles: Vec<&'a SoughtCycle>,
    /// The contacts of an assembly, each with the boundary that has its points.
    surfaces: Vec<(String, usize)>,
    /// The materials, for the stress fields.
    materials: &'a dyn MaterialField,
}

impl CycleSummary {
    /// Every figure of the cycles: contact over the period and at one instant, history, closed curves and harmonics of
    /// each, the fields of all, then their branches. `surfaces` are the contacts of an assembly, each with the boundary
    /// that has its points, `materials` those of the stress fields.
    pub fn figures(
        &self,
        body: &ShownBody<'_>,
        surfaces: Vec<(String, usize)>,
        materials: &dyn MaterialField,
    ) -> Vec<Figure> {
        let cycles = self.cycles.iter().filter(|own| !own.motion.frames.is_empty()).collect();
        let shown = &CycleFigures { found: self, body, cycles, surfaces, materials };
        let mut figures: Vec<Declaration<'_>> = Vec::new();
        for &own in &shown.cycles {
            figures.push(Box::new(move || shown.status(own)));
            figures.push(Box::new(move || Some(shown.at_one_instant(own))));
            figures.push(Box::new(move || Some(shown.history(own))));
            figures.push(Box::new(move || Some(shown.orbit(own))));
            figures.push(Box::new(move || Some(harmonics(own))));
        }
        figures.push(Box::new(|| Some(shown.velocity())));
        figures.push(Box::new(|| shown.shear_stress()));
        let families = self.families().into_iter().map(|own| (String::new(), own));
        let branches = draw_branches(&families.collect::<Vec<_>>(), &self.two_waves);
        declared(figures).into_iter().chain(branches).collect()
    }
}

impl CycleFigures<'_> {
    /// Nodes of the contact of motions of the whole mesh, counted from 0.
    fn nodes(&self) -> &[u32] {
        self.found.interface().map_or(&[], |interface| &interface.nodes)
    }

    /// Where the shown contact nodes are.
    fn places(&self) -> Axis {
        let in_order = Axis::new("contact nodes in their order", "%").times(100.0 / TAU);
        let round = || place_axis(self.body.mesh.has_round_contact());
        if self.body.is_assembly() { in_order.between(0.0, TAU) } else { round() }
    }

    /// The status of all contact nodes over one period; that of a wave is its history.
    fn status(&self, own: &SoughtCycle) -> Option<Figure> {
        if own.is_wave() {
            return None;
        }
        let times: Vec<f64> = own.history().iter().map(|row| row.time).collect();
        let statuses = own.motion.instants.iter().flat_map(|at| self.body.shown(at));
        let codes: Vec<u8> = statuses.map(|own| own.status as u8).collect();
        let range = (times[0], times[times.len() - 1]);
        let map = status_map(&times, codes.len() / times.len(), &codes, range);
        let caption = format!(
            "Contact status of every contact node over one period of the limit cycle of {}.",
            own.whose()
        );
        let panel = Panel::new(Axis::time(), self.places()).plain().height(120.0);
        let panel = panel.layers(map.map(|own| own.0)).legend();
        Some(Figure::new(format!("status-{}", own.name.tag()), caption).panel(panel))
    }

    /// The contact at time zero; of a wave around the whole circle, where a node at angle `theta` is in phase `n
    /// theta`.
    fn at_one_instant(&self, own: &SoughtCycle) -> Figure {
        let body = self.body;
        if body.is_assembly() {
            return self.on_surfaces(own);
        }
        let n = own.diameters().max(1);
        let edge = body.shown(&own.edge().repeat(n));
        let all = |of: fn(&PhasePoint) -> f64| -> Vec<f64> { edge.iter().map(of).collect() };
        let speed = if body.mesh.opposite.is_some() { f64::NAN } else { self.shown_speed(own) };
        let turns = format!("; the pattern turns against the rotor at 1/{n} of the frequency");
        let (turns, wave) = if own.is_wave() { (turns, ", wave ↻") } else { (String::new(), "") };
        let angles = self.found.interface().map_or(&[][..], |interface| &interface.angles);
        let shown = ContactInstant {
            name: format!("contact-{}", own.name.tag()),
            subject: [format!("Limit cycle of {} at one instant", own.whose()), turns],
            instant: own.heading() + wave,
            first_angle: angles.first().copied().unwrap_or(0.0),
            status: &edge.iter().map(|point| point.status).collect::<Vec<_>>(),
            tractions: [&all(|point| point.pressure), &all(|point| point.shear)],
            velocity: ContactVelocity::Absolute(&all(|point| point.velocity[1]), speed),
        };
        contact_figure(body, &shown)
    }

    /// Pressure on each contact surface at time zero, seen from outside along its mean normal; grey where it is open.
    fn on_surfaces(&self, own: &SoughtCycle) -> Figure {
        let mut values = vec![f64::NAN; self.body.mesh.node_count()];
        let closed = self.nodes().iter().zip(own.edge());
        for (&node, point) in closed.filter(|own| own.1.status != ContactStatus::Open) {
            values[node as usize] = point.pressure;
        }
        let caption = format!(
            "Limit cycle of {} at one instant: contact pressure on each contact surface, seen from \
            outside; grey where it is open.",
            own.whose()
        );
        let name = format!("contact-{}", own.name.tag());
        let surfaces = (self.body.mesh, &self.surfaces[..]);
        contact_surfaces((&name, &caption), surfaces, ("contact pressure", &values, &[]))
    }

    /// Speed of the counterface at the shown contact nodes, m/s: it grows with the radius.
    fn shown_speed(&self, own: &SoughtCycle) -> f64 {
        let motion = &own.motion;
        let Some(sector) = self.body.sector else { return motion.counterface_speed };
        let radius = |ring: usize| sector.rings[ring].radius;
        let rings = sector.rings.len();
        motion.counterface_speed * radius(rings / 2) / radius(motion.node % rings)
    }

    /// The contact node of the history in words.
    fn node(&self, own: &SoughtCycle) -> String {
        let node = self.nodes().get(own.motion.node);
        let label = node.map(|&node| self.body.mesh.node_label(node as usize));
        label.map_or_else(|| "a contact node".to_owned(), |label| format!("contact node {label}"))
    }

    /// What the node goes through in two periods, on a ground coloured by its status.
    fn history(&self, own: &SoughtCycle) -> Figure {
        let (motion, period) = (&own.motion, own.history());
        let interval = 1.0 / (motion.frequency_hz * period.len() as f64);
        let count = PERIODS * period.len() + 1;
        let rows: Vec<PhasePoint> = period.into_iter().cycle().take(count).collect();
        let status: Vec<ContactStatus> = rows.iter().map(|row| row.status).collect();
        let panel = |y: Axis, height: f64, caption: &str| {
            let time = Axis::time().between(0.0, (count - 1) as f64 * interval);
            // A sample stands for half an interval on either side.
            let ground = status_ground(&status, |i| (i as f64 - 0.5) * interval);
            Panel::new(time, y).plain().height(height).caption(caption).layer(ground)
        };
        let curve = |of: &dyn Fn(&PhasePoint) -> f64| {
            let timed = rows.iter().enumerate();
            Line::through(timed.map(|(i, row)| (i as f64 * interval, of(row))))
        };
        let line = |of: Of, colour| curve(&of).solid(colour, 1.1);
        let [normal, along] = directions(own);
        let displacement = |direction: &str, of: Of, caption: &str| {
            let metres = Axis::new(&format!("*u*_{{{direction}}}"), "m").prefixed();
            panel(metres, 62.0, caption).layer(line(of, INK))
        };
        // What a node that sticks moves with, and the limits of friction, where they are numbers.
        let counterface = (self.body.mesh.opposite.is_none())
            .then(|| Rule::horizontal(motion.counterface_speed).stretching().name("counterface"));
        let limit = |sign: f64| {
            let friction = sign * motion.friction_coefficient.unwrap_or(f64::NAN);
            curve(&|row| friction * row.pressure).stroke(Stroke::dashed(MUTED, 0.9))
        };
        let law = [limit(1.0).name("Coulomb limit ±*μp*"), limit(-1.0)].into_iter();
        let law = law.filter(|_| motion.friction_coefficient.is_some());
        let velocity = panel(Axis::new("*v*", "m/s"), 78.0, "velocity")
            .layers(counterface)
            .layer(line(|row| row.velocity[0], SERIES[2]).name(format!("normal *v*_{{{normal}}}")))
            .layer(
                line(|row| row.velocity[1], SERIES[0]).name(format!("tangential *v*_{{{along}}}")),
            );
        let tractions = panel(Axis::new("traction", "Pa").prefixed(), 90.0, "tractions")
            .layers(law)
            .layer(line(|row| row.pressure, INK).name("pressure *p*"))
            .layer(line(|row| row.shear, SERIES[1]).name("friction traction *τ*"));
        let caption =
            format!("Two periods of {} in the limit cycle of {}.", self.node(own), own.whose());
        Figure::new(format!("history-{}", own.name.tag()), caption)
            .shared_x()
            .panel(displacement(along, |row| row.displacement[1], "displacement along the contact"))
            .panel(displacement(normal, |row| row.displacement[0], "normal displacement"))
            .panel(velocity)
            .panel(tractions)
    }

    /// The closed curves of the node: velocity over displacement along the contact, normal to it and its path too.
    fn orbit(&self, own: &SoughtCycle) -> Figure {
        let period = own.history();
        let closed = || period.iter().chain(period.first());
        let status: Vec<ContactStatus> = closed().map(|row| row.status).collect();
        let loop_of = |caption: &str, x: (String, Of), y: (String, &str, Of)| {
            let points: Vec<(f64, f64)> = closed().map(|row| (x.1(row), y.2(row))).collect();
            Panel::new(Axis::new(&x.0, "m").prefixed(), Axis::new(&y.0, y.1).prefixed())
                .height(128.0)
                .caption(caption)
                .layers(status_curves(&points, &status))
                .layer(Line::through(points).solid(INK, 0.0).arrows(3))
        };
        let [normal, along] = directions(own);
        let moved = |way: &str| format!("displacement *u*_{{{way}}}");
        let speed = |way: &str| format!("velocity *v*_{{{way}}}");
        let (u_n, u_t): (Of, Of) = (|row| row.displacement[0], |row| row.displacement[1]);
        let (v_n, v_t): (Of, Of) = (|row| row.velocity[0], |row| row.velocity[1]);
        let range = |of: Of| extremes(period.iter().map(of));
        let [reach_n, reach_t] = [range(u_n), range(u_t)].map(|(low, high)| high - low);
        let moves_normal = reach_n > ROUND_OFF * reach_t;
        let (count, what) = match moves_normal {
            true => (3, "Phase plots, along the contact (a) and normal to it (b), and path (c)"),
            false => (1, "Phase plot along the contact"),
        };
        let caption =
            format!("{what} of {} in the limit cycle of {}.", self.node(own), own.whose());
        let panels = [
            loop_of("along the contact", (moved(along), u_t), (speed(along), "m/s", v_t)),
            loop_of("normal", (moved(normal), u_n), (speed(normal), "m/s", v_n)),
            loop_of("path", (moved(along), u_t), (moved(normal), "m", u_n)),
        ];
        let figure = Figure::new(format!("orbit-{}", own.name.tag()), caption).columns(count);
        let figure = if moves_normal { figure } else { figure.narrow() };
        figure.panels(panels.into_iter().take(count))
    }

    /// Contact status at time zero of every node of the edge; of a wave that of the nearest phase.
    fn around(&self, own: &SoughtCycle) -> Vec<ContactStatus> {
        let (nodes, edge) = (self.body.mesh.contact_edge().nodes.len(), own.edge());
        let points = edge.len().max(1);
        let nearest =
            |node: usize| (2 * own.diameters() * node * points + nodes) / (2 * nodes) % points;
        let shown = |point: &PhasePoint| point.status;
        match own.diameters() {
            0 => edge.iter().map(shown).collect(),
            _ => (0..nodes).filter_map(|node| edge.get(nearest(node)).map(shown)).collect(),
        }
    }

    fn shown_cycles(&self) -> impl Iterator<Item = &SoughtCycle> {
        self.cycles.iter().copied().take(FIELD_LIMIT)
    }

    /// The waves in motion, without the steady state that they ride on.
    fn turning(&self) -> Motion {
        let body = MovingBody::new(self.body.mesh);
        let states = self.shown_cycles().map(|own| MotionState {
            name: plain(&own.heading()),
            frequency_hz: own.motion.frequency_hz,
            kind: MotionKind::Turning {
                displacement: body.wave(&own.motion.frames[0].fields[0]),
                turn: -own.motion.counterface_speed.signum() * TAU / own.diameters() as f64,
                status: self.around(own).into_iter().map(|status| status as u8).collect(),
            },
        });
        Motion { states: states.collect(), ..body.at_rest.clone() }
    }

    fn velocity(&self) -> Figure {
        let cycles = self.shown_cycles();
        let fields = cycles
            .map(|own| (own.heading(), &own.motion.frames[0].fields[1][..], self.around(own)));
        let figure = velocity_figure(self.body, (WHEN, 0.0), fields);
        let is_wave = self.cycles.iter().any(|own| own.is_wave());
        if is_wave { figure.motion(self.turning()) } else { figure }
    }

    fn shear_stress(&self) -> Option<Figure> {
        let cycles = self.shown_cycles();
        let fields = cycles.map(|own| (own.heading(), &own.motion.frames[0].fields[0][..]));
        shear_stress_figure(self.body, self.materials, WHEN, fields)
    }
}

/// Names of the directions normal to the contact and along it: radius and angle of the disc of a wave.
fn directions(own: &SoughtCycle) -> [&'static str; 2] {
    if own.is_wave() { ["r", "θ"] } else { ["n", "t"] }
}

/// Amplitudes of the harmonics in time of a motion of the whole mesh.
fn harmonics(own: &SoughtCycle) -> Figure {
    let motion = &own.motion;
    let amplitudes = |c: usize| motion.harmonics.iter().map(|own| own.amplitude[c]).collect();
    let [normal, along]: [Vec<f64>; 2] = [0, 1].map(amplitudes);
    let caption = format!(
        "Harmonics of the motion of the contact nodes in the limit cycle of {}: root mean square over the nodes.",
        own.whose()
    );
    let line = |values: &[f64], colour, name: &str| {
        let frequencies = (1..=values.len()).map(|k| k as f64 * motion.frequency_hz);
        Line::through(frequencies.zip(values.iter().copied()))
            .solid(colour, 0.8)
            .marked(Marker::Circle, 1.6)
            .name(name)
    };
    let amplitude = Axis::new("amplitude", "m").logarithmic();
    let panel = Panel::new(Axis::kilohertz(), amplitude).height(110.0);
    let panel = panel.layer(line(&along, SERIES[0], "along the contact"));
    // Rigid contact that stays closed leaves round-off along the normal.
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let has_normal = largest(&normal) > ROUND_OFF * largest(&along);
    let normal = has_normal.then(|| line(&normal, SERIES[2], "normal"));
    Figure::new(format!("harmonics-{}", own.name.tag()), caption).panel(panel.layers(normal))
}
