//! The energy figure of a transient: where the power of the drive goes.

use super::run::RecordedRun;
use crate::charts::palette::{
    CONTACT_DISSIPATION, EXTERNAL_POWER, MATERIAL_DISSIPATION, NORMAL_POWER, SLIDE_POWER, STATUSES,
    STICK_POWER,
};
use crate::charts::run_axis;
use crate::common::*;
use frictionsim_chart::significant;

/// Time over which powers are averaged for the strong lines, s.
const AVERAGING_TIME: f64 = 5e-4;

/// A power or an energy: samples, their running mean, colour, name.
struct Course {
    values: Vec<f64>,
    mean: Vec<f64>,
    colour: &'static str,
    name: &'static str,
}

impl Course {
    fn line(&self, times: &[f64], width: f64) -> Line {
        Line::new(times, &self.mean).solid(self.colour, width).name(self.name)
    }
}

/// Mean over a window centred on each sample; within half a window of an end there is none, as half a window would
/// weigh what happens there twice.
fn moving_average(values: &[f64], window: usize) -> Vec<f64> {
    let half = (window / 2).min(values.len().saturating_sub(1) / 2);
    let mut sums = vec![0.0];
    for value in values {
        sums.push(sums[sums.len() - 1] + value);
    }
    let mean = |index: usize| match index >= half && index + half < values.len() {
        true => (sums[index + half + 1] - sums[index - half]) / (2 * half + 1) as f64,
        false => f64::NAN,
    };
    (0..values.len()).map(mean).collect()
}

/// Acceleration, status, external power and its parts, power balance of the body, the external power as the sum of what
/// contact and material dissipate, stored energy, balance residual, as figure 12 of the paper has them.
pub(super) fn energy(run: &RecordedRun<'_>) -> Figure {
    let (rows, times) = (&run.solved.record.rows, run.times());
    let (thickness, extent) = (run.thickness, run.extent);
    let step = (extremes(times.iter().copied()).1 - times.first().copied().unwrap_or(0.0))
        / times.len().max(2) as f64;
    let window = (AVERAGING_TIME / step.max(1e-300))
        .round()
        .clamp(1.0, (times.len() / 5).max(1) as f64) as usize;
    let course = |name: &'static str, colour: &'static str, of: &dyn Fn(&SampleRow) -> f64| {
        let values: Vec<f64> = rows.iter().map(|row| thickness * of(row)).collect();
        Course { mean: moving_average(&values, window), values, colour, name }
    };
    let external = course("external", EXTERNAL_POWER, &|row| row.powers.external);
    let stick = course("sticking", STICK_POWER, &|row| row.powers.stick);
    let slide = course("sliding", SLIDE_POWER, &|row| row.powers.slide);
    let contact = course("dissipated at the contact", CONTACT_DISSIPATION, &|row| {
        row.powers.contact_dissipated
    });
    let material = course("material damping", MATERIAL_DISSIPATION, &|row| row.material_damping);
    let normal = course("normal contact forces", NORMAL_POWER, &|row| row.powers.normal);
    let received = course("received", STICK_POWER, &|row| {
        let own = &row.powers;
        own.stick + own.slide + own.normal - own.damping + own.pressure
    });
    let total =
        course("total", INK, &|row| row.kinetic_energy + row.strain_energy + row.contact_energy);
    let strain = course("strain", SERIES[2], &|row| row.strain_energy);
    let kinetic = course("kinetic", SERIES[1], &|row| row.kinetic_energy);
    let probes = run.solved.record.probes.len();
    let inside = (0..probes).find(|&probe| !run.is_on_contact(probe)).or((probes > 0).then_some(0));
    let acceleration = inside.map(|probe| {
        let line = Line::new(&times, &run.acceleration(probe)).solid(SERIES[0], 0.45).whole();
        let [along, symbol] = run.directions()[run.shown_component(probe)];
        let caption = format!("{along} acceleration, node {}", run.probe_label(probe));
        let axis = Axis::new(&format!("*a*_{{{symbol}}}"), "m/s²").symmetric();
        panel(&times, axis, 50.0, caption).layer(line)
    });
    let dissipated: Vec<f64> =
        contact.mean.iter().zip(&material.mean).map(|(a, b)| a + b).collect();
    let zero = vec![0.0; times.len()];
    let area = |low: &[f64], high: &[f64], course: &Course| {
        Fill::between(&times, low, high, course.colour).opacity(0.45).name(course.name)
    };
    let axis = power_axis(&[&external, &contact, &material], extent).0;
    let sum = panel(&times, axis, 72.0, "external power and what is dissipated")
        .legend()
        .layer(area(&zero, &contact.mean, &contact))
        .layer(area(&contact.mean, &dissipated, &material))
        .layer(external.line(&times, 1.1));
    let powers = |caption: &str, height: f64, courses: &[&Course]| {
        powers((&times, extent), caption, height, courses)
    };
    let kept = Fill::between(&times, &received.mean, &material.mean, SERIES[5]);
    let balance = powers("power balance of the body", 72.0, &[&normal, &material, &received])
        .layer(kept.opacity(0.5).name("stored"));
    let axis = Axis::new("energy", &extent.unit("J")).prefixed().including(0.0);
    let stored = panel(&times, axis, 56.0, "stored energy")
        .legend()
        .layers([&total, &strain, &kinetic].map(|course| course.line(&times, 1.0)));
    Figure::new(
        "energy",
        "Energy flows: acceleration, contact status, external power and its parts, and the power balance of the body. \
         External power is the sum of what is dissipated, stored energy and the residual of the balance.",
    )
    .shared_x()
    .panels(acceleration)
    .panel(status(rows, &times))
    .panel(powers("external power and its parts", 88.0, &[&contact, &slide, &stick, &external]))
    .panel(balance)
    .panel(sum)
    .panel(stored)
    .panel(residual(rows, &times))
    .note(format!(
        "powers and energies: lines are means over {} ms, bands the range of the samples",
        significant(window as f64 * step * 1e3, 2)
    ))
}

/// A panel over the time of the run.
fn panel(times: &[f64], y: Axis, height: f64, caption: impl Into<String>) -> Panel {
    Panel::new(run_axis(times), y).height(height).caption(caption)
}

/// Fractions of contact nodes as stacked areas, stick below, then slip, then open.
fn status(rows: &[SampleRow], times: &[f64]) -> Panel {
    let axis = Axis::new("nodes", "%").times(100.0).between(0.0, 1.0);
    let mut below = vec![0.0; rows.len()];
    let areas = STATUSES.iter().enumerate().map(|(which, &(_, name, colour, ..))| {
        let own = rows.iter().map(|row| row.counts.fractions()[which]);
        let above: Vec<f64> = below.iter().zip(own).map(|(below, own)| below + own).collect();
        let area = Fill::between(times, &below, &above, colour).name(name);
        below = above;
        area
    });
    panel(times, axis, 50.0, "contact status").plain().legend().layers(areas)
}

/// An axis that holds several powers, but for their shortest peaks, and zero: the impact of the expansion lasts a few
/// hundredths of a run and would flatten the rest.
fn power_axis(courses: &[&Course], extent: Extent) -> (Axis, f64) {
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for course in courses {
        let mut mean: Vec<f64> = course.mean.clone();
        mean.retain(|value| value.is_finite());
        mean.sort_by(f64::total_cmp);
        let skipped = mean.len() / 40;
        if let (Some(least), Some(most)) =
            (mean.get(skipped), mean.get(mean.len().saturating_sub(1 + skipped)))
        {
            (low, high) = (low.min(*least), high.max(*most));
        }
    }
    let room = 0.2 * (high - low);
    let low = if low < -1e-3 * high { low - room } else { 0.0 };
    (Axis::new("power", &extent.unit("W")).prefixed().between(low, high + room), high + room)
}

/// Running means over the bands of their samples, with a word on a peak that the axis cuts off.
fn powers(
    (times, extent): (&[f64], Extent),
    caption: &str,
    height: f64,
    courses: &[&Course],
) -> Panel {
    let (axis, top) = power_axis(courses, extent);
    let band = |own: &&Course| Fill::range_of(times, &own.values, own.colour).opacity(0.22);
    let values = courses.iter().flat_map(|course| course.values.iter().copied().zip(times));
    let peak = values.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|peak| peak.0 > top);
    let peak = peak.map(|(peak, &time)| {
        let (factor, unit) = prefixed(peak, &extent.unit("W"));
        let label =
            format!("▲ largest sample {} {unit}, beyond the axis", significant(peak * factor, 3));
        let style = TextStyle::new(6.25).coloured(MUTED).with_halo();
        Label::new((time, top), label).moved(3.0, 8.0).style(style)
    });
    panel(times, axis, height, caption)
        .legend()
        .layers(courses.iter().map(band))
        .layer(Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.5)))
        .layers(courses.iter().map(|course| course.line(times, 1.1)))
        .layers(peak)
}

fn residual(rows: &[SampleRow], times: &[f64]) -> Panel {
    let size: Vec<f64> = rows.iter().map(|row| row.balance_residual.abs().max(1e-18)).collect();
    let largest = extremes(size.iter().copied()).1;
    let caption = format!("residual of the energy balance, at most {}", significant(largest, 2));
    panel(times, Axis::new("residual", "–").decades(6.0).room(0.1), 44.0, caption)
        .layer(Line::new(times, &size).solid(INK, 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moving_average_of_a_line_is_the_line() {
        let line: Vec<f64> = (0..50).map(f64::from).collect();
        let mean = moving_average(&line, 7);
        assert!((3..47).all(|index| (mean[index] - line[index]).abs() < 1e-12));
        assert!(mean[2].is_nan() && mean[47].is_nan());
    }
}
