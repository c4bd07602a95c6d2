//! The report as an HTML document.

use super::{Page, script};
use crate::{Manifest, prelude::*};
use frictionsim_chart::ID_PREFIX;

const STYLE: &str = include_str!("style.css");

/// What the page may load: nothing from outside.
const POLICY: &str = "default-src 'none'; img-src data:; media-src data:; style-src 'unsafe-inline'; \
                      script-src 'unsafe-inline'";

/// A part of the page, and its figures with their drawings.
type Part<'a> = (Section, Vec<(&'a Figure, &'a String)>);

impl Page {
    /// The page as one HTML document, with the drawings of its figures.
    ///
    /// It needs no network and no other file: drawings are inline, and so are the scripts that let a reader zoom, sort,
    /// animate and listen. Every number and every drawing is there without them.
    pub fn to_html(&self, drawings: &[String]) -> String {
        let Manifest { program, version, command, case_file, .. } = &self.manifest;
        let title = &self.document.title;
        let title = if title.is_empty() { case_file } else { title };
        let parts = self.parts(drawings);
        let mut out = String::new();
        let _ = write!(
            out,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <title>{0}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n\
             <p>{1}</p>\n</header>\n",
            escape(title),
            escape(&format!("{program} {version} {command}, {} {case_file}", self.source()[0]))
        );
        self.write_contents(&mut out, &parts);
        out.push_str("<main>\n");
        let mut figures = 0;
        for (index, part) in parts.iter().enumerate() {
            write_section(&mut out, index, part, &mut figures);
        }
        self.write_origin(&mut out);
        out.push_str("</main>\n");
        script::write(&mut out, parts.iter().flat_map(|part| &part.1).map(|own| own.0));
        out.push_str("</body>\n</html>\n");
        out
    }

    /// The parts that say something: each figure stands in the first one that names the beginning of its name, notes
    /// in the first.
    fn parts<'a>(&'a self, drawings: &'a [String]) -> Vec<Part<'a>> {
        let mut figures: Vec<_> = self.figures.iter().zip(drawings).collect();
        let mut notes = self.document.notes.clone();
        let part = |section: &Section| {
            let mut section = section.clone();
            let is_own = |(figure, _): &(&Figure, &String)| {
                section.figures.iter().any(|name| figure.name.starts_with(name))
            };
            let (own, others) = std::mem::take(&mut figures).into_iter().partition(is_own);
            figures = others;
            section.text.append(&mut notes);
            section.text.append(&mut section.aside);
            (section, own)
        };
        let says = |(section, own): &Part<'_>| {
            let has_rows = section.tables.iter().any(|table| !table.shown().1.is_empty());
            let has_words = !section.text.is_empty() || !section.facts.is_empty();
            has_words || has_rows || !own.is_empty()
        };
        self.document.sections.iter().map(part).filter(says).collect()
    }

    /// Whether it is made from a case, or else from a table of measurements.
    fn has_case(&self) -> bool {
        !self.manifest.case_text.is_empty()
    }

    /// What it is made from: in a word, and the names of file, hash and options in the manifest.
    fn source(&self) -> [&'static str; 4] {
        match (self.has_case(), self.manifest.command.as_str()) {
            (true, _) => ["case", "case file", "SHA-256 of the effective case", "overrides"],
            (false, "compare") => ["run", "compared with", "SHA-256 of names and cases", "runs"],
            (false, _) => ["table", "table", "SHA-256 of table and options", "options"],
        }
    }

    fn write_contents(&self, out: &mut String, parts: &[Part<'_>]) {
        out.push_str("<nav aria-label=\"Contents\">\n<ul>\n");
        for (index, (section, _)) in parts.iter().enumerate() {
            let heading = escape(&section.heading);
            let _ = writeln!(out, "<li><a href=\"#section-{}\">{heading}</a></li>", index + 1);
        }
        if self.has_case() {
            out.push_str("<li><a href=\"#case\">Case</a></li>\n");
        }
        out.push_str("<li><a href=\"#manifest\">Manifest</a></li>\n</ul>\n</nav>\n");
    }

    fn write_origin(&self, out: &mut String) {
        let manifest = &self.manifest;
        if self.has_case() {
            let _ = write!(
                out,
                "<section id=\"case\">\n<h2>Case</h2>\n<pre tabindex=\"0\" role=\"region\" \
                aria-label=\"Case\"><code>{}</code></pre>\n</section>\n",
                escape(&manifest.case_text)
            );
        }
        let [_, file, hash, overrides_name] = self.source();
        let rows = [
            ("program", manifest.program.clone()),
            ("version", manifest.version.clone()),
            ("command", manifest.command.clone()),
            (file, manifest.case_file.clone()),
            (hash, manifest.case_hash.clone()),
            (overrides_name, manifest.overrides_text()),
            ("threads", manifest.threads.to_string()),
            ("SIMD level", manifest.simd.clone()),
        ];
        out.push_str(
            "<section id=\"manifest\">\n<h2>Manifest</h2>\n\
             <div class=\"scroll\" role=\"region\" aria-label=\"Manifest\" tabindex=\"0\"><table>\n",
        );
        for (name, value) in rows {
            let _ = writeln!(
                out,
                "<tr><th scope=\"row\">{}</th><td>{}</td></tr>",
                escape(name),
                escape(&value)
            );
        }
        out.push_str("</table></div>\n</section>\n");
    }
}

/// A paragraph; text of several lines, a block to paste, as it stands.
fn write_paragraph(out: &mut String, text: &str) {
    let text = escape(text);
    let _ = match text.contains('\n') {
        true => writeln!(out, "<pre tabindex=\"0\"><code>{text}</code></pre>"),
        false => writeln!(out, "<p>{text}</p>"),
    };
}

fn write_section(out: &mut String, index: usize, (section, drawn): &Part<'_>, figures: &mut usize) {
    // The numbers that decide are set as a box.
    let is_box = !section.facts.is_empty();
    let _ = write!(
        out,
        "<section id=\"section-{}\"{}>\n<h2>{}</h2>\n",
        index + 1,
        if is_box { " class=\"results\"" } else { "" },
        escape(&section.heading)
    );
    if is_box {
        out.push_str("<dl>\n");
        for (name, value) in &section.facts {
            let _ = writeln!(out, "<div><dt>{}</dt><dd>{}</dd></div>", escape(name), escape(value));
        }
        out.push_str("</dl>\n");
    }
    for paragraph in &section.text {
        write_paragraph(out, paragraph);
    }
    // A report begins with numbers; behind them pictures come first.
    let is_first = index == 0;
    if is_first {
        section.tables.iter().for_each(|table| write_table(out, table));
    }
    for (figure, drawing) in drawn {
        *figures += 1;
        write_figure(out, *figures, figure, drawing);
    }
    if !is_first {
        section.tables.iter().for_each(|table| write_table(out, table));
    }
    out.push_str("</section>\n");
}

fn write_figure(out: &mut String, number: usize, figure: &Figure, drawing: &str) {
    // Two drawings of one kind carry the same ids; on one page each needs its own.
    let drawing = drawing.replace(ID_PREFIX, &format!("{ID_PREFIX}{number}-"));
    let [name, caption] = [&figure.name, &figure.caption].map(|text| escape(text));
    let _ = write!(
        out,
        "<figure id=\"{name}\">\n<div class=\"scroll picture\" role=\"region\" aria-label=\"Figure \
        {number}\" tabindex=\"0\">\n{drawing}</div>\n\
         <figcaption><b>Figure {number}.</b> {caption}</figcaption>\n</figure>\n"
    );
}

/// The columns of a table that people see; nothing of one without a row.
fn write_table(out: &mut String, table: &Table) {
    let (labels, rows) = table.shown();
    if rows.is_empty() {
        return;
    }
    // A column of numbers is set right-aligned, its name too.
    let is_number = |column: usize| {
        rows.iter().all(|row| row[column].is_empty() || row[column].parse::<f64>().is_ok())
    };
    let class = |column: usize| {
        if is_number(column) { " class=\"number\"" } else { "" }
    };
    let _ = write!(
        out,
        "<div class=\"scroll\" role=\"region\" aria-label=\"{0}\" \
        tabindex=\"0\"><table>\n<caption>{0}</caption>\n<thead><tr>",
        escape(&table.caption)
    );
    for (column, name) in labels.iter().enumerate() {
        let _ = write!(out, "<th scope=\"col\"{}>{}</th>", class(column), escape(name));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for row in &rows {
        out.push_str("<tr>");
        for (column, cell) in row.iter().enumerate() {
            let _ = write!(out, "<td{}>{}</td>", class(column), escape(cell));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
}
