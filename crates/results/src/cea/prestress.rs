//! The figures of the base state.

use super::CeaReport;
use super::base::{BaseField, ContactState, closed_share};
use super::shape::{Picture, size};
use crate::common::*;
use crate::{BodyStress, charts::contact_surfaces};

/// Half the length of the arrow of the sliding over the size of its surface.
const ARROW: f64 = 0.15;

/// Contact pressure and friction traction around a plane edge, and the von Mises stress field.
pub(super) fn plane(mesh: &Mesh, field: &BaseField) -> Option<Figure> {
    let BodyStress::Plane(stress) = &field.stress else { return None };
    let disc = Disc::new(mesh);
    let von_mises = stress.iter().map(NodalStress::von_mises).collect();
    let stress = Axis::new("von Mises stress", "Pa").prefixed();
    let is_closed = mesh.contact_edge().is_closed;
    let places = field.along_contact(mesh);
    let place = match mesh.counterface {
        // The angles of a straight edge stand for shares of its length.
        Counterface::Plane { .. } => {
            Axis::new("position along the contact", "%").times(100.0 / TAU)
        }
        Counterface::Cylinder { .. } if is_closed => Axis::angle(),
        // A pad is looked at from end to end.
        Counterface::Cylinder { .. } => Axis::degrees(),
    };
    let around = |value: fn(&ContactState) -> f64| {
        let points = places.iter().map(|&(i, angle)| (angle, value(&field.contact[i])));
        Line::through(wrapped(points.collect(), is_closed))
    };
    let caption = "Steady sliding: von Mises stress (a), contact pressure (b) and friction traction (c) around the \
        contact edge. Positive traction acts counter-clockwise around a shaft and against the direction of a plane.";
    let stressed = disc.panel(0.01).layer(disc.field(von_mises, stress, ColourMap::Viridis));
    Some(with_tractions(caption, stressed, (place, 86.0), around).shared_x())
}

/// A picture of the state, and pressure and traction along the contact beside it, over an axis and so high.
fn with_tractions(
    caption: &str,
    state: Panel,
    (place, height): (Axis, f64),
    along: impl Fn(fn(&ContactState) -> f64) -> Line,
) -> Figure {
    let panel = |name: &str, line: Line, colour: &str| {
        let axis = Axis::new(name, "Pa").prefixed().including(0.0).room(0.15);
        Panel::new(place.clone(), axis).height(height).layer(line.solid(colour, 1.2))
    };
    Figure::new("prestress", caption)
        .weighted(&[1.0, 1.15])
        .panel(state.height(190.0).beside(2).colour_bar(Side::Right))
        .panel(panel("pressure *p*", along(|own| own.pressure), SERIES[0]))
        .panel(panel("traction *τ*", along(|own| own.shear), SERIES[1]))
}

/// Points over rising angles; around a whole circle the first and the last are repeated a turn away, so that the curve
/// reaches both ends of its axis.
fn wrapped(points: Vec<(f64, f64)>, is_closed: bool) -> Vec<(f64, f64)> {
    let turned = |point: Option<&(f64, f64)>, by: f64| {
        point.filter(|_| is_closed).map(|&(angle, value)| (angle + by, value))
    };
    let (before, after) = (turned(points.last(), -TAU), turned(points.first(), TAU));
    before.into_iter().chain(points).chain(after).collect()
}

/// Pressure and traction along the contact of a body of revolution, and the section as the rotor deforms it.
pub(super) fn revolution(sector: &SolidSector, field: &BaseField) -> Figure {
    let is_cylinder = sector.specification.contact.face() == SolidFace::Inner;
    let (name, coordinate) = if is_cylinder { ("height *z*", 2) } else { ("radius *r*", 0) };
    let along = |value: fn(&ContactState) -> f64| {
        let points = field.contact.iter().map(|own| (own.place.position[coordinate], value(own)));
        Line::through(points).marked(Marker::Disc, 1.4)
    };
    let shape: Vec<c64> = field.displacement.iter().map(|&v| c64::new(v, 0.0)).collect();
    let largest = shape.chunks_exact(3).map(size).fold(0.0, f64::max);
    let axis = Axis::new("displacement |*u*|", "m").prefixed().between(0.0, largest);
    let caption = "Steady sliding: the body from above and its section through the axis, deformed and \
        coloured by displacement (a). Contact pressure (b) and friction traction (c) along the contact.";
    let place = Axis::new(name, "mm").times(1e3);
    with_tractions(caption, Picture::new(sector).panel(&shape, axis), (place, 100.0), along)
}

/// A traction on each contact surface of solid bodies, seen from outside along its mean normal, with the sliding over
/// it; grey where it is open.
pub(super) fn surfaces(
    report: &CeaReport<'_>,
    field: &BaseField,
    (name, what): (&str, &str),
    value: fn(&ContactState) -> f64,
) -> Option<Figure> {
    if report.base.is_without_pressure() {
        return None;
    }
    let mesh = report.body.mesh;
    let [tractions, closed] =
        [value, closed_share].map(|value| field.around_nodes(mesh.node_count(), value));
    let nodes = tractions.iter().zip(&closed);
    let values: Vec<f64> =
        nodes.map(|(&traction, &closed)| if closed > 0.0 { traction } else { f64::NAN }).collect();
    let caption = format!(
        "Base state: {what} on each contact surface, seen from outside; grey where it is open. The other surface \
        slides over it along the arrow."
    );
    let arrows = field.surfaces.iter().map(|(contact, _)| arrow(field, contact));
    let arrows: Vec<[[f64; 3]; 2]> = arrows.collect();
    let surfaces = (mesh, &field.surfaces[..]);
    Some(contact_surfaces((name, &caption), surfaces, (what, &values, &arrows)))
}

/// Ends of an arrow in the middle of a contact along the mean sliding of the other surface over it.
fn arrow(field: &BaseField, contact: &str) -> [[f64; 3]; 2] {
    let (mut area, mut middle, mut along) = (0.0, Vector3::zeros(), Vector3::zeros());
    let places = field.contact.iter().map(|own| &own.place);
    for place in places.filter(|place| place.contact == contact) {
        area += place.area;
        middle += Vector3::from(place.position) * place.area;
        along += Vector3::from(place.direction.unwrap_or_default()) * place.area;
    }
    let half = along * (ARROW * area.sqrt() / area.max(f64::MIN_POSITIVE));
    let middle = middle / area.max(f64::MIN_POSITIVE);
    [(middle - half).into(), (middle + half).into()]
}
