//! The contact over time and around the circle.

use super::palette::{
    OPEN, SLIP, STICK, centred, line_colour, status_ground, status_keys, status_ring, status_runs,
};
use super::{Disc, solid::speeds_of_bodies};
use crate::common::*;
use frictionsim_chart::Palette;

/// Columns of a status map: three for each point of a wide panel.
const FINEST: usize = 900;
/// The status of all contact nodes over time between two instants, and the interval between the instants shown (s) if
/// not every sample is; `codes` are 0 open, 1 stick, 2 slip, sample by sample, all nodes of one sample together, evenly
/// spaced in time and around the circle.
///
/// Where there are more samples than the drawing has columns, every so many-th is shown: a pattern that travels by more
/// than half its length from one to the next seems to go another way.
pub fn status_map(
    times: &[f64],
    nodes: usize,
    codes: &[u8],
    (from, to): (f64, f64),
) -> Option<(Heat, Option<f64>)> {
    let count = times.len().min(codes.len() / nodes.max(1));
    let first = times[..count].partition_point(|&t| t < from).saturating_sub(1);
    let last = (times[..count].partition_point(|&t| t <= to) + 1).min(count);
    if nodes == 0 || last < first + 2 {
        return None;
    }
    let stride = (last - first).div_ceil(FINEST);
    let columns = (last - first).div_ceil(stride);
    let hop = (times[count - 1] - times[0]) / (count - 1) as f64;
    let start = times[first] - 0.5 * hop;
    let end = start + hop * (stride * columns) as f64;
    let half = 0.5 * TAU / nodes as f64;
    let palette = Palette::of_colours(&[OPEN, STICK, SLIP]);
    let status =
        |column: usize, node: usize| codes[(first + column * stride) * nodes + node].min(2);
    let heat =
        Heat::of_states(((start, end), columns), ((-half, TAU - half), nodes), palette, status);
    let heat = heat.names(status_keys());
    Some((heat, (stride > 1).then_some(hop * stride as f64)))
}

/// Where nodes stand along the contact: the angle around a whole hole, a share of any other edge.
pub fn place_axis(is_round: bool) -> Axis {
    match is_round {
        true => Axis::angle(),
        false => Axis::new("position along the contact", "%").times(100.0 / TAU).between(0.0, TAU),
    }
}

/// Tangential velocity of the nodes of a contact, m/s.
pub enum ContactVelocity<'a> {
    /// On a rigid counterface: their own, and the counterface's.
    Absolute(&'a [f64], f64),
    /// Between two bodies that both move: that of a node against what it meets, zero where it sticks.
    Slip(&'a [f64]),
}

/// The contact at one instant.
pub struct ContactInstant<'a> {
    /// Name of its figure.
    pub name: String,
    /// What it is of, and how its pattern turns.
    pub subject: [String; 2],
    /// When it is.
    pub instant: String,
    /// Angle of the first node around a hole, rad.
    pub first_angle: f64,
    /// Status of each node.
    pub status: &'a [ContactStatus],
    /// Pressure and friction traction, Pa.
    pub tractions: [&'a [f64]; 2],
    /// Tangential velocity.
    pub velocity: ContactVelocity<'a>,
}

/// The contact at one instant, its nodes evenly spaced, on a ground coloured by status: tractions (Pa) and tangential
/// velocity (m/s), and around a whole hole arcs of stick, slip and separation.
pub fn contact_figure(body: &ShownBody<'_>, own: &ContactInstant<'_>) -> Figure {
    let [subject, turning] = &own.subject;
    if body.mesh.has_round_contact() {
        let names = (body.counterface(), "tangential *v*_{θ}");
        let caption = format!(
            "{subject}: status around the circle (a), tractions (b), velocity (c){turning}."
        );
        return Figure::new(own.name.clone(), caption)
            .weighted(&[1.0, 1.7])
            .shared_x()
            .panel(circle(own))
            .panels(contact_panels(own, true, names));
    }
    let names = ("counterface", "tangential velocity");
    let [traction, velocity] = contact_panels(own, false, names);
    let caption = format!(
        "{subject} along the contact edge: tractions (a), velocity (b), on a ground coloured by status."
    );
    let traction = traction.caption(own.instant.clone());
    Figure::new(own.name.clone(), caption).shared_x().panel(traction).panel(velocity)
}

/// Tractions (Pa) and tangential velocity along a contact or around a whole hole; `names` are those of the counterface
/// and of an absolute velocity.
fn contact_panels(own: &ContactInstant<'_>, is_round: bool, names: (&str, &str)) -> [Panel; 2] {
    // Around a hole the first node comes again at the end.
    let first = if is_round { own.first_angle } else { 0.0 };
    let steps = own.status.len().saturating_sub(usize::from(!is_round));
    let step = TAU / steps.max(1) as f64;
    let line = |values: &[f64]| {
        let again = values.first().filter(|_| is_round);
        let places = values.iter().chain(again).enumerate();
        Line::through(places.map(|(i, &value)| (first + i as f64 * step, value)))
    };
    let again = own.status.first().filter(|_| is_round);
    let status: Vec<ContactStatus> = own.status.iter().chain(again).copied().collect();
    let panel = |y: Axis, is_first: bool| {
        let ground = status_ground(&status, |i| first + (i as f64 - 0.5) * step);
        // Around a hole the ring beside the panels has the names.
        let ground = if is_first && !is_round { ground } else { ground.unnamed() };
        Panel::new(place_axis(is_round), y).plain().height(78.0).legend().layer(ground)
    };
    let [pressure, shear] = own.tractions;
    // At the rule a node sticks.
    let (velocity, name, rule) = match own.velocity {
        ContactVelocity::Absolute(values, speed) => {
            (values, names.1, Rule::horizontal(speed).stretching().name(names.0))
        }
        ContactVelocity::Slip(values) => {
            (values, "slip velocity", Rule::horizontal(0.0).name("no slip"))
        }
    };
    let traction = Axis::new("traction", "Pa").prefixed().including(0.0).room(0.08);
    [
        panel(traction, true)
            .layer(line(pressure).solid(INK, 1.1).name("pressure *p*"))
            .layer(line(shear).solid(SERIES[1], 1.1).name("friction traction *τ*")),
        panel(Axis::new("velocity", "m/s").including(0.0), false)
            .layer(rule)
            .layer(line(velocity).solid(SERIES[0], 1.1).name(name)),
    ]
}

/// The hole with arcs of stick, slip and separation.
fn circle(own: &ContactInstant<'_>) -> Panel {
    let angles = [0, 90, 180, 270].map(|degrees: i32| {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        Label::new((0.48 * cos, 0.48 * sin), format!("{degrees}°"))
            .style(centred(6.75))
            .moved(0.0, 2.4)
    });
    Panel::plane([[-1.05, -1.05], [1.05, 1.05]])
        .beside(2)
        .caption(own.instant.clone())
        .layer(status_ring(1.06, own.first_angle, own.status))
        .layers(angles)
        .layer(Label::new((0.0, 0.0), "↺").style(centred(13.0)))
        .layer(Label::new((0.0, 0.0), "rotor").style(centred(6.75)).moved(0.0, 11.0))
}

/// One field of several: heading, values at the nodes, status of each node of the contact edge.
type FieldFrame = (String, Vec<f64>, Vec<ContactStatus>);

/// Shear stress of several displacement fields side by side, each with its heading, of a plane body; `when` they are.
pub fn shear_stress_figure<'a>(
    body: &ShownBody<'_>,
    material: &dyn MaterialField,
    when: &str,
    fields: impl Iterator<Item = (String, &'a [f64])>,
) -> Option<Figure> {
    if body.is_solid() {
        return None;
    }
    let disc = Disc::new(body.mesh);
    let caption = format!("Shear stress {when}.");
    let frame = |(heading, displacement): (String, &[f64])| -> FieldFrame {
        let stress = nodal_stress(body.mesh, material, displacement);
        let shear = stress.iter().map(|node| node.shear);
        (heading, shear.collect(), Vec::new())
    };
    let axis = Axis::new("shear stress *τ*_{rθ}", "MPa").times(1e-6);
    let (names, frames) = (("shear-stress", &caption[..]), fields.map(frame).collect());
    Some(field_figure(names, &disc, &axis, ColourMap::Diverging, frames))
}

/// Velocity fields (nodal frames, m/s) side by side, each with its heading and the status of the contact nodes; `when`
/// they are. What is no faster than `rest` is at rest.
pub fn velocity_figure<'a>(
    body: &ShownBody<'_>,
    (when, rest): (&str, f64),
    fields: impl Iterator<Item = (String, &'a [f64], Vec<ContactStatus>)>,
) -> Figure {
    if body.is_assembly() {
        let caption = format!("Velocity modulus {when}.");
        return speeds_of_bodies(body.mesh, &caption, fields.map(|own| (own.0, own.1)));
    }
    let frames = fields.map(|(heading, velocity, status)| -> FieldFrame {
        let (speeds, status) = match body.sector {
            // A ring of statuses shows one edge.
            Some(sector) => (speeds_on_top(sector, velocity), Vec::new()),
            None => (velocity.chunks_exact(2).map(|v| v[0].hypot(v[1])).collect(), status),
        };
        let moves = |speed: f64| if speed > rest { speed } else { 0.0 };
        (heading, speeds.into_iter().map(moves).collect(), status)
    });
    let caption = format!("Velocity modulus and contact status {when}.");
    let axis = Axis::new("velocity |*v*|", "m/s");
    let disc = Disc::new(body.mesh);
    field_figure(("velocity", &caption), &disc, &axis, ColourMap::Viridis, frames.collect())
}

/// Speed of the nodes of the top face of a body of revolution, m/s, in the order of the plane section: outwards first.
fn speeds_on_top(sector: &SolidSector, velocity: &[f64]) -> Vec<f64> {
    let mut top: Vec<usize> =
        (0..sector.node_count()).filter(|&k| sector.is_on(k, SolidFace::Top)).collect();
    top.sort_by_key(|&k| sector.nodes[k].place[0]);
    let sheets = velocity.chunks_exact(3 * sector.node_count());
    let speed =
        |sheet: &[f64], k: usize| sheet[3 * k].hypot(sheet[3 * k + 1]).hypot(sheet[3 * k + 2]);
    sheets.flat_map(|sheet| top.iter().map(move |&k| speed(sheet, k))).collect()
}

/// Fields side by side, each with its own scale of colours, as amplitudes may differ by decades, and with the contact
/// status around the hole where it is known.
fn field_figure(
    (name, caption): (&str, &str),
    disc: &Disc<'_>,
    axis: &Axis,
    map: ColourMap,
    frames: Vec<FieldFrame>,
) -> Figure {
    let count = frames.len();
    let (radius, first_angle) = disc.contact_place();
    // Beside an edge that is no whole hole there is no place for a ring.
    let has_place = disc.mesh.has_round_contact();
    let has_status = has_place && frames.iter().any(|frame| !frame.2.is_empty());
    let panels = frames.into_iter().map(|(heading, values, status)| {
        let panel = disc.panel(0.01).heading(heading).layer(disc.field(values, axis.clone(), map));
        let has_ring = has_place && !status.is_empty();
        let ring = has_ring.then(|| status_ring(radius, first_angle, &status));
        panel.layers(ring).colour_bar(Side::Below)
    });
    let columns = if matches!(count, 5 | 6) { 3 } else { count.clamp(1, 4) };
    let figure = Figure::new(name, caption).columns(columns).panels(panels);
    let figure = if count == 1 { figure.narrow() } else { figure };
    if has_status { figure.note("ring inside the hole: contact status") } else { figure }
}

/// A closed or open curve coloured by the status of the samples it starts from; slip, over which a node runs back and
/// forth, is wide.
pub fn status_curves(points: &[(f64, f64)], status: &[ContactStatus]) -> Vec<Line> {
    let statuses = [ContactStatus::Slip, ContactStatus::Stick, ContactStatus::Open];
    let line = |wanted: ContactStatus| {
        let mut pieces: Vec<(f64, f64)> = Vec::new();
        for (own, start, end) in status_runs(status) {
            // One sample further, so that pieces join; a gap keeps pieces apart.
            let end = (end + 1).min(points.len());
            if own == wanted && start < end {
                pieces.extend(&points[start..end]);
                pieces.push((f64::NAN, f64::NAN));
            }
        }
        let width = if wanted == ContactStatus::Slip { 1.8 } else { 0.8 };
        Line::through(pieces).solid(line_colour(wanted), width).name(wanted.name())
    };
    statuses.map(line).into()
}
