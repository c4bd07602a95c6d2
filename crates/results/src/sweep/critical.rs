//! Critical friction over the swept key of a study of eigenvalue analyses.

use super::record::{PointRecord, listed};
use crate::cea::{CriticalFriction, arrow};
use crate::charts::palette::STABLE;
use crate::parameter::parameter_axis;
use crate::sorted;
use frictionsim_chart::{Axis, Figure, Fill, Label, Line, Panel, Scale, look};
use std::collections::BTreeSet;

const FRICTION: &str = "contact.friction_coefficient";

/// Harmonic or nodal diameters, of a body that has them; branch; direction.
fn name(onset: &CriticalFriction) -> (Option<usize>, usize, i8) {
    (onset.harmonic, onset.branch, onset.direction.unwrap_or(0))
}

/// The critical friction of each branch over the one swept key besides friction; below all of them steady sliding is
/// stable. `highest` is the largest friction coefficient that was studied.
/// Nothing where not one key was swept through eigenvalue analyses.
pub fn critical_friction(records: &[PointRecord], highest: f64) -> Option<Figure> {
    let mut keys = records.first()?.swept.keys().filter(|key| *key != FRICTION);
    let (Some(key), None) = (keys.next(), keys.next()) else { return None };
    let point = |record: &PointRecord| {
        let onsets = record.summaries.get("cea")?.get("critical_frictions");
        Some((record.swept.get(key)?.as_f64()?, listed::<CriticalFriction>(onsets)))
    };
    let mut points = sorted(records.iter().filter_map(point), |own| own.0);
    points.dedup_by(|a, b| a.0 == b.0);
    if points.len() < 2 {
        return None;
    }
    let values: Vec<f64> = points.iter().map(|point| point.0).collect();
    // The first onset of each branch at each value; none where it stays stable.
    let names: BTreeSet<_> = points.iter().flat_map(|point| &point.1).map(name).collect();
    let critical = |branch: &(Option<usize>, usize, i8)| -> Vec<f64> {
        let lowest = |onsets: &Vec<CriticalFriction>| {
            let own = onsets.iter().filter(|onset| name(onset) == *branch);
            own.filter_map(|onset| onset.critical_friction).fold(f64::NAN, f64::min)
        };
        points.iter().map(|point| lowest(&point.1)).collect()
    };
    let branches: Vec<(_, Vec<f64>)> = names.iter().map(|own| (own, critical(own))).collect();
    let lowest = |i: usize| branches.iter().map(|own| own.1[i]).fold(highest, f64::min);
    let lowest: Vec<f64> = (0..values.len()).map(lowest).collect();
    let lines = branches.iter().enumerate().map(|(index, ((n, number, direction), critical))| {
        let line = Line::new(&values, critical).nth(index).marked(look(index).1, 1.8);
        let harmonic = n.map_or(String::new(), |n| format!("*n* = {n}, "));
        line.name(format!("{harmonic}branch {number}{}", arrow(*direction)))
    });
    let x = parameter_axis(key).scaled(Scale::for_values(values.iter().copied(), 10.0)).tight();
    let panel = Panel::new(x, Axis::friction().between(0.0, highest))
        .height(150.0)
        .layer(Fill::from(0.0, &values, &lowest, STABLE).opacity(0.15))
        .layers(lines)
        .layer(Label::new((values[0], 0.0), "stable").moved(5.0, -5.0));
    let caption = format!(
        "Critical friction of each branch over {key}; steady sliding is stable below all of them."
    );
    Some(Figure::new("critical-friction", caption).narrow().panel(panel))
}
