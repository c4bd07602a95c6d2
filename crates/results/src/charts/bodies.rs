//! Fields of bodies in three dimensions at one time.

use super::solid::SolidView;
use frictionsim_chart::{Axis, ColourMap, Figure, Line, Panel, Side, literal};
use frictionsim_physics::mesh::{Mesh, SolidFace, SolidSector};

/// Values at nodes (NaN: grey) on each contact surface, seen from outside along its mean normal; `surfaces` has the
/// name and the boundary of each, `axis` is common to all. `arrows` are ends of an arrow on the surface of the same
/// place among them.
pub fn contact_surfaces(
    (name, caption): (&str, &str),
    (mesh, surfaces): (&Mesh, &[(String, usize)]),
    (values, arrows): (&[f64], &[[[f64; 3]; 2]]),
    axis: &dyn Fn() -> Axis,
) -> Figure {
    let panels = surfaces.iter().enumerate().map(|(k, (name, boundary))| {
        let view = SolidView::of_boundary(mesh, *boundary);
        let arrows = arrows.get(k).map(|ends| {
            let line = Line::through(ends.map(|end| view.at(end)));
            line.solid("black", 1.2).arrows(1)
        });
        let panel = view.panel(values.to_vec(), axis(), ColourMap::Viridis, 0.05);
        panel.caption(literal(name)).layers(arrows)
    });
    let columns = surfaces.len().clamp(1, 3);
    let figure = Figure::new(name, caption).columns(columns).panels(panels);
    figure.colour_foot(axis(), ColourMap::Viridis)
}

/// Speed over the surface of solid bodies in several frames, each a heading and a velocity field (nodal frames, m/s),
/// each picture with colours of its own.
pub fn speeds_of_bodies<'a>(
    mesh: &Mesh,
    caption: &str,
    frames: impl Iterator<Item = (String, &'a [f64])>,
) -> Figure {
    let view = SolidView::new(mesh);
    let panels = frames.map(|(heading, velocity)| {
        let speeds = velocity.chunks_exact(3);
        let speeds = speeds.map(|v| v[0].hypot(v[1]).hypot(v[2])).collect();
        let axis = Axis::new("velocity |*v*|", "m/s");
        let panel = view.panel(speeds, axis, ColourMap::Viridis, 0.04);
        panel.heading(heading).colour_bar(Side::Below)
    });
    let panels: Vec<Panel> = panels.collect();
    let columns = panels.len().clamp(1, 3);
    Figure::new("velocity", caption).columns(columns).panels(panels)
}

/// Speed of the nodes of the top face of a body of revolution, m/s, in the order of the plane section: outwards first.
pub fn speeds_on_top(sector: &SolidSector, velocity: &[f64]) -> Vec<f64> {
    let mut top: Vec<usize> =
        (0..sector.node_count()).filter(|&k| sector.is_on(k, SolidFace::Top)).collect();
    top.sort_by_key(|&k| sector.nodes[k].place[0]);
    let sheets = velocity.chunks_exact(3 * sector.node_count());
    let speed =
        |sheet: &[f64], k: usize| sheet[3 * k].hypot(sheet[3 * k + 1]).hypot(sheet[3 * k + 2]);
    sheets.flat_map(|sheet| top.iter().map(move |&k| speed(sheet, k))).collect()
}
