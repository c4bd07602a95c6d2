//! `frictionsim columns`: the columns of tables and the keys of `summary.json`.

use super::prelude::*;
use crate::results::reference::{markdown, objects};
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
    let found = objects(word);
    if found.is_empty() {
        return Err(Failure::usage(format!(
            "no column or key has \"{word}\" in its name or meaning"
        )));
    }
    if asked.json {
        return terminal::print_json(&json!({ "command": "columns", "columns": found }));
    }
    let (mut text, mut last) = (String::new(), None);
    for own in &found {
        let [command, file, name, unit, meaning] = ["command", "file", "name", "unit", "meaning"]
            .map(|key| own[key].as_str().unwrap_or_default());
        if last.replace((command, file)) != Some((command, file)) {
            let _ = writeln!(text, "{file} of {command}");
        }
        let space = if unit.is_empty() { "" } else { ", " };
        let _ = writeln!(text, "  {name}{space}{unit}\n      {meaning}");
    }
    terminal::print(&text)
}
