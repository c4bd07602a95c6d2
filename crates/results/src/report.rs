//! What a command found: its document and figures become `report.html` and `figures.bin`, a page and the same as data.

mod page;
mod script;

use super::drawing::{Declaration, File, REPORT, files_of};
use super::record::{Record, read_record, write_record};
use super::{DrawingError, DrawingOptions, manifest::Manifest};
use crate::prelude::*;
use crate::{FolderError, OutputFolder};
use frictionsim_chart::ChartError;

/// A page as data, `figures.bin`: what was drawn, to be drawn again at any size.
#[derive(Serialize, Deserialize)]
pub struct Page {
    /// Tables and sentences.
    document: Document,
    /// Its figures.
    pub figures: Vec<Figure>,
    /// What the result was made from.
    manifest: Manifest,
}

impl Record for Page {
    const FILE: &str = "figures.bin";
    const MAGIC: [u8; 8] = *b"FRICSIMF";
    const VERSION: u32 = 3;

    fn inconsistency(&self) -> Option<&'static str> {
        let is_whole = self.document.is_whole() && self.figures.iter().all(Figure::is_whole);
        (!is_whole).then_some("its numbers do not fit together")
    }
}

impl Page {
    /// The page of a document and its figures, of which it keeps what a drawing shows.
    pub fn new(document: Document, figures: Vec<Figure>, manifest: &Manifest) -> Self {
        let figures = figures.into_iter().map(Figure::thinned).collect();
        Self { document, figures, manifest: manifest.clone() }
    }

    /// Draws every figure in every format asked for, `figures/NAME.svg` and so on, and `report.html`.
    pub fn draw(
        &self,
        folder: &OutputFolder,
        options: &DrawingOptions,
    ) -> Result<(), DrawingError> {
        let write = |name: &str, bytes: &[u8]| folder.write_bulk(name, |out| out.write_all(bytes));
        let drawn = |figure: &Figure| {
            let svg = figure.to_svg(options.width_mm)?;
            Ok((files_of(&figure.name, &svg, options)?, svg))
        };
        let drawn: Result<Vec<_>, ChartError> =
            frictionsim_physics::parallel::map(&self.figures, drawn);
        let (files, drawings): (Vec<Vec<File>>, Vec<String>) = drawn?.into_iter().unzip();
        files.iter().flatten().try_for_each(|(name, bytes)| write(name, bytes))?;
        Ok(write(REPORT, self.to_html(&drawings).as_bytes())?)
    }
}

/// A summary that says everything: it is `summary.json`, and the tables, the page and the figures are made from it.
pub trait Finding: Serialize {
    /// Its tables and sentences.
    fn document(&self) -> Document;

    /// Its figures.
    fn figures(&self) -> Vec<Declaration<'_>>;
}

/// Writes the tables of a document that are files.
pub fn write_tables(folder: &OutputFolder, document: &Document) -> Result<(), FolderError> {
    document.files().try_for_each(|table| write_table(folder, table))
}

/// Writes a table as its file.
pub fn write_table(folder: &OutputFolder, table: &Table) -> Result<(), FolderError> {
    folder.write(&table.file, |out| table.write_csv(out))
}

/// Writes the page of a document, its figures, and both as data.
pub fn write_page(
    folder: &OutputFolder,
    document: Document,
    figures: Vec<Figure>,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    write_record(folder, &Page::new(document, figures, folder.manifest()))?;
    // What is drawn is what was kept: drawn again, it is the same.
    read_record::<Page>(folder.path())?.draw(folder, options)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frictionsim_chart::ID_PREFIX;
    use frictionsim_output::{Format, Section, Table};
    use serde_json::Value;

    /// A page with a figure that is there twice.
    fn page() -> Page {
        let figure = || Figure::new("plot", "A plot of a < b.");
        let table = Table::new("", "Eigenvalues")
            .column("", Some(("mode", Format::Count)), [1_usize])
            .column("", Some(("frequency (Hz)", Format::Fixed(0))), [5857.0])
            .column("", Some(("direction", Format::Plain)), ["standing"]);
        let section = Section::new("Modes")
            .text(["All modes below 17.5 kHz.".to_owned()])
            .tables([table])
            .figures(["plot"]);
        let manifest = Manifest {
            case_text: "[mesh]\nelement = \"quad4\" # <&>\n".into(),
            ..Manifest::new("cea")
        };
        let document = Document::new("Disc & <cylinder>").section(section);
        Page::new(document, vec![figure(), figure()], &manifest)
    }

    /// The page with the same drawing of both figures.
    fn html_of(page: &Page) -> String {
        let svg = format!("<svg><clipPath id=\"{ID_PREFIX}plot-1\"/></svg>\n");
        page.to_html(&[svg.clone(), svg])
    }

    #[test]
    fn report_is_self_contained_and_escapes_what_users_typed() {
        let html = html_of(&page());
        assert!(html.contains("<h1>Disc &amp; &lt;cylinder&gt;</h1>"));
        assert!(html.contains("# &lt;&amp;&gt;"));
        for outside in ["<script src", "src=\"http", "href=\"http", "@import"] {
            assert!(!html.contains(outside), "{outside}");
        }
    }

    #[test]
    fn no_text_of_a_user_ends_a_script() {
        let mut page = page();
        page.figures[0].name = "</script><img>".into();
        page.document.sections[0].figures.push("</script>".into());
        let html = html_of(&page);
        let data = html.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
        let data: Value = serde_json::from_str(data).unwrap();
        assert_eq!(data["figures"][0]["name"], "</script><img>");
        assert!(!html.contains("<img"));
    }

    #[test]
    fn numbers_of_the_box_come_before_words_and_pictures() {
        let mut page = page();
        let section = Section::new("Results").text(["In words.".to_owned()]);
        let section = section.facts([("main frequency", "9433 Hz".to_owned())]);
        page.document.sections.insert(0, section);
        let html = html_of(&page);
        let at = |text: &str| html.find(text).unwrap();
        assert!(at("<dd>9433 Hz</dd>") < at("In words.") && at("In words.") < at("<svg"));
    }

    #[test]
    fn report_on_a_table_has_no_case() {
        let mut page = page();
        page.manifest.case_text.clear();
        page.manifest.case_file = "frf.csv".into();
        page.document.sections[0].text = vec!["[damping]\nmass_coefficient = 40.0\n".into()];
        let html = html_of(&page);
        assert!(html.contains("table frf.csv") && !html.contains("id=\"case\""));
        assert!(html.contains(
            "<pre tabindex=\"0\"><code>[damping]\nmass_coefficient = 40.0\n</code></pre>"
        ));
    }

    #[test]
    fn repeated_drawings_keep_their_ids_apart() {
        let html = html_of(&page());
        for number in [1, 2] {
            let id = format!("id=\"{ID_PREFIX}{number}-plot-1\"");
            assert_eq!(html.matches(&id).count(), 1);
        }
    }

    #[test]
    fn columns_of_numbers_are_right_aligned() {
        let html = html_of(&page());
        assert!(html.contains("<td class=\"number\">5857</td>"));
        assert!(html.contains("<td>standing</td>"));
    }
}
