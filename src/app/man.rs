//! `frictionsim man`: manual pages.

use super::command_line;
use super::prelude::*;
use crate::case::{KEYS, reference};
use clap_mangen::Man;
use std::fmt::Write as _;
use std::{fs, io};

/// Print the manual page, or write those of all subcommands
#[derive(Args)]
pub struct Arguments {
    /// Print the page of this command, or that of the case file (case)
    #[arg(value_name = "COMMAND", conflicts_with = "out")]
    command: Option<String>,
    /// Write frictionsim.1, one page for each subcommand, and frictionsim-case.5 there
    #[arg(long, short, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
}

/// Files that every command with an output folder writes.
const EVERYWHERE: [(&str, &str); 4] = [
    ("summary.json", "the results in short, and what they were made from"),
    ("manifest.json", "case, overrides, version; names and checksums of all files"),
    ("report.html, figures/", "tables and figures"),
    ("figures.bin", "what the figures show, for plot and compare"),
];

/// Files and examples of each command.
const MANUAL: &str = include_str!("manual.txt");

/// What `manual.txt` tells of a command: the files that it writes, and its examples, each with what it is for.
fn told(command: &str) -> [Vec<(&'static str, &'static str)>; 2] {
    let heading = format!("[{command}]");
    let own = MANUAL.lines().skip_while(|line| *line != heading).skip(1);
    let (mut files, mut examples) = (Vec::new(), Vec::new());
    for (name, meaning) in own.map_while(|line| line.rsplit_once(" | ")) {
        match name.strip_prefix("$ ") {
            Some(line) => examples.push((line, meaning)),
            None => files.push((name, meaning)),
        }
    }
    [files, examples]
}

const EXIT_STATUS: [(&str, &str); 4] = [
    ("0", "done"),
    ("1", "the run failed"),
    ("2", "bad usage or case"),
    ("130", "interrupted by Ctrl-C or SIGTERM"),
];

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let mut command = command_line();
    // Builds the names of the subcommands: `frictionsim-cea`.
    command.build();
    if let Some(folder) = &asked.out {
        let failed = |error| Failure::run(format!("cannot write {}: {error}", folder.display()));
        return write_pages(&command, folder).map_err(failed);
    }
    let shown = match &asked.command {
        None => &command,
        Some(name) if name == "case" => return terminal::print(&case_page()),
        Some(name) => command.find_subcommand(name).ok_or_else(|| {
            Failure::usage(format!("there is no command {name}: see frictionsim --help"))
        })?,
    };
    terminal::print(&String::from_utf8_lossy(&page(shown)?))
}

fn write_pages(command: &clap::Command, folder: &std::path::Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let subcommands = command.get_subcommands().filter(|sub| sub.get_name() != "help");
    for command in std::iter::once(command).chain(subcommands) {
        let name = Man::new(command.clone()).get_filename();
        fs::write(folder.join(name), page(command)?)?;
    }
    fs::write(folder.join("frictionsim-case.5"), case_page())
}

/// One page in roff.
fn page(command: &clap::Command) -> io::Result<Vec<u8>> {
    let man = Man::new(command.clone());
    let mut out = Vec::new();
    man.render_title(&mut out)?;
    man.render_name_section(&mut out)?;
    man.render_synopsis_section(&mut out)?;
    man.render_description_section(&mut out)?;
    man.render_options_section(&mut out)?;
    if command.get_subcommands().next().is_some() {
        man.render_subcommands_section(&mut out)?;
    }
    let mut text = String::new();
    let [mut files, examples] = told(command.get_name());
    if command.get_arguments().any(|arg| arg.get_id() == "no_figures") {
        files.extend(EVERYWHERE);
    }
    section(&mut text, "FILES", &files);
    section(&mut text, "EXAMPLES", &examples);
    section(&mut text, "EXIT STATUS", &EXIT_STATUS);
    let runs_a_case = command.get_arguments().any(|arg| arg.get_id() == "set");
    if command.get_subcommands().next().is_some() || runs_a_case {
        text.push_str(".SH \"SEE ALSO\"\nfrictionsim\\-case(5): the keys of a case file\n");
    }
    out.extend_from_slice(text.as_bytes());
    if command.get_version().is_some() {
        man.render_version_section(&mut out)?;
    }
    Ok(out)
}

/// The page of the case file: every key with values, unit, default and meaning.
fn case_page() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut out = format!(".TH frictionsim-case 5 \"\" \"frictionsim {version}\"\n.SH NAME\n");
    out.push_str("frictionsim\\-case \\- keys of a case file, in TOML and SI units\n");
    for name in reference::sections() {
        let keys = KEYS.iter().filter(|key| key.section() == name);
        let entries: Vec<(String, String)> = keys
            .map(|key| {
                let term = format!("{} ({} {})", key.short(), key.values(), key.unit);
                let default = match key.default_text() {
                    "required" => "Required.".to_owned(),
                    other => format!("Default {other}."),
                };
                (term.replace(" )", ")"), format!("{}. {default}", key.meaning))
            })
            .collect();
        let entries: Vec<(&str, &str)> = entries.iter().map(|(t, m)| (&t[..], &m[..])).collect();
        let title = if name.is_empty() { "CASE" } else { name };
        section(&mut out, title, &entries);
    }
    out
}

/// A section of tagged paragraphs.
fn section(out: &mut String, title: &str, entries: &[(&str, &str)]) {
    if entries.is_empty() {
        return;
    }
    let _ = writeln!(out, ".SH \"{title}\"");
    for (term, meaning) in entries {
        let _ = writeln!(out, ".TP\n\\fB{}\\fR\n{}", escaped(term), escaped(meaning));
    }
}

/// Text that roff takes as it is.
fn escaped(text: &str) -> String {
    let text = text.replace('\\', "\\e").replace('-', "\\-");
    // A dot or an apostrophe would begin a request.
    if text.starts_with(['.', '\'']) { format!("\\&{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_that_runs_has_files_and_examples_in_its_page() {
        let mut command = command_line();
        command.build();
        for sub in command.get_subcommands() {
            let is_told = !told(sub.get_name())[1].is_empty();
            let needs = sub.get_arguments().any(|arg| arg.get_id() == "no_figures");
            assert!(is_told || !needs, "{}", sub.get_name());
        }
        for line in MANUAL.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let Some(name) = line.strip_prefix('[') else {
                assert!(line.contains(" | "), "{line} tells nothing");
                continue;
            };
            let name = name.trim_end_matches(']');
            assert!(command.find_subcommand(name).is_some(), "{name} is no command");
            for (line, _) in &told(name)[1] {
                let line = line.split(" | ").next().unwrap_or(line);
                let words = line.split(' ').collect::<Vec<&str>>();
                let parsed = command.clone().try_get_matches_from(words);
                assert!(parsed.is_ok(), "{line}: {}", parsed.unwrap_err());
            }
        }
    }
}
