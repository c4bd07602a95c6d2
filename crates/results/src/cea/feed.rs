//! Where on the contact surfaces friction feeds the unstable modes: `feed.csv`, `feed.vtu` and a figure.

use super::base::{ContactPlace, POINTS, means_around, or_zero};
use super::branches::{ModeName, NUMBERS, kilohertz};
use super::{BaseField, CeaReport};
use crate::common::*;

/// Modes that the figure shows, the fastest first: of plane bodies as lines, of solid ones as pictures.
const LINES: usize = 6;
const PICTURES: usize = 2;

/// What each contact point adds to the growth of a mode.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeFeed {
    /// The mode.
    pub mode: ModeName,
    /// Of each contact point of the base state, 1/s; they add up to what the contacts feed in `contributions.csv`.
    pub rates: Vec<f64>,
}

columns! {
    /// What a contact point adds to the growth of a mode: the rate, 1/s, of its area, m2.
    pub(crate) FEED: row as (f64, f64);
    growth_rate_per_s: "what it adds to the growth rate" = row.0;
    growth_rate_per_s_m2: "the same over its area" = row.0 / row.1;
}

/// `feed.csv`: a row for each unstable mode and contact point.
pub(super) fn table(field: &BaseField, modes: &[ModeFeed]) -> Table {
    let all = || modes.iter().flat_map(|own| field.contact.iter().zip(&own.rates));
    let names = modes.iter().flat_map(|own| field.contact.iter().map(|_| own.mode));
    let rates = all().map(|(point, &rate)| (rate, point.place.area));
    let points = all().map(|(point, _)| point);
    Table::new("feed.csv", "").columns(NUMBERS, names).columns(POINTS, points).columns(FEED, rates)
}

/// Writes `feed.vtu`, growth for each area of the contact surfaces, the mean of the points around each node, 0
/// elsewhere.
pub(super) fn write_fields(
    folder: &OutputFolder,
    report: &CeaReport<'_>,
    field: &BaseField,
    modes: &[ModeFeed],
) -> Result<(), FolderError> {
    let whole = report.body.whole();
    let fields = modes.iter().map(|own| {
        let name = format!("mode_{}_growth_rate_per_s_m2", own.mode.mode);
        Field::scalars(&name, or_zero(own.around_nodes(field, whole.node_count())))
    });
    let fields: Vec<Field> = fields.collect();
    folder
        .write_bulk("feed.vtu", |out| write_vtu(out, &EncodedMesh::new(&whole)?, &[], &fields, &[]))
}

impl ModeFeed {
    /// Growth for each area around each node; NaN where there is no contact point.
    fn around_nodes(&self, field: &BaseField, count: usize) -> Vec<f64> {
        let points = field.contact.iter().map(|own| &own.place).zip(self.rates.iter().copied());
        means_around(count, points, |rate, _, share| rate * share)
    }
}

/// The modes that grow fastest.
fn fastest<'a>(report: &CeaReport<'_>, all: &'a [ModeFeed]) -> Vec<&'a ModeFeed> {
    let friction = all.first().map(|own| own.mode.friction_coefficient);
    let mut points = report.solution.sweep.points.iter();
    let point = points.find(|point| Some(point.friction_coefficient) == friction);
    let growth = |own: &ModeFeed| {
        let mode = point.and_then(|point| point.modes.get(own.mode.mode - 1));
        mode.map_or(0.0, |mode| mode.growth_rate())
    };
    sorted(all, |own| -growth(own))
}

/// Growth for each area of the contact: lines along a plane edge, pictures of the surfaces of solid bodies.
pub(super) fn figure(
    report: &CeaReport<'_>,
    field: &BaseField,
    all: &[ModeFeed],
) -> Option<Figure> {
    let modes = fastest(report, all);
    let friction = modes.first()?.mode.friction_coefficient;
    let caption = format!(
        "Where the contact feeds the unstable modes at friction {friction}: growth rate for each area of the surface; \
        red feeds, blue takes. The sum over the surface is the contact's part in the budget."
    );
    Some(match report.body.is_assembly() {
        true => pictures(report.body.mesh, field, &modes, caption),
        false => lines(report, field, &modes, caption),
    })
}

fn lines(
    report: &CeaReport<'_>,
    field: &BaseField,
    modes: &[&ModeFeed],
    caption: String,
) -> Figure {
    // Across the rings of a body of revolution; along an edge by angle about the cylinder, or along the plane.
    let face = report.body.sector.map(|sector| sector.specification.contact.face());
    let across = |name: &str| Axis::new(name, "mm").times(1e3).tight();
    let way = (face, &report.body.mesh.counterface);
    let x = match way {
        (Some(SolidFace::Inner | SolidFace::Outer), _) => across("height *z*"),
        (Some(SolidFace::Top | SolidFace::Bottom), _) => across("radius *r*"),
        (None, Counterface::Cylinder { .. }) => Axis::degrees().tight(),
        (None, Counterface::Plane { .. }) => across("along the contact"),
    };
    let along = |&ContactPlace { position: [x, y, z], .. }: &ContactPlace| match way {
        (Some(SolidFace::Inner | SolidFace::Outer), _) => z,
        (Some(SolidFace::Top | SolidFace::Bottom), _) => x,
        (None, Counterface::Cylinder { center, .. }) => {
            (y - center[1]).atan2(x - center[0]).rem_euclid(TAU)
        }
        (None, Counterface::Plane { point, direction }) => {
            (x - point[0]) * direction[0] + (y - point[1]) * direction[1]
        }
    };
    let order = sorted(0..field.contact.len(), |&at| along(&field.contact[at].place));
    let y = Axis::new("feed", "1/(s cm²)").times(1e-4);
    let mut panel =
        Panel::new(x, y).height(150.0).layer(Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6)));
    for (index, own) in modes.iter().take(LINES).enumerate() {
        let points = order.iter().map(|&i| {
            let place = &field.contact[i].place;
            (along(place), own.rates[i] / place.area)
        });
        panel = panel.layer(Line::through(points).nth(index).name(name(own)));
    }
    Figure::new("feed", caption).panel(panel)
}

fn pictures(mesh: &Mesh, field: &BaseField, modes: &[&ModeFeed], caption: String) -> Figure {
    let surfaces = &field.surfaces;
    let panels = modes.iter().take(PICTURES).flat_map(|own| {
        let values = own.around_nodes(field, mesh.node_count());
        let numbers = values.iter().copied().filter(|value| value.is_finite());
        let largest = numbers.map(f64::abs).fold(f64::MIN_POSITIVE, f64::max);
        surfaces.iter().map(move |(contact, boundary)| {
            let axis = Axis::new("feed", "1/(s cm²)").times(1e-4).between(-largest, largest);
            let view = SolidView::of_boundary(mesh, *boundary);
            view.panel(&values, axis, ColourMap::Diverging, 0.05)
                .height(140.0)
                .caption(literal(contact))
                .heading(name(own))
                .colour_bar(frictionsim_chart::Side::Right)
        })
    });
    let panels: Vec<Panel> = panels.collect();
    Figure::new("feed", caption).columns(surfaces.len().clamp(1, 2)).panels(panels)
}

/// A mode for people.
fn name(own: &ModeFeed) -> String {
    format!("mode {}, {}", own.mode.mode, kilohertz(&own.mode).replace("n =", "*n* ="))
}
