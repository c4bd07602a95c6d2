//! Thinning of long series for drawing.

use super::svg::POINTS_PER_MM;

/// Columns for each point of width to which series are thinned (200 dots per inch, as the images have).
pub(super) const COLUMNS_PER_POINT: f64 = 200.0 / 72.0;

/// Deviation that no reader sees, points.
pub(super) const INVISIBLE: f64 = 0.03;

/// Width of the widest drawing, mm.
pub const WIDEST: f64 = 420.0;

/// Columns to which series are thinned for keeps, four for each one of the widest drawing: no eye tells it from the
/// whole.
const FINEST: f64 = 4.0 * WIDEST * POINTS_PER_MM * COLUMNS_PER_POINT;

/// Places of the samples that drawings of any width need: all, or of a series so long that most samples have no column
/// of their own those of [`keep_extremes`]. `fraction_of` is the place of an abscissa along its axis.
pub(super) fn lasting(xs: &[f64], ys: &[f64], fraction_of: &dyn Fn(f64) -> f64) -> Vec<usize> {
    match xs.len() as f64 > 4.0 * FINEST {
        true => kept(xs, ys, |x| FINEST * fraction_of(x)),
        false => (0..xs.len()).collect(),
    }
}

/// Thins a series with rising abscissae to at most four points for each column of a drawing, and
/// keeps the first, lowest, highest and last value of each column, so no extreme is lost.
///
/// `column_of` maps an abscissa to its column. Values that are not finite break the line: they come
/// out once as `NaN`.
pub fn keep_extremes(
    abscissae: &[f64],
    values: &[f64],
    column_of: impl Fn(f64) -> f64,
) -> Vec<(f64, f64)> {
    let gap = |value: f64| if value.is_finite() { value } else { f64::NAN };
    let kept = kept(abscissae, values, column_of).into_iter();
    kept.map(|at| (abscissae[at], gap(values[at]))).collect()
}

/// Places of the samples that [`keep_extremes`] keeps.
fn kept(abscissae: &[f64], values: &[f64], column_of: impl Fn(f64) -> f64) -> Vec<usize> {
    let mut out = Vec::new();
    let count = abscissae.len().min(values.len());
    let mut start = 0;
    while start < count {
        if !values[start].is_finite() {
            out.push(start);
            start += 1;
            continue;
        }
        let column = column_of(abscissae[start]).floor();
        let (mut end, mut lowest, mut highest) = (start, start, start);
        while end < count && values[end].is_finite() && column_of(abscissae[end]).floor() == column
        {
            if values[end] < values[lowest] {
                lowest = end;
            }
            if values[end] > values[highest] {
                highest = end;
            }
            end += 1;
        }
        // An abscissa that is not finite never equals its own column.
        end = end.max(start + 1);
        let mut kept = [start, lowest, highest, end - 1];
        kept.sort_unstable();
        out.extend(kept);
        start = end;
    }
    out.dedup();
    out
}

/// Drops points of a curve that lie within `tolerance` of the line through the points kept
/// (Douglas and Peucker's rule), in drawing units.
pub fn simplify(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut keep = vec![false; points.len()];
    // Blocks bound the cost on long, tightly wound curves.
    const BLOCK: usize = 256;
    let mut stack: Vec<(usize, usize)> = (0..points.len() - 1)
        .step_by(BLOCK)
        .map(|start| (start, (start + BLOCK).min(points.len() - 1)))
        .collect();
    for &(start, end) in &stack {
        keep[start] = true;
        keep[end] = true;
    }
    while let Some((start, end)) = stack.pop() {
        let farthest = (start + 1..end)
            .map(|index| (index, distance(points[index], points[start], points[end])))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((index, deviation)) = farthest
            && deviation > tolerance
        {
            keep[index] = true;
            stack.push((start, index));
            stack.push((index, end));
        }
    }
    points.iter().zip(&keep).filter_map(|(&point, &kept)| kept.then_some(point)).collect()
}

/// Distance of a point from a segment.
fn distance(point: (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (px, py) = (point.0 - from.0, point.1 - from.1);
    let square = dx * dx + dy * dy;
    let along = if square > 0.0 { ((px * dx + py * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    (px - along * dx).hypot(py - along * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimation_keeps_every_extreme_of_every_column() {
        let n = 100_000;
        let times: Vec<f64> = (0..n).map(|i| i as f64 / n as f64).collect();
        let mut values: Vec<f64> = times.iter().map(|t| (9000.0 * t).sin()).collect();
        values[54_321] = 7.0;
        values[54_400] = -6.0;
        let kept = keep_extremes(&times, &values, |t| t * 500.0);
        assert!(kept.len() <= 4 * 500);
        for column in 0..500 {
            let inside = |t: f64| (t * 500.0).floor() == f64::from(column);
            let range = |pairs: &mut dyn Iterator<Item = (f64, f64)>| {
                super::super::extremes(pairs.filter(|p| inside(p.0)).map(|p| p.1))
            };
            let full = range(&mut times.iter().copied().zip(values.iter().copied()));
            assert_eq!(full, range(&mut kept.iter().copied()));
        }
    }

    #[test]
    fn gaps_in_the_data_break_the_line() {
        let kept = keep_extremes(&[0.0, 1.0, 2.0], &[1.0, f64::NAN, 3.0], |t| t);
        assert_eq!(kept.len(), 3);
        assert!(kept[1].1.is_nan());
    }

    #[test]
    fn simplification_stays_within_its_tolerance() {
        let circle: Vec<(f64, f64)> = (0..=2000)
            .map(|i| (f64::from(i) * 0.01).sin_cos())
            .map(|(s, c)| (100.0 * c, 100.0 * s))
            .collect();
        let kept = simplify(&circle, 0.1);
        assert!(kept.len() < 500);
        for &point in &circle {
            let nearest = kept
                .windows(2)
                .map(|pair| distance(point, pair[0], pair[1]))
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.1 + 1e-9);
        }
    }
}
