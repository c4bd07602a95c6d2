//! One field of a table: a real or complex number, or a time stamp.

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Value {
    Real(f64),
    Complex(f64, f64),
    /// Days since 0000-03-01 (0 without a date), and seconds of the day.
    Time(i64, f64),
}

/// A number, a complex number or a time stamp.
pub(super) fn parse(field: &str) -> Option<Value> {
    // Plain numbers come first: they are nearly all.
    let real = number(field).map(Value::Real);
    let complex = || complex(field).map(|(re, im)| Value::Complex(re, im));
    let time = || time_stamp(field).map(|(day, seconds)| Value::Time(day, seconds));
    real.or_else(complex).or_else(time)
}

/// A number, with a decimal point or a decimal comma; NaN and infinity included.
pub(super) fn number(field: &str) -> Option<f64> {
    if let Ok(value) = field.parse() {
        return Some(value);
    }
    // A word of letters is none; this is met in every header.
    if !field.contains(|c: char| c.is_ascii_digit() || c == '#' || c == '/')
        && !field.eq_ignore_ascii_case("na")
    {
        return None;
    }
    let plain = field.replace(['\u{2212}', '\u{2013}'], "-");
    let lower = plain.to_ascii_lowercase();
    if matches!(lower.as_str(), "1.#ind" | "-1.#ind" | "1.#qnan" | "#n/a" | "na" | "n/a") {
        return Some(f64::NAN);
    }
    // Fortran writes exponents with d.
    let is_number = lower.contains(|c: char| c.is_ascii_digit());
    let mut text = if is_number { lower.replace('d', "e") } else { lower };
    if text.matches(',').count() == 1 && !text.contains('.') {
        text = text.replace(',', ".");
    }
    text.parse().ok()
}

/// `0.09+0.57j`, `(0.09-0.57i)`, `0.09 + j0.57`.
fn complex(field: &str) -> Option<(f64, f64)> {
    let plain: String = field
        .chars()
        .filter(|c| !c.is_whitespace() && !matches!(c, '(' | ')' | '*'))
        .map(|c| if matches!(c, 'J' | 'I' | 'i') { 'j' } else { c })
        .collect();
    if plain.matches('j').count() != 1 {
        return None;
    }
    // The sign that begins the imaginary part is the last one that belongs to no exponent.
    let bytes = plain.as_bytes();
    let is_sign = |k: &usize| {
        matches!(bytes[*k], b'+' | b'-')
            && (*k == 0 || !matches!(bytes[k - 1], b'e' | b'E' | b'd' | b'D'))
    };
    let at = (0..bytes.len()).rev().find(is_sign).unwrap_or(0);
    let (re, im) = (&plain[..at], plain[at..].replace('j', ""));
    let re = if re.is_empty() { 0.0 } else { number(re)? };
    let im = match im.as_str() {
        "" | "+" => 1.0,
        "-" => -1.0,
        text => number(text)?,
    };
    Some((re, im))
}

/// Day and second of `2024-05-01 12:00:00.00`, `01.05.2024 12:00:00,5`, `12:00:00.25` or a date alone.
pub(super) fn time_stamp(field: &str) -> Option<(i64, f64)> {
    let mut words = field.split(|c: char| c.is_whitespace() || c == 'T' || c == 'Z');
    let mut words = words.by_ref().filter(|w| !w.is_empty());
    let (first, second) = (words.next()?, words.next());
    if words.next().is_some() {
        return None;
    }
    match (date(first), second) {
        (Some(day), Some(clock)) => Some((day, time_of_day(clock)?)),
        (Some(day), None) => Some((day, 0.0)),
        (None, None) => Some((0, time_of_day(first)?)),
        (None, Some(_)) => None,
    }
}

/// Days of a date: year, month, day with `-` or `/`, or day, month, year with points.
fn date(text: &str) -> Option<i64> {
    let parts = |separator: char| -> Option<[i64; 3]> {
        let parts: Vec<i64> = text
            .split(separator)
            .map(|p| p.parse().ok().filter(|_| p.len() <= 4))
            .collect::<Option<_>>()?;
        parts.try_into().ok()
    };
    let (year, month, day) = if let Some([y, m, d]) = parts('-').or_else(|| parts('/')) {
        (y, m, d)
    } else {
        let [d, m, y] = parts('.')?;
        (y, m, d)
    };
    if !((1..=9999).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day)) {
        return None;
    }
    // Years that begin in March have the leap day at their end.
    let (y, m) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    Some(365 * y + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + day)
}

/// Seconds of `hh:mm:ss.f`.
fn time_of_day(text: &str) -> Option<f64> {
    let mut parts = text.split(':');
    let (hours, minutes, seconds) = (parts.next()?, parts.next()?, parts.next()?);
    let seconds: f64 = seconds.replace(',', ".").parse().ok()?;
    let (hours, minutes): (u32, u32) = (hours.parse().ok()?, minutes.parse().ok()?);
    let is_clock = hours < 24 && minutes < 60 && (0.0..61.0).contains(&seconds);
    (parts.next().is_none() && is_clock).then(|| f64::from(hours * 3600 + minutes * 60) + seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_complex_numbers_and_time_stamps_are_told_apart() {
        for (field, value) in [
            ("1,5", Value::Real(1.5)),
            ("-1.5D-3", Value::Real(-1.5e-3)),
            ("0.09+0.57j", Value::Complex(0.09, 0.57)),
            ("(0.09-5.7e-1i)", Value::Complex(0.09, -0.57)),
            ("1e-3 + j2e+2", Value::Complex(1e-3, 200.0)),
            ("-0.57i", Value::Complex(0.0, -0.57)),
            ("12:00:01.25", Value::Time(0, 43_201.25)),
        ] {
            assert_eq!(parse(field), Some(value), "{field}");
        }
        for field in ["one", "", "i + j", "1:2", "2024-13-01", "+-", "j1j"] {
            assert_eq!(parse(field), None, "{field}");
        }
        let day = |text: &str| time_stamp(text).unwrap().0;
        assert_eq!(day("2024-03-01 00:00:00") - day("2024-02-28T23:59:59"), 2);
        assert_eq!(day("01.01.2025") - day("2024/12/31"), 1);
    }
}
