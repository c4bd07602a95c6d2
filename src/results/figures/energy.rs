//! The energy figure: where the power of the drive goes.

use super::axis::{Axis, extremes, prefixed, significant};
use super::colour::{
    CONTACT_DISSIPATION, EXTERNAL_POWER, INK, MATERIAL_DISSIPATION, MUTED, NORMAL_POWER, OPEN,
    SERIES, SLIDE_POWER, SLIP, STICK, STICK_POWER,
};
use super::contact_status::status_keys;
use super::legend::{self, Key};
use super::panel::Panel;
use super::svg::{DOUBLE_COLUMN, Path, Stroke, Svg};
use super::text::TextStyle;
use super::time_stack::{TimeStack, scaled, span};
use super::{FigureError, expect_length};

/// Powers and energies of a run; all series share `times`, but for the acceleration.
///
/// Powers are in W, energies in J, each as the case scales them with its thickness.
#[derive(Clone, Debug)]
pub struct EnergyFlows<'a> {
    /// Times, s.
    pub times: &'a [f64],
    /// Power of the drive.
    pub external: &'a [f64],
    /// Power given to the body by sticking nodes.
    pub stick: &'a [f64],
    /// Power given to the body by sliding nodes.
    pub slide: &'a [f64],
    /// Power dissipated at the contact.
    pub contact_dissipated: &'a [f64],
    /// Power dissipated by material damping.
    pub material_damping: &'a [f64],
    /// Power of the normal contact forces.
    pub normal_contact: &'a [f64],
    /// Kinetic energy.
    pub kinetic: &'a [f64],
    /// Strain energy.
    pub strain: &'a [f64],
    /// Relative residual of the energy balance.
    pub balance_residual: &'a [f64],
    /// Fractions of contact nodes that stick, slip and are open.
    pub status: [&'a [f64]; 3],
    /// What the signal is, in mark-up.
    pub signal_name: String,
    /// Times of the acceleration, s.
    pub signal_times: &'a [f64],
    /// Acceleration of a probe, m/s².
    pub acceleration: &'a [f64],
    /// Time over which powers are averaged for the strong lines, s; zero for none.
    pub averaging_time: f64,
}

/// Mean over a window centred on each sample, cut off at the ends.
pub fn moving_average(values: &[f64], window: usize) -> Vec<f64> {
    let half = window / 2;
    let mut sums = Vec::with_capacity(values.len() + 1);
    sums.push(0.0);
    for value in values {
        sums.push(sums[sums.len() - 1] + value);
    }
    (0..values.len())
        .map(|index| {
            let from = index.saturating_sub(half);
            let to = (index + half + 1).min(values.len());
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// Draws the figure: acceleration, status, external power and its parts, power balance of the body,
/// stored energy, balance residual.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_energy_flows(data: &EnergyFlows) -> Result<String, FigureError> {
    check_lengths(data)?;
    let range = span(data.times)?;
    let (left, width) = (50.0, DOUBLE_COLUMN - 62.0);
    let mut svg = Svg::new("energy", DOUBLE_COLUMN, 100.0);
    let mut stack = TimeStack::new(left, width, 14.0, range);
    let times = scaled(data.times, stack.factor);
    draw_acceleration(&mut svg, &mut stack, data);
    draw_fractions(&mut svg, &mut stack, data, &times);
    draw_external_power(&mut svg, &mut stack, data, &times);
    draw_body_power(&mut svg, &mut stack, data, &times);
    draw_stored_energy(&mut svg, &mut stack, data, &times);
    draw_residual(&mut svg, &mut stack, data, &times);
    if averaging_window(data) > 1 {
        let note = format!(
            "(c)–(e): lines are means over {} ms, bands the range of the samples",
            significant(data.averaging_time * 1e3, 2)
        );
        let style = TextStyle::new(6.25).coloured(MUTED);
        svg.text(left, stack.bottom() + 7.0, &note, &style);
    }
    svg.set_height(stack.bottom() + 11.0);
    Ok(svg.finish(
        "Energy flows of the run",
        "Acceleration, contact status, external power and its three parts, power balance of the \
         body, stored energy and the residual of the energy balance over time.",
    ))
}

fn check_lengths(data: &EnergyFlows) -> Result<(), FigureError> {
    let count = data.times.len();
    let series: [(&str, &[f64]); 12] = [
        ("external power", data.external),
        ("stick power", data.stick),
        ("slide power", data.slide),
        ("power dissipated at the contact", data.contact_dissipated),
        ("power of material damping", data.material_damping),
        ("power of the normal contact", data.normal_contact),
        ("kinetic energy", data.kinetic),
        ("strain energy", data.strain),
        ("balance residual", data.balance_residual),
        ("stick fraction", data.status[0]),
        ("slip fraction", data.status[1]),
        ("open fraction", data.status[2]),
    ];
    for (what, values) in series {
        expect_length(what, values.len(), count)?;
    }
    let (what, count) = ("acceleration", data.signal_times.len());
    expect_length(what, data.acceleration.len(), count)
}

fn draw_acceleration(svg: &mut Svg, stack: &mut TimeStack, data: &EnergyFlows) {
    let y = Axis::symmetric("*a* (m/s²)", data.acceleration.iter().copied());
    let panel = stack.push(y, 54.0, false);
    panel.draw_ground(svg);
    let times = scaled(data.signal_times, stack.factor);
    let stroke = Stroke::solid(SERIES[0], 0.45);
    panel.series(svg, &times, data.acceleration, &stroke);
    panel.draw_frame(svg);
    stack.caption(svg, &panel, &data.signal_name);
}

/// Fractions as stacked areas, stick below, then slip, then open.
fn draw_fractions(svg: &mut Svg, stack: &mut TimeStack, data: &EnergyFlows, times: &[f64]) {
    let y = Axis::linear("nodes (%)", 0.0, 100.0);
    let panel = stack.push(y, 54.0, false).without_grid();
    let percent = |values: &[f64]| scaled(values, 100.0);
    let stick = percent(data.status[0]);
    let slip_top: Vec<f64> = stick
        .iter()
        .zip(percent(data.status[1]))
        .map(|(a, b)| a + b)
        .collect();
    svg.rectangle(&panel.area, OPEN, None);
    panel.fill_to(svg, times, &slip_top, 0.0, SLIP, 1.0);
    panel.fill_to(svg, times, &stick, 0.0, STICK, 1.0);
    panel.draw_frame(svg);
    stack.caption(svg, &panel, "contact status");
    draw_keys(svg, &panel, &status_keys());
}

/// Legend at the right above a panel, in line with its caption.
fn draw_keys(svg: &mut Svg, panel: &Panel, keys: &[(Key, String)]) {
    let width: f64 = keys
        .iter()
        .map(|(_, name)| super::text::width(name, super::panel::LABEL_SIZE, false) + 24.0)
        .sum();
    let x = panel.area.right() - width + 9.0;
    legend::draw_legend(svg, x, panel.area.y - 11.0, width + 1.0, keys);
}

/// A power or an energy: line of its running mean over the band of its samples.
fn draw_power(
    svg: &mut Svg,
    panel: &Panel,
    data: &EnergyFlows,
    (times, values): (&[f64], &[f64]),
    colour: &str,
) {
    let window = averaging_window(data);
    if window > 1 {
        panel.envelope(svg, times, values, colour, 0.22);
        let mean = moving_average(values, window);
        panel.series(svg, times, &mean, &Stroke::solid(colour, 1.1));
    } else {
        panel.series(svg, times, values, &Stroke::solid(colour, 1.0));
    }
}

fn averaging_window(data: &EnergyFlows) -> usize {
    let count = data.times.len();
    if count < 3 || data.averaging_time <= 0.0 {
        return 1;
    }
    let step = (data.times[count - 1] - data.times[0]) / (count - 1) as f64;
    (data.averaging_time / step).round() as usize
}

/// Factor and axis that hold several powers, but for their shortest peaks, and zero.
fn power_axis(data: &EnergyFlows, series: &[&[f64]]) -> (f64, Axis) {
    let window = averaging_window(data).max(1);
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for values in series {
        // The impact of the expansion lasts a few hundredths of a run and would flatten the rest.
        let mut mean = moving_average(values, window);
        mean.sort_by(f64::total_cmp);
        let skipped = mean.len() / 40;
        low = low.min(mean[skipped]);
        high = high.max(mean[mean.len() - 1 - skipped]);
    }
    let (factor, unit) = prefixed(low.abs().max(high.abs()), "W");
    let room = 0.2 * (high - low);
    let axis = Axis::linear(
        &format!("power ({unit})"),
        (low - if low < 0.0 { room } else { 0.2 * room }) * factor,
        (high + room) * factor,
    );
    (factor, axis)
}

fn draw_external_power(svg: &mut Svg, stack: &mut TimeStack, data: &EnergyFlows, times: &[f64]) {
    let parts: [(&[f64], &str, &str); 4] = [
        (
            data.contact_dissipated,
            CONTACT_DISSIPATION,
            "dissipated at the contact",
        ),
        (data.slide, SLIDE_POWER, "sliding"),
        (data.stick, STICK_POWER, "sticking"),
        (data.external, EXTERNAL_POWER, "external"),
    ];
    let (factor, y) = power_axis(data, &parts.map(|p| p.0));
    let panel = stack.push(y, 88.0, false);
    panel.draw_ground(svg);
    panel.horizontal(svg, 0.0, &Stroke::solid(INK, 0.5));
    svg.begin_clip(&panel.area);
    for (values, colour, _) in parts {
        let values = scaled(values, factor);
        draw_power(svg, &panel, data, (times, &values), colour);
    }
    svg.end_group();
    panel.draw_frame(svg);
    draw_cut_peak(svg, &panel, times, data.external, factor);
    stack.caption(svg, &panel, "external power and its parts");
    let keys: Vec<_> = parts
        .iter()
        .rev()
        .map(|&(_, colour, name)| (Key::line(colour), name.to_string()))
        .collect();
    draw_keys(svg, &panel, &keys);
}

fn draw_body_power(svg: &mut Svg, stack: &mut TimeStack, data: &EnergyFlows, times: &[f64]) {
    let received: Vec<f64> = (0..times.len())
        .map(|i| data.stick[i] + data.slide[i] + data.normal_contact[i])
        .collect();
    let (factor, y) = power_axis(data, &[&received, data.material_damping]);
    let panel = stack.push(y, 72.0, false);
    panel.draw_ground(svg);
    panel.horizontal(svg, 0.0, &Stroke::solid(INK, 0.5));
    let window = averaging_window(data).max(1);
    let mean_in = scaled(&moving_average(&received, window), factor);
    let mean_out = scaled(&moving_average(data.material_damping, window), factor);
    svg.begin_clip(&panel.area);
    fill_between(svg, &panel, times, &mean_in, &mean_out);
    let normal = scaled(data.normal_contact, factor);
    for (values, colour) in [
        (normal, NORMAL_POWER),
        (scaled(data.material_damping, factor), MATERIAL_DISSIPATION),
        (scaled(&received, factor), STICK_POWER),
    ] {
        draw_power(svg, &panel, data, (times, &values), colour);
    }
    svg.end_group();
    panel.draw_frame(svg);
    draw_cut_peak(svg, &panel, times, &received, factor);
    stack.caption(svg, &panel, "power balance of the body");
    let keys = [
        (Key::line(STICK_POWER), "received at the contact".into()),
        (Key::line(MATERIAL_DISSIPATION), "material damping".into()),
        (Key::line(NORMAL_POWER), "of it normal".into()),
        (Key::Patch(SERIES[5].into(), 0.5), "stored".to_string()),
    ];
    draw_keys(svg, &panel, &keys);
}

/// Says how high a peak goes that the panel cuts off.
fn draw_cut_peak(svg: &mut Svg, panel: &Panel, times: &[f64], values: &[f64], factor: f64) {
    let peak = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b]));
    let Some(peak) = peak.filter(|&i| values[i] * factor > panel.y.high) else {
        return;
    };
    let x = panel.at_x(times[peak]).min(panel.area.right() - 50.0);
    let unit = panel.y.title.rsplit_once('(').map_or("", |(_, unit)| unit);
    let label = format!(
        "▲ peak {} {}",
        significant(values[peak] * factor, 3),
        unit.trim_end_matches(')')
    );
    let style = TextStyle::new(6.25).coloured(MUTED).with_halo();
    svg.text(x + 3.0, panel.area.y + 8.0, &label, &style);
}

/// The area between two curves, thinned alike.
fn fill_between(svg: &mut Svg, panel: &Panel, times: &[f64], upper: &[f64], lower: &[f64]) {
    let stride = (times.len() / 800).max(1);
    let there = (0..times.len()).step_by(stride);
    let back = there.clone().rev();
    let outline = there
        .map(|i| (panel.at_x(times[i]), panel.at_y(upper[i])))
        .chain(back.map(|i| (panel.at_x(times[i]), panel.at_y(lower[i]))));
    svg.fill_path(&Path::polyline(outline, true), SERIES[5], 0.5);
}

fn draw_stored_energy(svg: &mut Svg, stack: &mut TimeStack, data: &EnergyFlows, times: &[f64]) {
    let total: Vec<f64> = data
        .kinetic
        .iter()
        .zip(data.strain)
        .map(|(a, b)| a + b)
        .collect();
    let high = extremes(total.iter().copied()).1;
    let (factor, unit) = prefixed(high, "J");
    let title = format!("energy ({unit})");
    let y = Axis::linear(&title, 0.0, high.max(f64::MIN_POSITIVE) * factor * 1.1);
    let panel = stack.push(y, 60.0, false);
    panel.draw_ground(svg);
    let series: [(&[f64], &str, &str); 3] = [
        (&total, INK, "total"),
        (data.strain, SERIES[2], "strain"),
        (data.kinetic, SERIES[1], "kinetic"),
    ];
    for (values, colour, _) in series {
        let values = scaled(values, factor);
        draw_power(svg, &panel, data, (times, &values), colour);
    }
    panel.draw_frame(svg);
    stack.caption(svg, &panel, "stored energy");
    let keys = series.map(|(_, colour, name)| (Key::line(colour), name.to_string()));
    draw_keys(svg, &panel, &keys);
}

fn draw_residual(svg: &mut Svg, stack: &mut TimeStack, data: &EnergyFlows, times: &[f64]) {
    let size: Vec<f64> = data
        .balance_residual
        .iter()
        .map(|r| r.abs().max(1e-18))
        .collect();
    let (low, high) = extremes(size.iter().copied());
    let low = low.max(1e-6 * high);
    let y = Axis::logarithmic(
        "residual (–)",
        10f64.powf((low.log10() - 0.5).floor()),
        10f64.powf((high.log10() + 0.5).ceil()),
    );
    let panel = stack.push(y, 44.0, true);
    panel.draw_ground(svg);
    panel.series(svg, times, &size, &Stroke::solid(INK, 0.5));
    panel.draw_frame(svg);
    let caption = format!(
        "residual of the energy balance, at most {}",
        significant(high, 2)
    );
    stack.caption(svg, &panel, &caption);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moving_average_of_a_line_is_the_line() {
        let line: Vec<f64> = (0..50).map(f64::from).collect();
        let mean = moving_average(&line, 7);
        for index in 3..47 {
            assert!((mean[index] - line[index]).abs() < 1e-12);
        }
        assert_eq!((mean[0], mean[49]), (1.5, 47.5));
    }
}
