//! Matching of modes of the model with lines of the measurement, and of measured shapes, which are data beside
//! frequencies, with both.

use super::{FitError, MeasuredMode, ModelMode, least_cost};
use crate::mac::{MeasuredShapes, refuse_revolution};
use crate::*;
use frictionsim_signal::reader::MeasuredShape;

/// Share of a line's own frequency that it costs to be matched by nothing, or by a stable mode where the line was
/// heard: more than any difference that makes sense.
const PENALTY: f64 = 1.0;

/// Weights of one line, 1/Hz.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    pub frequency: f64,
    pub real: f64,
    /// The measured shape of the line, and what it counts without anything of the mode.
    pub shape: Option<(usize, f64)>,
}

impl Weights {
    /// What the shape of the line counts for a mode: `s w f (1 - MAC)`.
    pub fn strangeness(&self, mode: &ModelMode) -> f64 {
        let own = self.shape.and_then(|(shape, weight)| {
            let assurance = mode.assurances.get(shape)?;
            Some(weight * (1.0 - assurance))
        });
        own.unwrap_or(0.0)
    }
}

/// The mode of each line, each for one line at most, at the smallest sum of squared weighted differences, and that sum.
///
/// A line of known harmonic takes modes of that harmonic alone. A line that no mode is left for has none; it costs as
/// much as a difference of its whole frequency.
pub(super) fn assign(
    lines: &[MeasuredMode],
    weights: &[Weights],
    modes: &[ModelMode],
) -> (Vec<Option<usize>>, f64) {
    let alone =
        |line: usize| (PENALTY * weights[line].frequency * lines[line].frequency_hz).powi(2);
    // A column for each mode, and one for each line that it has to itself where it takes none.
    let costs: Vec<Vec<f64>> = (0..lines.len())
        .map(|line| {
            let of_mode = |mode: &ModelMode| cost(&lines[line], weights[line], mode);
            let mut row: Vec<f64> = modes.iter().map(of_mode).collect();
            let none = (0..lines.len()).map(|other| if other == line { 2.0 } else { 4.0 });
            row.extend(none.map(|factor| factor * alone(line)));
            row
        })
        .collect();
    let columns = least_cost(&costs);
    let total = columns.iter().zip(&costs).map(|(&column, row)| row[column]).sum();
    let matched = columns.into_iter().map(|column| (column < modes.len()).then_some(column));
    (matched.collect(), total)
}

fn cost(line: &MeasuredMode, weights: Weights, mode: &ModelMode) -> f64 {
    let [df, dr] = differences(line, mode);
    let mut cost = (weights.frequency * df).powi(2) + (weights.real * dr).powi(2);
    cost += weights.strangeness(mode).powi(2);
    let penalty = (PENALTY * weights.frequency * line.frequency_hz).powi(2);
    if line.is_unstable && mode.eigenvalue.re <= 0.0 {
        cost += penalty;
    }
    if !mode.may_be(line) {
        cost += 1e3 * penalty;
    }
    cost
}

/// Measured less computed frequency and real part, Hz; the second 0 where it was not measured.
pub(super) fn differences(line: &MeasuredMode, mode: &ModelMode) -> [f64; 2] {
    let real = line.real_hz.map_or(0.0, |real| real - mode.told.real_hz);
    [line.frequency_hz - mode.told.frequency_hz, real]
}

/// Distance of the frequency of a shape from that of its line, as a share of it.
const WITHIN: f64 = 0.02;

impl MeasuredShapes {
    /// The shape of each line: each shape goes to the line whose frequency is nearest, the nearest pairs first. Refuses
    /// a body without a whole mesh, and points off it.
    pub(super) fn of_lines(
        &self,
        case: &Case,
        lines: &[MeasuredMode],
    ) -> Result<Vec<Option<usize>>, StudyError> {
        refuse_revolution(case)?;
        let mesh = case.body.mesh()?;
        self.placed(case, &mesh)?;
        let refuse = |shape: &MeasuredShape, reason: String| {
            StudyError::from(FitError::Table(format!(
                "shape {} belongs to no line of the table: {reason}; give its frequency, within \
                 {} % of that of its line",
                shape.name,
                100.0 * WITHIN
            )))
        };
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (index, shape) in self.shapes.iter().enumerate() {
            let Some(frequency) = shape.frequency_hz else {
                return Err(refuse(shape, "it has no frequency".to_owned()));
            };
            let away = |line: &MeasuredMode| (frequency / line.frequency_hz - 1.0).abs();
            let near = lines.iter().enumerate().filter(|(_, line)| away(line) <= WITHIN);
            pairs.extend(near.map(|(place, line)| (away(line), index, place)));
        }
        let mut shape_of = vec![None; lines.len()];
        for (shape, line) in order::each_once(pairs) {
            shape_of[line] = Some(shape);
        }
        let mut shapes = self.shapes.iter().enumerate();
        match shapes.find(|(index, _)| !shape_of.contains(&Some(*index))) {
            None => Ok(shape_of),
            Some((_, shape)) => {
                let frequency = shape.frequency_hz.unwrap_or(f64::NAN);
                Err(refuse(shape, format!("no line near {frequency} Hz is without one")))
            }
        }
    }

    /// The criterion of each mode with each shape, `[mode][shape]`.
    pub(super) fn assurances(
        &self,
        case: &Case,
        modes: &[ComplexMode],
    ) -> Result<Vec<Vec<f64>>, StudyError> {
        let mesh = case.body.mesh()?;
        let placed = self.placed(case, &mesh)?;
        let matrix = self.criteria(&mesh, &Vec::from_iter(modes), &placed);
        let of = |mode: usize| matrix.iter().map(|row| row[mode]).collect();
        Ok((0..modes.len()).map(of).collect())
    }
}
