//! Nodes of universal files: datasets 15, 781 and 2411.

use crate::deck::{quoted, real};

/// A line whose numbers are apart, also where a sign is all that separated them: fields of a fixed width may touch.
#[must_use]
pub fn universal_fields(line: &str) -> String {
    let mut spread = String::with_capacity(line.len() + 8);
    let mut before = ' ';
    for c in line.chars() {
        if matches!(c, '-' | '+') && before.is_ascii_digit() {
            spread.push(' ');
        }
        spread.push(if matches!(c, 'd' | 'D') { 'E' } else { c });
        before = c;
    }
    spread
}

/// Label and place of a node by its lines: three numbers, behind the label and three others on a line of their own.
///
/// # Errors
/// What is missing, in words.
pub fn universal_node(lines: &[impl AsRef<str>]) -> Result<(usize, [f64; 3]), String> {
    let [first, last] = [lines.first(), lines.last()].map(|line| line.map_or("", AsRef::as_ref));
    let label = first.split_whitespace().next().unwrap_or_default();
    let Ok(label) = label.parse() else {
        return Err(format!("the number of a node expected, found {}", quoted(label)));
    };
    let before = if lines.len() == 1 { 4 } else { 0 };
    let fields = universal_fields(last);
    let mut words = fields.split_whitespace().skip(before);
    let place = [0; 3].map(|_| {
        let word = words.next().ok_or_else(|| format!("node {label} needs three coordinates"))?;
        real(word).ok_or_else(|| format!("a coordinate expected, found {}", quoted(word)))
    });
    let [x, y, z] = place;
    Ok((label, [x?, y?, z?]))
}
