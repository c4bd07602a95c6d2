//! What a result says: sections with numbers, sentences, tables and the names of figures.

use super::table::Table;
use serde::{Deserialize, Serialize};

/// A part of a document.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Heading.
    pub heading: String,
    /// Numbers that decide, name and value with unit.
    pub facts: Vec<(String, String)>,
    /// Sentences.
    pub text: Vec<String>,
    /// Sentences and blocks to paste that are on the page only.
    pub aside: Vec<String>,
    /// Tables.
    pub tables: Vec<Table>,
    /// What the names of its figures begin with.
    pub figures: Vec<String>,
}

impl Section {
    /// An empty part.
    pub fn new(heading: impl Into<String>) -> Self {
        Self { heading: heading.into(), ..Self::default() }
    }

    /// The same with further numbers.
    #[must_use]
    pub fn facts<N: Into<String>>(mut self, facts: impl IntoIterator<Item = (N, String)>) -> Self {
        self.facts.extend(facts.into_iter().map(|(name, value)| (name.into(), value)));
        self
    }

    /// The same with further sentences.
    #[must_use]
    pub fn text(mut self, text: impl IntoIterator<Item = String>) -> Self {
        self.text.extend(text);
        self
    }

    /// The same with what is on the page only.
    #[must_use]
    pub fn aside(mut self, text: impl IntoIterator<Item = String>) -> Self {
        self.aside.extend(text);
        self
    }

    /// The same with further tables.
    #[must_use]
    pub fn tables(mut self, tables: impl IntoIterator<Item = Table>) -> Self {
        self.tables.extend(tables);
        self
    }

    /// The same with the figures whose names begin so.
    #[must_use]
    pub fn figures(mut self, names: impl IntoIterator<Item = &'static str>) -> Self {
        self.figures.extend(names.into_iter().map(str::to_owned));
        self
    }
}

/// What a result says, for the terminal and for the page.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// Title.
    pub title: String,
    /// Its parts; the first one decides.
    pub sections: Vec<Section>,
    /// What a reader must know, at the end.
    pub notes: Vec<String>,
    /// Tables that are files only; a page does not keep them.
    #[serde(skip)]
    pub only_files: Vec<Table>,
}

impl Document {
    /// An empty document under what it is of.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// The same under the title of a case, where that has one.
    #[must_use]
    pub fn titled(self, title: &str) -> Self {
        if title.is_empty() { self } else { Self { title: title.to_owned(), ..self } }
    }

    /// The same with a further part.
    #[must_use]
    pub fn section(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// The same with further notes.
    #[must_use]
    pub fn notes(mut self, notes: &[String]) -> Self {
        self.notes.extend_from_slice(notes);
        self
    }

    /// The same with a table that is a file only.
    #[must_use]
    pub fn file(mut self, table: Table) -> Self {
        self.only_files.push(table);
        self
    }

    /// The tables that are files.
    pub fn files(&self) -> impl Iterator<Item = &Table> {
        let tables = self.sections.iter().flat_map(|section| &section.tables);
        tables.chain(&self.only_files).filter(|table| !table.file.is_empty())
    }

    /// Whether its tables are whole.
    pub fn is_whole(&self) -> bool {
        self.sections.iter().flat_map(|section| &section.tables).all(Table::is_whole)
    }

    /// As text: the part that decides comes last, and its tables stand beside the prompt.
    pub fn to_text(&self) -> String {
        let mut out = format!("{}\n", self.title);
        for (at, section) in self.sections.iter().enumerate().rev() {
            if at == 0 && !self.notes.is_empty() {
                out.push('\n');
                out.extend(self.notes.iter().map(|note| format!("{note}\n")));
            }
            if !(section.facts.is_empty() && section.text.is_empty()) {
                out.push('\n');
            }
            out.extend(section.text.iter().map(|text| format!("{text}\n")));
            let width = section.facts.iter().map(|(name, _)| name.chars().count()).max();
            let width = width.unwrap_or(0);
            let facts = section.facts.iter();
            out.extend(facts.map(|(name, value)| format!("  {name:<width$}  {value}\n")));
            let tables = section.tables.iter().map(|table| (&table.caption, table.text()));
            let tables = tables.filter(|(_, text)| !text.is_empty());
            out.extend(tables.map(|(caption, text)| format!("\n{caption}\n{text}")));
        }
        out
    }
}
