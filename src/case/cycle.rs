//! `[cycle]`: limit cycles found directly.

use super::body::Body;
use super::keys;
use super::range::{Spacing, range_values};
use super::reader::Section;
use super::words::{OnsetChoice, StabilityChoice};
use crate::cycle::Parameter;

/// Shortest transient that puts a cycle to the test: its last fifth has the four periods that a frequency is read from,
/// and a wave that is no motion of the disc is gone by then.
const CONFIRMATION_PERIODS: usize = 20;

/// `[cycle]`: limit cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Circumferential harmonics; `None` takes those that are unstable.
    pub harmonics: Option<Vec<usize>>,
    /// Onsets of each harmonic.
    pub onsets: OnsetChoice,
    /// Phases along the wave; `None` takes as many as the mesh asks for.
    pub phases: Option<usize>,
    /// Times over one period at which the whole field is written.
    pub frames: usize,
    /// Periods of the transient that puts a cycle to the test; 0 for none.
    pub confirmation_periods: usize,
    /// What stability is worked out for.
    pub stability: StabilityChoice,
    /// Continuation over a parameter.
    pub continuation: Option<Continuation>,
}

/// `[cycle.continuation]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Continuation {
    /// Dotted case key.
    pub key: String,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
    /// Values between them, ends included, at which cycles are reported.
    pub count: usize,
    /// How those values are spaced.
    pub spacing: Spacing,
}

impl Continuation {
    /// The values, from first to last.
    pub fn values(&self) -> Vec<f64> {
        range_values(self.from, self.to, self.count, self.spacing)
    }
}

pub(super) fn cycle(root: &Section<'_>, body: Option<&Body>) -> Option<Cycle> {
    let section = root.section("cycle", false);
    let harmonics = section.harmonics(body.and_then(Body::sector_count));
    let onsets = section.choice("onsets");
    let phases = section.optional_count("phases");
    let frames = section.count("frames");
    let confirmation_periods = section.count("confirmation_periods");
    if let periods @ 1..CONFIRMATION_PERIODS = confirmation_periods {
        section.reject(
            "confirmation_periods",
            format!("cycle.confirmation_periods = {periods} is too short to read a frequency from its last fifth"),
            format!("0 for none, or {CONFIRMATION_PERIODS} and more"),
            None,
        );
    }
    let stability = section.choice("stability");
    let inner = section.section("continuation", false);
    let continuation = inner.is_given().then(|| Continuation {
        key: inner.parameter("key"),
        from: inner.number("from"),
        to: inner.number("to"),
        count: inner.count("count"),
        spacing: inner.choice("spacing"),
    });
    if let Some(continuation) = &continuation {
        check_continuation(&inner, continuation);
    }
    if stability == StabilityChoice::Branch && continuation.is_none() {
        section.reject(
            "stability",
            "cycle.stability = \"branch\" needs [cycle.continuation]".to_owned(),
            "needs [cycle.continuation]".to_owned(),
            Some("add that table, or use \"point\"".to_owned()),
        );
    }
    inner.close();
    let is_given = section.is_given();
    section.close();
    is_given.then_some(Cycle {
        harmonics,
        onsets,
        phases,
        frames,
        confirmation_periods,
        stability,
        continuation,
    })
}

fn check_continuation(section: &Section<'_>, continuation: &Continuation) {
    let Continuation {
        key,
        from,
        to,
        spacing,
        ..
    } = continuation;
    let is_numeric = keys::find(key).is_some_and(|known| known.is_numeric());
    if is_numeric && Parameter::from_key(key).is_none() {
        let known = Parameter::ALL.map(Parameter::key);
        section.reject(
            "key",
            format!("limit cycles cannot be followed over {key}"),
            "not one of the parameters of a cycle".to_owned(),
            Some(format!("one of {}", known.join(", "))),
        );
    }
    if from.min(*to) < 0.0 {
        section.reject(
            if *from < 0.0 { "from" } else { "to" },
            format!("{key} cannot be negative along a branch"),
            "must not be negative".to_owned(),
            None,
        );
    } else if *spacing == Spacing::Logarithmic && (*from == 0.0 || *to == 0.0) {
        section.reject(
            "spacing",
            format!(
                "cycle.continuation.spacing = \"log\" needs two positive ends, not {from} and {to}"
            ),
            "both ends must be positive".to_owned(),
            Some("use \"linear\"".to_owned()),
        );
    }
    if from == to {
        section.reject(
            "to",
            format!("cycle.continuation.to = {to} equals from"),
            "must differ from `from`".to_owned(),
            None,
        );
    }
}
