//! Units and keywords in column names.

/// Words of a lower-case name: split at everything that is neither letter, digit nor part of a unit.
pub(super) fn words(name: &str) -> Vec<&str> {
    name.split(|c: char| !(c.is_alphanumeric() || matches!(c, '/' | '²' | '^' | '°' | '%' | 'µ')))
        .filter(|w| !w.is_empty())
        .collect()
}

/// Whether a field of a header is a unit alone, in brackets or not: `[Hz]`, `m/s2/N`, `(m/s^2)/N`.
pub(super) fn is_unit(field: &str) -> bool {
    const ATOMS: [&str; 34] = [
        "", "-", "1", "hz", "khz", "s", "sec", "ms", "us", "µs", "μs", "ns", "deg", "°", "rad",
        "db", "g", "v", "mv", "n", "kn", "m", "mm", "um", "µm", "pa", "kpa", "mpa", "kg", "grad",
        "degree", "degrees", "%", "rpm",
    ];
    let bare = field.trim().to_lowercase();
    let is_atom = |atom: &str| {
        let digits = |c: char| c.is_ascii_digit() || matches!(c, '^' | '²' | '³');
        ATOMS.contains(&atom) || ATOMS.contains(&atom.trim_end_matches(digits))
    };
    let separators = ['/', '*', '·', ' ', '(', ')', '[', ']', '<', '>'];
    bare.split(separators).all(is_atom) || (bare.starts_with(['[', '(']) && bare.len() < 16)
}

/// Factor to seconds of a time column's name; `None` if the name is not that of a time.
pub(super) fn seconds(name: &str) -> Option<f64> {
    let words = words(name);
    let is_time = words.iter().any(|w| {
        matches!(*w, "time" | "t" | "zeit" | "temps" | "tempo" | "seconds" | "times" | "timestamp")
    });
    if !is_time {
        return None;
    }
    let unit = words.iter().find_map(|w| match *w {
        "ms" | "msec" | "milliseconds" => Some(1e-3),
        "us" | "µs" | "μs" | "usec" | "microseconds" => Some(1e-6),
        "ns" => Some(1e-9),
        "min" | "minutes" => Some(60.0),
        _ => None,
    });
    Some(unit.unwrap_or(1.0))
}

/// Factor to hertz of a frequency column's name, and whether the name states the unit; `None` if the name
/// is not that of a frequency.
pub(super) fn hertz(name: &str) -> Option<(f64, bool)> {
    let words = words(name);
    let has = |list: &[&str]| words.iter().any(|w| list.contains(w));
    let angular = has(&["omega", "rad/s", "ω"]) || name.contains("rad_per_s");
    let begins = |w: &&str| ["freq", "fréq", "fräq", "frec"].iter().any(|own| w.starts_with(own));
    let is_frequency = angular || has(&["f", "hz", "khz"]) || words.iter().any(begins);
    let plain = if has(&["khz"]) { 1e3 } else { 1.0 };
    let factor = if angular { 1.0 / std::f64::consts::TAU } else { plain };
    is_frequency.then_some((factor, angular || has(&["hz", "khz"])))
}

/// A unit of motion over force that a heading names, such as `mm/s2/N`, `[(m/s^2)/kN]`, `g/lbf` or `m_per_s_per_n`:
/// its factor to SI, and how often it is per second.
pub(super) fn response_unit(heading: &str) -> Option<(f64, usize)> {
    let plain = heading.replace("_per_", "/").replace(" /", "/").replace("/ ", "/");
    let plain = plain.replace("/(", "/").replace([')', ']', '}'], "");
    let mut words = plain.split(|c: char| c.is_whitespace() || "([{<>,;:=_".contains(c));
    words.find_map(|word| {
        let mut parts = word.split(['/', '*', '·']);
        let (mut scale, mut rate) = match parts.next()?.to_lowercase().as_str() {
            "m" => (1.0, 0),
            "cm" => (1e-2, 0),
            "mm" => (1e-3, 0),
            "um" | "µm" | "μm" => (1e-6, 0),
            "in" | "inch" => (0.0254, 0),
            "ft" => (0.3048, 0),
            "g" | "gn" => (9.806_65, 2),
            _ => return None,
        };
        let mut has_force = false;
        for part in parts {
            let (force, per_second) = match part.to_lowercase().as_str() {
                "s" | "sec" => (None, 1),
                "s2" | "s^2" | "s²" | "sec2" | "sec^2" => (None, 2),
                "ns" => (Some(1.0), 1),
                "n" => (Some(1.0), 0),
                "mn" if part == "MN" => (Some(1e6), 0),
                "mn" => (Some(1e-3), 0),
                "kn" => (Some(1e3), 0),
                "lbf" | "lb" => (Some(4.448_221_615_260_5), 0),
                "kgf" | "kp" => (Some(9.806_65), 0),
                _ => return None,
            };
            (scale, rate) = (scale / force.unwrap_or(1.0), rate + per_second);
            has_force |= force.is_some();
        }
        has_force.then_some((scale, rate))
    })
}

/// The number that a text begins with, and what follows it.
fn leading_number(text: &str) -> Option<(f64, &str)> {
    let mut parts = (1..=text.len().min(32)).rev().filter_map(|end| text.split_at_checked(end));
    parts.find_map(|(number, rest)| Some((number.parse().ok()?, rest)))
}

/// The number of the reference of a level, as in `dB re 1e-6 m/s2/N` or `dB re 20 uPa`; 1 where none is written.
pub(super) fn level_reference(name: &str) -> f64 {
    let Some((_, after)) = name.split_once("re ").or_else(|| name.split_once("ref ")) else {
        return 1.0;
    };
    let after = after.trim_start_matches(['.', ':', '=', ' ']);
    let (value, unit) = leading_number(after).unwrap_or((1.0, after));
    // A prefix of what is no unit of a response, as of `uPa`; that of one is in the unit.
    let unit = unit.trim_start();
    let is_micro = unit.starts_with(['u', 'µ', 'μ']) && response_unit(unit).is_none();
    let value = if is_micro { 1e-6 * value } else { value };
    if value > 0.0 && value.is_finite() { value } else { 1.0 }
}

/// A sampling rate stated in remarks, as `sampling rate: 51200 Hz` or `fs = 1e5`, Hz.
pub(super) fn sampling_rate(remarks: &str) -> Option<f64> {
    const KEYS: [&str; 5] =
        ["sampling rate", "sample rate", "samplerate", "sampling frequency", "fs"];
    remarks.lines().find_map(|line| {
        let line = line.trim().replace('_', " ");
        let rest = KEYS.iter().find_map(|key| line.strip_prefix(key))?;
        // `fs` must not be the beginning of another word.
        if rest.starts_with(|c: char| c.is_alphanumeric()) {
            return None;
        }
        let (value, unit) = leading_number(rest.trim_start_matches(|c: char| !c.is_ascii_digit()))?;
        let factor = if unit.trim_start().starts_with("khz") { 1e3 } else { 1.0 };
        (value > 0.0).then_some(value * factor)
    })
}
