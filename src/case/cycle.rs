//! `[cycle]`: limit cycles found directly.

use super::reader::{Bound, Section};
use super::rules::{harmonics, parameter};
use crate::mesh::AnnulusSpecification;

/// `[cycle]`: limit cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Circumferential harmonics; `None` takes those that are unstable.
    pub harmonics: Option<Vec<usize>>,
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
}

pub(super) fn cycle(root: &Section<'_>, annulus: &AnnulusSpecification) -> Option<Cycle> {
    let section = root.section("cycle", false);
    let harmonics = harmonics(&section, 1, annulus);
    let inner = section.section("continuation", false);
    let continuation = inner.is_given().then(|| Continuation {
        key: parameter(&inner, "key"),
        from: inner.number("from", Bound::Finite),
        to: inner.number("to", Bound::Finite),
    });
    if let Some(Continuation { from, to, .. }) = &continuation
        && from == to
    {
        inner.reject(
            "to",
            format!("cycle.continuation.to = {to} equals from"),
            "must differ from `from`".to_owned(),
            None,
        );
    }
    inner.close();
    let is_given = section.is_given();
    section.close();
    is_given.then_some(Cycle {
        harmonics,
        continuation,
    })
}
