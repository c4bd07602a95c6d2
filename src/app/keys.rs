//! `frictionsim keys`: every key of a case file.

use super::prelude::*;
use crate::case::{CaseKey, KEYS, reference};
use std::fmt::Write as _;

/// List the keys of a case with unit, default and meaning
#[derive(Args)]
pub struct Arguments {
    /// Only keys whose name or meaning holds this word
    word: Option<String>,
    /// One object for each key
    #[arg(long, conflicts_with_all = ["markdown", "schema"])]
    json: bool,
    /// Tables in Markdown
    #[arg(long, conflicts_with_all = ["word", "schema"])]
    markdown: bool,
    /// The JSON schema of a case file, for editors
    #[arg(long, conflicts_with = "word")]
    schema: bool,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    if asked.schema {
        return terminal::print_json(&reference::schema());
    }
    if asked.markdown {
        return terminal::print(&reference::markdown());
    }
    let word = asked.word.as_deref().unwrap_or("");
    let lower = word.to_lowercase();
    let holds =
        |key: &&CaseKey| key.name.contains(&lower) || key.meaning.to_lowercase().contains(&lower);
    let keys: Vec<&CaseKey> = KEYS.iter().filter(holds).collect();
    if keys.is_empty() {
        return Err(Failure::usage(format!("no case key has \"{word}\" in its name or meaning")));
    }
    if asked.json {
        let objects: Vec<Value> = keys.iter().map(|key| reference::object(key)).collect();
        return terminal::print_json(&json!({ "command": "keys", "keys": objects }));
    }
    terminal::print(&describe(&keys))
}

/// Two lines for each key, section by section.
fn describe(keys: &[&CaseKey]) -> String {
    let mut out = String::new();
    let mut section = "";
    for key in keys {
        if key.section() != section {
            section = key.section();
            let _ = writeln!(out, "[{section}]");
        }
        let unit = if key.unit.is_empty() { String::new() } else { format!(" {}", key.unit) };
        let (name, values, meaning) = (key.short(), key.values(), key.meaning);
        let default = match key.default_text() {
            needed if needed.starts_with("required") => needed.to_owned(),
            default => format!("default {default}"),
        };
        let _ = writeln!(out, "{name}: {values}{unit}; {default}\n    {meaning}");
        if !key.of_waves.is_empty() {
            let _ = writeln!(
                out,
                "    not used by the rotating waves of a plane annulus (cycle, basin): {}",
                key.of_waves
            );
        }
    }
    out
}
