//! Critical friction over a second parameter.

use super::axis::{Axis, Scale, extremes};
use super::colour::{SERIES, STABLE};
use super::legend::{self, Key};
use super::panel::{MARKERS, Panel};
use super::svg::{Rect, SINGLE_COLUMN, Stroke, Svg};
use super::text::TextStyle;
use super::{FigureError, expect_length, expect_some};

/// Where each branch turns unstable, over a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalFriction {
    /// Title of the parameter with its unit, in mark-up.
    pub parameter_title: String,
    /// Scale of the parameter.
    pub scale: Scale,
    /// Rising values of the parameter.
    pub values: Vec<f64>,
    /// Largest friction coefficient studied.
    pub highest_friction: f64,
    /// Name of each branch and its critical friction at each value; `NaN` where it stays stable.
    pub branches: Vec<(String, Vec<f64>)>,
}

/// Draws the critical friction of each branch; below all of them steady sliding is stable.
///
/// # Errors
/// [`FigureError`] with fewer than two values or arrays that do not fit together.
pub fn draw_critical_friction(data: &CriticalFriction) -> Result<String, FigureError> {
    expect_some(
        "second parameter value",
        data.values.len().saturating_sub(1),
    )?;
    for (name, critical) in &data.branches {
        expect_length(name, critical.len(), data.values.len())?;
    }
    let entries: Vec<(Key, String)> = data
        .branches
        .iter()
        .enumerate()
        .map(|(index, (name, _))| {
            let key = Key::Point(MARKERS[index % 4], SERIES[index % 7].into());
            (key, name.clone())
        })
        .collect();
    let (low, high) = extremes(data.values.iter().copied());
    let x = match data.scale {
        Scale::Linear => Axis::linear(&data.parameter_title, low, high),
        Scale::Logarithmic => Axis::logarithmic(&data.parameter_title, low, high),
    };
    let y = Axis::linear("friction coefficient *μ* (–)", 0.0, data.highest_friction);
    let width = SINGLE_COLUMN;
    let mut svg = Svg::new("critical-friction", width, 100.0);
    legend::draw_legend(&mut svg, 8.0, 2.0, width - 10.0, &entries);
    let top = 8.0 + legend::legend_height(&entries, width - 10.0);
    let left = Panel::left_margin(&y, 150.0);
    let area = Rect::new(left, top, width - left - 12.0, 150.0);
    let panel = Panel::new(area, x, y);
    panel.draw_ground(&mut svg);
    let lowest: Vec<f64> = (0..data.values.len())
        .map(|i| {
            let all = data.branches.iter().map(|(_, critical)| critical[i]);
            all.fold(data.highest_friction, f64::min)
        })
        .collect();
    svg.begin_clip(&panel.area);
    panel.fill_to(&mut svg, &data.values, &lowest, 0.0, STABLE, 0.15);
    for (index, (_, critical)) in data.branches.iter().enumerate() {
        let colour = SERIES[index % 7];
        panel.series(
            &mut svg,
            &data.values,
            critical,
            &Stroke::solid(colour, 0.9),
        );
        let points = data.values.iter().copied().zip(critical.iter().copied());
        panel.points(&mut svg, points, MARKERS[index % 4], 1.8, colour);
    }
    svg.end_group();
    panel.draw_frame(&mut svg);
    let style = TextStyle::new(6.75).with_halo();
    svg.text(area.x + 5.0, area.bottom() - 5.0, "stable", &style);
    svg.set_height(area.bottom() + Panel::bottom_margin());
    Ok(svg.finish(
        "Critical friction over a parameter",
        "One line for each branch that turns unstable; steady sliding is stable below all of them.",
    ))
}
