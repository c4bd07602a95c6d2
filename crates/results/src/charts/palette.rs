//! Meaning of each colour, the same in every figure.

use frictionsim_chart::{Anchor, Key, Shapes, TextStyle};
use frictionsim_physics::contact::ContactStatus;

/// Nodes that stick.
pub const STICK: &str = "#0072b2";
/// Nodes that slip.
pub const SLIP: &str = "#e69f00";
/// Nodes without contact.
pub const OPEN: &str = "#d9d9d9";
/// Stable modes.
pub const STABLE: &str = "#0072b2";
/// Unstable modes; frequencies and rates of the eigenvalue analysis drawn over a transient.
pub const UNSTABLE: &str = "#d55e00";

/// Power from the drive.
pub const EXTERNAL_POWER: &str = "#000000";
/// Power given to the body by sticking nodes.
pub const STICK_POWER: &str = STICK;
/// Power given to the body by sliding nodes.
pub const SLIDE_POWER: &str = SLIP;
/// Power dissipated at the contact.
pub const CONTACT_DISSIPATION: &str = "#d55e00";
/// Power dissipated by the material damping.
pub const MATERIAL_DISSIPATION: &str = "#009e73";
/// Power of the normal contact forces.
pub const NORMAL_POWER: &str = "#cc79a7";

/// The states in the order of every legend, each with name, colour of areas, tint of grounds under curves, colour of
/// lines.
pub static STATUSES: [Entry; 3] = [
    (ContactStatus::Stick, "stick", STICK, "#cce3f0", STICK),
    (ContactStatus::Slip, "slip", SLIP, "#faeccc", SLIP),
    (ContactStatus::Open, "open", OPEN, "#f2f2f2", "#8c8c8c"),
];

type Entry = (ContactStatus, &'static str, &'static str, &'static str, &'static str);

fn entry(status: ContactStatus) -> &'static Entry {
    STATUSES.iter().find(|entry| entry.0 == status).unwrap_or(&STATUSES[2])
}

/// The status of a code: 0 open, 1 stick, 2 slip.
pub fn status_of_code(code: u8) -> ContactStatus {
    match code {
        1 => ContactStatus::Stick,
        2 => ContactStatus::Slip,
        _ => ContactStatus::Open,
    }
}

/// Legend entries of the states as areas.
pub fn status_keys() -> Vec<(Key, String)> {
    let key = |entry: &Entry| (Key::patch(entry.2, 1.0), entry.1.to_owned());
    STATUSES.iter().map(key).collect()
}

/// Colour of lines in a status: open contact is darker than its areas.
pub fn line_colour(status: ContactStatus) -> &'static str {
    entry(status).4
}

/// Where a status begins and ends, run by run.
pub fn status_runs(
    status: &[ContactStatus],
) -> impl Iterator<Item = (ContactStatus, usize, usize)> {
    let mut end = 0;
    status.chunk_by(|a, b| a == b).map(move |run| {
        let start = end;
        end += run.len();
        (run[0], start, end)
    })
}

/// The ground of a panel coloured by status: sample `i` from abscissa `edge(i)` to `edge(i + 1)`; named in the legend.
pub fn status_ground(status: &[ContactStatus], edge: impl Fn(usize) -> f64) -> Shapes {
    let band = |(own, start, end)| (edge(start), edge(end), entry(own).3);
    named(Shapes::bands(status_runs(status).map(band).collect()), status, |s| s.3)
}

/// The ring of statuses around a hole of this radius (m), inside it; nodes evenly spaced from the angle of the first.
pub fn status_ring(radius: f64, first_angle: f64, status: &[ContactStatus]) -> Shapes {
    let step = std::f64::consts::TAU / status.len().max(1) as f64;
    let piece = |(own, start, end): (ContactStatus, usize, usize)| {
        let from = first_angle + (start as f64 - 0.5) * step;
        let to = from + (end - start) as f64 * step;
        let count = ((to - from) / 0.05).ceil().max(1.0);
        let arc = |radius: f64| -> Vec<(f64, f64)> {
            let angles = (0..=count as usize).map(|i| from + (to - from) * i as f64 / count);
            angles.map(|angle| (radius * angle.cos(), radius * angle.sin())).collect()
        };
        let back = arc(0.94 * radius).into_iter().rev();
        (arc(0.6 * radius).into_iter().chain(back).collect::<Vec<_>>(), entry(own).2)
    };
    let mut pieces: Vec<_> = status_runs(status).map(piece).collect();
    // One path for each colour.
    pieces.sort_by_key(|piece| piece.1);
    named(Shapes::polygons(pieces), status, |s| s.2)
}

fn named(shapes: Shapes, status: &[ContactStatus], colour: fn(&Entry) -> &'static str) -> Shapes {
    let present = STATUSES.iter().filter(|entry| status.contains(&entry.0));
    present.fold(shapes, |shapes, entry| shapes.name(Key::patch(colour(entry), 1.0), entry.1))
}

/// Small centred text over data.
pub fn centred(size: f64) -> TextStyle {
    TextStyle::new(size).anchored(Anchor::Middle).with_halo()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn animations_colour_statuses_as_figures_do() {
        let script = include_str!("../report/motion.js");
        let colours = [0, 1, 2].map(|code| format!("\"{}\"", line_colour(status_of_code(code))));
        let declared = format!("statusColours = [{}]", colours.join(", "));
        assert!(script.contains(&declared), "{declared}");
    }
}
