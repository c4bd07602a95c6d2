//! Every key a case can have: the one declaration, in `keys.txt`, that readers, messages,
//! `frictionsim keys`, the JSON schema and the commented template are made from. Of a key it says kind of value, bound,
//! unit, default and meaning.

use super::words::words_named;
use crate::*;
use std::sync::LazyLock;

/// Where a number must lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The ends of what it admits.
    pub ends: [f64; 2],
    /// Whether a finite end is admitted itself.
    pub is_closed: bool,
}

impl Bound {
    /// Any finite number.
    pub const FINITE: Self = Self { ends: [f64::NEG_INFINITY, f64::INFINITY], is_closed: false };

    /// Whether a value lies there; NaN and infinities never do.
    pub fn admits(self, value: f64) -> bool {
        let [low, high] = self.ends;
        let is_within = value > low && value < high;
        value.is_finite() && (is_within || self.is_closed && self.ends.contains(&value))
    }

    /// What an error says.
    pub fn text(self) -> String {
        match self.ends {
            [low, high] if high.is_finite() => {
                format!("must lie strictly between {low} and {high}")
            }
            [low, _] if low.is_infinite() => "must be finite".to_owned(),
            [0.0, _] if self.is_closed => "must be zero or positive, and finite".to_owned(),
            [0.0, _] => "must be positive and finite".to_owned(),
            [low, _] => format!("must be {low} or more, and finite"),
        }
    }

    /// The bound of a condition behind the word "number".
    fn of_condition(text: &str) -> Option<Self> {
        let ends = |[low, high]: [&str; 2]| Some([low.parse().ok()?, high.parse().ok()?]);
        let (ends, is_closed) = match text.split(' ').collect::<Vec<_>>()[..] {
            [""] => return Some(Self::FINITE),
            ["", ">", "0"] => (ends(["0", "inf"]), false),
            ["", ">=", low] => (ends([low, "inf"]), true),
            ["", "between", low, "and", high] => (ends([low, high]), false),
            _ => return None,
        };
        Some(Self { ends: ends?, is_closed })
    }
}

/// The kind of value that a key takes.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Free text.
    Text,
    /// Texts: one or a list.
    Texts,
    /// True or false.
    Flag,
    /// A number.
    Number(Bound),
    /// A number, or one word that stands for its absence.
    NumberOr(Bound, &'static str),
    /// Numbers: one, a list, or a range `{ from, to, count, spacing }`.
    Numbers(Bound),
    /// A whole number of at least this.
    Count(usize),
    /// Whole numbers of at least this: one or a list without repetition.
    Counts(usize),
    /// A node: its number, or a place whose nearest node it is.
    Node,
    /// Nodes, each by number or place: one or a list without repetition.
    Nodes,
    /// One of a few words.
    Choice(fn() -> Vec<&'static str>),
    /// Some of a few words: one or a list.
    Choices(fn() -> Vec<&'static str>),
    /// One of a few words, or two vectors.
    Directions(fn() -> Vec<&'static str>),
    /// The dotted name of a case key whose value is a number.
    Parameter,
    /// A table whose keys are case keys.
    Table,
}

impl Kind {
    /// The kind of a declaration: `number > 0`, `integer >= 1 or list`, `one CeaMethod`.
    fn read(text: &'static str) -> Option<Self> {
        if let Some(least) = text.strip_prefix("integer >= ") {
            return match least.strip_suffix(" or list") {
                Some(least) => least.parse().ok().map(Self::Counts),
                None => least.parse().ok().map(Self::Count),
            };
        }
        if let Some(bound) = text.strip_prefix("number") {
            if let Some(bound) = bound.strip_suffix(", list or range") {
                return Bound::of_condition(bound).map(Self::Numbers);
            }
            let Some((bound, word)) = bound.split_once(" or ") else {
                return Bound::of_condition(bound).map(Self::Number);
            };
            return Some(Self::NumberOr(Bound::of_condition(bound)?, word.trim_matches('"')));
        }
        Some(match (text, text.split_once(' ')) {
            ("text", _) => Self::Text,
            ("text or list", _) => Self::Texts,
            ("true or false", _) => Self::Flag,
            ("node", _) => Self::Node,
            ("node or list", _) => Self::Nodes,
            ("numeric case key", _) => Self::Parameter,
            (_, Some(("table", _))) => Self::Table,
            (_, Some(("some", name))) => Self::Choices(words_named(name)?),
            (_, Some(("one", name))) => match name.strip_suffix(" or two vectors") {
                Some(name) => Self::Directions(words_named(name)?),
                None => Self::Choice(words_named(name)?),
            },
            _ => return None,
        })
    }
}

/// A key of the case file: everything that is known of it but what it does.
///
/// A `*` in the name stands for any one name, as in `materials.*.density`.
#[derive(Clone, Copy, Debug)]
pub struct CaseKey {
    /// Dotted name.
    pub name: &'static str,
    /// The values it takes, as declared.
    pub(super) declared: &'static str,
    /// Their kind.
    pub kind: Kind,
    /// Unit of the value; empty for a pure number and for what is no number.
    pub unit: &'static str,
    /// What holds where it is left out: `= VALUE` in TOML, else in words.
    default: &'static str,
    /// A valid value, in TOML.
    pub example: &'static str,
    /// What it is, to be read behind "is".
    pub meaning: &'static str,
    /// What holds where `cycle` and `basin` seek rotating waves, which do not use it; empty of a key that every command
    /// uses.
    pub of_waves: &'static str,
    /// Names that other programs and papers have for it, apart by commas.
    pub(super) called: &'static str,
}

impl CaseKey {
    /// The key of a declaration, `name | values | unit | default | example`, and of what it is.
    pub(super) fn read(head: &'static str, text: &'static str) -> Option<Self> {
        let fields: Vec<&str> = head.split(" | ").collect();
        let [name, declared, unit, default, example] = fields[..] else { return None };
        let (text, called) = text.split_once(" also called: ").unwrap_or((text, ""));
        let (meaning, of_waves) = text.split_once(" of waves: ").unwrap_or((text, ""));
        let (kind, unit) = (Kind::read(declared)?, if unit == "-" { "" } else { unit });
        Some(Self { name, declared, kind, unit, default, example, meaning, of_waves, called })
    }

    /// This key in a section. Bodies whose sections have names of their own have no rotating waves.
    fn within(self, section: &str) -> Self {
        let name = match section {
            "" => self.name,
            _ => format!("{section}.{}", self.name).leak(),
        };
        Self { name, of_waves: if section.contains('*') { "" } else { self.of_waves }, ..self }
    }

    /// Whether the value is a single number, as a parameter study or a branch varies it.
    pub fn is_numeric(&self) -> bool {
        matches!(self.kind, Kind::Number(_) | Kind::NumberOr(..) | Kind::Count(_) | Kind::Node)
    }

    /// Where the value of a continuous parameter may lie; none of what is no such parameter.
    pub(super) fn continuous(&self) -> Option<Bound> {
        if let Kind::Number(own) | Kind::NumberOr(own, _) = self.kind { Some(own) } else { None }
    }

    /// Whether it may have a value of this kind: a number, or anything else but a section.
    pub(super) fn takes(&self, value: &RawValue) -> bool {
        let is_list = matches!(self.kind, Kind::Numbers(_) | Kind::Counts(_) | Kind::Nodes);
        match value {
            RawValue::Table(_) => false,
            RawValue::String(_) => !(is_list || self.is_numeric()),
            _ => value.number().is_none() || is_list || self.is_numeric(),
        }
    }

    /// The name without its section.
    pub fn short(&self) -> &'static str {
        self.name.rsplit('.').next().unwrap_or(self.name)
    }

    /// The section; empty for keys of the case itself.
    pub fn section(&self) -> &'static str {
        self.name.rsplit_once('.').map_or("", |pair| pair.0)
    }

    /// Whether this is the entry of a dotted name.
    pub(super) fn is_named(&self, name: &str) -> bool {
        let (own, given) = (self.name.split('.'), name.split('.'));
        self.name == name
            || self.name.contains('*')
                && own.clone().count() == given.clone().count()
                && own.zip(given).all(|(own, given)| own == "*" || own == given)
    }

    /// Whether others call it by this word.
    pub(super) fn is_called(&self, word: &str) -> bool {
        self.called.split_terminator(", ").any(|own| own == word)
    }

    /// What it is, with its unit.
    pub(super) fn meaning_with_unit(&self) -> String {
        match self.unit {
            "" => self.meaning.to_owned(),
            unit => format!("{}, {unit}", self.meaning),
        }
    }

    /// The values it takes, in words.
    pub fn values(&self) -> String {
        match self.kind {
            Kind::Node => "node number, { x, y } or { radius, angle_deg }".to_owned(),
            Kind::Nodes => "node number, { x, y }, { radius, angle_deg } or list".to_owned(),
            Kind::Choice(words) => format!("\"{}\"", words().join("\", \"")),
            Kind::Choices(words) => format!("some of \"{}\"", words().join("\", \"")),
            Kind::Directions(words) => format!("\"{}\" or two vectors", words().join("\", \"")),
            _ => self.declared.to_owned(),
        }
    }

    /// The value that holds where it is left out, in TOML; none where words say what holds.
    pub fn default_toml(&self) -> Option<&'static str> {
        self.default.strip_prefix("= ")
    }

    /// What holds where it is left out, in words.
    pub fn default_text(&self) -> &'static str {
        self.default_toml().unwrap_or(self.default)
    }

    /// Whether its section needs it, or what its default says in its place.
    pub(super) fn is_required(&self) -> bool {
        self.default.starts_with("required")
    }

    /// Whether a value is what holds where the key is left out.
    pub(super) fn is_default(&self, value: &RawValue) -> bool {
        let default = self.default_value().map(|value| value.to_string());
        let default = default.unwrap_or_else(|| self.default_text().to_owned());
        value.to_string().trim_matches('"') == default.trim_matches('"')
    }

    /// The default's value, where it has one.
    pub(super) fn default_value(&self) -> Option<RawValue> {
        RawValue::parse(self.default_toml()?)
    }
}

/// Sections, and a key that all of them have.
type Shared = (&'static str, CaseKey);

/// The declarations of a text of this program, which says at its head how they are written.
fn declared(text: &'static str) -> Vec<Shared> {
    let mut sections = "";
    let mut entries: Vec<(&str, String, String)> = Vec::new();
    for line in text.lines() {
        match (line.chars().next(), entries.last_mut()) {
            (None | Some('#'), _) => {}
            (Some('['), _) => sections = line.trim_matches(['[', ']']),
            (Some(' '), Some((_, head, meaning))) => {
                let goes_on = head.ends_with('\\');
                head.truncate(head.trim_end_matches([' ', '\\']).len());
                let place = if goes_on { head } else { meaning };
                let gap = if place.is_empty() { "" } else { " " };
                *place += &format!("{gap}{}", line.trim());
            }
            _ => entries.push((sections, line.to_owned(), String::new())),
        }
    }
    let keys = entries.into_iter().map(|(sections, head, meaning)| {
        let head = &*head.leak();
        let key = CaseKey::read(head, meaning.leak());
        (sections, key.unwrap_or_else(|| panic!("`{head}` declares no key")))
    });
    keys.collect()
}

/// The keys of sections, those of one section where its first one stands.
fn in_sections(rows: impl IntoIterator<Item = Shared>) -> Vec<CaseKey> {
    let pairs = rows
        .into_iter()
        .flat_map(|(sections, key)| sections.split(", ").map(move |section| key.within(section)));
    let mut all: Vec<CaseKey> = pairs.collect();
    let order: Vec<&str> = all.iter().map(CaseKey::section).collect();
    all.sort_by_cached_key(|key| order.iter().position(|section| *section == key.section()));
    all
}

/// All keys in the order of the documentation.
pub static KEYS: LazyLock<Vec<CaseKey>> =
    LazyLock::new(|| in_sections(declared(include_str!("keys.txt"))));

/// What stands for values.
static VALUES: LazyLock<Vec<Shared>> = LazyLock::new(|| declared(include_str!("values.txt")));

/// The keys of what stands for a value.
fn of_values(wanted: &str) -> Vec<CaseKey> {
    VALUES.iter().filter(|own| own.0 == wanted).map(|own| own.1).collect()
}

/// The keys of a range, which stands for a list of numbers.
pub(super) static RANGE: LazyLock<Vec<CaseKey>> = LazyLock::new(|| of_values("range"));

/// The keys of a place, which stands for the node nearest to it.
pub(super) static PLACE: LazyLock<Vec<CaseKey>> = LazyLock::new(|| of_values("place"));

/// Numbers of lists.
static ELEMENTS: LazyLock<Vec<CaseKey>> = LazyLock::new(|| {
    in_sections(VALUES.iter().copied().filter(|own| !["range", "place"].contains(&own.0)))
});

/// A dotted name with places in lists as parts of it: `KEY[2]` as `KEY.2`.
pub(super) fn dotted(name: &str) -> Cow<'_, str> {
    let mut parts = name.split('[');
    let mut with_parts = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.split_once(']').filter(|(place, _)| {
            !place.is_empty() && place.bytes().all(|byte| byte.is_ascii_digit())
        });
        match digits {
            Some((place, rest)) => with_parts += &format!(".{place}{rest}"),
            None => with_parts += &format!("[{part}"),
        }
    }
    if with_parts == name { Cow::Borrowed(name) } else { Cow::Owned(with_parts) }
}

/// The place in a list, from 0, that the last part of a dotted name gives counted from 1.
pub(super) fn list_place(part: &str) -> Option<usize> {
    part.parse::<usize>().ok()?.checked_sub(1)
}

/// The entry of a dotted key, of a number in a list, or of a key of a range.
pub fn find(name: &str) -> Option<&'static CaseKey> {
    KEYS.iter().find(|key| key.is_named(name)).or_else(|| {
        let name = dotted(name);
        list_place(name.rsplit('.').next()?).filter(|place| *place < 3)?;
        ELEMENTS.iter().find(|key| key.is_named(&name))
    })
}

/// Whether a dotted name is that of a section, or the beginning of one's; `*` stands for any one name.
pub(super) fn is_section(name: &str) -> bool {
    KEYS.iter().any(|key| {
        let mut parts = key.name.split('.');
        let fits = |given: &str| parts.next().is_some_and(|part| part == "*" || part == given);
        name.split('.').all(fits) && parts.next().is_some()
    })
}
