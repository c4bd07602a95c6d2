//! `report.html`: figures, tables, case and manifest of one result in one file.

use super::Manifest;
use crate::chart::{ID_PREFIX, escape};
use serde_json::Value;
use std::fmt::Write;

/// A finished drawing with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFigure {
    /// File name without extension, ASCII.
    pub name: String,
    /// Caption: what is shown, in a sentence or two.
    pub caption: String,
    /// The SVG document.
    pub svg: String,
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

/// A report on one result.
///
/// It needs no network and no other file: drawings are inline, nothing is scripted.
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
    number(summary, pointer).map_or_else(String::new, |value| {
        format!("{:.decimals$}", factor * value)
    })
}

/// The entries of an array of a summary; none if there is no such array.
pub fn entries<'a>(summary: &'a Value, key: &str) -> &'a [Value] {
    summary[key].as_array().map_or(&[][..], Vec::as_slice)
}

/// The texts of an array of a summary.
pub fn texts(summary: &Value, key: &str) -> Vec<String> {
    let texts = entries(summary, key).iter().filter_map(Value::as_str);
    texts.map(str::to_owned).collect()
}

const STYLE: &str = "\
:root{color-scheme:light}\
body{font:16px/1.5 'DejaVu Sans',Verdana,sans-serif;color:#222;background:#fff;max-width:60rem;\
margin:0 auto;padding:1.5rem}\
h1{font-size:1.6rem;line-height:1.25}h2{font-size:1.2rem;margin-top:2.5rem;border-bottom:1px solid #bbb}\
nav ul{columns:2;padding-left:1.2rem}a{color:#005a8c}\
figure{margin:1.5rem 0;break-inside:avoid}figure svg{width:100%;height:auto;max-height:95vh}\
figcaption{font-size:.9rem;color:#444;margin-top:.4rem}\
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.85rem;margin:1rem 0}\
caption{text-align:left;font-weight:bold;padding:.3rem 0}\
th,td{padding:.2rem .7rem;border-bottom:1px solid #ddd;text-align:left;vertical-align:top}\
td.number,th.number{text-align:right;font-variant-numeric:tabular-nums}\
thead th{border-bottom:2px solid #888}\
pre{background:#f5f5f5;border:1px solid #ddd;padding:.8rem;overflow-x:auto;font-size:.8rem;line-height:1.4}\
@media print{body{max-width:none;padding:0;font-size:10pt}nav{display:none}\
pre{white-space:pre-wrap;overflow-wrap:anywhere}.scroll{overflow:visible}a{color:inherit}}";

impl Report {
    /// The report as one HTML document.
    pub fn to_html(&self) -> String {
        let title = if self.title.is_empty() {
            self.manifest.case_file.clone()
        } else {
            self.title.clone()
        };
        let mut out = String::new();
        let _ = write!(
            out,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
             <title>{0}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n\
             <p>{1}</p>\n</header>\n",
            escape(&title),
            escape(&format!(
                "{} {} {}, {} {}",
                self.manifest.program,
                self.manifest.version,
                self.manifest.command,
                if self.has_case() { "case" } else { "table" },
                self.manifest.case_file
            ))
        );
        self.write_contents(&mut out);
        out.push_str("<main>\n");
        let mut figures = 0;
        for (index, section) in self.sections.iter().enumerate() {
            write_section(&mut out, index, section, &mut figures);
        }
        self.write_origin(&mut out);
        out.push_str("</main>\n</body>\n</html>\n");
        out
    }

    /// Whether it is made from a case, or else from a table of measurements.
    fn has_case(&self) -> bool {
        !self.manifest.case_text.is_empty()
    }

    fn write_contents(&self, out: &mut String) {
        out.push_str("<nav aria-label=\"Contents\">\n<ul>\n");
        for (index, section) in self.sections.iter().enumerate() {
            let heading = escape(&section.heading);
            let _ = writeln!(
                out,
                "<li><a href=\"#section-{}\">{heading}</a></li>",
                index + 1
            );
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
                "<section id=\"case\">\n<h2>Case</h2>\n<pre><code>{}</code></pre>\n</section>\n",
                escape(&manifest.case_text)
            );
        }
        let (file, hash, overrides_name) = match self.has_case() {
            true => ("case file", "SHA-256 of the effective case", "overrides"),
            false => ("table", "SHA-256 of table and options", "options"),
        };
        let overrides = match manifest.overrides.is_empty() {
            true => "none".to_string(),
            false => manifest.overrides.join(", "),
        };
        let rows = [
            ("program", manifest.program.clone()),
            ("version", manifest.version.clone()),
            ("command", manifest.command.clone()),
            (file, manifest.case_file.clone()),
            (hash, manifest.case_hash.clone()),
            (overrides_name, overrides),
            ("threads", manifest.threads.to_string()),
            ("SIMD level", manifest.simd.clone()),
        ];
        out.push_str(
            "<section id=\"manifest\">\n<h2>Manifest</h2>\n<div class=\"scroll\"><table>\n",
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
        true => writeln!(out, "<pre><code>{text}</code></pre>"),
        false => writeln!(out, "<p>{text}</p>"),
    };
}

fn write_section(out: &mut String, index: usize, section: &ReportSection, figures: &mut usize) {
    let _ = write!(
        out,
        "<section id=\"section-{}\">\n<h2>{}</h2>\n",
        index + 1,
        escape(&section.heading)
    );
    for paragraph in &section.paragraphs {
        write_paragraph(out, paragraph);
    }
    for table in &section.tables {
        write_table(out, table);
    }
    for figure in &section.figures {
        *figures += 1;
        write_figure(out, *figures, figure);
    }
    out.push_str("</section>\n");
}

fn write_figure(out: &mut String, number: usize, figure: &NamedFigure) {
    // Two drawings of one kind carry the same ids; on one page each needs its own.
    let own = format!("{ID_PREFIX}{number}-");
    let _ = write!(
        out,
        "<figure id=\"{}\">\n{}<figcaption><b>Figure {number}.</b> {}</figcaption>\n</figure>\n",
        escape(&figure.name),
        figure.svg.replace(ID_PREFIX, &own),
        escape(&figure.caption)
    );
}

fn write_table(out: &mut String, table: &ReportTable) {
    // A column of numbers is set right-aligned, its name too.
    let is_number = |column: usize| {
        !table.rows.is_empty()
            && table.rows.iter().all(|row| {
                row.get(column)
                    .is_none_or(|cell| cell.is_empty() || cell.parse::<f64>().is_ok())
            })
    };
    let class = |column: usize| {
        if is_number(column) {
            " class=\"number\""
        } else {
            ""
        }
    };
    let _ = write!(
        out,
        "<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escape(&table.caption)
    );
    for (column, name) in table.columns.iter().enumerate() {
        let _ = write!(
            out,
            "<th scope=\"col\"{}>{}</th>",
            class(column),
            escape(name)
        );
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        debug_assert_eq!(row.len(), table.columns.len(), "{}", table.caption);
        out.push_str("<tr>");
        for (column, cell) in row.iter().enumerate() {
            let _ = write!(out, "<td{}>{}</td>", class(column), escape(cell));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Report {
        let figure = NamedFigure {
            name: "plot".into(),
            caption: "A plot of a < b.".into(),
            svg: format!("<svg><clipPath id=\"{ID_PREFIX}plot-1\"/></svg>\n"),
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
        for outside in ["<script", "src=\"http", "href=\"http", "@import"] {
            assert!(!html.contains(outside), "{outside}");
        }
    }

    #[test]
    fn report_on_a_table_has_no_case() {
        let mut report = report();
        report.manifest.case_text.clear();
        report.manifest.case_file = "frf.csv".into();
        report.sections[0].paragraphs = vec!["[damping]\nmass_coefficient = 40.0\n".into()];
        let html = report.to_html();
        assert!(html.contains("table frf.csv") && !html.contains("id=\"case\""));
        assert!(html.contains("<pre><code>[damping]\nmass_coefficient = 40.0\n</code></pre>"));
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
