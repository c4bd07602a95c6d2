//! Branches of limit cycles over a parameter, as curves that may turn back.

use super::axis::{Axis, extremes};
use super::colour::INK;
use super::legend::Key;
use super::panel::{Marker, Panel};
use super::svg::{Stroke, Svg};
use super::time_stack::ReferenceFrequency;
use super::{FigureError, expect_length, expect_some};

/// What is known of the stability of a limit cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stability {
    /// Nothing.
    #[default]
    Unknown,
    /// Every small perturbation dies out.
    Stable,
    /// Some perturbation grows.
    Unstable,
}

/// Limit cycles of one family in the order of their branch, along which the parameter may turn back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BranchCurve {
    /// Name in mark-up: `*n* = 2`.
    pub name: String,
    /// Parameter.
    pub values: Vec<f64>,
    /// Main frequency, Hz.
    pub frequency_hz: Vec<f64>,
    /// Amplitude of the contact edge's tangential displacement, m.
    pub amplitude: Vec<f64>,
    /// Fractions of the contact edge that stick, slip, are open.
    pub status: [Vec<f64>; 3],
    /// Powers relative to the external one: stick, slide, dissipated in the contact, material damping, normal contact.
    pub shares: [Vec<f64>; 5],
    /// Stability of each cycle.
    pub stability: Vec<Stability>,
    /// Parameter values at which the branch turns back, in its order.
    pub folds: Vec<f64>,
    /// Parameter, frequency and amplitude of a cycle to be marked.
    pub marked: Option<[f64; 3]>,
}

/// Branches over one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchCurves {
    /// Title of the parameter's axis in mark-up, with the unit.
    pub parameter_title: String,
    /// The branches.
    pub curves: Vec<BranchCurve>,
    /// Frequencies of the eigenvalue analysis drawn as lines.
    pub references: Vec<ReferenceFrequency>,
}

/// A point of a curve: part `weight` of the way from cycle `before` to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    value: f64,
    before: usize,
    weight: f64,
}

impl Place {
    fn of(&self, ys: &[f64]) -> f64 {
        let next = ys[(self.before + 1).min(ys.len() - 1)];
        ys[self.before] + self.weight * (next - ys[self.before])
    }
}

impl BranchCurve {
    fn check(&self) -> Result<(), FigureError> {
        let count = self.values.len();
        let series = [&self.frequency_hz, &self.amplitude].into_iter();
        for values in series.chain(&self.status).chain(&self.shares) {
            expect_length("branch of limit cycles", values.len(), count)?;
        }
        expect_length("stability of limit cycles", self.stability.len(), count)
    }

    /// Where the folds lie, and whether the curve is seen to turn there: it then meets the same value before and after.
    ///
    /// A branch that turns twice between two cycles goes on as if it had not; its folds are placed on the line.
    fn fold_places(&self) -> Vec<(Place, bool)> {
        let mut left = self.folds.clone();
        let mut places = Vec::new();
        let count = self.values.len();
        for before in 0..count.saturating_sub(1) {
            let value = self.values[before];
            if value != self.values[before + 1] {
                continue;
            }
            let distance = |i: &usize| (left[*i] - value).abs();
            let nearest = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(nearest) = nearest {
                let value = left.remove(nearest);
                places.push((
                    Place {
                        value,
                        before,
                        weight: 0.5,
                    },
                    true,
                ));
            }
        }
        for value in left {
            let outside = |i: &usize| {
                let (a, b) = (self.values[*i], self.values[*i + 1]);
                (a.min(b) - value).max(value - a.max(b)).max(0.0)
            };
            let nearest =
                (0..count.saturating_sub(1)).min_by(|a, b| outside(a).total_cmp(&outside(b)));
            if let Some(before) = nearest {
                let (from, to) = (self.values[before], self.values[before + 1]);
                let weight = ((value - from) / (to - from)).clamp(0.0, 1.0);
                places.push((
                    Place {
                        value,
                        before,
                        weight,
                    },
                    false,
                ));
            }
        }
        places
    }

    /// The curve's points, each with the stability of the piece after it.
    fn places(&self) -> Vec<(Place, Stability)> {
        let folds = self.fold_places();
        let mut places = Vec::new();
        for before in 0..self.values.len() {
            let value = self.values[before];
            let stability = self.piece(before);
            places.push((
                Place {
                    value,
                    before,
                    weight: 0.0,
                },
                stability,
            ));
            let turn = folds
                .iter()
                .find(|(place, turns)| *turns && place.before == before);
            places.extend(turn.map(|(place, _)| (*place, stability)));
        }
        places
    }

    /// Stability between a cycle and the next: known where both agree.
    fn piece(&self, before: usize) -> Stability {
        let next = (before + 1).min(self.stability.len() - 1);
        let (a, b) = (self.stability[before], self.stability[next]);
        if a == b { a } else { Stability::Unknown }
    }

    /// Draws one quantity along the branch: stable pieces strong, unstable ones dashed, others plain.
    pub(super) fn draw(&self, svg: &mut Svg, panel: &Panel, ys: &[f64], factor: f64, colour: &str) {
        let places = self.places();
        let mut start = 0;
        while start + 1 < places.len() {
            let stability = places[start].1;
            let mut end = start + 1;
            while end + 1 < places.len() && places[end].1 == stability {
                end += 1;
            }
            let piece = &places[start..=end];
            let xs: Vec<f64> = piece.iter().map(|(place, _)| place.value).collect();
            let ys: Vec<f64> = piece
                .iter()
                .map(|(place, _)| factor * place.of(ys))
                .collect();
            panel.curve(svg, &xs, &ys, &stroke(stability, colour));
            start = end;
        }
    }

    /// Diamonds where the branch turns back.
    pub(super) fn draw_folds(
        &self,
        svg: &mut Svg,
        panel: &Panel,
        ys: &[f64],
        factor: f64,
        colour: &str,
    ) {
        let folds = self.fold_places().into_iter();
        let points = folds.map(|(place, _)| (place.value, factor * place.of(ys)));
        panel.points(svg, points, Marker::Diamond, 1.9, colour);
    }
}

fn stroke(stability: Stability, colour: &str) -> Stroke<'_> {
    match stability {
        Stability::Unknown => Stroke::solid(colour, 0.9),
        Stability::Stable => Stroke::solid(colour, 1.6),
        Stability::Unstable => Stroke::dashed(colour, 0.9),
    }
}

/// The parameter's axis, once the arrays are known to fit together.
pub(super) fn parameter_axis(data: &BranchCurves) -> Result<Axis, FigureError> {
    expect_some("branches", data.curves.len())?;
    for curve in &data.curves {
        curve.check()?;
        expect_some(
            "second cycle of a branch",
            curve.values.len().saturating_sub(1),
        )?;
    }
    let values = data
        .curves
        .iter()
        .flat_map(|curve| curve.values.iter().copied());
    let (low, high) = extremes(values);
    // More than a decade shows on a logarithmic axis only.
    Ok(if low > 0.0 && high > 10.0 * low {
        Axis::logarithmic(&data.parameter_title, low * 0.9, high * 1.1)
    } else {
        Axis::around(&data.parameter_title, [low, high])
    })
}

/// Legend entries for what a line's dash and the mark of a fold mean, where the branches have them.
pub(super) fn style_entries(data: &BranchCurves, fold: Key) -> Vec<(Key, String)> {
    let has = |wanted| {
        data.curves
            .iter()
            .any(|curve| curve.stability.contains(&wanted))
    };
    let line = |stability| {
        let Stroke {
            colour,
            width,
            dash,
            ..
        } = stroke(stability, INK);
        Key::Line(colour.into(), width, dash.to_vec())
    };
    let mut entries = Vec::new();
    if has(Stability::Stable) {
        entries.push((line(Stability::Stable), "stable".to_string()));
    }
    if has(Stability::Unstable) {
        entries.push((line(Stability::Unstable), "unstable".into()));
    }
    if data.curves.iter().any(|curve| !curve.folds.is_empty()) {
        entries.push((fold, "fold".into()));
    }
    entries
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(values: &[f64], folds: &[f64]) -> BranchCurve {
        BranchCurve {
            values: values.to_vec(),
            folds: folds.to_vec(),
            stability: vec![Stability::Unknown; values.len()],
            ..BranchCurve::default()
        }
    }

    #[test]
    fn a_curve_turns_at_the_fold_beyond_its_last_cycle() {
        let found = curve(&[1.0, 2.0, 2.0, 1.0], &[2.4]).places();
        let values: Vec<f64> = found.iter().map(|(place, _)| place.value).collect();
        assert_eq!(values, [1.0, 2.0, 2.4, 2.0, 1.0]);
        assert_eq!(found[2].0.of(&[0.0, 10.0, 20.0, 30.0]), 15.0);
    }

    #[test]
    fn folds_between_two_cycles_lie_on_the_line_between_them() {
        let found = curve(&[1.0, 2.0, 4.0], &[3.5, 3.0]).fold_places();
        let ordinates: Vec<f64> = found
            .iter()
            .map(|(place, _)| place.of(&[0.0, 10.0, 20.0]))
            .collect();
        assert_eq!(ordinates, [17.5, 15.0]);
        assert!(found.iter().all(|(_, turns)| !turns));
    }

    #[test]
    fn a_piece_is_stable_only_between_two_stable_cycles() {
        let mut curve = curve(&[1.0, 2.0, 3.0], &[]);
        curve.stability = vec![Stability::Stable, Stability::Stable, Stability::Unstable];
        assert_eq!(curve.piece(0), Stability::Stable);
        assert_eq!(curve.piece(1), Stability::Unknown);
    }
}
