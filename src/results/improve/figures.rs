//! `figures/improve-mode-N`: where each kind of modification feeds or damps a mode, with the candidates.

use super::{ImproveSummary, TargetFields};
use crate::chart::{
    Axis, ChartError, ColourMap, Figure, INK, Marker, Panel, Points, Side, significant,
};
use crate::mesh::Mesh;
use crate::results::charts::{Disc, SolidView};
use crate::results::drawing::{Declaration, declared};
use std::f64::consts::PI;

/// Targets that have a figure, the fastest first.
const MOST: usize = 4;

/// A figure for each target, the fastest first.
pub fn figures(
    summary: &ImproveSummary,
    mesh: &Mesh,
    fields: &[TargetFields],
) -> Result<Vec<Figure>, ChartError> {
    let growth = |own: &TargetFields| {
        let modes = summary.modes.iter();
        let rate = modes.filter(|mode| mode.mode == own.mode);
        rate.map(|mode| mode.growth_rate_per_s).fold(0.0, f64::max)
    };
    let mut order: Vec<&TargetFields> = fields.iter().collect();
    crate::order::sort_by_number(&mut order, |a| -growth(a));
    let declare = |own: &'_ TargetFields| -> Declaration<'_> {
        let own = own.clone();
        Box::new(move || target_figure(summary, mesh, &own))
    };
    declared(order.into_iter().take(MOST).map(declare).collect())
}

/// The derivatives of one growth rate over the body, a panel for each kind of modification.
fn target_figure(
    summary: &ImproveSummary,
    mesh: &Mesh,
    own: &TargetFields,
) -> Result<Figure, ChartError> {
    let sizes = &summary.sizes;
    let unit = |unit: &str| summary.extent.unit(unit);
    let radius = sizes.patch_radius_m;
    let patch = match mesh.dimension {
        2 => PI * radius.powi(2),
        _ => 4.0 / 3.0 * PI * radius.powi(3),
    };
    let text =
        |what: &str, size: f64, unit: &str| format!("{what}, {} {unit}", significant(size, 3));
    let (removal, damping) = (nodal(mesh, &own.removal), nodal(mesh, &own.damping));
    let panels = [
        ("mass", text("mass", sizes.mass_kg, &unit("kg")), sizes.mass_kg, &own.mass),
        (
            "spring",
            text("spring to the ground", sizes.stiffness_n_per_m, &unit("N/m")),
            sizes.stiffness_n_per_m,
            &own.spring,
        ),
        (
            "dashpot",
            text("dashpot to the ground", sizes.damping_n_s_per_m, &unit("N s/m")),
            sizes.damping_n_s_per_m,
            &own.dashpot,
        ),
        ("removal", text("removal within", radius, "m"), patch, &removal),
        (
            "damping",
            text("damping layer within", radius, "m"),
            patch * sizes.patch_damping_s,
            &damping,
        ),
    ];
    let panels = panels.map(|(kind, caption, size, values)| {
        let axis = Axis::new("change of growth, first order", "1/s").symmetric();
        let values: Vec<f64> = values.iter().map(|value| size * value).collect();
        let values = values.as_slice();
        let panel = match mesh.dimension {
            2 => plane_panel(mesh, values, axis),
            _ => solid_panel(mesh, values, axis),
        };
        let candidates = summary.candidates.iter().filter(|own| own.kind == kind);
        let places: Vec<(f64, f64)> =
            candidates.map(|own| (own.position_m[0], own.position_m[1])).collect();
        let panel = panel.caption(caption).height(150.0).colour_bar(Side::Right);
        match mesh.dimension {
            2 if !places.is_empty() => {
                panel.layer(Points::new(places).marker(Marker::Circle, 3.0, INK))
            }
            _ => panel,
        }
    });
    let caption = format!(
        "Change of the growth rate of mode {} ({:.1} Hz) at friction {} by a modification at each \
         place, to first order. Blue damps the mode, red feeds it; circles are the candidates.",
        own.mode, own.frequency_hz, summary.friction_coefficient
    );
    let name = format!("improve-mode-{}", own.mode);
    Ok(Figure::new(name, caption).columns(2).panels(panels))
}

fn plane_panel(mesh: &Mesh, values: &[f64], axis: Axis) -> Panel {
    let disc = Disc::new(mesh);
    disc.panel(0.03).layer(disc.field(values.to_vec(), axis, ColourMap::Diverging))
}

fn solid_panel(mesh: &Mesh, values: &[f64], axis: Axis) -> Panel {
    let view = SolidView::new(mesh);
    let surface = view.surface(values.to_vec(), (&[], 0.0), axis, ColourMap::Diverging);
    Panel::plane(surface.window(0.04)).layer(surface)
}

/// Means at the nodes of values in the elements around them.
fn nodal(mesh: &Mesh, values: &[f64]) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; mesh.node_count()];
    for (element, value) in values.iter().enumerate() {
        for &node in mesh.element_nodes(element) {
            sums[node as usize][0] += value;
            sums[node as usize][1] += 1.0;
        }
    }
    sums.into_iter().map(|[sum, count]: [f64; 2]| sum / count.max(1.0)).collect()
}
