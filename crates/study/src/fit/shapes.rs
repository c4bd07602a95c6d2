//! Measured shapes as data beside frequencies: which line each belongs to, and what the modes have in common with it.

use super::{FitError, MeasuredMode};
use crate::StudyError;
use crate::mac::{MeasuredShapes, refuse_revolution};
use frictionsim_case::Case;
use frictionsim_physics::cea::ComplexMode;
use frictionsim_signal::reader::MeasuredShape;

/// Distance of the frequency of a shape from that of its line, as a share of it.
const WITHIN: f64 = 0.02;

impl MeasuredShapes {
    /// The shape of each line: each shape goes to the line whose frequency is nearest, the nearest pairs first.
    pub(super) fn of_lines(&self, lines: &[MeasuredMode]) -> Result<Vec<Option<usize>>, FitError> {
        let refuse = |shape: &MeasuredShape, reason: String| {
            FitError::Table(format!(
                "shape {} belongs to no line of the table: {reason}; give its frequency, within \
                 {} % of that of its line",
                shape.name,
                100.0 * WITHIN
            ))
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
        for (shape, line) in frictionsim_physics::order::each_once(pairs) {
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

    /// Refuses a body without a whole mesh, and points off it.
    pub(super) fn check(&self, case: &Case) -> Result<(), StudyError> {
        refuse_revolution(case)?;
        let mesh = case.body.mesh()?;
        self.placed(case, &mesh)?;
        Ok(())
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
