//! `figures/improve-mode-N`: where each kind of modification feeds or damps a mode, with the candidates.

use super::{ImproveSummary, Improvement, Sizes, TargetFields};
use crate::charts::{Disc, SolidView};
use crate::drawing::{Declaration, declared};
use crate::sorted;
use frictionsim_chart::{Axis, ColourMap, Figure, INK, Marker, Points, Side, significant};
use frictionsim_physics::mesh::Mesh;
use std::f64::consts::PI;

/// Targets that have a figure, the fastest first.
const MOST: usize = 4;

/// A figure for each target, the fastest first.
pub fn figures(found: &Improvement) -> Vec<Figure> {
    let order = sorted(&found.fields, |own| -own.mode.growth_rate_per_s).into_iter();
    let figures = order.take(MOST).map(|own| -> Declaration<'_> {
        Box::new(move || Some(target_figure(&found.summary, &found.mesh, own)))
    });
    declared(figures.collect())
}

/// The derivatives of one growth rate over the body, a panel for each kind of modification.
fn target_figure(summary: &ImproveSummary, mesh: &Mesh, own: &TargetFields) -> Figure {
    let Sizes { mass_kg, stiffness_n_per_m, damping_n_s_per_m, patch_radius_m: radius, .. } =
        summary.sizes;
    let unit = |unit: &str| summary.extent.unit(unit);
    let patch = match mesh.dimension {
        2 => PI * radius.powi(2),
        _ => 4.0 / 3.0 * PI * radius.powi(3),
    };
    let damped = patch * summary.sizes.patch_damping_s;
    let text =
        |what: &str, size: f64, unit: &str| format!("{what} {} {unit}", significant(size, 3));
    let mass = text("mass of", mass_kg, &unit("kg"));
    let spring = text("spring to the ground of", stiffness_n_per_m, &unit("N/m"));
    let dashpot = text("dashpot to the ground of", damping_n_s_per_m, &unit("N s/m"));
    let (removal, damping) = (nodal(mesh, &own.removal), nodal(mesh, &own.damping));
    let panels = [
        ("mass", mass, mass_kg, &own.mass),
        ("spring", spring, stiffness_n_per_m, &own.spring),
        ("dashpot", dashpot, damping_n_s_per_m, &own.dashpot),
        ("removal", text("removal within", radius, "m"), patch, &removal),
        ("damping", text("damping layer within", radius, "m"), damped, &damping),
    ];
    let panels = panels.map(|(kind, caption, size, values)| {
        let axis = Axis::new("change of growth, first order", "1/s").symmetric();
        let values: Vec<f64> = values.iter().map(|value| size * value).collect();
        let candidates = summary.candidates.iter().filter(|own| own.kind == kind);
        let places: Vec<(f64, f64)> =
            candidates.map(|own| (own.position_m[0], own.position_m[1])).collect();
        let panel = match mesh.dimension {
            2 => {
                let disc = Disc::new(mesh);
                let field = disc.field(values, axis, ColourMap::Diverging);
                let circles = (!places.is_empty())
                    .then(|| Points::new(places).marker(Marker::Circle, 3.0, INK));
                disc.panel(0.03).layer(field).layers(circles)
            }
            _ => SolidView::new(mesh).panel(&values, axis, ColourMap::Diverging, 0.04),
        };
        panel.caption(caption).height(150.0).colour_bar(Side::Right)
    });
    let caption = format!(
        "Change of the growth rate of mode {} ({:.1} Hz) at friction {} by a modification at each \
         place, to first order. Blue damps the mode, red feeds it; circles are the candidates.",
        own.mode.mode, own.mode.frequency_hz, summary.friction_coefficient
    );
    let name = format!("improve-mode-{}", own.mode.mode);
    Figure::new(name, caption).columns(2).panels(panels)
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
