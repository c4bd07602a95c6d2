//! The map of a study of basins.

use super::super::parameter::parameter_axis;
use super::super::sweep::{PointRecord, by_other_keys, swept_text};
use frictionsim_chart::{Axis, Figure, Line, Marker, Panel, Points, Scale, literal, look};

const SPEED: &str = "contact.rotation_speed_rpm";
const FRICTION: &str = "contact.friction_coefficient";

/// The boundary at one value of the key along the axis.
struct Boundary {
    value: f64,
    low: Option<f64>,
    high: Option<f64>,
}

/// Amplitude ratio at saturation above which the second wave wins, over the rotation speed or the first swept key; one
/// line for each choice of the other keys.
pub fn basin_map(records: &[PointRecord]) -> Option<Figure> {
    let first = records.first()?;
    let keys = || first.swept.keys();
    let key = keys().find(|key| *key == SPEED).or_else(|| keys().next())?;
    let mut harmonics = [1, 2];
    let boundaries = records.iter().filter_map(|record| {
        let summary = record.summaries.get("basin")?;
        for (place, harmonic) in harmonics.iter_mut().enumerate() {
            let found = summary["harmonics"][place].as_f64();
            *harmonic = found.map_or(*harmonic, |n| n as usize);
        }
        let boundary = Boundary {
            value: record.swept[key].as_f64().unwrap_or(f64::NAN),
            low: summary["boundary"]["low"].as_f64(),
            high: summary["boundary"]["high"].as_f64(),
        };
        Some((record, boundary))
    });
    let series = by_other_keys(boundaries, key, |rest| match rest.get(FRICTION) {
        Some(friction) if rest.len() == 1 => format!("*μ* = {friction}"),
        _ => literal(&swept_text(rest)),
    });
    let [one, two] = harmonics;
    let values = series.iter().flat_map(|(_, all)| all).map(|b| b.value);
    let axis = parameter_axis(key).scaled(Scale::for_values(values, 10.0));
    let ratio = Axis::new("amplitude ratio at saturation", "").logarithmic();
    let only = [
        format!("*n* = {one} wins up to here, the largest ratio tried"),
        format!("*n* = {two} wins down to here, the smallest ratio tried"),
    ];
    let mut panel = Panel::new(axis, ratio).height(180.0);
    for (index, (name, boundaries)) in series.iter().enumerate() {
        let colour = look(index).0;
        let all = || boundaries.iter();
        let middle = all().filter_map(|b| Some((b.value, (b.low? * b.high?).sqrt())));
        let bars = all().map(|b| {
            let ends = [b.low, b.high].into_iter().flatten();
            Line::through(ends.map(|end| (b.value, end))).solid(colour, 3.0)
        });
        let low =
            Points::new(all().filter(|b| b.high.is_none()).filter_map(|b| Some((b.value, b.low?))));
        let high =
            Points::new(all().filter(|b| b.low.is_none()).filter_map(|b| Some((b.value, b.high?))));
        let one_sided = [low, high].into_iter().zip(&only).zip(Marker::ALL);
        let one_sided = one_sided.map(|((points, text), marker)| {
            let points = points.marker(marker, 2.6, colour);
            if index == 0 { points.name(text) } else { points }
        });
        panel = panel
            .layer(Line::through(middle).nth(index).name(name.clone()))
            .layers(bars)
            .layers(one_sided);
    }
    let caption = format!(
        "Amplitude of *n* = {two} over that of *n* = {one} at the first stick or opening, above \
         which *n* = {two} wins; bars: the bounds found."
    );
    Some(Figure::new("basins", caption).panel(panel))
}
