//! Limit cycles of a body without symmetry along a parameter, as a curve that may turn back.

use super::record::{CurveRecord, MotionRecord};
use crate::chart::{
    Axis, ChartError, Figure, Line, MUTED, Marker, Panel, Points, Rule, SERIES, Stroke,
};
use crate::results::charts::palette::STATUSES;
use crate::results::parameter::parameter_axis;

impl CurveRecord {
    fn is_fold(&self, cycle: usize) -> bool {
        self.folds.iter().any(|&place| place as usize == cycle)
    }

    /// Stability of a cycle; at a fold it is on the point of changing.
    fn stability(&self, cycle: usize) -> Option<bool> {
        let own = self.stable.get(cycle).copied().flatten();
        own.filter(|_| !self.is_fold(cycle))
    }

    /// What is known of the piece of the branch after a cycle: what both its ends, or the one that is decided, say.
    fn piece(&self, cycle: usize) -> Option<bool> {
        match [cycle, cycle + 1].map(|i| self.stability(i)) {
            [Some(a), Some(b)] => (a == b).then_some(a),
            [one, other] => one.or(other),
        }
    }

    /// One quantity along the branch: stable pieces strong, unstable ones dashed, others thin; named once.
    fn lines(&self, ys: &[f64], colour: &'static str, name: Option<&'static str>) -> Vec<Line> {
        let count = self.values.len();
        let points = |range: std::ops::RangeInclusive<usize>| {
            let places = range.map(|i| (self.values[i], ys[i]));
            Line::through(places.collect::<Vec<_>>())
        };
        let mut lines = Vec::new();
        let mut start = 0;
        while start + 1 < count {
            let known = self.piece(start);
            let mut end = start + 1;
            while end + 1 < count && self.piece(end) == known {
                end += 1;
            }
            let stroke = match known {
                Some(true) => Stroke::solid(colour, 1.6),
                Some(false) => Stroke::dashed(colour, 0.9),
                None => Stroke::solid(colour, 0.8),
            };
            lines.push(points(start..=end).stroke(stroke));
            start = end;
        }
        if let Some(name) = name {
            lines.push(points(0..=count - 1).solid(colour, 0.3).name(name));
        }
        lines
    }

    fn fold_points(&self, ys: &[f64]) -> Points {
        let places = self.folds.iter().map(|&place| place as usize);
        let points: Vec<(f64, f64)> = places.map(|i| (self.values[i], ys[i])).collect();
        Points::new(points).marker(Marker::Diamond, 2.4, SERIES[1]).name("fold")
    }
}

/// The cycles along the parameter of the case: frequency, amplitude, status, power; stable ones solid, unstable ones dashed,
/// with folds, the onset, and the case's own cycle.
pub(super) fn branch_figure(motion: &MotionRecord) -> Result<Figure, ChartError> {
    let curve = motion.branch.as_ref().filter(|curve| curve.values.len() > 1);
    let curve = curve.ok_or_else(|| ChartError::empty("cycles along a parameter"))?;
    let panel = |y: Axis, height: f64| {
        let onsets = curve.onsets.iter().map(|&onset| {
            let rule = Rule::vertical(onset).stretching();
            rule.stroke(Stroke::dotted(MUTED, 0.9))
                .name("onset: steady sliding loses its stability")
        });
        Panel::new(parameter_axis(&curve.key), y)
            .plain()
            .height(height)
            .layers(onsets.collect::<Vec<_>>())
    };
    let one = |y: Axis, height: f64, values: &[f64], own: Option<f64>| {
        let own = own.map(|y| {
            Points::new([(curve.own[0], y)])
                .marker(Marker::Circle, 2.2, SERIES[0])
                .name("the case's own cycle")
        });
        panel(y, height)
            .layers(curve.lines(values, SERIES[0], None))
            .layer(curve.fold_points(values))
            .layers(own)
    };
    let statuses = STATUSES.iter().zip(&curve.status);
    let statuses = statuses.fold(
        panel(Axis::new("share of nodes", "%").times(100.0), 84.0),
        |panel, ((_, name, _, _, colour), values)| {
            panel.layers(curve.lines(values, colour, Some(name)))
        },
    );
    let caption = format!(
        "Limit cycles along {} from that of {}: amplitude (a), frequency (b), contact status (c), power of the counterface (d).{}",
        curve.key,
        motion.hertz(),
        coexistence(curve),
    );
    let threshold = curve.threshold.map(|[amplitude, velocity]| {
        Points::new([(curve.own[0], amplitude)])
            .marker(Marker::Square, 2.2, SERIES[0])
            .name(format!("a kick of more than {velocity:.3e} m/s tips sliding"))
    });
    let figure = Figure::new(format!("branch-{}", motion.tag()), caption)
        .shared_x()
        .panel(
            one(
                Axis::new("amplitude", "m").prefixed().including(0.0),
                110.0,
                &curve.amplitude,
                Some(curve.own[2]),
            )
            .layers(threshold),
        )
        .panel(one(
            Axis::new("frequency", "kHz").times(1e-3),
            76.0,
            &curve.frequency_hz,
            Some(curve.own[1]),
        ))
        .panel(statuses)
        .panel(one(
            Axis::new("power", &curve.extent.unit("W")).prefixed(),
            76.0,
            &curve.external,
            None,
        ));
    let is_known = curve.stable.iter().any(Option::is_some);
    Ok(match is_known {
        true => figure.note("strong lines: stable; dashed: unstable; thin: stability unknown"),
        false => figure,
    })
}

/// Where cycles live beside stable sliding, as a sentence.
fn coexistence(curve: &CurveRecord) -> String {
    let text = |value: f64| crate::results::quantity::significant(value, 4);
    let both = curve.coexistence.iter();
    let both = both.map(|&[from, to]| {
        format!(" Stable sliding and a limit cycle coexist from {} to {}.", text(from), text(to))
    });
    both.collect()
}
