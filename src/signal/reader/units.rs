//! Units and keywords in column names.

/// Words of a lower-case name: split at everything that is neither letter, digit nor part of a unit.
pub(super) fn words(name: &str) -> Vec<&str> {
    name.split(|c: char| !(c.is_alphanumeric() || matches!(c, '/' | '²' | '^' | '°' | '%' | 'µ')))
        .filter(|w| !w.is_empty())
        .collect()
}

/// Whether a field of a header is a unit alone, in brackets or not.
pub(super) fn is_unit(field: &str) -> bool {
    const UNITS: [&str; 29] = [
        "", "-", "hz", "khz", "s", "sec", "ms", "us", "µs", "μs", "deg", "°", "rad", "db", "g",
        "v", "mv", "n", "m", "mm", "m/s", "m/s2", "m/s^2", "m/s²", "rad/s", "m/n", "m/s/n", "g/n",
        "pa",
    ];
    let bare = field
        .trim()
        .trim_matches(['[', ']', '(', ')', '<', '>'])
        .to_lowercase();
    UNITS.contains(&bare.as_str()) || (field.trim().starts_with(['[', '(']) && bare.len() < 16)
}

/// Factor to seconds of a time column's name; `None` if the name is not that of a time.
pub(super) fn seconds(name: &str) -> Option<f64> {
    let words = words(name);
    let is_time = words.iter().any(|w| {
        matches!(
            *w,
            "time" | "t" | "zeit" | "temps" | "tempo" | "seconds" | "times"
        )
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

/// Factor to hertz of a frequency column's name; `None` if the name is not that of a frequency.
pub(super) fn hertz(name: &str) -> Option<f64> {
    let words = words(name);
    let has = |list: &[&str]| words.iter().any(|w| list.contains(w));
    let angular = has(&["omega", "rad/s", "ω"]) || name.contains("rad_per_s");
    let is_frequency = angular
        || has(&["f", "hz", "khz", "fréquence", "frequenz", "frequenza"])
        || words.iter().any(|w| w.starts_with("freq"));
    is_frequency.then(|| {
        if angular {
            1.0 / std::f64::consts::TAU
        } else if has(&["khz"]) {
            1e3
        } else {
            1.0
        }
    })
}

/// A sampling rate stated in remarks, as `sampling rate: 51200 Hz` or `fs = 1e5`, Hz.
pub(super) fn sampling_rate(remarks: &str) -> Option<f64> {
    const KEYS: [&str; 8] = [
        "sampling rate",
        "sample rate",
        "sampling_rate",
        "sample_rate",
        "samplerate",
        "sampling frequency",
        "sampling_frequency",
        "fs",
    ];
    remarks.lines().find_map(|line| {
        let line = line.trim();
        let rest = KEYS.iter().find_map(|key| line.strip_prefix(key))?;
        // `fs` must not be the beginning of another word.
        if rest.starts_with(|c: char| c.is_alphanumeric()) {
            return None;
        }
        let rest = rest.trim_start_matches(|c: char| !c.is_ascii_digit());
        let end = rest
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | 'e' | '+')))
            .unwrap_or(rest.len());
        let value: f64 = rest[..end].parse().ok()?;
        let factor = if rest[end..].trim_start().starts_with("khz") {
            1e3
        } else {
            1.0
        };
        (value > 0.0).then_some(value * factor)
    })
}
