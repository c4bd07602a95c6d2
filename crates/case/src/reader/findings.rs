//! What was found wrong with a case.

use crate::{Diagnostic, RawTable, suggestion};
use std::cell::RefCell;

/// Errors and warnings found so far, and what the case may have.
#[derive(Debug)]
pub(crate) struct Findings<'a> {
    pub scope: suggestion::Scope<'a>,
    errors: RefCell<Vec<Diagnostic>>,
    warnings: RefCell<Vec<Diagnostic>>,
    /// Keys and sections that are not there, each with an error about that.
    pub(super) absent: RefCell<Vec<(String, String)>>,
}

impl<'a> Findings<'a> {
    /// Nothing found so far in a case.
    pub fn of(root: &'a RawTable) -> Self {
        let (errors, warnings, absent) = Default::default();
        Self { scope: suggestion::Scope::of(root), errors, warnings, absent }
    }

    /// Takes note of an error.
    pub fn push(&self, error: Diagnostic) {
        self.errors.borrow_mut().push(error);
    }

    /// Takes note of what is no error but what the user should hear of.
    pub fn warn(&self, warning: Diagnostic) {
        self.warnings.borrow_mut().push(warning);
    }

    /// Takes back what was said of a key or section that is not there: it is, by another name.
    pub(super) fn take_back(&self, name: &str) {
        let absent = self.absent.borrow();
        let is_of_it = |own: &Diagnostic| absent.contains(&(name.to_owned(), own.message.clone()));
        self.errors.borrow_mut().retain(|own| !is_of_it(own));
    }

    /// All errors and all warnings, each in the order found.
    pub fn into_parts(self) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
        (self.errors.into_inner(), self.warnings.into_inner())
    }
}
