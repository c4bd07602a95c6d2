//! Bytes to lines of text.

/// Decodes UTF-8, UTF-16 (with a byte-order mark) or else Latin-1, drops the mark, and makes every end of a line `\n`.
pub(super) fn decode(bytes: &[u8]) -> String {
    let wide = |rest: &[u8], join: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = rest.chunks_exact(2).map(|p| join([p[0], p[1]])).collect();
        String::from_utf16_lossy(&units)
    };
    let mut text = match bytes {
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => utf8_or_latin1(rest),
        _ => utf8_or_latin1(bytes),
    };
    for end in ["\r\n", "\r"] {
        if text.contains(end) {
            text = text.replace(end, "\n");
        }
    }
    text
}

fn utf8_or_latin1(bytes: &[u8]) -> String {
    let latin1 = |_| bytes.iter().map(|b| char::from(*b)).collect();
    std::str::from_utf8(bytes).map_or_else(latin1, str::to_string)
}

/// Lines with their 1-based numbers.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines())
}

/// The text of a comment line without its mark; `None` for other lines.
pub(super) fn comment(line: &str) -> Option<&str> {
    let trimmed = line.trim_start();
    ["#", "%", "//", "!", "*"].iter().find_map(|mark| trimmed.strip_prefix(mark))
}

/// A field for a message, shortened to what fits.
pub(super) fn shortened(field: &str) -> String {
    frictionsim_bounds::shortened(field, 24)
}

/// The first ten of some names, each shortened, and how many more there are.
pub(super) fn first_of<T: AsRef<str>>(names: impl IntoIterator<Item = T>) -> String {
    let names = names.into_iter().map(|name| shortened(name.as_ref()));
    frictionsim_bounds::first_of(names, 10)
}
