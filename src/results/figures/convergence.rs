//! Errors over a resolution, both axes logarithmic, with the observed order.

use super::axis::{Axis, extremes, signed};
use super::colour::{MUTED, SERIES};
use super::legend::{self, Key};
use super::panel::{MARKERS, Panel};
use super::svg::{Rect, SINGLE_COLUMN, Stroke, Svg};
use super::{FigureError, expect_length, expect_some};

/// Errors of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergenceSeries {
    /// Name in mark-up.
    pub name: String,
    /// Resolutions (element size, time step), positive.
    pub sizes: Vec<f64>,
    /// Errors, positive.
    pub errors: Vec<f64>,
}

/// A convergence study.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergenceStudy {
    /// Title of the horizontal axis, with unit.
    pub size_title: String,
    /// Title of the vertical axis, with unit.
    pub error_title: String,
    /// The quantities.
    pub series: Vec<ConvergenceSeries>,
}

/// Slope of `ln(errors)` over `ln(sizes)` by least squares, and its intercept; `None` below two
/// points or with one size alone.
pub fn observed_order(sizes: &[f64], errors: &[f64]) -> Option<(f64, f64)> {
    let points: Vec<(f64, f64)> = sizes
        .iter()
        .zip(errors)
        .filter(|&(&h, &e)| h > 0.0 && e > 0.0)
        .map(|(h, e)| (h.ln(), e.ln()))
        .collect();
    let count = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = points.iter().map(|p| p.1).sum::<f64>() / count;
    let square: f64 = points.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let product: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    (square > 0.0).then(|| (product / square, mean_y - product / square * mean_x))
}

/// Draws the errors with their fitted lines; the legend gives each slope.
///
/// # Errors
/// [`FigureError`] if there is nothing to draw or arrays do not fit together.
pub fn draw_convergence(data: &ConvergenceStudy) -> Result<String, FigureError> {
    expect_some("convergence study", data.series.len())?;
    for series in &data.series {
        expect_some("sizes", series.sizes.len())?;
        expect_length("errors", series.errors.len(), series.sizes.len())?;
    }
    let all = |pick: fn(&ConvergenceSeries) -> &Vec<f64>| {
        extremes(
            data.series
                .iter()
                .flat_map(|s| pick(s).iter().copied())
                .filter(|&v| v > 0.0),
        )
    };
    let (sizes, errors) = (all(|s| &s.sizes), all(|s| &s.errors));
    let entries: Vec<(Key, String)> = data
        .series
        .iter()
        .enumerate()
        .map(|(index, series)| {
            let slope = observed_order(&series.sizes, &series.errors)
                .map_or(String::new(), |(slope, _)| {
                    format!(", slope {}", signed(slope, 2))
                });
            let key = Key::Point(MARKERS[index % 4], SERIES[index % 7].into());
            (key, format!("{}{slope}", series.name))
        })
        .collect();
    let width = SINGLE_COLUMN;
    let mut svg = Svg::new("convergence", width, 100.0);
    let top = 6.0 + legend::legend_height(&entries, width - 10.0);
    legend::draw_legend(&mut svg, 8.0, 2.0, width - 10.0, &entries);
    let y = Axis::logarithmic(&data.error_title, errors.0 / 1.6, errors.1 * 1.6);
    let x = Axis::logarithmic(&data.size_title, sizes.0 / 1.25, sizes.1 * 1.25);
    let left = Panel::left_margin(&y, 150.0);
    // A label may stand at the very end of the axis.
    let area = Rect::new(left, top, width - left - 16.0, 150.0);
    let panel = Panel::new(area, x, y);
    panel.draw_ground(&mut svg);
    for (index, series) in data.series.iter().enumerate() {
        let colour = SERIES[index % 7];
        if let Some((slope, intercept)) = observed_order(&series.sizes, &series.errors) {
            let (from, to) = extremes(series.sizes.iter().copied().filter(|&v| v > 0.0));
            let fit = [from, to].map(|h| (intercept + slope * h.ln()).exp());
            svg.begin_clip(&panel.area);
            panel.curve(&mut svg, &[from, to], &fit, &Stroke::dashed(MUTED, 0.7));
            svg.end_group();
        }
        let points = series
            .sizes
            .iter()
            .copied()
            .zip(series.errors.iter().copied());
        panel.points(
            &mut svg,
            points.filter(|p| p.1 > 0.0),
            MARKERS[index % 4],
            2.2,
            colour,
        );
    }
    panel.draw_frame(&mut svg);
    svg.set_height(top + 150.0 + Panel::bottom_margin());
    Ok(svg.finish(
        "Convergence",
        "Errors over resolution on logarithmic axes; dashed lines are least-squares fits.",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn observed_order_of_a_power_law_is_its_exponent() {
        let sizes = [1.0, 0.5, 0.25, 0.125];
        let errors = sizes.map(|h: f64| 3.0 * h.powf(1.7));
        let (order, intercept) = observed_order(&sizes, &errors).unwrap();
        assert!((order - 1.7).abs() < 1e-12 && (intercept.exp() - 3.0).abs() < 1e-12);
        assert_eq!(observed_order(&[1.0], &[1.0]), None);
    }
}
