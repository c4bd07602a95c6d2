//! The figures of a parameter study, from its points.

use super::matrix_figure::operating_matrix;
use super::record::{PointRecord, listed};
use super::report::{TWO_FREQUENCY, UNSETTLED};
use super::table::{FRICTION, SPEED, by_other_keys, printed, swept_friction};
use crate::basin::basin_map;
use crate::cea::{CriticalFriction, UnstableCount, arrow};
use crate::charts::palette::{OPEN, SLIP, STICK};
use crate::common::*;
use crate::cycle::{FamilyRecord, draw_branches};

/// Most curves of one figure.
const MOST_SERIES: usize = 12;
/// Fraction of sticking nodes below which none is said to stick.
const NO_STICK: f64 = 0.005;

/// Draws what a study has points for: main frequency and contact status over the rotation speed, or else over another
/// swept key; critical friction if one key besides friction was swept through eigenvalue analyses; the operating matrix
/// of their unstable modes; branches of limit cycles if they were followed at its points.
///
/// `modes` are unstable modes at `friction_coefficient`, the case's own.
pub fn draw_sweep(
    records: &[PointRecord],
    friction_coefficient: f64,
    modes: &[ModeLine],
) -> Vec<Figure> {
    let study = Study::of(records);
    let study = &study;
    let declarations: Vec<Declaration<'_>> = vec![
        Box::new(move || Some(study.frequencies(modes, friction_coefficient))),
        Box::new(move || Some(study.status())),
        Box::new(move || critical_friction(records)),
        Box::new(move || basin_map(records)),
        Box::new(move || operating_matrix(records)),
    ];
    let mut figures = declared(declarations);
    let mut families = cycle_families(records);
    families.sort_by_key(|(_, family)| (family.mode, family.family()));
    figures.extend(draw_branches(&families, &[]));
    figures
}

/// The limit cycle found at one point.
struct Cycle {
    /// Number of its point.
    point: usize,
    value: f64,
    frequency_hz: f64,
    harmonic: Option<u64>,
    /// What the transient ends in.
    end: String,
    /// Fractions of contact nodes that stick, slip, are open.
    status: [f64; 3],
}

/// Points that differ in one key alone, in order of its values.
struct Series {
    name: String,
    cycles: Vec<Cycle>,
}

/// Limit cycles over one swept key.
struct Study {
    key: String,
    series: Vec<Series>,
}

impl Study {
    /// The points of a study over the rotation speed, where that was swept, or over the first swept key with several
    /// values; one series for each choice of the other keys.
    fn of(records: &[PointRecord]) -> Self {
        let value = |record: &PointRecord, key: &str| number(record.swept.get(key));
        let several = |key: &&String| {
            let first = records.first().map_or(f64::NAN, |record| value(record, key));
            first.is_finite() && records.iter().any(|record| value(record, key) != first)
        };
        let keys = || records.iter().flat_map(|record| record.swept.keys()).take(8).filter(several);
        let key = keys().find(|key| *key == SPEED).or_else(|| keys().next());
        let key = key.cloned().unwrap_or_default();
        let cycles = records.iter().filter_map(|record| {
            let summary = record.summaries.get("transient")?;
            let cycle = Cycle {
                point: record.point,
                value: value(record, &key),
                frequency_hz: number(summary.get("main_frequency_hz")),
                harmonic: summary["main_harmonic"].as_u64(),
                end: summary["end_state"].as_str().unwrap_or_default().to_owned(),
                status: ["stick", "slip", "open"]
                    .map(|status| number(summary["status"].get(status))),
            };
            Some((record, cycle))
        });
        let series = by_other_keys(cycles, &key, swept_label).into_iter();
        let mut series: Vec<Series> =
            series.map(|(name, cycles)| Series { name, cycles }).collect();
        for series in &mut series {
            frictionsim_physics::order::sort_by_number(&mut series.cycles, |a| a.value);
        }
        series.sort_by(|a, b| a.name.cmp(&b.name));
        series.retain(|series| series.cycles.len() > 1);
        series.truncate(MOST_SERIES);
        Self { key, series }
    }

    fn axis(&self) -> Axis {
        let values = self.cycles().map(|cycle| cycle.value);
        parameter_axis(&self.key).scaled(Scale::for_values(values, 10.0))
    }

    fn cycles(&self) -> impl Iterator<Item = &Cycle> + Clone {
        self.series.iter().flat_map(|series| &series.cycles)
    }

    /// What rings mean, where there are any.
    fn ring_caption(&self) -> String {
        let ends_in = |end: &str| self.cycles().any(|cycle| cycle.end == end);
        let mut caption = String::new();
        if ends_in(UNSETTLED) {
            caption += "; ring: not settled";
        }
        if ends_in(TWO_FREQUENCY) {
            caption += "; double ring: a vibration of two frequencies, no limit cycle";
        }
        caption
    }

    fn over(&self) -> String {
        plain(&parameter_axis(&self.key).title())
    }

    /// Main frequencies, one line for each choice of the other keys, with markers for the harmonic.
    fn frequencies(&self, modes: &[ModeLine], friction: f64) -> Figure {
        let modes = modes.iter().map(|mode| {
            let text = format!("{:.2} kHz, {}", mode.frequency_hz * 1e-3, mode.label);
            let name = format!("unstable mode of the eigenvalue analysis at *μ* = {friction}");
            Rule::horizontal(mode.frequency_hz)
                .stroke(Stroke::dashed(INK, 0.6))
                .at_rim(text)
                .name(name)
        });
        let mut panel = Panel::new(self.axis(), Axis::new("main frequency *f*", "kHz").times(1e-3))
            .height(180.0)
            .layers(modes);
        for (index, series) in self.series.iter().enumerate() {
            let line =
                Line::through(series.cycles.iter().map(|cycle| (cycle.value, cycle.frequency_hz)));
            panel = panel.layer(line.nth(index).name(series.name.clone()));
            // From where on one harmonic is selected for good.
            let last = series.cycles.last().and_then(|cycle| cycle.harmonic);
            let selected = last.filter(|_| self.key == SPEED);
            let selected = selected.and_then(|_| series.end_of(|cycle| cycle.harmonic != last));
            panel = panel.layers(selected.map(|speed| {
                Rule::vertical(speed)
                    .stroke(Stroke::dotted(look(index).0, 0.9))
                    .beside("*ω*\\*")
                    .name(format!("*ω*\\*, {}", series.name))
            }));
        }
        panel = panel.layers(rings(self.cycles(), |cycle| vec![(cycle.value, cycle.frequency_hz)]));
        for (harmonic, marker) in (0..).zip(Marker::ALL.iter().cycle()).take(9) {
            for (index, series) in self.series.iter().enumerate() {
                let own = series.cycles.iter().filter(|cycle| cycle.harmonic == Some(harmonic));
                let (points, rows): (Vec<(f64, f64)>, _) =
                    own.map(|cycle| ((cycle.value, cycle.frequency_hz), cycle.point)).unzip();
                let named = Points::new(points.iter().copied())
                    .marker(*marker, 0.01, INK)
                    .name(format!("*n* = {harmonic}"));
                let points = Points::new(points).marker(*marker, 2.0, look(index).0);
                panel = panel.layer(named).layer(points.rows(rows));
            }
        }
        let caption = format!(
            "Main frequency of the vibration over {}, with markers for the number of nodal \
            diameters; dashed: unstable modes{}.",
            self.over(),
            self.ring_caption()
        );
        Figure::new("frequencies", caption).panel(panel)
    }

    /// Shares of stick, slip and open as stacked areas, one panel for each choice of the other keys.
    fn status(&self) -> Figure {
        let panels = self.series.iter().map(|series| {
            let is_known = |cycle: &&Cycle| cycle.status.iter().all(|part| part.is_finite());
            let known = || series.cycles.iter().filter(is_known);
            let column = |of: &dyn Fn(&Cycle) -> f64| known().map(of).collect::<Vec<f64>>();
            let values = column(&|cycle| cycle.value);
            let stick = column(&|cycle| cycle.status[0]);
            let slip = column(&|cycle| cycle.status[0] + cycle.status[1]);
            let all = column(&|cycle| cycle.status.iter().sum());
            let rows = known().chain(known()).map(|cycle| cycle.point).collect();
            let bounds = values.iter().zip(&stick).chain(values.iter().zip(&slip));
            let no_stick = series.end_of(|cycle| cycle.status[0] > NO_STICK);
            let no_stick = no_stick.filter(|_| self.key == SPEED);
            Panel::new(
                self.axis().tight(),
                Axis::new("contact nodes", "%").times(100.0).between(0.0, 1.0),
            )
            .plain()
            .heading(series.name.clone())
            .layer(Fill::from(0.0, &values, &stick, STICK).name("stick"))
            .layer(Fill::between(&values, &stick, &slip, SLIP).name("slip"))
            .layer(Fill::between(&values, &slip, &all, OPEN).name("open"))
            .layers(rings(known(), |cycle| {
                let [stick, slip, _] = cycle.status;
                vec![(cycle.value, stick), (cycle.value, stick + slip)]
            }))
            .layer(
                Points::new(bounds.map(|(x, y)| (*x, *y)))
                    .marker(Marker::Disc, 1.1, INK)
                    .rows(rows)
                    .name("computed"),
            )
            .layers(
                no_stick.map(|speed| Rule::vertical(speed).name("*ω*^{+}: no stick from here on")),
            )
        });
        let caption = format!(
            "Shares of sticking, slipping and open contact nodes over {}{}.",
            self.over(),
            self.ring_caption()
        );
        let columns = self.series.len().clamp(1, 3);
        Figure::new("status", caption).columns(columns).shared_y().panels(panels)
    }
}

impl Series {
    /// The value from which on something is over that was before.
    fn end_of(&self, is_so: impl Fn(&Cycle) -> bool) -> Option<f64> {
        let last = self.cycles.iter().rposition(is_so)?;
        Some(self.cycles.get(last + 1)?.value)
    }
}

/// Rings around the points that are no limit cycles: one where the run has not settled, two around two frequencies.
fn rings<'a>(
    cycles: impl Iterator<Item = &'a Cycle> + Clone,
    places: impl Fn(&Cycle) -> Vec<(f64, f64)>,
) -> Vec<Points> {
    let ring = |end: &str, radius: f64| {
        let own = cycles.clone().filter(|cycle| cycle.end == end);
        let own: Vec<(f64, f64)> = own.flat_map(&places).collect();
        (!own.is_empty()).then(|| Points::new(own).marker(Marker::Circle, radius, INK))
    };
    let named = |points: Option<Points>, name: &str| points.map(|points| points.name(name));
    let rings = [
        named(ring(UNSETTLED, 3.6), "not settled"),
        named(ring(TWO_FREQUENCY, 5.0), "two frequencies"),
        ring(TWO_FREQUENCY, 3.6),
    ];
    rings.into_iter().flatten().collect()
}

/// The branches of limit cycles of all points.
fn cycle_families(records: &[PointRecord]) -> Vec<(String, FamilyRecord)> {
    let mut families = Vec::new();
    for record in records {
        let summary = record.summaries.get("cycle");
        let curves = listed(summary.and_then(|summary| summary.get("curves"))).into_iter();
        families.extend(curves.map(|own| (format!(", {}", swept_label(&record.swept)), own)));
    }
    families
}

/// What a point is known by, in mark-up.
fn swept_label(swept: &Map<String, Value>) -> String {
    match (swept.len(), swept.get(FRICTION)) {
        (0, _) => "limit cycle".into(),
        (1, Some(friction)) => format!("*μ* = {friction}"),
        _ => {
            let parts = swept.iter().map(|(key, value)| {
                format!("{} = {}", parameter_name(key), literal(&printed(value)))
            });
            parts.collect::<Vec<_>>().join(", ")
        }
    }
}

fn number(value: Option<&Value>) -> f64 {
    value.and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// Harmonic or nodal diameters, of a body that has them; branch; direction.
fn name(onset: &CriticalFriction) -> (Option<usize>, usize, i8) {
    (onset.harmonic, onset.branch, onset.direction.unwrap_or(0))
}

/// The critical friction of each branch over the one swept key besides friction; from the lowest friction coefficient
/// that was solved up to all of them steady sliding is stable.
/// Nothing where not one key was swept through eigenvalue analyses.
fn critical_friction(records: &[PointRecord]) -> Option<Figure> {
    let friction = records.iter().find_map(swept_friction).map(|own| own.0);
    let mut keys = records.first()?.swept.keys().filter(|key| Some(*key) != friction);
    let (Some(key), None) = (keys.next(), keys.next()) else { return None };
    let point = |record: &PointRecord| {
        let cea = record.summaries.get("cea")?;
        let solved = listed::<UnstableCount>(cea.get("unstable_counts")).into_iter();
        let solved = extremes(solved.map(|own| own.friction_coefficient));
        let onsets = listed::<CriticalFriction>(cea.get("critical_frictions"));
        Some((record.swept.get(key)?.as_f64()?, solved, onsets))
    };
    let mut points = sorted(records.iter().filter_map(point), |own| own.0);
    points.dedup_by(|a, b| a.0 == b.0);
    if points.len() < 2 {
        return None;
    }
    type Point = (f64, (f64, f64), Vec<CriticalFriction>);
    let column = |of: &dyn Fn(&Point) -> f64| points.iter().map(of).collect::<Vec<f64>>();
    let (values, start) = (column(&|own| own.0), column(&|own| own.1.0));
    // A branch that is lost may turn unstable anywhere from there on.
    let safe = |own: &CriticalFriction| own.lost_after.or(own.critical_friction);
    let safe = column(&|own| own.2.iter().filter_map(safe).fold(own.1.1, f64::min));
    // The first onset of each branch at each value; none where it stays stable or is unstable from the start.
    let located = |own: &&CriticalFriction| !own.unstable_from_start;
    let onsets = points.iter().flat_map(|own| &own.2).filter(located);
    let names: BTreeSet<_> = onsets.map(name).collect();
    let lines = names.iter().enumerate().map(|(index, branch)| {
        let of_branch = |onset: &&CriticalFriction| located(onset) && name(onset) == *branch;
        let critical = column(&|own| {
            let own = own.2.iter().filter(of_branch);
            own.filter_map(|onset| onset.critical_friction).fold(f64::NAN, f64::min)
        });
        let line = Line::new(&values, &critical).nth(index).marked(look(index).1, 1.8);
        let (n, number, direction) = branch;
        let harmonic = n.map_or(String::new(), |n| format!("*n* = {n}, "));
        line.name(format!("{harmonic}branch {number}{}", arrow(*direction)))
    });
    let x = parameter_axis(key).scaled(Scale::for_values(values.iter().copied(), 10.0)).tight();
    let highest = points.iter().map(|own| own.1.1).fold(0.0, f64::max);
    let at = (0..points.len()).find(|&at| start[at] < safe[at]);
    let label = |at| Label::new((values[at], start[at]), "stable").moved(5.0, -5.0);
    let area = |_| Fill::between(&values, &start, &safe, STABLE).opacity(0.15);
    let panel = Panel::new(x, Axis::friction().between(0.0, highest))
        .height(150.0)
        .layers(at.map(area))
        .layers(lines)
        .layers(at.map(label));
    let caption = format!(
        "Critical friction of each branch over {key}; steady sliding is stable where it is shaded."
    );
    Some(Figure::new("critical-friction", caption).narrow().panel(panel))
}
