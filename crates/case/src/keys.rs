//! Every key a case can have: the one declaration, in `keys.txt`, that readers, messages,
//! `frictionsim keys`, the JSON schema and the commented template are made from.

use super::CaseKey;
use std::borrow::Cow;
use std::sync::LazyLock;

impl CaseKey {
    /// This key in a section. Bodies whose sections have names of their own have no rotating waves.
    fn within(self, section: &str) -> Self {
        let name = match section {
            "" => self.name,
            _ => format!("{section}.{}", self.name).leak(),
        };
        Self { name, of_waves: if section.contains('*') { "" } else { self.of_waves }, ..self }
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
