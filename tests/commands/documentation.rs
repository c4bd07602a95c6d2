//! README and guide: every command shown runs, every result shown is printed, sentences and lines have the house's length.

use crate::architecture::rust_files;
use crate::prelude::*;

/// README, instructions and guide; the pages of keys and columns are made from the declarations.
fn pages() -> Vec<(String, String)> {
    let guide = files_below(&repository().join("src/guide")).into_iter();
    let is_written = |path: &PathBuf| {
        path.extension().is_some_and(|end| end == "md")
            && !["keys.md", "columns.md"].iter().any(|page| path.ends_with(page))
    };
    let mut paths: Vec<PathBuf> = guide.filter(is_written).collect();
    paths.extend(["README.md", "CONTRIBUTING.md"].map(|name| repository().join(name)));
    paths.sort();
    let page = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    paths.iter().map(page).collect()
}

struct Block {
    language: String,
    lines: Vec<String>,
}

/// The blocks of a page, and its paragraphs and items of lists, each in one line.
fn parts(text: &str) -> (Vec<Block>, Vec<String>) {
    let (mut blocks, mut paragraphs) = (Vec::new(), vec![String::new()]);
    let mut open: Option<Block> = None;
    for line in text.lines() {
        let trimmed = line.trim();
        if let Some(language) = trimmed.strip_prefix("```") {
            match open.take() {
                Some(block) => blocks.push(block),
                None => open = Some(Block { language: language.to_owned(), lines: Vec::new() }),
            }
            paragraphs.push(String::new());
        } else if let Some(block) = &mut open {
            block.lines.push(trimmed.to_owned());
        } else if trimmed.is_empty() || trimmed.starts_with(['|', '#', '<', '!']) {
            paragraphs.push(String::new());
        } else {
            let number = trimmed.split_once(". ").filter(|(start, _)| start.parse::<u8>().is_ok());
            let item = trimmed.strip_prefix("- ").or(number.map(|(_, rest)| rest));
            if item.is_some() {
                paragraphs.push(String::new());
            }
            let paragraph = paragraphs.last_mut().unwrap();
            paragraph.push_str(item.unwrap_or(trimmed));
            paragraph.push(' ');
        }
    }
    (blocks, paragraphs)
}

/// The words of a line, so that columns may be set closer.
fn words(line: &str) -> String {
    line.split_whitespace().collect::<Vec<&str>>().join(" ")
}

/// Whether a word is the one printed. A number with a decimal point may differ by one in its last digit: another machine
/// rounds differently, and a value close to the middle between two prints as the one or the other.
fn is_printed(shown: &str, printed: &str) -> bool {
    let number = |word: &str| word.parse::<f64>().ok().filter(|_| word.contains('.'));
    let (Some(value), Some(other)) = (number(shown), number(printed)) else {
        return shown == printed;
    };
    let (digits, power) = shown.split_once('e').unwrap_or((shown, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, end)| end.len()) as i32;
    let unit = 10f64.powi(power.parse::<i32>().unwrap() - decimals);
    (value - other).abs() < 1.5 * unit
}

/// Whether the words of a line stand one after the other in a printed one, whatever punctuation ends them.
fn stands_in(line: &str, printed: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        text.split(' ').map(|word| word.trim_end_matches([',', ';', ':', '.']).to_owned()).collect()
    };
    let (line, printed) = (words(line), words(printed));
    printed
        .windows(line.len())
        .any(|own| own.iter().zip(&line).all(|(own, shown)| is_printed(shown, own)))
}

/// The program's command lines of a block, continued lines joined, comments left out.
fn commands(block: &Block) -> Vec<String> {
    let joined = block.lines.join("\n").replace("\\\n", " ");
    let lines = joined.lines().map(|line| line.split(" #").next().unwrap_or(line).trim());
    lines.filter(|line| line.starts_with("frictionsim ")).map(words).collect()
}

/// Runs the commands of a page one after the other in a folder with the shipped cases, those of a block that begins with
/// `# dry run` with `--dry-run`. Figures of modes are drawn where the page draws them again. Every line of a block of printed text is part of what a command before it has printed.
fn run_page(name: &str) {
    let (_, text) = pages().into_iter().find(|(page, _)| page == name).unwrap();
    let folder = folder();
    Run::new(&["init", "--all"]).within(&folder).done();
    let mut printed = String::new();
    for block in parts(&text).0 {
        if block.language == "sh" {
            let is_dry = block.lines.first().is_some_and(|line| line.starts_with("# dry run"));
            let commands = commands(&block);
            if !commands.is_empty() {
                printed.clear();
            }
            for line in commands {
                let is_plain = line.starts_with("frictionsim cea ") && !text.contains("plot ");
                let mut given: Vec<&str> = line.split(' ').skip(1).collect();
                given.extend(is_dry.then_some("--dry-run"));
                given.extend(is_plain.then_some("--no-figures"));
                given.extend(line.starts_with("frictionsim init --all").then_some("--force"));
                let ran = Run::new(&given).within(&folder).end();
                assert_eq!(ran.code, Some(0), "{name}: {line}\n{}", ran.stderr);
                printed += &ran.stdout;
                printed.push('\n');
            }
        } else if block.language == "text" && !printed.is_empty() {
            let printed: Vec<String> = printed.lines().map(words).collect();
            for line in block.lines.iter().map(|line| words(line)) {
                let is_there = printed.iter().any(|own| stands_in(&line, own));
                assert!(is_there, "{name}: \"{line}\" is not in\n{}", printed.join("\n"));
            }
        }
    }
}

/// A test for each page with commands: it shows what they print.
macro_rules! pages_with_commands {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        fn $test() {
            run_page($name);
        })*

        #[test]
        fn every_page_with_commands_is_run() {
            let runs = |block: &Block| block.language == "sh" && !commands(block).is_empty();
            let found = pages().into_iter().filter(|(_, text)| parts(text).0.iter().any(runs));
            assert_eq!(found.map(|(name, _)| name).collect::<Vec<_>>(), [$($name),*]);
        }
    };
}

pages_with_commands! {
    the_readme_shows_what_its_commands_print: "README.md",
    the_page_of_analyses_shows_what_its_commands_print: "analyses.md",
    the_page_of_bodies_shows_what_its_commands_print: "bodies.md",
    the_page_for_a_brake_shows_what_its_commands_print: "brake.md",
    the_page_of_contact_shows_what_its_commands_print: "contact.md",
    the_page_of_matrices_shows_what_its_commands_print: "matrices.md",
    the_page_of_measurements_shows_what_its_commands_print: "measurement.md",
    the_page_for_an_own_part_shows_what_its_commands_print: "part.md",
    the_page_of_results_shows_what_its_commands_print: "results.md",
    the_page_for_a_start_shows_what_its_commands_print: "start.md",
}

#[test]
fn the_readme_is_short_and_pages_keep_within_100_columns() {
    for (name, text) in pages() {
        let most = if name == "README.md" { 180 } else { 250 };
        assert!(text.lines().count() <= most, "{name}");
        for line in text.lines() {
            assert!(line.chars().count() <= 100, "{name}: {line}");
        }
    }
}

/// The modules of the program and its crates: path and code.
fn modules() -> Vec<(String, String)> {
    let files = ["src", "crates"].into_iter().flat_map(rust_files);
    files.map(|path| (path.display().to_string(), fs::read_to_string(path).unwrap())).collect()
}

/// The texts between quotes in code, each in one line but for its own line breaks.
fn literals(code: &str) -> Vec<String> {
    let (mut found, mut rest) = (Vec::new(), code);
    while let Some(place) = rest.find(['/', '\'', '"']) {
        let (before, own) = rest.split_at(place);
        rest = &own[1..];
        if own.starts_with("//") {
            rest = own.split_once('\n').map_or("", |(_, rest)| rest);
        } else if own.starts_with("'\\") || own.starts_with("'\"'") {
            // A character that is escaped, or a quote.
            rest = &own[3..];
        } else if own.starts_with('"') {
            let hashes = &before[before.trim_end_matches('#').len()..];
            let (close, is_raw) = (format!("\"{hashes}"), before.ends_with(['#', 'r']));
            // A quote behind an odd number of backslashes is part of the text.
            let slashes = |at: usize| at - rest[..at].trim_end_matches('\\').len();
            let mut ends = rest.match_indices(&close).map(|(at, _)| at);
            let end = ends.find(|&at| is_raw || slashes(at) % 2 == 0).unwrap();
            let lines = rest[..end].split_inclusive("\\\n").map(str::trim_start);
            found.push(match is_raw {
                true => rest[..end].to_owned(),
                false => lines.collect::<String>().replace("\\\n", "").replace("\\n", "\n"),
            });
            rest = &rest[end + 1..];
        }
    }
    found
}

/// A sentence ends at a full stop, a colon or a question mark before a space; what stands as code is one word.
#[test]
fn sentences_of_readme_guide_and_modules_have_25_words_at_most() {
    // What modules and crates say of themselves at their heads.
    let heads = modules().into_iter().map(|(path, code)| {
        let head = code.lines().map_while(|line| line.strip_prefix("//!"));
        (path, head.collect::<Vec<_>>().join("\n"))
    });
    for (name, text) in pages().into_iter().chain(heads) {
        for paragraph in parts(&text).1 {
            let code = paragraph.split('`').enumerate();
            let plain: String =
                code.map(|(k, part)| if k % 2 == 1 { "code" } else { part }).collect();
            for sentence in plain.split(". ").flat_map(|part| part.split([':', '?'])) {
                let count = sentence.split_whitespace().count();
                assert!(count <= 25, "{name}: {count} words: {sentence}");
            }
        }
    }
}

/// Everything that `--help` prints of a command, of its options and of its subcommands.
fn help(command: &clap::Command) -> Vec<String> {
    let own = [command.get_about(), command.get_long_about(), command.get_after_help()];
    let mut texts: Vec<String> = own.into_iter().flatten().map(ToString::to_string).collect();
    for option in command.get_arguments() {
        let values = option.get_possible_values();
        let values = values.iter().map(|value| value.get_help());
        let all = values.chain([option.get_help(), option.get_long_help()]).flatten();
        texts.extend(all.map(ToString::to_string));
    }
    texts.into_iter().chain(command.get_subcommands().flat_map(help)).collect()
}

/// Sentences of messages, notes, captions, of `--help`, and of the pages of keys and columns: one ends at a full stop or a
/// question mark. A value put in is one word.
#[test]
fn sentences_of_messages_have_under_25_words() {
    let (mut long, mut count) = (String::new(), 0);
    let of_module = |(path, code): (String, String)| {
        (path, literals(code.split("#[cfg(test)]\nmod ").next().unwrap_or_default()))
    };
    let is_test = |path: &str| path.ends_with("tests.rs") || path.ends_with("fixtures.rs");
    let modules = modules().into_iter().filter(|module| !is_test(&module.0)).map(of_module);
    let pages = [
        ("keys.md", include_str!("../../src/guide/keys.md")),
        ("columns.md", include_str!("../../src/guide/columns.md")),
    ];
    let pages = pages.into_iter().map(|(name, page)| {
        (name.to_owned(), page.split('|').map(str::to_owned).collect::<Vec<_>>())
    });
    let help = ("--help".to_owned(), help(&frictionsim::app::command_line()));
    for (path, texts) in modules.chain(pages).chain([help]) {
        for text in texts {
            count += 1;
            let ends = |text: &str| text.replace(". ", ".\n").replace("? ", "?\n");
            let mut parts = text.split('{');
            let mut plain = parts.next().unwrap_or_default().to_owned();
            for part in parts {
                plain += &format!("X{}", part.split_once('}').map_or(part, |pair| pair.1));
            }
            for sentence in ends(&plain).lines() {
                let words = sentence.split_whitespace();
                let words = words.filter(|word| word.contains(char::is_alphanumeric)).count();
                if words >= 25 {
                    long += &format!("{path}: {words} words: {sentence}\n");
                }
            }
        }
    }
    assert!(count > 5_000, "{count} texts");
    assert!(long.is_empty(), "{long}");
}

/// Pages that the README and the instructions link to are there.
#[test]
fn links_of_readme_and_instructions_lead_somewhere() {
    for name in ["README.md", "CONTRIBUTING.md"] {
        let text = fs::read_to_string(repository().join(name)).unwrap();
        let inline = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let listed = text.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: "));
        for link in inline.chain(listed.map(|(_, link)| link)) {
            let path = link.split('#').next().unwrap_or(link);
            let is_there = link.starts_with("http") || repository().join(path).exists();
            assert!(is_there, "{name}: {link}");
        }
    }
}
