//! Contact status over angle and time, and around the circle.

use super::colour::{self, INK, STATUSES};
use super::legend::Key;
use super::panel::Panel;
use super::raster::IndexedImage;
use super::svg::{Path, Rect, Stroke, Svg};
use super::{FigureError, expect_length, expect_some};
use crate::contact::ContactStatus;

/// Status of every contact node over time.
#[derive(Clone, Copy, Debug)]
pub struct StatusHistory<'a> {
    /// Sample times, s, evenly spaced.
    pub times: &'a [f64],
    /// Contact nodes, evenly spaced around the circle from angle zero.
    pub node_count: usize,
    /// Status, sample by sample, all nodes of one sample together.
    pub status: &'a [ContactStatus],
}

/// Legend entries of the three states.
pub(super) fn status_keys() -> Vec<(Key, String)> {
    STATUSES
        .iter()
        .map(|&status| {
            let key = Key::patch(colour::of_status(status));
            (key, colour::name_of_status(status).to_string())
        })
        .collect()
}

/// Tint of a status colour light enough for curves on top.
pub(super) fn pale(status: ContactStatus) -> &'static str {
    match status {
        ContactStatus::Stick => "#cce3f0",
        ContactStatus::Slip => "#faeccc",
        ContactStatus::Open => "#f2f2f2",
    }
}

/// Colours the ground of a panel by status: sample `i` from abscissa `edge(i)` to `edge(i + 1)`.
pub(super) fn draw_status_ground(
    svg: &mut Svg,
    panel: &Panel,
    status: &[ContactStatus],
    edge: impl Fn(usize) -> f64,
) {
    let mut start = 0;
    for run in status.chunk_by(|a, b| a == b) {
        let end = start + run.len();
        let cell = panel.cell((edge(start), edge(end)), (panel.y.low, panel.y.high));
        svg.rectangle(&cell, pale(run[0]), None);
        start = end;
    }
}

/// Draws the status map into a panel whose axes are time and degrees, and returns the interval between
/// the instants shown (s) if not every sample is shown.
///
/// Where a run has more samples than the drawing has columns, single instants are shown, an interval
/// apart at which the end of the run repeats itself best: a travelling pattern then stands nearly
/// still, as under a stroboscope, and keeps its shares of stick, slip and open.
pub(super) fn draw_status_map(
    svg: &mut Svg,
    panel: &Panel,
    history: &StatusHistory,
    factor: f64,
) -> Result<Option<f64>, FigureError> {
    let (count, nodes) = (history.times.len(), history.node_count);
    expect_some("contact nodes", nodes)?;
    expect_some(
        "second sample of the contact status",
        count.saturating_sub(1),
    )?;
    expect_length("contact status", history.status.len(), count * nodes)?;
    let (low, high) = (panel.x.low / factor, panel.x.high / factor);
    let first = history
        .times
        .partition_point(|&t| t < low)
        .saturating_sub(1);
    let last = (history.times.partition_point(|&t| t <= high) + 1).min(count);
    let finest = (last - first).div_ceil((panel.area.width * 3.0) as usize);
    let stride = strobe_stride(history, finest);
    let columns = (last - first).div_ceil(stride);
    let mut image = IndexedImage {
        width: columns,
        height: nodes,
        pixels: vec![0; columns * nodes],
    };
    for column in 0..columns {
        let sample = first + column * stride;
        for node in 0..nodes {
            let status = history.status[sample * nodes + node];
            image.pixels[(nodes - 1 - node) * columns + column] = status as u8;
        }
    }
    let palette = [
        ContactStatus::Open,
        ContactStatus::Stick,
        ContactStatus::Slip,
    ]
    .map(|status| {
        let [red, green, blue] = colour::channels(colour::of_status(status));
        [red, green, blue, 255]
    });
    let hop = (history.times[count - 1] - history.times[0]) / (count - 1) as f64;
    let left = panel.at_x((history.times[first] - 0.5 * hop) * factor);
    let interval = hop * stride as f64;
    let right = panel.at_x((history.times[first] - 0.5 * hop + interval * columns as f64) * factor);
    let rect = Rect::new(left, panel.area.y, right - left, panel.area.height);
    svg.begin_clip(&panel.area);
    svg.image(&rect, &image.encode(&palette)?, true);
    svg.end_group();
    Ok((stride > 1).then_some(interval))
}

/// Fewest columns that a strobed map keeps.
const FEWEST_COLUMNS: usize = 150;

/// Samples between the instants shown: the number from `finest` up, with enough columns left, after
/// which the last fifth of the run repeats itself best.
fn strobe_stride(history: &StatusHistory, finest: usize) -> usize {
    let (count, nodes) = (history.times.len(), history.node_count);
    let start = count - count / 5;
    let coarsest = (3 * finest).max(count / FEWEST_COLUMNS);
    if finest <= 1 || start + coarsest >= count {
        return finest.max(1);
    }
    let probes: Vec<usize> = (start..count - coarsest)
        .step_by(((count - start) / 64).max(1))
        .collect();
    let agreement = |lag: usize| {
        probes
            .iter()
            .map(|&sample| {
                let now = &history.status[sample * nodes..(sample + 1) * nodes];
                let then = &history.status[(sample + lag) * nodes..(sample + lag + 1) * nodes];
                now.iter().zip(then).filter(|(a, b)| a == b).count()
            })
            .sum::<usize>()
    };
    // The shortest of equals: a uniform state needs no strobe.
    (finest..=coarsest)
        .max_by_key(|&lag| (agreement(lag), std::cmp::Reverse(lag)))
        .unwrap_or(finest)
}

/// Draws the status of all contact nodes as a coloured ring between two radii (points).
pub(super) fn draw_status_ring(
    svg: &mut Svg,
    centre: (f64, f64),
    radii: (f64, f64),
    angles: &[f64],
    status: &[ContactStatus],
) {
    let count = angles.len().min(status.len());
    let mut paths = [Path::new(), Path::new(), Path::new()];
    let mut start = 0;
    while start < count {
        let mut end = start + 1;
        while end < count && status[end] == status[start] {
            end += 1;
        }
        let step = std::f64::consts::TAU / count as f64;
        let (from, to) = (angles[start] - 0.5 * step, angles[end - 1] + 0.5 * step);
        let pieces = (((to - from) / 0.05).ceil() as usize).max(1);
        let arc = |radius: f64, backwards: bool| {
            (0..=pieces).map(move |piece| {
                let piece = if backwards { pieces - piece } else { piece };
                let angle = from + (to - from) * piece as f64 / pieces as f64;
                (
                    centre.0 + radius * angle.cos(),
                    centre.1 - radius * angle.sin(),
                )
            })
        };
        let path = &mut paths[status[start] as usize];
        path.extend(arc(radii.0, false).chain(arc(radii.1, true)));
        path.close();
        start = end;
    }
    for status in STATUSES {
        svg.fill_path(&paths[status as usize], colour::of_status(status), 1.0);
    }
    for radius in [radii.0, radii.1] {
        let circle = (0..=90).map(|i| {
            let angle = f64::from(i) * std::f64::consts::TAU / 90.0;
            (
                centre.0 + radius * angle.cos(),
                centre.1 - radius * angle.sin(),
            )
        });
        svg.path(&Path::polyline(circle, true), &Stroke::solid(INK, 0.4));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strobe_finds_the_period_of_a_rotating_pattern() {
        let (count, nodes, period) = (20_000, 36, 41);
        let times: Vec<f64> = (0..count).map(|i| i as f64).collect();
        let status: Vec<ContactStatus> = (0..count)
            .flat_map(|i| {
                (0..nodes).map(move |j| match (j * period + i * nodes) % (nodes * period) {
                    phase if phase < nodes * period / 3 => ContactStatus::Stick,
                    _ => ContactStatus::Slip,
                })
            })
            .collect();
        let history = StatusHistory {
            times: &times,
            node_count: nodes,
            status: &status,
        };
        assert_eq!(strobe_stride(&history, 20), period);
        assert_eq!(strobe_stride(&history, 1), 1);
    }
}
