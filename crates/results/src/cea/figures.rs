//! The figures of an eigenvalue analysis.

use super::branches::{Branch, branch_of, branches, interval_rows, pieces};
use super::locus::{NamedDamping, locus};
use super::shape::{Body, ModeShape, moving};
use super::{BaseField, CeaReport, direction_name, feed, prestress, reading::budget};
use crate::common::*;

/// Branches whose shape is followed over friction, at most.
const FOLLOWED_BRANCHES: usize = 4;

/// Every figure that the report has data for: eigenvalue locus with stability bars, pairs that turn unstable, base
/// state, mode shapes, the branches that turn unstable at every friction value that has shapes. `field` is the base
/// state place by place, `dampings` are those that regions of the body have.
pub fn figures(
    report: &CeaReport<'_>,
    field: &BaseField,
    dampings: &[NamedDamping],
) -> Vec<Figure> {
    let mut figures: Vec<Declaration<'_>> =
        vec![Box::new(move || Some(locus(report, dampings))), Box::new(move || pairs(report))];
    let body = report.body;
    match body.sector {
        Some(sector) => {
            figures.push(Box::new(move || Some(prestress::revolution(sector, field))));
        }
        None if body.is_assembly() => {
            let of = move |names, value| prestress::surfaces(report, field, names, value);
            let pressure = ("prestress", "contact pressure");
            figures.push(Box::new(move || of(pressure, |own| own.pressure)));
            let shear = ("shear", "friction traction");
            figures.push(Box::new(move || of(shear, |own| own.shear)));
        }
        None => figures.push(Box::new(move || prestress::plane(body.mesh, field))),
    }
    for point in &report.solution.sweep.points {
        let friction = point.friction_coefficient;
        figures.push(Box::new(move || Some(shapes(report, friction))));
    }
    // The first branches that turn unstable and have several shapes.
    let branches = distinct(report.solution.sweep.intervals.iter().map(branch_of)).into_iter();
    let followed = branches.filter(|branch| branch_points(report, *branch).len() > 1);
    for branch in followed.take(FOLLOWED_BRANCHES) {
        figures.push(Box::new(move || Some(branch_shapes(report, branch))));
    }
    if let Some(reading) = &report.solution.reading {
        figures.push(Box::new(move || budget(report, reading)));
        figures.push(Box::new(move || feed::figure(report, field, &reading.feed)));
    }
    declared(figures)
}

/// Frequency and damping factor over friction of each pair of waves that turns unstable, that with the rotor and that
/// against it as two lines; without symmetry of each mode.
fn pairs(report: &CeaReport<'_>) -> Option<Figure> {
    let sweep = &report.solution.sweep;
    if sweep.points.len() < 2 {
        return None;
    }
    let all = branches(sweep);
    let pairs = distinct(interval_rows(sweep).iter().map(|(branch, _)| (branch.0, branch.1)));
    let height = (620.0 / pairs.len().max(1) as f64 - 14.0).clamp(40.0, 92.0);
    type Quantity = fn(&ComplexMode) -> f64;
    let quantities: [(Axis, Quantity); 2] = [
        (Axis::kilohertz(), ComplexMode::frequency_hz),
        (Axis::new("damping *ζ*", "%").times(100.0), ComplexMode::damping_factor),
    ];
    let panels = pairs.iter().flat_map(|&(harmonic, branch)| {
        let caption = match report.has_harmonics {
            true => format!("*n* = {harmonic}, branch {branch}"),
            false => report.branch_name((harmonic, branch, 0)),
        };
        let of = |direction: i8| all.get(&(harmonic, branch, direction));
        let other = partner(&all, (harmonic, branch, 0)).filter(|_| !report.has_harmonics);
        quantities.clone().map(|(axis, quantity)| {
            let values = |points: &[(f64, &ComplexMode)]| -> Vec<(f64, f64)> {
                points.iter().map(|(mu, mode)| (*mu, quantity(mode))).collect()
            };
            let line_of = |branch: Option<&Vec<(f64, &ComplexMode)>>| {
                let points = branch.map_or(&[][..], Vec::as_slice);
                let pieces = pieces(points, sweep, report.contact_changes);
                let gap = [(f64::NAN, f64::NAN)];
                Line::through(
                    pieces.into_iter().flat_map(|piece| [values(piece), gap.to_vec()].concat()),
                )
            };
            let line = |direction: i8| line_of(of(direction));
            // Pieces belong to one branch: where contact opens at every value they are dots without a join.
            let own = [-1, 0, 1].into_iter().filter_map(of).map(|points| (points, STABLE));
            let joins = own.chain(other.map(|points| (points, INK))).map(|(points, colour)| {
                Line::through(values(points)).stroke(Stroke::dashed(colour, 0.4))
            });
            let growing = [-1, 0, 1].into_iter().filter_map(of).flatten();
            let growing = growing.filter(|(_, mode)| mode.is_unstable());
            let standing = line(0).solid(STABLE, 1.1);
            let standing = if report.has_harmonics { standing } else { standing.name("mode") };
            Panel::new(Axis::friction().tight(), axis)
                .height(height)
                .caption(caption.clone())
                .layer(Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6)))
                .layers(joins)
                .layer(standing)
                .layer(
                    line_of(other)
                        .stroke(Stroke::dashed(INK, 0.9))
                        .name("mode of the nearest frequency"),
                )
                .layer(line(-1).solid(STABLE, 1.1).name("against the rotor ↻"))
                .layer(line(1).stroke(Stroke::dashed(INK, 0.9)).name("with the rotor ↺"))
                .layer(
                    Points::new(growing.map(|(mu, mode)| (*mu, quantity(mode))))
                        .marker(Marker::Disc, 1.5, UNSTABLE)
                        .name("unstable, *ζ* < 0"),
                )
        })
    });
    let caption = match report.has_harmonics {
        true => {
            "Frequency and damping factor over friction of the pairs of waves that turn unstable."
        }
        false => "Frequency and damping factor over friction of the modes that turn unstable.",
    };
    let figure = Figure::new("pairs", caption).columns(2).shared_x().panels(panels);
    Some(match report.contact_changes {
        [] => figure,
        _ => figure.note("thin dashed joins: contact opens or closes between"),
    })
}

/// Share of a frequency within which another one counts as its partner.
const COUPLED: f64 = 0.05;

/// The branch of the nearest frequency where another one begins to grow: in mode coupling the mode that it meets.
fn partner<'a, 'm>(
    all: &'a BTreeMap<Branch, Vec<(f64, &'m ComplexMode)>>,
    own: Branch,
) -> Option<&'a Vec<(f64, &'m ComplexMode)>> {
    let (friction, mode) = all.get(&own)?.iter().find(|(_, mode)| mode.is_unstable())?;
    let distance = |points: &[(f64, &ComplexMode)]| {
        let (_, other) = points.iter().find(|(mu, _)| mu == friction)?;
        Some((other.frequency_hz() - mode.frequency_hz()).abs())
    };
    let others = all.iter().filter(|(branch, _)| **branch != own);
    let there = others.filter_map(|(_, points)| Some((points, distance(points)?)));
    let (points, distance) = there.min_by(|a, b| a.1.total_cmp(&b.1))?;
    (distance < COUPLED * mode.frequency_hz()).then_some(points)
}

/// All modes of one friction value as small multiples.
fn shapes(report: &CeaReport<'_>, friction: f64) -> Figure {
    let shapes: Vec<_> = ModeShape::all(report).filter(|own| own.friction == friction).collect();
    let columns = match shapes.len() {
        0..=4 => shapes.len().max(2),
        5..=6 => 3,
        7..=8 | 11..=12 => 4,
        9..=15 => 5,
        16..=18 => 6,
        _ => 7,
    };
    let caption = format!(
        "Mode shapes at friction coefficient {friction}: the deformed body, coloured by \
        displacement amplitude; unstable modes in red."
    );
    let figure = Figure::new(format!("modes-mu-{friction}"), caption).columns(columns);
    let rays = if columns < 6 { 24 } else { 12 };
    let figure = multiples(report, figure, rays, &shapes, |shape| {
        let first = format!("{}: {} Hz", shape.number, signed(shape.mode.frequency_hz(), 0));
        [first, format!("Re {} Hz", signed(shape.mode.real_hz(), 1)), shape.harmonic()]
    });
    if shapes.is_empty() { figure } else { figure.motion(moving(report, &shapes)) }
}

/// The shapes of a branch at every friction value; a degenerate pair stands at the start of both its waves.
fn branch_points<'a>(
    report: &CeaReport<'a>,
    (harmonic, branch, direction): Branch,
) -> Vec<ModeShape<'a>> {
    let is_own = |shape: &ModeShape<'_>| {
        let mode = shape.mode;
        (mode.harmonic, mode.branch) == (harmonic, branch)
            && [direction, 0].contains(&mode.direction)
    };
    let mut shapes: Vec<_> = ModeShape::all(report).filter(is_own).collect();
    shapes.dedup_by_key(|shape| shape.friction);
    shapes
}

/// One branch at every friction value that has shapes.
fn branch_shapes(report: &CeaReport<'_>, branch: Branch) -> Figure {
    let way = direction_name(branch.2);
    let (n, rank) = (branch.0, branch.1);
    let (name, caption) = match report.has_harmonics {
        true => (
            format!("branch-n{n}-{rank}-{way}"),
            format!(
                "Harmonic {n}, branch {rank}, travelling {way} the rotor, at several friction coefficients."
            ),
        ),
        false => (
            format!("branch-{rank}"),
            format!(
                "Branch {rank} at several friction coefficients: the mode that is number {rank} \
                 by frequency at the lowest."
            ),
        ),
    };
    let shapes = branch_points(report, branch);
    let columns = if shapes.len() == 6 { 3 } else { shapes.len().clamp(2, 5) };
    let figure = Figure::new(name, caption).columns(columns);
    multiples(report, figure, 24, &shapes, |shape| {
        let mode = shape.mode;
        let values =
            format!("{} Hz, Re {} Hz", signed(mode.frequency_hz(), 0), signed(mode.real_hz(), 1));
        [format!("*μ* = {}", signed(shape.friction, 3)), values, shape.harmonic()]
    })
}

/// Small multiples of mode shapes under their lines, with what their colours and arrows mean.
fn multiples(
    report: &CeaReport<'_>,
    figure: Figure,
    rays: usize,
    shapes: &[ModeShape<'_>],
    lines: impl Fn(&ModeShape<'_>) -> [String; 3],
) -> Figure {
    let body = Body::new(report, rays);
    let panels = shapes.iter().map(|shape| body.panel(shape, &lines(shape)));
    let amplitude = Axis::new("displacement amplitude |*u*| / max |*u*|", "–").between(0.0, 1.0);
    let figure = figure.unlettered().panels(panels).colour_foot(amplitude, ColourMap::Viridis);
    match report.has_harmonics {
        true => figure
            .note("↺ travels with the rotor, ↻ against it")
            .note("Re: real part of the eigenvalue / 2π; *n*: harmonic (nodal diameters)"),
        false => figure.note("Re: real part of the eigenvalue / 2π"),
    }
}
