//! Stability over two parameters.

use super::axis::{Axis, Scale, extremes};
use super::colour::{ColourMap, INK};
use super::legend;
use super::panel::Panel;
use super::raster::{FINE, level_of};
use super::svg::{Path, Rect, SINGLE_COLUMN, Stroke, Svg};
use super::{FigureError, expect_length, expect_some};

/// Largest growth rate over a grid of two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilityMap {
    /// Title of the horizontal axis, with unit.
    pub x_title: String,
    /// Rising values of the first parameter.
    pub x: Vec<f64>,
    /// Scale of the first parameter.
    pub x_scale: Scale,
    /// Title of the vertical axis, with unit.
    pub y_title: String,
    /// Rising values of the second parameter.
    pub y: Vec<f64>,
    /// Scale of the second parameter.
    pub y_scale: Scale,
    /// Largest real part of all eigenvalues, 1/s, first parameter fastest; `NaN` where it failed.
    pub growth_rate: Vec<f64>,
}

/// Draws the map, blue where every mode decays and red where one grows, with the boundary as a line.
///
/// # Errors
/// [`FigureError`] if the grid has fewer than two values in a direction or the array does not fit it.
pub fn draw_stability_map(data: &StabilityMap) -> Result<String, FigureError> {
    let (columns, rows) = (data.x.len(), data.y.len());
    expect_some(
        "second value of the first parameter",
        columns.saturating_sub(1),
    )?;
    expect_some(
        "second value of the second parameter",
        rows.saturating_sub(1),
    )?;
    expect_length("growth rates", data.growth_rate.len(), columns * rows)?;
    let height = 150.0;
    let mut svg = Svg::new(
        "stability-map",
        SINGLE_COLUMN,
        10.0 + height + Panel::bottom_margin(),
    );
    let [x_edges, y_edges] =
        [(&data.x, data.x_scale), (&data.y, data.y_scale)].map(|(v, s)| edges(v, s));
    let axis = |title: &str, edges: &[f64], scale: Scale| match scale {
        Scale::Linear => Axis::linear(title, edges[0], edges[edges.len() - 1]),
        Scale::Logarithmic => Axis::logarithmic(title, edges[0], edges[edges.len() - 1]),
    };
    let y = axis(&data.y_title, &y_edges, data.y_scale);
    let (low, high) = extremes(data.growth_rate.iter().copied());
    let mut reach = low.abs().max(high.abs()).max(f64::MIN_POSITIVE);
    let lesser = high.min(-low);
    // A far larger side would leave the other without colour: its colours end at the bar's end.
    if lesser > 0.0 {
        reach = reach.min(2.0 * lesser);
    }
    let left = Panel::left_margin(&y, height);
    let bar_axis = Axis::linear("largest growth rate (1/s)", -reach, reach);
    let mut bar = Rect::new(0.0, 10.0, 7.0, height);
    bar.x = SINGLE_COLUMN - legend::colour_bar_width(&bar_axis, &bar);
    let area = Rect::new(left, 10.0, bar.x - left - 7.0, height);
    let panel = Panel::new(area, axis(&data.x_title, &x_edges, data.x_scale), y);
    draw_cells(&mut svg, &panel, data, &x_edges, &y_edges, reach);
    svg.path(&boundary(&panel, data), &Stroke::solid(INK, 1.0));
    panel.draw_frame(&mut svg);
    legend::draw_colour_bar(&mut svg, &bar, &bar_axis, ColourMap::Diverging);
    Ok(svg.finish(
        "Stability map",
        "Largest growth rate over two parameters; the line separates stable from unstable.",
    ))
}

/// Cell edges half-way between grid values.
fn edges(values: &[f64], scale: Scale) -> Vec<f64> {
    let to = |value: f64| match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.ln(),
    };
    let from = |value: f64| match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.exp(),
    };
    let inner: Vec<f64> = values.iter().map(|&v| to(v)).collect();
    let last = inner.len() - 1;
    let first_edge = inner[0] - 0.5 * (inner[1] - inner[0]);
    let last_edge = inner[last] + 0.5 * (inner[last] - inner[last - 1]);
    let middle = inner.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    std::iter::once(first_edge)
        .chain(middle)
        .chain([last_edge])
        .map(from)
        .collect()
}

/// One path for each colour, so that the drawing stays small.
fn draw_cells(
    svg: &mut Svg,
    panel: &Panel,
    data: &StabilityMap,
    x_edges: &[f64],
    y_edges: &[f64],
    reach: f64,
) {
    let mut paths = vec![Path::new(); FINE + 1];
    for (index, &rate) in data.growth_rate.iter().enumerate() {
        let (column, row) = (index % data.x.len(), index / data.x.len());
        let cell = panel.cell(
            (x_edges[column], x_edges[column + 1]),
            (y_edges[row], y_edges[row + 1]),
        );
        // A slight overlap hides the seams that anti-aliasing leaves between neighbours.
        let (right, bottom) = (cell.right() + 0.15, cell.bottom() + 0.15);
        let path = &mut paths[level_of(rate, -reach, reach, FINE) as usize];
        path.move_to(cell.x, cell.y);
        path.line_to(right, cell.y);
        path.line_to(right, bottom);
        path.line_to(cell.x, bottom);
        path.close();
    }
    let colours = ColourMap::Diverging.samples(FINE);
    for (path, colour) in paths.iter().zip(&colours) {
        svg.fill_path(path, colour, 1.0);
    }
}

/// The zero line of the growth rate, by marching squares between grid points.
fn boundary(panel: &Panel, data: &StabilityMap) -> Path {
    let mut path = Path::new();
    let columns = data.x.len();
    let value = |i: usize, j: usize| data.growth_rate[j * columns + i];
    let place = |i: usize, j: usize| (panel.at_x(data.x[i]), panel.at_y(data.y[j]));
    for j in 0..data.y.len() - 1 {
        for i in 0..columns - 1 {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let mut crossings = Vec::new();
            for side in 0..4 {
                let (from, to) = (corners[side], corners[(side + 1) % 4]);
                let (a, b) = (value(from.0, from.1), value(to.0, to.1));
                if (a > 0.0) != (b > 0.0) && a.is_finite() && b.is_finite() {
                    let part = a / (a - b);
                    let (p, q) = (place(from.0, from.1), place(to.0, to.1));
                    crossings.push((p.0 + part * (q.0 - p.0), p.1 + part * (q.1 - p.1)));
                }
            }
            for pair in crossings.chunks_exact(2) {
                path.move_to(pair[0].0, pair[0].1);
                path.line_to(pair[1].0, pair[1].1);
            }
        }
    }
    path
}
