//! Diagnostics of a case: what is wrong, where, and the remedy.

use super::shown;
use super::shown::shown_in_place;
use crate::*;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;

/// Errors of a case that are shown; the others are counted.
const MOST_ERRORS: usize = 10;
/// Longest message, in characters: keys and words of a case have any length.
const LONGEST_MESSAGE: usize = 2000;

/// Remedy for a path of Windows.
pub(super) const BACKSLASH: &str = "in \"...\" a backslash begins an escape: use / or '...'";

/// A place in the case file (source 0) or in an override (source 1, 2, ...).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Location {
    /// Which text.
    pub source: usize,
    /// Bytes of it.
    pub span: Range<usize>,
}

impl Location {
    /// The place `span` of text `source`.
    pub fn new(source: usize, span: Range<usize>) -> Self {
        Self { source, span }
    }
}

/// A text that diagnostics point into.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// File name, or `--set`.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// One error of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, with the key and the value.
    pub message: String,
    /// The short form under the caret: the bound.
    pub label: String,
    /// Where.
    pub at: Location,
    /// The remedy.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error at a place.
    pub fn error(
        message: impl Into<String>,
        label: impl Into<String>,
        at: Location,
        help: Option<String>,
    ) -> Self {
        let (message, label) = (message.into(), label.into());
        let is_escaped = message.contains(|c: char| c.is_control() && c != '\n');
        let help = if is_escaped { Some(BACKSLASH.to_owned()) } else { help };
        Self { message, label, at, help }
    }
}

impl std::fmt::Display for Diagnostic {
    /// Message and remedy on one line.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.message)?;
        self.help.iter().try_for_each(|help| write!(f, " ({help})"))
    }
}

/// Every error of a case, with the texts they point into.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.render(false))]
pub struct CaseErrors {
    /// The case file, then the overrides.
    pub sources: Vec<Source>,
    /// The errors, unknown keys first.
    pub diagnostics: Vec<Diagnostic>,
}

impl CaseErrors {
    /// The message of each error.
    pub fn messages(&self) -> Vec<String> {
        self.diagnostics.iter().map(|error| error.message.clone()).collect()
    }

    /// All of them in one line.
    pub fn line(&self) -> String {
        self.messages().join("; ")
    }

    /// A report for people: each error with file, line, column, caret and remedy.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let safe = self.shown();
        let mut out = String::new();
        for (index, diagnostic) in safe.diagnostics.iter().enumerate() {
            if index > 0 {
                out.push_str("\n\n");
            }
            out.push_str(&renderer.render(&safe.groups(diagnostic)));
        }
        let hidden = self.diagnostics.len() - safe.diagnostics.len();
        if hidden > 0 {
            let _ = write!(out, "\n\n... and {hidden} more errors");
        }
        out
    }

    /// The first errors, with texts that a terminal shows as they are.
    fn shown(&self) -> Self {
        let source = |source: &Source| Source {
            name: shown(&source.name).into_owned(),
            text: shown_in_place(&source.text).into_owned(),
        };
        let diagnostic = |found: &Diagnostic| Diagnostic {
            message: cut(&shown(&found.message)),
            label: cut(&shown(&found.label)),
            at: found.at.clone(),
            help: found.help.as_deref().map(|help| cut(&shown(help))),
        };
        Self {
            sources: self.sources.iter().map(source).collect(),
            diagnostics: self.diagnostics.iter().take(MOST_ERRORS).map(diagnostic).collect(),
        }
    }

    fn groups<'a>(&'a self, diagnostic: &'a Diagnostic) -> [Group<'a>; 1] {
        let title = Level::ERROR.primary_title(diagnostic.message.as_str());
        let mut group = match self.sources.get(diagnostic.at.source) {
            Some(source) => {
                let span = clamp(&diagnostic.at.span, &source.text);
                let label = Some(diagnostic.label.as_str()).filter(|label| !label.is_empty());
                let annotation = AnnotationKind::Primary.span(span).label(label);
                let snippet = Snippet::source(source.text.as_str()).path(source.name.as_str());
                title.element(snippet.annotation(annotation))
            }
            None => Group::with_title(title),
        };
        if let Some(help) = &diagnostic.help {
            group = group.element(Level::HELP.message(help.as_str()));
        }
        [group]
    }
}

/// The part of `span` that lies in `text`, on character boundaries and within its first line.
fn clamp(span: &Range<usize>, text: &str) -> Range<usize> {
    let floor = |mut index: usize| {
        index = index.min(text.len());
        while !text.is_char_boundary(index) {
            index -= 1;
        }
        index
    };
    let start = floor(span.start);
    let end = floor(span.end.max(start)).max(start);
    text[start..end].find('\n').map_or(start..end, |newline| start..start + newline)
}

/// A text cut at [`LONGEST_MESSAGE`].
fn cut(text: &str) -> String {
    let end = text.char_indices().nth(LONGEST_MESSAGE);
    end.map_or_else(|| text.to_owned(), |(end, _)| format!("{} ...", &text[..end]))
}

/// What is wrong with a key; the short form under the caret; the remedy, without which the usage of the key is shown.
#[macro_export]
macro_rules! said {
    ($method:ident, $on:expr, $key:expr, $message:literal $(, $part:expr)*;
     $label:literal $(, $of:expr)* $(; $help:literal $(, $by:expr)*)?) => {
        $on.$method(
            $key,
            format!($message $(, $part)*),
            &format!($label $(, $of)*),
            $crate::said!($($help $(, $by)*)?),
        )
    };
    () => { None };
    ($help:literal $(, $by:expr)*) => { Some(format!($help $(, $by)*)) };
}

/// The error of a case at one of its keys: `refusal!(case, key, what; label; remedy)`.
#[macro_export]
macro_rules! refusal {
    ($case:expr, $($said:tt)*) => { $crate::said!(error_at, $case, $($said)*) };
}

/// What is said at a place.
macro_rules! placed {
    ($at:expr, $message:literal $(, $part:expr)*;
     $label:literal $(, $of:expr)* $(; $help:literal $(, $by:expr)*)?) => {
        $crate::Diagnostic::error(
            format!($message $(, $part)*),
            format!($label $(, $of)*),
            $at,
            $crate::said!($($help $(, $by)*)?),
        )
    };
}

/// The same among other errors, or as a warning.
macro_rules! diagnosis {
    ($case:expr, $key:expr, $($said:tt)*) => {
        placed!($case.raw.place($key), $($said)*)
    };
}

/// Refuses a key of a section: `refuse!(section, key, what; label; remedy)`; behind `=>` what is wrong follows the
/// key's name.
macro_rules! refuse {
    ($section:expr, $key:expr => $message:literal $(, $part:expr)*; $($rest:tt)*) => {
        refuse!($section, $key, "{} {}", $section.name($key),
            format_args!($message $(, $part)*); $($rest)*)
    };
    ($section:expr, $($said:tt)*) => { $crate::said!(reject, $section, $($said)*) };
}

/// Refuses a key where something holds: `refuse_if!(condition; section, key, what; label; remedy)`.
macro_rules! refuse_if {
    ($condition:expr; $($said:tt)*) => {
        if $condition {
            refuse!($($said)*);
        }
    };
}

/// Refuses those of some keys, apart by blanks, that a section gives: `refuse_each!(section, keys; key, what; ...)`.
macro_rules! refuse_each {
    ($section:expr, $keys:expr; $key:ident $($said:tt)*) => {
        for $key in $section.refused($keys) {
            refuse!($section, $key $($said)*);
        }
    };
}

/// Refuses what stands at a place: `refuse_at!(section, place, what; label; remedy)`.
macro_rules! refuse_at {
    ($section:expr, $at:expr, $($said:tt)*) => {
        $section.findings.push(placed!($at.clone(), $($said)*))
    };
}

/// As [`refuse!`] what is no error but what the user should hear of.
macro_rules! caution {
    ($section:expr, $key:expr => $message:literal $(, $part:expr)*; $($rest:tt)*) => {
        caution!($section, $key, "{} {}", $section.name($key),
            format_args!($message $(, $part)*); $($rest)*)
    };
    ($section:expr, $key:expr, $($said:tt)*) => {
        $section.findings.warn(placed!($section.place($key), $($said)*))
    };
}

/// As [`refuse_if!`] what is no error.
macro_rules! caution_if {
    ($condition:expr; $($said:tt)*) => {
        if $condition {
            caution!($($said)*);
        }
    };
}
