//! `frictionsim columns`: the columns of tables and the keys of `summary.json`.

use super::{Failure, terminal};
use crate::output::unit_of;
use crate::results::reference::{markdown, reference};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// List the columns of tables and the keys of summary.json with unit and meaning
#[derive(Args)]
pub struct Arguments {
    /// Only those whose name, meaning, file or command holds this word
    word: Option<String>,
    /// One object for each column and key
    #[arg(long, conflicts_with = "markdown")]
    json: bool,
    /// Tables in Markdown
    #[arg(long, conflicts_with = "word")]
    markdown: bool,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    if asked.markdown {
        return terminal::print(&markdown());
    }
    let word = asked.word.as_deref().unwrap_or("");
    let lower = word.to_lowercase();
    let (mut text, mut objects) = (String::new(), Vec::new());
    for file in reference() {
        let holds = |text: &str| text.to_lowercase().contains(&lower);
        let is_whole = holds(file.command) || holds(file.file);
        let found = file.entries.iter().filter(|e| is_whole || holds(&e.key) || holds(&e.meaning));
        for (at, entry) in found.enumerate() {
            let unit = unit_of(&entry.key).1;
            objects.push(json!({
                "command": file.command, "file": file.file, "name": entry.key,
                "unit": unit, "meaning": entry.meaning,
            }));
            if at == 0 {
                let _ = writeln!(text, "{} of {}", file.file, file.command);
            }
            let space = if unit.is_empty() { "" } else { ", " };
            let _ = writeln!(text, "  {}{space}{unit}\n      {}", entry.key, entry.meaning);
        }
    }
    if objects.is_empty() {
        return Err(Failure::usage(format!(
            "no column or key has \"{word}\" in its name or meaning"
        )));
    }
    match asked.json {
        true => {
            terminal::print_json(&json!({ "command": "columns", "columns": Value::from(objects) }))
        }
        false => terminal::print(&text),
    }
}
