//! The figure of `mac`.

use super::{MacPair, MacSummary};
use crate::chart::{Axis, ChartError, ColourMap, Figure, Heat, INK, Marker, Panel, Points, Side};

/// The criterion over modes and shapes, pairs marked.
pub(super) fn matrix(summary: &MacSummary) -> Result<Figure, ChartError> {
    let (shapes, modes) = (summary.shapes.len(), summary.modes.len());
    let span = |count: usize| ((0.5, count as f64 + 0.5), count);
    let axis = Axis::new("modal assurance criterion", "").between(0.0, 1.0);
    let heat =
        Heat::of_values(span(modes), span(shapes), (axis, ColourMap::Viridis), |mode, shape| {
            summary.mac[shape][mode]
        });
    let pairs = summary.pairs.iter();
    let places = pairs.map(|pair: &MacPair| (pair.mode as f64, pair.shape as f64));
    let between = |count: usize| (0.5, count as f64 + 0.5);
    let ((x0, x1), (y0, y1)) = (between(modes), between(shapes));
    let panel = Panel::new(
        Axis::new("mode of the model", "").between(x0, x1),
        Axis::new("measured shape", "").between(y0, y1),
    )
    .height(150.0)
    .layer(heat)
    .layer(Points::new(places).marker(Marker::Circle, 2.6, INK))
    .colour_bar(Side::Right);
    Ok(Figure::new(
        "mac",
        "Modal assurance criterion of each measured shape with each mode; circles are the pairs.",
    )
    .panel(panel))
}
