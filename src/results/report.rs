//! `report.html`: figures, tables, case and manifest of one result in one file.

mod numbers;
mod page;
mod reading;
mod script;

pub use reading::{ReadFigure, read_figures};

use super::Manifest;
use crate::chart::FigureData;
use serde_json::Value;

/// A finished drawing with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFigure {
    /// File name without extension, ASCII.
    pub name: String,
    /// Caption: what is shown, in a sentence or two.
    pub caption: String,
    /// The SVG document.
    pub svg: String,
    /// The numbers behind it.
    pub data: FigureData,
}

/// A small table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReportTable {
    /// Caption.
    pub caption: String,
    /// Column names with units.
    pub columns: Vec<String>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

impl ReportTable {
    /// A table of these columns and rows.
    pub fn new<C: ToString>(
        caption: impl Into<String>,
        columns: impl IntoIterator<Item = C>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        Self {
            caption: caption.into(),
            columns: columns.into_iter().map(|name| name.to_string()).collect(),
            rows: rows.into_iter().collect(),
        }
    }
}

/// A part of a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReportSection {
    /// Heading.
    pub heading: String,
    /// Paragraphs of plain text; one of several lines is set as a block.
    pub paragraphs: Vec<String>,
    /// Tables.
    pub tables: Vec<ReportTable>,
    /// Figures.
    pub figures: Vec<NamedFigure>,
}

/// Heading of the section that comes first and is set as a box: the numbers that decide.
const RESULTS: &str = "Results";

impl ReportSection {
    /// The numbers that decide, name and value, which a report opens with.
    pub fn results(paragraphs: Vec<String>, rows: Vec<(String, String)>) -> Self {
        let rows = rows.into_iter().map(|(name, value)| vec![name, value]);
        let table = ReportTable::new("", ["quantity", "value"], rows);
        Self::new(RESULTS).with_paragraphs(paragraphs).with_tables([table])
    }

    /// An empty part.
    pub fn new(heading: impl Into<String>) -> Self {
        Self { heading: heading.into(), ..Self::default() }
    }

    /// The same with further paragraphs.
    pub fn with_paragraphs(mut self, paragraphs: impl IntoIterator<Item = String>) -> Self {
        self.paragraphs.extend(paragraphs);
        self
    }

    /// The same with further tables.
    pub fn with_tables(mut self, tables: impl IntoIterator<Item = ReportTable>) -> Self {
        self.tables.extend(tables);
        self
    }

    /// The same with further figures.
    pub fn with_figures(mut self, figures: impl IntoIterator<Item = NamedFigure>) -> Self {
        self.figures.extend(figures);
        self
    }

    /// Whether some table has something in it.
    pub(super) fn has_rows(&self) -> bool {
        self.tables.iter().any(|table| !table.rows.is_empty())
    }

    /// Whether it is the box of results.
    fn is_box(&self) -> bool {
        self.heading == RESULTS
    }
}

/// A report on one result.
///
/// It needs no network and no other file: drawings are inline, and so are the scripts that let a reader zoom, sort, animate
/// and listen. Every number and every drawing is there without them.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Title, from the case.
    pub title: String,
    /// Parts in order.
    pub sections: Vec<ReportSection>,
    /// What the result was made from.
    pub manifest: Manifest,
}

/// The number at a JSON pointer of a summary, if there is one.
pub fn number(summary: &Value, pointer: &str) -> Option<f64> {
    summary.pointer(pointer).and_then(Value::as_f64)
}

/// The number at a JSON pointer times a factor, with so many decimals; empty if there is none.
pub fn cell(summary: &Value, pointer: &str, factor: f64, decimals: usize) -> String {
    number(summary, pointer)
        .map_or_else(String::new, |value| format!("{:.decimals$}", factor * value))
}

/// The entries of an array of a summary; none if there is no such array.
pub fn entries<'a>(summary: &'a Value, key: &str) -> &'a [Value] {
    summary[key].as_array().map_or(&[][..], Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::ID_PREFIX;

    fn report() -> Report {
        let figure = NamedFigure {
            name: "plot".into(),
            caption: "A plot of a < b.".into(),
            svg: format!("<svg><clipPath id=\"{ID_PREFIX}plot-1\"/></svg>\n"),
            data: FigureData::default(),
        };
        Report {
            title: "Disc & <cylinder>".into(),
            sections: vec![ReportSection {
                heading: "Modes".into(),
                paragraphs: vec!["All modes below 17.5 kHz.".into()],
                tables: vec![ReportTable {
                    caption: "Eigenvalues".into(),
                    columns: vec!["mode".into(), "frequency (Hz)".into(), "direction".into()],
                    rows: vec![vec!["1".into(), "5857".into(), "standing".into()]],
                }],
                figures: vec![figure.clone(), figure],
            }],
            manifest: Manifest {
                case_text: "[mesh]\nelement = \"quad4\" # <&>\n".into(),
                ..Manifest::new("cea")
            },
        }
    }

    #[test]
    fn report_is_self_contained_and_escapes_what_users_typed() {
        let html = report().to_html();
        assert!(html.contains("<h1>Disc &amp; &lt;cylinder&gt;</h1>"));
        assert!(html.contains("# &lt;&amp;&gt;"));
        for outside in ["<script src", "src=\"http", "href=\"http", "@import"] {
            assert!(!html.contains(outside), "{outside}");
        }
    }

    #[test]
    fn no_text_of_a_user_ends_a_script() {
        let mut report = report();
        report.sections[0].figures[0].name = "</script><img>".into();
        let html = report.to_html();
        let data = html.split("id=\"data\">").nth(1).unwrap();
        let data = data.split("</script>").next().unwrap();
        let data: Value = serde_json::from_str(data).unwrap();
        assert_eq!(data["figures"][0]["name"], "</script><img>");
        assert!(!html.contains("<img"));
    }

    #[test]
    fn numbers_of_the_box_come_before_words_and_pictures() {
        let mut report = report();
        let row = ("main frequency".into(), "9433 Hz".into());
        report.sections.insert(0, ReportSection::results(vec!["In words.".into()], vec![row]));
        let html = report.to_html();
        let at = |text: &str| html.find(text).unwrap();
        assert!(at("<dd>9433 Hz</dd>") < at("In words.") && at("In words.") < at("<svg"));
    }

    #[test]
    fn report_on_a_table_has_no_case() {
        let mut report = report();
        report.manifest.case_text.clear();
        report.manifest.case_file = "frf.csv".into();
        report.sections[0].paragraphs = vec!["[damping]\nmass_coefficient = 40.0\n".into()];
        let html = report.to_html();
        assert!(html.contains("table frf.csv") && !html.contains("id=\"case\""));
        assert!(html.contains(
            "<pre tabindex=\"0\"><code>[damping]\nmass_coefficient = 40.0\n</code></pre>"
        ));
    }

    #[test]
    fn repeated_drawings_keep_their_ids_apart() {
        let html = report().to_html();
        for number in [1, 2] {
            let id = format!("id=\"{ID_PREFIX}{number}-plot-1\"");
            assert_eq!(html.matches(&id).count(), 1);
        }
    }

    #[test]
    fn columns_of_numbers_are_right_aligned() {
        let html = report().to_html();
        assert!(html.contains("<td class=\"number\">5857</td>"));
        assert!(html.contains("<td>standing</td>"));
    }
}
