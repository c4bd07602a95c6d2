//! Keys of JSON with their meaning: `#[derive(Described)]` takes both from the fields of a struct.

use super::table::Entry;
use std::collections::BTreeMap;

/// What knows the keys that it has in JSON; a plain value has none.
pub trait Described {
    /// Adds its keys, which begin with a path: `[]` for each entry of a list, `KEY` for each key that the case decides.
    fn describe(path: &str, keys: &mut Vec<Entry>) {
        let _ = (path, keys);
    }
}

/// The keys of a summary.
pub fn keys_of<T: Described>() -> Vec<Entry> {
    let mut keys = Vec::new();
    T::describe("", &mut keys);
    keys
}

/// Adds a field and, by the `describe` of its type, what is in it; the keys of a flat one stand beside it.
pub fn describe_field(
    describe: fn(&str, &mut Vec<Entry>),
    path: &str,
    (name, meaning, is_flat): (&str, &str, bool),
    keys: &mut Vec<Entry>,
) {
    if is_flat {
        return describe(path, keys);
    }
    let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    // What several variants have is told once.
    if keys.iter().all(|own| own.key != path) {
        keys.push(Entry::new(path.clone(), meaning.trim()));
    }
    describe(&path, keys);
}

macro_rules! plain {
    ($($kind:ty),+) => {$(impl Described for $kind {})+};
}

plain!(bool, i8, i64, u8, u32, u64, usize, f64, &str, String, serde_json::Value);

impl Described for serde_json::Map<String, serde_json::Value> {
    fn describe(path: &str, keys: &mut Vec<Entry>) {
        BTreeMap::<String, serde_json::Value>::describe(path, keys);
    }
}

macro_rules! holders {
    ($($holder:ident $place:literal),+) => {$(impl<T: Described> Described for $holder<T> {
        fn describe(path: &str, keys: &mut Vec<Entry>) {
            T::describe(&format!("{path}{}", $place), keys);
        }
    })+};
}

holders!(Option "", Box "", Vec "[]");

impl<T: Described, const N: usize> Described for [T; N] {
    fn describe(path: &str, keys: &mut Vec<Entry>) {
        T::describe(&format!("{path}[]"), keys);
    }
}

impl<T: Described> Described for BTreeMap<String, T> {
    fn describe(path: &str, keys: &mut Vec<Entry>) {
        describe_field(T::describe, path, ("KEY", "value of the key", false), keys);
    }
}
