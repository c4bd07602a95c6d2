//! The figures of a parameter study, from its points.

use super::cycle_figures::{FamilyRecord, branch_curves, draw_branches};
use super::figures::axis::Scale;
use super::figures::text::literal;
use super::figures::{
    CriticalFriction, FigureError, ReferenceFrequency, SpeedSeries, SpeedSweep,
    draw_critical_friction, draw_speed_frequencies, draw_speed_status,
};
use super::parameter::parameter_title;
use super::report::NamedFigure;
use super::sweep::{PointRecord, swept_text};
use serde::Deserialize;
use serde_json::{Map, Value};

const SPEED: &str = "contact.rotation_speed_rpm";
const FRICTION: &str = "contact.friction_coefficient";

/// Draws what a study has points for: main frequency and contact status over the rotation speed if
/// that was swept, critical friction if one other key was swept through eigenvalue analyses, branches of limit cycles if
/// they were followed at its points.
///
/// `friction_coefficient` is the case's own, for studies that do not sweep it; `highest_friction` the
/// largest of its eigenvalue analysis. Nothing is drawn over speed where any other key than speed and
/// friction was swept as well.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_sweep(
    records: &[PointRecord],
    friction_coefficient: f64,
    highest_friction: f64,
    references: &[ReferenceFrequency],
) -> Result<Vec<NamedFigure>, FigureError> {
    let mut figures = Vec::new();
    let speeds = speed_sweep(records, friction_coefficient, references);
    if speeds.series.iter().any(has_values) {
        figures.push(NamedFigure {
            name: "frequencies".into(),
            caption:
                "Main frequency of the limit cycle over rotation speed; dashed: unstable modes."
                    .into(),
            svg: draw_speed_frequencies(&speeds)?,
        });
        figures.push(NamedFigure {
            name: "status".into(),
            caption: "Shares of sticking, slipping and open contact nodes over rotation speed."
                .into(),
            svg: draw_speed_status(&speeds)?,
        });
    }
    if let Some(critical) = critical_friction(records, highest_friction) {
        figures.push(NamedFigure {
            name: "critical-friction".into(),
            caption:
                "Critical friction of each branch; steady sliding is stable below all of them."
                    .into(),
            svg: draw_critical_friction(&critical)?,
        });
    }
    figures.extend(limit_cycles(records)?);
    Ok(figures)
}

/// The branches of limit cycles of all points, harmonic by harmonic.
fn limit_cycles(records: &[PointRecord]) -> Result<Vec<NamedFigure>, FigureError> {
    let mut families: Vec<(String, FamilyRecord)> = Vec::new();
    for record in records {
        let summary = record.summaries.get("cycle");
        let curves = summary.and_then(|summary| summary.get("curves")?.as_array());
        for curve in curves.into_iter().flatten() {
            // A record of another version has no curves that this one knows.
            if let Ok(family) = FamilyRecord::deserialize(curve) {
                families.push((format!(", {}", swept_label(&record.swept)), family));
            }
        }
    }
    families.sort_by_key(|(_, family)| family.family());
    let families: Vec<_> = families.iter().map(|(l, f)| (l.clone(), f)).collect();
    draw_branches(&branch_curves(&families))
}

/// What a point is known by, in mark-up.
fn swept_label(swept: &Map<String, Value>) -> String {
    match (swept.len(), swept.get(FRICTION)) {
        (1, Some(friction)) => format!("*μ* = {friction}"),
        _ => literal(&swept_text(swept)),
    }
}

/// Whether a series has two speeds or more, and a vibration at any.
fn has_values(series: &SpeedSeries) -> bool {
    series.speeds_rpm.len() > 1 && series.main_frequency_hz.iter().any(|f| f.is_finite())
}

fn number(value: Option<&Value>) -> f64 {
    value.and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// Points by friction coefficient, each series in order of speed; failed points leave gaps.
fn speed_sweep(
    records: &[PointRecord],
    friction_coefficient: f64,
    references: &[ReferenceFrequency],
) -> SpeedSweep {
    let mut points: Vec<(f64, f64, [f64; 4])> = Vec::new();
    for record in records {
        let speed = number(record.swept.get(SPEED));
        let is_known = |key: &String| key == SPEED || key == FRICTION;
        if !speed.is_finite() || !record.swept.keys().all(is_known) {
            continue;
        }
        let friction = record.swept.get(FRICTION).and_then(Value::as_f64);
        let summary = record.summaries.get("transient");
        let quantity = |path: &str| number(summary.and_then(|summary| summary.pointer(path)));
        let values = [
            "/main_frequency_hz",
            "/status/stick",
            "/status/slip",
            "/status/open",
        ];
        points.push((
            friction.unwrap_or(friction_coefficient),
            speed,
            values.map(quantity),
        ));
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut series: Vec<SpeedSeries> = Vec::new();
    for (friction, speed, [frequency, stick, slip, open]) in points {
        if series
            .last()
            .is_none_or(|last| last.friction_coefficient != friction)
        {
            series.push(SpeedSeries {
                friction_coefficient: friction,
                speeds_rpm: Vec::new(),
                main_frequency_hz: Vec::new(),
                stick: Vec::new(),
                slip: Vec::new(),
                open: Vec::new(),
            });
        }
        if let Some(last) = series.last_mut() {
            last.speeds_rpm.push(speed);
            last.main_frequency_hz.push(frequency);
            last.stick.push(stick);
            last.slip.push(slip);
            last.open.push(open);
        }
    }
    SpeedSweep {
        series,
        references: references.to_vec(),
    }
}

/// Critical friction over the one swept key of a study of eigenvalue analyses.
fn critical_friction(records: &[PointRecord], highest_friction: f64) -> Option<CriticalFriction> {
    let first = records.first()?;
    let mut keys = first.swept.keys().filter(|key| *key != FRICTION);
    let (Some(key), None) = (keys.next(), keys.next()) else {
        return None;
    };
    let mut points: Vec<(f64, &Value)> = records
        .iter()
        .filter_map(|record| {
            let found = record.summaries.get("cea")?.get("critical_frictions")?;
            Some((record.swept.get(key)?.as_f64()?, found))
        })
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.dedup_by(|a, b| a.0 == b.0);
    if points.len() < 2 {
        return None;
    }
    let branch_of = |entry: &Value| {
        let part = |name: &str| entry.get(name).and_then(Value::as_i64).unwrap_or(0);
        (part("harmonic"), part("branch"), part("direction"))
    };
    let mut names: Vec<(i64, i64, i64)> = points
        .iter()
        .flat_map(|(_, found)| found.as_array().into_iter().flatten())
        .map(branch_of)
        .collect();
    names.sort_unstable();
    names.dedup();
    let critical_of = |found: &Value, wanted: (i64, i64, i64)| {
        let entries = found.as_array().into_iter().flatten();
        let own = entries.filter(|entry| branch_of(entry) == wanted);
        own.map(|entry| number(entry.get("critical_friction")))
            .fold(f64::NAN, f64::min)
    };
    let values: Vec<f64> = points.iter().map(|point| point.0).collect();
    let (low, high) = (values[0], values[values.len() - 1]);
    Some(CriticalFriction {
        parameter_title: parameter_title(key),
        scale: if low > 0.0 && high / low > 20.0 {
            Scale::Logarithmic
        } else {
            Scale::Linear
        },
        branches: names
            .into_iter()
            .map(|name| {
                let critical = points.iter().map(|(_, found)| critical_of(found, name));
                (
                    format!("*n* = {}, branch {}", name.0, name.1),
                    critical.collect(),
                )
            })
            .collect(),
        values,
        highest_friction,
    })
}
