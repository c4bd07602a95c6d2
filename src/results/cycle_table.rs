//! Columns of a limit cycle.

use super::extent::Extent;
use super::quantity::{quantity, significant};
use super::report::{ReportTable, cell, entries, number};
use super::table::{Table, format_number};
use serde_json::Value;
use std::io::{self, Write};

/// Column of a table of cycles: name, place in the summary, factor, decimals.
pub type CycleColumn = (&'static str, &'static str, f64, usize);

/// Columns of every cycle.
const COMMON: [CycleColumn; 15] = [
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
    ("kick that tips sliding into it (m/s)", "/kick_velocity", 1.0, 5),
];

/// Columns of `cycle.csv`, and their places in the summary.
const FILE_COLUMNS: [(&str, &str); 21] = [
    ("mode", "/mode"),
    ("harmonic", "/harmonic"),
    ("onset", "/onset"),
    ("main_frequency_hz", "/main_frequency_hz"),
    ("amplitude_m", "/amplitude_m"),
    ("stick", "/status/stick"),
    ("slip", "/status/slip"),
    ("open", "/status/open"),
    ("external_w", "/power_w/external"),
    ("stick_w", "/power_w/stick"),
    ("slide_w", "/power_w/slide"),
    ("contact_dissipated_w", "/power_w/contact_dissipated"),
    ("material_damping_w", "/power_w/material_damping"),
    ("normal_contact_w", "/power_w/normal_contact"),
    ("balance_residual", "/balance_residual"),
    ("velocity_level_db", "/velocity_level_db"),
    ("sound_power_db", "/sound/level_db"),
    ("stable", "/stability/is_stable"),
    ("growth_rate_per_s", "/stability/leading/growth_rate_per_s"),
    ("kick_velocity", "/kick_velocity"),
    ("error", "/error"),
];

/// Writes `cycle.csv`: one row for each cycle that was sought, as the summary has it.
///
/// # Errors
/// Those of the writer.
pub fn write_cycles(out: &mut dyn Write, summary: &Value) -> io::Result<()> {
    let mut table = Table::new(out, &FILE_COLUMNS.map(|column| column.0))?;
    for cycle in entries(summary, "cycles") {
        table.row(FILE_COLUMNS.map(|(_, pointer)| value_cell(cycle.pointer(pointer))))?;
    }
    table.finish()
}

/// A value of a summary in a table.
fn value_cell(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Number(number)) if number.is_f64() => {
            format_number(number.as_f64().unwrap_or(f64::NAN))
        }
        Some(other) => other.to_string(),
    }
}

/// The branch of a cycle of the summary in one sentence: its values and ends, where it turns back, changes its stability, stops
/// sticking, where sliding loses its stability and lives beside it, and the kick between both. Nothing without a branch.
pub fn branch_sentence(cycle: &Value) -> Option<String> {
    let branch = cycle.get("branch").filter(|branch| branch.is_object())?;
    let text = |value: f64| significant(value, 5);
    let key = branch["key"].as_str().unwrap_or_default();
    let ends = [0, 1].map(|i| branch["ends"][i].as_str().unwrap_or_default());
    let name = match cycle["mode"].as_u64() {
        Some(mode) => format!("mode {mode}"),
        None => format!("n = {}, onset {}", cycle["harmonic"], cycle["onset"]),
    };
    let [low, high] = [0, 1].map(|i| branch["range"][i].as_f64());
    let Some((low, high)) = low.zip(high) else {
        return Some(format!(
            "{name}: no cycle at the values of {key} that were asked for ({})",
            ends[1]
        ));
    };
    let values = |list: &str| -> Vec<String> {
        let of = |entry: &Value| match entry.as_f64() {
            Some(value) => text(value),
            None => {
                let at = text(entry["at"].as_f64().unwrap_or(f64::NAN));
                format!("{at} ({} nodal diameters)", entry["harmonic"])
            }
        };
        entries(branch, list).iter().map(of).collect()
    };
    let said = |what: &str, values: Vec<String>| match values.is_empty() {
        true => String::new(),
        false => format!("; {what} {}", values.join(", ")),
    };
    let folds = match values("folds") {
        folds if folds.is_empty() => "; no fold".to_owned(),
        folds if folds.len() == 1 => said("a fold at", folds),
        folds => said(&format!("{} folds at", folds.len()), folds),
    };
    let saturation = branch["saturation_speed_rpm"].as_f64();
    let saturation = saturation.map(|speed| format!("; no point sticks above {speed:.1} rpm"));
    let both = entries(branch, "coexistence").iter().map(|ends| {
        let [from, to] = [0, 1].map(|i| text(ends[i].as_f64().unwrap_or(f64::NAN)));
        format!("; stable sliding and a limit cycle coexist from {key} = {from} to {to}")
    });
    let kick = cycle["kick_velocity"].as_f64().map(|velocity| {
        format!(
            "; at the case's own {key} a kick of more than {velocity:.3e} m/s tips sliding into it: 2 pi f times the amplitude of the \
             unstable cycle between both"
        )
    });
    Some(format!(
        "{name}: {} cycles over {key} from {} to {} (at one end {}, at the other {}){folds}{}{}{}{}{}",
        branch["cycles"],
        text(low),
        text(high),
        ends[0],
        ends[1],
        saturation.unwrap_or_default(),
        said("stability changes at", values("stability_changes")),
        said("steady sliding loses its stability at", values("onsets")),
        both.collect::<String>(),
        kick.unwrap_or_default(),
    ))
}

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
    let kick = number(cycle, "/kick_velocity");
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
        ("kick that tips sliding into it", kick.map(|velocity| format!("{velocity:.3e} m/s"))),
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
