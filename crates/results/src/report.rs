//! `report.html`: figures, tables, case and manifest of one result in one file.

mod numbers;
mod page;
mod script;

use super::Manifest;
use frictionsim_chart::FigureData;
use frictionsim_output::{Document, Section};

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

/// A report on one result.
///
/// It needs no network and no other file: drawings are inline, and so are the scripts that let a reader zoom, sort,
/// animate and listen. Every number and every drawing is there without them.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Title, from the case.
    pub title: String,
    /// Parts in order, each with its figures.
    pub sections: Vec<(Section, Vec<NamedFigure>)>,
    /// What the result was made from.
    pub manifest: Manifest,
}

impl Report {
    /// The page of a document: each figure stands in the first section that names the beginning of its name, notes in
    /// the first.
    pub fn of(document: Document, mut figures: Vec<NamedFigure>, manifest: &Manifest) -> Self {
        let mut notes = document.notes;
        let part = |mut section: Section| {
            let is_own = |figure: &NamedFigure| {
                section.figures.iter().any(|name| figure.name.starts_with(name))
            };
            let (own, others) = std::mem::take(&mut figures).into_iter().partition(is_own);
            figures = others;
            section.text.append(&mut notes);
            section.text.append(&mut section.aside);
            (section, own)
        };
        let sections = document.sections.into_iter().map(part);
        let says = |(section, own): &(Section, Vec<NamedFigure>)| {
            let has_rows = section.tables.iter().any(|table| !table.shown().1.is_empty());
            let has_words = !section.text.is_empty() || !section.facts.is_empty();
            has_words || has_rows || !own.is_empty()
        };
        let sections = sections.filter(says).collect();
        Self { title: document.title, sections, manifest: manifest.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frictionsim_chart::ID_PREFIX;
    use frictionsim_output::{Format, Table};
    use serde_json::Value;

    fn report() -> Report {
        let figure = NamedFigure {
            name: "plot".into(),
            caption: "A plot of a < b.".into(),
            svg: format!("<svg><clipPath id=\"{ID_PREFIX}plot-1\"/></svg>\n"),
            data: FigureData::default(),
        };
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
        Report::of(document, vec![figure.clone(), figure], &manifest)
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
        report.sections[0].1[0].name = "</script><img>".into();
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
        let section = Section::new("Results").text(["In words.".to_owned()]);
        let section = section.facts([("main frequency", "9433 Hz".to_owned())]);
        report.sections.insert(0, (section, Vec::new()));
        let html = report.to_html();
        let at = |text: &str| html.find(text).unwrap();
        assert!(at("<dd>9433 Hz</dd>") < at("In words.") && at("In words.") < at("<svg"));
    }

    #[test]
    fn report_on_a_table_has_no_case() {
        let mut report = report();
        report.manifest.case_text.clear();
        report.manifest.case_file = "frf.csv".into();
        report.sections[0].0.text = vec!["[damping]\nmass_coefficient = 40.0\n".into()];
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
