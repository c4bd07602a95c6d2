//! Critical friction over a second parameter.

use super::palette::STABLE;
use crate::chart::{Axis, Figure, Fill, Label, Line, Panel, Scale, look};
use crate::results::parameter::parameter_axis;

/// Harmonic or nodal diameters, of a body that has them; branch; direction.
pub type BranchName = (Option<usize>, usize, i8);

/// A branch that turns unstable, and its critical friction at each value of a parameter; `NaN` where it stays stable.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalBranch {
    /// Its name.
    pub branch: BranchName,
    /// Critical friction.
    pub critical: Vec<f64>,
}

/// The critical friction of each branch over a case key; below all of them steady sliding is stable.
pub fn critical_friction(
    key: &str,
    values: &[f64],
    branches: &[CriticalBranch],
    highest: f64,
) -> Figure {
    let lowest = |i: usize| {
        let all = branches.iter().map(|branch| branch.critical[i]);
        all.fold(highest, f64::min)
    };
    let lowest: Vec<f64> = (0..values.len()).map(lowest).collect();
    let scale = Scale::for_values(values.iter().copied(), 10.0);
    let x = parameter_axis(key).scaled(scale).tight();
    let lines = branches.iter().enumerate().map(|(index, branch)| {
        let (n, number, direction) = branch.branch;
        let way = match direction {
            1.. => " ↺",
            0 => "",
            ..0 => " ↻",
        };
        let line = Line::new(values, &branch.critical).nth(index).marked(look(index).1, 1.8);
        let harmonic = n.map_or(String::new(), |n| format!("*n* = {n}, "));
        line.name(format!("{harmonic}branch {number}{way}"))
    });
    let corner = values.first().map(|&first| (first, 0.0));
    let panel = Panel::new(x, Axis::friction().between(0.0, highest))
        .height(150.0)
        .layer(Fill::from(0.0, values, &lowest, STABLE).opacity(0.15))
        .layers(lines)
        .layers(corner.map(|corner| Label::new(corner, "stable").moved(5.0, -5.0)));
    Figure::new(
        "critical-friction",
        format!("Critical friction of each branch over {key}; steady sliding is stable below all of them."),
    )
    .narrow()
    .panel(panel)
}
