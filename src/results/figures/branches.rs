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

    /// Where the curve is seen to turn: it meets the same value before and after a fold.
    ///
    /// Where the branch turns twice between two values, the curve goes on as if it had not: such folds are narrower than
    /// the spacing of its cycles.
    fn fold_places(&self) -> Vec<Place> {
        let mut left = self.folds.clone();
        let mut places = Vec::new();
        for (before, pair) in self.values.windows(2).enumerate() {
            let distance = |i: &usize| (left[*i] - pair[0]).abs();
            let nearest = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(nearest) = nearest.filter(|_| pair[0] == pair[1]) {
                places.push(Place {
                    value: left.remove(nearest),
                    before,
                    weight: 0.5,
                });
            }
        }
        places
    }

    /// Parameter values at which the curve is seen to turn.
    pub(super) fn visible_folds(&self) -> Vec<f64> {
        self.fold_places().iter().map(|place| place.value).collect()
    }

    /// The curve's points, each with the stability of the piece after it.
    fn places(&self) -> Vec<(Place, Stability)> {
        let folds = self.fold_places();
        let mut places = Vec::new();
        for before in 0..self.values.len() {
            let value = self.values[before];
            let turn = folds.iter().find(|place| place.before == before);
            // At a fold stability changes, or does not change at all.
            let stability = match turn {
                Some(_) => self.stability[before],
                None => self.piece(before),
            };
            let place = Place {
                value,
                before,
                weight: 0.0,
            };
            places.push((place, stability));
            places.extend(turn.map(|place| (*place, self.stability[before + 1])));
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

    /// Diamonds where the curve turns back.
    pub(super) fn draw_folds(
        &self,
        svg: &mut Svg,
        panel: &Panel,
        ys: &[f64],
        factor: f64,
        colour: &str,
    ) {
        let folds = self.fold_places().into_iter();
        let points = folds.map(|place| (place.value, factor * place.of(ys)));
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
    if data
        .curves
        .iter()
        .any(|curve| !curve.visible_folds().is_empty())
    {
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
    fn folds_narrower_than_the_spacing_of_the_cycles_are_not_seen() {
        let found = curve(&[1.0, 2.0, 4.0], &[3.5, 3.0]);
        assert!(found.visible_folds().is_empty());
        assert_eq!(found.places().len(), 3);
        // Two of four folds belong to the turns, each the nearest.
        let found = curve(&[1.0, 2.0, 2.0, 1.0, 1.0, 2.0], &[1.3, 1.2, 2.3, 0.9]);
        assert_eq!(found.visible_folds(), [2.3, 0.9]);
    }

    #[test]
    fn a_piece_is_stable_only_between_two_stable_cycles_or_up_to_a_fold() {
        let mut curve = curve(&[1.0, 2.0, 3.0], &[]);
        curve.stability = vec![Stability::Stable, Stability::Stable, Stability::Unstable];
        assert_eq!(curve.piece(0), Stability::Stable);
        assert_eq!(curve.piece(1), Stability::Unknown);
        // A fold between two cycles is where stability changes.
        curve.values[2] = 2.0;
        curve.folds = vec![2.2];
        let pieces: Vec<Stability> = curve.places().iter().map(|(_, s)| *s).collect();
        let (stable, unstable) = (Stability::Stable, Stability::Unstable);
        assert_eq!(pieces[..3], [stable, stable, unstable]);
    }
}
