//! The log: one line for each event, for a terminal or for another program.

use crate::case::shown;
use std::io::Write;
use tracing::{Dispatch, Event, Level, Subscriber};
use tracing_subscriber::fmt::{FmtContext, FormatEvent, FormatFields};
use tracing_subscriber::{fmt::format::Writer, registry::LookupSpan};

/// A log that keeps warnings, each line written to what `writer` gives.
pub fn warnings_into<W: Write + 'static>(
    writer: impl Fn() -> W + Send + Sync + 'static,
) -> Dispatch {
    let subscriber = tracing_subscriber::fmt()
        .with_writer(writer)
        .with_ansi(false)
        .with_max_level(Level::WARN)
        .event_format(Line);
    subscriber.finish().into()
}

/// A line of the log: its level, coloured where stderr takes colours, and its text with control characters escaped.
pub struct Line;

impl<S, N> FormatEvent<S, N> for Line
where
    S: Subscriber + for<'a> LookupSpan<'a>,
    N: for<'a> FormatFields<'a> + 'static,
{
    fn format_event(
        &self,
        context: &FmtContext<'_, S, N>,
        mut out: Writer<'_>,
        event: &Event<'_>,
    ) -> std::fmt::Result {
        let level = event.metadata().level();
        let colour = match *level {
            Level::ERROR => 31,
            Level::WARN => 33,
            Level::INFO => 32,
            Level::DEBUG => 34,
            Level::TRACE => 35,
        };
        match out.has_ansi_escapes() {
            true => write!(out, "\x1b[{colour}m{level:>5}\x1b[0m ")?,
            false => write!(out, "{level:>5} ")?,
        }
        let mut text = String::new();
        context.format_fields(Writer::new(&mut text), event)?;
        writeln!(out, "{}", shown(&text))
    }
}
