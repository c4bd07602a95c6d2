//! Text from files and options, made safe to show on a terminal.

use crate::*;

/// Whether a terminal or a reader would act on a character instead of showing it: control characters of both sets
/// and the marks that turn the direction of writing. Tab and newline are text.
fn is_hidden(c: char) -> bool {
    let is_control = c.is_control() && c != '\n' && c != '\t';
    is_control
        || matches!(c, '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}')
        || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{fff9}'..='\u{fffb}')
}

/// `text` with such characters written by `write`.
fn rewritten(text: &str, write: impl Fn(&mut String, char)) -> Cow<'_, str> {
    if !text.chars().any(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_hidden(c) { write(&mut out, c) } else { out.push(c) }
    }
    Cow::Owned(out)
}

/// `text` with every control character and every mark of the writing direction escaped, as `\u{1b}`.
pub fn shown(text: &str) -> Cow<'_, str> {
    rewritten(text, |out, c| out.extend(c.escape_default()))
}

/// JSON text with such characters as escapes of JSON, `\u009b`: they can only stand within its strings.
pub fn shown_json(text: &str) -> Cow<'_, str> {
    rewritten(text, |out, c| {
        for unit in c.encode_utf16(&mut [0; 2]) {
            // Writing to a string cannot fail.
            let _ = write!(out, "\\u{unit:04x}");
        }
    })
}

/// `text` with such characters replaced by others of the same length in bytes: places in it stay places.
pub(super) fn shown_in_place(text: &str) -> Cow<'_, str> {
    rewritten(text, |out, c| {
        out.push(match c.len_utf8() {
            1 => '?',
            2 => '\u{b7}',
            3 => '\u{fffd}',
            // A replacement of four bytes, for completeness: no such character is hidden today.
            _ => '\u{1f6ab}',
        });
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_and_direction_marks_are_escaped_and_text_is_not() {
        let plain = "Scheibe \u{b5} = 0,3\tÄ\n日本";
        assert!(matches!(shown(plain), Cow::Borrowed(text) if text == plain));
        let evil = "a\u{1b}]0;b\u{7}\u{9b}31m\u{202e}c\r\u{7f}";
        assert_eq!(shown(evil), "a\\u{1b}]0;b\\u{7}\\u{9b}31m\\u{202e}c\\r\\u{7f}");
        let json = serde_json::to_string(&evil).unwrap();
        let safe = shown_json(&json);
        assert!(!safe.chars().any(is_hidden), "{safe}");
        assert_eq!(serde_json::from_str::<String>(&safe).unwrap(), evil);
        assert_eq!(shown_in_place(evil).len(), evil.len());
    }
}
