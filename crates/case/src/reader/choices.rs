//! Words that stand for choices, names of keys.

use super::Section;
use crate::words::Choice;
use crate::{CaseKey, RawItem, RawValue, keys, placed, refuse_if, suggestion, words};

impl Section<'_> {
    /// A list of words out of a few; empty where it is not given.
    pub fn choices<T: Choice>(&self, key: &str) -> Vec<T> {
        let items = self.item(key).map_or(&[][..], RawItem::listed);
        refuse_if!(self.list_length(key) == Some(0); self, key => "is an empty list";
            "at least one word");
        items.iter().filter_map(|item| self.read_choice(key, item)).collect()
    }

    /// Texts: one or a list; empty where it is not given.
    pub fn texts(&self, key: &str) -> Vec<String> {
        let items = self.item(key).map_or(&[][..], RawItem::listed).iter();
        let text = |item: &RawItem| match &item.value {
            RawValue::String(text) => Some(text.clone()),
            _ => {
                self.reject_at(item, key, "must be a string, or a list of strings");
                None
            }
        };
        items.filter_map(text).collect()
    }

    /// One of a few words; the default where the key is left out or wrong.
    pub fn choice<T: Choice>(&self, key: &str) -> T {
        self.item(key).and_then(|item| self.read_choice(key, item)).unwrap_or_else(|| {
            let default = self.declared(key).default_text().trim_matches('"');
            words::choice_of(default).unwrap_or(T::WORDS[0].1)
        })
    }

    /// The name of a numeric case key.
    pub fn parameter(&self, key: &str) -> String {
        let name = self.text(key);
        if self.is_some_text(key) && keys::find(&name).is_none_or(|known| !known.is_numeric()) {
            self.reject(
                key,
                format!("{} = \"{name}\" is not a numeric case key", self.name(key)),
                "must name a key whose value is a number",
                self.findings.scope.hint(&name, CaseKey::is_numeric),
            );
        }
        name
    }

    fn read_choice<T: Choice>(&self, key: &str, item: &RawItem) -> Option<T> {
        let words = words::words::<T>();
        let bound = format!("must be one of \"{}\"", words.join("\", \""));
        if let RawValue::String(text) = &item.value {
            if let Some(choice) = words::choice_of(text) {
                return Some(choice);
            }
            if let Some(near) = suggestion::nearest_word(text, &words) {
                let error = placed!(item.at.clone(), "{} = {} is not one of its values",
                    self.name(key), item.value.shortened(); "{bound}"; "did you mean \"{near}\"?");
                self.misread(key, true, error);
                return None;
            }
        }
        self.reject_at(item, key, &bound);
        None
    }
}
