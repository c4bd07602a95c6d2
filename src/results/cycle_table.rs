//! Columns of a limit cycle.

use super::extent::Extent;
use super::quantity::quantity;
use super::report::{ReportTable, cell, number};
use serde_json::Value;

/// Column of a table of cycles: name, place in the summary, factor, decimals.
pub type CycleColumn = (&'static str, &'static str, f64, usize);

/// Columns of every cycle.
const COMMON: [CycleColumn; 14] = [
    ("main frequency (Hz)", "/main_frequency_hz", 1.0, 2),
    ("stick (%)", "/status/stick", 100.0, 1),
    ("slip (%)", "/status/slip", 100.0, 1),
    ("open (%)", "/status/open", 100.0, 1),
    ("velocity level (dB)", "/velocity_level_db", 1.0, 1),
    ("sound power (dB)", "/sound/level_db", 1.0, 1),
    ("power of the counterface (W)", "/power_w/external", 1.0, 2),
    ("of it while sticking (W)", "/power_w/stick", 1.0, 2),
    ("while sliding (W)", "/power_w/slide", 1.0, 2),
    ("dissipated in the contact (W)", "/power_w/contact_dissipated", 1.0, 2),
    ("material damping (W)", "/power_w/material_damping", 1.0, 2),
    ("normal contact (W)", "/power_w/normal_contact", 1.0, 2),
    ("transient from it (Hz)", "/confirmation/main_frequency_hz", 1.0, 2),
    ("fastest growth of a perturbation (1/s)", "/stability/leading/growth_rate_per_s", 1.0, 1),
];

/// The cycles of a summary, one row each: `own` columns of the kind of body first; `absence` says why there is none.
pub fn cycle_table(
    cycles: &[Value],
    extent: Extent,
    own: &[CycleColumn],
    absence: &dyn Fn(&Value) -> String,
) -> ReportTable {
    let columns: Vec<&CycleColumn> = own.iter().chain(&COMMON).collect();
    let rows = cycles.iter().map(|cycle| {
        let cells = columns.iter();
        let cells =
            cells.map(|(_, pointer, factor, decimals)| cell(cycle, pointer, *factor, *decimals));
        let answer = |pointer: &str| match cycle.pointer(pointer).and_then(Value::as_bool) {
            Some(true) => "yes".to_owned(),
            Some(false) => "no".to_owned(),
            None => String::new(),
        };
        let answers = ["/stability/is_stable", "/confirmation/agrees"].map(answer);
        cells.chain(answers).chain([absence(cycle)]).collect()
    });
    let watts = format!("({})", extent.unit("W"));
    let names = columns.iter().map(|column| column.0.replace("(W)", &watts));
    ReportTable::new(
        "Limit cycles at the case's own operating point",
        names.chain(["stable", "a transient stays on it", "why there is none"].map(String::from)),
        rows,
    )
}

/// What decides of one cycle, each line with its `name` first.
pub fn cycle_results(name: &str, cycle: &Value, extent: Extent) -> Vec<(String, String)> {
    let text =
        |key: &str, pointer: &str| number(cycle, pointer).map(|value| quantity(key).text(value));
    let status = ["stick", "slip", "open"].map(|part| {
        let share = cell(cycle, &format!("/status/{part}"), 100.0, 1);
        format!("{part} {share} %")
    });
    let power = number(cycle, "/power_w/external").map(|power| {
        let number = quantity("power_w.external").number(power);
        format!("{number} {}", extent.unit("W"))
    });
    let stability = cycle.pointer("/stability/is_stable");
    let verdict = cycle.pointer("/stability/verdict").and_then(Value::as_str);
    let verdict = match stability.and_then(Value::as_bool) {
        Some(true) => Some("stable"),
        Some(false) => Some("unstable"),
        None => verdict,
    };
    let level = number(cycle, "/velocity_level_db");
    let sound = number(cycle, "/sound/level_db");
    let rows = [
        (
            "main frequency",
            text("main_frequency_hz", "/main_frequency_hz"),
        ),
        ("contact", Some(status.join(", "))),
        ("power of the counterface", power),
        (
            "velocity level",
            level.map(|level| format!("{level:.1} dB over 5e-8 m/s, mean over time and mass")),
        ),
        (
            "sound power",
            sound.map(|level| {
                format!(
                    "{level:.1} dB over 1e-12 W, an estimate: Rayleigh integral, each flat face in an infinite rigid baffle"
                )
            }),
        ),
        ("stability", verdict.map(str::to_owned)),
    ];
    let rows = rows.into_iter();
    rows.filter_map(|(what, value)| Some((format!("{name}: {what}"), value?))).collect()
}

/// Heading of the columns that [`printed_cycle`] fills.
pub fn printed_heading() -> String {
    format!(
        "{:>12} {:>7} {:>7} {:>7} {:>12} {:>7} {:>7} {:>10}",
        "frequency", "stick", "slip", "open", "external", "stick", "slide", "dissipated"
    )
}

/// Frequency (Hz), fractions `[stick, slip, open]`, and the powers `[external, stick, slide, dissipated in the contact]`, W or
/// W/m: the first as it is, the others as shares of it.
pub fn printed_cycle(
    frequency_hz: f64,
    [stick, slip, open]: [f64; 3],
    powers: [f64; 4],
    extent: Extent,
) -> String {
    let [stuck, slid, lost] = [1, 2, 3].map(|i| powers[i] / powers[0]);
    format!(
        "{frequency_hz:>9.2} Hz {stick:>7.3} {slip:>7.3} {open:>7.3} {:>10.2} {} {stuck:>7.3} {slid:>7.3} {lost:>10.3}",
        powers[0],
        extent.unit("W"),
    )
}
