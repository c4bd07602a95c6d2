//! Typed access to the raw tree, held to the declaration of each key, that collects every error
//! instead of stopping at one.

mod lists;

use super::value::{cut, with_point};
use super::{Bound, Kind, keys, suggestion};
use crate::*;
pub(super) use lists::NodePlace;
pub use lists::range_values;

/// Unknown keys of one section that are named; the others are counted.
const MOST_UNKNOWN: usize = 10;

/// Largest whole number that a key takes: products of two are safe in 64 bits.
const LARGEST_COUNT: usize = u32::MAX as usize;

/// The sections that the body is made of are one part of a case.
const BODY: &str =
    "mesh geometry material materials boundaries contact contacts ties motion modifications";

/// The part of a case that a key belongs to.
fn part_of(name: &str) -> &str {
    let section = name.split('.').next().unwrap_or(name);
    if BODY.split(' ').any(|own| own == section) { BODY } else { section }
}

/// Errors and warnings found so far, and what the case may have.
#[derive(Debug)]
pub(crate) struct Findings<'a> {
    pub scope: suggestion::Scope<'a>,
    errors: RefCell<Vec<Diagnostic>>,
    warnings: RefCell<Vec<Diagnostic>>,
    /// Keys and sections that are not there, each with an error about that.
    absent: RefCell<Vec<(String, String)>>,
    /// Values that cannot be read: of which part of the case, whether words or sections, and where they stand.
    misread: RefCell<Vec<(String, bool, Location)>>,
}

impl<'a> Findings<'a> {
    /// Nothing found so far in a case.
    pub fn of(root: &'a RawTable) -> Self {
        let (errors, warnings, absent, misread) = Default::default();
        Self { scope: suggestion::Scope::of(root), errors, warnings, absent, misread }
    }

    /// Takes note of an error that may follow from what the body is.
    pub fn push(&self, error: Diagnostic) {
        if self.misread.borrow().iter().all(|own| own.0 != BODY) {
            self.add(error);
        }
    }

    /// Takes note of an error, where nothing has been said of the value there.
    fn add(&self, error: Diagnostic) {
        if self.misread.borrow().iter().all(|own| own.2 != error.at) {
            self.errors.borrow_mut().push(error);
        }
    }

    /// Takes note of what is no error but what the user should hear of.
    pub fn warn(&self, warning: Diagnostic) {
        self.warnings.borrow_mut().push(warning);
    }

    /// Takes back what was said of a key or section that is not there: it is, by another name.
    fn take_back(&self, name: &str) {
        let absent = self.absent.borrow();
        let is_of_it = |own: &Diagnostic| absent.contains(&(name.to_owned(), own.message.clone()));
        self.errors.borrow_mut().retain(|own| !is_of_it(own));
    }

    /// All errors and all warnings, each in the order found.
    pub fn into_parts(self) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
        (self.errors.into_inner(), self.warnings.into_inner())
    }
}

/// One section of the case. Getters record what is wrong and then return a harmless value (NaN or
/// zero), which later comparisons must not mistake for input: they ask in the form that NaN fails.
///
/// Kind, bound and default of a key are those of its declaration in [`keys::KEYS`].
pub(super) struct Section<'a> {
    pub findings: &'a Findings<'a>,
    path: String,
    table: Option<&'a RawTable>,
    at: Location,
    /// Declarations of its keys, where they are not those of the case.
    declarations: Option<&'static [CaseKey]>,
    asked: RefCell<BTreeSet<String>>,
}

/// Declares a section, a struct: `key: type = getter, "meaning";` is a key that this getter of [`Section`] reads as it
/// stands; behind `with` are fields that take more, which are given: `field: type, "meaning";`.
macro_rules! declared {
    ($(#[$($meta:tt)+])* $name:ident {
        $($key:ident: $type:ty = $read:ident, $meaning:literal;)+
    } $(with { $($field:ident: $of:ty, $what:literal;)+ })?) => {
        $(#[$($meta)+])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $(#[doc = $meaning] pub $key: $type,)+
            $($(#[doc = $what] pub $field: $of,)+)?
        }

        impl $name {
            fn declared(section: &Section<'_> $($(, $field: $of)+)?) -> Self {
                $(let $key = section.$read(stringify!($key));)+
                Self { $($key,)+ $($($field,)+)? }
            }
        }
    };
}
pub(crate) use declared;

impl<'a> Section<'a> {
    /// The whole document; `at` is where missing sections are reported.
    pub fn root(findings: &'a Findings<'a>, table: &'a RawTable, at: Location) -> Self {
        Self::new(findings, String::new(), Some(table), at)
    }

    fn new(all: &'a Findings<'a>, path: String, table: Option<&'a RawTable>, at: Location) -> Self {
        Self { findings: all, path, table, at, declarations: None, asked: RefCell::default() }
    }

    /// Whether the case has this section.
    pub fn is_given(&self) -> bool {
        self.table.is_some()
    }

    /// Full dotted name of a key.
    pub fn name(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// The declaration of a key; what is declared nowhere is free text.
    fn declared(&self, key: &str) -> &'static CaseKey {
        let found = match self.declarations {
            Some(own) => own.iter().find(|known| known.name == key),
            None => keys::find(&self.name(key)),
        };
        debug_assert!(found.is_some(), "{} is not declared", self.name(key));
        found.unwrap_or(&keys::KEYS[0])
    }

    fn item(&self, key: &str) -> Option<&'a RawItem> {
        self.asked.borrow_mut().insert(key.to_owned());
        self.table?.get(key)
    }

    /// What holds for a key: as given, else its default.
    fn held(&self, key: &str) -> Option<Cow<'a, RawItem>> {
        self.item(key).map(Cow::Borrowed).or_else(|| {
            let default = self.declared(key).default_value()?;
            Some(Cow::Owned(RawItem::at(default, &self.place(key))))
        })
    }

    /// Where a key's value is written; the section's head where it is not.
    pub fn place(&self, key: &str) -> Location {
        let item = self.table.and_then(|table| table.get(key));
        item.map_or(&self.at, |item| &item.at).clone()
    }

    /// Whether the case gives a key.
    pub fn has(&self, key: &str) -> bool {
        self.table.is_some_and(|table| table.contains_key(key))
    }

    /// Takes note of keys, apart by blanks, that the case cannot have: those that it gives all the same. A default that
    /// is written out changes nothing.
    pub fn refused<'k>(&self, keys: &'k str) -> Vec<&'k str> {
        let keys = keys.split_whitespace();
        self.asked.borrow_mut().extend(keys.clone().map(str::to_owned));
        self.findings.scope.refused.borrow_mut().extend(keys.clone().map(|key| self.name(key)));
        let is_given = |key: &&str| {
            let value = self.given(key);
            value.is_some_and(|value| !self.declared(key).is_default(value))
        };
        keys.filter(is_given).collect()
    }

    /// Reports an error at a key, with the key's meaning as remedy unless another is given.
    pub fn reject(&self, key: &str, message: String, label: &str, help: Option<String>) {
        let name = self.name(key);
        // It may only seem wrong or missing where a word or section of its part or of the body cannot be read.
        let is_cause = |own: &(String, bool, _)| own.1 && [BODY, part_of(&name)].contains(&&*own.0);
        if self.findings.misread.borrow().iter().any(is_cause) {
            return;
        }
        let help = help.or_else(|| suggestion::usage(&name));
        if !self.has(key) {
            self.findings.absent.borrow_mut().push((name, message.clone()));
        }
        self.findings.add(Diagnostic::error(message, label, self.place(key), help));
    }

    /// Length of a key that is given as a list.
    pub fn list_length(&self, key: &str) -> Option<usize> {
        if let RawValue::Array(items) = self.given(key)? { Some(items.len()) } else { None }
    }

    /// Whether a key is given as this word.
    pub fn is_text(&self, key: &str, word: &str) -> bool {
        self.given(key).and_then(RawValue::text) == Some(word)
    }

    /// Whether a key is given as a string.
    pub fn is_some_text(&self, key: &str) -> bool {
        matches!(self.given(key), Some(RawValue::String(_)))
    }

    fn given(&self, key: &str) -> Option<&'a RawValue> {
        self.table?.get(key).map(|entry| &entry.value)
    }

    /// Reports a value that is not what its key takes; there is nothing to read then.
    fn reject_at<T>(&self, item: &RawItem, key: &str, bound: &str) -> Option<T> {
        let point = item.value.text().and_then(with_point);
        let point = point.map(|point| format!("write the number with a decimal point: {point}"));
        let help = point.or_else(|| suggestion::usage(&self.name(key)));
        let message = format!("{} = {} {bound}", self.name(key), item.value.shortened());
        let error = Diagnostic::error(message, bound, item.at.clone(), help);
        self.misread(key, !self.declared(key).is_numeric(), error);
        None
    }

    /// Reports a value that cannot be read, a number or what others hang on: nothing more is said of it then, but of
    /// another key that has its value from the same place of a mesh file.
    fn misread(&self, key: &str, is_word: bool, error: Diagnostic) {
        let (part, at) = (part_of(&self.name(key)).to_owned(), error.at.clone());
        let mut errors = self.findings.errors.borrow_mut();
        // A material of a mesh file that several regions have is told of once, by a region.
        let own = error.message.strip_prefix(&self.path).unwrap_or(&error.message);
        let is_same = |other: &Diagnostic| other.at == error.at && other.message.ends_with(own);
        errors.retain(|other| !(is_same(other) && other.message.starts_with("material.")));
        if !errors.iter().any(is_same) {
            errors.push(error);
        }
        self.findings.misread.borrow_mut().push((part, is_word, at));
    }

    /// Reports a key that must be there.
    pub fn missing(&self, key: &str) {
        // A missing section is reported once, where it is opened.
        if self.is_given() {
            let message = format!("missing key `{}`", self.name(key));
            self.reject(key, message, &format!("`{key}` is required in this section"), None);
        }
    }

    /// Reports a key that must be there, where it is not.
    pub fn needs(&self, key: &str) {
        if !self.has(key) {
            self.missing(key);
        }
    }

    /// A subsection; `required` ones are reported where absent.
    pub fn section(&self, key: &str, required: bool) -> Section<'a> {
        let mut section = Self::new(self.findings, self.name(key), None, self.at.clone());
        match self.item(key) {
            Some(item) => {
                section.at = item.key_at.clone();
                section.table = item.value.table();
                if section.table.is_none() {
                    let error = placed!(item.at.clone(), "`{}` is {}, not a section", section.path,
                        item.value.kind(); "expected a section"; "write its keys below [{}]",
                        section.path);
                    self.misread(key, true, error);
                }
            }
            None if required => {
                let help = match key {
                    "contact" => "a plane body needs it; `frictionsim init` writes a complete case",
                    _ => "`frictionsim init` writes a complete case to start from",
                };
                let message = format!("missing section [{}]", section.path);
                self.reject(key, message, "the case ends without it", Some(help.to_owned()));
            }
            None => {}
        }
        section
    }

    /// Reports every key that nobody asked for: the first ones by name, then how many more.
    pub fn close(&self) {
        let asked = self.asked.borrow();
        let names: Vec<&str> = asked.iter().map(String::as_str).collect();
        let entries = self.table.into_iter().flatten();
        let mut unknown = entries.filter(|(key, _)| !asked.contains(key.as_str()));
        let section = format!("not a key of [{}]", self.path);
        let root = "the case has no such section or key";
        let place = if self.path.is_empty() { root } else { &section };
        for (key, entry) in unknown.by_ref().take(MOST_UNKNOWN) {
            let word = (key.as_str(), &entry.value);
            let help = match self.declarations {
                Some(own) => suggestion::suggest_part(key, own),
                None => self.findings.scope.suggest(&self.path, word, &names),
            };
            if let Some(meant) = suggestion::meant_here(&help) {
                self.findings.take_back(&self.name(meant));
            }
            let message = format!("unknown key `{}`", cut(self.name(key)));
            self.findings.add(Diagnostic::error(message, place, entry.key_at.clone(), Some(help)));
        }
        if let Some((_, first)) = unknown.next() {
            let count = 1 + unknown.count();
            self.findings.add(placed!(first.key_at.clone(),
                "{count} more unknown keys, of which this is the first"; "{place}"));
        }
    }

    /// Every entry of the section that has not been asked for, as swept keys.
    pub fn remaining(&self) -> Vec<(&'a str, &'a RawItem)> {
        let asked = self.asked.borrow();
        let entries = self.table.into_iter().flatten();
        let rest = entries.filter(|(key, _)| !asked.contains(key.as_str()));
        rest.map(|(key, entry)| (key.as_str(), entry)).collect()
    }

    fn read_number(&self, key: &str, item: &RawItem, bound: Bound) -> Option<f64> {
        match item.value.number() {
            Some(value) if bound.admits(value) => Some(value),
            Some(_) => self.reject_at(item, key, &bound.text()),
            None => {
                self.reject_at(item, key, &format!("must be a number, not {}", item.value.kind()))
            }
        }
    }

    /// A number: as given (NaN where that is wrong), else its default, else none. The word that a
    /// key may have in a number's place is none, too.
    pub fn optional_number(&self, key: &str) -> Option<f64> {
        let declared = self.declared(key);
        let (bound, word) = match declared.kind {
            Kind::Number(bound) | Kind::Numbers(bound) => (bound, None),
            Kind::NumberOr(bound, word) => (bound, Some(word)),
            _ => (Bound::FINITE, None),
        };
        match (self.item(key), word) {
            (Some(_), Some(word)) if self.is_text(key, word) => None,
            (Some(item), Some(word)) if self.is_some_text(key) => {
                self.reject_at(item, key, &format!("must be a number or \"{word}\""))
            }
            (Some(item), _) => Some(self.read_number(key, item, bound).unwrap_or(f64::NAN)),
            (None, _) => declared.default_value()?.number(),
        }
    }

    /// A number that is given or has a default; NaN where it is missing.
    pub fn number(&self, key: &str) -> f64 {
        self.optional_number(key).unwrap_or_else(|| {
            self.missing(key);
            f64::NAN
        })
    }

    fn read_count(&self, key: &str, item: &RawItem, least: usize) -> Option<usize> {
        let value = match item.value {
            RawValue::Integer(value) => value,
            // Ranges produce numbers: a whole one is a count.
            RawValue::Float(value) if value.fract() == 0.0 && value.abs() < 9e15 => value as i64,
            ref other => {
                return self.reject_at(
                    item,
                    key,
                    &format!("must be an integer, not {}", other.kind()),
                );
            }
        };
        match usize::try_from(value) {
            Ok(value) if value > LARGEST_COUNT => {
                self.reject_at(item, key, &format!("must be {LARGEST_COUNT} or less"))
            }
            Ok(value) if value >= least => Some(value),
            _ => self.reject_at(item, key, &format!("must be {least} or more")),
        }
    }

    fn least(&self, key: &str) -> usize {
        match self.declared(key).kind {
            Kind::Count(least) | Kind::Counts(least) => least,
            _ => 0,
        }
    }

    /// A whole number: as given (0 where that is wrong), else its default, else none.
    pub fn optional_count(&self, key: &str) -> Option<usize> {
        let item = self.held(key)?;
        Some(self.read_count(key, &item, self.least(key)).unwrap_or(0))
    }

    /// A whole number that is given or has a default; 0 where it is missing.
    pub fn count(&self, key: &str) -> usize {
        self.optional_count(key).unwrap_or_else(|| {
            self.missing(key);
            0
        })
    }

    /// True or false; false without a default.
    pub fn flag(&self, key: &str) -> bool {
        let read = self.item(key).and_then(|item| match item.value {
            RawValue::Boolean(value) => Some(value),
            _ => self.reject_at(item, key, "must be true or false"),
        });
        read.unwrap_or(self.declared(key).default_toml() == Some("true"))
    }

    /// Text: as given, else its default, else none.
    pub fn optional_text(&self, key: &str) -> Option<String> {
        let item = self.held(key)?;
        let text = item.value.text().map(str::to_owned);
        text.or_else(|| self.reject_at(&item, key, "must be a string"))
    }

    /// Text that is given or has a default.
    pub fn text(&self, key: &str) -> String {
        self.optional_text(key).unwrap_or_else(|| {
            self.needs(key);
            String::new()
        })
    }

    /// One of a few words; the default where the key is left out or wrong.
    pub fn choice<T: Choice>(&self, key: &str) -> T {
        self.item(key).and_then(|item| self.read_choice(key, item)).unwrap_or_else(|| {
            let default = self.declared(key).default_text().trim_matches('"');
            T::of(default).unwrap_or(T::WORDS[0].1)
        })
    }

    fn read_choice<T: Choice>(&self, key: &str, item: &RawItem) -> Option<T> {
        let words = T::words();
        let bound = format!("must be one of \"{}\"", words.join("\", \""));
        if let RawValue::String(text) = &item.value {
            if let Some(choice) = T::of(text) {
                return Some(choice);
            }
            if let Some(near) = suggestion::nearest_word(text, &words) {
                let error = placed!(item.at.clone(), "{} = {} is not one of its values",
                    self.name(key), item.value.shortened(); "{bound}"; "did you mean \"{near}\"?");
                self.misread(key, true, error);
                return None;
            }
        }
        self.reject_at(item, key, &bound)
    }
}
